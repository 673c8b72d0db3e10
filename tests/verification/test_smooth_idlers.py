"""Smooth idlers: held against sprockets on whose pitch circle their rollers lie."""

import math
from pathlib import Path
from typing import Any

import pytest

import wearsim
from tests.drives import changed

PITCH, ROLLER = 12.7, 8.51
LOOP: dict[str, Any] = {
    "format_version": 1,
    "chain": {"designation": "08B-1"},
    "sprocket": [
        {"name": "motor", "teeth": 17, "profile": "iso606", "nodes": 51, "position_mm": [0, 0]},
        {"name": "pump", "teeth": 23, "profile": "iso606", "nodes": 51, "position_mm": [400, 0]},
    ],
    "mechanism": {"phases": 2},
    "load": {"power_kW": 1, "speed_rpm": 300},
    "lubrication": {"lubricant": "drip"},
    "stop": {"elongation_percent": 1},
    "run": {"life_tolerance": 0.1, "horizon_hours": 20_000},
}
PLACE = {"name": "idler", "role": "idler", "position_mm": [200, 45], "outside": True}
PLACE["take_up"] = {"travel_mm": [-60, 60]}


def with_idler(idler: dict[str, Any]) -> dict[str, Any]:
    return {**LOOP, "sprocket": [*LOOP["sprocket"], {**PLACE, **idler}]}


def on_pitch_circle(teeth: int) -> dict[str, Any]:
    """A smooth wheel whose rollers lie on the pitch circle p/sin(pi/z) of so many teeth."""
    return with_idler({"smooth_diameter_mm": PITCH / math.sin(math.pi / teeth) - ROLLER})


def test_a_chain_runs_as_round_a_sprocket_of_that_pitch_circle() -> None:
    toothed = wearsim.load_case(with_idler({"teeth": 13, "profile": "iso606", "nodes": 51}))
    smooth = wearsim.load_case(on_pitch_circle(13))
    one, other = (case.driver.drive for case in (toothed, smooth))
    assert other.layout.links == one.layout.links
    assert other.layout.loop.teeth == pytest.approx([17, 23, 13], rel=1e-12)
    for forces in ("tensions", "shaft_loads", "losses"):
        first, second = (getattr(drive.forces(drive.heaviest), forces) for drive in (one, other))
        assert second == pytest.approx(first, rel=1e-9)
    contacts = (case.driver.drive.contact(case.driver.case) for case in (toothed, smooth))
    first, second = (contact.cycles_per_mate for contact in contacts)
    assert second == pytest.approx(first, rel=1e-9)


def test_a_smooth_idler_is_no_part_that_wears() -> None:
    found = wearsim.simulate(wearsim.load_case(on_pitch_circle(13)))
    assert set(found.parts) == {"chain", "motor", "pump"}
    assert any("'idler' is smooth" in text for text in found.drive.assumptions)


@pytest.mark.parametrize("name", [None, "idler", "moter"])
def test_a_sprocket_of_the_drive_is_asked_for_in_the_same_words(name: str | None, tmp_path: Path) -> None:
    """The smooth idler is none: it has no teeth to export, nor to photograph."""
    case = wearsim.load_case(on_pitch_circle(13))
    assert [wheel.name for wheel in case.worn_wheels] == ["motor", "pump"]
    got = "" if name is None else f" \\(got '{name}'\\)"
    asked = f"sprocket: must name one wheel of the whole drive: one of 'motor', 'pump'{got}$"
    with pytest.raises(wearsim.CaseError, match=asked):
        wearsim.export(case, tmp_path / "wheel.dxf", sprocket=name)
    with pytest.raises(wearsim.CaseError, match=asked):
        case.titled_case(name)
    assert case.titled_case("pump").title.endswith(": pump")


def test_a_larger_wheel_turns_the_joints_less() -> None:
    """Links round it: pi over the arc sine of half a pitch over the radius of the joints."""
    cycles = []
    for diameter in (40.0, 60.0):
        case = wearsim.load_case(with_idler({"smooth_diameter_mm": diameter})).driver
        radius = 0.5 * (diameter + ROLLER)
        expected = math.pi / math.asin(0.5 * PITCH / radius)
        assert case.drive.layout.loop.teeth[2] == pytest.approx(expected, rel=1e-12)
        cycles.append(case.drive.contact(case.case).cycles_per_mate)
    assert cycles[0] < cycles[1]


def test_a_grown_chain_keeps_its_place_on_a_smooth_wheel() -> None:
    """On a sprocket the rollers ride higher, on a cylinder the joints stay where they were."""
    loop = wearsim.load_case(on_pitch_circle(13)).driver.drive.layout.loop
    grown = type(loop)(loop.pitch, loop.wheels, elongation=0.02, roller_radius=loop.roller_radius)
    assert grown.pitch_radii[2] == loop.pitch_radii[2]
    assert grown.pitch_radii[0] == pytest.approx(1.02 * loop.pitch_radii[0])
    assert grown.teeth[2] < loop.teeth[2]


@pytest.mark.parametrize(
    ("idler", "message"),
    [
        ({"smooth_diameter_mm": 60, "teeth": 13}, r"sprocket\.3\.teeth: a smooth idler has no teeth"),
        ({"smooth_diameter_mm": 60, "price": 5.0}, r"sprocket\.3\.price: a smooth idler"),
        (
            {"smooth_diameter_mm": 60, "role": "driven"},
            r"sprocket\.3\.role: a smooth wheel transmits no power",
        ),
        ({"smooth_diameter_mm": 10}, "smooth wheel 'idler' must be at least 13.1 mm in diameter"),
        ({"smooth_diameter_mm": -1}, r"sprocket\.3\.smooth_diameter_mm"),
        ({"teeth": 13}, r"sprocket\.3\.profile: this key is required"),
    ],
)
def test_what_a_smooth_idler_is_not(idler: dict[str, Any], message: str) -> None:
    with pytest.raises(wearsim.CaseError, match=message):
        wearsim.load_case(with_idler(idler))


def test_cogs_beside_a_smooth_idler_are_refused() -> None:
    cogs = [{"teeth": 21, "share_of_time": 0.5}, {"teeth": 23, "share_of_time": 0.5}]
    tables = with_idler({"smooth_diameter_mm": 60})
    tables["sprocket"][1] = {**LOOP["sprocket"][1], "cog": cogs}
    del tables["sprocket"][1]["teeth"]
    with pytest.raises(wearsim.CaseError, match=r"sprocket\.3\.smooth_diameter_mm: a drive with cogs"):
        wearsim.load_case(tables)


def test_a_plan_and_a_folder_leave_it_out(tmp_path: Any) -> None:
    priced = changed(on_pitch_circle(13), {"maintenance": {"chain_price": 50, "sprocket_price": 20}})
    found = wearsim.simulate(wearsim.load_case(priced))
    found.save(tmp_path / "out")
    again = type(found).load(tmp_path / "out")
    assert again.parts == found.parts
    plan = wearsim.maintain(wearsim.load_case(priced))
    assert "idler" not in plan.text.partition("\n")[2]
