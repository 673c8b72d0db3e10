"""A life that is not known is told with what it exceeds, wherever it is told."""

from wearsim.chain.drive_layout import ToothMeetings
from wearsim.result import Life, LowerBound
from wearsim.study.maintain.model import MaintenancePlan, ReplacementPolicy
from wearsim.study.maintain.sheet import counts_table, maintenance_text, policies_table
from wearsim.study.maintain.tooth_count import ToothCount
from wearsim.study.remaining.model import RemainingLife, SingleReading
from wearsim.study.remaining.sheet import remaining_json, remaining_text


def test_policy_of_a_sprocket_that_outlives_the_run():
    """50 000 h with chains of 20 000 h: the third is in use."""
    policy = ReplacementPolicy(0.02, False, 20_000.0, LowerBound(3e9, 50_000.0), 0.001)
    known = ReplacementPolicy(0.03, False, 20_000.0, Life(3e9, 50_000.0), 0.001)
    count = ToothCount(ToothMeetings(19, 100), True, {"chain": Life(1e9, 20_000.0)})
    plan = MaintenancePlan("a", "A", (policy, known), (count,), 0.03, (), (), ())
    bound, row = policies_table(plan).records()
    assert (bound["sprocket_life_hours"], bound["sprocket_life_hours_at_least"]) == (None, 50_000.0)
    assert (bound["chains_per_sprocket"], bound["chains_per_sprocket_at_least"]) == (None, 3)
    assert bound["last_chain_used"] is bound["stops"] is None
    assert (row["sprocket_life_hours"], row["sprocket_life_hours_at_least"]) == (50_000.0, None)
    assert (row["chains_per_sprocket"], row["chains_per_sprocket_at_least"]) == (3, None)
    assert (row["last_chain_used"], row["stops"]) == (0.5, 3)
    shown = maintenance_text(plan).splitlines()[2]
    assert " ".join(shown.split()) == "2 % no 20 000 h > 2 - > 50 000 h - -"
    (counted,) = counts_table(plan).records()
    assert counted["chain_life_hours"] == 20_000.0
    assert counted["sprocket_life_hours"] is counted["sprocket_life_hours_at_least"] is None


def test_what_is_left_of_a_life_that_the_run_does_not_reach():
    """At 30 km an hour more than 1000 h are more than 30 000 km."""
    inputs = {"service": {"km_per_hour": 30.0}}
    bound, life = LowerBound(6e6, 1000.0), Life(3e6, 500.0)
    reading = SingleReading("max_depth_mm", 0.1, 0.01, 200.0)
    found = RemainingLife("a", "A", "sprocket", reading, 100.0, 0.5, 1e-10, bound, bound, life, bound, (), ())
    content = remaining_json(found, inputs)
    for name in ("life_hours", "remaining_hours", "remaining_hours_high"):
        assert (content[name], content[f"{name}_at_least"]) == (None, 1000.0)
    assert content["remaining_hours_low"] == 500.0
    assert content["remaining_hours_low_at_least"] is None
    assert content["service_at_least"] == {"km": 30_000.0}
    assert "service" not in content
    assert "In service more than 30 000 km" in " ".join(remaining_text(found, inputs).split())
