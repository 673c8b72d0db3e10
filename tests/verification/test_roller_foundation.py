"""A roller on an elastic foundation of cells, against closed forms, however few cells it presses."""

import math

import numpy as np
import pytest

from wearsim.kernels import wrap_stage
from wearsim.kernels import wrap_yielding_seats as wrap_seats
from wearsim.kernels.wrap_yielding_seats import foundation_force

COMPLIANCE = 2e-6
"""Compliance of all cells [mm/MPa]."""


def pressed(x, y, radius, centre, raised=0.0):
    """Return force per width, stiffness, energy, width and pressures that a foundation answers."""
    width = np.gradient(np.concatenate([[0.0], np.hypot(np.diff(x), np.diff(y)).cumsum()]))
    pressure, part, answer = np.zeros(x.size), np.zeros(x.size), np.zeros(7)
    cells = width, np.full(x.size, COMPLIANCE), np.zeros(x.size), np.zeros(x.size) + raised
    foundation_force(
        x, y, *cells, 0, x.size, radius, *centre, np.zeros((3, x.size + 2)), pressure, part, answer
    )
    assert part @ width == pytest.approx(answer[6], rel=1e-12)
    stiffness = np.array([[answer[2], answer[3]], [answer[3], answer[4]]])
    return answer[:2], stiffness, answer[5], answer[6], pressure


@pytest.mark.parametrize("place", [0.0, 0.013, 0.05, 0.077])
@pytest.mark.parametrize("half", [0.01, 0.06, 0.3, 1.5])
def test_roller_on_a_flat(half, place):
    # Overlap d - x^2/2r on springs of compliance c: 4/3 d a/c with d = a^2/2r; its derivative is 2 a/c.
    radius, spacing = 50.0, 0.1
    depth = half * half / (2.0 * radius)
    x = spacing * np.arange(-60.0, 61.0)
    force, stiffness, energy, width, pressure = pressed(x, 0.0 * x, radius, (place, radius - depth))
    assert force[1] == pytest.approx(4.0 / 3.0 * depth * half / COMPLIANCE, rel=1e-3)
    assert abs(force[0]) < 1e-3 * force[1]
    assert stiffness[1, 1] == pytest.approx(2.0 * half / COMPLIANCE, rel=1e-3)
    assert energy == pytest.approx(8.0 / 15.0 * depth * depth * half / COMPLIANCE, rel=1e-3)
    assert width == pytest.approx(2.0 * half, rel=1e-3)
    assert pressure.sum() * spacing == pytest.approx(force[1], rel=1e-3)


@pytest.mark.parametrize("end", [1, -1])
def test_roller_on_the_end_of_a_flat(end):
    # As much of the overlap as lies on the outline, which reaches half a cell beyond its last point.
    radius, spacing, half = 50.0, 0.1, 0.4
    depth = half * half / (2.0 * radius)
    x = spacing * np.arange(-60.0, 61.0)
    force, _, _, width, pressure = pressed(x, 0.0 * x, radius, (end * 6.0, radius - depth))
    beyond = 0.5 * spacing
    expected = depth * (half + beyond) - (half**3 + beyond**3) / (6.0 * radius)
    assert force[1] == pytest.approx(expected / COMPLIANCE, rel=2e-3)
    assert width == pytest.approx(half + beyond, rel=1e-3)
    assert pressure[0 if end < 0 else -1] > 0.9 * depth / COMPLIANCE


@pytest.mark.parametrize("turn", [0.0, 0.002, 0.0041, 0.3])
@pytest.mark.parametrize("pocket", [5.06, 5.5, 8.0])
def test_roller_rolls_in_a_pocket(pocket, turn):
    # The centre of a roller that just touches a pocket moves on a circle of radius R - r. A force N on it
    # draws it back by N/(R - r) per way, though it presses a part of one cell.
    radius, load = 5.0, 2.0
    angle = np.linspace(-1.2, 1.2, 241)
    x, y = pocket * np.sin(angle), -pocket * np.cos(angle)
    bend = 1.0 / radius - 1.0 / pocket
    half = (1.5 * load * COMPLIANCE / bend) ** (1.0 / 3.0)
    way = pocket - radius + 0.5 * bend * half * half
    force, stiffness, _, width, _ = pressed(x, y, radius, (way * math.sin(turn), -way * math.cos(turn)))
    along = np.array([math.cos(turn), math.sin(turn)])
    across = np.array([-math.sin(turn), math.cos(turn)])
    assert math.hypot(*force) == pytest.approx(load, rel=0.02)
    assert abs(force @ along) < 2e-3 * load
    assert width == pytest.approx(2.0 * half, rel=0.01)
    assert along @ stiffness @ along == pytest.approx(load / (pocket - radius), rel=0.03)
    assert abs(along @ stiffness @ across) < 0.03 * (across @ stiffness @ across)


def test_force_is_the_slope_of_the_energy():
    rng = np.random.default_rng(7)
    x = np.linspace(-2.0, 2.0, 41)
    y = 0.02 * rng.standard_normal(41)
    raised = 0.01 * rng.standard_normal(41)
    for _ in range(30):
        centre = np.array([rng.uniform(-1.0, 1.0), 4.0 - rng.uniform(0.0, 0.08)])
        force, stiffness, *_ = pressed(x, y, 4.0, centre, raised)
        for axis in range(2):
            step = np.zeros(2)
            step[axis] = 1e-6
            ahead, behind = (pressed(x, y, 4.0, centre + sign * step, raised) for sign in (1.0, -1.0))
            size = max(float(np.abs(force).max()), 1.0)
            assert (behind[2] - ahead[2]) / 2e-6 == pytest.approx(force[axis], abs=1e-4 * size)
            slope = (behind[0] - ahead[0]) / 2e-6
            assert slope == pytest.approx(
                stiffness[axis], rel=0.02, abs=2e-3 * float(np.abs(stiffness).max())
            )


@pytest.mark.parametrize(("left", "right"), [(1.0, 1.0), (0.4, 1.0), (0.25, 0.7), (1.0, 0.01)])
def test_wear_lies_where_the_contact_presses(left, right):
    """Uniform pressure that ends within cells: area and centre of gravity are those of the rectangle."""
    cells, first, last, spacing = 12, 4, 8, 0.5
    part = np.zeros(cells)
    part[first:last] = 1.0
    part[first], part[last - 1] = left, right
    seats, numbers = np.zeros((wrap_seats.SEAT_ROWS, 1)), np.zeros(wrap_stage.STAGE_NUMBERS)
    seats[[wrap_seats.FIRST, wrap_seats.LAST, wrap_seats.SLIP], 0] = first, last, 2.0
    numbers[[wrap_stage.RATE_FACTOR, wrap_stage.EXPONENT]] = 1e-3, 1.0
    blocks, works = np.zeros((1, wrap_stage.BLOCK_ROWS)), np.zeros((1, cells))
    blocks[0, wrap_stage.COUNT] = 1.0
    unworn, outlines = np.full((6, cells), spacing), np.full((wrap_stage.OUTLINES, cells), spacing)
    pressures, sums = np.array([100.0 * part, part]), np.zeros((5, cells + 1))
    tables = blocks, seats, numbers, unworn, pressures, outlines, works, sums
    wrap_stage.add_work(0, 1, 1.0, 1, 1, *tables)
    begin, end = first + 1.0 - left, last - 1.0 + right
    assert works.sum() == pytest.approx(0.2 * (end - begin), rel=1e-12)
    centre = works[0] @ (np.arange(cells) + 0.5) / works.sum()
    assert centre == pytest.approx(0.5 * (begin + end), rel=1e-12)
