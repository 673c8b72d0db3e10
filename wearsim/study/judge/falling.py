"""Readings of wear that fall, which wear does not do."""

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from operator import itemgetter
from statistics import median
from typing import NamedTuple

from wearsim.study.judge.wear_series import WearReading

_LEAST_SD, _USUAL_SD = 0.01, 0.1
"""Standard deviation of ln(wear) of a reading: the least, and what is taken where readings do not tell."""

_TO_TELL = 3
"""Readings between two others that tell the scatter."""

_NORMAL = 1.4826
"""Standard deviation of a normal distribution over the median of its sizes."""

_BEYOND = 4.0
"""Standard deviations that no two readings are apart by scatter."""


class WearFall(NamedTuple):
    """A reading, and a higher one before it."""

    later: WearReading
    earlier: WearReading


def falls(readings: Iterable[WearReading]) -> list[WearFall]:
    """Return the worst fall of each series that has one beyond gauge and scatter.

    The scatter is that about straight lines from the reading before to the one after; its median over all
    series is not moved by a few wrong readings.

    Examples
    --------
    >>> falling = [WearReading("pin", float(hours), 10.0 - 2.0 * hours) for hours in range(1, 5)]
    >>> [(one.earlier.wear, one.later.wear) for one in falls(falling)]
    [(8.0, 2.0)]
    """
    rows = sorted((one for one in readings if not one.censored), key=lambda one: (one.series, one.exposure))
    several = [list(series) for _, series in groupby(rows, key=lambda one: one.series)]
    off = [size for series in several for size in _off_line(series)]
    scatter = max(_LEAST_SD, _NORMAL * median(off)) if len(off) >= _TO_TELL else None
    worst = [max(_falls(series, scatter), key=itemgetter(0), default=None) for series in several]
    return [fall for one in worst if one is not None for size, fall in [one] if size > _BEYOND]


def _off_line(series: Sequence[WearReading]) -> Iterator[float]:
    """Give how far each reading is off the line through its neighbours, in their common scatter."""
    for before, one, after in zip(series, series[1:], series[2:], strict=False):
        if after.exposure > before.exposure:
            part = (one.exposure - before.exposure) / (after.exposure - before.exposure)
            line = (1.0 - part) * before.wear + part * after.wear
            yield abs(math.log(one.wear / line)) / math.sqrt(1.0 + part**2 + (1.0 - part) ** 2)


def _falls(series: Sequence[WearReading], scatter: float | None) -> Iterator[tuple[float, WearFall]]:
    """Give each fall below the highest reading before, in standard deviations."""
    highest = series[0]
    for one in series[1:]:
        if one.wear > highest.wear:
            highest = one
        elif one.wear < highest.wear:
            yield _size(one, highest, scatter), WearFall(one, highest)


def _size(later: WearReading, earlier: WearReading, scatter: float | None) -> float:
    gauge = math.hypot(later.error, earlier.error)
    by_gauge = (earlier.wear - later.wear) / gauge if gauge else math.inf
    if scatter is None and gauge:
        return by_gauge
    by_scatter = math.log(earlier.wear / later.wear) / (math.sqrt(2.0) * (scatter or _USUAL_SD))
    return min(by_gauge, by_scatter)
