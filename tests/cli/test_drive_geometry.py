"""Drives by links, centre distance or places: one formula, one rule for odd links, all faults at once."""

import json
import math

import pytest

KART = """
format_version = 1
[chain]
pitch_mm = 7.774
roller_diameter_mm = 4.59
inner_width_mm = 4.68
pin_diameter_mm = 3.01
bearing_area_mm2 = 21
mass_kg_per_m = 0.35
[[sprocket]]
name = "engine"
role = "driver"
teeth = 12
profile = "iso606"
nodes = 61
[[sprocket]]
name = "axle"
teeth = 82
profile = "iso606"
nodes = 61
[drive]
links = 104
[load]
power_kW = 2
speed_rpm = 8000
[wear]
condition = "hardened, oiled"
[stop]
elongation_percent = 1.25
"""

NO_80 = """
format_version = 1
[chain]
designation = "ANSI 80"
[[sprocket]]
role = "driver"
teeth = 11
profile = "ansi_b29"
nodes = 61
[[sprocket]]
teeth = 20
profile = "ansi_b29"
nodes = 61
[drive]
links = 47
[load]
power_kW = 1
speed_rpm = 100
[wear]
condition = "hardened, oiled"
"""

RACING_CAR = """
format_version = 1
[chain]
designation = "#40"
[[sprocket]]
name = "motor"
role = "driver"
teeth = 12
profile = "ansi_b29"
nodes = 61
[[sprocket]]
name = "differential"
teeth = 46
profile = "ansi_b29"
nodes = 61
[drive]
centre_distance_mm = "6.84 inch"
[load]
torque_N_m = 230
speed_rpm = 3300
[wear]
condition = "hardened, dry"
"""


def placed(text: str, distance: float) -> str:
    """The same drive by the places of its sprockets."""
    head, first, second = text.split("[[sprocket]]\n")
    places = "[[sprocket]]\nposition_mm = [0, 0]\n", f"[[sprocket]]\nposition_mm = [{distance}, 0]\n"
    return "".join((head, places[0], first, places[1], second))


@pytest.fixture
def checked(cli, tmp_path):
    """Check a drive that stands in a file of its own."""

    def _checked(text):
        path = tmp_path / "drive.toml"
        path.write_text(text)
        return cli("check", path, "--json")

    return _checked


@pytest.mark.parametrize(
    ("x", "y", "side"),
    [(396, 0, "below"), (-396, 0, "above"), (0, 396, "to the right of"), (0, -396, "to the left of")],
)
def test_sense_of_two_placed_sprockets_is_said(checked, x, y, side):
    """The spans open towards the larger wheel: the tight one pulls the shaft of the driver to its side."""
    text = placed(NO_80, 396).replace("[396, 0]", f"[{x}, {y}]").replace("= 47", "= 47\nslack_tension_N = 20")
    found = json.loads(checked(text).out)
    (said,) = [one for one in found["assumptions"] if "counter-clockwise" in one]
    assert f"its slack span lies {side} the line of centres" in said
    pull = found["layout"]["sprockets"][0]["shaft_direction_deg"]
    beside = (pull - math.degrees(math.atan2(y, x)) + 180.0) % 360.0 - 180.0
    assert 0.0 < beside < 90.0  # left of the way to the driven wheel, so that the slack span is right of it


def centre(layout) -> float:
    one, two = layout["sprockets"]
    return two["x_mm"] - one["x_mm"]


@pytest.mark.wide
@pytest.mark.wide
@pytest.mark.parametrize(
    ("text", "taut"),
    # tests/verification/test_drive_layout.py holds both against polygons of rigid links.
    [(KART, 202.764), (NO_80, 398.388)],
)
def test_by_links_by_distance_and_by_places_a_drive_is_the_same(checked, text, taut):
    links = text.split("links = ")[1].split("\n")[0]
    layouts = [json.loads(checked(text).out)["layout"]]
    if text == KART:
        by_distance = text.replace(f"links = {links}", f"centre_distance_mm = {taut}")
        layouts.append(json.loads(checked(by_distance).out)["layout"])
        layouts.append(json.loads(checked(placed(text.replace("links = 104\n", ""), taut)).out)["layout"])
    layouts.append(json.loads(checked(placed(text, taut)).out)["layout"])
    for layout in layouts:
        assert layout["links"] == int(links)
        assert centre(layout) == pytest.approx(taut, abs=1e-3)
        for key, digits in (("wrap_deg", 1e-2), ("teeth_in_mesh", 1e-3)):
            assert [one[key] for one in layout["sprockets"]] == pytest.approx(
                [one[key] for one in layouts[0]["sprockets"]], abs=digits
            )
        assert layout["spans"][0]["length_mm"] == pytest.approx(layouts[0]["spans"][0]["length_mm"], abs=2e-3)


def test_a_chain_without_slack_has_the_tension_of_its_stretch(checked):
    """0.0361 mm further apart than taut, the two spans at 25 degrees ask for 2 cos(b) as much more."""
    tilt = math.asin(7.774 * (1 / math.sin(math.pi / 82) - 1 / math.sin(math.pi / 12)) / 2 / 202.764)
    short = 2 * math.cos(tilt) * (202.8 - 202.7639)
    found = json.loads(checked(placed(KART, 202.8)).out)
    slack = found["layout"]["spans"][0]["tension_N"]
    weight, span = 0.35e-6 * 9806.65 * math.cos(tilt), found["layout"]["spans"][0]["length_mm"]
    stretch = 104 * slack / 30600 - weight**2 * span**3 / (24 * slack**2)
    assert stretch == pytest.approx(short, abs=2e-4)
    assert any(f"fits without slack ({-short:+.2g}" in text for text in found["assumptions"])
    softer = placed(KART, 202.8).replace("links = 104", "links = 104\nlink_stiffness_N_per_mm = 10000")
    assert json.loads(checked(softer).out)["layout"]["spans"][0]["tension_N"] < 0.6 * slack


def test_places_that_do_not_fit_are_told_how_far_apart_they_would(checked):
    done = checked(placed(KART.replace("links = 104\n", ""), 203.09))
    assert done.code == 2
    assert "need 104.0759 links; 104 links are 0.59 mm too short, 0.073 %" in done.err
    assert "set the centre distance to 202.764 mm for 104 links or 211.323 mm for 106 links" in done.err


@pytest.mark.parametrize("pitch", ["alternating", "uniform"])
@pytest.mark.parametrize("place", [False, True])
def test_odd_links_are_warned_of_by_one_rule(checked, pitch, place):
    text = f'{NO_80}[joint]\npitch = "{pitch}"\n'
    done = checked(placed(text, 398.388) if place else text)
    assert done.code == 0, done.err
    warnings = json.loads(done.out)["warnings"]
    assert sum("47 links need a cranked (offset) link" in text for text in warnings) == 1


def test_a_jump_does_not_hide_what_overloads_the_drive(checked):
    """230 N m at 3300 rpm are 79.48 kW; H2 = 17 (100 z/n)^1.5 p^0.8 hp of 12 teeth is 1.597 kW."""
    done = checked(RACING_CAR)
    assert done.code == 2
    impact = 0.7457 * 17 * (100 * 12 / 3300) ** 1.5 * 0.5**0.8
    assert impact == pytest.approx(1.597, abs=1e-3)
    motor, differential, load = [line for line in done.err.splitlines() if "drive.toml:" in line]
    assert "'motor': " in motor and "the chain jumps: give a slack tension" in motor
    assert "'differential': " in differential
    assert ": load: the load must stay within its ratings: " in load
    assert "roller impact 79.48 kW, allowed at most 1.597 kW (ANSI B29.1, H2): 4 978 % of it" in load
    for name in ("plate fatigue", "corrected power", "safety against breaking"):
        assert name in load


def test_a_jump_of_a_drive_within_its_ratings_is_told_alone(checked):
    done = checked(NO_80.replace("links = 47", "links = 48\nslack_tension_N = 0.5"))
    assert done.code == 2
    assert "the chain jumps" in done.err
    assert "ratings" not in done.err
