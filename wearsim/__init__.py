"""Wear of sprockets: tooth profile, tooth load, wear, new profile, hours of life."""

from typing import TYPE_CHECKING

from wearsim._version import __version__
from wearsim.lazy import lazy_names

_PUBLIC = {
    "Case": "wearsim.case.model",
    "CaseError": "wearsim.errors",
    "ContactError": "wearsim.errors",
    "CheckResult": "wearsim.python.check",
    "ConvergenceError": "wearsim.errors",
    "DriveCase": "wearsim.study.whole_drive.keys",
    "DriveLife": "wearsim.study.whole_drive.model",
    "GeometryError": "wearsim.errors",
    "Life": "wearsim.result",
    "LoadsResult": "wearsim.python.loads",
    "LowerBound": "wearsim.result",
    "WearResult": "wearsim.result",
    "WearsimError": "wearsim.errors",
    "check": "wearsim.python.check",
    "load_case": "wearsim.case.load_case",
    "load_drive": "wearsim.study.whole_drive.keys",
    "loads": "wearsim.python.loads",
    "simulate": "wearsim.python.simulate",
    "simulate_many": "wearsim.simulation.batch_lives",
}

if TYPE_CHECKING:
    from wearsim.case.load_case import load_case
    from wearsim.case.model import Case
    from wearsim.errors import CaseError, ContactError, ConvergenceError, GeometryError, WearsimError
    from wearsim.python.check import CheckResult, check
    from wearsim.python.loads import LoadsResult, loads
    from wearsim.python.simulate import simulate
    from wearsim.result import Life, LowerBound, WearResult
    from wearsim.simulation.batch_lives import simulate_many
    from wearsim.study.whole_drive.keys import DriveCase, load_drive
    from wearsim.study.whole_drive.model import DriveLife

__all__ = [
    "Case",
    "CaseError",
    "CheckResult",
    "ContactError",
    "ConvergenceError",
    "DriveCase",
    "DriveLife",
    "GeometryError",
    "Life",
    "LoadsResult",
    "LowerBound",
    "WearResult",
    "WearsimError",
    "__version__",
    "check",
    "load_case",
    "load_drive",
    "loads",
    "simulate",
    "simulate_many",
]

__getattr__, __dir__ = lazy_names(__name__, _PUBLIC)
