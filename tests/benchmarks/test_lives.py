"""The prescribed kernel on benchmark B9's flank, and a whole life of the reference run."""

import numpy as np
import pytest

from wearsim.contact.engagement import Kind
from wearsim.contact.hertz import contact_modulus
from wearsim.kernels.cycles import run_cycles
from wearsim.kernels.wear import RUNNING
from wearsim.mechanisms.prescribed import PrescribedMechanism
from wearsim.wear.advance import run_advance
from wearsim.wear.criteria import depth_criterion
from wearsim.wear.law import archard

CYCLES = 2000


@pytest.mark.parametrize("nodes", [200, 500])
def test_prescribed_cycles(benchmark, start, nodes):
    """Flank arc R 39.1 mm, 6 mm long, roller radius 6.035 mm, sliding distance given."""
    u = np.linspace(0.0, 1.0, nodes)
    contact = PrescribedMechanism(
        kind=Kind.LOCAL,
        arc_length=6.0 * u,
        load_per_width=100.0 * (0.2 + 0.8 * np.cos(0.5 * np.pi * u)),
        slip=0.05 + 0.4 * u,
        sliding_speed=np.full(nodes, np.nan),
        flank_curvature=np.full(nodes, 1.0 / 39.1),
        roller_radius=6.035,
        modulus=contact_modulus((2.1e5, 2.1e5), (0.3, 0.3)),
    ).contact
    law = archard(1e-10)

    def run():
        state = start(contact)
        return run_cycles(
            contact.kernel, state.x, state.y, state.depth, contact.constants, contact.columns,
            state.work, contact.modulus, law.numbers(contact.kind),
            law.diffusion(contact.kind, 0.0), 1.0, 1.0, CYCLES, state.done,
        )  # fmt: skip

    benchmark.extra_info["point_cycles"] = CYCLES * nodes
    assert benchmark(run) == RUNNING


@pytest.mark.parametrize("tolerance", [1e-3, 1e-4])
def test_advance_reference_run(benchmark, reference_contact, tolerance):
    """8.1389e4 cycles to 0.2 mm: two independent programs, docs/physics.md, "Reference run"."""
    contact, law = reference_contact(201)
    criteria = (depth_criterion(0.2),)
    run, _ = benchmark(lambda: run_advance(contact, law, criteria, 1e9, tolerance))
    assert run.cycles[-1] == pytest.approx(8.1389e4, rel=5e-4)
