"""The production run: ends on its limit or horizon, refuses what it cannot do.

Expected: closed forms of a flat flank under constant load, depth per cycle I = k sigma s.
"""

import math
import re

import numpy as np
import pytest

from tests.drives import depth_limit
from wearsim.contact.engagement import ContactKind, FlankContact
from wearsim.contact.stop_limits import StopLimit
from wearsim.errors import ContactError, ConvergenceError
from wearsim.mechanisms.prescribed.contact import PrescribedMechanism
from wearsim.wear.advance import run_advance
from wearsim.wear.law import archard
from wearsim.wear.problem import WearProblem
from wearsim.wear.trajectory import difference

ROLLER, MODULUS, LOAD = 5.0, 1e5, 200.0
SIGMA = math.sqrt(LOAD * MODULUS / (math.pi * ROLLER))
STEP, DEPTH = 1e-7, 0.01
LAW, LIMIT = archard(STEP / SIGMA), (depth_limit(DEPTH),)


def contact(
    nodes: int = 41,
    load: float = LOAD,
    path: float = 1.0,
    ripple: float = 0.0,
    curvature: float = 0.0,
    kind: ContactKind = ContactKind.LOCAL,
) -> FlankContact:
    arc = np.linspace(0.0, 4.0, nodes)
    return PrescribedMechanism(
        kind=kind,
        arc_length=arc,
        load_per_width=np.full(nodes, load),
        slip=path * (1.0 + ripple * np.cos(0.5 * np.pi * arc)),
        sliding_speed=np.full(nodes, np.nan),
        flank_curvature=np.full(nodes, curvature),
        mate_radius=ROLLER,
        modulus=MODULUS,
    ).contact


@pytest.mark.parametrize("tolerance", [1e-2, 1e-4, 1e-6])
def test_uniform_wear_ends_on_the_limit(tolerance: float) -> None:
    run, error = run_advance(WearProblem(contact(), LAW, LIMIT, 1e9), tolerance)
    assert run.met is LIMIT[0]
    assert run.cycles[-1] == pytest.approx(DEPTH / STEP, rel=1e-9)
    np.testing.assert_allclose(run.depth[-1], DEPTH, rtol=1e-9)
    assert error <= tolerance


def test_horizon_ends_a_run_without_a_limit() -> None:
    run, _ = run_advance(WearProblem(contact(), LAW, LIMIT, 12345.0), 1e-4)
    assert run.met is None
    assert run.cycles[-1] == pytest.approx(12345.0, rel=1e-12)
    np.testing.assert_allclose(run.depth[-1], 12345.0 * STEP, rtol=1e-9)


@pytest.mark.parametrize("factor", [1.0 - 1e-6, 1.0 + 1e-6])
def test_limit_just_before_or_after_the_horizon(factor: float) -> None:
    run, _ = run_advance(WearProblem(contact(), LAW, LIMIT, factor * DEPTH / STEP), 1e-4)
    assert (run.met is None) == (factor < 1.0)


def test_first_of_two_limits_ends_the_run() -> None:
    tip = StopLimit("tip", -0.0031, lambda x, y, depth: float(y[-1]) + 0.0031)
    run, _ = run_advance(WearProblem(contact(), LAW, (*LIMIT, tip), 1e9), 1e-4)
    assert run.met is tip
    assert run.cycles[-1] == pytest.approx(0.0031 / STEP, rel=1e-9)


def test_cost_does_not_grow_with_the_cycles() -> None:
    few, _ = run_advance(WearProblem(contact(ripple=0.3), archard(1e-6 / SIGMA), LIMIT, 1e15), 1e-3)
    many, _ = run_advance(WearProblem(contact(ripple=0.3), archard(1e-12 / SIGMA), LIMIT, 1e15), 1e-3)
    assert many.cycles[-1] == pytest.approx(1e6 * few.cycles[-1], rel=1e-12)
    assert many.updates == few.updates


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4])
def test_life_keeps_the_tolerance(tolerance: float) -> None:
    exact = run_advance(WearProblem(contact(ripple=-0.5), LAW, LIMIT, 1e9), 1e-6)[0].cycles[-1]
    run, error = run_advance(WearProblem(contact(ripple=-0.5), LAW, LIMIT, 1e9), tolerance)
    assert run.cycles[-1] == pytest.approx(exact, rel=tolerance)
    assert 0.0 < error <= tolerance


def test_fine_grids_are_stable() -> None:
    """1601 points: the bound of an explicit update would be 1.25e-6 mm."""
    lives = [
        run_advance(WearProblem(contact(nodes, ripple=-0.5), LAW, LIMIT, 1e9), 1e-4)[0].cycles[-1]
        for nodes in (101, 401, 1601)
    ]
    assert lives == pytest.approx([lives[-1]] * 3, rel=1e-4)


@pytest.mark.parametrize(("given", "match"), [(contact(path=0.0), "slide"), (contact(load=0.0), "touch")])
def test_no_slip_or_no_load_is_an_error(given: FlankContact, match: str) -> None:
    with pytest.raises(ContactError, match=f"cycle 0.*{match}"):
        run_advance(WearProblem(given, LAW, LIMIT, 1e9), 1e-3)


def test_flank_that_comes_to_conform_names_cycle_and_place() -> None:
    """With a slip ratio at m = 1 nothing holds the curvature back.

    I = k q lambda gives w = I N (1 + 0.5 cos(pi x/2)), so 1/rho_H = 1/5 - 0.19 + w'' falls to 0
    where the cosine is 1, beside the ends x = 0 and 4, at I N = 0.01/(0.5 (pi/2)^2).
    """
    given = contact(201, path=0.5, ripple=0.5, curvature=-0.19, kind=ContactKind.TRAVELLING)
    law = archard(STEP / (LOAD * 0.5))
    with pytest.raises(ContactError, match="conforms") as conforming:
        run_advance(WearProblem(given, law, (depth_limit(0.05),), 1e9), 1e-4)
    found = re.search(r"cycle (\S+), (\S+) mm from the root", str(conforming.value))
    assert found is not None
    earliest = 0.01 / (0.5 * (0.5 * math.pi) ** 2 * STEP)
    assert 0.999 * earliest <= float(found[1]) <= 2.0 * earliest
    assert min(float(found[2]), 4.0 - float(found[2])) < 0.7


def test_tolerance_out_of_reach_is_refused() -> None:
    with pytest.raises(ConvergenceError, match="ask a larger life_tolerance"):
        run_advance(WearProblem(contact(ripple=-0.5), LAW, LIMIT, 1e9), 1e-13)


def test_difference_of_two_runs() -> None:
    slow, _ = run_advance(WearProblem(contact(), LAW, LIMIT, 1e9), 1e-4)
    fast, _ = run_advance(WearProblem(contact(path=1.25), LAW, LIMIT, 1e9), 1e-4)
    assert difference(slow, fast) == pytest.approx(0.2, rel=1e-9)
    short, _ = run_advance(WearProblem(contact(), LAW, LIMIT, 1e4), 1e-4)
    shorter, _ = run_advance(WearProblem(contact(path=1.25), LAW, LIMIT, 1e4), 1e-4)
    assert difference(short, shorter) == pytest.approx(0.25, rel=1e-9)
