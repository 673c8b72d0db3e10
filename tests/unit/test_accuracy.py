"""The error of the grid: what lives on fewer points tell about those on all."""

import math

import numpy as np
import pytest

from wearsim.contact.engagement import Contact, Kind
from wearsim.errors import ConvergenceError
from wearsim.mechanisms.prescribed import PrescribedMechanism
from wearsim.wear.accuracy import depth_missed, grid_error, grid_study
from wearsim.wear.advance import run_advance
from wearsim.wear.criteria import depth_criterion
from wearsim.wear.law import archard
from wearsim.wear.trajectory import Trajectory

LIMIT = depth_criterion(0.01)


def contact(points: int, ripple: float = 0.0) -> Contact:
    arc = np.linspace(0.0, 4.0, points)
    return PrescribedMechanism(
        kind=Kind.LOCAL,
        arc_length=arc,
        load_per_width=np.full(points, 200.0),
        slip=1.0 + ripple * np.cos(0.5 * np.pi * arc),
        sliding_speed=np.full(points, np.nan),
        flank_curvature=np.zeros(points),
        roller_radius=5.0,
        modulus=1e5,
    ).contact


def ended(life: float, depth: tuple[float, ...] = (0.01, 0.01, 0.01)) -> Trajectory:
    """Return a run that reached its limit after a number of cycles."""
    shape = np.array([np.zeros(len(depth)), depth])
    place = np.tile(np.arange(len(depth), dtype=float), (2, 1))
    return Trajectory(np.array([0.0, life]), place, 0.0 * place, shape, LIMIT, 1)


@pytest.mark.parametrize(
    ("half", "quarter", "expected"),
    [
        (1.01, 1.02, 0.01),
        (1.01, 1.01 * 1.1, 0.05),
        (1.0, 1.1, 0.05),
        (1.01, math.nan, 0.02),
    ],
)
def test_error_is_the_greater_of_a_move_and_of_half_the_next(
    half: float, quarter: float, expected: float
) -> None:
    lives = {41: half, 21: quarter}

    def run_on(grid: Contact) -> Trajectory:
        life = lives[grid.profile.x.size]
        if math.isnan(life):
            raise ConvergenceError("none")
        return ended(life)

    assert grid_error(ended(1.0), contact(81), run_on) == pytest.approx(expected, rel=1e-9)


def test_error_holds_what_the_deepest_point_misses() -> None:
    """0.01 - 0.001 (s - 0.25)^2 at s = -1, 0, 1."""
    depth = tuple(0.01 - 0.001 * (s - 0.25) ** 2 for s in (-1.0, 0.0, 1.0))
    error = grid_error(ended(1.0, depth), contact(81), lambda grid: ended(1.0))
    assert error == pytest.approx(0.001 * 0.25**2 / depth[1], rel=1e-9)


def test_depth_missed_on_uneven_points_and_at_an_end() -> None:
    s = np.array([-1.0, 0.2, 0.9, 3.0])
    depth = 1.0 - 0.1 * (s - 0.4) ** 2
    missed = depth_missed(0.6 * s, 0.8 * s, depth)
    assert missed == pytest.approx(1.0 / depth[1] - 1.0, rel=1e-9)
    assert depth_missed(s, 0.0 * s, s) == 0.0
    assert depth_missed(s[:3], 0.0 * s[:3], np.ones(3)) == 0.0


def test_study_of_a_ripple_is_of_second_order() -> None:
    """And the error of its finest grid is a third of the move, as Richardson has it."""
    law = archard(1e-9)

    def run_on(grid: Contact) -> Trajectory:
        return run_advance(grid, law, (LIMIT,), 1e12, 1e-7)[0]

    given = contact(81, ripple=-0.5)
    study = grid_study(given, run_on)
    assert study.points == (81, 41, 21)
    assert 1.9 < study.order < 2.1
    fine, middle, _ = study.values
    assert study.error == pytest.approx(abs(middle / fine - 1.0) / 3.0, rel=0.1)
    # On 81 points the run misses nothing between them: the deepest is where the ripple is.
    error = grid_error(run_on(given), given, run_on)
    assert error == pytest.approx(2.0 * abs(middle / fine - 1.0), rel=0.1)
