"""Shipped cases of a wrapped chain: numbers of their sources, the chain's life in closed form, runs.

The runs are coarse and end after a fraction of the chain's life: they show that a case is
complete, not what its teeth live.
"""

import json
import math
import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import wearsim
from wearsim.mechanisms.wrap.tooth_loads import tooth_loads
from wearsim.result import WearResult

FOLDER = Path(__file__).parents[2] / "cases"
PATHS = {
    path.stem: path for path in sorted(FOLDER.glob("*.toml")) if 'kind = "wrap"' in path.read_text("utf-8")
}
QUICK = ("sprocket.nodes=151", "mechanism.phases=2", "run.life_tolerance=0.1")
EVERY_CASE = pytest.mark.parametrize("name", PATHS)


@cache
def loaded(name: str) -> wearsim.Case:
    return wearsim.load_case(PATHS[name])


def chain_hours(case: wearsim.Case) -> float:
    """Archard in the joints: a link turns by 2 pi/z under load on and off each sprocket.

    Hours = eps p X/(60 n z k (p_t + p_s) pi d2 (1/z1 + 1/z2)) with the pressures of the tight
    strand, where driver and driven sprocket are left and entered, and of the slack one.
    """
    inputs, drive = case.inputs, case.drive
    layout, area = drive.layout, case.drive.chain.bearing_area
    load = drive.heaviest
    tight, slack = load.tension + load.centrifugal, drive.slack + load.centrifugal
    own = case.drive.gaps / case.engaged_every
    mate = layout.teeth_2 if case.drive.driver else layout.teeth_1
    turning = math.pi * case.drive.chain.pin_diameter * (1 / own + 1 / mate)
    joint = inputs["joint"]
    worn = 0.0
    for pressure in (tight / area, slack / area):
        law = 1.0
        if joint["law"] == "pressure_speed":
            # No shipped wrap with such a law turns by another speed or pitch than its reference.
            assert joint["speed_exponent"] == joint["pitch_exponent"] == 0.0
            held = max(pressure, 15.0) / max(joint["reference_pressure_MPa"], 15.0)
            law = held ** (joint["pressure_exponent"] - 1.0)
        worn += joint["specific_wear_rate_mm2_per_N"] * law * pressure
    loop = worn * turning / case.drive.chain.pitch
    pitches = inputs["sprocket"]["teeth"] / inputs["sprocket"].get("engaged_every", 1)
    loops = 60.0 * inputs["load"]["speed_rpm"] * pitches / layout.links
    dirt = inputs.get("lubrication", {}).get("contamination_factor", 1.0)
    return 0.01 * inputs["stop"]["elongation_percent"] / (dirt * loop * loops)


@cache
def short_run(name: str) -> WearResult:
    hours = f"run.horizon_hours={0.03 * chain_hours(loaded(name)):.6g}"
    return wearsim.simulate(wearsim.load_case(PATHS[name], (*QUICK, hours)))


@EVERY_CASE
def test_loads_fall_along_the_wrap(name):
    found = tooth_loads(loaded(name))
    assert found.loads.force[0] == found.loads.force.max()
    assert found.loads.force.min() > 0.0
    assert found.smallest_slack < found.slack
    assert found.loads.tension[0] == pytest.approx(loaded(name).drive.heaviest.tension)


@pytest.mark.parametrize(
    ("name", "pull", "force"),
    [
        ("a140-17t-starved", 17760.0, 2.5 * 3640.0),
        ("a50-20t-drip", 1174.0, 511.0),
        ("a80-20t-oilbath", 4724.0, 2065.0),
        ("pr254-27t-greased", 2110.0, 742.0),
        ("a40-19t-rating", 1145.0, 511.0),
        ("d6-crawler-27t-wrap", 90000.0, 56500.0),
        ("520-15t-wrap", 1370.0, 736.0),
    ],
)
def test_pull_and_first_tooth_of_the_worked_cases(name, pull, force):
    """Ft to its printed digits (E has 4.60 of the 4.604 kW); P1 of a rigid chain within 5 %."""
    drive = loaded(name).drive
    assert drive.heaviest.tension - drive.slack == pytest.approx(pull, rel=1.2e-3)
    assert tooth_loads(loaded(name)).loads.force[0] == pytest.approx(force, rel=0.05)


def test_rating_point_lives_15_000_hours_to_3_percent():
    """1.16e-7 mm3/(N m) is made for it, without the turning under the slack strand's 2.4 %."""
    case = loaded("a40-19t-rating")
    drive = case.drive
    slack = 1.0 + (drive.slack + drive.heaviest.centrifugal) / (
        drive.heaviest.tension + drive.heaviest.centrifugal
    )
    assert slack * chain_hours(case) == pytest.approx(15_000, rel=0.005)


@EVERY_CASE
def test_chain_lives_within_a_factor_of_practice(name):
    text = PATHS[name].read_text("utf-8")
    if "# practice: none found" in text:
        return
    low, high = map(float, re.search(r"^# practice: (\d+)\.\.(\d+) h", text, re.M).groups())
    factor = float(re.search(r"^# factor: ([\d.]+) ", text, re.M)[1])
    assert low / factor <= chain_hours(loaded(name)) <= high * factor


@EVERY_CASE
def test_it_runs_to_a_complete_result(name):
    run = short_run(name)
    for key, values in {**run.history_columns, **run.flank_columns}.items():
        assert values.size > 1, key
        assert np.all(np.isfinite(values)), key
    assert np.all(np.diff(run.history_columns["max_depth_mm"]) >= 0.0)
    assert run.history_columns["max_depth_mm"][-1] == run.max_depth > 0.0
    assert run.final_peak_pressure > 0.0
    summary = json.loads(json.dumps(run.summary(), allow_nan=False))
    assert not summary["life_reached"]
    assert summary["case"] == name


@EVERY_CASE
def test_chain_grows_by_archard(name):
    """3 % of its life, 3 % of its limit."""
    grown = short_run(name).history_columns["elongation_percent"][-1]
    limit = loaded(name).inputs["stop"]["elongation_percent"]
    assert grown == pytest.approx(0.03 * limit, rel=1e-4)


def test_gears_of_a_bicycle():
    """Chainring 50 at 90 rpm turns the cog of 17 at 264.7 rpm; 200 W at 0.9525 m/s pull 210 N."""
    case = loaded("bicycle-17t-road")
    assert not case.drive.driver
    assert case.speed_rpm == pytest.approx(90 * 50 / 17, rel=1e-4)
    assert case.drive.heaviest.tension - case.drive.slack == pytest.approx(200 / 0.9525, rel=1e-4)
