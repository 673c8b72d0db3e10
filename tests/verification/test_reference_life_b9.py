"""Benchmark B9: life of an arc under local Hertz contact with a given sliding distance.

Flank radius 39.1 mm, length 6 mm, roller 6.035 mm, q = 100 (0.2 + 0.8 cos(pi u/2)),
s = 0.05 + 0.4 u mm, k = 1e-10 mm2/N, depth 0.5 mm. Expected lives: two independent programs
with the rounded Hertz coefficient 0.418 (26 114 833.8 at K = 200 points, 26 114 900.2
at K = 500), so the exact coefficient shortens them by 0.418/0.4182051.
"""

import math
from collections.abc import Callable, Sequence

import numpy as np
import pytest

import wearsim

CaseMaker = Callable[..., wearsim.Case]

EXACT = 0.418 / math.sqrt(1.0 / (2.0 * math.pi * (1.0 - 0.3**2)))


def life(
    prescribed: CaseMaker, points: int, tolerance: float, overrides: Sequence[str] = ()
) -> wearsim.WearResult:
    u = np.linspace(0.0, 1.0, points)
    case = prescribed(
        {
            "arc_length_mm": 6.0 * u,
            "load_per_width_N_per_mm": 100.0 * (0.2 + 0.8 * np.cos(0.5 * np.pi * u)),
            "flank_curvature_per_mm": 1.0 / 39.1,
            "sliding_distance_mm": 0.05 + 0.4 * u,
        },
        {"law": "archard", "specific_wear_rate_mm2_per_N": 1e-10},
        0.5,
        6.035,
        [f"run.life_tolerance={tolerance}", *overrides],
    )
    return wearsim.simulate(case)


@pytest.mark.parametrize("points", [200, 500])
def test_life_of_the_benchmark(prescribed: CaseMaker, points: int) -> None:
    assert life(prescribed, points, 1e-3).cycles == pytest.approx(26_102_090, rel=1e-4)


@pytest.mark.parametrize(("points", "rounded"), [(200, 26_114_833.8), (500, 26_114_900.2)])
def test_life_to_all_published_digits(prescribed: CaseMaker, points: int, rounded: float) -> None:
    result = life(prescribed, points, 1e-6)
    assert result.cycles == pytest.approx(rounded * EXACT, rel=1e-8)


def test_cycle_by_cycle_updates_converge_on_it(prescribed: CaseMaker) -> None:
    """Explicit updates of 1000 and 500 cycles approach the life linearly from one side."""
    per_cycle = "run.method=per_cycle"
    lives = [
        life(prescribed, 200, 1e-4, [per_cycle, f"run.cycles_per_update={cycles}"]).cycles
        for cycles in (1000, 500)
    ]
    extrapolated = 2.0 * lives[1] - lives[0]
    assert extrapolated == pytest.approx(26_114_833.8 * EXACT, rel=1e-7)
