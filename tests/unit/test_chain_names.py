"""Designations as people type them: read, led to dimensions, or refused with what is like them."""

import re

import pytest

from wearsim.catalogue.catalogues import chains
from wearsim.catalogue.chain_names import chain_name, nearest_chain, what_is_meant
from wearsim.drive.load_case import load_case
from wearsim.errors import CaseError


@pytest.mark.parametrize(
    ("typed", "name"),
    [
        ("08B-1", "08B-1"),
        ("08b", "08B"),
        ("08 B", "08B"),
        ("08B1", "08B-1"),
        ("16 - b - 2", "16B-2"),
        ("ANSI40", "ANSI 40"),
        ("ANSI-40", "ANSI 40"),
        ("ansi  40 - 2", "ANSI 40-2"),
        ("#40", "ANSI 40"),
        ("# 40-3", "ANSI 40-3"),
        ("no. 40", "ANSI 40"),
        ("ANSI No 40", "ANSI 40"),
        ("№ 40", "ANSI 40"),
        ("ПР-12.7-18.2", "ПР-12,7-18,2"),
        ("пр 12,7-18.2", "ПР-12,7-18,2"),
        ("2ПР25.4-114", "2ПР-25,4-114"),
        ("16 b-2", "16B-2"),
        ("16B/2", "16B-2"),
        ("DIN 8187 16B-2", "16B-2"),
        ("ISO 606 - 08b", "08B"),
        ("RS40", "ANSI 40"),
        ("rs 80-2", "ANSI 80-2"),
        ("ASA 60", "ANSI 60"),
        ("ANSI 40-1", "ANSI 40-1"),
        ("80-1", "ANSI 80-1"),
        ("40-2", "ANSI 40-2"),
        ("120-4", "ANSI 120-4"),
        ("80h", "80H"),
        ("ANSI 80H", "80H"),
        ("RS80H-2", "80H-2"),
    ],
)
def test_designation_as_people_type_it(typed, name):
    assert chain_name(typed) == name


@pytest.mark.parametrize(
    "typed", ["40", "8B", "08", "08-1", "0851", "ANSI 402", "ANSI 4-1", "ПР-12.71-8.2", "#08B", "#", "-", ""]
)
def test_designation_that_could_be_another(typed):
    """Digits on both sides of a hyphen, and a number without its series, are not guessed at."""
    assert chain_name(typed) is None


def test_every_name_stands_for_itself_whatever_its_case_and_spaces():
    for name in chains():
        assert chain_name(f" {name.lower().replace(' ', '')} ") == chain_name(name) == name


@pytest.mark.parametrize(
    ("typed", "hint"),
    [
        ("40", "'ANSI 40' (pitch 12.7 mm) or '40A' or '40B' (pitch 63.5 mm)?"),
        ("8B", "'08B' (pitch 12.7 mm)?"),
        ("8b-2", "'08B-2' (pitch 12.7 mm)?"),
        ("60", "'ANSI 60' or '60H' (pitch 19.05 mm)?"),
        ("35", "'ANSI 35' (pitch 9.525 mm)?"),
        ("16X", "'16B' or '16A' or '80H' (pitch 25.4 mm)?"),
        ("16X-2", "'16B-2' or '16A-2' or '80H-2' (pitch 25.4 mm)?"),
        ("50X", "'10B' or '10A' (pitch 15.875 mm)?"),
        ("#08B", "'08B' (pitch 12.7 mm)?"),
        ("ПР-25,4-57", "'ПР-25,4-60' (pitch 25.4 mm)?"),
        ("2ПР-25,4-100", "'2ПР-25,4-114' (pitch 25.4 mm)?"),
    ],
)
def test_nearest_chains(typed, hint):
    assert nearest_chain(typed) == f"; did you mean {hint}"


@pytest.mark.parametrize("typed", ["40", 40])
def test_a_number_without_its_series_is_refused(typed):
    with pytest.raises(CaseError, match=r"did you mean 'ANSI 40' \(pitch 12.7 mm\) or '40A'"):
        load_case({"chain": {"designation": typed}})


@pytest.mark.parametrize("typed", ["18B", "9999", "04B", "completely different", ""])
def test_nothing_is_proposed_where_no_chain_has_the_pitch(typed):
    """18/16 inch and 999/8 inch are no pitches of the catalogue; 04B has 6 mm in DIN 8187, not 4/16 inch."""
    assert nearest_chain(typed) == ""
    assert "for another chain give pitch_mm, roller_diameter_mm and inner_width_mm" in what_is_meant(typed)


# Pitch of eighths of an inch by the first digit; roller and width typed from Wemoto's table.
MOTORCYCLE = {
    "415": (4, 7.75, 4.88),
    "420": (4, 7.75, 6.35),
    "428": (4, 8.51, 7.75),
    "520": (5, 10.16, 6.35),
    "525": (5, 10.16, 7.85),
    "530": (5, 10.16, 9.53),
    "532": (5, 11.10, 9.53),
    "630": (6, 11.91, 9.53),
    "632": (6, 12.68, 9.66),
}


def strand_case(chain):
    """Return a case of a strand, which needs no more than the dimensions of a chain."""
    return {
        "format_version": 1,
        "chain": chain,
        "sprocket": {"teeth": 15, "profile": "evolute"},
        "load": {"tension_N": 100, "speed_rpm": 100},
        "wear": {"condition": "hardened, oiled"},
    }


def dimensions(text):
    return {key: float(value) for key, value in re.findall(r"(\w+_mm|strands) = ([\d.]+\d|\d)", text)}


@pytest.mark.parametrize("name", MOTORCYCLE)
@pytest.mark.parametrize("written", ["{}", "{}h", "DID{}VX3", "rk {}"])
def test_motorcycle_chain_is_led_to_its_dimensions(name, written):
    typed, (eighths, roller, width) = written.format(name), MOTORCYCLE[name]
    assert chain_name(typed) is None
    text = what_is_meant(typed)
    assert text.startswith(f": {name} is a motorcycle chain. In [chain] of a case give")
    assert dimensions(text) == {
        "pitch_mm": pytest.approx(eighths * 25.4 / 8.0, rel=1e-12),
        "roller_diameter_mm": roller,
        "inner_width_mm": width,
    }


def test_kart_chain_is_led_to_its_pitch():
    """Only its pitch stands in a work that can be cited."""
    text = what_is_meant("219")
    assert text.startswith(": 219 is a kart chain.")
    assert dimensions(text) == {"pitch_mm": 7.774}
    assert "roller_diameter_mm and inner_width_mm as its maker has" in text


# Pitch, roller and inner width [mm] typed from a maker's table of double-pitch chains (Star Machine): ISO 606
# had rollers of 7.95 mm for 08A until 2004.
DOUBLE = {
    "C2040": (25.4, 7.95, 7.85),
    "A2040": (25.4, 7.95, 7.85),
    "208A": (25.4, 7.95, 7.85),
    "208B": (25.4, 8.51, 7.75),
    "C208B-1": (25.4, 8.51, 7.75),
    "c2050": (31.75, 10.16, 9.4),
    "C2060H": (38.1, 11.91, 12.57),
    "C212AH": (38.1, 11.91, 12.57),
    "C2080": (50.8, 15.88, 15.75),
    "C2100": (63.5, 19.05, 18.9),
    "C2120": (76.2, 22.23, 25.22),
}


@pytest.mark.parametrize("typed", DOUBLE)
def test_double_pitch_chain_is_led_to_its_dimensions(typed):
    assert chain_name(typed) is None
    text, (pitch, roller, width) = what_is_meant(typed), DOUBLE[typed]
    assert "is the double-pitch chain of" in text
    found = dimensions(text)
    assert found["pitch_mm"] == pitch
    assert found["roller_diameter_mm"] == pytest.approx(roller, abs=0.031)
    assert found["inner_width_mm"] == width


@pytest.mark.parametrize("typed", ["C2042", "C208BL", "C2062H"])
def test_large_rollers_of_double_pitch_are_the_makers(typed):
    text = what_is_meant(typed)
    assert "with large rollers" in text
    assert "roller_diameter_mm as its maker has" in text
    assert "roller_diameter_mm" not in dimensions(text)


@pytest.mark.parametrize(
    ("typed", "most", "strands"),
    [("16B-4", "up to 3 strands", 4), ("085-2", "one strand", 2), ("41-3", "one strand", 3)],
)
def test_more_strands_than_the_standard_has(typed, most, strands):
    text = what_is_meant(typed)
    assert f"has {most} there" in text
    assert dimensions(text)["strands"] == strands


@pytest.mark.parametrize(
    ("designation", "strands", "name"),
    [("ANSI 80", 6, "ANSI 80-6"), ("16B-1", 3, "16B-3"), ("ПР-25,4-60", 2, "2ПР-25,4-114")],
)
def test_strands_beside_a_single_chain(designation, strands, name):
    read = load_case(strand_case({"designation": designation, "strands": strands}))
    assert read.inputs["chain"]["designation"] == name
    assert read.drive.chain.strands == strands


@pytest.mark.parametrize(("designation", "most"), [("16B", 3), ("80H", 3), ("ПР-25,4-60", 3)])
def test_more_strands_beside_a_single_chain_than_there_are(designation, most):
    with pytest.raises(CaseError, match=rf"chain.strands.*has up to {most} strands there.*pitch_mm = \d"):
        load_case(strand_case({"designation": designation, "strands": 4}))


def test_four_strands_of_a_chain_of_ones_own():
    """As the message about 16B-4 has it."""
    read = load_case(strand_case(dimensions(what_is_meant("16B-4")) | {"strands": 4}))
    assert read.drive.chain.strands == 4
    assert read.drive.chain.face_width == pytest.approx(4 * 0.93 * 17.02, rel=1e-12)


def test_more_strands_than_the_ratings_know():
    assert what_is_meant("80-7") == ": 16A has up to 6 strands there, and the ratings know up to 6"


def test_dimensions_that_are_offered_make_a_case():
    """Those of 428 in place of the name, as the message says."""
    assert load_case(strand_case(dimensions(what_is_meant("428")))).drive.chain.pitch == 12.7
    with pytest.raises(CaseError, match=r"chain.designation.*428 is a motorcycle chain"):
        load_case(strand_case({"designation": "428"}))
