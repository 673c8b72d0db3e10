"""Gears whose lives must not come out wrong in silence, each from a case that once did."""

import math
from pathlib import Path
from typing import Any

import pytest

import wearsim
from wearsim.report.answer import answer

CASES = Path(__file__).parents[2] / "cases"
FZG = CASES / "fzg-c14-16t-mild.toml"
STEEL = {"treatment": "carburised", "hardness_HRC": 60.0}


def gears(gear: dict[str, Any], torque: float, depth: float, ratio: float) -> dict[str, Any]:
    return {
        "format_version": 1,
        "gear": gear,
        "mechanism": {"pair_stiffness_N_per_mm_um": 14},
        "load": {"torque_N_m": torque, "speed_rpm": 100},
        "wear": {"specific_wear_rate_mm2_per_N": 1e-10, "wheel_wear_ratio": ratio},
        "stop": {"critical_depth_mm": depth},
        "run": {"horizon_hours": 1e7},
    }


def life(tables: dict[str, Any], *settings: str) -> wearsim.WearResult:
    return wearsim.simulate(wearsim.load_case(tables, settings))


@pytest.mark.parametrize("name", ["fzg-c14-16t-mild", "convex-concave-17t-mild", "constant-stress-36t-mild"])
def test_the_limit_of_the_wheel_is_said_in_words(name: str) -> None:
    case = wearsim.load_case(CASES / f"{name}.toml", ["stop.wheel_critical_depth_mm=0.005"])
    result = wearsim.simulate(case)
    assert result.stop == "wheel_critical_depth_mm"
    assert "until 0.005 mm is worn off the wheel" in " ".join(answer(result, "").split())


ROUGH: dict[str, Any] = {
    "profile": "prescribed_stress",
    "pinion_teeth": 36,
    "wheel_teeth": 54,
    "module_mm": 3,
    "face_width_mm": 76,
    "contact_stress_MPa": [1500, 1100, 1500],
    "stress_pitch_point_distance_mm": [-7.5, 0, 7.5],
    "first_pitch_point_distance_mm": -7,
    "last_pitch_point_distance_mm": 7,
    "nodes": 401,
}


def test_fatigue_looks_at_the_highest_stress_not_only_at_the_pitch_point() -> None:
    """1205 MPa 2 mm before the pitch point against 23 HRC/1.2: 1513 h at 1000 rpm; 1100 MPa never pits."""
    tables = gears(ROUGH, 240.0, 0.05, 1.0)
    tables["load"]["speed_rpm"] = 1000
    tables["fatigue"] = {"pinion": STEEL, "wheel": STEEL}
    result = life(tables)
    assert result.parts["pinion_fatigue"].hours_run == pytest.approx(1513.0, rel=0.02)


def test_soft_gears_bend_more() -> None:
    """E 3000 MPa and 0.4 on steel: 14 N/(mm um) by E*/E* of steel, 107.7 h by an own integration."""
    soft = ["material.pinion.youngs_modulus_MPa=3000", "material.pinion.poissons_ratio=0.4"]
    case = wearsim.load_case(FZG, soft)
    pinion, steel = (1.0 - 0.4**2) / 3000.0, (1.0 - 0.3**2) / 206_000.0
    stiffness = 14.0 * 2.0 * steel / (pinion + steel)
    assert case.inputs["mechanism"]["pair_stiffness_N_per_mm_um"] == pytest.approx(stiffness)
    assert wearsim.simulate(case).life.hours_run == pytest.approx(107.7, rel=5e-3)


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        (["gear.pinion_teeth=10", "gear.pinion_shift=1.0"], "width of the tip of the pinion"),
        (["gear.wheel_tip_radius_mm=62.5"], "gear"),
    ],
)
def test_pointed_involutes_are_refused(settings: list[str], message: str) -> None:
    with pytest.raises(wearsim.CaseError, match=message):
        wearsim.load_case(FZG, settings)


LIGHT = (
    (
        {
            "pinion_teeth": 14,
            "wheel_teeth": 90,
            "module_mm": 3.64,
            "face_width_mm": 30.6,
            "pressure_angle_deg": 26.954,
            "pinion_shift": -0.065,
            "wheel_shift": 0.375,
        },
        38.817,
        0.05289,
        1.262,
        3810.0,
    ),
    (
        {
            "profile": "prescribed_stress",
            "pinion_teeth": 36,
            "wheel_teeth": 95,
            "module_mm": 5.22,
            "face_width_mm": 65.4,
            "first_pitch_point_distance_mm": -10.5356,
            "last_pitch_point_distance_mm": 5.7158,
            "contact_stress_MPa": [329.545, 278.333, 235.44],
            "stress_pitch_point_distance_mm": [-10.6409, 0, 5.7729],
        },
        373.86,
        0.07169,
        0.587,
        7953.0,
    ),
    (
        {
            "profile": "convex_concave",
            "pinion_teeth": 11,
            "wheel_teeth": 72,
            "module_mm": 4.45,
            "face_width_mm": 29.7,
            "pitch_point_angle_deg": 14.177,
            "addendum_arc_radius_mm": 20.452,
            "dedendum_arc_radius_mm": 14.929,
            "addendum_ratio": 1.193,
            "nodes": 401,
        },
        17.052,
        0.13697,
        0.379,
        23645.0,
    ),
)


@pytest.mark.parametrize("case", LIGHT, ids=["involute", "prescribed", "convex-concave"])
def test_corners_of_tips_carry_load_however_deep_the_wear(case: tuple[Any, ...]) -> None:
    """Worn far more than the load bends the teeth: lives of an independent integration."""
    gear, torque, depth, ratio, hours = case
    result = life(gears(gear, torque, depth, ratio))
    assert result.life.hours_run == pytest.approx(hours, rel=max(0.01, result.numerical_error))


BESIDE_A_KINK = (
    (
        {
            "profile": "prescribed_stress",
            "pinion_teeth": 41,
            "wheel_teeth": 51,
            "module_mm": 6.09,
            "face_width_mm": 51.8,
            "first_pitch_point_distance_mm": -11.5353,
            "last_pitch_point_distance_mm": 12.4090,
            "contact_stress_MPa": 254.1777,
        },
        210.402,
        0.04474,
        3.111,
        2930.5,
    ),
    (
        {
            "pinion_teeth": 12,
            "wheel_teeth": 51,
            "module_mm": 7.4,
            "face_width_mm": 93.2,
            "pressure_angle_deg": 26.509,
            "pinion_shift": 0.026,
            "wheel_shift": -0.13,
        },
        208.119,
        0.03168,
        1.112,
        1825.6,
    ),
)


@pytest.mark.parametrize("case", BESIDE_A_KINK, ids=["prescribed", "involute"])
def test_error_of_a_maximum_beside_a_kink_is_stated(case: tuple[Any, ...]) -> None:
    """Against the lives with 1601 points."""
    gear, torque, depth, ratio, hours = case
    result = life(gears(gear, torque, depth, ratio))
    assert abs(result.life.hours_run / hours - 1.0) <= result.numerical_error


def test_a_third_pair_is_warned_of() -> None:
    gear = {
        "pinion_teeth": 30,
        "wheel_teeth": 45,
        "module_mm": 4.5,
        "face_width_mm": 14,
        "pinion_tip_radius_mm": 72.9,
        "wheel_tip_radius_mm": 106.6,
    }
    text = "a third pair of teeth carries load here"
    assert text in " ".join(life(gears(gear, 1500.0, 0.05, 1.0)).warnings)
    assert text not in " ".join(wearsim.load_case(FZG, ["load.torque_N_m=2000"]).warnings)


def test_an_absurd_stress_is_refused() -> None:
    with pytest.raises(wearsim.CaseError):
        life(
            gears(
                {**ROUGH, "contact_stress_MPa": 1e9, "stress_pitch_point_distance_mm": None} | {"nodes": 201},
                240.0,
                0.05,
                1.0,
            )
        )


def test_numbers_beyond_reason_are_named() -> None:
    with pytest.raises(wearsim.CaseError, match="1e-30 to 1e\\+15"):
        wearsim.load_case(FZG, ["gear.module_mm=1e300"])


def test_width_of_a_tip_is_that_of_its_arc() -> None:
    """On the pitch circle without shift half the pitch; the closed form against points of the flank."""
    from wearsim.geometry.gear.involute import InvolutePair

    pair = InvolutePair((20, 30), 3.0, math.radians(20.0), (0.0, 0.0), (30.0, 45.0))
    assert pair.tip_width(0) == pytest.approx(1.5 * math.pi)
    high = InvolutePair((20, 30), 3.0, math.radians(20.0), (0.0, 0.0), (33.0, 48.0))
    flank = high.mesh(401).flank
    angle = math.atan2(flank.x[-1], flank.y[-1])
    pitch = math.atan2(*(float(v) for v in at_radius(flank, 30.0)))
    assert high.tip_width(0) == pytest.approx(2.0 * 33.0 * (math.pi / 40.0 - abs(angle - pitch)), rel=1e-5)


def at_radius(flank: Any, radius: float) -> tuple[float, float]:
    import numpy as np

    away = np.hypot(flank.x, flank.y)
    return float(np.interp(radius, away, flank.x)), float(np.interp(radius, away, flank.y))
