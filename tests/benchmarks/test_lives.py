"""A whole life of the reference run."""

import pytest

from tests.drives import depth_limit
from wearsim.wear.advance import run_advance
from wearsim.wear.problem import WearProblem


@pytest.mark.parametrize("tolerance", [1e-3, 1e-4])
def test_advance_reference_run(benchmark, reference_contact, tolerance):
    """8.1389e4 cycles to 0.2 mm: two independent programs, docs/physics.md, "Reference run"."""
    contact, law = reference_contact(201)
    stop_limits = (depth_limit(0.2),)
    run, _ = benchmark(lambda: run_advance(WearProblem(contact, law, stop_limits, 1e9), tolerance))
    assert run.cycles[-1] == pytest.approx(8.1389e4, rel=5e-4)
