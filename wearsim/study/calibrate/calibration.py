"""What is asked of a calibration, and what it answers."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from wearsim.case.model import Case
from wearsim.geometry.measured.registration import Freedom
from wearsim.geometry.profile_points import Vector
from wearsim.readings.relubrications import RelubricationLog
from wearsim.readings.teeth_as_read import Teeth
from wearsim.study.calibrate.least_squares import ConfidenceInterval
from wearsim.study.calibrate.observations import ReadingResidual


@dataclass(frozen=True)
class CalibrationOptions:
    """How readings are fitted."""

    shapes: tuple[str, ...] = ()  # keys that are fitted besides the coefficients
    freedom: Freedom = "turn"  # how profiles may be moved: `none`, `turn` or `free`
    cutoff: float = 0.8  # cut-off wavelength of their filter [mm]
    confidence: float = 0.9  # of the intervals
    sprocket: str = ""  # of a whole drive, on which teeth were read
    teeth: Teeth = "case"  # what the teeth of the fitted case wear by where only the chain was read


@dataclass(frozen=True)
class FittedCoefficient:
    """A value that was fitted."""

    key: str  # of the case
    value: float  # fitted, and in the case
    in_case: float  # fitted, and in the case
    interval: ConfidenceInterval  # by the profile of the likelihood
    holds_at: str = ""  # where it holds, in words; everywhere without them


@dataclass(frozen=True)
class PartLife:
    """What is left of the sprocket or of the chain."""

    name: str  # `sprocket` or `chain`; `pinion` of gears
    hours: float  # when it was read last [h]
    life: float  # in all [h]
    interval: ConfidenceInterval  # of the life [h]

    @property
    def remaining(self) -> float:
        """Hours that are left, 0 where the limit is passed."""
        return self._left(self.life)

    @property
    def band(self) -> ConfidenceInterval:
        """Hours that are left at both ends of the interval; fewer than none cannot be."""
        low, high = self._left(self.interval.low), self._left(self.interval.high)
        return ConfidenceInterval(low, high, self.interval.low_known or low == 0.0, self.interval.high_known)

    def _left(self, life: float) -> float:
        left = life - self.hours
        return left if left > _NOTHING * self.hours else 0.0


_NOTHING = 1e-6
"""Part of the hours run that counts as none left."""


@dataclass(frozen=True, eq=False)
class Calibration:
    """A case fitted to readings."""

    case: Case  # as it was given
    options: CalibrationOptions  # how it was fitted
    values: tuple[FittedCoefficient, ...]  # what was fitted
    parts: tuple[PartLife, ...]  # what is left
    chi_square: float  # sum of squared residuals
    freedom: int  # its degrees of freedom
    scale: float  # what the stated errors were multiplied by
    readings: int  # their number
    relubrications: RelubricationLog
    # line of every profile, and how it was moved: turn [rad], shifts along x and y [mm]
    moves: tuple[tuple[int, float, float, float], ...]
    shown: tuple[ReadingResidual, ...]  # every value beside its prediction
    chain_course: tuple[Vector, Vector]  # of the fit [h], [%]; empty where no chain was read
    runs: int  # runs of the case that were needed
    tables: Mapping[str, Any]  # of the case with the fitted values, files by their whole paths
    assumptions: tuple[str, ...]  # what was taken for granted, and what the user should look at
    warnings: tuple[str, ...]  # what was taken for granted, and what the user should look at
