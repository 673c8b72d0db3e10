"""`wearsim lubricate`: lives and costs against the interval, by hand and by brute force."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

import wearsim
from tests.drives import LIGHT_WRAP, changed
from wearsim.cli.main import wearsim_command
from wearsim.drive.part_life import case_clock
from wearsim.quantities import grouped
from wearsim.study.lubricate.answer import LubricationResult
from wearsim.study.lubricate.runs import compare_intervals
from wearsim.study.lubricate.sheet import lubrication_json, lubrication_text, policy_rows

CASES = Path(__file__).parents[2] / "cases"
STRAND: dict[str, Any] = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "sprocket": {"teeth": 20, "profile": "evolute", "nodes": 61},
    "load": {"power_kW": 3, "speed_rpm": 100},
    "run": {"life_tolerance": 0.1},
    "wear": {"tooth_hardness": "normalised"},
    "lubrication": {
        "lubricant": "manual",
        "interval_hours": 40.0,
        "lasts_hours": 50.0,
        "fades_over_hours": 200.0,
        "dry_factor": 5.0,
        "price_per_application": 2.0,
        "minutes_per_application": 10.0,
        "labour_cost_per_hour": 30.0,
    },
    "maintenance": {"chain_price": 1.0, "sprocket_price": 300.0},
}


def study(*settings: str, tables: dict[str, Any] | None = None) -> Any:
    return compare_intervals(wearsim.load_case(tables or STRAND, settings))


def mean_factor(interval: float, lasts: float = 50.0, fades: float = 200.0, dry: float = 5.0) -> float:
    """Mean of a ramp by hand."""
    ramp = min(max(interval - lasts, 0.0), fades)
    worn = ramp * (1.0 + (dry - 1.0) * 0.5 * ramp / fades)
    return (min(interval, lasts) + worn + dry * max(interval - lasts - fades, 0.0)) / interval


def test_costs_by_hand() -> None:
    """2 + 10/60 x 30 = 7 a relubrication; 300 a life of so many hours of lubricated contacts."""
    (plan,) = study().plans
    steady = wearsim.simulate(wearsim.load_case(_without_schedule())).life.hours_run
    for policy in plan.policies:
        factor = mean_factor(policy.interval)
        assert policy.wear_factor == pytest.approx(factor, rel=1e-12)
        expected = 1000.0 * (7.0 / policy.interval + 300.0 * factor / steady)
        assert policy.cost == pytest.approx(expected, rel=1e-3)


def _without_schedule() -> dict[str, Any]:
    return {**STRAND, "lubrication": {"lubricant": "manual"}}


def test_cheapest_is_that_of_a_finer_search() -> None:
    (plan,) = study().plans
    steady = plan.parts[0].hours
    at = np.geomspace(1.0, 5000.0, 20_001)
    costs = [1000.0 * (7.0 / interval + 300.0 * mean_factor(interval) / steady) for interval in at]
    assert plan.cheapest.interval == pytest.approx(at[int(np.argmin(costs))], rel=1e-3)
    low, high = plan.cheap
    near = at[np.array(costs) <= 1.05 * min(costs)]
    assert low == pytest.approx(near[0], rel=0.03)
    assert high == pytest.approx(near[-1], rel=0.03)


def test_missed_relubrication_by_hand() -> None:
    """Every 100 h: 100 h beyond the first 100 wear by the ramp from 50 to 150 h, 1 + 4 x (0.25 + 0.75)/2."""
    (plan,) = study("lubrication.interval_hours=100").plans
    once = 50.0 + 50.0 * (1.0 + 4.0 * 0.125)
    more = 50.0 + 150.0 * (1.0 + 4.0 * 0.5 * 0.75) - 2.0 * once
    assert plan.missed.lost == pytest.approx(more * 100.0 / once, rel=1e-9)
    assert plan.missed.cost == pytest.approx(more * 300.0 / plan.parts[0].hours - 7.0, rel=1e-9)


def test_lives_are_those_of_the_case_at_that_interval() -> None:
    (plan,) = study().plans
    for policy in plan.policies[::3]:
        case = wearsim.load_case(STRAND, [f"lubrication.interval_hours={policy.interval!r}"])
        assert policy.lives["sprocket"] == pytest.approx(wearsim.simulate(case).life.hours_run, rel=2e-2)


@pytest.mark.parametrize(
    "setting",
    [
        "price_per_application=9",
        "minutes_per_application=50",
        "labour_cost_per_hour=90",
        "dry_factor=9",
        "lasts_hours=60",
        "fades_over_hours=20",
    ],
)
def test_key_moves_the_cheapest_interval(setting: str) -> None:
    (plan,), (other,) = study().plans, study(f"lubrication.{setting}").plans
    assert other.cheapest.cost != pytest.approx(plan.cheapest.cost, rel=1e-4)


@pytest.mark.parametrize("setting", ["chain_price=5", "sprocket_price=30"])
def test_price_of_the_parts(setting: str) -> None:
    """A strand has no chain that wears."""
    (plan,), (other,) = study().plans, study(f"maintenance.{setting}").plans
    assert (other.cheapest.cost == plan.cheapest.cost) == setting.startswith("chain")


OPTIONS: dict[str, Any] = {
    "lubricant": "greased",
    "lasts_hours": 80.0,
    "fades_over_hours": 10.0,
    "dry_factor": 20.0,
    "price_per_application": 4.0,
    "minutes_per_application": 60.0,
    "completeness": 1.0,
    "contamination_removed": 1.0,
}


def test_option_takes_the_place_of_the_lubricant() -> None:
    tables = {**STRAND, "lubrication": {**STRAND["lubrication"], "option": [OPTIONS]}}
    first, second = study(tables=tables).plans
    assert (first.name, second.name) == ("manual", "greased")
    assert (second.lasts, second.fades, second.dry_factor) == pytest.approx((80.0, 10.0, 20.0))
    alone = {**STRAND, "lubrication": {"interval_hours": 40.0, "labour_cost_per_hour": 30.0, **OPTIONS}}
    (expected,) = study(tables=alone).plans
    assert second.cheapest.cost == expected.cheapest.cost
    assert (
        study(tables=tables).cheapest.name == min((first, second), key=lambda plan: plan.cheapest.cost).name
    )


DRIP: dict[str, Any] = {"lubricant": "drip", "consumption_ml_per_hour": 5.0, "price_per_litre": 8.0}


def test_supply_by_hand() -> None:
    """5 ml an hour at 8 a litre are 40 in 1000 h, beside 300 a life; dust multiplies the wear by 3.6."""
    tables = {**STRAND, "lubrication": {**STRAND["lubrication"], "environment": "dust", "option": [DRIP]}}
    found = study(tables=tables)
    clean = wearsim.simulate(wearsim.load_case({**STRAND, "lubrication": {"lubricant": "drip"}}))
    life, low, high = (end.hours_run for end in (clean.life, clean.life_low, clean.life_high))
    # Dust wears 1.8 to 6.3 times as fast.
    low, high = life / spread(life / low, 6.3 / 3.6) / 3.6, life * spread(high / life, 2.0) / 3.6
    life /= 3.6
    (policy,) = found.plans[1].policies
    assert policy.lives["sprocket"] == pytest.approx(life, rel=1e-9)
    assert policy.wear_factor == pytest.approx(3.6)
    costs = [40.0 + 1000.0 * 300.0 / hours for hours in (life, high, low)]
    assert [policy.cost, policy.cost_low, policy.cost_high] == pytest.approx(costs, rel=1e-9)
    text = lubrication_text(found)
    assert (
        f"Cost       all the time, {grouped(costs[0])} ({grouped(costs[1])} to {grouped(costs[2])})" in text
    )
    assert (found.cheapest.name, "Pays       drip, all the time" in text) == ("drip", True)
    row = policy_rows(found)[-1]
    assert (row["lubricant"], row["interval_hours"], row["relubrications_per_1000_h"]) == ("drip", None, 0.0)


def test_supply_without_a_price_is_said() -> None:
    """Its oil may cost what is left to the cheapest interval of the other."""
    option = {"lubricant": "oil bath"}
    found = study(tables={**STRAND, "lubrication": {**STRAND["lubrication"], "option": [option]}})
    applied, supplied = found.plans
    life = wearsim.simulate(wearsim.load_case({**STRAND, "lubrication": option})).life.hours_run
    assert supplied.cost_without_oil == pytest.approx(1000.0 * 300.0 / life, rel=1e-9)
    assert policy_rows(found)[-1]["cost_per_1000_h"] is None
    left = applied.cheapest.cost - 1000.0 * 300.0 / life
    text = " ".join(lubrication_text(found).split())
    assert "Cost without its oil: give consumption_ml_per_hour and price_per_litre" in text
    assert f"oil bath pays where its oil costs less than {grouped(left)} per 1000 h" in text
    assert found.cheapest is applied
    assert supplied.cheapest is None


def test_none_is_the_cheapest_while_a_life_is_not_reached() -> None:
    """Drip outlives a run that ends between the lives of both, so it may be the cheaper one."""
    applied_life = wearsim.simulate(wearsim.load_case(STRAND)).life.hours_run
    option = {"lubricant": "drip", "consumption_ml_per_hour": 5.0, "price_per_litre": 8.0}
    tables = {
        **STRAND,
        "lubrication": {**STRAND["lubrication"], "option": [option]},
        "run": {**STRAND.get("run", {}), "horizon_hours": 1.01 * applied_life},
    }
    found = study(tables=tables)
    applied, supplied = found.plans
    assert applied.cheapest is not None and supplied.cheapest is None
    assert found.cheapest is None
    assert "Pays not known, as there is no least cost for drip (the life" in " ".join(
        lubrication_text(found).split()
    )


def test_applied_one_beside_a_supply_of_the_case(tmp_path: Path) -> None:
    table = {**DRIP, "labour_cost_per_hour": 30.0, "option": [{**OPTIONS, "lubricant": "manual"}]}
    found = study(tables={**STRAND, "lubrication": table})
    alone = {"labour_cost_per_hour": 30.0, **OPTIONS, "lubricant": "manual"}
    (expected,) = study(tables={**STRAND, "lubrication": alone}).plans
    assert [plan.supplied for plan in found.plans] == [True, False]
    assert found.plans[1].cheapest.cost == expected.cheapest.cost
    json.dumps(lubrication_json(found), allow_nan=False)
    LubricationResult(found).save(tmp_path / "out")
    assert (tmp_path / "out" / "intervals.csv").exists()


@pytest.mark.parametrize(
    ("table", "key", "words"),
    [
        ({**DRIP, "price_per_litre": None}, "consumption_ml_per_hour", "needs price_per_litre too"),
        ({**DRIP, "consumption_ml_per_hour": None}, "price_per_litre", "needs consumption_ml_per_hour too"),
        ({**OPTIONS, "price_per_litre": 8.0}, "price_per_litre", "give price_per_application instead"),
        ({**DRIP, "price_per_application": 2.0}, "price_per_application", "does not apply to a lubricant"),
    ],
)
def test_costs_that_do_not_fit_the_supply_are_named(table: dict[str, Any], key: str, words: str) -> None:
    option = {name: value for name, value in table.items() if value is not None}
    tables = {**STRAND, "lubrication": {**STRAND["lubrication"], "option": [option]}}
    with pytest.raises(wearsim.CaseError, match=words) as caught:
        study(tables=tables)
    assert [fault.key for fault in caught.value.faults] == [f"lubrication.option.1.{key}"]


def answered(printed: str) -> Any:
    """The JSON of an answer, which click before 8.2 prints among what is said on the way."""
    return json.loads(next(line for line in printed.splitlines() if line.startswith("{")))


def run(*words: str) -> Any:
    return CliRunner().invoke(wearsim_command, ["lubricate", *words], catch_exceptions=True)


@pytest.mark.wide
def test_shipped_case_answers(tmp_path: Path) -> None:
    out = tmp_path / "out"
    done = run("bicycle-17t-lubricants", "--json", "--out", str(out))
    assert done.exit_code == 0, done.output
    found = answered(done.stdout)
    assert [one["lubricant"] for one in found["lubricants"]] == ["wet drip", "wax drip", "immersion wax"]
    assert found["cheapest_lubricant"] == "immersion wax"
    assert sorted(path.name for path in out.iterdir() if not path.name.startswith(".")) == [
        "intervals.csv",
        "lubrication.png",
        "lubrication.svg",
        "lubrication.txt",
    ]
    text = (out / "lubrication.txt").read_text("utf-8")
    assert "Pays" in text
    assert "nan" not in text


@pytest.mark.wide
def test_whole_drive_has_all_its_parts(tmp_path: Path) -> None:
    table = '\n[lubrication]\nlubricant = "manual"\nlasts_hours = 50\ninterval_hours = 60000\n'
    text = (CASES / "drives" / "packaging-conveyor.toml").read_text("utf-8")
    text = text.replace('[wear]\ncondition = "hardened, oiled"\n', table).replace("nodes = 201", "nodes = 61")
    path = tmp_path / "drive.toml"
    rough = "\n[run]\nlife_tolerance = 0.1\n[mechanism]\nphases = 2\n[stop]\ncritical_depth_mm = 0.05\n"
    path.write_text(text + rough, "utf-8")
    done = run(str(path), "--json")
    assert done.exit_code == 0, done.output
    found = answered(done.stdout)
    (first, *_) = found["policies"]
    assert {"chain_life_hours", "motor_life_hours", "conveyor_life_hours"} <= first.keys()
    lives = answered(CliRunner().invoke(wearsim_command, ["life", str(path), "--json"]).stdout)
    own = next(row for row in found["policies"] if math.isclose(row["interval_hours"], 6e4))
    assert own["chain_life_hours"] == pytest.approx(lives["chain_life_hours"], rel=1e-9)
    key = "lubrication.interval_hours = 60000 is longer than the life of the"
    for warnings in (found["warnings"], lives["warnings"]):
        texts = [text for text in warnings if "never relubricated" in text]
        assert [text.split(", ")[0] for text in texts] == [
            f"{key} chain",
            f"motor: {key} sprocket",
            f"conveyor: {key} sprocket",
        ]
        assert all(text.endswith("gone from 50 h on") for text in texts), texts


def test_late_relubrication_is_named_for_each_lubricant() -> None:
    """50 and 200 h of the one, 80 and 10 h of the other."""
    tables = {**STRAND, "lubrication": {**STRAND["lubrication"], "option": [OPTIONS]}}
    found = study("lubrication.interval_hours=9000", tables=tables)
    texts = [text for text in found.warnings if "never relubricated" in text]
    key = "lubrication.interval_hours = 9000 is longer than the life of the flank"
    assert texts[0].startswith(key)
    assert texts[0].endswith("gone from 250 h on")
    assert texts[1].startswith(f"greased: {key}")
    assert texts[1].endswith("gone from 90 h on")
    assert all(text in lubrication_text(found).replace("\n             ", " ") for text in texts)


def test_ways_of_different_units_are_one_interval() -> None:
    """The flanks of the strand slide so many m in the hours of an interval."""
    in_hours = wearsim.load_case(STRAND)
    clock = case_clock(in_hours)
    way = {"lasts_hours": 50.0, "interval_sliding_m": 20.0}
    table = {**{k: v for k, v in STRAND["lubrication"].items() if k != "interval_hours"}, **way}
    (plan,) = study(tables={**STRAND, "lubrication": table}).plans
    by_hours = {**STRAND["lubrication"], "interval_hours": plan.own.interval}
    (same,) = study(tables={**STRAND, "lubrication": by_hours}).plans
    assert clock.lubricant.repeats / in_hours.cycles_per_hour == pytest.approx(40.0)
    assert same.own.lives == pytest.approx(plan.own.lives)


@pytest.mark.parametrize(
    "settings",
    [
        ["wear.cycles_exponent=0.5", "wear.reference_hours=1000"],
        ["wear.running_in_factor=5", "wear.running_in_distance_mm=50000"],
    ],
    ids=["power of the cycles", "running-in"],
)
def test_band_is_that_of_the_life(settings: list[str]) -> None:
    result = wearsim.simulate(wearsim.load_case(STRAND, settings))
    (plan,) = study(*settings).plans
    own = plan.own
    assert own.lives["sprocket"] == pytest.approx(result.life.hours_run, rel=1e-6)
    assert own.lives_low["sprocket"] == pytest.approx(result.life_low.hours_run, rel=1e-6)
    assert own.lives_high["sprocket"] == pytest.approx(result.life_high.hours_run, rel=1e-6)


def spread(*factors: float) -> float:
    """Factor of independent causes together: logarithms add as squares."""
    return math.exp(math.hypot(*map(math.log, factors)))


WRAP = changed(
    LIGHT_WRAP,
    {
        "run.life_tolerance": 0.1,
        "lubrication": {"lubricant": "manual", "lasts_hours": 30.0, "interval_hours": 20.0},
    },
)


@pytest.mark.parametrize(
    ("settings", "part", "ends"),
    [
        # Of the conditions, mm2/N: joints 1.2e-10, 1.8e-10 and 1e-9, teeth 2.5e-11, 7.5e-11 and 2.3e-10; with
        # the spread of the rules on joints, 1/2 and 2.5, and 1.8 as 200 rpm are beyond 500 to 1500 rpm.
        (["stop.critical_depth_mm=1"], "chain", (1.0 / spread(10 / 1.8, 2.5, 1.8), spread(1.5, 2.0, 1.8))),
        (["stop.critical_depth_mm=0.01"], "sprocket", (1.0 / spread(2.3 / 0.75, 1.8), spread(3.0, 1.8))),
        (
            ["stop.critical_depth_mm=1", "joint.specific_wear_rate_mm2_per_N=1.8e-10"],
            "chain",
            (1.0 / 3.0, 3.0),
        ),
    ],
    ids=["joints", "teeth", "joints without a band"],
)
def test_band_of_a_part_is_the_same_in_life_and_lubricate(
    settings: list[str], part: str, ends: tuple[float, float]
) -> None:
    """Relubricated in time, so that lives go with one over the coefficient of what ends them."""
    case = wearsim.load_case(WRAP, settings)
    result = wearsim.simulate(case)
    assert result.life == result.parts[part]
    expected = [end * result.life.hours_run for end in ends]
    assert [result.life_low.hours_run, result.life_high.hours_run] == pytest.approx(expected, rel=1e-9)
    ruled = "spread of the published rules" in result.band
    assert ruled == ("joint." not in str(settings) and part == "chain")
    own = study(*settings, tables=WRAP).plans[0].own
    assert [own.lives_low[part], own.lives_high[part]] == pytest.approx(expected, rel=1e-9)


def test_band_of_a_chain_that_runs_in_is_that_of_life() -> None:
    """Its joints run in by their own way, not by that of the teeth."""
    settings = ["wear.running_in_factor=5", "wear.running_in_distance_mm=5e5", "stop.critical_depth_mm=1"]
    result = wearsim.simulate(wearsim.load_case(WRAP, settings))
    assert result.life == result.parts["chain"]
    own = study(*settings, tables=WRAP).plans[0].own
    assert own.lives_low["chain"] == pytest.approx(result.life_low.hours_run, rel=1e-6)
    assert own.lives_high["chain"] == pytest.approx(result.life_high.hours_run, rel=1e-6)


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        (["lubrication.dry_factor=1"], "never within a life"),
        (["lubrication.price_per_application=1e6"], "never within a life"),
        (["lubrication.price_per_application=0", "lubrication.minutes_per_application=0"], "costs nothing"),
    ],
)
def test_no_interval_is_made_up(settings: list[str], words: str) -> None:
    (plan,) = study(*settings).plans
    assert plan.cheapest is None
    assert words in plan.unknown
    assert words in lubrication_text(study(*settings))


def test_missed_one_is_not_told_where_a_part_does_not_outlive_it() -> None:
    (plan,) = study("lubrication.interval_hours=3000").plans
    assert (plan.missed.lost, plan.missed.cost) == (None, None)


def test_option_without_a_lubricant_is_named() -> None:
    tables = {**STRAND, "lubrication": {**STRAND["lubrication"], "option": [OPTIONS, {"lubricant": "dry"}]}}
    with pytest.raises(wearsim.CaseError) as caught:
        study(tables=tables)
    assert {fault.key for fault in caught.value.faults} == {"lubrication.option.2.lubricant"}
    assert "changed" not in str(caught.value)


@pytest.mark.parametrize(
    "own", [{"wear": {"condition": "hardened, oiled"}}, {"wear": {"specific_wear_rate_mm2_per_N": 1e-9}}]
)
def test_lubricants_of_one_wear_rate_are_not_compared(own: dict[str, Any]) -> None:
    tables = {**STRAND, **own, "lubrication": {**STRAND["lubrication"], "option": [OPTIONS]}}
    with pytest.raises(wearsim.CaseError, match="holds for one lubricant"):
        study(tables=tables)


@pytest.mark.parametrize(
    ("tables", "words"),
    [
        ({"lubricant": "drip"}, "how long a lubricant lasts"),
        ({"lubricant": "drip", "environment": "dust"}, "how long a lubricant lasts"),
        ({"lubricant": "dry", "environment": "dust"}, "how long a lubricant lasts"),
        (None, "how long a lubricant lasts"),
        ({"lubricant": "manual", "lasts_hours": 9, "phase": [{"hours": 9}]}, "relubricates by itself"),
    ],
)
def test_case_without_intervals_is_refused(tmp_path: Path, tables: dict[str, Any] | None, words: str) -> None:
    case = {**STRAND, "wear": {"condition": "hardened, oiled"}, "lubrication": tables}
    if tables is None:
        del case["lubrication"]
    with pytest.raises(wearsim.CaseError, match=words):
        study(tables=case)


def test_without_prices_no_cost_is_made_up() -> None:
    tables = {key: value for key, value in STRAND.items() if key != "maintenance"}
    (plan,) = study(tables=tables).plans
    assert plan.cheapest is None
    assert all(policy.cost is None for policy in plan.policies)
