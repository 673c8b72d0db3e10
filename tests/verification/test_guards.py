"""A wrong life is never returned in silence: any step, any grid.

Limits from the stability of the explicit scheme, depth per update <= ds^2/(2 e rho_H); orders and
errors against far finer grids.
"""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import wearsim
from wearsim.drive.part_life import verify_grid
from wearsim.errors import WearsimError

CaseMaker = Callable[..., wearsim.Case]

STRAND: dict[str, Any] = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "sprocket": {"teeth": 20, "profile": "evolute", "evolute_offset_mm": 5.5, "nodes": 61},
    "load": {"tension_N": 5000, "speed_rpm": 100},
    "wear": {"law": "power", "coefficient": 5e-11, "pressure_exponent": 1.0},
    "stop": {"critical_depth_mm": 0.2},
}


def strand(exponent: float, *settings: str) -> wearsim.Case:
    coefficient = 5e-11 / 800.0 ** (exponent - 1.0)
    law = (f"wear.pressure_exponent={exponent}", f"wear.coefficient={coefficient}")
    return wearsim.load_case(STRAND, [*law, *settings])


def right_or_refused(case: Callable[..., wearsim.Case], stable: float, factor: float) -> None:
    """The life with updates of so many times the stable cycles is right, or the run raises."""
    cycles = max(1, round(factor * stable))
    expected = wearsim.simulate(case()).life.cycles
    try:
        result = wearsim.simulate(case("run.method=per_cycle", f"run.cycles_per_update={cycles}"))
    except WearsimError:
        assert factor > 0.3
        return
    assert result.life.cycles == pytest.approx(expected, rel=0.01)


FACTORS = [0.05, 0.2, 0.8, 0.95, 1.05, 1.3, 2.0, 5.0, 30.0, 1000.0]


@pytest.mark.parametrize("factor", FACTORS)
def test_any_step_on_the_benchmark_is_right_or_refused(b9: CaseMaker, factor: float) -> None:
    """At 100 points ds = 6/99 mm, e = 1/2; the fastest point at first fixes the stable cycles."""
    u = np.linspace(0.0, 1.0, 100)
    load = 100.0 * (0.2 + 0.8 * np.cos(0.5 * np.pi * u))
    relative = 1.0 / 6.035 + 1.0 / 39.1
    modulus = 2.1e5 / (2.0 * (1.0 - 0.3**2))
    rate = 1e-10 * np.sqrt(load * modulus * relative / np.pi) * (0.05 + 0.4 * u)
    stable = float((6.0 / 99.0) ** 2 * relative / rate.max())
    right_or_refused(lambda *settings: b9(100, *settings), stable, factor)


@pytest.mark.wide
@pytest.mark.parametrize("factor", FACTORS)
@pytest.mark.parametrize("exponent", [1.0, 2.0])
def test_any_step_on_the_strand_is_right_or_refused(exponent: float, factor: float) -> None:
    """The stable cycles as the refusal itself proposes them for a hopeless step."""
    with pytest.raises(WearsimError, match="take cycles_per_update = ") as caught:
        wearsim.simulate(strand(exponent, "run.method=per_cycle", "run.cycles_per_update=1000000"))
    stable = int(str(caught.value).split("take cycles_per_update = ")[1].split()[0])
    right_or_refused(lambda *settings: strand(exponent, *settings), float(stable), factor)


def test_order_on_the_benchmark(b9: CaseMaker) -> None:
    """Depth in the middle of the flank after 2e7 cycles; the deepest point hops from node to node."""
    depths = []
    for points in (33, 65, 129):
        cycles = ("load.speed_rpm=166666.666666666667", "stop.critical_depth_mm=2")
        case = b9(points, "run.life_tolerance=1e-6", "run.horizon_hours=2", *cycles)
        result = wearsim.simulate(case)
        assert result.cycles_run == pytest.approx(2e7, rel=1e-12)
        depths.append(result.flank_columns["depth_mm"][-points + points // 2])
    coarse, fine = np.diff(depths)
    assert math.log2(coarse / fine) >= 1.9


def test_richardson_error_is_the_true_one(prescribed: CaseMaker) -> None:
    """A symmetric load that fades to the ends: the deepest point is a node of every grid."""

    def symmetric(points: int) -> wearsim.Case:
        u = np.linspace(0.0, 1.0, points)
        return prescribed(
            {
                "arc_length_mm": 6.0 * u,
                "load_per_width_N_per_mm": 100.0 * np.sin(np.pi * u) ** 4,
                "flank_curvature_per_mm": 1.0 / 39.1,
                "sliding_distance_mm": 0.25,
            },
            {"law": "archard", "specific_wear_rate_mm2_per_N": 1e-10},
            0.5,
            6.035,
            ["run.life_tolerance=1e-5"],
        )

    grid = verify_grid(symmetric(65))
    assert grid.points == (65, 33, 17)
    assert 1.9 <= grid.order <= 2.1 and grid.extrapolates
    true = abs(grid.values[0] / wearsim.simulate(symmetric(513)).life.cycles - 1.0)
    assert grid.error == pytest.approx(true, rel=0.1)


def test_no_extrapolation_on_the_strand() -> None:
    """Its ramps have kinks: the order is none, the spread of three grids bounds the error."""
    grid = verify_grid(strand(1.0, "sprocket.nodes=101"))
    fine = verify_grid(strand(1.0, "sprocket.nodes=401"))
    assert not grid.extrapolates
    assert abs(grid.values[0] / fine.values[0] - 1.0) <= grid.error


@pytest.mark.parametrize("exponent", [1.0, 2.0])
def test_life_on_the_strand_hardly_depends_on_the_nodes(exponent: float) -> None:
    lives = [
        wearsim.simulate(strand(exponent, f"sprocket.nodes={nodes}")).life.cycles for nodes in (101, 201, 401)
    ]
    assert max(lives) - min(lives) < 2e-4 * lives[-1]


def test_a_solve_that_takes_too_much_memory_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """8 rows of 201 points of 8 bytes are 12 864 a step: 7 steps in 1e5 bytes, too few for any life."""
    monkeypatch.setattr("wearsim.wear.solve._MOST_BYTES", 1e5)
    with pytest.raises(WearsimError, match=r"within 7 steps.*larger run\.life_tolerance, or fewer nodes"):
        wearsim.simulate(strand(1.0, "sprocket.nodes=201", "run.life_tolerance=1e-5"))
