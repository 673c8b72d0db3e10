"""Runs cycle by cycle, the source's (10) to (13) as they stand, against those in long steps.

Here gears and wraps; strands are in test_reference_run.py, tables of loads in test_reference_life_b9.py.
"""

import re

import numpy as np
import pytest

import wearsim
from tests import drives

GEARS = drives.changed(
    drives.GEARS,
    {"gear.nodes": 101, "wear.specific_wear_rate_mm2_per_N": 1e-9, "stop.critical_depth_mm": 0.005},
)

WRAP = {
    "format_version": 1,
    "chain": {"designation": "ANSI 40"},
    "sprocket": {"teeth": 20, "profile": "ansi_b29", "nodes": 151},
    "mechanism": {"kind": "wrap", "phases": 4},
    "drive": {"mate_teeth": 20, "links": 114, "slack_tension_N": 50},
    "load": {"tension_N": 1000, "speed_rpm": 100},
    "wear": {"specific_wear_rate_mm2_per_N": 1e-6},
    "stop": {"critical_depth_mm": 0.03},
}


@pytest.mark.wide
@pytest.mark.parametrize("tables", [GEARS, WRAP], ids=["gears", "wrap"])
def test_life_and_depth_of_both_methods(tables):
    """The loop knows nothing of the steps: both lives agree within the error that these state."""
    stepped, loop = (
        wearsim.simulate(wearsim.load_case(tables, [f"run.method={method}"]))
        for method in ("advance", "per_cycle")
    )
    assert loop.updates == np.ceil(loop.cycles)
    assert loop.updates > 1000
    assert stepped.numerical_error < (1e-2 if tables is GEARS else 0.1)
    assert stepped.cycles == pytest.approx(loop.cycles, rel=max(stepped.numerical_error, 1e-3))
    assert loop.stop == stepped.stop
    # (11) and (12): the sum of the deepest point has come to the limit.
    assert loop.max_depth == pytest.approx(tables["stop"]["critical_depth_mm"], rel=1e-9)
    # (13), for one loading a turn.
    assert loop.life.hours == pytest.approx(loop.cycles / (60.0 * loop.speed_rpm), rel=1e-12)


@pytest.mark.parametrize(("tables", "rate"), [(GEARS, 1e-14), (WRAP, 1e-9)], ids=["gears", "wrap"])
def test_run_of_too_many_cycles_is_refused_with_those_of_the_long_steps(tables, rate):
    settings = [f"wear.specific_wear_rate_mm2_per_N={rate}", "run.horizon_hours=1e7"]
    with pytest.raises(wearsim.ConvergenceError, match=r"about \d+ (min|h): take cycles") as refusal:
        wearsim.simulate(wearsim.load_case(tables, [*settings, "run.method=per_cycle"]))
    stepped = wearsim.simulate(wearsim.load_case(tables, settings))
    updates = float(re.search(r"takes (\S+),", str(refusal.value))[1])
    assert updates == pytest.approx(stepped.cycles_run, rel=0.01)
