"""The reference run in mm and N against the same numbers written with SI and other units.

Expected: the same life (benchmark B8 iv); 1 in = 25.4 mm, 1 mm3/(N m) = 1e-3 mm2/N.
"""

import copy
import math
from collections.abc import Callable
from typing import Any

import pytest

import wearsim

CaseMaker = Callable[..., wearsim.Case]

SI: dict[str, Any] = {
    "format_version": 1,
    "chain": {"pitch_mm": "0.0254 m", "roller_diameter_mm": "1.588 cm", "inner_width_mm": "17020 um"},
    "sprocket": {
        "teeth": 20,
        "profile": "evolute",
        "face_width_mm": "0.017 m",
        "evolute_offset_mm": "5.5e-3 m",
        "contact_start_mm": "0.03067 m",
        "contact_end_mm": "4e-3 m",
    },
    "material": {
        body: {"youngs_modulus_MPa": "2.1e11 Pa", "poissons_ratio": 0.3} for body in ("sprocket", "roller")
    },
    "load": {"tension_N": "5 kN", "speed_rpm": "10.471975511965978 rad/s"},
    "stop": {"critical_depth_mm": "2e-4 m"},
    "run": {"life_tolerance": 1e-4, "horizon_hours": "180 Ms"},
}


@pytest.mark.wide
@pytest.mark.parametrize("rate", ["1e-14 m^2/N", "1e-5 mm^3/(N*m)", "1e-14 m^3/(N*m)"])
@pytest.mark.parametrize("method", ["advance", "per_cycle"])
def test_si_input_gives_the_same_life(reference: CaseMaker, rate: str, method: str) -> None:
    wear = {"law": "archard", "specific_wear_rate_mm2_per_N": rate}
    method = f"run.method={method}"
    result = wearsim.simulate(wearsim.load_case({**SI, "wear": wear}, [method]))
    expected = wearsim.simulate(reference(1, method))
    assert result.cycles == pytest.approx(expected.cycles, rel=1e-9)
    assert result.life.hours == pytest.approx(expected.life.hours, rel=1e-9)
    assert result.initial_peak_pressure == pytest.approx(expected.initial_peak_pressure, rel=1e-9)


@pytest.mark.parametrize("load", ["torque_N_m", "power_kW"])
def test_torque_and_power_give_the_pull(reference: CaseMaker, load: str) -> None:
    """F_t = T/R = P/(omega R), R = p z/(2 pi); by per_cycle, which has no step control."""
    torque = 5000.0 * 0.0254 * 20 / (2.0 * math.pi)
    omega = 2.0 * math.pi * 100.0 / 60.0
    values = {"torque_N_m": f"{torque!r} Nm", "power_kW": f"{torque * omega!r} W"}
    tables = copy.deepcopy(SI)
    tables["wear"] = {"law": "archard", "specific_wear_rate_mm2_per_N": 1e-8}
    tables["load"] = {load: values[load], "speed_rpm": 100}
    expected = wearsim.simulate(reference(1, "run.method=per_cycle")).cycles
    result = wearsim.simulate(wearsim.load_case(tables, ["run.method=per_cycle"]))
    assert result.cycles == pytest.approx(expected, rel=1e-9)


def test_drozdov_constants_with_units() -> None:
    numbers = {
        "law": "drozdov",
        "coefficient": 1e-5,
        "pressure_exponent": 1.0,
        "hardness_MPa": 5000.0,
        "reference_speed_mm_per_s": 400.0,
        "speed_exponent": 0.2,
    }
    strings = {**numbers, "hardness_MPa": "5 GPa", "reference_speed_mm_per_s": "0.4 m/s"}
    lives = [wearsim.simulate(wearsim.load_case({**SI, "wear": wear})).cycles for wear in (numbers, strings)]
    assert lives[0] == pytest.approx(lives[1], rel=1e-9)


def test_every_second_gap_on_the_same_centrode() -> None:
    """40 teeth, every second gap: R = p z/(4 pi), and the same 20 gaps are loaded every turn."""
    tables = copy.deepcopy(SI)
    tables["wear"] = {"law": "archard", "specific_wear_rate_mm2_per_N": 1e-8}
    tables["chain"]["roller_diameter_mm"] = 8.0
    whole = wearsim.simulate(wearsim.load_case(tables))
    half = wearsim.simulate(wearsim.load_case(tables, ["sprocket.teeth=40", "sprocket.engaged_every=2"]))
    assert half.cycles == pytest.approx(whole.cycles, rel=1e-9)
    assert half.life.hours == pytest.approx(whole.life.hours, rel=1e-9)
    assert any("the same 20 gaps" in text for text in half.warnings)
