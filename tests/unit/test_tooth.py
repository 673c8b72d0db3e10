"""Tooth and wheel around a flank: expected values from plain geometry.

A flank straight along a radius gives a tooth whose chord on a circle is known by hand; areas
are compared with sums over thin rings or with circles that bound them.
"""

import math

import numpy as np
import pytest
import shapely
from shapely.affinity import rotate

from wearsim.errors import GeometryError
from wearsim.geometry.blank import tooth_space
from wearsim.geometry.forms.evolute import Strand, evolute_flank
from wearsim.geometry.profile_points import Profile
from wearsim.geometry.tooth import Tooth, cut_depth, sweep_path
from wearsim.geometry.wheel_outline import ring

STRAND = Strand(25.4 * 20 / (2.0 * np.pi), 7.94, 5.5)


def tooth(relief: float = 0.254, nodes: int = 201) -> Tooth:
    return Tooth(STRAND, evolute_flank(STRAND, 4.0, 30.67, nodes).profile, 20, relief)


def wheel_of(shape: Tooth) -> shapely.Polygon:
    (chain,) = ring((tooth_space(shape),) * shape.teeth)
    return shapely.Polygon(chain.outline.polygon(1e-6))


def radial_tooth(half_gap_angle: float, teeth: int = 20) -> Tooth:
    """Both flanks of the gap straight along radii, from 70 to 84 mm."""
    radius = np.linspace(70.0, 84.0, 57)
    flank = Profile(-radius * np.sin(half_gap_angle), radius * np.cos(half_gap_angle))
    return Tooth(STRAND, flank, teeth, relief=0.0)


def test_thickness_of_a_tooth_between_radial_flanks() -> None:
    """2 r sin((2 pi/z - 2 g)/2) for a gap of half-angle g."""
    gap = 0.1
    shape = radial_tooth(gap)
    angle = 2.0 * math.pi / 20 - 2.0 * gap
    for radius in (70.0, 75.0, 80.85, 84.0):
        expected = 2.0 * radius * math.sin(0.5 * angle)
        assert float(shape.thickness(radius)) == pytest.approx(expected, rel=1e-9)
    assert shape.tip_radius == pytest.approx(84.0, rel=1e-12)
    assert shape.tip_land == pytest.approx(84.0 * angle, rel=1e-9)
    assert shape.neck == pytest.approx(140.0 * math.sin(0.5 * angle), rel=1e-9)
    assert shape.pitch_line_thickness == pytest.approx(
        2.0 * STRAND.centrode_radius * math.sin(0.5 * angle), rel=1e-9
    )


def test_thickness_is_held_inside_the_flank() -> None:
    shape = radial_tooth(0.1)
    for outside, end in ((10.0, 70.0), (99.0, 84.0)):
        assert float(shape.thickness(outside)) == pytest.approx(float(shape.thickness(end)))


@pytest.mark.parametrize("depth", [0.1, 1.0])
def test_worn_tip_land_of_a_radial_flank(depth: float) -> None:
    """A flank parallel to its radius at the distance d leaves asin(d/R) less of the tip."""
    shape = radial_tooth(0.1)
    worn = shape.flank.recede(depth)
    expected = shape.tip_land - 84.0 * math.asin(depth / 84.0)
    found = shape.worn_tip_land(np.array(worn.x), np.array(worn.y))
    assert found == pytest.approx(expected, abs=2e-4)
    unworn = shape.worn_tip_land(np.array(shape.flank.x), np.array(shape.flank.y))
    assert unworn == pytest.approx(shape.tip_land, rel=1e-12)


def test_back_flank_is_the_recessed_mirror_image() -> None:
    shape = tooth(relief=0.3)
    mirror = shape.flank.mirrored()
    way = np.hypot(shape.back_flank.x - mirror.x, shape.back_flank.y - mirror.y)
    np.testing.assert_allclose(way, 0.3, rtol=1e-12)
    assert (shape.back_flank.x > 0.0).all()
    np.testing.assert_array_equal(tooth(relief=0.0).back_flank.x, mirror.x)


def test_relief_thins_the_tooth_by_less_than_its_width_across() -> None:
    thinner = tooth(relief=0.0).neck - tooth(relief=0.3).neck
    assert 0.0 < thinner < 0.3 / math.cos(0.7)


@pytest.mark.parametrize("relief", [0.0, 0.254])
def test_wheels_are_valid(relief: float) -> None:
    shape = tooth(relief)
    wheel = wheel_of(shape)
    assert wheel.is_valid
    assert wheel.is_simple
    assert wheel.contains(shapely.Point(0.0, 0.0))


def test_area_of_the_wheel_is_that_of_its_rings() -> None:
    """Solid up to the lowest seat point; above, the polygon's share of thin circles."""
    shape = tooth()
    wheel = wheel_of(shape)
    seat_radius = float(np.hypot(*shape.seat.T).min())
    assert wheel.bounds[2] <= shape.tip_radius + 1e-9
    radii = np.linspace(seat_radius, shape.tip_radius, 141)
    middle, width = 0.5 * (radii[1:] + radii[:-1]), radii[1] - radii[0]
    angle = np.arange(3600) * (2.0 * math.pi / 3600)
    shapely.prepare(wheel)
    rings = sum(
        2.0
        * math.pi
        * radius
        * width
        * float(shapely.contains_xy(wheel, radius * np.cos(angle), radius * np.sin(angle)).mean())
        for radius in middle
    )
    assert wheel.area == pytest.approx(math.pi * seat_radius**2 + rings, rel=2e-3)


def test_wheel_has_the_symmetry_of_its_teeth() -> None:
    wheel = wheel_of(tooth())
    rotated = rotate(wheel, 360.0 / 20, origin=(0.0, 0.0))
    assert wheel.symmetric_difference(rotated).area < 1e-9 * wheel.area
    off = rotate(wheel, 180.0 / 20, origin=(0.0, 0.0))
    assert wheel.symmetric_difference(off).area > 0.01 * wheel.area


def test_twenty_teeth_stand_on_the_root_disc() -> None:
    shape = tooth()
    seat_radius = float(np.hypot(*shape.seat.T).min())
    ring = shapely.Point(0.0, 0.0).buffer(seat_radius + 0.5, quad_segs=500)
    teeth = wheel_of(shape).difference(ring)
    assert len(teeth.geoms) == 20


def test_flank_and_seat_bound_the_wheel() -> None:
    shape = tooth()
    boundary = wheel_of(shape).exterior
    flank = np.column_stack([shape.flank.x, shape.flank.y])
    assert float(shapely.distance(shapely.points(flank), boundary).max()) < 1e-9
    _, root = tooth_space(shape).right
    (bulge,), (start, end) = root.bulges, root.vertices
    # The centre lies off the middle of the chord by (1 - b^2)/(4 b) of its length, to the left.
    way = end - start
    centre = 0.5 * (start + end) + (1.0 - bulge**2) / (4.0 * bulge) * way[::-1] * (-1.0, 1.0)
    radius = math.hypot(*(start - centre))
    np.testing.assert_allclose(np.hypot(*(shape.seat - centre).T), radius, atol=1e-9)
    np.testing.assert_allclose([start, end], shape.seat[[-1, 0]], atol=1e-9)


def test_seat_clears_the_roller() -> None:
    """The roller at the bottom of its way has its centre on +y at R - h."""
    shape = tooth()
    distance = np.hypot(shape.seat[:, 0], shape.seat[:, 1] - STRAND.height)
    assert distance.min() >= 7.94 - 1e-3
    np.testing.assert_allclose(shape.seat[0], [shape.flank.x[0], shape.flank.y[0]], atol=1e-9)
    np.testing.assert_allclose(shape.seat[-1], [shape.back_flank.x[-1], shape.back_flank.y[-1]], atol=1e-9)


@pytest.mark.wide
def test_roller_never_enters_the_wheel() -> None:
    """A polygon of the roller, carried along its way in and out, overlaps by nothing."""
    shape = tooth()
    wheel = wheel_of(shape)
    path = STRAND.roller_path(np.linspace(-45.0, 45.0, 181))
    roller = shapely.buffer(shapely.points(path), 7.94 - 2e-3, quad_segs=64)
    assert float(shapely.area(shapely.intersection(roller, wheel)).max()) < 1e-6
    assert shape.cut_depth() <= 1e-3


def test_cut_of_an_infeasible_flank_is_seen_in_the_wheel() -> None:
    strand = Strand(STRAND.centrode_radius, 7.94, 4.0)
    shape = Tooth(strand, evolute_flank(strand, 4.0, 30.67, 201).profile, 20, 0.254)
    # physics.md 2.1: h = 4.0 is cut by 1.27 mm.
    assert shape.cut_depth() == pytest.approx(1.27, abs=5e-3)


def test_exit_is_the_mirror_image_of_the_entry() -> None:
    entry, leave = (np.array(sweep_path(STRAND, 83.36, side).coords) for side in (1.0, -1.0))
    np.testing.assert_allclose(entry * [-1.0, 1.0], leave, atol=1e-12)
    assert np.hypot(*entry[-1]) >= 83.36 + 7.94 - 1e-9


def test_cut_depth_of_a_straight_way() -> None:
    """A roller of 2 mm along y = 3 enters 0.5 mm behind (0, 1.5) and clears (0, 0.5)."""
    way = shapely.LineString([(-5.0, 3.0), (5.0, 3.0)])
    assert cut_depth(np.array([[0.0, 1.5]]), way, 2.0) == pytest.approx(0.5)
    assert cut_depth(np.array([[0.0, 0.5]]), way, 2.0) == pytest.approx(-0.5)


def test_seat_that_cannot_clear_is_refused() -> None:
    """The flank of a roller of 7.94 mm around a roller of twice the size."""
    wide = Strand(STRAND.centrode_radius, 15.0, 5.5)
    with pytest.raises(GeometryError, match="seat"):
        _ = Tooth(wide, tooth().flank, 20, 0.254).seat


def test_teeth_that_overlap_are_refused() -> None:
    with pytest.raises(GeometryError, match="outline: it must not cross itself"):
        wheel_of(Tooth(STRAND, tooth().flank, 40, 0.254))
