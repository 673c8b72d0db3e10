"""The value of one input key at which a case lasts as long as required."""

import math
from collections.abc import Callable
from dataclasses import dataclass

from scipy.optimize import brentq

from wearsim.case.model import Case
from wearsim.drive.drive_case import DriveCase
from wearsim.drive.drive_result import DriveLife
from wearsim.drive.simulate import simulate
from wearsim.errors import WearsimError
from wearsim.result import WearResult

_FACTOR = 2.0
"""Between values tried on the way to a bracket."""

_MAX_FACTORS = 24
_IN_VAIN = 4
"""Steps in a row that bring the life no nearer to what is required, after which a direction is given up."""

_EDGE_STEPS = 12
"""Halvings of the logarithm on the way to the last value that is allowed."""

_STEP = 0.02
"""Relative step of the slope."""

_LEAST_HOURS = 1e-9
"""Stands for the life of no hours of a case that contact fatigue damages from the start."""

Result = WearResult | DriveLife


def hours_to_first_end(result: Result) -> float:
    """Hours until anything ends, by whatever mode, as far as the run went."""
    return min(life.hours_run for life in result.named_lives.values())


def hours_to_wear(result: Result) -> float:
    """Hours until anything is worn out, as far as the run went."""
    return result.life.hours_run


@dataclass(frozen=True)
class SolveTrial:
    """A value and what the case does with it."""

    value: float  # of the key
    hours: float  # life, or twice the required hours where it is at least that [h]
    result: Result  # the run


@dataclass(frozen=True)
class Solved:
    """The value that gives the required life, or the best that the allowed range has."""

    trial: SolveTrial  # at the value
    met: bool  # whether it gives the life; otherwise it is the one that comes nearest
    # relative change of the life over that of the value, there; nan where not known
    elasticity: float
    low: float  # values between which the case could be run
    high: float  # values between which the case could be run
    runs: int  # lives that were calculated


class _Lives:
    """Lives by value, each calculated once."""

    def __init__(
        self,
        case_at: Callable[[float], Case | DriveCase],
        hours: float,
        whole: bool,
        life_of: Callable[[Result], float],
    ) -> None:
        self.case_at, self.required, self.whole, self.life_of = case_at, hours, whole, life_of
        self.found: dict[float, SolveTrial | None] = {}
        self.failure: WearsimError | None = None

    def at(self, value: float) -> SolveTrial | None:
        """Return the trial at a value, None where the case cannot be run with it."""
        value = float(round(value)) if self.whole else value
        if value not in self.found:
            self.found[value] = self._run(value)
        return self.found[value]

    def excess(self, value: float) -> float:
        """Return the logarithm of life over required life; raise where the case cannot be run."""
        trial = self.at(value)
        if trial is None:
            assert self.failure is not None
            raise self.failure
        return math.log(trial.hours / self.required)

    def _run(self, value: float) -> SolveTrial | None:
        try:
            result = simulate(self.case_at(value).with_horizon(2.0 * self.required))
        except WearsimError as error:
            self.failure = error
            return None
        return SolveTrial(value, max(self.life_of(result), _LEAST_HOURS), result)


def solve_for(
    case_at: Callable[[float], Case | DriveCase],
    start: float,
    hours: float,
    whole: bool = False,
    life_of: Callable[[Result], float] = hours_to_first_end,
) -> Solved:
    """Find the value of a key at which a case lasts as long as required.

    From the start the value is doubled or halved, to the side on which the life comes
    nearer first, until the life is met, the case refuses or four steps bring the life no
    nearer; Brent's method on the logarithms follows, for whole numbers bisection to the
    value that still lasts as long.
    """
    lives = _Lives(case_at, hours, whole, life_of)
    first = lives.at(start)
    if first is None:
        assert lives.failure is not None
        raise lives.failure
    bracket = None
    for direction in _directions(lives, start):
        bracket = _bracket(lives, start, direction)
        if bracket is not None:
            break
    allowed = [value for value, trial in lives.found.items() if trial is not None]
    trial = _nearest(lives) if bracket is None else _root(lives, *bracket)
    return Solved(
        trial, bracket is not None, _elasticity(lives, trial), min(allowed), max(allowed), len(lives.found)
    )


def _directions(lives: _Lives, start: float) -> tuple[float, float]:
    """Both directions, first the one in which the life comes nearer to what is required."""
    step = 1.0 / start if lives.whole else _STEP
    other = lives.at(start * (1.0 + step))
    if other is None:
        return 1.0 / _FACTOR, _FACTOR
    nearer = abs(lives.excess(other.value)) < abs(lives.excess(start))
    return (_FACTOR, 1.0 / _FACTOR) if nearer else (1.0 / _FACTOR, _FACTOR)


def _bracket(lives: _Lives, start: float, factor: float) -> tuple[float, float] | None:
    """Return two values between which the life is met, None where there are none on this side."""
    inside, sign = start, lives.excess(start) > 0.0
    nearest, in_vain = abs(lives.excess(start)), 0
    for _ in range(_MAX_FACTORS):
        outside = inside * factor
        trial = lives.at(outside)
        if trial is None:
            return _at_edge(lives, inside, outside, sign)
        if (lives.excess(trial.value) > 0.0) != sign:
            return inside, trial.value
        distance = abs(lives.excess(trial.value))
        in_vain = 0 if distance < nearest else in_vain + 1
        if trial.value == inside or in_vain == _IN_VAIN:
            return None
        inside, nearest = trial.value, min(nearest, distance)
    return None


def _at_edge(lives: _Lives, inside: float, outside: float, sign: bool) -> tuple[float, float] | None:
    """Go on towards a value that is refused, as near as bisection comes."""
    start = inside
    for _ in range(_EDGE_STEPS):
        trial = lives.at(math.sqrt(inside * outside))
        if trial is None:
            outside = math.sqrt(inside * outside)
        elif (lives.excess(trial.value) > 0.0) != sign:
            return start, trial.value
        else:
            inside = trial.value
    return None


def _root(lives: _Lives, one: float, other: float) -> SolveTrial:
    low, high = sorted((one, other))
    if lives.whole:
        return _whole_root(lives, low, high)
    tolerance = 0.1 * lives.found[one].result.life_tolerance  # type: ignore[union-attr]

    def value(part: float) -> float:
        return high if part == 1.0 else low * (high / low) ** part

    root = brentq(lambda part: lives.excess(value(part)), 0.0, 1.0, xtol=tolerance / math.log(high / low))
    found = lives.at(value(root))
    assert found is not None
    return found


def _whole_root(lives: _Lives, low: float, high: float) -> SolveTrial:
    """The whole number next to the root that lasts as long as required."""
    rising = lives.excess(high) > 0.0
    while (middle := _between(lives, low, high)) is not None:
        low, high = (low, middle) if (lives.excess(middle) > 0.0) == rising else (middle, high)
    found = lives.at(high if rising else low)
    assert found is not None
    return found


def _between(lives: _Lives, low: float, high: float) -> float | None:
    """The whole number nearest to the middle of two at which the case can be run, if there is one."""
    middle = 0.5 * (low + high)
    inside = sorted(range(int(low) + 1, int(high)), key=lambda value: abs(value - middle))
    return next((float(value) for value in inside if lives.at(value) is not None), None)


def _nearest(lives: _Lives) -> SolveTrial:
    trials = [trial for trial in lives.found.values() if trial is not None]
    return min(trials, key=lambda trial: abs(math.log(trial.hours / lives.required)))


def _elasticity(lives: _Lives, trial: SolveTrial) -> float:
    """Relative change of the life over that of the value, by a step to each side that can be run."""
    step = 1.0 / trial.value if lives.whole else _STEP
    around = [lives.at(trial.value * (1.0 + part)) for part in (-step, step)]
    known = [other or trial for other in around]
    ratio = math.log(known[1].value / known[0].value)
    return math.log(known[1].hours / known[0].hours) / ratio if ratio else math.nan
