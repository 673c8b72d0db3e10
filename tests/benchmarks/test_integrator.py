"""One solve in long steps: benchmark B9 on 500 nodes, the strand with m = 1 on 200 nodes.

Goal on B9: within 1e-4 of 26 114 900 cycles in at most 1 ms warm (recorded: it depends on the
machine). Other methods and tolerances: reports/reference/work_precision.md.
"""

import math

import numpy as np
import pytest

from tests.drives import depth_limit
from wearsim.contact.engagement import ContactKind
from wearsim.drive.load_case import load_case
from wearsim.kernels.controlled_steps import CLOCK, END, RATES, STATE_ROWS, wear_in_steps
from wearsim.kernels.hertz_wear import DEPTH_REACHED
from wearsim.kernels.rosenbrock import STAGES, WORK_ROWS, rosenbrock_step
from wearsim.mechanisms.prescribed.contact import PrescribedMechanism
from wearsim.wear.law import archard
from wearsim.wear.loop import run_per_cycle
from wearsim.wear.problem import WearProblem

TOLERANCE = 1e-4
STRAND = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "sprocket": {"teeth": 20, "profile": "evolute", "evolute_offset_mm": 5.5, "nodes": 200},
    "load": {"tension_N": 5000, "speed_rpm": 100},
    "wear": {"law": "archard", "specific_wear_rate_mm2_per_N": 5e-11},
    "stop": {"critical_depth_mm": 0.2},
}


def b9_contact():
    """Flank arc R 39.1 mm, 6 mm long; the modulus makes p = 0.418 sqrt(q E/rho_H) exact."""
    u = np.linspace(0.0, 1.0, 500)
    return PrescribedMechanism(
        kind=ContactKind.LOCAL,
        arc_length=6.0 * u,
        load_per_width=100.0 * (0.2 + 0.8 * np.cos(0.5 * np.pi * u)),
        slip=0.05 + 0.4 * u,
        sliding_speed=np.full(u.size, np.nan),
        flank_curvature=np.full(u.size, 1.0 / 39.1),
        mate_radius=6.035,
        modulus=math.pi * 0.418**2 * 2.1e5,
    ).contact


class Solve:
    """The compiled solve of a contact under Archard's law of coefficient 1."""

    def __init__(self, contact, limit, ends_bend):
        self.contact, self.limit, self.ends = contact, limit, int(ends_bend)
        profile = contact.profile
        self.start = np.array([profile.x, profile.y, np.zeros(profile.x.size)])
        points = profile.x.size
        self.state, self.clock = self.start.copy(), np.zeros(CLOCK)
        self.work, self.increments = np.zeros((WORK_ROWS, points)), np.zeros((STAGES, 3 * points))
        self.times, self.path = np.zeros(2), np.zeros((2, STATE_ROWS, points))
        law = archard(1.0)
        self.law = law.numbers(contact.kind)
        self.diffusion = law.diffusion(contact.kind, contact.slip_curvature_exponent)

    def __call__(self):
        contact = self.contact
        self.state[:], self.clock[:] = self.start, 0.0
        return wear_in_steps(
            rosenbrock_step,
            contact.kernel,
            self.state,
            contact.constants,
            contact.columns,
            contact.modulus,
            self.law,
            self.diffusion,
            self.ends,
            self.limit,
            TOLERANCE,
            1e6,
            2**62,
            self.work,
            self.increments,
            self.clock,
            self.times,
            self.path,
        )

    def measured(self, benchmark):
        """Benchmark the solve; return the life in cycles times coefficient."""
        assert benchmark(self) == DEPTH_REACHED
        benchmark.extra_info.update(nodes=self.start.shape[1], rates=int(self.clock[RATES]))
        return self.clock[END]


def test_solve_of_b9(benchmark):
    """26 114 900 cycles were confirmed cycle by cycle by a program of its own."""
    life = Solve(b9_contact(), 0.5, False).measured(benchmark) / 1e-10
    benchmark.extra_info["life_error"] = life / 26_114_900.2 - 1.0
    assert life == pytest.approx(26_114_900, rel=1e-4)


def test_solve_of_the_strand(benchmark):
    """Against the loop over updates of 1000 cycles, some 15 000 of them, explicit and stable."""
    case = load_case(STRAND)
    contact = case.drive.mechanism(case).contact
    life = Solve(contact, 0.2, True).measured(benchmark) / 5e-11
    loop = run_per_cycle(WearProblem(contact, archard(5e-11), (depth_limit(0.2),), 1e9), 1000)
    benchmark.extra_info["life_error"] = life / float(loop.cycles[-1]) - 1.0
    assert life == pytest.approx(float(loop.cycles[-1]), rel=1e-4)
