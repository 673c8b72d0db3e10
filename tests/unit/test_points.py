"""A flank through points: expected values from circles with known noise."""

import math

import numpy as np
import pytest
import shapely

from wearsim.errors import GeometryError
from wearsim.geometry.measured.points import contact_range, flank_from_points, working_side
from wearsim.geometry.profile_points import Profile

RADIUS, CENTRE = 20.0, (11.1, 78.4)


def circle(count: int) -> np.ndarray:
    """A concave arc on the left of the gap, root to tip."""
    angle = np.linspace(np.pi + 0.22, np.pi - 0.2, count)
    return np.array([CENTRE[0] + RADIUS * np.cos(angle), CENTRE[1] + RADIUS * np.sin(angle)])


def test_exact_points_give_back_radius_and_ends() -> None:
    flank = flank_from_points(*circle(60), noise=0.0, nodes=101)
    np.testing.assert_allclose(np.hypot(flank.x - CENTRE[0], flank.y - CENTRE[1]), RADIUS, rtol=1e-9)
    np.testing.assert_allclose(flank.curvature[1:-1], -1.0 / RADIUS, rtol=1e-5)
    np.testing.assert_allclose([flank.x[0], flank.y[0]], circle(60)[:, 0], atol=1e-12)
    np.testing.assert_allclose(np.diff(flank.arc_length), RADIUS * 0.42 / 100, rtol=1e-4)


@pytest.mark.parametrize("seed", range(5))
def test_noise_is_smoothed_away(seed: int) -> None:
    """Three-point curvature of the raw points is off by sqrt(6) sigma/spacing^2, over 10 %."""
    noise = 1e-4
    points = circle(200) + noise * np.random.default_rng(seed).standard_normal((2, 200))
    raw = Profile(*points)
    flank = flank_from_points(*points, noise, 201)
    error = np.abs(flank.curvature[10:-10] * RADIUS + 1.0)
    assert np.abs(raw.curvature[1:-1] * RADIUS + 1.0).max() > 1.0
    assert error.max() < 0.05
    distance = np.hypot(flank.x - CENTRE[0], flank.y - CENTRE[1]) - RADIUS
    assert np.abs(distance).max() < 3.0 * noise


def test_residuals_have_the_size_of_the_noise() -> None:
    noise = 1e-3
    points = circle(400) + noise * np.random.default_rng(0).standard_normal((2, 400))
    flank = flank_from_points(*points, noise, 2001)
    line = shapely.LineString(np.column_stack([flank.x, flank.y]))
    way = shapely.distance(shapely.points(points.T), line)
    # The distance across the flank is one of the two normal deviates.
    assert math.sqrt(np.mean(way**2)) == pytest.approx(noise, rel=0.1)


def test_crossing_points_are_refused() -> None:
    t = np.linspace(-1.5, 1.5, 40)
    with pytest.raises(GeometryError, match="cross"):
        flank_from_points(t**2, t**3 - t, 0.0, 51)


def test_working_side_is_on_the_left_of_the_gap() -> None:
    left = Profile(*circle(30))
    assert working_side(left) is left
    right = Profile(-left.x, left.y)
    mirrored = working_side(right)
    np.testing.assert_array_equal(mirrored.x, left.x)
    np.testing.assert_array_equal(mirrored.curvature, left.curvature)


def test_contact_range_of_a_circle() -> None:
    """Roller centres lie on the circle of radius 12 around the same centre."""
    flank = flank_from_points(*circle(200), noise=0.0, nodes=801)
    height, roller = 75.35, 8.0
    expected = []
    for angle in (np.pi + 0.22, np.pi - 0.2):
        C = (CENTRE[0] + 12.0 * math.cos(angle), CENTRE[1] + 12.0 * math.sin(angle))
        expected.append(math.sqrt(C[0] ** 2 + C[1] ** 2 - height**2))
    assert contact_range(flank, height, roller) == pytest.approx(tuple(expected), rel=1e-5)


@pytest.mark.parametrize(("height", "end"), [(78.0, "root"), (200.0, "root")])
def test_end_out_of_reach_is_named(height: float, end: str) -> None:
    flank = flank_from_points(*circle(60), noise=0.0, nodes=101)
    with pytest.raises(GeometryError, match=f"must reach the {end} end"):
        contact_range(flank, height, 8.0)
