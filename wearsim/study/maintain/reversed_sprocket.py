"""A worn sprocket turned round, so that its other flank works."""

import numpy as np
from numpy.typing import NDArray

from wearsim.case.model import Case
from wearsim.contact.resting_engagement import NEW_MATE, MateWear, RestingContact
from wearsim.contact.stop_limits import LIMITS, StopLimit, deepest, stop_limit
from wearsim.drive.wear_task import wear_law
from wearsim.drive.wrap_life import wrap_of
from wearsim.geometry.profile_points import Vector
from wearsim.mechanisms.wrap.contact import WrapContact
from wearsim.result import Life, LowerBound, WearResult, life_of
from wearsim.wear.problem import StartState, WearProblem
from wearsim.wear.settled_run import advance_resting


def reversed_life(case: Case, first: WearResult) -> tuple[Life | LowerBound, float]:
    """Return how long a worn sprocket lives when it is turned onto its other flank."""
    contact = wrap_of(case).contact(case)
    points = contact.profile.x.size
    depth = first.flank_columns["depth_mm"][-contact.bodies * points :].reshape(-1, points)
    history = first.history_columns
    wear = MateWear(0.01 * float(history["elongation_percent"][-1]), float(history["roller_wear_mm"][-1]))
    chain = int(history["chain"][-1])
    if wear.elongation >= contact.elongation_limit * (1.0 - 1e-9):
        wear, chain = NEW_MATE, chain + 1
    reversed_ = contact.on_outline(contact.profile.mirrored())
    start = StartState(depth[:, ::-1].copy(), wear, chain)
    stop_limits = _stop_limits(case, reversed_, _working_half(contact, depth))
    profile = reversed_.profile
    margins = [one.margin(*profile.receded(d), d) for one in stop_limits for d in start.depth]
    if min(margins) <= 0.0:
        return Life(0.0, 0.0), 0.0
    law, horizon = wear_law(case.wear, case.wear.coefficient), case.run.horizon_hours * case.cycles_per_hour
    problem = WearProblem[RestingContact](reversed_, law, stop_limits, horizon, start)
    run, error = advance_resting(problem, case.run.life_tolerance)
    return life_of(float(run.cycles[-1]), case.cycles_per_hour, run.met is not None), error


def _working_half(contact: WrapContact, depth: Vector) -> NDArray[np.bool_]:
    """Points of the mirrored outline on the side that wore, which is where the load will be again."""
    x, arc = contact.profile.x, contact.arc_length
    worn = depth.sum(axis=0) * np.gradient(arc)
    side = 1.0 if worn[x > 0.0].sum() >= worn[x < 0.0].sum() else -1.0
    return side * contact.profile.mirrored().x >= 0.0


def _stop_limits(case: Case, contact: WrapContact, half: NDArray[np.bool_]) -> tuple[StopLimit, ...]:
    """The limits of the case, those on the depth for the half that works."""
    return tuple(
        stop_limit(one.name, one.limit, lambda x, y, depth: float(depth[half].max()))
        if LIMITS[one.name].worn is deepest
        else one
        for one in wrap_of(case).gap_limits(case, contact.mechanism.path)
    )
