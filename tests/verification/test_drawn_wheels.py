"""Drawn wheels that are not what they should be: what is told of them is what was done to an exact one.

The exact one has the gaps of ISO 606; it is then stretched, moved, rounded or opened by a known length.
"""

import math
import re
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest

import wearsim
from wearsim.errors import CaseError, GeometryError
from wearsim.geometry.forms.iso606 import iso606_gap
from wearsim.geometry.measured.dxf_outline import DrawnGap, outline_from_dxf
from wearsim.mechanisms.wrap.tooth_loads import tooth_loads

PITCH, ROLLER, TEETH = 12.7, 8.51, 20
STEP = 2.0 * math.pi / TEETH
CASE = {
    "format_version": 1,
    "title": "Half-inch chain, 20 teeth",
    "chain": {"designation": "08B-1"},
    "mechanism": {"kind": "wrap"},
    "drive": {"mate_teeth": 38, "links": 100},
    "load": {"power_kW": 0.5, "speed_rpm": 100},
    "wear": {"condition": "hardened, oiled"},
}


def gap_points(count: int) -> np.ndarray:
    outline = iso606_gap(PITCH, ROLLER, TEETH).outline(count)
    return np.column_stack([outline.x, outline.y])


def turned(points: np.ndarray, angle: float) -> np.ndarray:
    cosine, sine = math.cos(angle), math.sin(angle)
    return points @ np.array([[cosine, sine], [-sine, cosine]])


def pieces(count: int = 121) -> list[np.ndarray]:
    """Flank, seat, flank and tip land of every gap, all around."""
    gap = gap_points(count)
    third = count // 3
    cuts = [gap[: third + 1], gap[third : 2 * third + 1], gap[2 * third :]]
    land = np.array([gap[-1], turned(gap[:1], STEP)[0]])
    return [turned(part, i * STEP) for i in range(TEETH) for part in (*cuts, land)]


def ring(count: int = 121, turn: float = 0.0) -> np.ndarray:
    return turned(np.concatenate([part[:-1] for part in pieces(count)]), turn)


def saved(path: Path, *polylines: np.ndarray, closed: bool = True, bore: Any = None, unit: int = 4) -> Path:
    drawing = ezdxf.new(units=unit)
    for points in polylines:
        drawing.modelspace().add_lwpolyline(points, close=closed)
    if bore is not None:
        drawing.modelspace().add_circle(bore, 10.0)
    drawing.saveas(path)
    return path


def drawn(path: Path, *polylines: np.ndarray, tolerance: float = 1e-3, **keys: Any) -> DrawnGap:
    return outline_from_dxf(saved(path, *polylines, **keys), TEETH, tolerance=tolerance)


def first_tooth(sprocket: dict[str, object]) -> tuple[float, tuple[str, ...]]:
    case = wearsim.load_case(CASE | {"sprocket": {"teeth": TEETH, **sprocket}})
    return float(tooth_loads(case).loads.force[0]), case.warnings


def told(texts: list[str], pattern: str) -> float:
    """The number that a text tells."""
    (found,) = {match[1] for text in texts if (match := re.search(pattern, text))}
    return float(found)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "wheel.dxf"


@pytest.mark.parametrize("stretched", [0.0, 5e-6, 2e-4, 1e-3, 0.02])
def test_an_oval_is_told(path: Path, stretched: float) -> None:
    """Along x by one part more and along y by one less: the seats at 36 mm go up and down by 36 of these."""
    points = ring() * [1.0 + stretched, 1.0 - stretched]
    bottom = stretched * float(np.hypot(*gap_points(121).T).min())
    if bottom > 0.075:
        with pytest.raises(GeometryError, match="only round wheels of equal gaps are computed") as refused:
            drawn(path, points)
        assert told([str(refused.value)], r"by up to ([\d.]+) mm in shape") == pytest.approx(bottom, rel=0.06)
        return
    found = drawn(path, points)
    assert len(found.warnings) == (bottom > 2e-3)
    if found.warnings:
        shape = told(found.warnings, r"by up to ([\d.]+) mm in shape")
        assert shape == pytest.approx(bottom, rel=0.06)


@pytest.mark.wide
@pytest.mark.parametrize("off", [5e-4, 0.03, 0.3, 3.0])
@pytest.mark.parametrize("bored", [True, False])
def test_teeth_off_their_axis_are_told(path: Path, off: float, bored: bool) -> None:
    points, bore = ring() + np.array([off, 0.0]), (0.0, 0.0) if bored else None
    if bored and off > 0.075:
        with pytest.raises(GeometryError, match=f"{off:g} mm from the bore: only round wheels are computed"):
            drawn(path, points, bore=bore)
        return
    found = drawn(path, points, bore=bore)
    name = "the bore" if bored else "the origin"
    assert [f"{off:g} mm from {name}" in text for text in found.warnings] == [True] * (off > 1e-3)
    if off > 1e-3:
        assert np.abs(found.points - drawn(path, ring()).points).max() < 1e-6


def test_a_wheel_that_is_drawn_elsewhere_with_its_bore_is_not_doubted(path: Path) -> None:
    for x, y in ((300.0, -40.0), (5.0, 0.0)):
        found = drawn(path, ring() + np.array([x, y]), bore=(x, y))
        assert found.warnings == []
        assert any("moved to the origin" in note for note in found.notes)


@pytest.mark.parametrize("error", [1e-4, 5e-4, 1.5e-3, 5e-3])
def test_a_tooth_gap_out_of_its_place_is_told(path: Path, error: float) -> None:
    """One gap turned by an angle lies 19/20 of it beside the even spacing, along the tip circle."""
    gaps = [turned(gap_points(121), i * STEP + (error if i == 7 else 0.0)) for i in range(TEETH)]
    beside = (1.0 - 1.0 / TEETH) * error * float(np.hypot(*gaps[0][0]))
    if beside > 0.075:
        with pytest.raises(GeometryError, match=r"most the one 126(\.\d+)? degrees from \+y"):
            drawn(path, np.concatenate(gaps))
        return
    found = drawn(path, np.concatenate(gaps))
    assert len(found.warnings) == (beside > 1e-2)
    texts = [*found.notes, *found.warnings]
    assert told(texts, r"([\d.]+) mm in spacing") == pytest.approx(beside, rel=0.03)


@pytest.mark.parametrize("single", [False, True], ids=["wheel", "gap"])
@pytest.mark.parametrize(
    ("step", "unit", "told_step"),
    [(0.1, 4, 0.1), (0.05, 4, 0.05), (0.01, 4, 0.01), (0.001, 4, None), (0.001, 1, 0.0254), (1e-5, 1, None)],
)
def test_rounded_coordinates_are_told(
    path: Path, single: bool, step: float, unit: int, told_step: float | None
) -> None:
    """In the unit of the drawing: thousandths of an inch are coarse, thousandths of a millimetre are not."""
    factor = 25.4 if unit == 1 else 1.0
    points = gap_points(121) if single else ring(121, 0.1)
    rounded = np.round(points / factor / step) * step
    found = drawn(path, rounded, closed=not single, unit=unit)
    text = f"multiples of {told_step:g} mm" if told_step else "multiples"
    assert [text in one for one in found.warnings] == [True] * bool(told_step)


def test_what_is_not_doubted_keeps_the_force_of_the_first_tooth(path: Path) -> None:
    exact, _ = first_tooth({"profile": "iso606"})
    assert exact == pytest.approx(713.0, abs=0.05)
    keys: dict[str, object] = {"profile": "dxf", "dxf_file": str(path)}
    for step in (1e-3, 1e-5):
        saved(path, np.round(ring(121, 0.1) / step) * step)
        force, warnings = first_tooth(keys)
        assert force == pytest.approx(exact, rel=0.02)
        assert not any("drawing" in text for text in warnings)
    saved(path, np.round(ring(61, 0.123) / 0.1) * 0.1)
    force, warnings = first_tooth(keys)
    assert 0.02 < abs(force / exact - 1.0) < 0.3
    assert any("can change the force of the first tooth" in text for text in warnings)


@pytest.mark.parametrize(
    ("decimals", "noise", "doubted"), [(2, None, True), (2, 0.01, False), (4, None, False)]
)
def test_rounded_points_are_told_unless_their_error_is_given(
    tmp_path: Path, decimals: int, noise: float | None, doubted: bool
) -> None:
    file = tmp_path / "gap.csv"
    form = f"%.{decimals}f"
    np.savetxt(file, gap_points(121), form, delimiter=",", header="x_mm,y_mm", comments="")
    keys = {"points_noise_mm": noise} if noise else {}
    _, warnings = first_tooth({"profile": "points", "points_file": str(file), **keys})
    assert any("multiples of 0.01 mm" in text for text in warnings) == doubted


def test_points_that_no_smooth_outline_passes_are_told(path: Path) -> None:
    """Steps of 0.1 mm rounded to 0.1 mm turn by 45 degrees at every second one."""
    saved(path, np.round(ring(241) / 0.1) * 0.1)
    with pytest.raises(CaseError, match=r"turn sharply at \d+ places: give points as exact as 0.001 mm"):
        first_tooth({"profile": "dxf", "dxf_file": str(path)})


@pytest.mark.parametrize("apart", [1.5e-3, 6e-3, 0.04])
def test_open_joints_are_told_and_joined_by_the_key(path: Path, apart: float) -> None:
    """Every second piece moved out: open at both of its ends, by as much."""
    parts = [part * (1.0 + (i % 2) * apart / np.hypot(*part[0])) for i, part in enumerate(pieces())]
    with pytest.raises(GeometryError, match="is open at 80 places, the widest: from") as refused:
        drawn(path, *parts, closed=False)
    assert told([str(refused.value)], r"mm, ([\d.]+) mm apart: join") == pytest.approx(apart, rel=0.1)
    assert "more teeth" not in str(refused.value)
    tolerance = told([str(refused.value)], r"set sprocket\.dxf_join_tolerance_mm = ([\d.]+)$")
    found = drawn(path, *parts, closed=False, tolerance=tolerance)
    bare = min(np.hypot(*(found.points - at).T).min() for at in gap_points(31)[3:-3])
    assert bare < apart
    assert any("80 open places of up to" in text for text in [*found.notes, *found.warnings])
    with pytest.raises(GeometryError, match="is open at"):
        drawn(path, *parts, closed=False, tolerance=0.8 * apart)


@pytest.mark.parametrize("missing", [0, 1, 2, 3], ids=["right flank", "seat", "left flank", "land"])
def test_a_missing_piece_is_told_by_its_ends(path: Path, missing: int) -> None:
    parts = pieces()
    lost = parts.pop(20 + missing)
    with pytest.raises(GeometryError, match="is open at 1 place: from") as refused:
        drawn(path, *parts, closed=False, bore=(0.0, 0.0))
    apart = math.dist(lost[0], lost[-1])
    assert f"{apart:.3g} mm apart: draw what is missing there" in str(refused.value)
    for end in (lost[0], lost[-1]):
        x, y = end.round(4).tolist()
        assert f"({x:g}, {y:g})" in str(refused.value)


@pytest.mark.parametrize("apart", [3e-3, 0.05])
@pytest.mark.parametrize("where", [20, 60, 115], ids=["right flank", "seat", "near the tip"])
def test_a_gap_drawn_alone_that_is_open_is_told(path: Path, where: int, apart: float) -> None:
    gap = gap_points(121)
    with pytest.raises(GeometryError, match="outline of the gap must be closed, but is open at 1") as it:
        drawn(path, gap[:where], gap[where - 1 :] + np.array([apart, 0.0]), closed=False)
    assert f"{apart:.3g} mm apart: join the ends" in str(it.value)


@pytest.mark.parametrize("first", [(0, 30), (40, 79)])
def test_a_part_of_a_wheel_is_open(path: Path, first: tuple[int, int]) -> None:
    part = np.concatenate([one[:-1] for one in pieces()[slice(*first)]])
    apart = math.dist(part[0], part[-1])
    with pytest.raises(GeometryError, match=rf"open .*{apart:.3g} mm apart"):
        drawn(path, part, closed=False)


def test_a_gap_that_ends_half_way_up_is_none(path: Path) -> None:
    with pytest.raises(GeometryError, match="must be drawn, but there are 0 closed outlines"):
        drawn(path, gap_points(121)[:95], closed=False)
