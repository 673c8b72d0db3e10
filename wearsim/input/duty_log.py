"""A log of load and speed: read from its file, and reduced to blocks.

Wear is linear in the path slid, so it is the histogram of load and speed that counts and
no pairing of peaks and valleys: every cell keeps its time, its revolutions and the mean
load over them, whatever the width of the bins.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from wearsim.files import MOST_ROWS
from wearsim.geometry.profile_points import Vector
from wearsim.input.csv_tables import MOST_NAMED, read_columns
from wearsim.input.faults import Faults


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


_TIME = {"time_s": 1.0, "time_hours": 3600.0, "secs": 1.0}
_SPEED = {"speed_rpm": 1.0, "cad": 1.0}
_LOAD = {"tension_N": 1.0, "torque_N_m": 1.0, "power_kW": 1e3, "power_W": 1.0, "watts": 1.0}
"""Columns that give time, speed and load, and their units in s, rpm, N, N m and W."""

_OF_METERS = {"secs": "time_s", "cad": "speed_rpm", "watts": "power_W"}
"""Columns as power meters of bicycles write them."""

COLUMNS = tuple(name for name in (*_TIME, *_SPEED, *_LOAD) if name not in _OF_METERS)
"""Columns that a log may have, by their names of the table of quantities."""

_POWERS = ("power_kW", "power_W", "watts")

_ALIKE, _MOST, _FEWEST = 0.1, 0.6, 5
"""A log is sampled evenly if so many of its steps differ from the median by no more than this part of it."""

_MISSING = 1.5
"""Step of an evenly sampled log over the median above which rows are missing."""

_GAP = 10.0
"""The same of any other log."""


@dataclass(frozen=True, eq=False)
class LogFile:
    """What a log says about a drive."""

    log: DutyLog  # the rows in which it runs
    lines: NDArray[np.int64]  # of these rows in the file, shape (rows,)
    kind: str  # of their load, `tension_N` or `torque_N_m`
    column: str  # that gives the load
    duration: float  # from the first row to the last [s]
    usual: float  # median step [s]
    even: bool  # whether it is sampled evenly
    gaps: int  # steps in which rows are missing
    missing: float  # time without rows [s]
    renamed: Mapping[str, str]  # columns by the names of a power meter, and what they are

    @property
    def running(self) -> float:
        """Time in which the drive runs [s]."""
        return float(self.log.step.sum())


def read_log(path: Path, key: str, faults: Faults) -> LogFile | None:
    """Read a log of load and speed."""
    columns = read_columns(path, (), (*COLUMNS, *_OF_METERS), key, faults, MOST_ROWS)
    if not columns:
        return None
    before = faults.count
    names = [_column(columns, group, path, key, faults) for group in (_TIME, _SPEED, _LOAD)]
    if faults.count > before:
        return None
    time, speed, load = (
        columns[name] * group[name] for name, group in zip(names, (_TIME, _SPEED, _LOAD), strict=True)
    )
    if time.size < 2:
        faults.add(key, f"{path.name}: needs at least 2 rows, has {time.size}")
        return None
    step = np.diff(time)
    for index in np.flatnonzero(step <= 0.0)[:MOST_NAMED]:
        faults.add(key, f"{path.name}:{index + 3}: {names[0]} must increase from row to row")
    if faults.count > before:
        return None
    usual, even = float(np.median(step)), _sampled_evenly(step)
    runs = speed[:-1] != 0.0
    missing = runs & (step > (_MISSING if even else _GAP) * usual)
    held = np.where(missing, usual, step)
    rows = np.flatnonzero(runs)
    log = _running(held[rows], load[rows], speed[rows], names[2] in _POWERS)
    _check_running(log, names, path, key, faults)
    if faults.count > before:
        return None
    return LogFile(
        log=log,
        lines=rows + 2,
        kind="torque_N_m" if names[2] in _POWERS else names[2],
        column=names[2],
        duration=float(time[-1] - time[0]),
        usual=usual,
        even=even,
        gaps=int(missing.sum()),
        missing=float((step - held).sum()),
        renamed={name: _OF_METERS[name] for name in names if name in _OF_METERS},
    )


def _column(
    columns: Mapping[str, Vector], group: Mapping[str, float], path: Path, key: str, faults: Faults
) -> str:
    """Return the one column of a group that the log has."""
    found = [name for name in group if name in columns]
    first, *others = (name for name in group if name not in _OF_METERS)
    if not found:
        instead = f", or {' or '.join(others)} in its place" if others else ""
        faults.add(key, f"{path.name}:1: column {first!r} is missing{instead}")
    if len(found) > 1:
        faults.add(
            key, f"{path.name}:1: only one column may give this (got {' and '.join(found)}): keep one of them"
        )
    return found[0] if found else first


def _sampled_evenly(step: Vector) -> bool:
    """Tell whether most steps are alike, so that a longer one is of rows that are missing.

    Examples
    --------
    >>> _sampled_evenly(np.array([1.0, 1.0, 1.02, 7.0, 1.0])), _sampled_evenly(np.array([20.0, 60.0] * 5))
    (True, False)
    """
    usual = np.median(step)
    return step.size >= _FEWEST and float(np.mean(np.abs(step - usual) <= _ALIKE * usual)) >= _MOST


def _running(step: Vector, load: Vector, speed: Vector, power: bool) -> DutyLog:
    """Return the rows of a drive that runs; power becomes the torque P/(2 pi n)."""
    torque = load / (2.0 * np.pi * speed / 60.0) if power else load
    return DutyLog(step, torque, np.abs(speed))


def _check_running(log: DutyLog, names: list[str], path: Path, key: str, faults: Faults) -> None:
    if not log.step.size:
        faults.add(key, f"{path.name}: {names[1]} must not be 0 in every row: the drive never runs")
    elif not log.load.any():
        faults.add(key, f"{path.name}: {names[2]} must be above 0 in some row in which the drive runs")
    elif not log.load.max() > 0.0:
        faults.add(
            key,
            f"{path.name}: {names[2]} must load the flank that is calculated in some row, but loads the "
            "other one only: reverse its signs",
        )
