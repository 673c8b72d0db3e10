"""Benchmark B9 cycle by cycle, all 26 million of them, where the quick tests use advance.

Expected lives: two independent programs with the rounded Hertz coefficient 0.418, so the exact
coefficient sqrt(1/(2 pi (1 - nu^2))) shortens them by the ratio of both.
"""

import math

import numpy as np
import pytest

from tests.drives import depth_limit
from wearsim.contact.engagement import ContactKind
from wearsim.contact.hertz import contact_modulus
from wearsim.mechanisms.prescribed.contact import PrescribedMechanism
from wearsim.wear.law import archard
from wearsim.wear.loop import run_per_cycle
from wearsim.wear.problem import WearProblem

EXACT = 0.418 / math.sqrt(1.0 / (2.0 * math.pi * (1.0 - 0.3**2)))


@pytest.mark.slow
@pytest.mark.parametrize(("rows", "rounded"), [(200, 26_114_833.8), (500, 26_114_900.2)])
def test_b9_cycle_by_cycle(rows, rounded):
    u = np.linspace(0.0, 1.0, rows)
    mechanism = PrescribedMechanism(
        kind=ContactKind.LOCAL,
        arc_length=6.0 * u,
        load_per_width=100.0 * (0.2 + 0.8 * np.cos(0.5 * np.pi * u)),
        slip=0.05 + 0.4 * u,
        sliding_speed=np.full(rows, np.nan),
        flank_curvature=np.full(rows, 1.0 / 39.1),
        mate_radius=6.035,
        modulus=contact_modulus((2.1e5, 2.1e5), (0.3, 0.3)),
    )
    run = run_per_cycle(WearProblem(mechanism.contact, archard(1e-10), (depth_limit(0.5),), 1e8), 1)
    assert run.cycles[-1] == pytest.approx(rounded * EXACT, rel=1e-7)
