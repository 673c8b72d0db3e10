"""Chains, materials, wear conditions, regimes, factors of handbooks, from the data files beside this one."""

import csv
import difflib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from wearsim.errors import CaseError, Fault


@cache
def regimes() -> dict[str, tuple[tuple[float, float], ...]]:
    """Return the typical regimes of loading as blocks.

    Only moments are published, mu = sum share x^k with k = 3 (contact), 6 and 9
    (bending) of the relative load x = T/T_max; the curves of figure 2 are lost. The blocks
    are four Gauss nodes of the distribution named in the table, which reproduce its
    moments up to the seventh: those of wear, between the first and the second, lie
    within 1e-4 of it.

    Examples
    --------
    Where all loads are equally probable, the mean of x^3 is 1/4:

    >>> round(sum(share * load**3 for load, share in regimes()["II"]), 6)
    0.25
    """
    found: dict[str, tuple[tuple[float, float], ...]] = {}
    for row in catalogue_rows("regimes"):
        block = float(row["relative_load"]), float(row["share_of_cycles"])
        found[row["regime"]] = (*found.get(row["regime"], ()), block)
    return found


KG_PER_M = 1e-6
"""A mass per length of 1 kg/m in the units inside, t/mm = N s^2/mm^2."""


@dataclass(frozen=True)
class Chain:
    """A roller chain.

    Examples
    --------
    >>> duplex = chains()["08B-2"]
    >>> duplex.strands, duplex.bearing_area, duplex.tensile  # 2 * 50.3, less than 2 * 17.8 kN
    (2, 100.6, 31100.0)
    >>> round(duplex.mass_per_length / KG_PER_M, 6)  # 2 * 0.70 kg/m
    1.4
    """

    designation: str  # as in its standard; empty for a chain of one's own
    pitch: float  # p [mm]
    roller_diameter: float  # d1 [mm]
    inner_width: float  # b1 [mm]
    strands: int = 1  # chains side by side
    tensile: float = 0.0  # minimum tensile strength [N], 0 where it is not known
    note: str = ""  # doubtful numbers of the table and what else there is to know about the row
    # standard and series as in the table, such as `ISO606-B`; empty for a chain of one's own
    series: str = ""
    pin_diameter: float = 0.0  # d2 [mm], 0 where it is not known
    # projected area of pin in bush, all strands together [mm2], 0 where it is not known
    bearing_area: float = 0.0
    # q, all strands together [t/mm = N s^2/mm^2], 0 where it is not known: `KG_PER_M` times the
    # kg/m of the table, so that q v^2 with v in mm/s is a force in N
    mass_per_length: float = 0.0
    transverse_pitch: float = 0.0  # distance of the strands [mm], 0 where it is not known
    doubtful: tuple[str, ...] = ()  # columns of the table whose numbers are in doubt

    @property
    def in_words(self) -> str:
        """Designation, or the pitch of a chain without one."""
        return self.designation or f"of {self.pitch:g} mm pitch"

    @property
    def face_width(self) -> float:
        """Width of the standard tooth under all strands [mm] (ISO 606 rim width b_f1)."""
        wide = self.pitch > 12.7
        single, few, many = (0.95, 0.93, 0.93) if wide else (0.93, 0.91, 0.88)
        share = single if self.strands == 1 else few if self.strands <= 3 else many
        return self.strands * self.inner_width * share


@dataclass(frozen=True)
class Material:
    """An elastic material."""

    name: str  # as in the table
    youngs_modulus: float  # E [MPa]
    poissons_ratio: float  # Poisson's ratio
    density: float  # mass over volume [kg/m3]


@dataclass(frozen=True)
class WearCondition:
    """A typical state of surface and lubricant with its specific wear rates."""

    condition: str  # as in the table
    low: float  # specific wear rate k of a tooth [mm2/N]
    typical: float  # specific wear rate k of a tooth [mm2/N]
    high: float  # specific wear rate k of a tooth [mm2/N]
    source: str  # where the numbers come from
    lubricated: bool  # whether oil or grease reaches teeth and joints, and no dirt
    joint_low: float  # specific wear rate of pin and bush together in that state [mm2/N]
    joint_typical: float  # specific wear rate of pin and bush together in that state [mm2/N]
    joint_high: float  # specific wear rate of pin and bush together in that state [mm2/N]
    # how that of the joints depends on pressure, turning speed and pitch, and where `joint_typical` holds
    joint_pressure_exponent: float  # m of `wearsim.chain.joint_wear.JointLaw`
    joint_speed_exponent: float  # q
    joint_pitch_exponent: float  # r
    joint_reference_pressure: float  # [MPa]
    joint_reference_speed: float  # of the small sprocket [rpm]
    joint_reference_pitch: float  # [mm]
    joint_source: str  # where the numbers of the joints come from
    machine: str  # what it is for: `any` machine, or one whose numbers are told apart


@dataclass(frozen=True)
class Lubricant:
    """A way to lubricate a chain, and how long that lasts."""

    lubricant: str  # as in the table
    wear_condition: str  # row of the table of wear conditions that holds its wear rates
    supply: str  # `applied` now and then, `continuous`, or `none`
    lasts: float | None  # way of the joints on which it keeps its effect [m]; None where nothing is known
    fades: float | None  # way on which it loses it then [m]
    dry_factor: float | None  # coefficient of dry contacts over that of lubricated ones
    contamination_removed: float | None  # part of what dirt adds that an application takes away
    source: str  # where the numbers come from
    # lasts_ends, dry_ends: ends of what is known of both; None where nothing is
    lasts_ends: tuple[float, float] | None = None
    dry_ends: tuple[float, float] | None = None
    is_own: bool = False  # whether a program gave it, not the table


@dataclass(frozen=True)
class Environment:
    """What the surroundings multiply the wear of a lubricated chain by."""

    environment: str  # as in the table
    factor: float  # typical
    low: float
    high: float
    ageing: float  # how many times as fast a lubricant ages there
    source: str  # where the numbers come from


@dataclass(frozen=True)
class WearLawEntry:
    """A row of the registry of wear laws, and of what multiplies their coefficient."""

    name: str  # as in the table
    kind: str  # `law`, of which a case has one, `factor`, of which it may have several, or `told`: no wear
    formula: str  # in plain text; I is the depth of one cycle
    keys: tuple[str, ...]  # keys that it needs, the coefficient of a law first; of laws and factors in [wear]
    valid: str  # range in which it holds
    source: str  # where it comes from
    not_for: str  # what it must not be used for


@cache
def catalogue_rows(table: str) -> tuple[dict[str, str], ...]:
    """Return a table as it stands in its file."""
    path = Path(__file__).with_name(f"{table}.csv")
    with path.open(encoding="utf-8", newline="") as file:
        return tuple(csv.DictReader(file))


@cache
def chain_rows() -> tuple[dict[str, str], ...]:
    """Return the rows of all chains, each single row before those of its several strands.

    ASME B29.1 gives N strands N times the tensile strength of one, to any number of strands, and the
    heavy series of ISO 606 has it so to three: these rows follow from the single one. The B chains of
    ISO 606 of two and three strands carry less than that and stand in the table.
    """
    found: list[dict[str, str]] = []
    for row in catalogue_rows("chains"):
        several = _MOST_BY_RULE.get(row["series"], 1) if row["transverse_pitch_mm"] else 1
        found += [row, *(_several(row, strands) for strands in range(2, several + 1))]
    return tuple(found)


MOST_STRANDS = 6
"""Strands that the ratings of ANSI are tabled to."""

_MOST_BY_RULE = {"ISO606-A/ANSI B29.1": MOST_STRANDS, "ISO606-H": 3}
"""Series whose chains of several strands follow from the single row, and to how many strands."""


def _several(row: dict[str, str], strands: int) -> dict[str, str]:
    """Return the row of so many strands of a single chain."""
    times = {
        column: f"{strands * float(row[column]):.6g}"
        for column in ("bearing_area_mm2", "tensile_kN", "mass_kg_per_m")
    }
    known, _, doubtful = row["trust"].partition("; doubtful: ")
    known = known.replace("typical: mass_kg_per_m", "estimated: mass_kg_per_m")
    about = f"tensile_kN {strands} times the single row as the standard has it, bearing_area_mm2 too; "
    about += f"mass_kg_per_m {strands} times the single row, good to about 10 %"
    return (
        row
        | times
        | {
            "designation": row["designation"].replace("-1", f"-{strands}").replace(")", f"-{strands})"),
            "trust": known + (f"; doubtful: {doubtful}" if doubtful else ""),
            "note": "; ".join(part for part in (row["note"], about) if part),
        }
    )


@cache
def chains() -> dict[str, Chain]:
    """Return the chains by every name they go by.

    Examples
    --------
    >>> chains()["16B"] is chains()["16B-1"]
    True
    >>> chains()["ANSI 40-3"].designation
    '08A-3'
    """
    found: dict[str, Chain] = {}
    for row in chain_rows():
        chain = _chain(row)
        found |= dict.fromkeys(_names(row), chain)
    return found


def _names(row: dict[str, str]) -> list[str]:
    """Return the designation, that without the one strand, and those of ANSI."""
    designation, _, ansi = row["designation"].rstrip(")").partition(" (")
    names = [designation]
    if row["series"].startswith("ISO606"):
        names.append(designation.removesuffix("-1"))
        if ansi:
            names += [ansi, f"{ansi}-1"] if designation.endswith("-1") else [ansi]
    return names


def _chain(row: dict[str, str]) -> Chain:
    designation = row["designation"].partition(" (")[0]
    return Chain(
        designation=designation,
        pitch=float(row["pitch_mm"]),
        roller_diameter=float(row["roller_diameter_mm"]),
        inner_width=float(row["inner_width_mm"]),
        strands=_strands(row["series"], designation),
        tensile=1000.0 * float(row["tensile_kN"]),
        note=_note(row),
        series=row["series"],
        pin_diameter=float(row["pin_diameter_mm"] or 0.0),
        bearing_area=float(row["bearing_area_mm2"] or 0.0),
        mass_per_length=KG_PER_M * float(row["mass_kg_per_m"] or 0.0),
        transverse_pitch=float(row["transverse_pitch_mm"] or 0.0),
        doubtful=tuple(filter(None, row["trust"].partition("doubtful: ")[2].split(", "))),
    )


def _strands(series: str, designation: str) -> int:
    """Return the number that ISO 606 writes behind a designation and GOST 13568 before it."""
    count = designation[0] if series == "GOST13568" else designation.partition("-")[2]
    return int(count) if count.isdigit() else 1


def _note(row: dict[str, str]) -> str:
    """What a case that uses the row must tell: its doubtful numbers first."""
    _, uncertain, columns = row["trust"].partition("doubtful: ")
    return ", ".join(part for part in (uncertain + columns, row["note"]) if part)


@cache
def materials() -> dict[str, Material]:
    """Return the materials by name."""
    return {
        row["name"]: Material(
            row["name"],
            float(row["youngs_modulus_MPa"]),
            float(row["poissons_ratio"]),
            float(row["density_kg_per_m3"]),
        )
        for row in catalogue_rows("materials")
    }


USUAL_CONDITION = "hardened, oiled"
"""Wear condition whose joints a chain has where none is named."""


@cache
def wear_conditions() -> dict[str, WearCondition]:
    """Return the wear conditions by name."""
    return {
        row["condition"]: WearCondition(
            row["condition"],
            float(row["low_mm2_per_N"]),
            float(row["typical_mm2_per_N"]),
            float(row["high_mm2_per_N"]),
            row["source"],
            row["lubricated"] == "yes",
            float(row["joint_low_mm2_per_N"]),
            float(row["joint_typical_mm2_per_N"]),
            float(row["joint_high_mm2_per_N"]),
            float(row["joint_pressure_exponent"]),
            float(row["joint_speed_exponent"]),
            float(row["joint_pitch_exponent"]),
            float(row["joint_reference_pressure_MPa"]),
            float(row["joint_reference_speed_rpm"]),
            float(row["joint_reference_pitch_mm"]),
            row["joint_source"],
            row["machine"],
        )
        for row in catalogue_rows("wear_conditions")
    }


HARDNESSES = ("hardened", "normalised")
"""How hard teeth are, in words: flame or case hardened, about 650 HV; or softer, about 200 HV."""

_OTHER_CONDITIONS = {"unhardened, dry": "normalised, dry"}
"""Names that wear conditions had."""


def condition_name(name: str) -> str:
    """Return the present name of a wear condition."""
    return _OTHER_CONDITIONS.get(name, name)


def condition_of_teeth(lubricant: Lubricant, hardness: str) -> str:
    """Return the wear condition of a lubricant on teeth of a hardness; its own where that says no hardness.

    Examples
    --------
    >>> condition_of_teeth(lubricants()["manual"], "normalised")
    'normalised, greased'
    """
    return lubricant.wear_condition.replace(f"{HARDNESSES[0]}, ", f"{hardness}, ")


def _number(text: str) -> float | None:
    return float(text) if text else None


def _ends(row: Mapping[str, str], low: str, high: str) -> tuple[float, float] | None:
    return (float(row[low]), float(row[high])) if row[low] else None


@cache
def lubricants() -> dict[str, Lubricant]:
    """Return the lubricants by name."""
    return {
        row["lubricant"]: Lubricant(
            row["lubricant"],
            row["wear_condition"],
            row["supply"],
            _number(row["lasts_sliding_m"]),
            _number(row["fades_over_sliding_m"]),
            _number(row["dry_factor"]),
            _number(row["contamination_removed"]),
            row["source"],
            _ends(row, "lasts_low_sliding_m", "lasts_high_sliding_m"),
            _ends(row, "dry_factor_low", "dry_factor_high"),
        )
        for row in catalogue_rows("lubricants")
    }


@cache
def environments() -> dict[str, Environment]:
    """Return the environments by name."""
    return {
        row["environment"]: Environment(
            row["environment"],
            float(row["contamination_factor"]),
            float(row["low"]),
            float(row["high"]),
            float(row["ageing_factor"]),
            row["source"],
        )
        for row in catalogue_rows("environments")
    }


@cache
def wear_laws() -> dict[str, WearLawEntry]:
    """Return the wear laws and the factors of their coefficient by name.

    Examples
    --------
    >>> wear_laws()["power"].keys
    ('coefficient', 'pressure_exponent')
    """
    return {
        row["law"]: WearLawEntry(
            row["law"],
            row["kind"],
            row["formula"],
            tuple(row["keys"].split()),
            row["range"],
            row["source"],
            row["not_for"],
        )
        for row in catalogue_rows("wear_laws")
    }


def table_factor(table: str, **keys: str) -> float:
    """Return the factor of the row whose columns hold given words.

    Examples
    --------
    >>> table_factor("application_factors", driver="smooth", driven="heavy shocks")
    1.8
    """
    left = catalogue_rows(table)
    for column, word in keys.items():
        known = dict.fromkeys(row[column] for row in left)
        if word not in known:
            allowed = f"{', '.join(known)}, is {word!r}{nearest(word, list(known))}"
            place = table.replace("_", " ")
            raise CaseError([Fault(f"{place}: {column} must be one of {allowed}")])
        left = tuple(row for row in left if row[column] == word)
    return float(left[0]["factor"])


def nearest(name: str, names: "list[str] | dict[str, object]") -> str:
    """Return a hint at the names most like a wrong one."""
    upper = {known.upper(): known for known in names}
    close = difflib.get_close_matches(name.upper(), upper, n=3, cutoff=0.6)
    return f"; did you mean {' or '.join(repr(upper[match]) for match in close)}?" if close else ""
