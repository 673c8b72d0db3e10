"""A log of load and speed reduced to blocks.

Wear is linear in the path slid, so it is the histogram of load and speed that counts and
no pairing of peaks and valleys: every cell keeps its time, its revolutions and the mean
load over them, whatever the width of the bins.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from wearsim.geometry.profile_points import Vector


@dataclass(frozen=True, eq=False)
class DutyLog:
    """The rows of a log in which the drive runs."""

    step: Vector  # time that every row holds [s], shape (rows,)
    # tension of the tight strand [N] or torque [N m], below 0 where the other flank bears it, shape (rows,)
    load: Vector
    speed: Vector  # of the sprocket [rpm], above 0 in both senses of rotation, shape (rows,)

    def of_flank(self, other: bool) -> "DutyLog":
        """Return the rows that load the flank of positive loads, or the other one, with the size of the load.

        Examples
        --------
        >>> log = DutyLog(np.array([1.0, 2.0]), np.array([5.0, -3.0]), np.array([60.0, 90.0]))
        >>> log.of_flank(True)
        DutyLog(step=array([2.]), load=array([3.]), speed=array([90.]))
        """
        rows = (self.load < 0.0) == other
        return replace(self, step=self.step[rows], load=np.abs(self.load[rows]), speed=self.speed[rows])


@dataclass(frozen=True)
class LogBin:
    """Part of a log."""

    time: float  # how long it lasts [s]
    revolutions: float  # of the sprocket in this time
    load: float  # mean over the revolutions [N] or [N m]


def log_bins(log: DutyLog, load_bins: int, speed_bins: int) -> list[LogBin]:
    """Sort a log into bins of equal width between the least and the largest value.

    Examples
    --------
    Two rows of 10 s and 30 s at 60 rpm in one bin: 40 revolutions, mean (10 + 3 * 50)/4 N:

    >>> log = DutyLog(np.array([10.0, 30.0]), np.array([10.0, 50.0]), np.array([60.0, 60.0]))
    >>> log_bins(log, 1, 1)
    [LogBin(time=40.0, revolutions=40.0, load=40.0)]
    """
    if not log.step.size:
        return []
    cell = _bin(log.load, load_bins) * speed_bins + _bin(log.speed, speed_bins)
    revolutions = log.speed * log.step / 60.0
    count = load_bins * speed_bins
    time, turns, work = (
        np.bincount(cell, weights, count) for weights in (log.step, revolutions, revolutions * log.load)
    )
    return [LogBin(float(time[i]), float(turns[i]), float(work[i] / turns[i])) for i in np.flatnonzero(turns)]


def _bin(values: Vector, count: int) -> NDArray[np.int64]:
    low, high = values.min(), values.max()
    width = (high - low) / count
    if not width > 0.0:
        return np.zeros(values.size, dtype=np.int64)
    cell: NDArray[np.int64] = np.minimum(((values - low) / width).astype(np.int64), count - 1)
    return cell


def merged(blocks: list[LogBin], most_blocks: int) -> list[LogBin]:
    """Join the smallest blocks with their nearest until so many are left.

    The nearest is that with which the least of the variance of load and speed, each
    over its range, is lost.

    Examples
    --------
    >>> merged([LogBin(9.0, 9.0, 100.0), LogBin(3.0, 3.0, 60.0)], 1)
    [LogBin(time=12.0, revolutions=12.0, load=90.0)]
    """
    time = np.array([block.time for block in blocks])
    turns = np.array([block.revolutions for block in blocks])
    load = np.array([block.load for block in blocks])
    speed = turns / time
    ranges = [float(np.ptp(values)) or 1.0 for values in (load, speed)] if blocks else []
    while time.size > most_blocks:
        least = int(turns.argmin())
        away = ((load - load[least]) / ranges[0]) ** 2 + (
            (turns / time - turns[least] / time[least]) / ranges[1]
        ) ** 2
        lost = away * turns * turns[least] / (turns + turns[least])
        lost[least] = np.inf
        near = int(lost.argmin())
        work = load[near] * turns[near] + load[least] * turns[least]
        time[near] += time[least]
        turns[near] += turns[least]
        load[near] = work / turns[near]
        time, turns, load = (np.delete(values, least) for values in (time, turns, load))
    return [LogBin(*map(float, values)) for values in zip(time, turns, load, strict=True)]
