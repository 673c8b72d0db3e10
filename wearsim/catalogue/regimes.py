"""The published typical regimes of loading, read from the data file beside this one."""

from functools import cache

from wearsim.catalogue.catalogues import rows


@cache
def regimes() -> dict[str, tuple[tuple[float, float], ...]]:
    """Return the typical regimes of loading as blocks.

    Only moments are published, mu = sum share x^k with k = 3 (contact), 6 and 9
    (bending) of the relative load x = T/T_max; the curves of figure 2 are lost. The blocks
    are four Gauss nodes of the distribution named in the table, which reproduce its
    moments up to the seventh: those of wear, between the first and the second, lie
    within 1e-4 of it.

    Returns
    -------
    dict
        From ``0`` (constant), ``I`` (heavy) to ``V`` (very light): pairs of relative load
        and share of the cycles, the heaviest first.

    Examples
    --------
    Where all loads are equally probable, the mean of x^3 is 1/4:

    >>> round(sum(share * load**3 for load, share in regimes()["II"]), 6)
    0.25
    """
    found: dict[str, tuple[tuple[float, float], ...]] = {}
    for row in rows("regimes"):
        block = float(row["relative_load"]), float(row["share_of_cycles"])
        found[row["regime"]] = (*found.get(row["regime"], ()), block)
    return found
