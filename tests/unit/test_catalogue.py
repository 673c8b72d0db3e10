"""Chains, materials and wear conditions against the standard's numbers."""

import math
import re

import pytest

from wearsim.catalogue.catalogues import (
    KG_PER_M,
    catalogue_rows,
    chain_rows,
    chains,
    materials,
    nearest,
    wear_conditions,
)
from wearsim.drive.load_case import load_case

# p, d1, b1 [mm] and tensile strength [kN] typed from ISO 606 (ANSI B29.1 for the A series).
ISO_606 = {
    "05B-1": (8.0, 5.0, 3.0, 4.4),
    "06B-1": (9.525, 6.35, 5.72, 8.9),
    "08B-1": (12.7, 8.51, 7.75, 17.8),
    "10B-1": (15.875, 10.16, 9.65, 22.2),
    "12B-1": (19.05, 12.07, 11.68, 28.9),
    "16B-1": (25.4, 15.88, 17.02, 60.0),
    "20B-1": (31.75, 19.05, 19.56, 95.0),
    "24B-1": (38.1, 25.4, 25.4, 160.0),
    "32B-1": (50.8, 29.21, 30.99, 250.0),
    "ANSI 25": (6.35, 3.3, 3.1, 3.5),
    "08A-1": (12.7, 7.92, 7.85, 13.9),
    "ANSI 50": (15.875, 10.16, 9.4, 21.8),
    "16A-1": (25.4, 15.88, 15.75, 55.6),
    "ANSI 240": (76.2, 47.63, 47.35, 500.0),
    "80H-1": (25.4, 15.88, 15.75, 55.6),
}


@pytest.mark.parametrize("designation", ISO_606)
def test_chain_of_the_standard(designation):
    chain = chains()[designation]
    pitch, roller, width, tensile = ISO_606[designation]
    assert (chain.pitch, chain.roller_diameter, chain.inner_width) == (pitch, roller, width)
    assert chain.tensile == pytest.approx(1000.0 * tensile)


def test_gost_names_with_strands():
    """GOST 13568: the digit before ПР counts the strands."""
    assert chains()["ПР-25,4-60"].strands == 1
    assert chains()["2ПР-25,4-114"].strands == 2
    assert chains()["3ПР-25,4-171"].strands == 3


@pytest.mark.parametrize(
    ("designation", "factor"), [("08B-1", 0.93), ("06B-1", 0.93), ("10B-1", 0.95), ("16B-1", 0.95)]
)
def test_face_width_of_a_single_chain(designation, factor):
    """ISO 606 rim width b_f1: 0.93 b1 up to p = 12.7 mm, 0.95 b1 above."""
    chain = chains()[designation]
    assert chain.face_width == pytest.approx(factor * ISO_606[designation][2], rel=1e-12)


@pytest.mark.parametrize(
    ("designation", "width"), [("2ПР-12,7-31,8", 2 * 0.91 * 7.75), ("3ПР-25,4-171", 3 * 0.93 * 15.88)]
)
def test_face_width_of_several_strands(designation, width):
    """ISO 606 for multiple chains: 0.91 b1 up to p = 12.7 mm, 0.93 b1 above, a strand each."""
    assert chains()[designation].face_width == pytest.approx(width, rel=1e-12)


@pytest.mark.parametrize("table", ["chains", "materials", "wear_conditions"])
def test_every_row_has_a_source(table):
    assert catalogue_rows(table)
    assert all(row["source"].strip() for row in catalogue_rows(table))


CITED = {
    "ISO 606:2015, 3.3 and 3.4.2",
    "ASME B29.1-2011",
    "DIN 8187-1:1996",
    "GOST 13568-97, clause 3",
    "Donghua catalogue 2020 (tensile_kN)",
    "Donghua catalogue 2020 (mass_kg_per_m)",
    "Donghua catalogue 2020 (tensile_kN, mass_kg_per_m)",
    "Donghua catalogue 2020 (tensile_kN, transverse_pitch_mm, mass_kg_per_m)",
    "American Metric catalogue (mass_kg_per_m)",
    "Galaxy Chain catalogue (pin_diameter_mm)",
    "Galaxy Chain catalogue (tensile_kN)",
    "Galaxy Chain catalogue (pin_diameter_mm, tensile_kN)",
    "Galaxy Chain catalogue (pin_diameter_mm, transverse_pitch_mm)",
    "simplexchain.top, 56B-1 (roller_diameter_mm, inner_width_mm, pin_diameter_mm)",
    "Standard Roller Chain Dimensions, weights in lb/ft (mass_kg_per_m)",
}


def test_every_chain_comes_from_a_work_that_can_be_cited():
    """Standards and makers' tables; no code and no page that only its finder knows."""
    for row in catalogue_rows("chains"):
        assert set(row["source"].split("; ")) <= CITED, row
        text = " ".join(row.values())
        assert not re.search(r"unsure|scribd|\b[KF]:|\bK\b|\(F\)|memory", text, re.IGNORECASE), row


def test_trust_names_columns_and_doubt_has_its_reason():
    levels = ["standard", "derived", "typical", "estimated", "doubtful"]
    for row in catalogue_rows("chains"):
        first, *parts = row["trust"].split("; ")
        named = [part.partition(": ")[0] for part in parts]
        assert [first, *named] == [level for level in levels if level in (first, *named)], row
        columns = [name for part in parts for name in part.partition(": ")[2].split(", ")]
        assert len(set(columns)) == len(columns)
        assert all(row[name] for name in columns), row
        assert row["note"] or not {"estimated", "doubtful"} & set(named), row


def test_case_tells_of_the_doubtful_numbers_of_its_chain():
    """DIN 8187 and GOST 13568 disagree about 082; only one table has the transverse pitch of 60H."""
    tables = {
        "format_version": 1,
        "chain": {"designation": "082"},
        "sprocket": {"teeth": 20, "profile": "evolute"},
        "load": {"tension_N": 100, "speed_rpm": 100},
        "wear": {"condition": "hardened, oiled"},
    }
    told = "catalogue note on chain {}: doubtful: "
    assert any(
        text.startswith(told.format("082") + "tensile_kN, 9.8 in DIN 8187-1, 10 in GOST")
        for text in load_case(tables).assumptions
    )
    tables["chain"]["designation"] = "60H"
    (note,) = (text for text in load_case(tables).assumptions if "catalogue note" in text)
    assert note.startswith(told.format("60H-1") + "transverse_pitch_mm, found in one table only; ")
    assert note.endswith("mass_kg_per_m that of 12A-1 with thicker plates, good to about 5 %")
    tables["chain"]["designation"] = "16B"
    assert not any("catalogue note" in text for text in load_case(tables).assumptions)


def test_no_name_stands_twice():
    names = [row["designation"] for row in catalogue_rows("chains")]
    assert len(set(names)) == len(names) == 103


# d2 [mm], bearing area [mm2], q [kg/m], transverse pitch [mm] typed from catalogues.
JOINTS = {
    "08B-1": (4.45, 50.3, 0.70, 13.92),
    "16B-1": (8.28, 210.7, 2.68, 31.88),
    "08A-1": (3.98, 44.5, 0.60, 14.38),
    "ANSI 140": (12.71, 472.6, 7.5, 48.87),
    "ПР-25,4-60": (7.92, 179.7, 2.6, 29.29),
    "081": (3.66, 21.2, 0.28, 0.0),
    "60H-1": (5.96, 115.8, 1.85, 26.11),
    "2ПР-25,4-114": (7.92, 359.4, 5.0, 29.29),
}


@pytest.mark.parametrize("designation", JOINTS)
def test_joint_and_mass(designation):
    """0 stands for what the table does not know."""
    chain, (pin, area, mass, transverse) = chains()[designation], JOINTS[designation]
    assert (chain.pin_diameter, chain.bearing_area, chain.transverse_pitch) == (pin, area, transverse)
    assert chain.mass_per_length / KG_PER_M == pytest.approx(mass, rel=1e-12)


# kg/m typed from GOST 13568-97 and from makers' tables: Donghua, American Metric, lb/ft of ANSI chains.
MASSES = {
    "ПР-8-4,6": 0.2,
    "ПР-9,525-9,1": 0.45,
    "ПР-12,7-10-1": 0.3,
    "ПР-12,7-9": 0.35,
    "ПР-12,7-18,2-1": 0.65,
    "ПР-15,875-23-1": 0.8,
    "ПР-63,5-354": 16.0,
    "2ПР-12,7-31,8": 1.4,
    "2ПР-15,875-45,4": 1.9,
    "2ПР-19,05-64": 2.9,
    "2ПР-31,75-177": 7.3,
    "2ПР-38,1-254": 11.0,
    "2ПР-44,45-344,8": 14.4,
    "2ПР-50,8-453,6": 19.1,
    "56B-1": 35.78,
    "64B-1": 46.0,
    "72B-1": 60.8,
    "36A-1": 13.45,
    "40A-1": 16.15,
    "48A-1": 23.2,
    "082": 0.26,
    "083": 0.42,
    "ANSI 25": 0.084 * 0.45359237 / 0.3048,
    "ANSI 35": 0.21 * 0.45359237 / 0.3048,
    "ANSI 41": 0.28 * 0.45359237 / 0.3048,
}


@pytest.mark.parametrize("name", MASSES)
def test_mass_of_the_standard_or_a_maker(name):
    """To the digits that the table keeps."""
    assert chains()[name].mass_per_length / KG_PER_M == pytest.approx(MASSES[name], rel=1e-2)


def test_every_chain_has_a_mass():
    assert all(float(row["mass_kg_per_m"]) > 0.0 for row in catalogue_rows("chains"))


# One, two and three strands [kg/m] of Donghua (05B to 72B, no. 200 and 240) and of the ASA chains.
STRANDS = {
    "05B": (0.20, 0.33, 0.48),
    "40B": (16.35, 32.00, 48.10),
    "48B": (25.00, 50.00, 75.00),
    "56B": (35.78, 71.48, 107.18),
    "64B": (46.00, 91.00, 136.00),
    "72B": (60.80, 120.40, 180.00),
    "40A": (16.15, 32.24, 49.03),
    "48A": (23.20, 45.23, 71.60),
    "16A": (2.60, 5.15, 7.89),
    "24A": (5.62, 11.70, 17.53),
    "28A": (7.50, 15.14, 22.20),
    "32A": (10.10, 20.14, 30.02),
}


def test_third_strand_adds_what_the_second_adds():
    """The rule behind the masses of 3ПР, 2 q_2 - q_1: within 6.1 %, ten of twelve within 3 %."""
    off = [abs((2 * two - one) / three - 1.0) for one, two, three in STRANDS.values()]
    assert max(off) < 0.061
    assert sum(part < 0.03 for part in off) == 10


def test_three_rows_of_gost_by_that_rule():
    for name, row in {row["designation"]: row for row in catalogue_rows("chains")}.items():
        if not name.startswith("3ПР"):
            continue
        pitch, strength = name.removeprefix("3ПР-").rsplit("-", 1)
        one, two = (
            next(
                other
                for other in catalogue_rows("chains")
                if other["designation"].startswith(f"{prefix}ПР-{pitch}-")
                and other["inner_width_mm"] == row["inner_width_mm"]
            )
            for prefix in ("", "2")
        )
        expected = 2.0 * float(two["mass_kg_per_m"]) - float(one["mass_kg_per_m"])
        assert float(row["mass_kg_per_m"]) == pytest.approx(expected, rel=1e-12), strength


# Thickness of the plates of the standard and of the heavy series [inch], ASME B29.1.
PLATES = {
    "60H": ("12A", 0.094, 0.125),
    "80H": ("16A", 0.125, 0.156),
    "100H": ("20A", 0.156, 0.187),
    "120H": ("24A", 0.187, 0.219),
    "140H": ("28A", 0.219, 0.250),
    "160H": ("32A", 0.250, 0.281),
    "180H": ("36A", 0.281, 0.312),
    "200H": ("40A", 0.312, 0.375),
    "240H": ("48A", 0.375, 0.500),
}


def obrounds(pitch, *heights):
    """Area of plates with round ends, 0.95 p and 0.82 p high where nothing is said [mm2]."""
    heights = heights or (0.95 * pitch, 0.82 * pitch)
    return sum(pitch * height + math.pi / 4 * height**2 for height in heights)


@pytest.mark.parametrize("name", PLATES)
def test_mass_of_a_heavy_chain_is_that_of_its_plates_more(name):
    """A link of each kind has two plates: over two pitches one more area each, times 7.85 g/cm3."""
    standard, thin, thick = PLATES[name]
    chain = chains()[name]
    more = 7.85e-6 * obrounds(chain.pitch) * 25.4 * (thick - thin) / chain.pitch * 1e3
    expected = chains()[standard].mass_per_length / KG_PER_M + more
    assert chain.mass_per_length / KG_PER_M == pytest.approx(expected, rel=5e-3)


def test_estimated_masses_against_what_is_published():
    """80H by a maker: 3.10 kg/m. The estimate leaves out holes and waists, which nearly cancel."""
    assert chains()["80H"].mass_per_length / KG_PER_M == pytest.approx(3.10, rel=0.05)


@pytest.mark.parametrize("name", PLATES)
def test_bearing_area_of_a_heavy_chain(name):
    """The bush is longer by both inner plates: d2 times twice their thickness more."""
    standard, thin, thick = PLATES[name]
    more = chains()[name].pin_diameter * 2.0 * 25.4 * (thick - thin)
    assert chains()[name].bearing_area == pytest.approx(chains()[standard].bearing_area + more, rel=6e-3)


def parts_volume(row):
    """Plates, rollers and pins per length of a single chain from the columns of its row [mm2]."""
    pitch, roller, width, pin = (
        float(row[column])
        for column in ("pitch_mm", "roller_diameter_mm", "inner_width_mm", "pin_diameter_mm")
    )
    bush = float(row["bearing_area_mm2"]) / pin
    plate = 0.5 * (bush - width)
    solid = plate * obrounds(pitch, 0.9 * pitch, 0.9 * pitch)
    solid += math.pi / 4 * ((roller**2 - pin**2) * width + pin**2 * (bush + 3.0 * plate))
    return solid / pitch


def test_masses_follow_the_volume_of_the_parts():
    """Each by the others: what they weigh over the volume of plates, rollers and pins.

    No misprint of a digit passes: three in four within 10 %, all within 35 %. ПР-19,05-31,8 of
    GOST is the heaviest for its size, the bicycle chains 081 to 083 are the lightest.
    """
    single = [
        row for row in catalogue_rows("chains") if chains()[row["designation"].split(" (")[0]].strands == 1
    ]
    ratio = {row["designation"]: float(row["mass_kg_per_m"]) / parts_volume(row) for row in single}
    off = []
    for name, own in ratio.items():
        others = [math.log(value) for other, value in ratio.items() if other != name]
        off.append(abs(own / math.exp(sum(others) / len(others)) - 1.0))
    assert max(off) < 0.35
    assert sum(part < 0.10 for part in off) >= 0.75 * len(off)


def test_mass_is_consistent_with_newton_millimetre_second():
    """q v^2 of 1 kg/m at 1 m/s is 1 N."""
    speed = 1000.0
    assert KG_PER_M * speed**2 == pytest.approx(1.0, rel=1e-12)


@pytest.mark.parametrize(
    ("alias", "designation"),
    [("08B", "08B-1"), ("08A", "08A-1"), ("ANSI 40", "08A-1"), ("085", "085-1"), ("60H", "60H-1")],
)
def test_aliases(alias, designation):
    assert chains()[alias] is chains()[designation]
    assert chains()[alias].designation == designation


# Minimum tensile strength of two and three rows [kN], typed from makers' tables: Galaxy Chain, duplex and
# triplex British standard (08B to 32B), and Donghua 2020 (05B, 40B to 72B).
MULTIPLE = {
    "05B": (7.8, 11.1),
    "08B": (31.10, 44.50),
    "10B": (44.54, 66.81),
    "12B": (57.88, 86.82),
    "16B": (106.14, 160.10),
    "20B": (170.05, 250.16),
    "24B": (280.07, 425.02),
    "28B": (359.90, 529.95),
    "32B": (449.92, 669.79),
    "40B": (630.0, 950.0),
    "48B": (1000.0, 1500.0),
    "56B": (1600.0, 2240.0),
    "64B": (2000.0, 3000.0),
    "72B": (2500.0, 3750.0),
}


@pytest.mark.parametrize("name", MULTIPLE)
def test_b_chains_of_two_and_three_rows_have_their_own_strength(name):
    """Makers write the numbers of ISO 606 over from pounds: 0.2 % apart at most."""
    for strands, tensile in zip((2, 3), MULTIPLE[name], strict=True):
        chain = chains()[f"{name}-{strands}"]
        assert chain.strands == strands
        assert chain.tensile == pytest.approx(1000.0 * tensile, rel=2e-3)
        assert chain.tensile <= 1.003 * strands * chains()[name].tensile
        assert chain.bearing_area == pytest.approx(strands * chains()[name].bearing_area, rel=1e-9)


def test_strength_of_06b_rows():
    """8.9, 16.9 and 24.9 kN in ISO 606."""
    assert [chains()[f"06B-{strands}"].tensile for strands in (1, 2, 3)] == [8900.0, 16_900.0, 24_900.0]


# Two and three rows [kg/m] of Galaxy Chain.
GALAXY_MASSES = {
    "08B": (1.300, 1.920),
    "10B": (1.856, 2.785),
    "12B": (2.487, 3.731),
    "16B": (5.213, 7.819),
    "20B": (7.605, 11.407),
    "24B": (14.278, 21.417),
    "28B": (17.909, 26.864),
    "32B": (19.391, 29.086),
}


@pytest.mark.parametrize("name", GALAXY_MASSES)
def test_estimated_mass_of_b_rows_against_a_maker(name):
    """As many times the single row: good to about 10 %, as the note says."""
    for strands, mass in zip((2, 3), GALAXY_MASSES[name], strict=True):
        chain = chains()[f"{name}-{strands}"]
        assert chain.mass_per_length / KG_PER_M == pytest.approx(mass, rel=0.1)
        assert "good to about 10 %" in chain.note


@pytest.mark.parametrize(
    ("name", "strands", "area", "tensile", "mass"),
    [
        ("16A-2", 2, 358.8, 111_200.0, 5.2),
        ("ANSI 40-2", 2, 89.0, 27_800.0, 1.2),
        ("ANSI 140-3", 3, 1417.8, 510_000.0, 22.5),
        ("ANSI 80-4", 4, 717.6, 222_400.0, 10.4),
        ("08A-6", 6, 267.0, 83_400.0, 3.6),
        ("80H-3", 3, 578.4, 166_800.0, 9.21),
    ],
)
def test_several_strands_by_the_rule_of_the_standard(name, strands, area, tensile, mass):
    """Donghua has ANSI 180 with 280.2, 560.5 and 840.7 kN: so many times one row."""
    chain = chains()[name]
    assert chain.strands == strands
    assert chain.bearing_area == pytest.approx(area, rel=1e-12)
    assert chain.tensile == pytest.approx(tensile, rel=1e-12)
    assert chain.mass_per_length / KG_PER_M == pytest.approx(mass, rel=1e-12)
    assert f"tensile_kN {strands} times the single row as the standard has it" in chain.note


def test_rule_for_the_mass_against_makers():
    """`STRANDS` holds 36A too: two and three rows of Donghua weigh 29.22 and 38.22 kg/m."""
    rows = {"36A": (13.45, 29.22, 38.22)} | {name: row for name, row in STRANDS.items() if name[2] == "A"}
    for name, (_, two, three) in rows.items():
        assert chains()[f"{name}-2"].mass_per_length / KG_PER_M == pytest.approx(two, rel=0.1)
        assert chains()[f"{name}-3"].mass_per_length / KG_PER_M == pytest.approx(three, rel=0.1)


@pytest.mark.parametrize("name", [name for name in STRANDS if name[2] == "B"])
def test_mass_of_b_rows_that_a_maker_has(name):
    for strands, mass in zip((2, 3), STRANDS[name][1:], strict=True):
        assert chains()[f"{name}-{strands}"].mass_per_length / KG_PER_M == pytest.approx(mass, rel=1e-12)


def test_every_chain_of_several_strands_has_a_row_with_its_trust():
    rows = {row["designation"].partition(" (")[0]: row for row in chain_rows()}
    assert set(rows) == {chain.designation for chain in chains().values()}
    assert rows["16A-4"]["trust"] == "standard; derived: bearing_area_mm2; estimated: mass_kg_per_m"
    assert rows["80H-2"]["trust"].endswith("; doubtful: transverse_pitch_mm")


def test_width_of_the_teeth_of_more_than_three_strands():
    """ISO 606: 0.88 b1 of four and more strands up to p = 12.7 mm, 0.93 b1 above."""
    assert chains()["08A-4"].face_width == pytest.approx(4 * 0.88 * 7.85, rel=1e-12)
    assert chains()["16A-4"].face_width == pytest.approx(4 * 0.93 * 15.75, rel=1e-12)


def test_note_of_the_single_row_is_kept():
    assert chains()["06C-2"].note.startswith("mass_kg_per_m from 0.21 lb/ft")


@pytest.mark.parametrize(
    "name", ["081-2", "085-2", "ANSI 41-2", "ПР-12,7-18,2-2", "2ПР-25,4-114-2", "16B-4", "80H-4", "16A-7"]
)
def test_no_strands_without_a_transverse_pitch_or_a_row_of_their_own(name):
    assert name not in chains()


def test_gost_suffix_is_no_count_of_strands():
    """The last digit of ПР-12,7-10-1 tells designs apart."""
    assert "ПР-12,7-10" not in chains()
    assert chains()["ПР-12,7-10-1"].strands == 1


def test_bearing_area_is_pin_diameter_times_inner_link_width():
    """b2 of ISO 606 [mm]; the area is d2 b2 to rounding."""
    for name, width in {"08B": 11.30, "10B": 13.28, "12B": 15.62, "16B": 25.45, "16A": 22.60}.items():
        chain = chains()[name]
        assert chain.bearing_area == pytest.approx(chain.pin_diameter * width, rel=2e-3)


def test_chain_numbers_are_possible():
    for name, chain in chains().items():
        assert 0.0 < chain.roller_diameter < chain.pitch, name
        assert chain.inner_width > 0.0, name
        assert chain.tensile > 0.0, name


def test_notes_are_kept():
    assert "4.4 in ISO 606, 5.0 in DIN 8187" in chains()["05B-1"].note
    assert chains()["10B-1"].note == ""


def test_materials():
    assert (materials()["steel"].youngs_modulus, materials()["steel"].poissons_ratio) == (2.1e5, 0.3)
    assert all(-1.0 < material.poissons_ratio < 0.5 for material in materials().values())


def test_wear_conditions_are_bands_around_a_typical_value():
    assert wear_conditions()["hardened, oiled"].typical == 5e-11
    for condition in wear_conditions().values():
        assert 0.0 < condition.low < condition.typical < condition.high
        assert 0.0 < condition.joint_low < condition.joint_typical < condition.joint_high
        assert condition.joint_source.strip()


def test_lubricated_joints_wear_less_than_dry_and_contaminated_ones():
    """One rate tells the two states apart: 1e-9 mm2/N, the end of the boundary-lubricated range."""
    for condition in (row for row in wear_conditions().values() if row.machine == "any"):
        greatest, least = condition.joint_high, condition.joint_low
        assert greatest <= 1e-9 if condition.lubricated else least >= 1e-9


def test_dry_joints_by_hand():
    """8.8 times 1.2e-10, the rig's 4.4e-5 mm3/(N m), and the geometric mean of both."""
    dry = wear_conditions()["hardened, dry"]
    assert dry.joint_low == pytest.approx(0.903 / 0.103 * 1.2e-10, rel=0.05)
    assert dry.joint_high == pytest.approx(4.4e-5 * 1e-3)
    assert dry.joint_typical == pytest.approx((dry.joint_low * dry.joint_high) ** 0.5, rel=0.01)


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("16b", "; did you mean '16B'"),
        ("ansi 50", "; did you mean 'ANSI 50'"),
        ("ansi 50-2", "; did you mean 'ANSI 50-2'"),
        ("16B1", "; did you mean '16B-1'"),
        ("completely different", ""),
        ("", ""),
    ],
)
def test_nearest_names(name, hint):
    assert nearest(name, dict(chains())).startswith(hint)
    assert bool(nearest(name, dict(chains()))) is bool(hint)


def test_case_says_how_it_reads_a_designation():
    tables = {
        "format_version": 1,
        "chain": {"designation": "16b"},
        "sprocket": {"teeth": 20, "profile": "evolute"},
        "load": {"power_kW": 3, "speed_rpm": 100},
        "wear": {"condition": "hardened, oiled"},
    }
    read, text = load_case(tables), "chain '16b' is read as 16B of the catalogue"
    assert read.drive.chain.designation == "16B-1"
    assert read.inputs["chain"]["designation"] == "16B"
    assert text in read.assumptions
    given = load_case(read.inputs)
    assert text not in given.assumptions
    assert given.drive.chain == read.drive.chain
