"""Which drive comes first among those that keep to all limits."""

from collections.abc import Iterable, Mapping

from wearsim.study.select.considered_chains import considered_chains
from wearsim.study.select.model import CandidateDrive, Price, judged_drives
from wearsim.study.select.requirements import DriveRequirements


def select(need: DriveRequirements, prices: Mapping[str, Price] | None = None) -> tuple[CandidateDrive, ...]:
    """Return the drives that keep to all limits, the cheapest or lightest one first.

    Parameters
    ----------
    need : DriveRequirements
        What the drive is to do, and what may be used for it.
    prices : mapping, optional
        Prices by designation: only those chains are considered, and the cheapest drive comes first.

    Returns
    -------
    tuple of CandidateDrive
        Every pair of teeth of every chain that passes; empty where none does.

    Examples
    --------
    >>> need = DriveRequirements(power=3.0, speed=120.0, ratio=2.7, hours=15_000.0, series=("A",))
    >>> best = select(need)[0]
    >>> best.chain.designation, best.layout.teeth_1, best.layout.teeth_2
    ('10A-3', 18, 49)
    """
    return ranked(judged_drives(need, considered_chains(need, prices).chains, prices), need.ratio)


def ranked(drives: Iterable[CandidateDrive], ratio: float) -> tuple[CandidateDrive, ...]:
    """Return the drives that pass in their order.

    Drives of one chain on as many teeth of the smaller sprocket are equals: the one of the nearest ratio
    comes first of them, and stands for them.
    """
    equals: dict[tuple[str, int], list[CandidateDrive]] = {}
    for one in drives:
        if not one.refusals:
            teeth = min(one.layout.teeth_1, one.layout.teeth_2)
            equals.setdefault((one.chain.designation, teeth), []).append(one)
    groups = [sorted(group, key=lambda one: (_off(one, ratio), rank(one))) for group in equals.values()]
    return tuple(one for group in sorted(groups, key=lambda group: rank(group[0])) for one in group)


def _off(drive: CandidateDrive, ratio: float) -> float:
    """Return how far a ratio is off, over what is wanted; rounded, so that two of one distance are equal."""
    return round(abs(drive.layout.ratio / ratio - 1.0), 9)


def best_of_each_chain(ranking: Iterable[CandidateDrive]) -> tuple[CandidateDrive, ...]:
    """Return of drives in their order the first one of every chain."""
    found: dict[str, CandidateDrive] = {}
    for one in ranking:
        found.setdefault(one.chain.designation, one)
    return tuple(found.values())


def rank(drive: CandidateDrive) -> tuple[float, int, int, str]:
    """Return what drives are ordered by: cost where prices are given, else mass; teeth; chain."""
    teeth = sorted((drive.layout.teeth_1, drive.layout.teeth_2))
    return drive.mass if drive.cost is None else drive.cost, teeth[0], teeth[1], drive.chain.designation


def refused_by(drives: Iterable[CandidateDrive]) -> dict[str, int]:
    """Return how many drives each limit refuses, the one that refuses most first."""
    counts: dict[str, int] = {}
    for one in drives:
        for refusal in one.refusals:
            counts[refusal.limit] = counts.get(refusal.limit, 0) + 1
    return dict(sorted(counts.items(), key=lambda entry: -entry[1]))


def nearest_miss(drives: Iterable[CandidateDrive]) -> CandidateDrive | None:
    """Return the refused drive that is beyond its limits by the least part; None where there is none."""
    refused = (one for one in drives if one.refusals)
    return min(
        refused, key=lambda one: (max(refusal.used for refusal in one.refusals), rank(one)), default=None
    )
