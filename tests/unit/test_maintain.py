"""Policies of maintenance: bookkeeping by hand, against the run of the life itself and one another."""

import copy
import math
from pathlib import Path

import numpy as np
import pytest

import wearsim
from tests.drives import FAST_WRAP, changed, depth_limit
from wearsim.case.keys import MaintenanceTable
from wearsim.contact.resting_engagement import MateWear
from wearsim.drive.wear_task import wear_law
from wearsim.errors import CaseError
from wearsim.report.answer import answer
from wearsim.result import Life, LowerBound
from wearsim.study.maintain.model import MaintenancePlan, ReplacementPolicy, cost_per_1000_hours, maintain
from wearsim.study.maintain.reversed_sprocket import reversed_life
from wearsim.study.maintain.sheet import maintenance_page, maintenance_text, policies_table
from wearsim.study.maintain.tooth_count import meetings_around, variant
from wearsim.wear.implicit_steps import run_resting
from wearsim.wear.problem import StartState, WearProblem

CASES = Path(__file__).parents[2] / "cases"

DRIVE = changed(
    FAST_WRAP,
    {
        "stop.critical_depth_mm": 0.04,
        "run.life_tolerance": 0.1,
        "maintenance": {
            "replace_at_percent": [1.0, 3.0],
            "turn_sprocket": True,
            "chain_price": 40.0,
            "sprocket_price": 60.0,
            "downtime_hours": 2.0,
            "downtime_cost_per_hour": 30.0,
        },
    },
)


def case(**tables):
    """The drive with keys of its tables changed, or dropped where None."""
    changed = copy.deepcopy(DRIVE)
    for table, keys in tables.items():
        changed.setdefault(table, {}).update(keys)
        changed[table] = {key: value for key, value in changed[table].items() if value is not None}
    return wearsim.load_case(changed)


@pytest.fixture(scope="module")
def plan():
    told = []
    found = maintain(case(), lambda *step: told.append(step))
    assert [step[:2] for step in told] == [(done, 7) for done in range(7)]
    return found


@pytest.fixture(scope="module")
def life():
    """The run of ``wearsim life`` to the sprocket's limit."""
    return wearsim.simulate(case())


@pytest.fixture
def without_counts(monkeypatch):
    monkeypatch.setattr("wearsim.study.maintain.model.meetings_around", lambda case, drive: ())


def policy(plan, percent, reversed_=False):
    (found,) = (
        p for p in plan.policies if p.reversed_ == reversed_ and math.isclose(100 * p.replace_at, percent)
    )
    return found


@pytest.mark.parametrize(
    ("prices", "cost"),
    [
        ({"chain_price": 40.0, "sprocket_price": 60.0}, 1000 * (3 * 40 + 60) / 8000),
        (
            {
                "chain_price": 40.0,
                "sprocket_price": 60.0,
                "downtime_hours": 2.0,
                "downtime_cost_per_hour": 30.0,
            },
            1000 * (3 * 40 + 60 + 4 * 2 * 30) / 8000,
        ),
        ({}, None),
    ],
)
def test_cost_by_hand(prices, cost):
    assert cost_per_1000_hours(MaintenanceTable(**prices), 8000.0, 3, 4) == cost


@pytest.mark.parametrize(
    ("hours", "chains", "used", "stops"), [(2500.0, 3, 0.5, 3), (3000.0, 3, 1.0, 3), (400.0, 1, 0.4, 1)]
)
def test_chains_and_stops_by_hand(hours, chains, used, stops):
    """Chains of 1000 h each; the last one goes with the sprocket, in the same stop."""
    new = ReplacementPolicy(0.03, False, 1000.0, Life(1.0, hours), 0.0)
    assert (new.chains, new.stops) == (chains, stops)
    assert new.last_chain_used == pytest.approx(used, abs=1e-9)
    assert ReplacementPolicy(0.03, True, 1000.0, Life(1.0, hours), 0.0).stops == stops + 1


@pytest.mark.wide
def test_chain_lives_are_linear_in_the_elongation(plan):
    assert policy(plan, 3).chain_hours == pytest.approx(3 * policy(plan, 1).chain_hours, rel=1e-12)


def test_replaced_at_the_limit_is_the_life_itself(plan, life):
    """stop.elongation_percent is 3 here: the same run, whose history counts the chains."""
    found = policy(plan, 3)
    assert found.sprocket == life.parts["sprocket"]
    assert found.chain_hours == pytest.approx(life.parts["chain"].hours, rel=1e-12)
    assert found.chains == life.history_columns["chain"][-1] > 1
    elongation = life.history_columns["elongation_percent"][-1]
    assert found.last_chain_used == pytest.approx(elongation / 3, rel=1e-6)


def test_costs_are_those_of_the_rows(plan):
    for found in plan.policies:
        price = 40 * found.chains + 60 + 60 * found.stops
        assert found.cost == pytest.approx(1000 * price / found.sprocket.hours, rel=1e-12)
    assert plan.cheapest.cost == min(found.cost for found in plan.policies)


def test_earlier_replacement_takes_more_chains_and_turning_lives_longer(plan):
    assert policy(plan, 1).chains > policy(plan, 3).chains
    for percent in (1, 3):
        once, twice = policy(plan, percent), policy(plan, percent, reversed_=True)
        assert once.hours < twice.hours < 2.2 * once.hours
        assert twice.stops == twice.chains + 1


def test_counts_around_the_drive(plan):
    """gcd(18, 120) = 6 and gcd(20, 120) = 20 by hand: even, so one kind of link for life."""
    classes = {(c.meetings.teeth, c.meetings.links): c.meetings.classes for c in plan.counts}
    assert classes == {
        (18, 118): 2,
        (18, 120): 6,
        (18, 122): 2,
        (19, 118): 1,
        (19, 120): 1,
        (19, 122): 1,
        (20, 118): 2,
        (20, 120): 20,
        (20, 122): 2,
    }
    run = {(c.meetings.teeth, c.meetings.links): c.lives for c in plan.counts if c.lives}
    assert set(run) == {(19, 120), (19, 122), (20, 120), (20, 122)}
    assert run[19, 120]["sprocket"] == policy(plan, 3).sprocket
    longer = run[19, 122]["chain"].hours / run[19, 120]["chain"].hours
    assert longer == pytest.approx(122 / 120, rel=1e-3)


def test_other_teeth_are_those_of_a_case_of_their_own():
    own = case()
    teeth = next(c.meetings for c in meetings_around(own, own.drive) if c.meetings.teeth == 20)
    same = case(sprocket={"teeth": 20}, drive={"links": teeth.links})
    found = variant(own, teeth)
    assert np.array_equal(found.drive.outline.x, same.drive.outline.x)
    assert (
        found.inputs["sprocket"]
        == {key: value for key, value in same.inputs["sprocket"].items() if key != "back_flank"}
        or found.inputs["sprocket"] == same.inputs["sprocket"]
    )
    assert found.drive.layout == same.drive.layout


def test_tooth_counts_of_every_second_gap_are_left_out():
    crawler = wearsim.load_case(CASES / "d6-crawler-27t-wrap.toml")
    assert crawler.engaged_every == 2
    assert meetings_around(crawler, crawler.drive) == ()


def test_default_policies_end_with_the_limit(without_counts):
    few = {"maintenance": {"replace_at_percent": None, "turn_sprocket": False}}
    found = maintain(case(**few, stop={"elongation_percent": 1.2, "critical_depth_mm": 0.005}))
    assert [round(100 * p.replace_at, 9) for p in found.policies] == [1.0, 1.2]


def test_a_strand_has_no_chain_to_replace():
    strand = {"teeth": 19, "profile": "evolute", "nodes": 61}
    tables = {
        "format_version": 1,
        "chain": {"designation": "16B-1"},
        "sprocket": strand,
        "load": DRIVE["load"],
        "wear": DRIVE["wear"],
    }
    with pytest.raises(CaseError, match=r"kind = 'wrap'"):
        maintain(wearsim.load_case(tables))


def test_sprocket_whose_limit_is_not_reached(without_counts):
    found = maintain(case(run={"horizon_hours": 5}, maintenance={"replace_at_percent": [3.0]}))
    (only,) = found.policies
    assert only.sprocket == LowerBound(300_000, 5.0)
    assert only.cost is None
    assert found.cheapest is None
    text = maintenance_text(found)
    assert "> 5 h" in text
    assert "raise run.horizon_hours" in text
    (row,) = policies_table(found).records()
    assert (row["life_reached"], row["hours_run"]) == (False, 5.0)
    of_a_life = ("sprocket_life_hours", "chains_per_sprocket", "last_chain_used", "stops")
    assert [row[name] for name in of_a_life] == [None] * 4


def test_a_run_goes_on_from_where_another_ended():
    """Half and half is the whole, as near as steps are (first order: smaller with each level)."""
    drive = case(stop={"critical_depth_mm": 0.02})
    contact = drive.drive.contact(drive)
    law, stop_limits = wear_law(drive.wear, drive.wear.coefficient), (depth_limit(0.02),)
    whole = run_resting(WearProblem(contact, law, stop_limits, 1e12), 1)
    half = run_resting(WearProblem(contact, law, stop_limits, 0.5 * whole.cycles[-1]), 1)
    assert half.met is None
    start = StartState(half.all_depth[-1], MateWear(float(half.elongation[-1])), int(half.mates[-1]))
    rest = run_resting(WearProblem(contact, law, stop_limits, 1e12, start), 1)
    assert np.array_equal(rest.all_depth[0], half.all_depth[-1])
    assert rest.x[0] == pytest.approx(half.x[-1], abs=1e-12)
    assert half.cycles[-1] + rest.cycles[-1] == pytest.approx(whole.cycles[-1], rel=0.02)
    assert rest.all_depth[-1].max() == pytest.approx(0.02, rel=1e-12)


def turned_while_new(result):
    """The result of a run as if nothing had worn in it."""
    unworn = copy.copy(result)
    columns = {**result.flank_columns, "depth_mm": 1e-9 * result.flank_columns["depth_mm"]}
    history = {
        **result.history_columns,
        "elongation_percent": np.zeros(1),
        "roller_wear_mm": np.zeros(1),
        "chain": np.ones(1),
    }
    object.__setattr__(unworn, "flank_columns", columns)
    object.__setattr__(unworn, "history_columns", history)
    return unworn


def test_a_sprocket_turned_while_new_lives_as_long_as_one_that_is_not(life):
    """A symmetric gap: mirror image and original live alike when the first side is unworn."""
    again, _ = reversed_life(case(), turned_while_new(life))
    assert again.hours == pytest.approx(life.parts["sprocket"].hours, rel=0.05)


def test_case_depth_of_a_turned_sprocket():
    """It ends both lives as a critical depth of as much would."""
    deep = case(stop={"critical_depth_mm": 0.04, "case_depth_mm": 0.01})
    first = wearsim.simulate(deep)
    assert first.limits[1].name == "case_depth_mm"
    assert first.history_columns["max_depth_mm"][-1] == pytest.approx(0.01, rel=1e-9)
    fresh, _ = reversed_life(deep, turned_while_new(first))
    assert fresh.hours == pytest.approx(first.parts["sprocket"].hours, rel=0.05)
    shallow = case(stop={"critical_depth_mm": 0.01})
    expected, _ = reversed_life(shallow, wearsim.simulate(shallow))
    again, _ = reversed_life(deep, first)
    assert again.hours == pytest.approx(expected.hours, rel=0.05)


def test_a_seat_worn_through_is_worn_for_both_flanks(life):
    worn = copy.copy(life)
    columns = {**life.flank_columns, "depth_mm": 0.04 + 0.0 * life.flank_columns["depth_mm"]}
    object.__setattr__(worn, "flank_columns", columns)
    assert reversed_life(case(), worn) == (Life(0.0, 0.0), 0.0)


def test_page_and_text_hold_the_same_numbers(plan):
    text, page = maintenance_text(plan, explain=True), maintenance_page(plan)
    for found in plan.policies:
        for shown in (f"{found.chains}", f"{found.last_chain_used:.0%}".replace("%", " %")):
            assert shown in text and shown in page
    assert max(map(len, text.splitlines())) <= 100
    for shown in (" ".join(text.split()), page):
        assert "- in the table of teeth and links: life not calculated" in shown
    assert "new chain at" in text and "new chain at" in page


def test_policies_are_those_asked_for(without_counts, plan):
    """Without turning, and at 1 % only: the row of the plan with both."""
    one = {"replace_at_percent": [1.0], "turn_sprocket": False}
    assert policies_table(maintain(case(maintenance=one))).records() == policies_table(plan).records()[:1]


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("chain_price", 41.0),
        ("sprocket_price", 61.0),
        ("downtime_hours", 3.0),
        ("downtime_cost_per_hour", 31.0),
    ],
)
def test_every_price_raises_the_cost(plan, key, value):
    table = MaintenanceTable(**{**DRIVE["maintenance"], key: value})
    for found in plan.policies:
        cost = cost_per_1000_hours(table, found.hours, found.chains, found.stops)
        assert cost > found.cost


@pytest.mark.parametrize(
    ("table", "keys", "named"),
    [
        ("maintenance", {"sprocket_price": None}, "maintenance.chain_price"),
        ("maintenance", {"downtime_hours": None}, "maintenance.downtime_cost_per_hour"),
        ("maintenance", {"replace_at_percent": []}, "maintenance.replace_at_percent"),
        ("maintenance", {"replace_at_percent": [1, 11]}, "maintenance.replace_at_percent"),
        ("maintenance", {"replace_at_percent": [2, 2]}, "maintenance.replace_at_percent"),
        ("maintenance", {"replace_at_percent": 2}, "maintenance.replace_at_percent"),
        ("service", {"start_date": "2026-01-01"}, "service.start_date"),
        ("service", {"start_date": "2026-13-01", "hours_per_day": 8}, "service.start_date"),
        ("service", {"hours_per_day": 25}, "service.hours_per_day"),
    ],
)
def test_keys_that_do_not_fit_are_named(table, keys, named):
    with pytest.raises(CaseError) as caught:
        case(**{table: keys})
    assert named in {fault.key for fault in caught.value.faults}


@pytest.mark.parametrize(
    ("key", "value", "shown"),
    [
        ("km_per_hour", 30.0, "km"),
        ("tonnes_per_hour", 12.0, "tonnes"),
        ("hours_per_day", 8.0, "days"),
        ("start_date", "2026-01-01", "date"),
    ],
)
def test_life_in_other_measures(life, key, value, shown):
    """Life times the factor; 1 January and one day in eight hours' steps."""
    given = {key: value, **({"hours_per_day": 8.0} if key == "start_date" else {})}
    result = copy.copy(life)
    object.__setattr__(result, "inputs", {**life.inputs, "service": given})
    hours = life.life.hours
    found = result.summary()["service"][shown]
    if key == "start_date":
        assert found == str(np.datetime64("2026-01-01") + np.timedelta64(int(hours / 8.0), "D"))
    else:
        assert found == pytest.approx(hours / 8.0 if shown == "days" else hours * value)
    assert "In service" in answer(result, "drive.toml")
    assert "service" not in life.summary()


def test_plan_is_what_the_report_takes(plan):
    assert isinstance(plan, MaintenancePlan)
    assert not any("fails" in text for text in plan.warnings)
