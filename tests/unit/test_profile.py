"""Profile: expected values from circles and straight lines, worked out by hand."""

import numpy as np
import pytest

from wearsim.errors import GeometryError
from wearsim.geometry.profile_points import Profile, area_between


def arc(
    radius: float, start: float, end: float, nodes: int, centre: tuple[float, float] = (0.0, 0.0)
) -> Profile:
    angle = np.linspace(start, end, nodes)
    return Profile(centre[0] + radius * np.cos(angle), centre[1] + radius * np.sin(angle))


def wavy(nodes: int) -> Profile:
    s = np.linspace(0.0, 10.0, nodes) ** 1.05
    return Profile(0.5 * np.sin(0.6 * s), s)


def test_arc_length_of_a_circle() -> None:
    profile = arc(20.0, 0.2, 1.4, 41)
    assert profile.arc_length[0] == 0.0
    np.testing.assert_allclose(profile.arc_length, 20.0 * np.linspace(0.0, 1.2, 41), rtol=1e-7, atol=0.0)


def test_arc_length_of_a_line() -> None:
    profile = Profile([0.0, 3.0, 3.0 + 6.0], [0.0, 4.0, 4.0 + 8.0])
    np.testing.assert_allclose(profile.arc_length, [0.0, 5.0, 15.0], rtol=1e-15)


@pytest.mark.parametrize(("start", "end", "sign"), [(0.0, 1.5, 1.0), (1.5, 0.0, -1.0)])
def test_curvature_sign_and_normal_of_a_circle(start: float, end: float, sign: float) -> None:
    """The gap is on the right: outside a circle run counterclockwise, inside one run clockwise."""
    profile = arc(8.0, start, end, 31)
    np.testing.assert_allclose(profile.curvature[1:-1], sign / 8.0, rtol=1e-12)
    np.testing.assert_allclose(profile.curvature[[0, -1]], sign / 8.0, rtol=5e-3)
    np.testing.assert_allclose(profile.normal_x[1:-1], sign * profile.x[1:-1] / 8.0, atol=1e-12)
    np.testing.assert_allclose(profile.normal_y[1:-1], sign * profile.y[1:-1] / 8.0, atol=1e-12)
    np.testing.assert_allclose(np.hypot(profile.normal_x, profile.normal_y), 1.0, rtol=1e-14)


def test_end_frame_is_that_of_the_parabola() -> None:
    """Points of y = x^2/20 at equal steps of x; the gap lies below, the flank is concave to it."""
    errors = []
    for nodes in (21, 41):
        x = np.linspace(0.0, 4.0, nodes)
        profile = Profile(x, x**2 / 20.0)
        slope = x[[0, -1]] / 10.0
        exact = 0.1 / (1.0 + slope**2) ** 1.5
        errors.append(np.abs(profile.curvature[[0, -1]] - exact).max())
        normal = slope / np.sqrt(1.0 + slope**2)
        np.testing.assert_allclose(profile.normal_x[[0, -1]], normal, atol=2e-4)
        assert (profile.normal_y < 0.0).all()
    assert errors[1] < 0.6 * errors[0]
    assert errors[1] < 1e-3


def test_straight_flank_has_no_curvature() -> None:
    profile = Profile([0.0, 1.0, 2.5, 3.0], [0.0, 2.0, 5.0, 6.0])
    np.testing.assert_allclose(profile.curvature, 0.0, atol=1e-15)


@pytest.mark.parametrize(("start", "end", "worn"), [(0.0, 1.2, 7.5), (1.2, 0.0, 8.5)])
def test_recede_moves_every_point_away_from_the_gap(start: float, end: float, worn: float) -> None:
    """A convex circle of 8 mm shrinks by 0.5, a concave one grows by 0.5."""
    receded = arc(8.0, start, end, 25).recede(0.5)
    np.testing.assert_allclose(np.hypot(receded.x, receded.y)[1:-1], worn, rtol=1e-12)


def test_recede_by_one_depth_per_point() -> None:
    flat = Profile([0.0, 0.0, 0.0, 0.0], [0.0, 1.0, 2.0, 3.0])
    receded = flat.recede([0.0, 0.1, 0.2, 0.0])
    np.testing.assert_allclose(receded.x, [0.0, -0.1, -0.2, 0.0])
    np.testing.assert_allclose(receded.y, flat.y)


@pytest.mark.parametrize(("start", "end", "sign"), [(0.0, 1.2, 1.0), (1.2, 0.0, -1.0)])
def test_removed_area_between_circles(start: float, end: float, sign: float) -> None:
    """Area of the ring sector, angle (R^2 - (R - d)^2)/2; polygons: sin of the step for it."""
    before = arc(8.0, start, end, 601)
    after = before.recede(0.5)
    outer, inner = max(8.0, 8.0 - sign * 0.5), min(8.0, 8.0 - sign * 0.5)
    area = area_between(before.x, before.y, after.x, after.y)
    assert area == pytest.approx(0.6 * (outer**2 - inner**2), rel=1e-5)
    assert area_between(after.x, after.y, before.x, before.y) == pytest.approx(-area, rel=1e-12)


def test_area_of_a_far_flank_keeps_its_digits() -> None:
    y = np.linspace(0.0, 2.0, 11)
    assert area_between(1e6 + 0.0 * y, y, 1e6 - 0.5 + 0.0 * y, y) == pytest.approx(1.0, rel=1e-12)


def test_mirrored_flank_keeps_the_gap_on_its_right() -> None:
    profile = arc(8.0, 1.2, 0.4, 25, (-10.0, 70.0))
    mirror = profile.mirrored()
    np.testing.assert_array_equal(mirror.x, -profile.x[::-1])
    np.testing.assert_array_equal(mirror.y, profile.y[::-1])
    np.testing.assert_allclose(mirror.normal_x, -profile.normal_x[::-1], atol=1e-14)
    np.testing.assert_allclose(mirror.normal_y, profile.normal_y[::-1], atol=1e-14)
    np.testing.assert_allclose(mirror.curvature, profile.curvature[::-1], rtol=1e-12)
    np.testing.assert_array_equal(mirror.mirrored().x, profile.x)


def test_rotated_by_a_right_angle() -> None:
    rotated = Profile([1.0, 2.0, 4.0], [0.0, 0.5, 0.5]).rotated(0.5 * np.pi)
    np.testing.assert_allclose(rotated.x, [0.0, -0.5, -0.5], atol=1e-15)
    np.testing.assert_allclose(rotated.y, [1.0, 2.0, 4.0], rtol=1e-15)


def test_self_crossing_is_found() -> None:
    assert not Profile([0.0, 2.0, 2.0, 1.0, 1.0], [0.0, 0.0, 1.0, 1.0, -1.0]).is_simple
    assert wavy(40).is_simple


def test_receding_beyond_the_radius_folds_and_is_found() -> None:
    """A ridge of 2 mm radius between straight sides, receded by 1.9 and by 3 mm."""
    angle = np.linspace(-0.8, 0.8, 41)
    way = np.linspace(4.0, 0.1, 20)
    before = (2.0 * np.cos(0.8) - way * np.sin(0.8), -2.0 * np.sin(0.8) - way * np.cos(0.8))
    x = np.concatenate([before[0], 2.0 * np.cos(angle), before[0][::-1]])
    y = np.concatenate([before[1], 2.0 * np.sin(angle), -before[1][::-1]])
    ridge = Profile(x, y)
    assert ridge.recede(1.9).is_simple
    assert not ridge.recede(3.0).is_simple


@pytest.mark.parametrize(
    ("x", "y", "match"),
    [
        ([0.0, 1.0], [0.0, 1.0], "at least three points"),
        ([0.0, 1.0, 2.0], [0.0, 1.0], "as many x as y"),
        ([0.0, 1.0, np.nan], [0.0, 1.0, 2.0], "finite"),
        ([0.0, 1.0, np.inf], [0.0, 1.0, 2.0], "finite"),
        ([0.0, 1.0, 1.0, 2.0], [0.0, 1.0, 1.0, 2.0], "points 2 and 3 coincide"),
    ],
)
def test_impossible_points_are_refused(x: list[float], y: list[float], match: str) -> None:
    with pytest.raises(GeometryError, match=match):
        Profile(x, y)


def test_profile_cannot_be_changed() -> None:
    x = np.array([0.0, 1.0, 2.0])
    profile = Profile(x, x**2)
    x[1] = 5.0
    assert profile.x[1] == 1.0
    with pytest.raises(ValueError, match="read-only"):
        profile.x[1] = 5.0
