"""Wear of the chain's joints: pins in bushes under the tension of the strands."""

import math


def elongation_per_loop(
    specific_wear_rate: float,
    pressures: tuple[float, float],
    pin_diameter: float,
    pitch: float,
    teeth: tuple[float, float],
) -> float:
    """Return how much a chain grows in one loop around two sprockets.

    A joint turns by 2 pi/z where it comes onto a sprocket and where it leaves it, once
    under the tight tension and once under the slack one. Its pin slides pi d2/z each time,
    so Archard's law gives d(eps)/d(loop) = k (p_tight + p_slack) pi d2 (1/z1 + 1/z2)/p,
    equation (4.1) of the reference with its slack part.

    Equation physics.md (E1).

    Parameters
    ----------
    specific_wear_rate : float
        k of pin and bush together [mm2/N].
    pressures : tuple of float
        Tension of the tight and of the slack strand over the bearing area [MPa].
    pin_diameter : float
        d2 [mm].
    pitch : float
        p [mm].
    teeth : tuple of float
        z1 and z2, rollers per turn.

    Returns
    -------
    float
        Relative elongation per loop.

    Examples
    --------
    1e-9 mm2/N at 20 MPa over pi 5 (1/20 + 1/20) mm on a pitch of 10 mm:

    >>> round(elongation_per_loop(1e-9, (20.0, 0.0), 5.0, 10.0, (20, 20)) / (1e-9 * math.pi), 12)
    1.0
    """
    path = math.pi * pin_diameter * (1.0 / teeth[0] + 1.0 / teeth[1])
    return specific_wear_rate * sum(pressures) * path / pitch
