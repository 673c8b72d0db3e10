"""Spans and arcs of a closed chain round circles: direction, length, wrap angle, links."""

import math

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

FULL_TURN = 2.0 * math.pi


def span_tangents(centres: Floats, signed_radii: Floats) -> tuple[Floats, Floats]:
    """Return direction and length of the tangents from each circle to the next one round a loop.

    With d the distance of two centres, phi the direction from one to the other and k the difference of the
    signed radii, the direction is phi - asin(k/d) and the length sqrt(d^2 - k^2): open
    tangents where both signs are the same, crossed ones where not.

    Equations physics.md (D1) and (D2).

    Parameters
    ----------
    centres : ndarray, shape (n, 2)
        Centres of the circles in the order of the loop [mm].
    signed_radii : ndarray, shape (n,)
        Pitch radius [mm], above 0 where the chain turns counter-clockwise, below 0 where clockwise.

    Returns
    -------
    tuple of ndarray, shape (n,)
        Direction [rad] and length [mm] of the span after each circle; nan where no tangent exists.

    Examples
    --------
    Circles of radius 3 on both sides of a straight line 8 long, 10 apart: 8^2 = 10^2 - 6^2.

    >>> span_tangents(np.array([[0.0, 0.0], [10.0, 0.0]]), np.array([3.0, -3.0]))[1]
    array([8., 8.])
    """
    apart = np.roll(centres, -1, axis=0) - centres
    distance = np.hypot(*apart.T)
    step = np.roll(signed_radii, -1) - signed_radii
    with np.errstate(invalid="ignore", divide="ignore"):
        angles = np.arctan2(apart[:, 1], apart[:, 0]) - np.arcsin(step / distance)
        return angles, np.sqrt(distance**2 - step**2)


def wrap_angles(span_angles: Floats, senses: Floats) -> Floats:
    """Return the angle by which the chain turns on each wheel between its two spans.

    Equation physics.md (D3).

    Parameters
    ----------
    span_angles : ndarray, shape (n,)
        Direction of the span after each wheel [rad].
    senses : ndarray, shape (n,)
        1 where the chain turns counter-clockwise, -1 where clockwise.

    Returns
    -------
    ndarray, shape (n,)
        Wrap angles from 0 to below 2 pi [rad].

    Examples
    --------
    >>> wrap_angles(np.array([0.0, np.pi]), np.array([1.0, 1.0])) / np.pi  # half a turn each
    array([1., 1.])
    """
    return np.mod(senses * (span_angles - np.roll(span_angles, 1)), FULL_TURN)


def links_round(pitch: float, span_lengths: Floats, wrap_angles: Floats, teeth: Floats) -> float:
    """Return the links of a closed chain, the spans over the pitch and the teeth in mesh.

    For two wheels it is `belt_links`.

    Equation physics.md (D5).

    Parameters
    ----------
    pitch : float
        Pitch of the chain as it is, elongated or not [mm].
    span_lengths : ndarray, shape (n,)
        Lengths of the spans [mm].
    wrap_angles : ndarray, shape (n,)
        Wrap angles [rad].
    teeth : ndarray, shape (n,)
        Teeth of the wheels.

    Returns
    -------
    float
        Links, in general no whole number.

    Examples
    --------
    Two spans of 30 pitches and half of 20 teeth twice:

    >>> links_round(10.0, np.array([300.0, 300.0]), np.full(2, np.pi), np.full(2, 20.0))
    80.0
    """
    return float(np.sum(span_lengths) / pitch + np.sum(wrap_angles * teeth) / FULL_TURN)
