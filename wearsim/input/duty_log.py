"""A log of tension and speed reduced to blocks.

Wear is linear in the path slid, so it is the histogram of tension and speed that counts and
no pairing of peaks and valleys: every cell keeps its time, its revolutions and the mean
tension over them, whatever the width of the bins.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from wearsim.geometry.profile_points import Vector


@dataclass(frozen=True, eq=False)
class DutyLog:
    """A log whose rows hold until the next; the last row only ends the one before."""

    step: Vector  # time that every row holds [s], shape (rows - 1,)
    tension: Vector  # of the tight strand [N], shape (rows - 1,)
    speed: Vector  # of the sprocket [rpm], above 0, shape (rows - 1,)

    @property
    def duration(self) -> float:
        """Time from the first to the last row [s]."""
        return float(self.step.sum())


@dataclass(frozen=True)
class LogBin:
    """Part of a log."""

    time: float  # how long it lasts [s]
    revolutions: float  # of the sprocket in this time
    tension: float  # mean over the revolutions [N]


def log_bins(log: DutyLog, tension_bins: int, speed_bins: int) -> list[LogBin]:
    """Sort a log into bins of equal width between the least and the largest value.

    Examples
    --------
    Two rows of 10 s and 30 s at 60 rpm in one bin: 40 revolutions, mean (10 + 3 * 50)/4 N:

    >>> log = DutyLog(np.array([10.0, 30.0]), np.array([10.0, 50.0]), np.array([60.0, 60.0]))
    >>> log_bins(log, 1, 1)
    [LogBin(time=40.0, revolutions=40.0, tension=40.0)]
    """
    cell = _bin(log.tension, tension_bins) * speed_bins + _bin(log.speed, speed_bins)
    revolutions = log.speed * log.step / 60.0
    count = tension_bins * speed_bins
    time, turns, work = (
        np.bincount(cell, weights, count) for weights in (log.step, revolutions, revolutions * log.tension)
    )
    return [LogBin(float(time[i]), float(turns[i]), float(work[i] / turns[i])) for i in np.flatnonzero(turns)]


def _bin(values: Vector, count: int) -> NDArray[np.int64]:
    low, high = values.min(), values.max()
    width = (high - low) / count
    if not width > 0.0:
        return np.zeros(values.size, dtype=np.int64)
    cell: NDArray[np.int64] = np.minimum(((values - low) / width).astype(np.int64), count - 1)
    return cell


def merged(blocks: list[LogBin], greatest: int) -> list[LogBin]:
    """Join the smallest blocks with their nearest until so many are left.

    The nearest is that with which the least of the variance of tension and speed, each
    over its range, is lost.

    Examples
    --------
    >>> merged([LogBin(9.0, 9.0, 100.0), LogBin(3.0, 3.0, 60.0)], 1)
    [LogBin(time=12.0, revolutions=12.0, tension=90.0)]
    """
    time = np.array([block.time for block in blocks])
    turns = np.array([block.revolutions for block in blocks])
    tension = np.array([block.tension for block in blocks])
    speed = turns / time
    ranges = [float(np.ptp(values)) or 1.0 for values in (tension, speed)]
    while time.size > greatest:
        least = int(turns.argmin())
        away = ((tension - tension[least]) / ranges[0]) ** 2 + (
            (turns / time - turns[least] / time[least]) / ranges[1]
        ) ** 2
        lost = away * turns * turns[least] / (turns + turns[least])
        lost[least] = np.inf
        near = int(lost.argmin())
        work = tension[near] * turns[near] + tension[least] * turns[least]
        time[near] += time[least]
        turns[near] += turns[least]
        tension[near] = work / turns[near]
        time, turns, tension = (np.delete(values, least) for values in (time, turns, tension))
    return [LogBin(*map(float, values)) for values in zip(time, turns, tension, strict=True)]
