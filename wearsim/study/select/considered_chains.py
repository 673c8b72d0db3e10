"""Chains of the catalogue whose numbers suffice to choose among them."""

from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace

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
    ['10B-1', '12B-1', '16B-1']
    >>> found.skipped["doubtful pin_diameter_mm"][:2]
    ('20B-1', '24B-1')
    """
    names = {SERIES[word] for word in need.series}
    wanted = [
        chain
        for chain in {chain.designation: chain for chain in chains().values()}.values()
        if chain.series in names and need.strands_min <= chain.strands <= need.strands_max
    ]
    kept: list[Chain] = []
    skipped: dict[str, list[str]] = {}
    for chain in map(with_mass, wanted):
        reason = _reason(chain, priced)
        if reason:
            skipped.setdefault(reason, []).append(chain.designation)
        else:
            kept.append(chain)
    return ConsideredChains(tuple(kept), {reason: tuple(found) for reason, found in skipped.items()})


def with_mass(chain: Chain) -> Chain:
    """Return a chain of several strands whose mass the table lacks with that of so many single ones.

    Examples
    --------
    >>> from wearsim.catalogue.catalogues import KG_PER_M
    >>> round(with_mass(chains()["2ПР-25,4-114"]).mass_per_length / KG_PER_M, 9)  # 2 * 2.6 kg/m
    5.2
    """
    if chain.mass_per_length or chain.strands == 1:
        return chain
    for single in _singles(chain):
        return replace(chain, mass_per_length=chain.strands * single.mass_per_length)
    return chain


def _singles(chain: Chain) -> Iterable[Chain]:
    """Give the single chains of the same series with the same links whose mass is known."""
    size = (chain.series, chain.pitch, chain.roller_diameter, chain.inner_width)
    for single in chains().values():
        if single.strands == 1 and single.mass_per_length and size == _size(single):
            yield single


def _size(chain: Chain) -> tuple[str, float, float, float]:
    return chain.series, chain.pitch, chain.roller_diameter, chain.inner_width


def _reason(chain: Chain, priced: Collection[str] | None) -> str:
    """Return why a chain is left out, the least that is known of it first; empty where it is not."""
    missing = [column for column, field in _NEEDED.items() if not getattr(chain, field)]
    if missing:
        return f"no {', '.join(missing)} in the catalogue"
    doubtful = [column for column in _NEEDED if column in chain.doubtful]
    if doubtful:
        return f"doubtful {', '.join(doubtful)}"
    return "no price" if priced is not None and chain.designation not in priced else ""
