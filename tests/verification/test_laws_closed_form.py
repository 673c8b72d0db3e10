"""Life of a flank of constant load, curvature and slip, against the closed form of each law.

Uniform wear leaves the curvature of relative motion w'' = 0, so the depth per cycle I is
constant and the life is depth / I:
travelling contact I = K c_m sigma^m (v/v0)^n 2a lambda, local contact I = K sigma^m (v/v0)^n s,
sigma = sqrt(q E*/(pi rho)), a = sqrt(4 q rho/(pi E*)), c_m by quadrature in this test.
"""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad

import wearsim
from wearsim.wear.law import mean_pressure_factor

CaseMaker = Callable[..., wearsim.Case]

LOAD, FLANK_RADIUS, ROLLER, SPEED = 100.0, 39.1, 6.035, 700.0
MODULUS = 2.1e5 / (2.0 * 0.91)
RELATIVE = 1.0 / ROLLER + 1.0 / FLANK_RADIUS
SIGMA = math.sqrt(LOAD * MODULUS * RELATIVE / math.pi)
HALF_WIDTH = math.sqrt(4.0 * LOAD / (math.pi * MODULUS * RELATIVE))
DEPTH = 0.01

LAWS: list[tuple[dict[str, Any], float, float]] = [
    ({"law": "archard", "specific_wear_rate_mm2_per_N": 1e-9}, 1.0, 1e-9),
    ({"law": "power", "coefficient": 1e-9, "pressure_exponent": 1.0}, 1.0, 1e-9),
    ({"law": "power", "coefficient": 1e-10, "pressure_exponent": 1.5}, 1.5, 1e-10),
    ({"law": "power", "coefficient": 1e-12, "pressure_exponent": 2}, 2.0, 1e-12),
    ({"law": "power", "coefficient": 1e-15, "pressure_exponent": 3.3}, 3.3, 1e-15),
    (
        {
            "law": "drozdov",
            "coefficient": 1e-4,
            "pressure_exponent": 1.2,
            "hardness_MPa": 5500.0,
            "reference_speed_mm_per_s": 1000.0,
            "speed_exponent": -0.3,
        },
        1.2,
        1e-4 / 5500.0**1.2 * (SPEED / 1000.0) ** -0.3,
    ),
    (
        {
            "law": "drozdov",
            "coefficient": 1e-5,
            "pressure_exponent": 2,
            "hardness_MPa": 2000.0,
            "reference_speed_mm_per_s": 250.0,
            "speed_exponent": 0.5,
        },
        2.0,
        1e-5 / 2000.0**2 * (SPEED / 250.0) ** 0.5,
    ),
]


def mean_factor(exponent: float) -> float:
    return float(quad(lambda t: math.sin(t) ** (exponent + 1.0), 0.0, 0.5 * math.pi)[0])


@pytest.mark.wide
@pytest.mark.parametrize("method", ["advance", "per_cycle"])
@pytest.mark.parametrize("column", ["slip_ratio", "sliding_distance_mm"])
@pytest.mark.parametrize(("wear", "exponent", "factor"), LAWS)
def test_life_equals_the_closed_form(
    validated: Callable[..., None],
    prescribed: CaseMaker,
    wear: dict[str, Any],
    exponent: float,
    factor: float,
    column: str,
    method: str,
) -> None:
    slip = 0.3
    case = prescribed(
        {
            "arc_length_mm": np.linspace(0.0, 6.0, 31),
            "load_per_width_N_per_mm": LOAD,
            "flank_curvature_per_mm": 1.0 / FLANK_RADIUS,
            column: slip,
            "sliding_speed_mm_per_s": SPEED,
        },
        wear,
        DEPTH,
        ROLLER,
        [f"run.method={method}"],
    )
    path = slip if column == "sliding_distance_mm" else (mean_factor(exponent) * 2.0 * HALF_WIDTH * slip)
    result = wearsim.simulate(case)
    validated(
        f"life by the law {wear['law']}, m = {exponent:g}",
        result.cycles,
        DEPTH / (factor * SIGMA**exponent * path),
        *(1e-9, "closed form at constant load, curvature and slip", "cycles"),
        page=(column, method) == ("slip_ratio", "advance") and exponent in (1.2, 1.5, 3.3),
    )
    assert result.initial_peak_pressure == pytest.approx(SIGMA, rel=1e-12)
    assert result.final_peak_pressure == pytest.approx(SIGMA, rel=1e-6)


@pytest.mark.parametrize("exponent", [0.2, 1.0, 1.5, 2.0, 3.0, 7.5])
def test_mean_pressure_factor_is_the_integral(validated: Callable[..., None], exponent: float) -> None:
    """Integral of (1 - u^2)^(m/2) over 0..1, with u = cos t."""
    validated(
        f"mean of p^m over p0^m, m = {exponent:g}",
        *(mean_pressure_factor(exponent), mean_factor(exponent), 1e-10, "quadrature"),
        page=exponent == 1.5,
    )


@pytest.mark.parametrize(("exponent", "value"), [(0.0, 1.0), (1.0, math.pi / 4), (2.0, 2.0 / 3.0)])
def test_mean_pressure_factor_by_hand(exponent: float, value: float) -> None:
    assert mean_pressure_factor(exponent) == pytest.approx(value, rel=1e-15)


def test_peak_instead_of_mean_pressure_is_27_percent_too_much() -> None:
    assert 1.0 / mean_pressure_factor(1.0) == pytest.approx(1.27, abs=5e-3)
