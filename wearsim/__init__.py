"""Wear of sprockets: tooth profile, tooth load, wear, new profile, hours of life."""

from typing import TYPE_CHECKING, Any

from wearsim._version import __version__

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


def __getattr__(name: str) -> Any:
    if name not in _PUBLIC:
        raise AttributeError(f"module 'wearsim' has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(_PUBLIC[name]), name)


def __dir__() -> list[str]:
    return sorted([*globals(), *_PUBLIC])
