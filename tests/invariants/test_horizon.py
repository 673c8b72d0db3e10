"""A run goes on until a limit is met: a horizon is the last resort, and the user's own.

Expected: life times wear coefficient is constant, so a hundred times the coefficient gives a
hundredth of the life.
"""

import pytest

import wearsim
from wearsim.result import Life, LowerBound
from wearsim.wear import implicit_steps

SLOW = 5e-13
STRAND = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "sprocket": {"teeth": 20, "profile": "evolute", "nodes": 101},
    "load": {"power_kW": 3, "speed_rpm": 100},
    "wear": {"specific_wear_rate_mm2_per_N": SLOW, "band_factor": 3.0},
    "stop": {"critical_depth_mm": 0.2},
}
WRAP = {
    "format_version": 1,
    "chain": {"designation": "ANSI 40"},
    "sprocket": {"teeth": 20, "profile": "ansi_b29", "nodes": 101},
    "mechanism": {"kind": "wrap", "phases": 2},
    "drive": {"mate_teeth": 20, "links": 114, "slack_tension_N": 50},
    "joint": {"pitch": "uniform", "specific_wear_rate_mm2_per_N": 2e-11},
    "load": {"tension_N": 1000, "speed_rpm": 100},
    "wear": {"specific_wear_rate_mm2_per_N": 1e-11},
    "stop": {"critical_depth_mm": 0.03, "elongation_percent": 1},
    "run": {"life_tolerance": 0.1},
}
RATE = "wear.specific_wear_rate_mm2_per_N"
JOINT = "joint.specific_wear_rate_mm2_per_N"


def run(tables, *settings):
    return wearsim.simulate(wearsim.load_case(tables, settings))


def test_life_of_a_slow_strand_is_found():
    """Far beyond 50 000 h, and the ends of its band with it."""
    slow, fast = run(STRAND), run(STRAND, f"{RATE}={100 * SLOW}")
    assert isinstance(slow.life, Life) and slow.life.hours > 1e5
    assert slow.life.hours == pytest.approx(100 * fast.life.hours, rel=1e-9)
    assert slow.life_low.hours == pytest.approx(slow.life.hours / 3, rel=1e-9)
    assert slow.life_high.hours == pytest.approx(slow.life.hours * 3, rel=1e-9)
    assert slow.stop == "critical_depth_mm"
    (many,) = wearsim.simulate_many([wearsim.load_case(STRAND)])
    assert many.life == slow.life


def test_lives_of_a_slow_wrap_are_found():
    """Its chain lives beyond 50 000 h, and its sprocket as well."""
    slow = run(WRAP)
    fast = run(WRAP, f"{RATE}=1e-9", f"{JOINT}=2e-9")
    for part in ("chain", "sprocket"):
        found = slow.parts[part]
        assert isinstance(found, Life) and found.hours > 5e4
        assert found.hours == pytest.approx(100 * fast.parts[part].hours, rel=1e-6)


@pytest.mark.parametrize("tables", [STRAND, WRAP])
def test_a_horizon_that_is_given_ends_the_run(tables):
    result = run(tables, "run.horizon_hours=2000")
    assert isinstance(result.life, LowerBound)
    assert result.life.hours_run == pytest.approx(2000.0, rel=1e-9)
    assert result.stop == "horizon_hours"
    assert not [text for text in result.warnings if "the most allowed" in text]


def test_what_hardly_wears_ends_after_a_million_hours():
    result = run(STRAND, f"{RATE}=1e-15")
    assert isinstance(result.life, LowerBound)
    assert result.life.hours_run == pytest.approx(1e6, rel=1e-9)
    (told,) = [text for text in result.assumptions if text.startswith("run.horizon_hours")]
    assert told == "run.horizon_hours = 1e+06 (default: until a limit is met)"


def test_a_sprocket_that_outlives_many_chains_takes_so_many_steps(monkeypatch):
    """16 steps a chain at least: 40 are over in the third, whose life is known."""
    monkeypatch.setattr(implicit_steps, "_MAX_STEPS", 40)
    result = run(WRAP, f"{RATE}=1e-13", f"{JOINT}=1e-9")
    chain, sprocket = result.parts["chain"], result.parts["sprocket"]
    assert isinstance(chain, Life) and result.life == chain
    assert isinstance(sprocket, LowerBound)
    assert 2.0 * chain.hours < sprocket.hours_run < 3.0 * chain.hours
    assert sprocket.hours_run == result.hours_run
    assert result.updates in (40, 80)  # of twice as many steps where the error asks for them
    (told,) = [text for text in result.warnings if "the most allowed" in text]
    assert told.startswith(f"the run stopped after {result.updates} steps and 3 chains")
