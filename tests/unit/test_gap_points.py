"""Gaps from points and around evolute flanks: circles, corners and brute force."""

import math
from itertools import pairwise

import numpy as np
import pytest

from wearsim.errors import GeometryError
from wearsim.geometry.forms.evolute import Strand, evolute_flank
from wearsim.geometry.gap_points import evolute_gap, gap_from_points, lowest_centre
from wearsim.geometry.tooth import Tooth


def half_circle(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Radius 5 around (0, 30), right to left."""
    angle = np.linspace(0.0, -math.pi, count)
    return 5.0 * np.cos(angle), 30.0 + 5.0 * np.sin(angle)


def trapezoid(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Flat seat from x = 4 to -4 at y = 20, flanks up to (8, 30); corners of 68.2 degrees."""
    corners = np.array([[8.0, 30.0], [4.0, 20.0], [-4.0, 20.0], [-8.0, 30.0]])
    rows = [np.linspace(a, b, count) for a, b in pairwise(corners)]
    points = np.concatenate([rows[0], rows[1][1:], rows[2][1:]])
    return points[:, 0], points[:, 1]


def test_uneven_points_give_equal_steps() -> None:
    angle = -math.pi * np.linspace(0.0, 1.0, 150) ** 1.5
    gap = gap_from_points(5.0 * np.cos(angle), 30.0 + 5.0 * np.sin(angle), 0.0, 201, 4.0)
    np.testing.assert_allclose(np.hypot(gap.x, gap.y - 30.0), 5.0, atol=2e-5)
    np.testing.assert_allclose(np.diff(gap.arc_length), 5.0 * math.pi / 200, rtol=1e-4)


@pytest.mark.parametrize("count", [60, 7001])
def test_corners_stay_corners(count: int) -> None:
    gap = gap_from_points(*trapezoid(count), 0.0, 801, 4.5)
    slanted = np.abs(10.0 * (np.abs(gap.x) - 4.0) - 4.0 * (gap.y - 20.0)) / math.hypot(10.0, 4.0)
    distance = np.where(np.abs(gap.x) > 4.0, slanted, np.abs(gap.y - 20.0))
    assert distance.max() < 1e-9


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_half_outline_is_mirrored(side: float) -> None:
    x, y = half_circle(401)
    whole = gap_from_points(x, y, 0.0, 201, 4.0)
    half = gap_from_points(side * x[200::-1], y[200::-1], 0.0, 201, 4.0)
    np.testing.assert_allclose(half.x, whole.x, atol=1e-6)
    np.testing.assert_allclose(half.y, whole.y, atol=1e-6)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda x, y: (x[::-1], y[::-1]), "reverse the order of the points"),
        (lambda x, y: (x[:101], y[:101]), "from the centre line x = 0 to a tip, .* reverse the order"),
        (lambda x, y: (x[:80], y[:80]), "or start on it, but keeps .* away: add the seat"),
        (lambda x, y: (np.r_[x, x + 10.0], np.r_[y, y]), "once, but does 2 times"),
        (lambda x, y: (x, y - 30.0), "above the sprocket's centre"),
        (lambda x, y: (x[::10], y[::10]), "at least 24 points"),
        (lambda x, y: (np.where(x > 4.9, np.nan, x), y), "finite"),
        (lambda x, y: (x, np.r_[y[:20], y[19::-1], y[40:]] + 0.0 * x), "must not cross itself"),
    ],
)
def test_unusable_points_are_refused(change, message: str) -> None:
    with pytest.raises(GeometryError, match=message):
        gap_from_points(*change(*half_circle(201)), 0.0, 101, 4.0)


@pytest.mark.parametrize("half", [True, False])
def test_scatter_at_the_bottom_is_named_as_such(half: bool) -> None:
    """Three points at the bottom of a gap, one of them 0.02 mm on the wrong side: no matter of order."""
    x, y = half_circle(401)
    x[[199, 200, 201]] = [-0.02, 0.01, 0.02] if not half else [0.0, 0.02, -0.04]
    if half:
        x, y = x[200:], y[200:]
    with pytest.raises(GeometryError, match=r"scatter by 0.02 mm .* give points_noise_mm = 0.0067 or more"):
        gap_from_points(x, y, 0.0, 101, 4.0)
    assert abs(gap_from_points(x, y, 0.0067, 101, 4.0).y.min() - 25.0) < 0.01


def test_roller_too_large_for_the_gap_is_refused() -> None:
    """On the corners of the mouth, 10 mm apart, its centre stops at 30 + sqrt(5.5^2 - 5^2)."""
    with pytest.raises(GeometryError, match=r"of 11 mm .* tips, 10 mm apart, .* y = 32.29 mm"):
        gap_from_points(*half_circle(201), 0.0, 101, 5.5)


@pytest.mark.parametrize("roller", [3.0, 4.5])
def test_lowest_centre_of_a_trapezoid(roller: float) -> None:
    """On the flat, as long as it fits between the flanks; else between the two flanks."""
    lowest = 20.0 + roller
    slope = math.atan2(10.0, 4.0)
    between = 20.0 + roller / math.cos(slope) - 4.0 * math.tan(slope)
    x, y = trapezoid(4001)
    centre = lowest_centre(x, y, roller)
    assert centre[1] == pytest.approx(max(lowest, between), abs=1e-5)


def evolute_tooth(pitch: float, roller: float, teeth: int, offset: float, relief: float) -> Tooth:
    strand = Strand(pitch * teeth / (2.0 * math.pi), 0.5 * roller, offset)
    flank = evolute_flank(strand, 0.16 * pitch, 1.21 * pitch, 401).profile
    return Tooth(strand, flank, teeth, relief)


DRIVES = [
    pytest.param(25.4, 15.88, 20, 5.8, 0.254, id="16B-20"),
    pytest.param(12.7, 8.51, 17, 3.4, 0.0, id="08B-17"),
]


@pytest.mark.parametrize(("pitch", "roller", "teeth", "offset", "relief"), DRIVES)
def test_evolute_gap_seats_the_roller_on_the_pitch_circle(
    pitch: float, roller: float, teeth: int, offset: float, relief: float
) -> None:
    """Centres on many lines along +y, bisected between touching and clear of all points."""
    gap = evolute_gap(evolute_tooth(pitch, roller, teeth, offset, relief), pitch, 2001)
    radius = 0.5 * pitch / math.sin(math.pi / teeth)
    across = np.linspace(-0.03, 0.03, 61) * pitch
    blocked, free = np.full(61, radius - 0.2 * roller), np.full(61, radius + 0.2 * roller)
    for _ in range(22):
        y = 0.5 * (blocked + free)
        clear = np.hypot(across[:, None] - gap.x, y[:, None] - gap.y).min(axis=1)
        is_free = clear >= 0.5 * roller
        blocked, free = np.where(is_free, blocked, y), np.where(is_free, y, free)
    lowest = np.hypot(across, free)[free.argmin()]
    assert lowest == pytest.approx(radius, abs=5e-5)


@pytest.mark.parametrize(("pitch", "roller", "teeth", "offset", "relief"), DRIVES)
def test_evolute_gap_is_the_tooth_moved_outwards(
    pitch: float, roller: float, teeth: int, offset: float, relief: float
) -> None:
    tooth = evolute_tooth(pitch, roller, teeth, offset, relief)
    gap = evolute_gap(tooth, pitch, 1001)
    rise = gap.y[-1] - tooth.flank.y[-1]
    assert rise > 0.0
    assert (gap.x[0], gap.y[0] - rise) == pytest.approx(
        (tooth.back_flank.x[0], tooth.back_flank.y[0]), abs=1e-12
    )
    assert gap.x[-1] == pytest.approx(tooth.flank.x[-1], abs=1e-12)
    exact = tooth.strand.conjugate_points(np.linspace(0.16 * pitch, 1.21 * pitch, 20001))
    on_flank = (gap.x < 0.0) & (gap.y - rise > exact[0, 1] + 0.1)
    assert on_flank.sum() > 100
    x = np.interp(gap.y[on_flank] - rise, exact[:, 1], exact[:, 0])
    np.testing.assert_allclose(gap.x[on_flank], x, atol=1e-6)
    np.testing.assert_allclose(np.diff(gap.arc_length)[5:-5], gap.arc_length[-1] / 1000, rtol=5e-3)
