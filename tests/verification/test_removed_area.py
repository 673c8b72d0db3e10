"""Removed area of history.csv against the flanks of flank.csv.

Expected: the shoelace area between the first and every later flank, and the time integral of
the wear over the current arc, both worked out here from the saved file alone.
"""

import csv
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

import wearsim

CaseMaker = Callable[..., wearsim.Case]


def read(path: Path) -> dict[str, np.ndarray]:
    with path.open(encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    numbers = [[float(cell or "nan") for cell in row] for row in rows[1:]]
    return dict(zip(rows[0], np.array(numbers).T, strict=True))


@dataclass(frozen=True)
class Saved:
    """Columns of history.csv, and those of flank.csv with a row for every snapshot."""

    history: dict[str, np.ndarray]
    flanks: dict[str, np.ndarray]


@pytest.fixture(scope="module", params=["advance", "per_cycle"])
def saved(
    request: pytest.FixtureRequest, reference: CaseMaker, tmp_path_factory: pytest.TempPathFactory
) -> Saved:
    folder = tmp_path_factory.mktemp("removed_area") / "run"
    wearsim.simulate(reference(1, f"run.method={request.param}")).save(folder)
    flank = read(folder / "flank.csv")
    nodes = int(flank["node"].max())
    return Saved(
        read(folder / "history.csv"), {name: values.reshape(-1, nodes) for name, values in flank.items()}
    )


@pytest.mark.wide
def test_removed_area_is_the_shoelace_area(saved: Saved) -> None:
    x, y = saved.flanks["x_mm"], saved.flanks["y_mm"]
    area = []
    for end_x, end_y in zip(x, y, strict=True):
        u, v = np.append(x[0], end_x[::-1]), np.append(y[0], end_y[::-1])
        area.append(0.5 * (np.sum(u * np.roll(v, -1)) - np.sum(v * np.roll(u, -1))))
    removed = saved.history["removed_area_mm2"]
    np.testing.assert_allclose(removed, area, rtol=0.0, atol=1e-9 * removed[-1])
    assert (np.diff(removed) > 0.0).all()


def test_removed_area_is_the_integral_of_wear_over_the_current_arc(saved: Saved) -> None:
    """Within 1e-4 over the current arc; over the initial arc it is about half a per cent low."""
    x, y, depth = (saved.flanks[name] for name in ("x_mm", "y_mm", "depth_mm"))
    chord = np.hypot(np.diff(x, axis=1), np.diff(y, axis=1))
    cell = np.zeros_like(x)
    cell[:, 1:] += 0.5 * chord
    cell[:, :-1] += 0.5 * chord
    step = np.diff(depth, axis=0)
    removed = saved.history["removed_area_mm2"][-1]
    assert np.sum(step * 0.5 * (cell[1:] + cell[:-1])) == pytest.approx(removed, rel=1e-4)
    assert np.sum(step * cell[0]) / removed - 1.0 == pytest.approx(-0.005, abs=0.003)


def test_no_point_gains_material(saved: Saved) -> None:
    assert (np.diff(saved.flanks["depth_mm"], axis=0) >= 0.0).all()


def test_history_agrees_with_the_flanks(saved: Saved) -> None:
    history = saved.history
    for name, column in (
        ("max_depth_mm", "depth_mm"),
        ("peak_pressure_MPa", "pressure_MPa"),
        ("max_sliding_speed_mm_per_s", "sliding_speed_mm_per_s"),
    ):
        np.testing.assert_array_equal(history[name], np.nanmax(saved.flanks[column], axis=1))
    np.testing.assert_allclose(history["time_hours"], history["cycles"] / 6000.0, rtol=1e-14)
    assert history["cycles"][0] == 0.0
    assert 100 <= history["cycles"].size <= 200


def test_no_sliding_speed_is_said_where_no_roller_touches(saved: Saved) -> None:
    """A roller slides w (l + r) wherever it touches, and nowhere at 0 mm/s."""
    speed, load = saved.flanks["sliding_speed_mm_per_s"], saved.flanks["load_per_width_N_per_mm"]
    assert load[0, 0] == 0.0
    np.testing.assert_array_equal(np.isnan(speed), load == 0.0)
    assert np.nanmin(speed) > 0.0


def test_pressure_of_the_file_is_hertz_of_its_load_and_curvature(saved: Saved) -> None:
    load, relative, pressure = (
        saved.flanks[name]
        for name in ("load_per_width_N_per_mm", "relative_curvature_per_mm", "pressure_MPa")
    )
    modulus = 2.1e5 / (2.0 * 0.91)
    np.testing.assert_allclose(pressure, np.sqrt(load * relative * modulus / np.pi), rtol=1e-12)


@pytest.mark.wide
@pytest.mark.parametrize(
    ("name", "closes"), [("16b-20t-oiled", 1e-4), ("520-15t-wrap", 1e-3), ("hertz-arc-prescribed", 3e-3)]
)
def test_budget_of_a_result_closes(validated: Callable[..., None], name: str, closes: float) -> None:
    """The two areas come from the points and from the wear: shoelace and sum."""
    case = Path(__file__).parents[2] / "cases" / f"{name}.toml"
    result = wearsim.simulate(wearsim.load_case(case, ["run.life_tolerance=0.05"]))
    assert result.removed_area > 0.0
    assert result.worn_area == pytest.approx(result.removed_area, rel=closes)
    columns, points = result.flank_columns, int(result.flank_columns["node"].max())
    x, y = (columns[key].reshape(-1, points) for key in ("x_mm", "y_mm"))
    (first, last) = (np.column_stack([x[i], y[i]]) for i in (0, -1))
    ring = np.vstack([first, last[::-1]])
    shoelace = 0.5 * np.sum(ring[:, 0] * np.roll(ring[:, 1], -1) - np.roll(ring[:, 0], -1) * ring[:, 1])
    quantity, source = f"removed area of {name}", "shoelace formula on its flanks"
    shown = name != "hertz-arc-prescribed"
    validated(quantity, result.removed_area, abs(shoelace), 1e-9, source, "mm2", page=shown)
