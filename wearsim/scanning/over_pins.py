"""The measurement over pins that a photograph tells: pins of the roller's diameter in the mean gap."""

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize_scalar

from wearsim.geometry.profile_points import Vector
from wearsim.geometry.worn_tooth import measurement_over_pins
from wearsim.scanning.flank_depths import FlankDepths

_DIRECTIONS = 81
"""Directions in which the pin's centre is looked for before the lowest one is refined."""


@dataclass(frozen=True)
class OverPins:
    """Measurement over two pins in opposite gaps, or in the two nearest to opposite ones."""

    pin_diameter: float  # that of the roller [mm]
    size: float  # the measurement [mm]
    decrease: float  # how much less it is than that of the new form [mm]
    error: float  # standard error of both [mm]


def over_pins(depths: FlankDepths) -> OverPins | None:
    """Return what pins would read in the mean gap; None where no roller belongs to the wheel."""
    wheel = depths.place.wheel
    pin = wheel.roller_diameter
    if pin is None:
        return None
    new, found = (_size(gap, pin, wheel.teeth) for gap in (wheel.gap, depths.worn_gap))
    moved = [_size(depths.gap_of(depths.mean + off), pin, wheel.teeth) - found for off in depths.deviations]
    return OverPins(pin, found, new - found, float(np.linalg.norm(moved)))


def _size(gap: Vector, pin_diameter: float, teeth: int) -> float:
    return measurement_over_pins(seated_radius(gap, 0.5 * pin_diameter, teeth), pin_diameter, teeth)


def seated_radius(gap: Vector, pin_radius: float, teeth: int) -> float:
    """Return how near to the axis the centre of a pin comes in a gap about +y [mm].

    Examples
    --------
    A pin of radius 5 on two corners that are 8 apart: sqrt(25 - 16) above them.

    >>> corners = np.array([[4.0, 30.0], [4.0, 20.0], [0.0, 15.0], [-4.0, 20.0], [-4.0, 30.0]])
    >>> round(seated_radius(corners[1:4], 5.0, 20), 6)
    23.0
    """

    def stop(angle: float) -> float:
        """Return where the pin stops that comes to the axis from this direction."""
        along = gap @ np.array([math.sin(angle), math.cos(angle)])
        across = gap @ np.array([math.cos(angle), -math.sin(angle)])
        reached = np.abs(across) <= pin_radius
        return float((along[reached] + np.sqrt(pin_radius**2 - across[reached] ** 2)).max())

    angles = np.linspace(-0.5, 0.5, _DIRECTIONS) * math.pi / teeth
    best = int(np.argmin([stop(angle) for angle in angles]))
    low, high = angles[max(best - 1, 0)], angles[min(best + 1, _DIRECTIONS - 1)]
    return float(minimize_scalar(stop, bounds=(low, high), method="bounded", options={"xatol": 1e-8}).fun)
