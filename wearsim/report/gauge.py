"""A go/no-go gauge: the outline of the gap between two teeth at the limit of their wear.

It fills the gap of a wheel that is worn out and hangs on the tips beside it by two shoulders. On a
tooth that is not worn out it does not go down to the tips.
"""

import math
from dataclasses import dataclass

from wearsim.geometry.outline import turned
from wearsim.geometry.stretch import angle_between, arc_about_axis, line
from wearsim.geometry.wheel import Chain
from wearsim.report.wheel_shapes import WheelShape

_HEAD = 0.5
_LEAST_HEAD = 20.0
"""Height of the gauge above the tips: part of the pitch, and its least [mm]."""


@dataclass(frozen=True, eq=False)
class Gauge:
    """A gauge in the frame of its space, whose centre line is +y.

    Attributes
    ----------
    name : str
        Of the wheel.
    outline : Chain
        Closed: the gap at the limit, shoulders along the tips, head.
    new : tuple of Chain
        The new gap, for comparison.
    pitch_radius, tip_radius : float
        Of the wheel [mm].
    """

    name: str
    outline: Chain
    new: tuple[Chain, ...]
    pitch_radius: float
    tip_radius: float

    @property
    def box(self) -> tuple[float, float, float, float]:
        """Left, bottom, width and height [mm]."""
        points = self.outline.vertices
        # Arcs of the bottom and the head bulge beyond their vertices.
        low, high = points.min(axis=0) - 1.0, points.max(axis=0) + 1.0
        return float(low[0]), float(low[1]), *(high - low).tolist()


def gauge(shape: WheelShape) -> Gauge:
    """Return the gauge of a wheel that is worn to its limit.

    Parameters
    ----------
    shape : WheelShape
        The wheel with its worn spaces.

    Returns
    -------
    Gauge
        Of the space worn most.
    """
    worn, new = shape.worn[shape.most_worn], shape.new[shape.most_worn]
    sides = worn.right + worn.left
    if not worn.rooted:
        sides = (
            *worn.right,
            *line("root", worn.right[-1].vertices[-1], worn.left[0].vertices[0]),
            *worn.left,
        )
    right, left = sides[0].vertices[0], sides[-1].vertices[-1]
    land = math.tau / len(shape.new) - angle_between(right, left)
    half = 0.5 * max(land, 0.0)
    top = shape.tip_radius + max(
        _LEAST_HEAD, _HEAD * math.tau * shape.pitch_radius / len(shape.new)
    )
    left_end, right_end = turned(left, half), turned(right, -half)
    upper_left = left_end * (top / math.hypot(*left_end))
    upper_right = right_end * (top / math.hypot(*right_end))
    head = (
        *arc_about_axis("shoulder", left, left_end),
        *line("head", left_end, upper_left),
        *line("head", upper_left, upper_right),
        *line("head", upper_right, right_end),
        *arc_about_axis("shoulder", right_end, right),
    )
    stretches = (*sides, *head)
    fresh = (new.right + new.left,) if new.rooted else (new.right, new.left)
    return Gauge(
        shape.name,
        Chain(stretches, (1,) * len(stretches), True),
        tuple(Chain(row, (1,) * len(row), False) for row in fresh),
        shape.pitch_radius,
        shape.tip_radius,
    )
