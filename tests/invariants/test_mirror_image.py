"""A drive and its mirror image live equally long.

Expected: the same life; a prescribed flank is mirrored by reading its rows backwards, a flank
of points by changing the sign of x.
"""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import wearsim
from wearsim.geometry.forms.evolute import Strand

TABLES: dict[str, Any] = {
    "format_version": 1,
    "chain": {"pitch_mm": 25.4, "roller_diameter_mm": 15.88, "inner_width_mm": 17.02},
    "load": {"speed_rpm": 100},
    "wear": {"law": "power", "coefficient": 1e-11, "pressure_exponent": 2},
    "stop": {"critical_depth_mm": 0.2},
    "run": {"life_tolerance": 1e-5, "horizon_hours": 1e7},
}


def write(file: Path, columns: dict[str, np.ndarray]) -> str:
    rows = np.column_stack(list(columns.values())).tolist()
    lines = [",".join(columns), *(",".join(map(repr, row)) for row in rows)]
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return str(file)


@pytest.mark.parametrize("column", ["slip_ratio", "sliding_distance_mm"])
@pytest.mark.parametrize(("method", "within"), [("per_cycle", 1e-9), ("advance", 1e-6)])
def test_prescribed_rows_backwards(tmp_path: Path, column: str, method: str, within: float) -> None:
    """Without step control to rounding, with it to a tenth of the asked tolerance."""
    u = np.linspace(0.0, 1.0, 61) ** 1.2
    columns = {
        "arc_length_mm": 8.0 * u,
        "load_per_width_N_per_mm": 100.0 + 80.0 * u,
        "flank_curvature_per_mm": -0.04 + 0.03 * u,
        column: 0.2 + 0.1 * np.sin(3.0 * u),
    }
    backwards = {name: values[::-1] for name, values in columns.items()}
    backwards["arc_length_mm"] = 8.0 - backwards["arc_length_mm"]
    results = []
    for name, table in (("run.csv", columns), ("mirror.csv", backwards)):
        mechanism = {"kind": "prescribed", "table_file": write(tmp_path / name, table)}
        case = wearsim.load_case(
            {**TABLES, "mechanism": mechanism}, [f"run.method={method}", "wear.coefficient=1e-9"]
        )
        results.append(wearsim.simulate(case))
    first, mirror = results
    assert mirror.cycles == pytest.approx(first.cycles, rel=within)
    assert mirror.max_depth_arc_length == pytest.approx(8.0 - first.max_depth_arc_length, abs=1e-9)
    area = [result.history_columns["removed_area_mm2"][-1] for result in results]
    assert area[1] == pytest.approx(area[0], rel=max(within, 1e-6))


def test_points_on_the_other_side_of_the_gap(tmp_path: Path) -> None:
    strand = Strand(25.4 * 20 / (2.0 * np.pi), 7.94, 5.5)
    x, y = strand.conjugate_points(np.linspace(4.0, 30.67, 200)).T
    lives = []
    for name, sign in (("left.csv", 1.0), ("right.csv", -1.0)):
        sprocket = {
            "teeth": 20,
            "profile": "points",
            "points_file": write(tmp_path / name, {"x_mm": sign * x, "y_mm": y}),
            "evolute_offset_mm": 5.5,
            "face_width_mm": 17.0,
        }
        case = wearsim.load_case(
            {**TABLES, "sprocket": sprocket, "load": {"tension_N": 5000, "speed_rpm": 100}}
        )
        lives.append(wearsim.simulate(case).cycles)
    assert lives[1] == pytest.approx(lives[0], rel=1e-9)
