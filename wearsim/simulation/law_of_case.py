"""The wear law of a case."""

from collections.abc import Callable
from dataclasses import replace

from wearsim.case.model import WearInput
from wearsim.wear.law import Law, archard, drozdov, power
from wearsim.wear.running_in import CONSTANT, RunningIn


def wear_law(wear: WearInput, coefficient: float) -> Law:
    """Return the law of a case with a coefficient of one's own."""
    laws: dict[str, Callable[[], Law]] = {
        "archard": lambda: archard(coefficient),
        "power": lambda: power(coefficient, wear.pressure_exponent),
        "drozdov": lambda: drozdov(
            coefficient, wear.pressure_exponent, wear.hardness, wear.reference_speed, wear.speed_exponent
        ),
    }
    return replace(laws[wear.law](), case_depth=wear.case_depth, core_factor=wear.core_factor)


def running_in_assumptions(warp: RunningIn) -> tuple[str, ...]:
    """Return what running-in takes for granted."""
    if warp.factor == 1.0:
        return ()
    return (
        f"running-in: the coefficients of teeth and joints are {warp.factor:g} times as high at first, "
        f"the excess falls to 1/e in {warp.cycles:.3g} cycles; joints of every new chain run in as well",
    )


def running_in(wear: WearInput, sliding_per_cycle: float) -> RunningIn:
    """Return how the law of a case runs in."""
    if wear.running_in_factor == 1.0 or not sliding_per_cycle > 0.0:
        return CONSTANT
    return RunningIn(wear.running_in_factor, wear.running_in_distance / sliding_per_cycle)
