"""Wear of sprockets: tooth profile, tooth load, wear, new profile, hours of life."""

from typing import TYPE_CHECKING

from wearsim._version import __version__
from wearsim.lazy import lazy_names

_PUBLIC = {
    "CalibrationResult": "wearsim.python.calibrate",
    "Case": "wearsim.case.model",
    "CaseError": "wearsim.errors",
    "ChainReadingsResult": "wearsim.python.chain_readings",
    "CheckResult": "wearsim.python.check",
    "ContactError": "wearsim.errors",
    "ConvergenceError": "wearsim.errors",
    "DriveCase": "wearsim.drive.drive_case",
    "DriveLife": "wearsim.drive.drive_result",
    "ExportResult": "wearsim.python.export",
    "GeometryError": "wearsim.errors",
    "JudgementResult": "wearsim.python.judge",
    "Life": "wearsim.result",
    "LoadsResult": "wearsim.python.loads",
    "LowerBound": "wearsim.result",
    "LubricationResult": "wearsim.python.lubricate",
    "MaintenanceResult": "wearsim.python.maintain",
    "OptimiseResult": "wearsim.python.optimise",
    "RemainingResult": "wearsim.python.remaining",
    "SelectionResult": "wearsim.python.select",
    "SweepResult": "wearsim.python.sweep",
    "UncertaintyResult": "wearsim.python.uncertainty",
    "WearResult": "wearsim.result",
    "WearsimError": "wearsim.errors",
    "calibrate": "wearsim.python.calibrate",
    "check": "wearsim.python.check",
    "export": "wearsim.python.export",
    "judge": "wearsim.python.judge",
    "load_case": "wearsim.drive.load_case",
    "loads": "wearsim.python.loads",
    "lubricate": "wearsim.python.lubricate",
    "maintain": "wearsim.python.maintain",
    "optimise": "wearsim.python.optimise",
    "progress_bar": "wearsim.python.progress",
    "remaining": "wearsim.python.remaining",
    "select": "wearsim.python.select",
    "simulate": "wearsim.python.simulate",
    "simulate_many": "wearsim.drive.simulate",
    "sweep": "wearsim.python.sweep",
    "uncertainty": "wearsim.python.uncertainty",
}

_FORMER: dict[str, tuple[str, str]] = {}
"""Names of before: what they are called now, and the version that will be without them."""

if TYPE_CHECKING:
    from wearsim.case.model import Case
    from wearsim.drive.drive_case import DriveCase
    from wearsim.drive.drive_result import DriveLife
    from wearsim.drive.load_case import load_case
    from wearsim.drive.simulate import simulate_many
    from wearsim.errors import CaseError, ContactError, ConvergenceError, GeometryError, WearsimError
    from wearsim.python.calibrate import CalibrationResult, calibrate
    from wearsim.python.chain_readings import ChainReadingsResult
    from wearsim.python.check import CheckResult, check
    from wearsim.python.export import ExportResult, export
    from wearsim.python.judge import JudgementResult, judge
    from wearsim.python.loads import LoadsResult, loads
    from wearsim.python.lubricate import LubricationResult, lubricate
    from wearsim.python.maintain import MaintenanceResult, maintain
    from wearsim.python.optimise import OptimiseResult, optimise
    from wearsim.python.progress import progress_bar
    from wearsim.python.remaining import RemainingResult, remaining
    from wearsim.python.select import SelectionResult, select
    from wearsim.python.simulate import simulate
    from wearsim.python.sweep import SweepResult, sweep
    from wearsim.python.uncertainty import UncertaintyResult, uncertainty
    from wearsim.result import Life, LowerBound, WearResult

__all__ = [
    "CalibrationResult",
    "Case",
    "CaseError",
    "ChainReadingsResult",
    "CheckResult",
    "ContactError",
    "ConvergenceError",
    "DriveCase",
    "DriveLife",
    "ExportResult",
    "GeometryError",
    "JudgementResult",
    "Life",
    "LoadsResult",
    "LowerBound",
    "LubricationResult",
    "MaintenanceResult",
    "OptimiseResult",
    "RemainingResult",
    "SelectionResult",
    "SweepResult",
    "UncertaintyResult",
    "WearResult",
    "WearsimError",
    "__version__",
    "calibrate",
    "check",
    "export",
    "judge",
    "load_case",
    "loads",
    "lubricate",
    "maintain",
    "optimise",
    "progress_bar",
    "remaining",
    "select",
    "simulate",
    "simulate_many",
    "sweep",
    "uncertainty",
]

__getattr__, __dir__ = lazy_names(__name__, _PUBLIC, _FORMER)
