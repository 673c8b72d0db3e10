"""Chains of the catalogue whose numbers suffice to choose among them."""

from collections.abc import Collection
from dataclasses import dataclass

from wearsim.catalogue.catalogues import Chain, chains
from wearsim.study.select.requirements import SERIES, DriveRequirements

_NEEDED = {
    "pitch_mm": "pitch",
    "roller_diameter_mm": "roller_diameter",
    "inner_width_mm": "inner_width",
    "pin_diameter_mm": "pin_diameter",
    "bearing_area_mm2": "bearing_area",
    "mass_kg_per_m": "mass_per_length",
    "tensile_kN": "tensile",
}
"""Columns of the catalogue that ratings, life and mass follow from, and the fields that hold them."""


@dataclass(frozen=True)
class ConsideredChains:
    """Chains that are chosen among, and those that are left out."""

    chains: tuple[Chain, ...]
    skipped: dict[str, tuple[str, ...]]  # designations by the reason why they are left out


def considered_chains(need: DriveRequirements, priced: Collection[str] | None = None) -> ConsideredChains:
    """Return the chains of the wanted series and strands, without those of doubtful or missing numbers.

    Parameters
    ----------
    need : DriveRequirements
        Series and strands.
    priced : collection of str, optional
        Designations that have a price; others are left out. Without it prices do not matter.

    Examples
    --------
    >>> need = DriveRequirements(3.0, 120.0, 2.7, 15_000.0, strands_max=1, series=("B",))
    >>> found = considered_chains(need)
    >>> [chain.designation for chain in found.chains][-3:]
    ['32B-1', '40B-1', '56B-1']
    >>> found.skipped["doubtful pin_diameter_mm"]
    ('48B-1',)
    """
    names = {SERIES[word] for word in need.series}
    wanted = [
        chain
        for chain in {chain.designation: chain for chain in chains().values()}.values()
        if chain.series in names and need.strands_min <= chain.strands <= need.strands_max
    ]
    kept: list[Chain] = []
    skipped: dict[str, list[str]] = {}
    for chain in wanted:
        reason = _reason(chain, priced)
        if reason:
            skipped.setdefault(reason, []).append(chain.designation)
        else:
            kept.append(chain)
    return ConsideredChains(tuple(kept), {reason: tuple(found) for reason, found in skipped.items()})


def _reason(chain: Chain, priced: Collection[str] | None) -> str:
    """Return why a chain is left out, the least that is known of it first; empty where it is not."""
    missing = [column for column, field in _NEEDED.items() if not getattr(chain, field)]
    if missing:
        return f"no {', '.join(missing)} in the catalogue"
    doubtful = [column for column in _NEEDED if column in chain.doubtful]
    if doubtful:
        return f"doubtful {', '.join(doubtful)}"
    return "no price" if priced is not None and chain.designation not in priced else ""
