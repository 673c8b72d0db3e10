"""The linearly implicit step and what it is made of.

Expected: NumPy's dense solve, the order conditions of W-methods (Hairer and Wanner, Solving ODEs II,
IV.7), second differences of quadratics, and runs of far smaller steps.
"""

import numpy as np
import pytest

from tests.drives import depth_limit
from wearsim.contact.engagement import ContactKind
from wearsim.geometry.forms.evolute import Strand, evolute_flank
from wearsim.kernels.controlled_steps import STATE_ROWS, between
from wearsim.kernels.hertz_wear import flank_rate
from wearsim.kernels.rosenbrock import ERROR, GAMMA, RIGHT, STAGES, STATE, WORK_ROWS, slope_rate, wear_rows
from wearsim.kernels.tridiagonal import factorise, solve
from wearsim.mechanisms.prescribed.contact import PrescribedMechanism
from wearsim.mechanisms.strand.contact import StrandMechanism
from wearsim.wear.advance import run_advance
from wearsim.wear.law import archard, power
from wearsim.wear.problem import WearProblem


def dense(rows: np.ndarray) -> np.ndarray:
    """The matrix that rows of three entries stand for; those of the ends reach inwards."""
    n = rows.shape[1]
    matrix = np.zeros((n, n))
    for j in range(1, n - 1):
        matrix[j, j - 1 : j + 2] = rows[:, j]
    matrix[0, :3] = rows[1, 0], rows[2, 0], rows[0, 0]
    matrix[-1, -3:] = rows[2, -1], rows[0, -1], rows[1, -1]
    return matrix


@pytest.mark.parametrize("n", [3, 4, 5, 6, 9, 50, 201])
def test_solve_agrees_with_a_dense_one(n: int) -> None:
    rng = np.random.default_rng(n)
    rows = rng.uniform(0.1, 1.0, (3, n))
    rows[1] = -(rows[0] + rows[2])
    right, factors = rng.normal(size=n), np.empty((4, n))
    factorise(rows, 0.3, factors)
    found = right.copy()
    solve(factors, found)
    expected = np.linalg.solve(np.eye(n) - 0.3 * dense(rows), right)
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-13)


@pytest.mark.parametrize("slope", [0.0, -2e-6])
def test_rows_are_those_of_the_differences(slope: float) -> None:
    """Depth a s^2 on uneven points: second derivative 2 a, first 2 a s, ends included."""
    arc = np.array([0.0, 0.1, 0.25, 0.3, 0.5, 0.6, 0.75])
    start = np.zeros((STATE_ROWS, arc.size))
    start[0], start[3], start[6] = arc, 3e-6, 0.2
    rows, slopes = np.zeros((4, arc.size)), np.full(arc.size, slope)
    wear_rows(start, slopes, 0.5, 1, rows)
    expected = 2.0 * 0.7 * (0.5 * 3e-6 / 0.2 + slope * arc)
    np.testing.assert_allclose(dense(rows[:3]) @ (0.7 * arc**2), expected, rtol=1e-12, atol=1e-18)
    slopes[[0, -1]] = 0.0
    wear_rows(start, slopes, 0.5, 0, rows)
    expected[[0, -1]] = 0.0
    np.testing.assert_allclose(dense(rows[:3]) @ (0.7 * arc**2), expected, rtol=1e-12, atol=1e-18)


def test_matrix_is_the_derivative_of_the_rate() -> None:
    """Against central differences of the rate of a strand's flank, moved point by point."""
    strand = Strand(25.4 * 20 / (2.0 * np.pi), 7.94, 5.5)
    flank = evolute_flank(strand, 4.0, 30.67, 41).profile
    contact = StrandMechanism(
        strand=strand,
        profile=flank,
        contact_end=4.0,
        contact_start=30.67,
        pitch=25.4,
        pull_per_width=300.0,
        angular_speed=10.0,
        slip_fraction=1.0,
        modulus=1e5,
    ).contact
    law, points = power(1.0, 2.0), flank.x.size
    numbers, work = law.unit_numbers(contact.kind), np.zeros((WORK_ROWS, points))
    given = contact.constants, contact.columns, contact.modulus, numbers
    state = np.array([flank.x, flank.y, np.zeros(points)])
    flank_rate(contact.kernel, state, state[2], *given, work)
    start = np.array([*state, work[8], work[0], work[1], work[7], work[2]])
    slope_rate(contact.kernel, start, *given, work)
    rows = np.zeros((4, points))
    diffusion = law.diffusion(contact.kind, contact.slip_curvature_exponent)
    wear_rows(start, work[9], diffusion, 1, rows)

    def rate(way: np.ndarray) -> np.ndarray:
        moved = np.array([flank.x - way * start[4], flank.y - way * start[5], way])
        flank_rate(contact.kernel, moved, moved[2], *given, work)
        found: np.ndarray = work[8] * (work[0] * start[4] + work[1] * start[5])
        return found

    moves = 1e-7 * np.eye(points)
    true = np.array([(rate(move) - rate(-move)) / 2e-7 for move in moves]).T
    # The place itself, which is left out, changes the load on the steep ramp at the root.
    greatest = np.abs(true).max()
    np.testing.assert_allclose(dense(rows[:3]), true, rtol=0.0, atol=5e-3 * greatest)
    wear_rows(start, 0.0 * work[9], diffusion, 1, rows)
    assert np.abs(dense(rows[:3]) - true).max() > 0.05 * greatest


def test_order_conditions() -> None:
    """Order 3 with any matrix, the embedded one of order 2, and a result that is the last stage."""
    lower = np.zeros((STAGES, STAGES))
    right = lower.copy()
    lower[:, :3], right[:, :3] = np.reshape(STATE, (4, 3)), np.reshape(RIGHT, (4, 3))
    gamma = np.linalg.inv(np.eye(STAGES) / GAMMA - right)
    alpha = lower @ gamma
    weights = (lower[-1] + np.eye(STAGES)[-1]) @ gamma
    embedded = weights - np.array(ERROR) @ gamma
    one = np.ones(STAGES)
    for b in (weights, embedded):
        assert b @ one == pytest.approx(1.0, abs=1e-14)
        assert b @ alpha @ one == pytest.approx(0.5, abs=1e-14)
        assert b @ gamma @ one == pytest.approx(0.0, abs=1e-14)
    assert weights @ (alpha @ one) ** 2 == pytest.approx(1.0 / 3.0, abs=1e-14)
    assert weights @ alpha @ alpha @ one == pytest.approx(1.0 / 6.0, abs=1e-14)
    for first, second in ((alpha, gamma), (gamma, alpha), (gamma, gamma)):
        assert weights @ first @ second @ one == pytest.approx(0.0, abs=1e-14)
    np.testing.assert_allclose(weights, alpha[-1] + gamma[-1], atol=1e-14)


def test_between_two_states_lies_the_cubic_through_them() -> None:
    """Depth t^3 + t over one step of 2: values and slopes at both ends give it back."""
    start, end = np.zeros((STATE_ROWS, 1)), np.zeros((STATE_ROWS, 1))
    start[2:6, 0] = 0.0, 1.0, 0.6, 0.8
    end[2:6, 0] = 10.0, 13.0, 0.6, 0.8
    end[:2, 0] = -6.0, -8.0
    for part in (0.1, 0.5, 0.9):
        time = 2.0 * part
        depth = time**3 + time
        found = [between(start, end, 2.0, row, part, 0) for row in range(3)]
        np.testing.assert_allclose(found, [-0.6 * depth, -0.8 * depth, depth], rtol=1e-14)


def test_states_between_the_steps_are_as_good_as_the_life() -> None:
    """A table whose deepest point is inside; the loose run against one of far smaller steps."""
    arc = np.linspace(0.0, 4.0, 81)
    contact = PrescribedMechanism(
        kind=ContactKind.LOCAL,
        arc_length=arc,
        load_per_width=200.0 + 0.0 * arc,
        slip=1.0 - 0.5 * np.cos(0.5 * np.pi * arc),
        sliding_speed=np.full(arc.size, np.nan),
        flank_curvature=0.0 * arc,
        mate_radius=5.0,
        modulus=1e5,
    ).contact
    given = contact, archard(1e-9), (depth_limit(0.05),), 1e15
    loose, tight = run_advance(WearProblem(*given), 1e-2)[0], run_advance(WearProblem(*given), 1e-6)[0]
    assert loose.updates < 0.2 * tight.updates
    assert loose.cycles[-1] == pytest.approx(tight.cycles[-1], rel=1e-3)
    np.testing.assert_allclose(loose.depth, tight.depth, rtol=0.0, atol=1e-3 * 0.05)
