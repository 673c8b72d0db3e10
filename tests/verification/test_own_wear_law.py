"""Wear laws that a program gives as functions, against closed forms of Archard's law and the power law.

On a flat that is loaded and slid over alike everywhere the depth grows alike everywhere, so the pressure
sigma_H = sqrt(q E*/(pi R)) stays and h = K sigma_H^m s N; in a contact that travels s is the slip ratio
times the width 2a = 4 q/(pi sigma_H), over which the mean of (sigma/sigma_H)^m is
c_m = (sqrt(pi)/2) Gamma(1 + m/2)/Gamma(3/2 + m/2).
"""

import math

import numpy as np
import pytest

import wearsim

MODULUS = 2.1e5 / (2.0 * 0.91)
RADIUS, LOAD, DEPTH, PATH, SLIP = 5.0, 80.0, 0.05, 0.4, 0.3
PRESSURE = math.sqrt(LOAD * MODULUS / (math.pi * RADIUS))
EXPONENTS = [1.0, 1.5, 2.0, 3.3]
COEFFICIENT = {m: 1e-8 / PRESSURE**m for m in EXPONENTS}

STRAND = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "sprocket": {"teeth": 20, "profile": "evolute", "evolute_offset_mm": 5.6, "nodes": 51},
    "load": {"power_kW": 3, "speed_rpm": 100},
    "wear": {"law": "drozdov of ours"},
    "stop": {"critical_depth_mm": 0.1},
    "run": {"life_tolerance": 0.1},
}
GEARS = {
    "format_version": 1,
    "gear": {"module_mm": 3.0, "pinion_teeth": 20, "wheel_teeth": 36, "face_width_mm": 20.0, "nodes": 51},
    "load": {"torque_N_m": 60.0, "speed_rpm": 500.0},
    "wear": {"specific_wear_rate_mm2_per_N": 1e-9},
    "stop": {"critical_depth_mm": 0.02},
    "run": {"life_tolerance": 1e-5},
}


@pytest.fixture(autouse=True, scope="module")
def laws(catalogue_as_before):
    """Archard's law and others as functions of the test."""
    wearsim.wear_law("archard of ours", lambda p, q, v, s, k: k * p, {"k": 1e-10}, source="test")
    wearsim.wear_law(
        "power of ours", lambda p, q, v, s, K, m: K * p**m, {"K": 1e-10, "m": (0.5, 1.0, 5.0)}, source="test"
    )
    wearsim.wear_law(
        "drozdov of ours",
        lambda p, q, v, s, K, m, n: K * (p / 500.0) ** m * (v / 100.0) ** n,
        {"K": 1e-7, "m": (0.5, 1.5, 3.0), "n": 0.2},
        source="test",
    )


def mean_pressure_factor(m):
    """Mean of (1 - u^2)^(m/2) over half a width."""
    return 0.5 * math.sqrt(math.pi) * math.gamma(1.0 + 0.5 * m) / math.gamma(1.5 + 0.5 * m)


def flat(column, value, wear):
    """A flat under one load, slid over by one path or with one slip ratio."""
    rows = np.ones(21)
    table = {
        "arc_length_mm": np.linspace(0.0, 10.0, 21),
        "load_per_width_N_per_mm": LOAD * rows,
        "flank_curvature_per_mm": 0.0 * rows,
        column: value * rows,
    }
    steel = {"youngs_modulus_MPa": 2.1e5, "poissons_ratio": 0.3}
    return wearsim.load_case(
        {
            "format_version": 1,
            "chain": {"pitch_mm": 25.4, "roller_diameter_mm": 2.0 * RADIUS, "inner_width_mm": 17.0},
            "material": {"sprocket": steel, "roller": steel},
            "mechanism": {"kind": "prescribed", "table_file": table},
            "load": {"speed_rpm": 100},
            "wear": wear,
            "stop": {"critical_depth_mm": DEPTH},
            "run": {"life_tolerance": 1e-6},
        }
    )


@pytest.mark.parametrize("m", EXPONENTS)
def test_power_law_over_a_given_path(m):
    constants = {"K": COEFFICIENT[m], "m": m}
    case = flat("sliding_distance_mm", PATH, {"law": "power of ours", "constants": constants})
    cycles = DEPTH / (COEFFICIENT[m] * PRESSURE**m * PATH)
    assert wearsim.simulate(case).life.cycles == pytest.approx(cycles, rel=1e-6)


@pytest.mark.parametrize("m", EXPONENTS)
def test_power_law_in_a_contact_that_travels(m):
    constants = {"K": COEFFICIENT[m], "m": m}
    case = flat("slip_ratio", SLIP, {"law": "power of ours", "constants": constants})
    swept = mean_pressure_factor(m) * 4.0 * LOAD / (math.pi * PRESSURE)
    cycles = DEPTH / (COEFFICIENT[m] * PRESSURE**m * SLIP * swept)
    assert wearsim.simulate(case).life.cycles == pytest.approx(cycles, rel=1e-6)


def test_archard_is_k_q_slip():
    case = flat("slip_ratio", SLIP, {"law": "archard of ours", "constants": {"k": 3e-10}})
    cycles = DEPTH / (3e-10 * LOAD * SLIP)
    assert wearsim.simulate(case).life.cycles == pytest.approx(cycles, rel=1e-6)


def test_on_a_strand_it_wears_as_the_law_of_the_catalogue():
    case = wearsim.load_case(STRAND)
    given = {
        "law": "drozdov",
        "coefficient": 1e-7,
        "pressure_exponent": 1.5,
        "hardness_MPa": 500.0,
        "reference_speed_mm_per_s": 100.0,
        "speed_exponent": 0.2,
    }
    same = wearsim.load_case({**STRAND, "wear": given})
    own, known = wearsim.simulate(case), wearsim.simulate(same)
    assert own.life.cycles == pytest.approx(known.life.cycles, rel=1e-6)
    np.testing.assert_allclose(own.flank.depth_mm, known.flank.depth_mm, rtol=1e-5, atol=1e-9)
    np.testing.assert_allclose(own.flank.pressure_MPa, known.flank.pressure_MPa, rtol=1e-5)


def test_on_gears_it_wears_both_flanks():
    known = wearsim.simulate(wearsim.load_case(GEARS))
    wear = {"law": "archard of ours", "constants": {"k": 1e-9}}
    own = wearsim.simulate(wearsim.load_case({**GEARS, "wear": wear}))
    assert own.life.cycles == pytest.approx(known.life.cycles, rel=1e-6)
    assert own.flank.wheel_depth_mm.max() == pytest.approx(known.flank.wheel_depth_mm.max(), rel=1e-5)


def test_many_cases_have_the_lives_of_each_alone():
    case = wearsim.load_case(STRAND)
    cases = [case, case.with_({"wear.constants.m": 2.0}), case.with_({"wear.coefficient": 2.0})]
    found = [one.life for one in wearsim.simulate_many(cases)]
    assert found == [wearsim.simulate(one).life for one in cases]
    assert found[2].cycles == pytest.approx(0.5 * found[0].cycles)


def test_calibrate_finds_the_constants_that_readings_were_made_with():
    case = wearsim.load_case(STRAND)
    worn = wearsim.simulate(case.with_({"wear.coefficient": 1.7, "wear.constants.m": 1.2})).history
    rows = [
        {"time_hours": hours, "quantity": "max_depth_mm", "value": depth, "error": 1e-5}
        for hours, depth in zip(worn.time_hours[10::20], worn.max_depth_mm[10::20], strict=True)
    ]
    found = wearsim.calibrate(case, rows, fit=["wear.constants.m"]).values.set_index("key")
    assert found.value["wear.coefficient"] == pytest.approx(1.7, rel=5e-3)
    assert found.value["wear.constants.m"] == pytest.approx(1.2, rel=5e-3)
    assert (found.low < found.value).all()


def test_its_constants_scatter():
    """Half of the drives have an exponent below its median, and pressures here are above 500 MPa."""
    scatter = {
        "wear.constants.m": {"distribution": "normal", "mean": 1.5, "standard_deviation": 0.1},
        "wear.coefficient": {"distribution": "lognormal", "sigma_ln": 1e-6},
    }
    case = wearsim.load_case(STRAND)
    lives = wearsim.uncertainty(case, scatter, samples=8)
    assert lives.samples["wear.constants.m"].std() == pytest.approx(0.1, rel=0.4)
    order = lives.samples.sort_values("wear.constants.m").life_hours.to_numpy()
    assert (np.diff(order) != 0.0).all()
    assert abs(np.sign(np.diff(order)).sum()) == order.size - 1
