"""Quantities written as strings; expected values are definitions of the units."""

import math

import pytest

from wearsim.input.units import convert

# inch = 25.4 mm, lbf = 4.4482216152605 N, ft = 0.3048 m, turn = 2 pi rad: by definition.
EXACT = [
    ("1 inch", "mm", 25.4),
    ("0.5 in", "mm", 12.7),
    ("3/4 inch", "mm", 19.05),
    ("5mm", "mm", 5.0),
    ("  5 mm ", "mm", 5.0),
    ("-5 mm", "mm", -5.0),
    ("+.5e1 mm", "mm", 5.0),
    ("20 µm", "mm", 0.02),
    ("1 m/s", "mm/s", 1000.0),
    ("20 N*m", "N*m", 20.0),
    ("20 Nm", "N*m", 20.0),
    ("20 N m", "N*m", 20.0),
    ("20 N·m", "N*m", 20.0),
    ("2 kNm", "N*m", 2000.0),
    ("10 lbf*ft", "N*m", 10 * 4.4482216152605 * 0.3048),
    ("3 kW", "kW", 3.0),
    ("210 GPa", "MPa", 2.1e5),
    ("2.1e5 N/mm2", "MPa", 2.1e5),
    ("2.1e5 N/mm²", "MPa", 2.1e5),
    ("5e-8 mm^3/(N*m)", "mm^2/N", 5e-11),
    ("5e-8 mm3/(N m)", "mm^2/N", 5e-11),
    ("5e-8 mm3/Nm", "mm^2/N", 5e-11),
    ("2 days", "h", 48.0),
    ("100 rpm", "rpm", 100.0),
    ("2 rev/s", "rpm", 120.0),
    ("10 rad/s", "rpm", 10 * 60 / (2 * math.pi)),
]


@pytest.mark.parametrize(("text", "unit", "expected"), EXACT)
def test_string_with_unit(text, unit, expected):
    assert convert(text, unit) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("text", ["1,5 mm", "1 1/4 inch", "20 000 mm", "mm", "nonsense", "nan mm"])
def test_only_one_plain_number_is_read(text):
    with pytest.raises(ValueError, match="must be one number and its unit"):
        convert(text, "mm")


@pytest.mark.parametrize("text", ["5", "-1.5e3", "", " "])
def test_number_without_a_unit_does_not_belong_in_quotes(text):
    with pytest.raises(ValueError, match="a number without quotes"):
        convert(text, "mm")


@pytest.mark.parametrize("text", ["25 degC", "5 N", "20 Nm", "3 kg"])
def test_unit_of_another_kind(text):
    with pytest.raises(ValueError, match="the unit must be convertible to mm"):
        convert(text, "mm")


@pytest.mark.parametrize("text", ["5 furlongz", "5 **2", "5 mm + 2 mm", '1"'])
def test_unknown_unit(text):
    with pytest.raises(ValueError, match="unknown unit"):
        convert(text, "mm")


@pytest.mark.parametrize("text", ["2 Hz", "2 hertz", "100 min^-1", "5 s**-1", "2 kHz"])
def test_speed_that_may_mean_turns_or_radians(text):
    with pytest.raises(ValueError, match="write a speed in rpm or rad/s"):
        convert(text, "rpm")


@pytest.mark.parametrize(
    "unit",
    [
        "N*9**9**9**9",
        "N^9^9^9^9",
        "N**(9**9**9)",
        "min²²²²²²²²²/s²²²²²²²²²*N",
        "N*٩^٩^٩^٩",
        "(((min^9)^9)^9)^9/(((s^9)^9)^9)^9*N",
    ],
)
def test_powers_that_would_take_for_ever(unit):
    with pytest.raises(ValueError, match="unknown unit"):
        convert(f"1 {unit}", "N")


@pytest.mark.parametrize("text", ["1 a" + 300_000 * " " + "b", 200_000 * "1" + " ,", f"1 {200_000 * 'k'}N"])
def test_long_text_is_left_unread(text):
    with pytest.raises(ValueError, match=r"in at most 100 characters, has \d+: shorten it"):
        convert(text, "N")


@pytest.mark.parametrize("sign", ["\u202e", "\u200b", "\x1b", "\x00", "\t"])
def test_unseen_characters_in_a_quantity(sign):
    with pytest.raises(ValueError, match=f"holds U\\+{ord(sign):04X}: remove it"):
        convert(f"1 N{sign}", "N")
