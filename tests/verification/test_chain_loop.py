"""Closed chains round sprockets against belts of two wheels, hulls of circles, and strings round a disc.

The hull of the pitch circles is the loop of wheels that all lie inside; shapely makes it of polygons,
whose perimeter is extrapolated to circles. A loop moved inwards everywhere by the radius of equal
wheels is a string from point to point round one larger disc, and shorter by 2 pi times the radius.
"""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from shapely import MultiPolygon, Point, unary_union

from wearsim.chain.chain_length import belt_centre, belt_links
from wearsim.chain.chain_loop import ChainLoop, Wheel
from wearsim.chain.drive_layout import DriveLayout
from wearsim.chain.take_up import TakeUp, fitting_travel
from wearsim.errors import CaseError

PITCH = 12.7
DRIVES = ((17, 34, 25.0), (20, 63, 36.0), (60, 20, 40.0), (27, 51, 30.0), (19, 19, 20.0))


def two_wheels(one: int, two: int, centre: float, slope: float = 0.0) -> ChainLoop:
    at = PITCH * centre * math.cos(slope), PITCH * centre * math.sin(slope)
    return ChainLoop(PITCH, (Wheel("driver", (0.0, 0.0), one), Wheel("driven", at, two)))


def with_idler(x: float, y: float, teeth: int = 13, idler: int = 11, apart: float = 500.0) -> ChainLoop:
    """Two equal wheels, and an idler on the upper strand from above."""
    wheels = (
        Wheel("driver", (0.0, 0.0), teeth),
        Wheel("driven", (apart, 0.0), teeth),
        Wheel("idler", (x, y), idler, outside=True),
    )
    return ChainLoop(PITCH, wheels)


def test_two_wheels_are_a_belt(validated: Callable[..., None]) -> None:
    found = [two_wheels(*drive, slope).links for drive in DRIVES for slope in (0.0, 0.7, -2.0)]
    expected = [belt_links(*drive) for drive in DRIVES for _ in range(3)]
    validated("links around two wheels", found, expected, 1e-13, "closed form of the open belt", "links")


@pytest.mark.parametrize(("one", "two", "centre"), DRIVES)
def test_two_wheels_are_laid_out_as_ever(one: int, two: int, centre: float) -> None:
    loop, layout = two_wheels(one, two, centre, 0.3), DriveLayout(PITCH, one, two, 400, PITCH * centre)
    assert loop.wrap_angles == pytest.approx([layout.wrap_angle_1, layout.wrap_angle_2], rel=1e-13)
    assert loop.teeth_in_mesh == pytest.approx([layout.engaged_1, layout.engaged_2], rel=1e-13)
    assert loop.span_lengths == pytest.approx(2 * [layout.span], rel=1e-13)
    omega = 7.0
    assert loop.mean_radii[0] * omega == pytest.approx(layout.chain_speed(omega), rel=1e-15)


def test_three_equal_wheels(validated: Callable[..., None]) -> None:
    """Perimeter of the triangle and one pitch circle; in links, one turn of teeth."""
    corners = ((0.0, 0.0), (400.0, 0.0), (90.0, 310.0))
    loop = ChainLoop(PITCH, tuple(Wheel(f"w{i}", at, 21) for i, at in enumerate(corners)))
    perimeter = sum(math.dist(corners[i - 1], corners[i]) for i in range(3))
    radius = 0.5 * PITCH / math.sin(math.pi / 21)
    quantity, source = "chain line around three equal wheels", "perimeter + 2 pi r"
    validated(quantity, loop.circle_length, perimeter + 2.0 * math.pi * radius, 1e-13, source, "mm")
    assert loop.links == pytest.approx(perimeter / PITCH + 21, rel=1e-13)
    assert np.sum(loop.wrap_angles) == pytest.approx(2.0 * math.pi, rel=1e-14)


def _hull(loop: ChainLoop, segments: int):
    circles = zip(loop.centres, loop.pitch_radii, strict=True)
    return unary_union([Point(c).buffer(r, quad_segs=segments) for c, r in circles]).convex_hull


def _random_ring(draw: np.random.Generator) -> tuple[Wheel, ...]:
    """Wheels on an ellipse, some of which may lie within the hull of the others."""
    count = int(draw.integers(3, 7))
    angles = 2.0 * math.pi * (np.arange(count) + draw.uniform(-0.3, 0.3, count)) / count
    half = draw.uniform(300.0, 900.0, 2)[:, None] * draw.uniform(0.5, 1.0, count)
    return tuple(
        Wheel(f"w{i}", (half[0, i] * math.cos(a), half[1, i] * math.sin(a)), int(draw.integers(9, 50)))
        for i, a in enumerate(angles)
    )


@pytest.mark.wide
def test_random_loops_are_hulls(validated: Callable[..., None]) -> None:
    draw = np.random.default_rng(19)
    found, expected, missed = [], [], 0
    while len(found) < 60:
        wheels = _random_ring(draw)
        try:
            loop = ChainLoop(PITCH, wheels)
        except CaseError as error:
            missed += "does not touch" in str(error)
            continue
        coarse, fine = (_hull(loop, segments).length for segments in (1024, 2048))
        found.append(loop.circle_length)
        expected.append((4.0 * fine - coarse) / 3.0)
    assert missed > 0
    source = "shapely: hull of the circles, extrapolated"
    validated("chain line around 3 to 6 wheels", found, expected, 1e-8, source, "mm")


def test_wheels_within_the_hull_are_not_touched() -> None:
    """What is refused as not touched can be left out: the hull stays the same."""
    draw, seen = np.random.default_rng(4), 0
    for _ in range(200):
        wheels = _random_ring(draw)
        try:
            ChainLoop(PITCH, wheels)
        except CaseError as error:
            text = str(error)
            named = [w for w in wheels if f"touch wheel {w.name!r}" in text]
            rest = [w for w in wheels if w not in named]
            if not named or len(rest) < 2:
                continue
            seen += 1
            circles = [Point(w.centre).buffer(0.5 * PITCH / math.sin(math.pi / w.teeth), 512) for w in named]
            others = [Point(w.centre).buffer(0.5 * PITCH / math.sin(math.pi / w.teeth), 512) for w in rest]
            hull = MultiPolygon(others).convex_hull
            assert all(hull.buffer(1e-2).contains(circle) for circle in circles)
    assert seen > 5


def test_outside_idler_is_a_string_round_a_disc(validated: Callable[..., None]) -> None:
    """Tangents sqrt(D^2 - R^2) from two points to a disc of R = r + s, and the arc below it."""
    found, expected = [], []
    for x, y in ((250.0, 20.0), (120.0, 5.0), (390.0, 35.0)):
        loop = with_idler(x, y)
        r, _, s = loop.pitch_radii
        disc, left, right = r + s, math.hypot(x, y), math.hypot(500.0 - x, y)
        below = math.pi - math.atan2(y, x) - math.atan2(y, 500.0 - x)
        arc = below - math.acos(disc / left) - math.acos(disc / right)
        tangents = [math.sqrt(far**2 - disc**2) for far in (right, left)]
        assert loop.span_lengths[1:] == pytest.approx(tangents, rel=1e-13)
        assert loop.wrap_angles[2] == pytest.approx(arc, rel=1e-11)
        found.append(loop.circle_length)
        expected.append(500.0 + sum(tangents) + disc * arc + 2.0 * math.pi * r)
    source = "string from point to point round a disc of r + s"
    validated("chain line around two wheels with an outside idler", found, expected, 1e-13, source, "mm")


def test_links_of_an_outside_idler() -> None:
    """Wheels take half a turn and half of the idler's wrap each."""
    loop = with_idler(250.0, 20.0)
    wrap = loop.wrap_angles[2]
    arcs = (13 * (2.0 * math.pi + wrap) + 11 * wrap) / (2.0 * math.pi)
    assert loop.links == pytest.approx(np.sum(loop.span_lengths) / PITCH + arcs, rel=1e-14)
    assert loop.even_links == 2 * math.ceil(loop.links / 2.0)


def test_mirror_and_turn_change_nothing() -> None:
    """The loop mirrored and run through in the other order, turned by 1 rad, is as long."""
    loop = with_idler(180.0, 12.0)

    def placed(wheel: Wheel) -> Wheel:
        z = complex(*wheel.centre).conjugate() * complex(math.cos(1.0), math.sin(1.0))
        return replace(wheel, centre=(z.real, z.imag))

    mirrored = ChainLoop(PITCH, tuple(placed(wheel) for wheel in reversed(loop.wheels)))
    assert mirrored.links == pytest.approx(loop.links, rel=1e-13)
    assert mirrored.wrap_angles[::-1] == pytest.approx(loop.wrap_angles, rel=1e-11)


def test_spans_are_tangents_and_join() -> None:
    loop = with_idler(180.0, 12.0)
    for points, owners in ((loop.starts, [0, 1, 2]), (loop.ends, [1, 2, 0])):
        spokes = points - loop.centres[owners]
        assert np.hypot(*spokes.T) == pytest.approx(loop.pitch_radii[owners], rel=1e-14)
        assert np.sum(spokes * loop.directions, axis=1) == pytest.approx(0.0, abs=1e-11)
    joined = loop.starts + loop.span_lengths[:, None] * loop.directions
    assert joined == pytest.approx(loop.ends, rel=1e-13, abs=1e-11)


@pytest.mark.parametrize("elongation", [0.0, 0.02])
def test_take_up_of_two_wheels(validated: Callable[..., None], elongation: float) -> None:
    """With the pitch, circles and centre distance of the belt grow alike."""
    take_up = TakeUp("driven", (2.0, 0.0), -20.0, 60.0)
    found = fitting_travel(two_wheels(20, 63, 36.0), take_up, 116, elongation)
    expected = (1.0 + elongation) * PITCH * belt_centre(20, 63, 116) - 36.0 * PITCH
    quantity, source = f"travel to fit 116 links, {100 * elongation:g} % elongated", "belt over both circles"
    validated(quantity, found, expected, 1e-9, source, "mm")


def test_elongation_of_two_equal_wheels() -> None:
    """80 links round 20 and 20 teeth have two spans of 30 pitches, which grow by 3 %: 9 mm."""
    loop = ChainLoop(10.0, (Wheel("driver", (0.0, 0.0), 20), Wheel("driven", (290.0, 0.0), 20)))
    take_up = TakeUp("driven", (1.0, 0.0), 0.0, 30.0)
    new, worn = (fitting_travel(loop, take_up, 80, elongation) for elongation in (0.0, 0.03))
    assert worn - new == pytest.approx(9.0, rel=1e-9)


def test_idler_takes_up_an_elongated_chain() -> None:
    loop, take_up = with_idler(250.0, 60.0, teeth=21), TakeUp("idler", (0.0, -1.0), -5.0, 60.0)
    new, travel = (fitting_travel(loop, take_up, loop.even_links, elongation) for elongation in (0.0, 0.01))
    worn = take_up.moved(replace(loop, elongation=0.01), travel)
    assert worn.links == pytest.approx(loop.even_links, rel=1e-11)
    assert worn.chain_pitch == pytest.approx(1.01 * PITCH, rel=1e-15)
    assert travel > new


def test_length_grows_by_the_turn_of_the_spans() -> None:
    """The arcs follow by themselves: moved by dt along a, the line grows by (u_before - u_after).a dt."""
    loop, take_up, step = with_idler(180.0, 12.0), TakeUp("idler", (0.3, -1.0), -1.0, 1.0), 1e-3
    ends = (take_up.moved(loop, sign * step).circle_length for sign in (1.0, -1.0))
    slope = (next(ends) - next(ends)) / (2.0 * step)
    turn = loop.directions[1] - loop.directions[2]
    assert slope == pytest.approx(float(turn @ np.array(take_up.unit)), rel=1e-8)
