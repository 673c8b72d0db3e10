"""Wear of sprockets: tooth profile, tooth load, wear, new profile, hours of life."""

from typing import TYPE_CHECKING

from wearsim._version import __version__
from wearsim.lazy import lazy_names

_PUBLIC = {
    "CalibrationResult": "wearsim.study.calibrate.answer",
    "Case": "wearsim.case.model",
    "CaseError": "wearsim.errors",
    "ChainReadingsResult": "wearsim.study.remaining.chain_answer",
    "CheckResult": "wearsim.report.check",
    "ContactError": "wearsim.errors",
    "ConvergenceError": "wearsim.errors",
    "DriveCase": "wearsim.drive.drive_case",
    "DriveLife": "wearsim.drive.drive_result",
    "ExportResult": "wearsim.cad.export",
    "GeometryError": "wearsim.errors",
    "JudgementResult": "wearsim.study.judge.answer",
    "Life": "wearsim.result",
    "LoadsResult": "wearsim.report.loads_result",
    "LowerBound": "wearsim.result",
    "LubricationResult": "wearsim.study.lubricate.answer",
    "MaintenanceResult": "wearsim.study.maintain.answer",
    "OptimiseResult": "wearsim.study.optimise.answer",
    "RemainingResult": "wearsim.study.remaining.answer",
    "ScanResult": "wearsim.scanning.answer",
    "SelectionResult": "wearsim.study.select.answer",
    "SweepResult": "wearsim.study.sweep.answer",
    "UncertaintyResult": "wearsim.study.uncertainty.answer",
    "WearResult": "wearsim.result",
    "WearsimError": "wearsim.errors",
    "YearPlanResult": "wearsim.study.maintain.year_answer",
    "allow_outside": "wearsim.input.named_files",
    "calibrate": "wearsim.study.calibrate.answer",
    "check": "wearsim.report.check",
    "export": "wearsim.cad.export",
    "judge": "wearsim.study.judge.answer",
    "load_case": "wearsim.drive.load_case",
    "loads": "wearsim.report.loads_result",
    "lubricant": "wearsim.lubrication.own_lubricant",
    "lubricate": "wearsim.study.lubricate.answer",
    "maintain": "wearsim.study.maintain.answer",
    "optimise": "wearsim.study.optimise.answer",
    "progress_bar": "wearsim.runner.progress",
    "remaining": "wearsim.study.remaining.answer",
    "scan": "wearsim.scanning.answer",
    "select": "wearsim.study.select.answer",
    "simulate": "wearsim.drive.simulate",
    "simulate_many": "wearsim.drive.simulate",
    "sweep": "wearsim.study.sweep.answer",
    "uncertainty": "wearsim.study.uncertainty.answer",
    "wear_law": "wearsim.catalogue.own_wear_laws",
}

_FORMER: dict[str, tuple[str, str]] = {}
"""Names of before: what they are called now, and the version that will be without them."""

if TYPE_CHECKING:
    from wearsim.cad.export import ExportResult, export
    from wearsim.case.model import Case
    from wearsim.catalogue.own_wear_laws import wear_law
    from wearsim.drive.drive_case import DriveCase
    from wearsim.drive.drive_result import DriveLife
    from wearsim.drive.load_case import load_case
    from wearsim.drive.simulate import simulate, simulate_many
    from wearsim.errors import CaseError, ContactError, ConvergenceError, GeometryError, WearsimError
    from wearsim.input.named_files import allow_outside
    from wearsim.lubrication.own_lubricant import lubricant
    from wearsim.report.check import CheckResult, check
    from wearsim.report.loads_result import LoadsResult, loads
    from wearsim.result import Life, LowerBound, WearResult
    from wearsim.runner.progress import progress_bar
    from wearsim.scanning.answer import ScanResult, scan
    from wearsim.study.calibrate.answer import CalibrationResult, calibrate
    from wearsim.study.judge.answer import JudgementResult, judge
    from wearsim.study.lubricate.answer import LubricationResult, lubricate
    from wearsim.study.maintain.answer import MaintenanceResult, maintain
    from wearsim.study.maintain.year_answer import YearPlanResult
    from wearsim.study.optimise.answer import OptimiseResult, optimise
    from wearsim.study.remaining.answer import RemainingResult, remaining
    from wearsim.study.remaining.chain_answer import ChainReadingsResult
    from wearsim.study.select.answer import SelectionResult, select
    from wearsim.study.sweep.answer import SweepResult, sweep
    from wearsim.study.uncertainty.answer import UncertaintyResult, uncertainty

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
    "ScanResult",
    "SelectionResult",
    "SweepResult",
    "UncertaintyResult",
    "WearResult",
    "WearsimError",
    "YearPlanResult",
    "__version__",
    "allow_outside",
    "calibrate",
    "check",
    "export",
    "judge",
    "load_case",
    "loads",
    "lubricant",
    "lubricate",
    "maintain",
    "optimise",
    "progress_bar",
    "remaining",
    "scan",
    "select",
    "simulate",
    "simulate_many",
    "sweep",
    "uncertainty",
    "wear_law",
]

__getattr__, __dir__ = lazy_names(__name__, _PUBLIC, _FORMER)
