"""Worn depth and area converge as the grid is refined, for every mechanism without kinks.

Lives of gears, which have some, are in verification/test_gear_pair.py.

Expected: second order in the middle of the flank (three-point curvature), on a wrap 3/2, as there the
pressure falls off like a root at both ends of a contact; at least first order for the area, whose
ends and corners of the load share are not smooth.
"""

from collections.abc import Callable

import numpy as np
import pytest

from tests.drives import depth_limit
from wearsim.contact.engagement import ContactKind, Mechanism
from wearsim.geometry.profile_points import area_between
from wearsim.wear.advance import run_advance
from wearsim.wear.implicit_steps import run_seated
from wearsim.wear.law import power
from wearsim.wear.problem import WearProblem


@pytest.mark.wide
@pytest.mark.parametrize("exponent", [1.0, 1.5])
def test_order_of_convergence(smooth: Callable[..., Mechanism], exponent: float) -> None:
    law = power(1e-7 / 1000.0 ** (exponent - 1.0), exponent)
    contact = smooth(51).contact
    first, _ = run_advance(WearProblem(contact, law, (depth_limit(0.05),), 1e9), 1e-3)
    horizon, limits = float(first.cycles[-1]), (depth_limit(1.0),)
    depths, areas = [], []
    # On a wrap the ends of the contact, which lie between points, set the areas of coarser outlines.
    for nodes in (101, 201, 401) if contact.kind is ContactKind.RESTING else (51, 101, 201):
        finer = smooth(nodes).contact
        if contact.kind is ContactKind.RESTING:
            # As many steps on each: what a tolerance asks for is another number of phases.
            worn = run_seated(WearProblem(finer, law, limits, horizon), 3)
        else:
            worn, _ = run_advance(WearProblem(finer, law, limits, horizon), 1e-6)
        depths.append(worn.depth[-1][nodes // 2])
        areas.append(area_between(worn.x[0], worn.y[0], worn.x[-1], worn.y[-1]))
    coarse, fine = np.abs(np.diff(depths)) / depths[-1]
    assert fine <= coarse / 2.0 ** (1.5 if contact.kind is ContactKind.RESTING else 1.9) + 1e-6
    coarse, fine = np.abs(np.diff(areas)) / areas[-1]
    # On a wrap 1e-5 is what the balance of its rollers leaves.
    assert fine <= (coarse / 1.5 + 1e-5 if contact.kind is ContactKind.RESTING else coarse / 2.0)
    assert fine < 1e-3
