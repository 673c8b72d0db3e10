"""Curves by few arcs: how many there are, and how far they lie off the points."""

import math

import numpy as np
import pytest
import shapely

from wearsim.geometry.arc_fit import with_few_arcs
from wearsim.geometry.outline import along_ways
from wearsim.geometry.outline_stretch import OutlineStretch, along_points


def polyline(points):
    return OutlineStretch("flank", points, np.zeros(len(points) - 1), is_curve=True)


def fine(stretch):
    points, _ = along_ways(stretch.vertices[:-1], stretch.vertices[1:], stretch.bulges, 1e-8)
    return shapely.LineString([*points, stretch.vertices[-1]])


def within(tolerance, arcs, curve):
    """Whether each of two curves lies within a distance of the other."""
    return all(a.buffer(tolerance).covers(b) for a, b in ((arcs, curve), (curve, arcs)))


@pytest.mark.parametrize("sense", [1, -1])
def test_a_circle_is_one_arc_in_either_sense(sense):
    angle = sense * np.linspace(0.3, 2.3, 401)
    arcs = with_few_arcs(polyline(50.0 * np.column_stack([np.cos(angle), np.sin(angle)])), 1e-3)
    assert arcs.bulges == pytest.approx([sense * math.tan(0.5)], abs=1e-6)


def test_lines_with_a_corner_keep_it():
    rows = [(x, 0.0) for x in range(5)] + [(4.0, y) for y in range(1, 5)]
    arcs = with_few_arcs(polyline(np.array(rows, dtype=float)), 1e-3)
    assert arcs.vertices.tolist() == [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0]]
    assert arcs.bulges.tolist() == [0.0, 0.0]


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4])
def test_an_ellipse_stays_within_the_tolerance(tolerance):
    """An arc that meets a curve at both ends and its middle leaves it by k' s^3 / (72 sqrt(3))."""
    angle = np.linspace(0.0, 0.5 * math.pi, 2001)
    curve = along_points("flank", np.column_stack([20.0 * np.cos(angle), 12.0 * np.sin(angle)]))
    arcs = with_few_arcs(curve, tolerance)
    assert within(tolerance, fine(arcs), fine(curve))
    # k', the change of the curvature, is at most 0.0114 per mm2 here, where the quarter is 25.5 mm long.
    assert len(arcs.bulges) < 2.0 + 25.5 / (72.0 * math.sqrt(3.0) * tolerance / 0.0114) ** (1.0 / 3.0)


def test_points_that_scatter_are_kept_within_the_tolerance():
    """No arc swings out between two points, however sharp their corners are."""
    scatter = np.random.default_rng(5).normal(0.0, 0.05, 300)
    rough = polyline(np.column_stack([np.linspace(0.0, 60.0, 300), scatter]))
    assert within(1e-3, fine(with_few_arcs(rough, 1e-3)), fine(rough))


def test_arcs_of_a_standard_form_stay_as_they_are():
    form = OutlineStretch("gap", np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]]), np.full(2, 0.1))
    assert with_few_arcs(form, 1.0) is form
