"""What is asked of a calibration, and what it answers."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from wearsim.case.model import Case
from wearsim.geometry.measured.registration import Freedom
from wearsim.study.calibrate.least_squares import Interval
from wearsim.study.calibrate.observe import Shown


@dataclass(frozen=True)
class Options:
    """How readings are fitted.

    Attributes
    ----------
    shapes : tuple of str
        Keys that are fitted besides the coefficients.
    freedom : str
        How profiles may be moved: ``none``, ``turn`` or ``free``.
    cutoff : float
        Cut-off wavelength of their filter [mm].
    confidence : float
        Of the intervals.
    """

    shapes: tuple[str, ...] = ()
    freedom: Freedom = "turn"
    cutoff: float = 0.8
    confidence: float = 0.9


@dataclass(frozen=True)
class Value:
    """A value that was fitted.

    Attributes
    ----------
    key : str
        Of the case.
    value, given : float
        Fitted, and in the case.
    interval : Interval
        By the profile of the likelihood.
    """

    key: str
    value: float
    given: float
    interval: Interval


@dataclass(frozen=True)
class Part:
    """What is left of the sprocket or of the chain.

    Attributes
    ----------
    name : str
        ``sprocket`` or ``chain``; ``pinion`` of gears.
    hours : float
        When it was read last [h].
    life : float
        In all [h].
    interval : Interval
        Of the life [h].
    """

    name: str
    hours: float
    life: float
    interval: Interval

    @property
    def remaining(self) -> float:
        """Hours that are left, 0 where the limit is passed."""
        return self._left(self.life)

    @property
    def band(self) -> Interval:
        """Hours that are left at both ends of the interval; fewer than none cannot be."""
        low, high = self._left(self.interval.low), self._left(self.interval.high)
        return Interval(low, high, self.interval.low_known or low == 0.0, self.interval.high_known)

    def _left(self, life: float) -> float:
        left = life - self.hours
        return left if left > _NOTHING * self.hours else 0.0


_NOTHING = 1e-6
"""Part of the hours run that counts as none left."""


@dataclass(frozen=True, eq=False)
class Calibration:
    """A case fitted to readings.

    Attributes
    ----------
    case : Case
        As it was given.
    options : Options
        How it was fitted.
    values : tuple of Value
        What was fitted.
    parts : tuple of Part
        What is left.
    chi_square : float
        Sum of squared residuals.
    freedom : int
        Its degrees of freedom.
    scale : float
        What the stated errors were multiplied by.
    readings : int
        Their number.
    moves : tuple of (int, float, float, float)
        Line of every profile, and how it was moved: turn [rad], shifts along x and y [mm].
    shown : tuple of Shown
        Every value beside its prediction.
    runs : int
        Runs of the case that were needed.
    tables : mapping
        Of the case with the fitted values, files by their whole paths.
    assumptions, warnings : tuple of str
        What was taken for granted, and what the user should look at.
    """

    case: Case
    options: Options
    values: tuple[Value, ...]
    parts: tuple[Part, ...]
    chi_square: float
    freedom: int
    scale: float
    readings: int
    moves: tuple[tuple[int, float, float, float], ...]
    shown: tuple[Shown, ...]
    runs: int
    tables: Mapping[str, Any]
    assumptions: tuple[str, ...]
    warnings: tuple[str, ...]
