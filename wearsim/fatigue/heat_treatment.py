"""Heat treatments of gear teeth with the limits that come with them.

Source 001, tables 2.2 and 2.3 and items 5, 7 and 9; the numbers stand in the data file.
"""

import math
from dataclasses import dataclass
from functools import cache

from wearsim.catalogue.catalogues import catalogue_rows

HB_PER_HRC = 10.0
"""Of the source: 1 HRC is about 10 HB."""


@dataclass(frozen=True)
class Treatment:
    """A heat treatment with what the source gives for it (table 2.3, items 5, 7 and 9)."""

    name: str  # as in the input
    scale: str  # `HB` or `HRC`, of the hardness in its formulas
    hardness_range: tuple[float, float]  # for which they are given
    # slope and offset of sigma_Hlim over the hardness [MPa]; nan where the source lost them
    contact_line: tuple[float, float]
    # slope and offset of sigma_Flim [MPa]; over the core's hardness where it is nitrided
    bending_line: tuple[float, float]
    contact_safety: float  # S_H
    bending_exponent: float  # m of the curve of bending fatigue
    # contact_factor, bending_factor: greatest K_HL and K_FL
    contact_factor: float
    bending_factor: float
    overload_of: str  # `yield` or `hardness`: what the greatest contact stress is a multiple of
    # overload_slope, overload_cap: that multiple, and the most that it may come to [MPa]
    overload_slope: float
    overload_cap: float

    def contact_limit(self, hardness: float) -> float:
        """Return the endurance limit in contact, sigma_Hlim of table 2.3.

        Examples
        --------
        >>> treatments()["quenched_and_tempered"].contact_limit(285.5)
        641.0
        """
        slope, offset = self.contact_line
        return slope * hardness + offset

    def own_hardness(self, brinell: float) -> float:
        """Return a hardness in the treatment's scale."""
        return brinell if self.scale == "HB" else brinell / HB_PER_HRC

    def outside(self, hardness: float) -> str:
        """Return what is wrong with a hardness for which the formulas are not given.

        Examples
        --------
        >>> treatments()["quenched_and_tempered"].outside(400.0)
        'table 2.3 holds for at most 350 HB where it is quenched_and_tempered, it is 400'
        """
        least, greatest = self.hardness_range
        if least <= hardness <= greatest:
            return ""
        span = f"{least:g} to {greatest:g}" if least > 0.0 else f"at most {greatest:g}"
        return f"table 2.3 holds for {span} {self.scale} where it is {self.name}, it is {hardness:g}"

    def bending_limit(self, hardness: float) -> float:
        """Return the endurance limit in bending, sigma_Flim of table 2.3."""
        slope, offset = self.bending_line
        return slope * hardness + offset

    def greatest_contact(self, hardness: float, yield_strength: float) -> float:
        """Return the greatest contact stress allowed in an overload, strength.md (9).

        2.8 sigma_T of homogeneous teeth, 44 HRC of those hardened along the contour or
        carburised, 35 HRC of nitrided ones and at most 2000 MPa.
        """
        base = yield_strength if self.overload_of == "yield" else hardness
        greatest = self.overload_slope * base
        return greatest if math.isnan(greatest) else min(greatest, self.overload_cap)


def in_brinell(hardness: float, scale: str) -> float:
    """Return a hardness in HB, 10 to 1 HRC."""
    return hardness if scale == "HB" else HB_PER_HRC * hardness


@cache
def treatments() -> dict[str, Treatment]:
    """Return the heat treatments of table 2.3 by name."""

    def _number(text: str, missing: float) -> float:
        return float(text) if text else missing

    return {
        row["treatment"]: Treatment(
            name=row["treatment"],
            scale=row["scale"],
            hardness_range=(_number(row["least_hardness"], 0.0), float(row["greatest_hardness"])),
            contact_line=(_number(row["contact_slope"], math.nan), _number(row["contact_offset"], math.nan)),
            bending_line=(float(row["bending_slope"]), float(row["bending_offset"])),
            contact_safety=float(row["contact_safety"]),
            bending_exponent=float(row["bending_exponent"]),
            contact_factor=float(row["contact_factor"]),
            bending_factor=float(row["bending_factor"]),
            overload_of=row["overload_of"],
            overload_slope=float(row["overload_slope"]),
            overload_cap=_number(row["overload_cap"], math.inf),
        )
        for row in catalogue_rows("heat_treatments")
    }
