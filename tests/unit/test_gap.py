"""Segments and gaps: expected values from circles and lines one can work out by hand."""

import math

import numpy as np
import pytest

from wearsim.errors import GeometryError
from wearsim.geometry.forms import iso606
from wearsim.geometry.forms.ansi_b29 import ansi_b29_gap
from wearsim.geometry.forms.gost591 import GostTooth, gost591_gap, tooth_height_factor
from wearsim.geometry.forms.iso606 import iso606_gap
from wearsim.geometry.gap import Gap, pitch_diameter, seat_height
from wearsim.geometry.segments import ArcSegment, LineSegment, points_along

QUARTER = 0.5 * math.pi


def test_arc_ends_and_tangents() -> None:
    arc = ArcSegment((1.0, 2.0), 3.0, -QUARTER, 0.0)
    assert arc.start == pytest.approx((1.0, -1.0))
    assert arc.end == pytest.approx((4.0, 2.0))
    assert (arc.start_tangent, arc.end_tangent) == (0.0, QUARTER)
    assert arc.length == pytest.approx(3.0 * QUARTER)
    assert (arc.sense, arc.curvature) == (1.0, pytest.approx(-1.0 / 3.0))


def test_clockwise_arc_is_convex() -> None:
    arc = ArcSegment((0.0, 0.0), 2.0, math.pi, QUARTER)
    assert (arc.sense, arc.curvature) == (-1.0, 0.5)
    assert (arc.start_tangent, arc.end_tangent) == (QUARTER, 0.0)
    np.testing.assert_allclose(
        arc.point_at([0.0, 0.5 * math.pi, math.pi]),
        [[-2.0, 0.0], [-math.sqrt(2.0), math.sqrt(2.0)], [0.0, 2.0]],
        atol=1e-15,
    )


def test_offset_arcs_keep_their_centre() -> None:
    """Into the gap, on the left of travel: concave 3 - 1, convex 2 + 1."""
    assert ArcSegment((1.0, 2.0), 3.0, -QUARTER, 0.0).offset(1.0) == ArcSegment(
        (1.0, 2.0), 2.0, -QUARTER, 0.0
    )
    assert ArcSegment((0.0, 0.0), 2.0, math.pi, QUARTER).offset(1.0).radius == 3.0


def test_line() -> None:
    line = LineSegment((1.0, 1.0), math.atan2(4.0, 3.0), 5.0)
    assert line.end == pytest.approx((4.0, 5.0))
    assert line.start_tangent == line.end_tangent == math.atan2(4.0, 3.0)
    assert line.curvature == 0.0
    np.testing.assert_allclose(line.point_at([2.5]), [[2.5, 3.0]])
    np.testing.assert_allclose(line.offset(5.0).end, (0.0, 8.0), atol=1e-14)
    assert line.shortened(2.5).end == pytest.approx((2.5, 3.0))


def test_line_crossings() -> None:
    line = LineSegment((0.0, 3.0), 0.0, 10.0)
    assert line.length_to_circle(5.0) == pytest.approx(4.0)
    assert line.length_to_circle(2.0) == math.inf
    assert line.length_to_circle(20.0) == math.inf
    assert line.length_to_ray(0.25 * math.pi) == pytest.approx(3.0)
    assert line.length_to_ray(-0.25 * math.pi) == math.inf
    assert line.length_to_ray(QUARTER) == math.inf


def test_arc_crossings() -> None:
    """Unit circle about (0, 3), from its lowest point counterclockwise to its highest."""
    arc = ArcSegment((0.0, 3.0), 1.0, -QUARTER, QUARTER)
    assert arc.length_to_circle(math.sqrt(10.0)) == pytest.approx(QUARTER)
    assert arc.length_to_circle(2.0) == 0.0
    assert arc.length_to_circle(4.0) == pytest.approx(math.pi)
    assert arc.length_to_circle(1.9) == arc.length_to_circle(4.1) == math.inf
    assert arc.length_to_ray(math.atan2(1.0, 3.0)) == pytest.approx(QUARTER - 2.0 * math.atan2(1.0, 3.0))
    assert arc.length_to_ray(0.5) == math.inf
    assert arc.shortened(QUARTER).end == pytest.approx((1.0, 3.0))


def test_crossing_of_a_clockwise_arc() -> None:
    """Unit circle about (3, 3), run clockwise from its leftmost to its highest point."""
    arc = ArcSegment((3.0, 3.0), 1.0, math.pi, QUARTER)
    assert arc.length_to_circle(math.sqrt(13.0)) == 0.0
    assert arc.length_to_circle(5.0) == pytest.approx(QUARTER)
    x, y = 3.0 + math.cos(math.radians(170.0)), 3.0 + math.sin(math.radians(170.0))
    assert arc.length_to_ray(math.atan2(x, y)) == pytest.approx(math.radians(10.0))
    assert arc.length_to_ray(0.25 * math.pi) == math.inf


def test_points_along_a_row() -> None:
    row = (LineSegment((0.0, 1.0), 0.0, 2.0), ArcSegment((2.0, 2.0), 1.0, -QUARTER, 0.0))
    way = [0.0, 1.0, 2.0, 2.0 + QUARTER]
    np.testing.assert_allclose(
        points_along(row, way), [[0.0, 1.0], [1.0, 1.0], [2.0, 1.0], [3.0, 2.0]], atol=1e-15
    )


def test_pitch_diameter_of_a_square() -> None:
    assert pitch_diameter(2.0, 4) == pytest.approx(math.sqrt(8.0))


@pytest.mark.parametrize(("pitch", "teeth"), [(0.0, 17), (-1.0, 17), (12.7, 2), (math.nan, 17)])
def test_pitch_diameter_of_no_sprocket(pitch: float, teeth: int) -> None:
    with pytest.raises(GeometryError, match="sprocket: needs a pitch above 0"):
        pitch_diameter(pitch, teeth)


def square_gap(tip: float, rise: float = 4.0) -> Gap:
    """Seat of radius 2 about (0, 10), then straight up; four teeth."""
    seat = ArcSegment((0.0, 10.0), 2.0, -QUARTER, 0.0)
    return Gap((seat, LineSegment((2.0, 10.0), QUARTER, rise)), 4, 10.0, 1.9, tip, "square")


def test_gap_by_hand() -> None:
    gap = square_gap(tip=12.0)
    assert (gap.seat_centre, gap.bottom_radius, gap.tip_radius) == (10.0, 8.0, 12.0)
    assert gap.half_length == pytest.approx(math.pi + math.sqrt(140.0) - 10.0)
    assert gap.segments[-1].end == pytest.approx((2.0, math.sqrt(140.0)))
    angle = math.atan2(2.0, math.sqrt(140.0))
    assert gap.tip_land == pytest.approx(24.0 * (math.pi / 4.0 - angle))
    assert gap.pointed_radius == math.inf
    assert not gap.truncated
    assert math.degrees(gap.pressure_angle(math.radians(30.0))) == pytest.approx(15.0)


def test_pointed_tooth_is_cut_off_where_its_flanks_meet() -> None:
    """A line to the right at y = 10 meets the tooth's axis, at 45 degrees, in (10, 10)."""
    seat = ArcSegment((0.0, 10.0), 2.0, -QUARTER, 0.0)
    row = (seat, LineSegment((2.0, 10.0), 0.0, 20.0))
    gap = Gap(row, 4, 10.0, 1.9, 15.0, "flat")
    assert gap.truncated
    assert gap.pointed_radius == gap.tip_radius == pytest.approx(math.sqrt(200.0))
    assert gap.tip_land == 0.0
    assert gap.segments[-1].end == pytest.approx((10.0, 10.0))
    lower = Gap(row, 4, 10.0, 1.9, 12.0, "flat")
    assert (lower.truncated, lower.pointed_radius) == (False, gap.pointed_radius)


@pytest.mark.parametrize("tip", [7.9, 8.0, 10.1])
def test_tip_circle_must_leave_a_flank(tip: float) -> None:
    with pytest.raises(GeometryError, match=r"square, z = 4: (no flank|the tip diameter)"):
        square_gap(tip)


def test_tip_circle_above_the_tooth() -> None:
    with pytest.raises(GeometryError, match=r"top 28\.2843 mm, is 40 mm: give one in between"):
        square_gap(20.0)


@pytest.mark.parametrize("nodes", [3, 4, 40, 41])
def test_outline_nodes(nodes: int) -> None:
    """Equal steps along the right side down and the left side up, symmetric to the bit."""
    gap = square_gap(tip=12.0)
    outline = gap.outline(nodes)
    assert outline.x.size == nodes
    assert (outline.x == -outline.x[::-1]).all()
    assert (outline.y == outline.y[::-1]).all()
    assert outline.x[0] > 0.0
    assert ((outline.x == 0.0).sum(), outline.y.min() == 8.0) == (nodes % 2, nodes % 2 == 1)
    way = np.abs(np.linspace(1.0, -1.0, nodes)) * gap.half_length
    expected = np.where(
        way < math.pi,
        [2.0 * np.sin(way / 2.0), 10.0 - 2.0 * np.cos(way / 2.0)],
        [np.full(nodes, 2.0), 10.0 + way - math.pi],
    )
    np.testing.assert_allclose([np.abs(outline.x), outline.y], expected, atol=1e-14)


def test_normals_of_an_outline_point_into_the_gap() -> None:
    outline = iso606_gap(12.7, 8.51, 17).outline(101)
    assert outline.normal_y[50] == pytest.approx(1.0)
    assert outline.normal_x[10] < 0.0 < outline.normal_x[90]


def test_roller_path_by_hand() -> None:
    """A roller of radius 1.9 in the square gap: arc of radius 0.1, then up at x = 0.1."""
    arc, line = square_gap(tip=12.0).roller_path()
    assert isinstance(arc, ArcSegment)
    assert (arc.centre, arc.radius) == ((0.0, 10.0), pytest.approx(0.1))
    assert isinstance(line, LineSegment)
    assert line.start == pytest.approx((0.1, 10.0))


def test_seat_height() -> None:
    assert seat_height("pitch_circle", 30.0, 4.5, 4.25) == 30.0
    assert seat_height("root_diameter", 30.0, 4.5, 4.25) == 30.25
    with pytest.raises(GeometryError, match="'pitch_circle' or 'root_diameter', got 'here'"):
        seat_height("here", 30.0, 4.5, 4.25)  # type: ignore[arg-type]
    with pytest.raises(GeometryError, match="its radius must exceed the roller's"):
        seat_height("pitch_circle", 30.0, 4.25, 4.25)


@pytest.mark.parametrize("form", ["min", "max"])
@pytest.mark.parametrize("teeth", [5, 6, 7, 8])
def test_iso_gap_of_few_teeth_exists(form: str, teeth: int) -> None:
    gap = iso606_gap(12.7, 8.51, teeth, form=form)
    assert gap.tip_land > 0.0


@pytest.mark.parametrize(("build", "fewest"), [(ansi_b29_gap, 5), (gost591_gap, 6)])
def test_concave_gap_of_few_teeth(build: type[Gap], fewest: int) -> None:
    """1.4 sin(17 - 64/z) > 0.8 sin(18 - 56/z) from z = 5 on, with 1.24 from z = 6 on."""
    assert build(12.7, 8.51, fewest).tip_land > 0.0
    with pytest.raises(GeometryError, match=f"z = {fewest - 1}: working arc and head overlap"):
        build(12.7, 8.51, fewest - 1)


@pytest.mark.parametrize("build", [iso606_gap, ansi_b29_gap, gost591_gap])
def test_rollers_without_size_or_room_make_no_gap(build: type[Gap]) -> None:
    with pytest.raises(GeometryError, match="diameter must be above 0"):
        build(12.7, 0.0, 17)
    with pytest.raises(GeometryError):
        build(12.7, 30.0, 17, tip_diameter=90.0)


def test_unknown_iso_form() -> None:
    with pytest.raises(GeometryError, match="must be 'min' or 'max', got 'mean'"):
        iso606_gap(12.7, 8.51, 17, form="mean")


def test_smaller_flank_radius_is_the_smaller() -> None:
    for teeth in range(3, 1000):
        assert iso606.re_small(8.0, teeth) < iso606.re_large(8.0, teeth)


@pytest.mark.parametrize(
    ("ratio", "factor"),
    [
        (1.41, 0.480),
        (1.5, 0.480),
        (1.5001, 0.532),
        (1.6, 0.532),
        (1.7, 0.555),
        (1.8, 0.575),
        (1.81, 0.565),
        (2.0, 0.565),
    ],
)
def test_gost_tooth_height_by_ratio(ratio: float, factor: float) -> None:
    """Upper ends belong to their interval, whatever t/D rounds to."""
    for roller in (3.0, 6.35, 7.7, 10.0, 15.88):
        assert tooth_height_factor(ratio * roller, roller) == factor


@pytest.mark.parametrize("ratio", [1.3, 1.4, 2.0001, 3.0])
def test_gost_refuses_what_its_table_leaves_out(ratio: float) -> None:
    with pytest.raises(GeometryError, match=r"must lie above 1\.40 and not above 2\.00"):
        gost591_gap(10.0 * ratio, 10.0, 25)
    tip = pitch_diameter(10.0 * ratio, 25) + 5.0
    assert gost591_gap(10.0 * ratio, 10.0, 25, tip_diameter=tip).tip_radius == 0.5 * tip


def test_gost_displacement() -> None:
    assert GostTooth(25.4, 15.88, 25).displacement == pytest.approx(0.762)
