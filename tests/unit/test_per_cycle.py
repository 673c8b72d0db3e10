"""The reference loop: stability limit, sawtooth watch, last update on the limit.

A flat flank under constant load is worn by I = k sigma s in every cycle, so every number
here is a closed form: the bound of a depth per update is spacing^2/(2 e rho_H) with e = m/2.
"""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from tests.drives import depth_limit
from wearsim.contact.engagement import ContactKind, FlankContact
from wearsim.contact.stop_limits import StopLimit
from wearsim.errors import ContactError, ConvergenceError
from wearsim.geometry.forms.evolute import Strand, evolute_flank
from wearsim.mechanisms.prescribed.contact import PrescribedMechanism
from wearsim.mechanisms.strand.contact import StrandMechanism
from wearsim.wear.law import WearLaw, archard, drozdov, power
from wearsim.wear.loop import check_length, run_per_cycle
from wearsim.wear.problem import WearProblem

NODES, SPACING, ROLLER, MODULUS, LOAD = 41, 0.1, 5.0, 1e5, 200.0
SIGMA = math.sqrt(LOAD * MODULUS / (math.pi * ROLLER))
DEPTH = 0.01


def flat(path: float = 1.0, load: float = LOAD) -> FlankContact:
    return PrescribedMechanism(
        kind=ContactKind.LOCAL,
        arc_length=SPACING * np.arange(NODES),
        load_per_width=np.full(NODES, load),
        slip=np.full(NODES, path),
        sliding_speed=np.full(NODES, np.nan),
        flank_curvature=np.zeros(NODES),
        mate_radius=ROLLER,
        modulus=MODULUS,
    ).contact


def reference(nodes: int = 201) -> FlankContact:
    strand = Strand(25.4 * 20 / (2.0 * np.pi), 7.94, 5.5)
    return StrandMechanism(
        strand=strand,
        profile=evolute_flank(strand, 4.0, 30.67, nodes).profile,
        contact_end=4.0,
        contact_start=30.67,
        pitch=25.4,
        pull_per_width=5000.0 / 17.0,
        angular_speed=10.0,
        slip_fraction=1.0,
        modulus=2.1e5 / 1.82,
    ).contact


@pytest.mark.parametrize("exponent", [1.0, 2.0])
@pytest.mark.parametrize("factor", [1.0 - 1e-9, 1.0 + 1e-6])
def test_stability_limit_is_spacing_squared_over_two_e_rho(exponent: float, factor: float) -> None:
    """A depth per update just below the bound runs, just above it is refused."""
    bound = SPACING**2 / (2.0 * (0.5 * exponent) * ROLLER)
    law = power(factor * bound / SIGMA**exponent, exponent)
    limit = (depth_limit(20.0 * bound),)
    if factor < 1.0:
        run = run_per_cycle(WearProblem(flat(), law, limit, 1e6), 1)
        assert run.cycles[-1] == pytest.approx(20.0 / factor, rel=1e-9)
    else:
        with pytest.raises(ConvergenceError, match=r"spacing\^2/\(2 e rho_H\) = 0.00"):
            run_per_cycle(WearProblem(flat(), law, limit, 1e6), 1)


def test_given_slip_ratio_at_m_1_has_no_stability_limit() -> None:
    """e = (m - 1)/2 = 0: the depth does not depend on the curvature."""
    contact = replace(flat(path=0.5), kind=ContactKind.TRAVELLING)
    law = archard(1e-3 / (LOAD * 0.5))
    run = run_per_cycle(WearProblem(contact, law, (depth_limit(DEPTH),), 1e6), 5)
    assert run.cycles[-1] == pytest.approx(10.0, rel=1e-12)


def test_refusal_proposes_the_largest_stable_update() -> None:
    bound = SPACING**2 / ROLLER
    law = archard(bound / 22.6 / SIGMA)
    with pytest.raises(ConvergenceError, match="take cycles_per_update = 22 or"):
        run_per_cycle(WearProblem(flat(), law, (depth_limit(1.0),), 1e6), 100)
    run_per_cycle(WearProblem(flat(), law, (depth_limit(0.1),), 1e6), 22)


def test_refusal_proposes_fewer_nodes_where_one_cycle_is_too_much() -> None:
    law = archard(1.5 * SPACING**2 / ROLLER / SIGMA)
    with pytest.raises(ConvergenceError, match="take fewer nodes or"):
        run_per_cycle(WearProblem(flat(), law, (depth_limit(1.0),), 1e6), 1)


@pytest.mark.parametrize("times", [1.0, 1.1, 1.5, 3.0, 10.0])
def test_bound_is_sharp_and_the_sawtooth_watch_stands_behind_it(times: float) -> None:
    """The reference run (81 389 cycles) with the bound switched off (diffusion set to 0).

    physics.md 3: 1.0 times the bound is right, 1.1 times wrong without notice.
    """
    law, limit = archard(1e-8), (depth_limit(0.2),)
    with pytest.raises(ConvergenceError) as refusal:
        run_per_cycle(WearProblem(reference(), law, limit, 1e6), 2000)
    proposed = re.search(r"cycles_per_update = (\d+)", str(refusal.value))
    assert proposed is not None
    blind = replace(reference(), slip_curvature_exponent=0.0)
    assert law.diffusion(blind.kind, blind.slip_curvature_exponent) == 0.0
    update = int(times * int(proposed[1]))
    if times == 1.0:
        run = run_per_cycle(WearProblem(blind, law, limit, 1e6), update)
        assert run.cycles[-1] == pytest.approx(8.1389e4, rel=5e-4)
    else:
        # Rounding decides which comes first: the teeth, or a tooth deep enough to end the contact.
        noticed = "alternates from point to point|conforms to the roller|would pull there"
        with pytest.raises((ConvergenceError, ContactError), match=noticed):
            run_per_cycle(WearProblem(blind, law, limit, 1e6), update)


@pytest.mark.parametrize("kind", [ContactKind.LOCAL, ContactKind.TRAVELLING])
@pytest.mark.parametrize(
    "law",
    [
        power(1e-9, 1.0),
        power(1e-9, 1.5),
        power(1e-11, 2.0),
        drozdov(1e-3, 1.7, 2000.0, 30.0, 0.3),
        replace(power(1e-9, 1.0), case_depth=0.002, core_factor=3.0),
    ],
)
def test_offset_form_is_the_general_loop(law: WearLaw, kind: ContactKind) -> None:
    """The loop that keeps points and frames in between must give the same flank, one end unloaded."""
    arc = SPACING * np.arange(41)
    given = PrescribedMechanism(
        kind=kind,
        arc_length=arc,
        load_per_width=LOAD * np.maximum(np.sin(3.5 * arc / arc[-1]), 0.0),
        slip=0.2 + 0.1 * np.cos(arc),
        sliding_speed=30.0 + arc,
        flank_curvature=0.01 * np.sin(arc),
        mate_radius=ROLLER,
        modulus=MODULUS,
    ).contact
    limit = (depth_limit(0.004),)
    fast = run_per_cycle(WearProblem(given, law, limit, 1e6), 1)
    # The general loop under the same contact; its spacing is that of the worn points.
    slow = run_per_cycle(WearProblem(replace(given, offset_form=False), law, limit, 1e6), 1)
    assert fast.cycles[-1] == pytest.approx(slow.cycles[-1], rel=1e-11)
    for one, other in ((fast.depth, slow.depth), (fast.x, slow.x), (fast.y, slow.y)):
        np.testing.assert_allclose(one, other, rtol=0.0, atol=1e-10)


@pytest.mark.parametrize("cycles_per_update", [1, 7, 40])
def test_last_update_ends_on_the_limit(cycles_per_update: int) -> None:
    """N = depth / I, not the next whole update."""
    step = 3.7e-6
    run = run_per_cycle(
        WearProblem(flat(), archard(step / SIGMA), (depth_limit(DEPTH),), 1e6), cycles_per_update
    )
    assert run.met is not None
    assert run.met.name == "critical_depth_mm"
    assert run.cycles[-1] == pytest.approx(DEPTH / step, rel=1e-9)
    np.testing.assert_allclose(run.depth[-1], DEPTH, rtol=1e-12)
    np.testing.assert_allclose(run.y[0] - run.y[-1], DEPTH, rtol=1e-9)
    assert run.updates == math.ceil(DEPTH / step / cycles_per_update)


def test_horizon_ends_a_run_without_a_limit() -> None:
    step = 1e-6
    run = run_per_cycle(WearProblem(flat(), archard(step / SIGMA), (depth_limit(DEPTH),), 1234.0), 10)
    assert run.met is None
    assert run.cycles[-1] == 1230.0
    np.testing.assert_allclose(run.depth[-1], 1230.0 * step, rtol=1e-9)


def test_horizon_shorter_than_an_update_is_refused() -> None:
    with pytest.raises(ConvergenceError, match="must hold at least one update of 10 cycles"):
        run_per_cycle(WearProblem(flat(), archard(1e-12), (depth_limit(DEPTH),), 5.0), 10)


def test_second_limit_in_the_middle_of_a_block_is_met_to_the_cycle() -> None:
    """A limit on the tip's y stops where the flank has receded by 0.0031 mm there."""
    step = 1e-6
    tip = StopLimit("tip", -0.0031, lambda x, y, depth: float(y[-1]) + 0.0031)
    run = run_per_cycle(WearProblem(flat(), archard(step / SIGMA), (depth_limit(DEPTH), tip), 1e6), 1)
    assert run.met is tip
    assert run.cycles[-1] == pytest.approx(3100.0, rel=1e-9)


def test_snapshots_are_some_and_increase() -> None:
    run = run_per_cycle(WearProblem(flat(), archard(1e-7 / SIGMA), (depth_limit(DEPTH),), 1e6), 1)
    assert 100 <= run.cycles.size <= 200
    assert (np.diff(run.cycles) > 0.0).all()
    assert run.cycles[0] == 0.0
    assert (run.depth[0] == 0.0).all()


@pytest.mark.parametrize(("contact", "match"), [(flat(path=0.0), "slide"), (flat(load=0.0), "touch")])
def test_no_slip_or_no_load_is_an_error(contact: FlankContact, match: str) -> None:
    with pytest.raises(ContactError, match=match):
        run_per_cycle(WearProblem(contact, archard(1e-9), (depth_limit(DEPTH),), 1e6), 1)


def test_a_long_run_tells_how_far_it_is() -> None:
    """By blocks of 50 000 updates, whatever the limit that ends it."""
    told: list[float] = []
    run = run_per_cycle(WearProblem(reference(), archard(5e-9), (depth_limit(0.2),), 1e12), 1, told.append)
    assert run.met is not None and run.updates > 100_000
    assert len(told) > run.updates // 50_000
    assert told == sorted(told) and 0.0 < told[0] < 0.6 and told[-1] == 1.0


@pytest.mark.parametrize(("cycles", "count"), [(1e9, 1), (5e3, 0)])
def test_a_long_run_says_its_time_before_it_begins(
    cycles: float, count: int, caplog: pytest.LogCaptureFixture
) -> None:
    """10^9 updates of 41 points take many seconds on any machine, 5000 none."""
    caplog.set_level("INFO", "wearsim")
    check_length(WearProblem(flat(), archard(1e-12), (depth_limit(DEPTH),), 1e12), cycles, 1)
    texts = [record.getMessage() for record in caplog.records]
    assert len(texts) == count
    assert all(re.fullmatch(r"cycle by cycle: 1e\+09 updates, about \S+ (s|min|h)", one) for one in texts)
