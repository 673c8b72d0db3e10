"""The error of the grid: what lives on fewer points tell about those on all."""

import numpy as np
import pytest

from tests.drives import depth_limit
from wearsim.contact.engagement import ContactKind, FlankContact
from wearsim.mechanisms.prescribed.contact import PrescribedMechanism
from wearsim.wear.accuracy import SAFETY, depth_missed, exceeds, grid_error, grid_study
from wearsim.wear.advance import run_advance
from wearsim.wear.law import archard
from wearsim.wear.problem import WearProblem
from wearsim.wear.trajectory import Trajectory

LIMIT = depth_limit(0.01)


def contact(points: int, ripple: float = 0.0) -> FlankContact:
    arc = np.linspace(0.0, 4.0, points)
    return PrescribedMechanism(
        kind=ContactKind.LOCAL,
        arc_length=arc,
        load_per_width=np.full(points, 200.0),
        slip=1.0 + ripple * np.cos(0.5 * np.pi * arc),
        sliding_speed=np.full(points, np.nan),
        flank_curvature=np.zeros(points),
        mate_radius=5.0,
        modulus=1e5,
    ).contact


def ended(life: float, depth: tuple[float, ...] = (0.01, 0.01, 0.01)) -> Trajectory:
    """Return a run that reached its limit after a number of cycles."""
    shape = np.array([np.zeros(len(depth)), depth])
    place = np.tile(np.arange(len(depth), dtype=float), (2, 1))
    return Trajectory(np.array([0.0, life]), place, 0.0 * place, shape, LIMIT, 1)


def test_error_of_first_order_is_found_from_one_grid() -> None:
    """Lives 1 + 0.3 h: on h = 0.1 the error is 0.03, whichever other grid tells it."""
    for other in (0.2, 0.4, 0.02):
        told = grid_error(0.1, [(other, 0.3 * abs(other - 0.1))])
        assert told == pytest.approx(SAFETY * 0.03, rel=1e-12)


def test_errors_of_both_ends_that_cancel_on_one_grid_are_seen_on_another() -> None:
    assert grid_error(0.1, [(0.2, 0.0), (0.02, 0.004)]) == pytest.approx(SAFETY * 0.005, rel=1e-12)


@pytest.mark.parametrize(
    ("error", "tolerance", "expected"),
    [
        (0.0312, 0.01, "numerical error 0.031 exceeds the tolerance 0.01"),
        (0.01004, 0.01, "numerical error 0.01004 exceeds the tolerance 0.01"),
        (1e-3 * (1 + 1e-6), 1e-3, "numerical error 0.001000001 exceeds the tolerance 0.001"),
    ],
)
def test_error_beyond_its_tolerance_is_printed_as_more(error: float, tolerance: float, expected: str) -> None:
    assert exceeds(error, tolerance) == expected


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

    def run_on(grid: FlankContact) -> Trajectory:
        return run_advance(WearProblem(grid, law, (LIMIT,), 1e12), 1e-7)[0]

    given = contact(81, ripple=-0.5)
    study = grid_study(given, run_on)
    assert study.points == (81, 41, 21)
    assert 1.9 < study.order < 2.1
    fine, middle, _ = study.values
    assert study.error == pytest.approx(abs(middle / fine - 1.0) / 3.0, rel=0.1)
    # A bound that does not lean on the order: the half and the quarter, the latter for a third.
    half, quarter = (abs(life / fine - 1.0) for life in study.values[1:])
    assert study.error < grid_error(0.05, [(0.1, half), (0.2, quarter)]) < 5.0 * half
