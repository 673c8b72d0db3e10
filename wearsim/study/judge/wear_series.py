"""Readings of wear in series: one specimen, chain or lubricant each, read now and then."""

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from wearsim.geometry.profile_points import Vector


@dataclass(frozen=True)
class WearReading:
    """One reading of a series."""

    series: str  # what was read: a specimen, a chain, a lubricant
    exposure: float  # since it was new, above 0: cycles, hours or a distance
    wear: float  # since it was new, above 0
    load: float = 1.0  # on it
    slip: float = 1.0  # way slid over the exposure, the same along a series
    error: float = 0.0  # standard deviation of the gauge, in the unit of the wear
    censored: int = 0  # 1 where the wear is above the reading, -1 where it is below, else 0
    environment: str = ""  # since the reading before
    relubricated: bool = False  # after the reading
    t_gamma: float = np.nan  # friction force times slip over the area of contact [N/mm2]
    speed: float = np.nan  # of sliding [m/s]
    held_out: bool = False  # to judge by, not to fit
    line: int = 0  # of the file that it stands in


@dataclass(frozen=True, eq=False)
class WearSeries:
    """Readings in columns of shape (n,), those of one series together and in order."""

    names: tuple[str, ...]  # of the series, s of them
    exposure_unit: str  # cycles, h, km or m
    wear_unit: str  # um, mm, mg or %
    series: NDArray[np.intp]  # number of the series of each reading
    exposure: Vector  # in parts of the longest one
    longest: float  # longest exposure [exposure unit]
    wear: Vector  # [wear unit]
    load: Vector  # in parts of the geometric mean
    slip: Vector  # way slid over the exposure
    error: Vector  # of the gauge [wear unit]
    censored: NDArray[np.intp]  # 1 above, -1 below, 0 read
    environments: tuple[str, ...]  # in the order of their first readings
    environment: NDArray[np.intp]  # number of the environment since the reading before
    start: Vector  # exposure at the reading before, 0 for the first one
    age: Vector  # exposure since the last relubrication, at the reading before
    relubricated: bool  # whether that was noted at all
    t_gamma: Vector  # [N/mm2]
    speed: Vector  # [m/s]
    held_out: NDArray[np.bool_]
    slots: NDArray[np.intp]  # shape (s, most readings of a series): numbers of readings, -1 for none
    warnings: tuple[str, ...] = ()  # what is doubtful about the readings

    @property
    def fitted(self) -> NDArray[np.bool_]:
        """Which readings are to be fitted."""
        return ~self.held_out

    def summed(self, parts: Vector) -> Vector:
        """Return sums along each series of what its intervals add, parts of shape (..., n)."""
        total = np.cumsum(parts, axis=-1)
        first = self.slots[:, 0]
        before = total[..., first] - parts[..., first]
        return np.asarray(total - before[..., self.series])


def wear_series(
    readings: Iterable[WearReading], exposure_unit: str, wear_unit: str, relubrication_noted: bool = False
) -> WearSeries:
    """Return readings as columns.

    Examples
    --------
    >>> found = wear_series([WearReading("a", 5.0, 2.0), WearReading("a", 10.0, 3.0)], "km", "um")
    >>> found.exposure.tolist(), found.start.tolist()
    ([0.5, 1.0], [0.0, 0.5])
    """
    given = list(readings)
    names = tuple(dict.fromkeys(one.series for one in given))
    by_name = {name: index for index, name in enumerate(names)}
    rows = sorted(given, key=lambda one: (by_name[one.series], one.exposure))
    series = np.array([by_name[one.series] for one in rows])
    longest = max(one.exposure for one in rows)
    environments = tuple(dict.fromkeys(one.environment for one in rows))
    load = np.array([one.load for one in rows])
    start, age = _before(rows)
    most = int(np.bincount(series).max())
    slots = np.full((len(names), most), -1)
    for index in range(len(names)):
        own = np.flatnonzero(series == index)
        slots[index, : own.size] = own
    return WearSeries(
        names=names,
        exposure_unit=exposure_unit,
        wear_unit=wear_unit,
        series=series,
        exposure=np.array([one.exposure for one in rows]) / longest,
        longest=longest,
        wear=np.array([one.wear for one in rows]),
        load=load / np.exp(np.log(load).mean()),
        slip=np.array([one.slip for one in rows]),
        error=np.array([one.error for one in rows]),
        censored=np.array([one.censored for one in rows]),
        environments=environments,
        environment=np.array([environments.index(one.environment) for one in rows]),
        start=np.array(start) / longest,
        age=np.array(age) / longest,
        relubricated=relubrication_noted or any(one.relubricated for one in rows),
        t_gamma=np.array([one.t_gamma for one in rows]),
        speed=np.array([one.speed for one in rows]),
        held_out=np.array([one.held_out for one in rows]),
        slots=slots,
    )


def _before(rows: list[WearReading]) -> tuple[list[float], list[float]]:
    """Return exposure and age of the lubricant at the reading before each one."""
    start, age = [0.0], [0.0]
    for before, one in pairwise(rows):
        same = one.series == before.series
        start.append(before.exposure if same else 0.0)
        grown = age[-1] + before.exposure - start[-2]
        age.append(grown if same and not before.relubricated else 0.0)
    return start, age
