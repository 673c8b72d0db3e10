"""Load spectra of gears and the constant load that fatigues as much.

Source 001, formula (22) and table 2.2: typical regimes and load spectra. An overload, which acts
for less than 5e4 cycles, is no part of the sum; it is judged against the static limits.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from wearsim.catalogue.catalogues import catalogue_rows, regimes
from wearsim.errors import GeometryError

OVERLOAD_CYCLES = 5e4
"""Number of load cycles below which a torque is an overload and does not fatigue."""


@dataclass(frozen=True)
class LoadSpectrum:
    """Torques of a gear pair and how often each acts."""

    name: str  # what it was given as
    # pairs of a torque over the largest long-acting one and its share of all cycles
    blocks: tuple[tuple[float, float], ...]
    # the largest long-acting torque over the torque that the load spectrum is relative to
    torque: float = 1.0
    peak: float = 1.0  # the largest torque at all over the largest long-acting one; 1 without overloads
    peak_cycles: float = 0.0  # for how many cycles overloads act
    # published factors of equivalence by exponent, which go before the sum over the blocks
    published: Mapping[int, float] = field(default_factory=dict)

    def equivalence(self, exponent: float) -> float:
        """Return the cycles of the largest torque that fatigue as much, over all cycles.

        mu = sum (T_i/T)^k N_i/N, strength.md (22).

        Examples
        --------
        >>> LoadSpectrum("two steps", ((1.0, 0.5), (0.5, 0.5))).equivalence(3)
        0.5625
        """
        for known, factor in self.published.items():
            if known == exponent:
                return factor
        return math.fsum(share * torque**exponent for torque, share in self.blocks)


def regime_spectrum(name: str) -> LoadSpectrum:
    """Return a typical regime of loading.

    Its factors for contact and for m = 6 and 9 are those printed in table 2.2; for another
    exponent they follow from the blocks of `wearsim.catalogue.catalogues`.

    Examples
    --------
    >>> regime_spectrum("II").equivalence(6)  # 1/7, as printed
    0.143
    """
    published = {
        int(row["exponent"]): float(row["factor"])
        for row in catalogue_rows("equivalence_factors")
        if row["regime"] == name
    }
    title = "constant" if name == "0" else f"typical regime {name}"
    return LoadSpectrum(title, regimes()[name], published=published)


def load_spectrum(steps: Sequence[tuple[float, float]], total: float) -> LoadSpectrum:
    """Return what a load spectrum comes to, its overloads set apart.

    Overloads are the largest torques as long as they act, together, for less than 5e4 cycles.

    Examples
    --------
    >>> spectrum = load_spectrum([(1.0, 6e6), (0.5, 4e6), (1.6, 2e4)], 1e7)
    >>> spectrum.peak, round(spectrum.equivalence(3), 6)
    (1.6, 0.65)
    """
    ordered = sorted(steps, reverse=True)
    acted = 0.0
    for first, (torque, cycles) in enumerate(ordered):
        if torque > 0.0 and acted + cycles >= OVERLOAD_CYCLES:
            return LoadSpectrum(
                name="load spectrum",
                blocks=tuple((each / torque, count / total) for each, count in ordered[first:]),
                torque=torque,
                peak=ordered[0][0] / torque,
                peak_cycles=acted,
            )
        acted += cycles if torque > 0.0 else 0.0
    raise GeometryError(
        f"load_spectrum: torques above 0 must act for at least {OVERLOAD_CYCLES:g} cycles, but act for "
        f"{acted:.4g}: all of it is overload: raise the life or leave out the load spectrum"
    )
