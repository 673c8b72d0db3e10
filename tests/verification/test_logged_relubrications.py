"""Logged relubrications: data by small steps of the state of the lubricant give coefficients back."""

import csv
import itertools
import math
from pathlib import Path

import numpy as np
import pytest

import wearsim
from wearsim.lubrication.clock import LubricantClock
from wearsim.lubrication.law import LubricantLaw
from wearsim.lubrication.schedule import LubricantEvent, LubricantSchedule
from wearsim.readings.relubrications import RelubricationLog, at_one_interval

pytest.importorskip("pandera", reason="pandera is not installed")

CHAIN = {
    "format_version": 1,
    "chain": {"designation": "08B-1"},
    "sprocket": {"teeth": 23, "profile": "iso606", "nodes": 51},
    "drive": {"mate_teeth": 38, "links": 120},
    "mechanism": {"kind": "wrap", "phases": 2},
    "joint": {"specific_wear_rate_mm2_per_N": 2.3e-10},
    "load": {"power_kW": 1.5, "speed_rpm": 400},
    "wear": {"specific_wear_rate_mm2_per_N": 1e-9},
    "stop": {"elongation_percent": 2},
}
STRAND = {
    "format_version": 1,
    "chain": {"designation": "20A-1"},
    "sprocket": {"teeth": 18, "profile": "evolute", "nodes": 51},
    "load": {"power_kW": 5, "speed_rpm": 60},
    "wear": {"specific_wear_rate_mm2_per_N": 2e-10},
    "stop": {"critical_depth_mm": 0.3},
}
LASTS, FADES, DRY, LEFT, DIRT, AGEING = 120.0, 60.0, 6.0, 0.25, 1.5, 1.3
OILED = {
    "lasts_hours": LASTS,
    "fades_over_hours": FADES,
    "dry_factor": DRY,
    "completeness": 1.0 - LEFT,
    "contamination_factor": DIRT,
    "ageing_factor": AGEING,
}
DONE = (90.0, 310.0, 420.0, 700.0)
READ = (200.0, 390.0, 650.0, 830.0)
STEP = 0.02


def worn_by_small_steps(hours: float) -> "tuple[np.ndarray, np.ndarray]":
    """Running hours, and hours at the wear of lubricated contacts: the age goes on step by step.

    Relubricated as logged, then at 700/4 = 175 h from there.
    """
    coming = [*DONE, *(DONE[-1] + 175.0 * number for number in range(1, math.ceil(hours / 175.0)))]
    times = STEP * np.arange(math.ceil(hours / STEP) + 1)
    worn, age, due = np.zeros(times.size), 0.0, 0
    for number, time in enumerate(times[:-1]):
        if due < len(coming) and coming[due] <= time + 1e-9:
            age, due = LEFT * age, due + 1
        dry = min(max((age + 0.5 * AGEING * STEP - LASTS) / FADES, 0.0), 1.0)
        worn[number + 1] = worn[number] + STEP * DIRT * (1.0 + (DRY - 1.0) * dry)
        age = min(age + AGEING * STEP, LASTS + FADES)
    return times, worn


def rows(quantity, values, error):
    """Readings and relubrications in the order of time."""
    found = [
        {"time_hours": hours, "quantity": quantity, "value": value, "error": error}
        for hours, value in zip(READ, values, strict=True)
    ]
    found += [{"time_hours": hours, "quantity": "relubrication"} for hours in DONE]
    return sorted(found, key=lambda row: row["time_hours"])


def test_the_rate_of_a_chain_comes_back():
    """Put in: 1.7 times the coefficient of the case."""
    steady = wearsim.remaining(CHAIN, 1.0, elongation_percent=2).found.model_hours
    times, worn = worn_by_small_steps(2500.0)
    values = [1.7 * 2.0 / steady * np.interp(hours, times, worn) for hours in READ]
    found = wearsim.calibrate({**CHAIN, "lubrication": OILED}, rows("elongation_percent", values, 1e-3))
    (value,), (part,) = found.found.values, found.found.parts
    assert value.value / value.in_case == pytest.approx(1.7, rel=1e-3)
    life = float(np.interp(steady / 1.7, worn, times))
    assert 900.0 < life < 2400.0
    assert part.life == pytest.approx(life, rel=1e-3)
    assert part.remaining == pytest.approx(life - READ[-1], rel=2e-3)
    assert found.summary()["relubrications"] == 4


def test_the_log_takes_the_place_of_the_schedule_of_the_case():
    """Without the log the same readings give another coefficient; with it the schedule does not matter."""
    values = rows("elongation_percent", (0.1, 0.2, 0.3, 0.4), 1e-3)
    often = {**CHAIN, "lubrication": {**OILED, "interval_hours": 50}}
    never = {**CHAIN, "lubrication": OILED}
    logged, same = (wearsim.calibrate(case, values).found.values[0].value for case in (often, never))
    assert logged == pytest.approx(same, rel=1e-12)
    readings = [row for row in values if row["quantity"] != "relubrication"]
    as_planned = wearsim.calibrate(often, readings).found
    assert as_planned.values[0].value > 1.2 * logged
    assert any("relubricated as [lubrication] says" in text for text in as_planned.assumptions)


def test_the_rate_of_teeth_comes_back():
    """Depths of a steady run at the lubricated hours of small steps, for 1.4 times its coefficient."""
    run = wearsim.simulate(STRAND)
    scale = 6000.0 / run.life.hours  # a life of 6000 lubricated hours
    rate = STRAND["wear"]["specific_wear_rate_mm2_per_N"] / scale
    at, depth = scale * run.history_columns["time_hours"], run.history_columns["max_depth_mm"]
    times, worn = worn_by_small_steps(2000.0)
    values = [np.interp(1.4 * np.interp(hours, times, worn), at, depth) for hours in READ]
    case = {**STRAND, "wear": {"specific_wear_rate_mm2_per_N": rate}, "lubrication": OILED}
    found = wearsim.calibrate(case, rows("max_depth_mm", values, 1e-4)).found
    assert found.values[0].value / rate == pytest.approx(1.4, rel=2e-3)
    assert found.parts[0].life == pytest.approx(np.interp(6000.0 / 1.4, worn, times), rel=2e-3)


def test_a_schedule_goes_on_at_its_interval_by_hand():
    """Dry at 5 times the wear after 100 of 150 cycles, then renewed every 110: 350, then 150 each."""
    law = LubricantLaw(dry_factor=5.0, lasts=100.0)
    clock = LubricantClock(
        law, LubricantSchedule((LubricantEvent(150.0, relubricated=True),), then_every=110.0)
    )
    assert clock.steady_cycles(150.0) == pytest.approx(350.0, rel=1e-15)
    for rounds, rest in itertools.product((0, 1, 7, 123_456), (0.0, 60.0)):
        worn = 350.0 + 150.0 * rounds + rest
        run = 150.0 + 110.0 * rounds + rest
        assert clock.steady_cycles(run) == pytest.approx(worn, rel=1e-14)
        assert clock.running_cycles(np.array([worn]))[0] == pytest.approx(run, rel=1e-14)


BAD = [
    ({"time_hours": 0.0001, "quantity": "relubrication"}, r"readings:2: time_hours: relubrication must come"),
    ({"time_hours": 0, "quantity": "relubrication"}, r"readings:2: .*must be later than 0"),
    (
        {"time_hours": -1, "quantity": "relubrication"},
        r"readings:2: time_hours: must be a number of at least",
    ),
    (
        {"time_hours": 5, "quantity": "relubrication", "value": 2},
        r"readings:2: value: must be empty for relu",
    ),
    (
        {"time_hours": 5, "quantity": "oiled", "error": 1},
        r"must be one of .*new, relubrication \(got 'oiled'",
    ),
]


@pytest.mark.parametrize(("row", "message"), BAD, ids=range(len(BAD)))
def test_bad_events_are_named_by_line(row, message):
    case = {**CHAIN, "lubrication": OILED}
    reading = {"time_hours": 500, "quantity": "elongation_percent", "value": 0.3, "error": 0.01}
    with pytest.raises(wearsim.CaseError, match=message):
        wearsim.calibrate(case, [row, reading])
    if row["quantity"] != "oiled":
        with pytest.raises(wearsim.CaseError, match=message):
            wearsim.remaining(case, readings=[row, reading])


def test_relubrications_need_a_lubricant_that_ages():
    data = rows("elongation_percent", (0.1, 0.2, 0.3, 0.4), 1e-3)
    with pytest.raises(wearsim.CaseError, match=r"readings:2: quantity: relubrication needs \[lubrication\]"):
        wearsim.calibrate(CHAIN, data)


def test_one_reading_of_a_lubricant_that_ages_is_refused():
    """Whatever else changes with the cycles: one factor cannot stand for both."""
    wear = {**CHAIN["wear"], "cycles_exponent": 0.5, "reference_hours": 100}
    for case in (CHAIN, {**CHAIN, "wear": wear}):
        with pytest.raises(wearsim.CaseError, match="give a table of readings, which takes it into account"):
            wearsim.remaining({**case, "lubrication": OILED}, 100.0, elongation_percent=0.5)


def test_one_that_is_overdue_comes_now_and_counts() -> None:
    """Relubricated at 1 h and not in the 804 h since: two in 805 h, the second one today."""
    log = at_one_interval({"": RelubricationLog("log.csv", "time_hours", 2, (1.0,), 805.0)})[""]
    assert (log.mean_interval, log.to_come) == (402.5, 805.0)
    assert "in the last 804 h, but they came every 1 h before" in next(log.warnings(None))
    in_time = at_one_interval({"": RelubricationLog("log.csv", "time_hours", 2, (100.0, 200.0), 300.0)})[""]
    assert (in_time.mean_interval, in_time.to_come, [*in_time.warnings(None)]) == (100.0, 300.0, [])


def test_the_calibrated_case_lives_as_told(tmp_path: Path):
    """With the relubrications of the log, and those to come, in the place of its schedule."""
    data = rows("elongation_percent", (0.1, 0.2, 0.3, 0.4), 1e-2)
    case = {**CHAIN, "lubrication": {**OILED, "interval_hours": 50}, "run": {"life_tolerance": 0.1}}
    found = wearsim.calibrate(case, data)
    told = found.found.parts[0].life
    given = found.found.tables["lubrication"]
    assert (given["at_hours"], given["interval_hours"]) == ([*DONE, 875.0], 175.0)
    reached = found.case.with_({"run.horizon_hours": 1.01 * told})
    assert wearsim.simulate(reached).parts["chain"].hours == pytest.approx(told, rel=1e-9)
    path = tmp_path / "log.csv"
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, ["time_hours", "quantity", "value", "error"])
        writer.writeheader()
        writer.writerows(data)
    assert wearsim.calibrate(case, path).summary() == found.summary()
