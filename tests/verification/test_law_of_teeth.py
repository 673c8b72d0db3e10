"""Studies keep the law by which teeth and joints wear, and what a reading found holds where it was read.

Expectations are the life of the case itself, and the causes of a band added by hand: x/÷1.8 beyond what a
rate was found for, logarithms by squares.
"""

import math
from typing import Any

import pandas as pd
import pytest

import wearsim
from wearsim.chain.joint_wear import LEAST_PRESSURE, PITCHES, TURNING, JointState
from wearsim.drive.wrap_life import wrap_of

SLOW: dict[str, Any] = {
    "format_version": 1,
    "chain": {"designation": "12A-1"},
    "sprocket": {"teeth": 21, "profile": "ansi_b29", "nodes": 41},
    "mechanism": {"kind": "wrap", "phases": 1},
    "drive": {"mate_teeth": 57, "links": 124},
    "load": {"power_kW": 1.5, "speed_rpm": 100},
    "wear": {"condition": "hardened, oiled"},
    "stop": {"critical_depth_mm": 0.1},
    "run": {"life_tolerance": 0.1},
}
TEETH, JOINTS = "wear.specific_wear_rate_mm2_per_N", "joint.specific_wear_rate_mm2_per_N"


@pytest.fixture(scope="module")
def slow() -> wearsim.Case:
    """A drive at a tenth of the speed where rates of oil hold, whose tooth ends first."""
    case = wearsim.load_case(SLOW)
    assert isinstance(case, wearsim.Case)
    return case


@pytest.fixture(scope="module")
def life(slow: wearsim.Case) -> float:
    return float(wearsim.simulate(slow).parts["sprocket"].hours)


def readings(quantity: str, hours: float, value: float) -> pd.DataFrame:
    return pd.DataFrame([{"time_hours": hours, "quantity": quantity, "value": value, "error": 0.02 * value}])


def of_drive(**tables: Any) -> dict[str, Any]:
    """Tables of both sprockets of the drive."""
    wheel = {"profile": "ansi_b29", "nodes": 41}
    wheels = [
        {**wheel, "name": "motor", "teeth": 21, "role": "driver"},
        {**wheel, "name": "roll", "teeth": 57},
    ]
    return {**{key: SLOW[key] for key in SLOW if key not in ("sprocket", "drive")}, **tables} | {
        "sprocket": wheels,
        "drive": {"links": 124},
    }


@pytest.mark.wide
def test_half_of_the_samples_live_as_long_as_the_case(slow: wearsim.Case, life: float) -> None:
    near = {key: {"distribution": "lognormal", "sigma_ln": 0.01} for key in (TEETH, JOINTS)}
    found = wearsim.uncertainty(slow, near, samples=4, threads=1)
    assert found.samples["life_hours"].median() == pytest.approx(life, rel=0.02)


@pytest.mark.wide
def test_teeth_read_as_predicted_keep_their_rate(slow: wearsim.Case, life: float) -> None:
    found = wearsim.calibrate(slow, readings("max_depth_mm", life, 0.1))
    (value,) = found.found.values
    assert value.value == pytest.approx(5e-11, rel=0.03)
    assert value.holds_at.startswith("at 25.7 MPa, 1000 rpm and 12.7 mm pitch")
    again = wearsim.simulate(found.case)
    assert again.parts["sprocket"].hours == pytest.approx(found.found.parts[0].life, rel=0.02)
    # The chain was not read: its life and the outer end of its band stay.
    joints = slow.drive.wear_band("chain", slow.wear)
    assert again.parts["chain"].hours == pytest.approx(wearsim.simulate(slow).parts["chain"].hours, rel=1e-6)
    assert found.case.drive.wear_band("chain", slow.wear).high == pytest.approx(joints.high, rel=1e-9)
    # The teeth were read at 100 rpm, which is no extrapolation there.
    band = found.case.drive.wear_band("sprocket", slow.wear)
    assert band.high == pytest.approx(found.case.inputs["wear"]["band_factor"], rel=1e-9)


def chain_hours(case: wearsim.Case) -> float:
    return float(wrap_of(case).contact(case).cycles_per_mate / case.cycles_per_hour)


def tooth_rates(case: wearsim.Case) -> list[float]:
    """Rates of the teeth under each load [mm2/N]."""
    return [case.wear.coefficient * block.wear_factor for block in wrap_of(case).blocks]


def test_a_chain_that_was_read_holds_at_its_drive() -> None:
    given = wearsim.load_case(of_drive())
    found = wearsim.calibrate(given, readings("elongation_percent", 2000.0, 0.5))
    (value,) = found.found.values
    assert value.holds_at.endswith("joint.law = 'pressure_speed'")
    assert found.found.parts[0].life == pytest.approx(12_000.0, rel=1e-6)
    assert chain_hours(found.case.chain_case) == pytest.approx(12_000.0, rel=1e-6)
    # The rate alone, constant then, gives nearly that life too.
    alone = wearsim.load_case(of_drive(joint={JOINTS.partition(".")[2]: value.value}))
    assert chain_hours(alone.chain_case) == pytest.approx(12_000.0, rel=0.03)
    # Teeth were not read.
    for before, after in zip(*(one.single_cases.values() for one in (given, found.case)), strict=True):
        assert tooth_rates(after) == pytest.approx(tooth_rates(before), rel=1e-12)


def test_what_was_read_is_less_sure_at_another_speed() -> None:
    """As of a wear condition: x/÷1.8 more at 30 rpm, none where it was read, in the same law."""
    given = wearsim.load_case(of_drive())
    tables = wearsim.calibrate(given, readings("elongation_percent", 2000.0, 0.5)).found.tables
    factor = tables["joint"]["band_factor"]
    wider = math.exp(math.hypot(math.log(factor), math.log(1.8)))
    for rpm, expected in ((100, factor), (30, wider)):
        load = {"power_kW": 0.015 * rpm, "speed_rpm": rpm}
        moved = wearsim.load_case({**tables, "load": load}).chain_case
        band = moved.drive.wear_band("chain", moved.wear)
        assert band.high == pytest.approx(expected, rel=1e-9)
        assert band.low == pytest.approx(1.0 / expected, rel=1e-9)


@pytest.mark.parametrize("state", [(22.0, 100.0, 19.05), (7.0, 6000.0, 8.0), (40.0, 10.0, 76.2)])
def test_a_law_told_from_elsewhere_is_the_same(slow: wearsim.Case, state: tuple[float, ...]) -> None:
    law = slow.drive.joint.law
    told = law.at(JointState(*state))
    for place in ((30.0, 300.0, 25.4), (5.0, 5000.0, 9.525), state):
        assert told.rate(*place) == pytest.approx(law.rate(*place), rel=1e-12)
    assert told.coefficient == pytest.approx(law.rate(*state), rel=1e-12)


@pytest.mark.parametrize(
    ("key", "ends"),
    [
        ("reference_pressure_MPa", (LEAST_PRESSURE, 1000.0)),
        ("reference_speed_rpm", TURNING),
        ("reference_pitch_mm", PITCHES),
    ],
)
def test_references_that_a_law_holds_are_refused(
    slow: wearsim.Case, key: str, ends: tuple[float, float]
) -> None:
    low, high = ends
    for end in ends:
        slow.with_({"joint.law": "pressure_speed", f"joint.{key}": end})
    for beyond in (0.99 * low, 1.01 * high):
        with pytest.raises(wearsim.CaseError, match=f"joint.{key}: must lie between {low:g} and {high:g}"):
            slow.with_({"joint.law": "pressure_speed", f"joint.{key}": beyond})


def test_a_rate_that_is_held_says_where(slow: wearsim.Case) -> None:
    fast = slow.with_({"load.speed_rpm": 2000.0, "load.power_kW": 1.0})
    (text,) = [text for text in fast.assumptions if text.startswith("joint wear by")]
    assert text.endswith("(rate held at 15 MPa, 1000 rpm)")
    assert "held" not in "".join(slow.assumptions)


@pytest.mark.parametrize("rate", [None, 5e-9])
def test_a_law_without_exponents_says_so(slow: wearsim.Case, rate: float | None) -> None:
    named = {"wear.condition": "hardened, dry", "joint.law": "pressure_speed"}
    case = slow.with_(named | ({JOINTS: rate} if rate else {}))
    assert any(
        text.startswith("joint.law = 'pressure_speed' has no effect here") for text in case.assumptions
    )
    own = case.with_({"joint.speed_exponent": 0.5})
    assert not any("has no effect here" in text for text in own.assumptions)
