"""Wear of sprockets: tooth profile, tooth load, wear, new profile, hours of life."""

from typing import TYPE_CHECKING

from wearsim._version import __version__
from wearsim.lazy import lazy_names

_PUBLIC = {
    "Case": "wearsim.case.model",
    "CaseError": "wearsim.errors",
    "ContactError": "wearsim.errors",
    "ConvergenceError": "wearsim.errors",
    "GeometryError": "wearsim.errors",
    "Life": "wearsim.result",
    "LowerBound": "wearsim.result",
    "WearResult": "wearsim.result",
    "WearsimError": "wearsim.errors",
    "load_case": "wearsim.case.load_case",
    "simulate": "wearsim.simulation",
    "simulate_many": "wearsim.simulation.batch_lives",
}

if TYPE_CHECKING:
    from wearsim.case.load_case import load_case
    from wearsim.case.model import Case
    from wearsim.errors import CaseError, ContactError, ConvergenceError, GeometryError, WearsimError
    from wearsim.result import Life, LowerBound, WearResult
    from wearsim.simulation import simulate
    from wearsim.simulation.batch_lives import simulate_many

__all__ = [
    "Case",
    "CaseError",
    "ContactError",
    "ConvergenceError",
    "GeometryError",
    "Life",
    "LowerBound",
    "WearResult",
    "WearsimError",
    "__version__",
    "load_case",
    "simulate",
    "simulate_many",
]

__getattr__, __dir__ = lazy_names(__name__, _PUBLIC)
