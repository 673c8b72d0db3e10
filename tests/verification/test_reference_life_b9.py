"""Benchmark B9: life of an arc under local Hertz contact with a given sliding distance.

Expected lives: two independent programs
with the rounded Hertz coefficient 0.418 (26 114 833.8 at K = 200 points, 26 114 900.2
at K = 500), so the exact coefficient shortens them by 0.418/0.4182051.
"""

import math
from collections.abc import Callable, Sequence

import pytest

import wearsim

CaseMaker = Callable[..., wearsim.Case]

EXACT = 0.418 / math.sqrt(1.0 / (2.0 * math.pi * (1.0 - 0.3**2)))


def life(b9: CaseMaker, points: int, tolerance: float, overrides: Sequence[str] = ()) -> wearsim.WearResult:
    return wearsim.simulate(b9(points, f"run.life_tolerance={tolerance}", *overrides))


@pytest.mark.parametrize("points", [200, 500])
def test_life_of_the_benchmark(b9: CaseMaker, points: int) -> None:
    assert life(b9, points, 1e-3).cycles == pytest.approx(26_102_090, rel=1e-4)


@pytest.mark.parametrize(("points", "rounded"), [(200, 26_114_833.8), (500, 26_114_900.2)])
def test_life_to_all_published_digits(
    validated: Callable[..., None], b9: CaseMaker, points: int, rounded: float
) -> None:
    result = life(b9, points, 1e-6)
    source = "two independent programs, every cycle"
    quantity = f"life of an arc, {points} points"
    shown = points == 500
    validated(quantity, result.cycles, rounded * EXACT, 1e-8, source, "cycles", page=shown)


def test_cycle_by_cycle_updates_converge_on_it(validated: Callable[..., None], b9: CaseMaker) -> None:
    """Explicit updates of 1000 and 500 cycles approach the life linearly from one side."""
    per_cycle = "run.method=per_cycle"
    lives = [
        life(b9, 200, 1e-4, [per_cycle, f"run.cycles_per_update={cycles}"]).cycles for cycles in (1000, 500)
    ]
    extrapolated = 2.0 * lives[1] - lives[0]
    validated(
        "life of an arc, 200 points, cycle by cycle, extrapolated",
        *(extrapolated, 26_114_833.8 * EXACT, 1e-7, "two independent programs", "cycles"),
    )
