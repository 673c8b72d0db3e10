"""What ends a life; the first stop limit that is met is named."""

from collections.abc import Callable
from dataclasses import dataclass

from wearsim.geometry.profile_points import Vector


@dataclass(frozen=True)
class StopLimit:
    """A limit on the worn flank."""

    name: str  # key of the quantity with its unit, as in the input file
    limit: float  # value at which the life ends
    # of x, y and depth [mm]; above zero as long as the limit is not met
    margin: Callable[[Vector, Vector, Vector], float]
    falling: bool = False  # whether the quantity falls to its limit, instead of rising to it

    def value(self, x: Vector, y: Vector, depth: Vector) -> float:
        """Return what the quantity has come to."""
        margin = self.margin(x, y, depth)
        return self.limit + margin if self.falling else self.limit - margin


def depth_limit(critical_depth: float) -> StopLimit:
    """Return the source's stop limit, physics.md (12): the deepest point reaches a depth."""
    return rising("critical_depth_mm", critical_depth, lambda x, y, depth: float(depth.max()))


def rising(name: str, limit: float, value: Callable[[Vector, Vector, Vector], float]) -> StopLimit:
    """Return the stop limit that a quantity rises to a limit.

    Examples
    --------
    >>> import numpy as np
    >>> depth = rising("case_depth_mm", 0.5, lambda x, y, depth: float(depth.max()))
    >>> depth.margin(np.zeros(2), np.zeros(2), np.array([0.1, 0.25]))
    0.25
    """
    return StopLimit(name, limit, lambda x, y, depth: limit - value(x, y, depth))


def falling(name: str, limit: float, value: Callable[[Vector, Vector, Vector], float]) -> StopLimit:
    """Return the stop limit that a quantity falls to a limit.

    Examples
    --------
    >>> import numpy as np
    >>> tip = falling("min_tip_land_mm", 1.0, lambda x, y, depth: 1.5)
    >>> tip.margin(np.zeros(2), np.zeros(2), np.zeros(2))
    0.5
    """
    return StopLimit(name, limit, lambda x, y, depth: value(x, y, depth) - limit, True)


def tip_land_limit(min_tip_land: float, tip_land: Callable[[Vector, Vector], float]) -> StopLimit:
    """Return the stop limit that the worn tip keeps a least length."""
    return falling("min_tip_land_mm", min_tip_land, lambda x, y, depth: tip_land(x, y))


def jump_limit(slack_tension: float) -> StopLimit:
    """Return the stop limit that a chain meets when it jumps on the worn teeth."""
    return StopLimit("min_slack_tension_N", slack_tension, lambda x, y, depth: 0.0)


def first_limit_met(
    stop_limits: "tuple[StopLimit, ...]", x: Vector, y: Vector, depth: Vector
) -> StopLimit | None:
    """Return the stop limit that a worn flank fails by most, if any."""
    margins = [(stop_limit.margin(x, y, depth), stop_limit) for stop_limit in stop_limits]
    worst = min(margins, key=lambda pair: pair[0])
    return worst[1] if worst[0] <= 0.0 else None
