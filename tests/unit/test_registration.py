"""Measured points laid on a profile by least squares."""

import numpy as np
import pytest

from wearsim.errors import GeometryError
from wearsim.geometry.measured.registration import feet, register
from wearsim.geometry.profile_points import Profile

RADIUS, CENTRE = 30.0, (25.0, 60.0)


def flank(points=601):
    """An arc of 30 mm radius whose material is on the left of the gap."""
    angle = np.linspace(np.pi + 0.35, np.pi - 0.15, points)
    x, y = CENTRE[0] + RADIUS * np.cos(angle), CENTRE[1] + RADIUS * np.sin(angle)
    return Profile(x, y)


def worn(depth):
    """Dense points behind the new arc by a depth that grows along it."""
    angle = np.linspace(np.pi + 0.33, np.pi - 0.13, 400)
    share = (np.pi + 0.33 - angle) / 0.46
    radius = RADIUS + depth * share
    return CENTRE[0] + radius * np.cos(angle), CENTRE[1] + radius * np.sin(angle), share


def moved(x, y, turn, shift):
    c, s = np.cos(turn), np.sin(turn)
    return c * x - s * y + shift[0], s * x + c * y + shift[1]


def test_feet_on_a_circle():
    x, y, share = worn(0.2)
    arc, recess = feet(flank(), x, y)
    assert recess == pytest.approx(0.2 * share, abs=4e-6)
    # Arc length from the root end, RADIUS times the angle.
    assert arc == pytest.approx(RADIUS * (0.02 + 0.46 * share), abs=2e-4)


@pytest.mark.parametrize("turn", [-0.02, 0.0, 0.01])
def test_a_turn_is_found(turn):
    x, y, _ = worn(0.0)
    found = register(flank(), *moved(x, y, turn, (0.0, 0.0)), "turn")
    assert found.turn == pytest.approx(-turn, abs=1e-6)
    assert np.abs(found.recess).max() < 5e-6
    assert found.moves.shape == (found.recess.size, 1)


def test_none_moves_nothing():
    x, y, _ = worn(0.0)
    found = register(flank(), *moved(x, y, 1e-3, (0.0, 0.0)), "none")
    assert (found.turn, found.shift_x, found.shift_y) == (0.0, 0.0, 0.0)
    assert np.abs(found.recess).max() > 0.05
    assert found.moves.shape == (found.recess.size, 0)


def test_shifts_are_taken_up():
    """On an arc alone turn and shift along it are one, so that only the fit is unique."""
    x, y, _ = worn(0.0)
    found = register(flank(), *moved(x, y, 0.004, (0.05, -0.08)), "free")
    assert np.abs(found.recess).max() < 1e-5


def test_moves_are_the_derivatives_of_the_recess():
    nominal = flank()
    x, y, _ = worn(0.1)
    found = register(nominal, x, y, "none")
    step = 1e-5
    whole = register(nominal, x, y, "free", expected=None)
    at = moved(x, y, whole.turn, (whole.shift_x, whole.shift_y))
    size = float(np.hypot(*at).max())
    for column, (turn, shift) in enumerate(
        [(step / size, (0.0, 0.0)), (0.0, (step, 0.0)), (0.0, (0.0, step))]
    ):
        after = feet(nominal, *moved(*at, turn, shift))[1]
        change = (after - whole.recess) / step
        assert change == pytest.approx(whole.moves[:, column], abs=2e-3 * np.abs(change).max())
    assert found.left_out == 0


def test_what_is_expected_is_not_taken_for_a_movement():
    nominal = flank()
    x, y, share = worn(0.3)
    chords = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(nominal.x), np.diff(nominal.y)))])
    expected = 0.3 * np.clip((chords / RADIUS - 0.02) / 0.46, 0.0, 1.0)
    rotated = moved(x, y, 0.003, (0.0, 0.0))
    naive = register(nominal, *rotated, "turn")
    told = register(nominal, *rotated, "turn", expected)
    assert told.turn == pytest.approx(-0.003, abs=2e-6)
    assert abs(naive.turn + 0.003) > 1e-3
    assert told.recess == pytest.approx(0.3 * share, abs=2e-4)


def test_points_beyond_the_ends_are_left_out():
    x, y, _ = worn(0.0)
    beyond = flank(), np.append(x, [-4.0, 0.0]), np.append(y, [30.0, 100.0])
    assert register(*beyond, "none").left_out == 2


def test_points_of_something_else_are_refused():
    with pytest.raises(GeometryError, match="at least 11 points must lie on the profile"):
        register(flank(), np.full(20, 500.0), np.linspace(-900.0, -800.0, 20), "turn")
