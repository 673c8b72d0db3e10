"""Line of roller centres: exact arcs, a groove that holds the roller on both sides, grazing rays."""

import math

import numpy as np
import pytest

from wearsim.errors import GeometryError
from wearsim.geometry.forms.ansi_b29 import ansi_b29_gap
from wearsim.geometry.forms.gost591 import gost591_gap
from wearsim.geometry.forms.iso606 import iso606_gap
from wearsim.geometry.profile_points import Profile
from wearsim.geometry.roller_path import roller_path
from wearsim.geometry.segments import ArcSegment
from wearsim.kernels.roller_locus import roller_locus

FORMS = {
    "ANSI": ansi_b29_gap(12.7, 7.92, 20),
    "ISO min": iso606_gap(12.7, 8.51, 17, form="min"),
    "ISO max": iso606_gap(12.7, 8.51, 17, form="max"),
    "GOST": gost591_gap(12.7, 8.51, 17),
    "GOST displaced": gost591_gap(12.7, 8.51, 17, displaced=True),
}


def distance_to(parts, x, y):
    """Distance of a point from a row of arcs and lines."""
    found = []
    for part in parts:
        if isinstance(part, ArcSegment):
            dx, dy = x - part.centre[0], y - part.centre[1]
            turn = (math.atan2(dy, dx) - part.first) * part.sense
            within = turn % (2.0 * math.pi) <= abs(part.last - part.first)
            if within:
                found.append(abs(math.hypot(dx, dy) - part.radius))
        else:
            dx, dy = x - part.start[0], y - part.start[1]
            along = dx * math.cos(part.direction) + dy * math.sin(part.direction)
            if 0.0 <= along <= part.length:
                found.append(abs(dy * math.cos(part.direction) - dx * math.sin(part.direction)))
        found += [math.hypot(x - end[0], y - end[1]) for end in (part.start, part.end)]
    return min(found)


@pytest.mark.parametrize("nodes", [301, 601])
@pytest.mark.parametrize("form", FORMS)
def test_nodes_lie_on_the_exact_arcs(form, nodes):
    gap = FORMS[form]
    outline = gap.outline(nodes)
    path = roller_path(outline, gap.roller_radius, (nodes + 1) // 2)
    worn = path.worn(np.array(outline.x), np.array(outline.y))
    exact = gap.roller_path()
    off = np.array([distance_to(exact, abs(x), y) for x, y in worn.locus[:2].T])
    # where two arcs meet the outline's curvature jumps between two points
    assert np.quantile(off, 0.95) < 1e-6
    assert off.max() < (5e-5 if nodes == 601 else 2e-4)
    right, left = worn.locus[:2, 0], worn.locus[:2, -1]
    end = np.array(exact[-1].end)
    assert right == pytest.approx(end, abs=5e-6)
    assert left == pytest.approx(end * [-1.0, 1.0], abs=5e-6)


def test_normals_point_from_the_touched_place_to_the_centre():
    gap = FORMS["ISO max"]
    outline = gap.outline(601)
    worn = roller_path(outline, gap.roller_radius, 301).worn(np.array(outline.x), np.array(outline.y))
    points = np.arange(outline.x.size)
    x, y = (np.interp(worn.touched, points, values) for values in (outline.x, outline.y))
    centre = np.array([x, y]) + gap.roller_radius * worn.locus[2:]
    assert centre == pytest.approx(worn.locus[:2], abs=2e-4)
    assert np.hypot(*worn.locus[2:]) == pytest.approx(1.0, rel=1e-12)
    assert (np.diff(worn.touched) > -1e-9).all()


def groove(half_angle, points=401):
    """Two straight sides of 10 mm that meet at (0, 20)."""
    way = np.linspace(10.0, -10.0, points)
    return Profile(np.sin(half_angle) * way, 20.0 + np.cos(half_angle) * np.abs(way))


@pytest.mark.parametrize("degrees", [20.0, 40.0, 60.0])
def test_roller_hangs_on_both_sides_of_a_groove(degrees):
    """The line is two straight ones, r/sin(angle) above the bottom they meet.

    There the unworn nodes turn, or two of a cast line lie as good as on one another.
    """
    angle, radius = math.radians(degrees), 2.0
    outline = groove(angle)
    path = roller_path(outline, radius, 201)
    corner = np.array([0.0, 20.0 + radius / math.sin(angle)])
    for line in (path.base, path.worn(np.array(outline.x), np.array(outline.y)).locus):
        side = np.where(line[0] > 0.0, 1.0, -1.0)
        off = (line[0] * side * np.cos(angle)) - (line[1] - 20.0) * np.sin(angle) + radius
        from_corner = np.hypot(line[0] - corner[0], line[1] - corner[1])
        assert np.abs(off[from_corner > 0.1]).max() < 1e-7
        assert from_corner.min() < 0.05
        assert line[1].min() > corner[1] - 1e-3
        direction = np.unwrap(np.arctan2(line[3], line[2]))
        assert direction[-1] - direction[0] == pytest.approx(-(math.pi - 2.0 * angle), abs=1e-9)
        turn = np.abs(np.diff(direction))
        at = int(turn.argmax())
        spot = np.hypot(*(line[:2, at + 1] - line[:2, at]))
        assert turn[at] < math.radians(3.1) or spot < 2e-3 * radius


@pytest.mark.parametrize("beside", [1.0, 1.001, 1.5])
def test_circles_beside_a_ray_do_not_stop_it(beside):
    """A wall x = 0 touched by rays along -x; a row of points beside the rays, at least r off them."""
    radius = 2.0
    y = np.linspace(0.0, 4.0, 81)
    wall_x, wall_y = np.zeros_like(y), y
    row_x, row_y = np.linspace(0.5, 9.0, 60), np.full(60, 4.0 + beside * radius)
    base = np.array([[5.0] * 3, [1.0, 2.5, 4.0], [1.0] * 3, [0.0] * 3])
    locus, touched = np.empty((4, 3)), np.empty(3)
    x, y = np.concatenate([wall_x, row_x]), np.concatenate([wall_y, row_y])
    roller_locus(x, y, base, radius, np.empty(x.size + 4), locus, touched)
    assert locus[0] == pytest.approx(radius, abs=1e-9)
    assert locus[1] == pytest.approx(base[1], abs=1e-12)
    assert touched == pytest.approx([20.0, 50.0, 80.0], abs=1e-6)


def test_opposite_side_stops_no_roller_that_fits():
    """Walls x = 0 and x = 2 r + 0.001: the circles of the far one lie behind the node."""
    radius, y = 2.0, np.linspace(-3.0, 3.0, 121)
    x = np.concatenate([np.zeros_like(y), np.full_like(y, 2.0 * radius + 1e-3)])
    base = np.array([[radius], [0.0], [1.0], [0.0]])
    locus, touched = np.empty((4, 1)), np.empty(1)
    roller_locus(x, np.concatenate([y, y]), base, radius, np.empty(x.size + 4), locus, touched)
    assert locus[:, 0] == pytest.approx([radius, 0.0, 1.0, 0.0], abs=1e-9)


def test_ray_that_meets_nothing_leaves_its_node():
    base = np.array([[0.0], [50.0], [0.0], [1.0]])
    locus, touched = np.empty((4, 1)), np.empty(1)
    x = np.linspace(5.0, 6.0, 9)
    roller_locus(x, 0.0 * x, base, 2.0, np.empty(13), locus, touched)
    assert (locus[:, 0] == base[:, 0]).all()
    assert touched[0] == -1.0


def test_worn_flank_moves_the_line_by_the_depth():
    """0.2 mm off everywhere: the line of a roller thinner by as much."""
    gap = FORMS["ANSI"]
    outline = gap.outline(601)
    worn = outline.recede(0.2)
    line = roller_path(outline, gap.roller_radius, 301).worn(np.array(worn.x), np.array(worn.y))
    exact = [part.offset(gap.roller_radius - 0.2) for part in gap.segments]
    off = np.array([distance_to(exact, abs(x), y) for x, y in line.locus[:2].T])
    assert np.quantile(off, 0.95) < 1e-5
    assert off.max() < 2e-4


def test_places_and_nodes_are_inverse():
    gap = FORMS["ISO min"]
    outline = gap.outline(301)
    line = roller_path(outline, gap.roller_radius, 151).worn(np.array(outline.x), np.array(outline.y))
    node = np.linspace(0.0, line.place.size - 1.0, 37)
    assert line.node_of(line.node_place(node)) == pytest.approx(node, abs=1e-9)
    assert line.node_place(np.array([0.0]))[0] == 0.0


def test_roller_larger_than_the_gap():
    with pytest.raises(GeometryError, match="check roller_diameter_mm"):
        roller_path(FORMS["ANSI"].outline(301), 12.0, 151)
