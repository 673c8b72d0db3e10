"""A worn sprocket turned round, so that its other flank works."""

import numpy as np
from numpy.typing import NDArray

from wearsim.case.model import Case
from wearsim.contact.criteria import Criterion, rising
from wearsim.contact.resting_engagement import NEW_CHAIN, ChainWear
from wearsim.geometry.profile import Vector
from wearsim.mechanisms.wrap.contact import WrapContact
from wearsim.result import Life, LowerBound, WearResult, life_of
from wearsim.simulation.task import wear_law
from wearsim.simulation.wrap_life import wrap_of
from wearsim.wear.bodies import Start
from wearsim.wear.halving import advance_dwelling


def turned_life(case: Case, first: WearResult) -> tuple[Life | LowerBound, float]:
    """Return how long a worn sprocket lives when it is turned onto its other flank."""
    contact = wrap_of(case).contact(case)
    points = contact.profile.x.size
    depth = first.flank_columns["depth_mm"][-contact.bodies * points :].reshape(-1, points)
    history = first.history_columns
    wear = ChainWear(0.01 * float(history["elongation_percent"][-1]), float(history["roller_wear_mm"][-1]))
    chain = int(history["chain"][-1])
    if wear.elongation >= contact.elongation_limit * (1.0 - 1e-9):
        wear, chain = NEW_CHAIN, chain + 1
    turned = contact.on_outline(contact.profile.mirrored()).thinned()
    start = Start(depth[:, ::-1].copy(), wear, chain)
    criteria = _criteria(case, turned, _working_half(contact, depth))
    profile = turned.profile
    margins = [criterion.margin(*profile.receded(d), d) for criterion in criteria for d in start.depth]
    if min(margins) <= 0.0:
        return Life(0.0, 0.0), 0.0
    run, error = advance_dwelling(
        turned,
        wear_law(case.wear, case.wear.coefficient),
        criteria,
        case.run.horizon_hours * case.cycles_per_hour,
        case.run.life_tolerance,
        start,
    )
    return life_of(float(run.cycles[-1]), case.cycles_per_hour, run.met is not None), error


def _working_half(contact: WrapContact, depth: Vector) -> NDArray[np.bool_]:
    """Points of the mirrored outline on the side that wore, which is where the load will be again."""
    x, arc = contact.profile.x, contact.arc_length
    worn = depth.sum(axis=0) * np.gradient(arc)
    side = 1.0 if worn[x > 0.0].sum() >= worn[x < 0.0].sum() else -1.0
    return side * contact.profile.mirrored().x >= 0.0


def _criteria(case: Case, contact: WrapContact, half: NDArray[np.bool_]) -> tuple[Criterion, ...]:
    """The limits of the case, those on the depth for the half that works."""
    found = []
    for criterion in wrap_of(case).gap_limits(case, contact.mechanism.path):
        of_half = criterion.name in ("critical_depth_mm", "case_depth_mm")
        found.append(
            rising(criterion.name, criterion.limit, lambda x, y, depth: float(depth[half].max()))
            if of_half
            else criterion
        )
    return tuple(found)
