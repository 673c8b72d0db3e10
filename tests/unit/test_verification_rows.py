"""What a sheet verifies: inputs as they were written, and what follows from them."""

import pytest

import wearsim
from tests import drives
from wearsim.report.html import page_content
from wearsim.report.verification import given_rows, verification_rows

CONVEYOR = {
    "format_version": 1,
    "chain": {"designation": "12B-1"},
    "sprocket": [{"name": "motor", "teeth": 21}, {"name": "conveyor", "teeth": 57}],
    "drive": {"centre_distance_mm": 800, "service_factor": 1.4, "joint_application_factor": 1.6875},
    "load": {"power_kW": "7.5 kW", "speed_rpm": 120},
    "lubrication": {"lubricant": "drip"},
    "service": {"hours_per_day": 16},
}
for one in CONVEYOR["sprocket"]:
    one |= {"profile": "iso606", "nodes": 61}


def rows(**values):
    """Both parts of the sheet of the conveyor, with other values of keys."""
    drive = wearsim.load_case(drives.changed(CONVEYOR, {k.replace("__", "."): v for k, v in values.items()}))
    case = drive.driver.case
    return dict(given_rows(drive.inputs, case)), dict(verification_rows(case, case.drive.ratings(case)))


def test_inputs_stand_as_they_were_given():
    given, _ = rows()
    assert given["load as given"] == "7.5 kW at 120 rpm"
    assert given["shock class"] == "driver smooth, driven machine moderate shocks (f1 = 1.4 of ISO 10823)"
    assert given["running time"] == "16 h a day"
    assert given["lubrication"] == "drip"
    assert given["centre distance"].startswith("prescribed 800 mm; 124 links need 802.19 mm")
    assert given["sprockets"] == "21 and 57 teeth, ratio 2.714"


@pytest.mark.parametrize(
    ("key", "value", "label", "told"),
    [
        ("load__power_kW", "10 hp", "load as given", "10 hp at 120 rpm"),
        ("drive__service_factor", 1.95, "shock class", "f1 = 1.95, not a class of ISO 10823"),
        ("drive__service_factor", 1.8, "shock class", "heavy shocks (f1 = 1.8"),
        ("service__hours_per_day", 7.5, "running time", "7.5 h a day"),
        ("lubrication__environment", "dust", "lubrication", "drip, environment dust"),
        ("drive__centre_distance_mm", 900, "centre distance", "prescribed 900 mm"),
    ],
)
def test_another_input_is_another_text(key, value, label, told):
    given, _ = rows(**{key: value})
    assert told in given[label]


def test_what_is_not_given_says_so():
    few = {key: table for key, table in CONVEYOR.items() if key not in ("drive", "service", "lubrication")}
    drive = wearsim.load_case({**few, "drive": {"links": 124}, "wear": {"condition": "hardened, oiled"}})
    given = dict(given_rows(drive.inputs, drive.driver.case))
    assert given["shock class"].startswith("not given: f1 = 1 is assumed")
    assert given["running time"] == "not given"
    assert given["lubrication"] == "type not given, wear condition 'hardened, oiled'"
    assert given["centre distance"].startswith("not prescribed; 124 links give 802.19 mm")


def test_a_duty_is_written_out():
    blocks = [{"share_of_time": 0.4, "power_kW": 3, "speed_rpm": 120}] + [
        {"share_of_time": 0.1, "power_kW": 1, "speed_rpm": 120} for _ in range(6)
    ]
    tables = {key: table for key, table in CONVEYOR.items() if key != "load"}
    drive = wearsim.load_case({**tables, "duty": blocks})
    told = dict(given_rows(drive.inputs, drive.driver.case))["load as given"]
    assert told.startswith("40 % of the time 3 kW at 120 rpm; 10 % of the time 1 kW at 120 rpm; ")
    assert told.endswith("; 3 more blocks")


def test_pressure_and_factors_by_hand():
    """7.5 kW at 21 * 19.05 mm * 120 rpm = 0.8001 m/s is 9374 N on 89.3 mm2; f2 = (19/21)^1.08."""
    _, found = rows()
    pull = 7500.0 / 0.8001
    assert found["chain pull"] == "9 374 N"
    pressure = pull / 89.3
    assert found["bearing pressure"] == (
        f"{pressure:.4g} N/mm2 on 89.3 mm2; {1.6875 * pressure:.4g} N/mm2 with K_e = 1.6875"
    )
    assert found["application factor f1"].startswith("1.4,")
    assert found["tooth factor f2"].startswith(f"{(19 / 21) ** 1.08:.3g} for 21 teeth")
    assert found["corrected power P f1 f2"] == f"{7.5 * 1.4 * (19 / 21) ** 1.08:.4g} kW"


def test_two_strands_say_how_they_share():
    """ANSI and GOST practice: two strands carry 1.7 times the load of one."""
    _, found = rows(chain__designation="12B-2")
    pressure = 7500.0 / 0.8001 / (178.6 / 2 * 1.7)
    assert found["bearing pressure"].startswith(
        f"{pressure:.4g} N/mm2 on 178.6 mm2, where 2 strands carry 1.7 "
    )


@pytest.mark.parametrize(
    ("speed", "needed", "state"),
    [
        (120, "drip, or by hand every 8 hours (type A", "drip: as recommended"),
        (200, "oil bath or disc (type B", "drip: one type below"),
        (1400, "oil stream (type C", "drip: insufficient"),
    ],
)
def test_lubrication_follows_the_speed(speed, needed, state):
    """19.05 mm of pitch: drip up to 1.12 m/s, a bath up to 9.1 m/s (ANSI B29.1)."""
    _, found = rows(load__speed_rpm=speed)
    assert found["required lubrication"].startswith(needed)
    assert found["required lubrication"].endswith("drip up to 1.12 m/s, bath up to 9.1 m/s")
    assert found["lubrication given"] == state
    assert found["required viscosity"].startswith("SAE 30 (ISO VG 100) at 5 to 40 °C; SAE 20 at -5 to 5;")


def test_no_chain_has_no_rows():
    case = wearsim.load_case(drives.GEARS)
    assert given_rows(case.inputs, case) == verification_rows(case, ()) == []


def test_a_default_of_one_sprocket_is_not_called_given():
    tables = {**drives.LIGHT_WRAP, "wear": {"condition": "hardened, oiled"}}
    result = wearsim.simulate(wearsim.load_case(tables, ["run.horizon_hours=1", "run.life_tolerance=0.1"]))
    page = page_content.case_page(result, "x", brief=False)
    assert dict(page.given)["shock class"].startswith("not given")
    assert page_content.case_page(result, "x", brief=True).given == []
