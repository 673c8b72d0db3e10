"""The reference run of a 20-tooth evolute sprocket on 16B chain.

Expected lives and pressure: two independent programs, cycle by cycle. Chain pitch 25.4,
roller 15.88; offset 5.5, x 4.0..30.67, width 17 mm, pull 5000 N, steel on steel, depth 0.2 mm.
"""

import re
from collections.abc import Callable

import numpy as np
import pytest
import shapely

import wearsim
from tests.drives import depth_limit
from wearsim.drive.wear_task import wear_task
from wearsim.mechanisms.strand.contact import StrandMechanism
from wearsim.wear.advance import run_advance
from wearsim.wear.law import power
from wearsim.wear.problem import WearProblem

CaseMaker = Callable[..., wearsim.Case]

LIVES = {1: 8.1389e4, 1.5: 9.905e4, 2: 1.07527e5}
PER_CYCLE = "run.method=per_cycle"


def last_flank(result: wearsim.WearResult) -> shapely.LineString:
    columns = result.flank_columns
    nodes = int(columns["node"].max())
    return shapely.LineString(np.column_stack([columns["x_mm"], columns["y_mm"]])[-nodes:])


@pytest.mark.wide
@pytest.mark.parametrize("method", ["advance", "per_cycle"])
@pytest.mark.parametrize("nodes", [101, 201, 401])
@pytest.mark.parametrize("exponent", LIVES)
def test_life_and_pressure(
    validated: Callable[..., None], reference: CaseMaker, exponent: float, nodes: int, method: str
) -> None:
    result = wearsim.simulate(reference(exponent, f"sprocket.nodes={nodes}", f"run.method={method}"))
    shown = (nodes, method) == (401, "advance")
    within, source = 5e-4, "two independent programs, every cycle"
    quantity = f"life of the reference run, m = {exponent:g}"
    validated(quantity, result.cycles, LIVES[exponent], within, source, "cycles", page=shown)
    assert result.life.hours == pytest.approx(result.cycles / (60 * 100), rel=1e-14)
    quantity, found = "initial peak pressure of the reference run", result.initial_peak_pressure
    shown = shown and exponent == 1
    validated(quantity, found, 995.0, within, source, "MPa", page=shown)
    assert result.stop == "critical_depth_mm"
    assert result.max_depth == pytest.approx(0.2, rel=1e-9)


def test_deepest_point_lies_near_x_24(reference: CaseMaker) -> None:
    case = reference(1, "run.life_tolerance=0.01")
    result = wearsim.simulate(case)
    columns = result.flank_columns
    node = int(columns["depth_mm"][-201:].argmax())
    # Nodes lie at equal steps of the roller's way x from 4.0 to 30.67.
    assert np.linspace(4.0, 30.67, 201)[node] == pytest.approx(24.0, abs=0.3)
    assert columns["arc_length_mm"][node] == result.max_depth_arc_length


def test_contact_ratio_falls_below_one_and_is_warned_of(reference: CaseMaker) -> None:
    result = wearsim.simulate(reference(1))
    ratio = result.history_columns["worn_contact_ratio"]
    assert ratio[0] == pytest.approx((30.67 - 4.0) / 25.4, abs=2e-4)
    assert ratio[-1] == pytest.approx(0.95, abs=5e-3)
    assert sum(bool(re.search("worn contact ratio .* below 1", text)) for text in result.warnings) == 1


@pytest.mark.wide
@pytest.mark.parametrize(("exponent", "depth"), [(1, 0.2), (1.5, 0.2), (1, 0.75), (2, 0.75)])
def test_both_methods_agree(reference: CaseMaker, exponent: float, depth: float) -> None:
    """The same life within the tolerance and the same worn flank within 1e-5 of the depth.

    Both on the points of the case: a tolerance of 1e-6 would refine the flank.
    """
    stop = f"stop.critical_depth_mm={depth}"
    case = reference(exponent, stop, "run.life_tolerance=1e-6")
    advance, _ = wear_task(case, case.drive.mechanism(case).contact).run()
    per_cycle = wearsim.simulate(reference(exponent, stop, PER_CYCLE))
    assert advance.cycles[-1] == pytest.approx(per_cycle.cycles, rel=1e-4)
    flank = shapely.LineString(np.column_stack([advance.x[-1], advance.y[-1]]))
    assert flank.hausdorff_distance(last_flank(per_cycle)) < 1e-5 * depth


@pytest.mark.parametrize(("exponent", "coarse"), [(1, 20), (1, 2000), (1.5, 200), (2, 500)])
def test_coarse_updates_are_refused_and_the_proposal_runs(
    reference: CaseMaker, exponent: float, coarse: int
) -> None:
    nodes = "sprocket.nodes=401"
    with pytest.raises(wearsim.ConvergenceError) as refusal:
        wearsim.simulate(reference(exponent, nodes, PER_CYCLE, f"run.cycles_per_update={coarse}"))
    proposal = re.search(r"cycles_per_update = (\d+)", str(refusal.value))
    assert proposal is not None
    assert 1 < int(proposal[1]) < coarse
    result = wearsim.simulate(reference(exponent, nodes, PER_CYCLE, f"run.cycles_per_update={proposal[1]}"))
    assert result.cycles == pytest.approx(LIVES[exponent], rel=5e-4)


@pytest.mark.parametrize(("exponent", "life"), [(1, 7.9469e4), (2, 1.0408e5)])
def test_infeasible_offset_4_is_still_a_valid_number(
    validated: Callable[..., None],
    reference_mechanism: Callable[..., StrandMechanism],
    exponent: float,
    life: float,
) -> None:
    """At h = 4.0 the leaving roller cuts the flank, so only the engine can be asked."""
    mechanism = reference_mechanism(nodes=401, offset=4.0)
    law = power({1: 1e-8, 2: 1e-11}[exponent], exponent)
    run, _ = run_advance(WearProblem(mechanism.contact, law, (depth_limit(0.2),), 1e9), 1e-4)
    quantity = f"life with an offset of 4 mm, m = {exponent:g}"
    source, shown = "two independent programs", exponent == 1
    validated(quantity, run.cycles[-1], life, 5e-4, source, "cycles", page=shown)
