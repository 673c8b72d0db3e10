"""Where inside a step a stop limit is met: by bisection, or on a path by Brent's method on the margin.

The reference loop goes back to the update itself (`_retreat` and `_on_limit` of `wearsim.wear.loop`), by
`first_place` from here; a depth on the path of one flank is found in the kernel, `part_to_depth`.
"""

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING, TypeVar

from wearsim.contact.resting_engagement import RestingContact
from wearsim.contact.stop_limits import StopLimit, jump_limit
from wearsim.wear.problem import Rows, WearProblem

if TYPE_CHECKING:  # flanks wear without resting bodies
    from wearsim.wear.resting_bodies import WornBodies, WornState

AnyNumber = TypeVar("AnyNumber", int, float)


def first_place(fails: Callable[[AnyNumber], bool], low: AnyNumber, high: AnyNumber) -> AnyNumber:
    """Return the first place at which a limit fails, by bisection to the last bit or the last whole number.

    Examples
    --------
    >>> first_place(lambda part: part >= 0.3, 0.0, 1.0), first_place(lambda update: update >= 3, 0, 10)
    (0.3, 3)
    """
    while True:
        middle = (low + high) // 2 if isinstance(high, int) else 0.5 * (low + high)
        if not low < middle < high:
            return high
        low, high = (low, middle) if fails(middle) else (middle, high)


def first_limit_on_path(
    limits: Sequence[StopLimit],
    state: Callable[[float], Rows],
    span: tuple[float, float],
    last: Rows,
    before: tuple[float, StopLimit | None],
) -> tuple[float, StopLimit | None]:
    """Return when in a step on a path the first of the limits that fail at its last state is met.

    That is x, y and depth, as are those of `state` by the time within the span of the step; `before`
    is the end that is known already, and its limit.
    """
    from scipy.optimize import brentq  # takes 0.1 s, and most runs end on the depth

    (low, high), (end, met) = span, before
    for stop_limit in limits:
        if stop_limit.margin(*last) > 0.0:
            continue
        # What brentq is given refers to itself from then on, and stays until Python collects garbage.
        margin = partial(_margin, state, stop_limit)
        time = brentq(margin, low, high, rtol=1e-14, xtol=1e-300) if margin(low) > 0.0 else low
        if time < end or (time == end and met is None):
            end, met = float(time), stop_limit
    return end, met


def _margin(state: Callable[[float], Rows], stop_limit: StopLimit, time: float) -> float:
    return stop_limit.margin(*state(time))


def limit_of_bodies(problem: WearProblem[RestingContact], bodies: "WornBodies") -> StopLimit | None:
    """Return the limit that the first of the bodies to fail one fails by most, if any."""
    found = (problem.met(*body) for body in zip(bodies.x, bodies.y, bodies.depth, strict=True))
    return next((stop_limit for stop_limit in found if stop_limit is not None), None)


def go_back_to_limit(
    problem: WearProblem[RestingContact], bodies: "WornBodies", before: "WornState"
) -> StopLimit | None:
    """Return the limit that the last step has met, if any, and go back to where it was met."""
    contact, met = problem.contact, limit_of_bodies(problem, bodies)
    if met is not None:
        _go_back_to_first(bodies, before, lambda: limit_of_bodies(problem, bodies) is not None)
    if not contact.holds(bodies.x, bodies.y, bodies.wear):
        met = jump_limit(contact.slack_limit)
        _go_back_to_first(bodies, before, lambda: not contact.holds(bodies.x, bodies.y, bodies.wear))
    return met


def _go_back_to_first(bodies: "WornBodies", before: "WornState", fails: Callable[[], bool]) -> None:
    """Go back on the last step to the first place at which something fails."""
    after = bodies.state()

    def fails_after(part: float) -> bool:
        bodies.go_back(bodies.on_the_way(before, after, part))
        return fails()

    bodies.go_back(bodies.on_the_way(before, after, first_place(fails_after, 0.0, 1.0)))
