"""Memory of a life: its peak does not depend on its number of cycles, and none of it stays behind.

Expected: the same peak within 10 %, measured by tracemalloc, for a life ten times as long; afterwards
less than a tenth of it while Python collects no garbage.
"""

import gc
import tracemalloc
from collections.abc import Callable

import pytest

import wearsim
from tests.drives import depth_limit
from wearsim.contact.engagement import Mechanism
from wearsim.wear.advance import run_advance
from wearsim.wear.law import archard
from wearsim.wear.loop import run_per_cycle
from wearsim.wear.problem import WearProblem

pytestmark = pytest.mark.wide


def peak(wear: Callable[[], object]) -> int:
    gc.collect()
    tracemalloc.start()
    try:
        wear()
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


@pytest.mark.slow
@pytest.mark.parametrize("method", ["advance", "per_cycle"])
def test_ten_times_the_cycles(build: Callable[..., Mechanism], method: str) -> None:
    contact, stop_limits = build(101).contact, (depth_limit(0.05),)

    def wear(rate: float) -> float:
        if method == "advance":
            worn, _ = run_advance(WearProblem(contact, archard(rate), stop_limits, 1e9), 1e-3)
        else:
            worn = run_per_cycle(WearProblem(contact, archard(rate), stop_limits, 1e9), 1)
        cycles.append(float(worn.cycles[-1]))
        return cycles[-1]

    cycles: list[float] = []
    wear(1e-7)
    few, many = peak(lambda: wear(1e-7)), peak(lambda: wear(1e-8))
    assert cycles[-1] == pytest.approx(10.0 * cycles[0], rel=0.01)
    assert many < 1.2 * few


STRAND = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "sprocket": {"teeth": 20, "profile": "evolute", "nodes": 801},
    "load": {"tension_N": 3000.0, "speed_rpm": 100.0},
    "wear": {"condition": "hardened, oiled"},
    "run": {"life_tolerance": 1e-4},
}


@pytest.mark.parametrize("limit", ["critical_depth_mm", "min_tip_land_mm"])
def test_nothing_large_waits_for_the_garbage_collector(limit: str) -> None:
    """To see what stays, call ``gc.set_debug(gc.DEBUG_SAVEALL)`` and look into ``gc.garbage``."""
    case = wearsim.load_case(STRAND)
    if limit == "min_tip_land_mm":
        case = case.with_({"stop.min_tip_land_mm": case.drive.tip_land - 0.02})
    assert wearsim.simulate(case).stop == limit  # imports and kernels stay in memory from here on
    gc.collect()
    gc.disable()
    tracemalloc.start()
    try:
        wearsim.simulate(case)
        left, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
        gc.enable()
    assert left < 0.1 * most
