"""Life times coefficient is constant: one reading in service replaces the coefficient."""

import copy

import numpy as np
import pytest

import wearsim
from tests.drives import FAST_WRAP, changed
from wearsim.errors import CaseError
from wearsim.result import Life, LowerBound
from wearsim.study.remaining.model import DEPTH, ELONGATION, OVER_PINS, SingleReading, remaining_life

STRAND = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "sprocket": {"teeth": 20, "profile": "evolute", "evolute_offset_mm": 5.6, "nodes": 51},
    "load": {"power_kW": 3, "speed_rpm": 100},
    "wear": {"specific_wear_rate_mm2_per_N": 1e-10},
    "stop": {"critical_depth_mm": 0.05},
}
WRAP = changed(FAST_WRAP, {"stop.critical_depth_mm": 0.04, "run.life_tolerance": 0.1})


def case(base, **tables):
    changed = copy.deepcopy(base)
    for table, keys in tables.items():
        changed.setdefault(table, {}).update(keys)
    return wearsim.load_case(changed)


@pytest.fixture(scope="module", params=[STRAND, WRAP], ids=["strand", "wrap"])
def model(request):
    """A case and its run."""
    loaded = case(request.param)
    return loaded, wearsim.simulate(loaded)


def course(result):
    """Hours, depths and life of a run, and a snapshot in its middle."""
    life = result.parts.get("sprocket", result.life)
    hours, depth = result.history_columns["time_hours"], result.history_columns["max_depth_mm"]
    return hours, depth, life, hours.size // 2


def test_a_reading_as_the_model_says_gives_the_model_s_life(model):
    loaded, result = model
    hours, depth, life, i = course(result)
    found = remaining_life(loaded, SingleReading(DEPTH, float(depth[i]), 0.001, float(hours[i])))
    assert found.life.hours == pytest.approx(life.hours, rel=1e-9)
    assert found.remaining.hours == pytest.approx(life.hours - hours[i], rel=1e-9)
    assert found.coefficient == pytest.approx(loaded.wear.coefficient, rel=1e-9)
    assert found.life.cycles == pytest.approx(found.life.hours * loaded.cycles_per_hour, rel=1e-12)
    assert found.part == "sprocket"


def test_the_same_depth_in_half_the_time_gives_half_the_life(model):
    loaded, result = model
    hours, depth, life, i = course(result)
    found = remaining_life(loaded, SingleReading(DEPTH, float(depth[i]), 0.001, 0.5 * float(hours[i])))
    assert found.life.hours == pytest.approx(0.5 * life.hours, rel=1e-9)
    assert found.factor == pytest.approx(2.0, rel=1e-9)


def test_a_reading_of_a_drive_that_wears_three_times_as_fast():
    """The run of that drive itself: its depth at a time gives its life, by the run with k alone."""
    fast = wearsim.simulate(case(STRAND, wear={"specific_wear_rate_mm2_per_N": 3e-10}))
    hours, depth, life, i = course(fast)
    found = remaining_life(case(STRAND), SingleReading(DEPTH, float(depth[i]), 0.001, float(hours[i])))
    assert found.life.hours == pytest.approx(life.hours, rel=2e-3)
    assert found.coefficient == pytest.approx(3e-10, rel=2e-3)


def test_band_is_that_of_the_readings_at_its_ends(model):
    loaded, result = model
    hours, depth, _, i = course(result)
    at, value, error = float(hours[i]), float(depth[i]), 0.2 * float(depth[i])
    found = remaining_life(loaded, SingleReading(DEPTH, value, error, at))
    for end, other in ((found.remaining_low, value + error), (found.remaining_high, value - error)):
        assert end == remaining_life(loaded, SingleReading(DEPTH, other, 1e-6, at)).remaining
    assert found.remaining_low.hours < found.remaining.hours < found.remaining_high.hours


@pytest.mark.parametrize(("percent", "hours"), [(1.2, 4200.0), (0.3, 100.0), (3.0, 7.0)])
def test_elongation_is_linear(percent, hours):
    """h (3/eps - 1) hours remain until 3 %, whatever the coefficient; the band likewise."""
    found = remaining_life(case(WRAP), SingleReading(ELONGATION, percent, 0.05, hours))
    assert found.part == "chain"
    assert found.remaining.hours == pytest.approx(hours * (3.0 / percent - 1.0), rel=1e-9, abs=1e-9)
    assert found.remaining_high.hours == pytest.approx(hours * (3.0 / (percent - 0.05) - 1.0))
    low = max(3.0 / (percent + 0.05) - 1.0, 0.0)
    assert found.remaining_low.hours == pytest.approx(hours * low, rel=1e-9, abs=1e-9)


def test_elongation_gives_the_coefficient_of_the_joints():
    """eps = 3 % after the chain's life at 1.5e-8; the same in a third of the time is 4.5e-8."""
    loaded = case(WRAP)
    life = wearsim.simulate(loaded).parts["chain"].hours
    found = remaining_life(loaded, SingleReading(ELONGATION, 3.0, 0.05, life / 3.0))
    assert found.coefficient == pytest.approx(4.5e-8, rel=1e-9)


@pytest.mark.slow
def test_over_pins():
    """Twice the seat's shift for an even number of teeth: the run's own column, read back."""
    loaded = case(WRAP, sprocket={"teeth": 20}, stop={"critical_depth_mm": 0.1})
    result = wearsim.simulate(loaded)
    hours, over = (result.history_columns[name] for name in ("time_hours", "over_pins_mm"))
    fall = np.maximum.accumulate(over[0] - over)
    i = int(np.searchsorted(fall, 0.6 * fall[-1]))
    found = remaining_life(loaded, SingleReading(OVER_PINS, float(fall[i]), 0.3 * fall[-1], 50.0))
    assert found.model_hours == pytest.approx(hours[i], rel=1e-9)
    life = result.parts["sprocket"].hours
    assert found.life.hours == pytest.approx(life * 50.0 / hours[i], rel=1e-9)


def test_a_life_that_was_not_reached_stays_a_bound():
    loaded = case(STRAND, run={"horizon_hours": 100})
    result = wearsim.simulate(loaded)
    depth = float(result.history_columns["max_depth_mm"][-1])
    found = remaining_life(loaded, SingleReading(DEPTH, depth, 0.1 * depth, 40.0))
    assert found.remaining == LowerBound(0.0, 0.0)
    assert isinstance(found.life, LowerBound)
    assert found.life.hours_run == pytest.approx(40.0, rel=1e-9)


@pytest.mark.parametrize(
    ("base", "reading", "message"),
    [
        (
            STRAND,
            SingleReading(DEPTH, 0.06, 0.001, 100.0),
            "at most 0.05, its value when the limit is reached",
        ),
        (STRAND, SingleReading(DEPTH, 0.02, 0.02, 100.0), "larger than its error of 0.02"),
        (STRAND, SingleReading(ELONGATION, 1.0, 0.05, 100.0), "set kind = 'wrap'"),
        (STRAND, SingleReading(OVER_PINS, 0.1, 0.02, 100.0), "set kind = 'wrap'"),
        (WRAP, SingleReading(ELONGATION, 3.1, 0.05, 100.0), "at most 3, its value when the limit is reached"),
        (WRAP, SingleReading(OVER_PINS, 0.02, 1e-9, 100.0), "over pins increases again"),
    ],
)
def test_readings_that_say_nothing_are_refused(base, reading, message):
    with pytest.raises(CaseError, match=message):
        remaining_life(case(base), reading)


def test_a_reading_out_of_the_band_is_doubted():
    found = remaining_life(case(WRAP), SingleReading(DEPTH, 0.03, 0.001, 1.0))
    assert any("outside its band" in text for text in found.warnings)
    assert isinstance(found.life, Life)


@pytest.mark.parametrize("command", ["maintain", "remaining"])
def test_running_in_is_refused(command: str) -> None:
    """Lives scale with the coefficient only where it is constant."""
    from wearsim.runner.scaled_percentiles import check_no_running_in

    tables = {
        "format_version": 1,
        "chain": {"designation": "08B-1"},
        "sprocket": {"teeth": 13, "profile": "iso606"},
        "load": {"tension_N": 800, "speed_rpm": 200},
        "drive": {"slack_tension_N": 30},
        "wear": {"specific_wear_rate_mm2_per_N": 1e-9, "running_in_factor": 2, "running_in_distance_mm": 10},
    }
    with pytest.raises(wearsim.CaseError, match=f"{command}.*constant"):
        check_no_running_in(wearsim.load_case(tables), command)
