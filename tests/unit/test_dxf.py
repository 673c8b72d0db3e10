"""Drawings that cannot be used, and what is said about those that can."""

import math
from collections.abc import Callable
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from ezdxf.document import Drawing

from wearsim.cad.dxf_writer import dxf_drawing
from wearsim.errors import GeometryError
from wearsim.geometry.measured.dxf_outline import outline_from_dxf

Save = Callable[[Drawing], Path]
TEETH = 6


def star(turn: float = 0.0) -> list[tuple[float, float]]:
    """A star of six tips on radius 40 and six roots on radius 20, one of these on +y."""
    angle = 0.5 * math.pi + turn + math.pi / TEETH * np.arange(2 * TEETH)
    radius = np.where(np.arange(2 * TEETH) % 2 == 0, 20.0, 40.0)
    return list(zip(radius * np.cos(angle), radius * np.sin(angle), strict=True))


def moved(points: list[tuple[float, float]], x: float, y: float) -> list[tuple[float, float]]:
    return [(u + x, v + y) for u, v in points]


@pytest.fixture
def drawing() -> Drawing:
    return ezdxf.new(units=4)


@pytest.fixture
def save(tmp_path: Path) -> Save:
    def saved(drawing: Drawing) -> Path:
        path = tmp_path / "drawn.dxf"
        drawing.saveas(path)
        return path

    return saved


def test_gap_of_a_star_ends_below_its_tips(drawing: Drawing, save: Save) -> None:
    drawing.modelspace().add_lwpolyline(star(0.1), close=True)
    points, notes, _ = outline_from_dxf(save(drawing), TEETH)
    assert points[np.hypot(*points.T).argmin()] == pytest.approx((0.0, 20.0), abs=1e-9)
    tip = (40.0 * math.sin(math.pi / TEETH), 40.0 * math.cos(math.pi / TEETH))
    assert points[0] == pytest.approx(tip, abs=2e-3)
    assert points[-1] == pytest.approx((-tip[0], tip[1]), abs=2e-3)
    assert np.hypot(*points[0]) == pytest.approx(40.0 - 1e-3, abs=1e-6)
    assert "5.7296 degrees from +y" in notes[-1]


def test_old_style_polyline_and_lines_give_the_same(drawing: Drawing, save: Save) -> None:
    drawing.modelspace().add_polyline2d(star(), close=True)
    old, *_ = outline_from_dxf(save(drawing), TEETH)
    lines = ezdxf.new(units=4)
    corners = star()
    for a, b in zip(corners, corners[1:] + corners[:1], strict=True):
        lines.modelspace().add_line(a, b)
    new, *_ = outline_from_dxf(save(lines), TEETH)
    np.testing.assert_allclose(old, new, atol=1e-12)


def deeper(depth: float) -> list[tuple[float, float]]:
    """The star with one root deeper, the one on -y; the gap's two sides then turn, the tips stay."""
    corners = star()
    corners[6] = (corners[6][0], corners[6][1] + depth)
    return corners


def aside(depth: float) -> float:
    """How far the mean of the star's gaps, one of them deeper, leaves that one, at the bottom of a gap."""
    half, height = 40.0 * math.sin(math.pi / TEETH), 40.0 * math.cos(math.pi / TEETH) - 20.0
    return (1.0 - 1.0 / TEETH) * depth * math.sin(math.atan2(half, height + depth))


@pytest.mark.parametrize("depth", [0.001, 0.01, 0.05])
def test_a_gap_that_differs_is_told_and_doubted(drawing: Drawing, save: Save, depth: float) -> None:
    drawing.modelspace().add_lwpolyline(deeper(depth), close=True)
    _, notes, warnings = outline_from_dxf(save(drawing), TEETH)
    told = f"by up to {aside(depth):.2g} mm in shape and 0 mm in spacing"
    assert told in notes[-1]
    assert [told in text for text in warnings] == [True] * (aside(depth) > 2e-3)
    assert all("180 degrees from +y" in text for text in warnings)


def test_duplicates_short_edges_and_other_kinds_are_passed_over(drawing: Drawing, save: Save) -> None:
    space = drawing.modelspace()
    corners = star()
    for a, b in zip(corners, corners[1:] + corners[:1], strict=True):
        space.add_line(a, b)
        space.add_line(b, a)
    space.add_line((0.0, 0.0), (1e-5, 0.0))
    space.add_text("wheel")
    points, notes, _ = outline_from_dxf(save(drawing), TEETH)
    assert points.shape[0] > 100
    assert "passed over what is no edge: 1 TEXT" in notes
    assert "13 edges drawn twice or too short: passed over" in notes


def test_open_joints_are_closed_within_the_tolerance(drawing: Drawing, save: Save) -> None:
    corners = star()
    for a, b in zip(corners, corners[1:] + corners[:1], strict=True):
        drawing.modelspace().add_line(a, (b[0], b[1] + 5e-4))
    _, notes, _ = outline_from_dxf(save(drawing), TEETH)
    assert "ends of edges up to 0.0005 mm apart were joined" in notes
    with pytest.raises(GeometryError, match=r"is open at 12 places, .*dxf_join_tolerance_mm = 0\.0005"):
        outline_from_dxf(save(drawing), TEETH, tolerance=1e-4)


def test_spokes_that_end_on_a_polyline_do_not_break_it(drawing: Drawing, save: Save) -> None:
    space = drawing.modelspace()
    space.add_lwpolyline(star(), close=True)
    alone, *_ = outline_from_dxf(save(drawing), TEETH)
    for x, y in star()[1:4]:
        space.add_line((0.0, 0.0), (x, y))
    spoked, *_ = outline_from_dxf(save(drawing), TEETH)
    np.testing.assert_array_equal(spoked, alone)


def test_gap_ends_at_the_near_end_of_a_straight_tip_land(drawing: Drawing, save: Save) -> None:
    """Of every land the right end lies 3e-3 mm higher, as rounded coordinates may have it."""
    angles = np.array([-0.1, 0.1, math.pi / TEETH])
    radii = np.array([40.003, 40.0, 20.0])
    corners = [
        (radius * math.cos(at), radius * math.sin(at))
        for turn in 2.0 * math.pi / TEETH * np.arange(TEETH)
        for radius, at in zip(radii, angles + turn, strict=True)
    ]
    drawing.modelspace().add_lwpolyline(corners, close=True)
    points, notes, _ = outline_from_dxf(save(drawing), TEETH)
    bottom = int(np.hypot(*points.T).argmin())
    assert np.hypot(*points[[0, -1]].T) == pytest.approx([39.999, 40.002], abs=1e-6)
    wide = np.ptp(np.arctan2(points[:, 1], points[:, 0]))
    assert wide == pytest.approx(2.0 * math.pi / TEETH - 0.2, abs=1e-3)
    assert points[bottom] == pytest.approx((0.0, 20.0), abs=0.05)
    assert "differ from their mean by up to 0 mm in shape" in notes[-1]


def test_circles_alone_are_no_wheel(drawing: Drawing, save: Save) -> None:
    drawing.modelspace().add_circle((0.0, 0.0), 30.0)
    with pytest.raises(GeometryError, match=r"1 closed outlines \(with 0 gaps\) and 0 open"):
        outline_from_dxf(save(drawing), TEETH)


def test_layer_is_chosen(drawing: Drawing, save: Save) -> None:
    space = drawing.modelspace()
    corners = star()
    for a, b in zip(corners, corners[1:] + corners[:1], strict=True):
        space.add_line(a, b, dxfattribs={"layer": "Outline"})
    for i in (0, 6):
        space.add_line((0.0, 0.0), star()[i], dxfattribs={"layer": "centre"})
    for layer in ("Outline", "outline"):
        outline_from_dxf(save(drawing), TEETH, layer=layer)
    with pytest.raises(GeometryError, match=r"'teeth' .* holds nothing: .*\(Outline, centre\)"):
        outline_from_dxf(save(drawing), TEETH, layer="teeth")
    with pytest.raises(GeometryError, match=r"more than two edges meet .* such as \("):
        outline_from_dxf(save(drawing), TEETH)


def test_only_the_chosen_layer_must_be_small(drawing: Drawing, save: Save) -> None:
    space = drawing.modelspace()
    space.add_lwpolyline(star(), close=True, dxfattribs={"layer": "outline"})
    for i in range(1001):
        space.add_circle((100.0 + i, 0.0), 0.4, dxfattribs={"layer": "holes"})
    outline_from_dxf(save(drawing), TEETH, layer="outline")
    with pytest.raises(GeometryError, match="at most 1000 circles"):
        outline_from_dxf(save(drawing), TEETH)


def test_wrong_number_of_gaps_is_named(drawing: Drawing, save: Save) -> None:
    drawing.modelspace().add_lwpolyline(star(), close=True)
    with pytest.raises(GeometryError, match=r"with 7 gaps.*1 closed outlines \(with 6 gaps\)"):
        outline_from_dxf(save(drawing), 7)


def test_crossing_outline_is_refused(drawing: Drawing, save: Save) -> None:
    corners = star()
    first, way = np.array(corners[0]), np.subtract(corners[1], corners[0])
    across = np.array([-way[1], way[0]]) / 20.0
    loop = [first + 0.95 * way, first + 0.85 * way + across, first + 0.8 * way - across]
    corners[1:1] = [(float(x), float(y)) for x, y in loop]
    drawing.modelspace().add_lwpolyline(corners, close=True)
    with pytest.raises(GeometryError, match="must not cross itself"):
        outline_from_dxf(save(drawing), TEETH)


@pytest.mark.parametrize("shift", [(0.0, 0.0), (3.0, 4.0), (300.0, 40.0)])
def test_a_wheel_whose_gaps_differ_more_than_made_ones_is_refused(
    drawing: Drawing, save: Save, shift: tuple[float, float]
) -> None:
    drawing.modelspace().add_lwpolyline(moved(deeper(1.0), *shift), close=True)
    with pytest.raises(GeometryError, match=r"alike within 0.075 mm, but .* up to 0\.\d+ mm in shape"):
        outline_from_dxf(save(drawing), TEETH)


def test_damaged_files_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "drawn.dxf"
    with pytest.raises(GeometryError, match="cannot be opened"):
        outline_from_dxf(path, TEETH)
    path.write_text("no drawing\nat all\n")
    with pytest.raises(GeometryError, match="must be a DXF file, but cannot be read"):
        outline_from_dxf(path, TEETH)


def test_damaged_file_is_repaired(drawing: Drawing, save: Save) -> None:
    drawing.modelspace().add_lwpolyline(star(), close=True)
    path = save(drawing)
    text = path.read_text().replace("  0\nENDSEC\n  0\nSECTION\n  2\nENTITIES", "  0\nSECTION\n  2\nENTITIES")
    path.write_text(text)
    points, notes, _ = outline_from_dxf(path, TEETH)
    assert points.shape[0] > 100
    assert notes[0].startswith("the file was damaged")


def test_empty_drawing_names_what_it_holds(drawing: Drawing, save: Save) -> None:
    drawing.modelspace().add_text("nothing")
    with pytest.raises(GeometryError, match=r"there are none \(found: 1 TEXT\): explode blocks"):
        outline_from_dxf(save(drawing), TEETH)


def test_unit_that_is_no_length_of_a_wheel_is_refused(drawing: Drawing, save: Save) -> None:
    drawing.header["$INSUNITS"] = 19
    drawing.modelspace().add_lwpolyline(star(), close=True)
    with pytest.raises(GeometryError, match="is number 19: set it to mm"):
        outline_from_dxf(save(drawing), TEETH)


def test_a_drawing_has_the_same_lines_in_every_process(tmp_path):
    """The library takes names of classes from a set, whose order the hash of strings decides."""
    dxf_drawing([], {"body": (7, 25, "Continuous")}).saveas(tmp_path / "empty.dxf")
    keys = [found.key for found in ezdxf.readfile(tmp_path / "empty.dxf").classes]
    assert len(keys) > 10 and keys == sorted(keys)
