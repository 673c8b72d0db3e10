"""Lives that must not come out wrong in silence, each from a case that once did."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import wearsim
from wearsim.drive.batch_lives import CaseLife
from wearsim.drive.part_life import verify_grid
from wearsim.drive.simulate import simulate_many
from wearsim.errors import ContactError, ConvergenceError
from wearsim.kernels.roller_locus import distance_to, met_near

STRAND: dict[str, Any] = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "sprocket": {"teeth": 20, "profile": "evolute", "evolute_offset_mm": 5.5, "nodes": 101},
    "load": {"tension_N": 5000, "speed_rpm": 100},
    "wear": {"specific_wear_rate_mm2_per_N": 1e-9},
    "stop": {"critical_depth_mm": 0.1},
}


def table(folder: Path, columns: dict[str, np.ndarray], **tables: Any) -> dict[str, Any]:
    """A table of loads as a case."""
    file = folder / "loads.csv"
    rows = np.column_stack(list(columns.values()))
    np.savetxt(file, rows, "%.15g", ",", header=",".join(columns), comments="")
    return {
        "format_version": 1,
        "chain": {"pitch_mm": 25.4, "roller_diameter_mm": 10.0, "inner_width_mm": 17.0},
        "mechanism": {"kind": "prescribed", "table_file": str(file)},
        "load": {"speed_rpm": 100},
        **tables,
    }


def test_roller_is_stopped_by_a_neck_above_its_pocket() -> None:
    """An arc of radius 1.25 under two points that a roller of 1 cannot pass."""
    angle = np.radians(np.linspace(-70.0, 70.0, 29))
    x = np.concatenate([[-0.998], 1.25 * np.sin(angle), [0.998]])
    y = np.concatenate([[-0.07], -1.25 * np.cos(angle), [-0.07]])
    ray = np.array([0.0, 0.0, 0.0, 1.0])
    ways = np.array([distance_to(x, y, j, ray, 1.0) for j in range(x.size)])
    assert ways.argmin() in (0, x.size - 1)
    assert met_near(x, y, 15, ray, 1.0) == -1


@pytest.mark.wide
@pytest.mark.parametrize("seed", range(20))
def test_nearby_search_never_differs_from_trying_all(seed: int) -> None:
    """Random gaps, undercut or not: either the same place or none."""
    rng = np.random.default_rng(seed)
    angle = np.linspace(-2.0, 2.0, 60) * rng.uniform(0.4, 1.2)
    radius = 1.1 + 0.3 * rng.random() + 0.1 * np.cumsum(rng.normal(0.0, 0.1, 60))
    x, y = radius * np.sin(angle), -radius * np.cos(angle)
    for _ in range(200):
        turn, start = rng.uniform(-1.0, 1.0), int(rng.integers(60))
        ray = np.array([*rng.normal(0.0, 0.3, 2), np.sin(turn), np.cos(turn)])
        found = met_near(x, y, start, ray, 1.0)
        ways = np.array([distance_to(x, y, j, ray, 1.0) for j in range(60)])
        if found >= 0:
            assert distance_to(x, y, found, ray, 1.0) == pytest.approx(ways.min(), abs=1e-9)


def test_flank_that_is_turned_over_is_refused(tmp_path: Path) -> None:
    """Convex with a radius of 0.2 mm, worn evenly to 2 mm: no life, where 46e6 cycles came out."""
    arc = np.linspace(0.0, 1.0, 41)
    columns = {
        "arc_length_mm": arc,
        "load_per_width_N_per_mm": np.full(41, 50.0),
        "flank_curvature_per_mm": np.full(41, 5.0),
        "sliding_distance_mm": np.full(41, 0.5),
    }
    wear, stop = {"specific_wear_rate_mm2_per_N": 1e-10}, {"critical_depth_mm": 2.0}
    case = wearsim.load_case(table(tmp_path, columns, wear=wear, stop=stop, run={"horizon_hours": 1e9}))
    with pytest.raises(ConvergenceError, match="beyond its centre of curvature"):
        wearsim.simulate(case)
    [found] = simulate_many([case])
    assert isinstance(found, ConvergenceError)


@pytest.mark.wide
@pytest.mark.parametrize("factor", [0.2, 8.0, 30.0])
def test_core_far_softer_than_its_layer_wears_on(factor: float) -> None:
    """Against the loop over updates of 20 cycles."""
    settings = [f"wear.core_factor={factor}", "wear.case_depth_mm=0.03", "run.life_tolerance=1e-3"]
    long = wearsim.simulate(wearsim.load_case(STRAND, settings))
    loop = ["run.method=per_cycle", "run.cycles_per_update=20"]
    assert long.life.hours_run == pytest.approx(
        wearsim.simulate(wearsim.load_case(STRAND, [*settings, *loop])).life.hours_run, rel=1e-3
    )


def alternating(folder: Path, **tables: Any) -> dict[str, Any]:
    """A load that is rough from row to row: the depth alternates and the run is refused."""
    arc = np.linspace(0.0, 4.0, 21)
    columns = {
        "arc_length_mm": arc,
        "load_per_width_N_per_mm": 50.0 * (1.0 + 0.03 * (-1.0) ** np.arange(21)),
        "flank_curvature_per_mm": np.zeros(21),
        "sliding_distance_mm": np.full(21, 0.5),
    }
    wear = {"law": "power", "coefficient": 1e-12, "pressure_exponent": 2.0}
    stop, run = {"critical_depth_mm": 0.05}, {"horizon_hours": 1e9}
    return table(folder, columns, **{"wear": wear, "stop": stop, "run": run, **tables})


RUNS_IN = ["wear.running_in_factor=10"]


def refused_at(tables: dict[str, Any], *settings: str) -> float:
    with pytest.raises(ConvergenceError) as error:
        wearsim.simulate(wearsim.load_case(tables, settings))
    return float(str(error.value).split("cycle ")[1].split(",")[0])


@pytest.mark.parametrize("method", [(), ("run.method=per_cycle", "run.cycles_per_update=1")])
def test_errors_name_the_cycles_run(tmp_path: Path, method: tuple[str, ...]) -> None:
    """With running-in a tenth of those of constant coefficient: 10 times the wear at first."""
    tables = alternating(tmp_path)
    slow = refused_at(tables, *method)
    fast = refused_at(tables, *RUNS_IN, "wear.running_in_distance_mm=1e12", *method)
    assert fast == pytest.approx(0.1 * slow, rel=0.02)


def test_rough_table_is_named(tmp_path: Path) -> None:
    """The depth alternates because the load does: fewer cycles per update would not help."""
    with pytest.raises(ConvergenceError, match=r"load times sliding .* smooth the table of loads"):
        wearsim.simulate(wearsim.load_case(alternating(tmp_path)))


@pytest.mark.wide
@pytest.mark.parametrize("exponent", [1.08, 1.15, 1.25])
def test_flank_that_nearly_conforms_is_told(tmp_path: Path, exponent: float) -> None:
    """The pressure that the wear feeds on fades: 1/rho_H falls to 0 without passing it."""
    arc = np.linspace(0.0, 4.0, 41)
    columns = {
        "arc_length_mm": arc,
        "load_per_width_N_per_mm": 50.0 * (0.4 + np.exp(-((arc - 1.6) ** 2))),
        "flank_curvature_per_mm": np.full(41, -0.1998),
        "slip_ratio": np.full(41, 0.5),
    }
    wear = {"law": "power", "coefficient": 1e-12, "pressure_exponent": exponent}
    stop, run = {"critical_depth_mm": 0.4}, {"horizon_hours": 1e12}
    case = wearsim.load_case(table(tmp_path, columns, wear=wear, stop=stop, run=run))
    with pytest.raises(ContactError, match="conforms to the roller"):
        wearsim.simulate(case)


def test_grids_are_compared_at_the_same_time(tmp_path: Path) -> None:
    """A horizon just before the life of the finest: the error is that of the depth then."""
    u = np.linspace(0.0, 1.0, 41)
    columns = {
        "arc_length_mm": 4.0 * u,
        "load_per_width_N_per_mm": 50.0 * (1.0 - np.abs(2.0 * u - 1.0)) + 1.0,
        "flank_curvature_per_mm": np.zeros(41),
        "sliding_distance_mm": np.full(41, 0.5),
    }
    wear = {"law": "power", "coefficient": 1e-12, "pressure_exponent": 2.0}
    tables = table(tmp_path, columns, wear=wear, stop={"critical_depth_mm": 0.02}, run={"horizon_hours": 1e9})
    case = wearsim.load_case(tables)
    whole = verify_grid(case)
    hours = 0.998 * whole.values[0] / 6000.0
    cut = verify_grid(wearsim.load_case(tables, [f"run.horizon_hours={hours!r}"]))
    lives = (max(whole.values) - min(whole.values)) / whole.values[0]
    depths = (max(cut.values) - min(cut.values)) / cut.values[0]
    assert depths > 0.3 * lives


def test_a_horizon_near_the_life_of_another_case_is_its_own() -> None:
    """Cases alike but for their horizons, some within the steps' error of the life."""
    base = wearsim.load_case(STRAND, ["run.life_tolerance=1e-2"])
    hours = wearsim.simulate(base).life.hours_run
    factors = (1.0 - 1e-4, 1.0 - 1e-6, 1.0 + 1e-6, 1.0 + 1e-4, 2.0)
    cases = [base] + [
        wearsim.load_case(STRAND, ["run.life_tolerance=1e-2", f"run.horizon_hours={hours * f!r}"])
        for f in factors
    ]
    for found, case in zip(simulate_many(cases), cases, strict=True):
        assert isinstance(found, CaseLife)
        assert found.life == wearsim.simulate(case).life


def test_lower_bound_of_a_drive_that_runs_in_is_one(tmp_path: Path) -> None:
    """Where the run at the high coefficient fails: what was shown, in cycles of constant wear."""
    tables = alternating(tmp_path)
    runs_in = [*RUNS_IN, f"wear.running_in_distance_mm={0.03 * refused_at(tables)!r}"]
    hours = 0.6 * refused_at(tables, *runs_in) / 6000.0
    case = wearsim.load_case(tables, [*runs_in, f"run.horizon_hours={hours!r}"])
    result = wearsim.simulate(case)
    assert isinstance(result.life_low, wearsim.LowerBound)
    assert any("high end" in text for text in result.warnings)
    # A third of the constant cycles is less than a third of the cycles run.
    assert result.life_low.cycles_run < 0.96 * result.cycles_run / case.wear.high
