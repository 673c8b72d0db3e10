"""The wear law of a case."""

from collections.abc import Callable

from wearsim.case.model import WearInput
from wearsim.wear.law import Law, archard, drozdov, power


def wear_law(wear: WearInput, coefficient: float) -> Law:
    """Return the law of a case with a coefficient of one's own.

    Parameters
    ----------
    wear : WearInput
        The law as it was given.
    coefficient : float
        In place of the given one.

    Returns
    -------
    Law
        What the wear engine takes.
    """
    laws: dict[str, Callable[[], Law]] = {
        "archard": lambda: archard(coefficient),
        "power": lambda: power(coefficient, wear.pressure_exponent),
        "drozdov": lambda: drozdov(
            coefficient,
            wear.pressure_exponent,
            wear.hardness,
            wear.reference_speed,
            wear.speed_exponent,
        ),
    }
    return laws[wear.law]()
