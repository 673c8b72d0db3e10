"""Chains, materials and wear conditions, read from the data files beside this one."""

import csv
import difflib
from dataclasses import dataclass
from functools import cache
from pathlib import Path


@dataclass(frozen=True)
class Chain:
    """A roller chain.

    Attributes
    ----------
    designation : str
        As in its standard; empty for a chain of one's own.
    pitch, roller_diameter, inner_width : float
        p, d1 and b1 [mm].
    strands : int
        Chains side by side.
    tensile : float
        Minimum tensile strength [N], 0 where it is not known.
    flag : str
        Doubt about a number of the table.
    """

    designation: str
    pitch: float
    roller_diameter: float
    inner_width: float
    strands: int = 1
    tensile: float = 0.0
    flag: str = ""

    @property
    def face_width(self) -> float:
        """Width of the standard tooth under all strands [mm] (ISO 606 rim width b_f1)."""
        wide = self.pitch > 12.7
        single, multiple = (0.95, 0.93) if wide else (0.93, 0.91)
        return self.strands * self.inner_width * (single if self.strands == 1 else multiple)


@dataclass(frozen=True)
class Material:
    """An elastic material.

    Attributes
    ----------
    name : str
        As in the table.
    youngs_modulus : float
        E [MPa].
    poissons_ratio : float
        Poisson's ratio.
    """

    name: str
    youngs_modulus: float
    poissons_ratio: float


@dataclass(frozen=True)
class WearCondition:
    """A typical state of surface and lubricant with its specific wear rate.

    Attributes
    ----------
    condition : str
        As in the table.
    low, typical, high : float
        Specific wear rate k [mm2/N].
    source : str
        Where the numbers come from.
    """

    condition: str
    low: float
    typical: float
    high: float
    source: str


def rows(table: str) -> list[dict[str, str]]:
    """Return a table as it stands in its file.

    Parameters
    ----------
    table : str
        ``chains``, ``materials`` or ``wear_conditions``.

    Returns
    -------
    list of dict
        One dictionary of strings for each row.
    """
    path = Path(__file__).with_name(f"{table}.csv")
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


@cache
def chains() -> dict[str, Chain]:
    """Return the chains by every name they go by.

    Returns
    -------
    dict
        A row ``04C-1 (ANSI 25)`` stands under ``04C-1`` and under ``ANSI 25``.
    """
    found = {}
    for row in rows("chains"):
        designation, _, other = row["designation"].partition(" (")
        first = designation[0]
        strands = int(first) if first.isdigit() and designation[1:3] == "ПР" else 1
        chain = Chain(
            designation=designation,
            pitch=float(row["pitch_mm"]),
            roller_diameter=float(row["roller_diameter_mm"]),
            inner_width=float(row["inner_width_mm"]),
            strands=strands,
            tensile=1000.0 * float(row["tensile_kN"]),
            flag=row["flag"],
        )
        found[designation] = chain
        if other:
            found[other.rstrip(")")] = chain
    return found


@cache
def materials() -> dict[str, Material]:
    """Return the materials by name.

    Returns
    -------
    dict
        Material by name.
    """
    return {
        row["name"]: Material(
            row["name"], float(row["youngs_modulus_MPa"]), float(row["poissons_ratio"])
        )
        for row in rows("materials")
    }


@cache
def wear_conditions() -> dict[str, WearCondition]:
    """Return the wear conditions by name.

    Returns
    -------
    dict
        Condition by name.
    """
    return {
        row["condition"]: WearCondition(
            row["condition"],
            float(row["low_mm2_per_N"]),
            float(row["typical_mm2_per_N"]),
            float(row["high_mm2_per_N"]),
            row["source"],
        )
        for row in rows("wear_conditions")
    }


def nearest(name: str, names: "list[str] | dict[str, object]") -> str:
    """Return a hint at the names most like a wrong one.

    Parameters
    ----------
    name : str
        What was given.
    names : list or dict of str
        What is allowed.

    Returns
    -------
    str
        ``; did you mean ...``, or nothing where no name is close.
    """
    upper = {known.upper(): known for known in names}
    close = difflib.get_close_matches(name.upper(), upper, n=3, cutoff=0.6)
    return f"; did you mean {' or '.join(repr(upper[match]) for match in close)}?" if close else ""
