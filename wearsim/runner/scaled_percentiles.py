"""Percentiles of a life that follow from one run: life times wear coefficient is constant."""

import numpy as np

from wearsim.case.keys.study_tables import Distribution
from wearsim.case.model import Case
from wearsim.errors import CaseError, Fault
from wearsim.result import Life, WearResult
from wearsim.runner.scatter import coefficient_key, quantile


def scaled_percentiles(result: WearResult, case: Case, shares: tuple[float, ...]) -> list[float]:
    """Return the hours that parts of all lives do not exceed, where they follow without samples.

    That is so where by [uncertainty] only the wear coefficient scatters, every limit is one of the
    teeth (no wrap, whose chain wears by another coefficient), contact fatigue is not asked for,
    and the coefficient does not change as the drive runs in or with the lubricant: the percentile p of
    the life is L k / k_(1-p).
    """
    table = result.inputs.get("uncertainty") or {}
    steady = (
        not case.drive.wear_coefficients
        and case.wear.is_steady
        and (case.lubrication is None or case.lubrication.steady)
    )
    alone = list(table) == [coefficient_key(case)] and not result.fatigue
    if not alone or not steady or not isinstance(result.life, Life):
        return []
    (entry,) = table.values()
    value = case.wear.coefficient
    coefficients = quantile(Distribution.model_validate(entry), value)(1.0 - np.array(shares))
    return [result.life.hours * value / float(coefficient) for coefficient in coefficients]


def check_steady_lubricant(case: Case, command: str, instead: str) -> None:
    """Raise where the wear coefficient of a case changes with its lubricant, and say what works instead."""
    if case.lubrication is not None and not case.lubrication.is_constant:
        message = (
            f"{command!r} scales lives, which holds for a constant coefficient only: remove this table, or "
            f"{instead}"
        )
        raise CaseError([Fault(message, "lubrication", case.name)])


def check_no_running_in(case: Case, command: str) -> None:
    """Raise where the wear coefficient of a case changes with the cycles run."""
    if case.wear.is_steady:
        return
    runs_in = case.wear.running_in_factor != 1.0
    key, other = (
        ("running_in_factor", "running_in_distance_mm") if runs_in else ("cycles_exponent", "reference_hours")
    )
    message = (
        f"{command!r} scales lives, which holds for a constant coefficient only: remove {key} and {other}"
    )
    raise CaseError([Fault(message, f"wear.{key}", case.name)])
