"""What ends a part first, and what happens when: by hand, without a run."""

import numpy as np
import pytest

from wearsim.result import Life, LowerBound
from wearsim.result.ends import PartEnd, before_wear, ends_json, first_end_keys, part_ends, wear_only
from wearsim.result.events import drive_events

IMPACT = PartEnd("chain", "roller and bush impact", 2500.0, 1250.0, 5000.0)
WORN = PartEnd("chain", "joint wear", 6000.0, 2000.0, 18_000.0)
TEETH = PartEnd("a", "tooth wear", 20_000.0, 7000.0, 60_000.0)


def told(ends, inputs=None, grown=(0.0, 1.0, 2.0), limit=3.0, replaced=None):
    """Events of a chain that grows by 1 % in every 2000 h."""
    elongation = np.array(grown)
    history = {
        "chain": np.ones(len(grown)),
        "time_hours": 2000.0 * elongation,
        "elongation_percent": elongation,
    }
    found = drive_events({"wear": {}, **(inputs or {})}, history, limit, ends, replaced)
    return [(one.hours, one.part, one.event) for one in found]


def elongations(*arguments, **options):
    return [
        (hours, text[:14])
        for hours, _, text in told(*arguments, **options)
        if text.startswith("elongation 1")
    ]


def test_an_elongation_that_the_run_did_not_reach_is_no_event():
    bound = PartEnd("chain", "joint wear", 2400.0, reached=False)
    assert elongations([bound], grown=(0.0, 0.5, 1.2)) == [(2000.0, "elongation 1 %")]
    assert elongations([bound], grown=(0.0, 0.577)) == []
    assert elongations([WORN]) == [(2000.0, "elongation 1 %"), (3000.0, "elongation 1.5")]


def test_what_ends_the_chain_before_wear_is_an_event():
    """Impact ends it at 2500 h: it is never grown by 1.5 % (3000 h), nor by 3 % (6000 h)."""
    assert [one for one in told([IMPACT, WORN]) if one[0] > 20.0] == [
        (2000.0, "chain", "elongation 1 %"),
        (2500.0, "chain", "roller and bush impact: at its end"),
    ]


def test_parts_are_replaced_as_planned():
    found = told([WORN, TEETH], replaced={"chain": 6000.0, "a": 18_000.0})
    assert found[-2:] == [
        (6000.0, "chain", "elongation 3 %: replace it"),
        (18_000.0, "a", "replace it; teeth worn to their limit at 20 000 h"),
    ]
    assert told([WORN, TEETH])[-2:] == [
        (6000.0, "chain", "elongation 3 %: worn out"),
        (20_000.0, "a", "teeth worn to their limit: worn out"),
    ]


@pytest.mark.parametrize(
    ("table", "expected"),
    [
        ({"at_hours": [100.0, 300.0]}, [(100.0, ""), (300.0, "")]),
        ({"interval_hours": 50.0}, [(50.0, ", then every 50 h")]),
        ({"at_hours": [100.0], "interval_hours": 50.0}, [(100.0, ""), (150.0, ", then every 50 h")]),
        ({"at_km": [30.0], "interval_km": 60.0}, [(1.0, ""), (3.0, ", then every 2 h")]),
        ({"interval_sliding_m": 40.0}, [(None, " every 40 m of sliding")]),
        ({"at_hours": [100.0], "interval_sliding_m": 40.0}, [(100.0, ""), (None, " every 40 m of sliding")]),
        ({"when_rate_exceeds": 2.0}, [(None, " as soon as the contacts wear 2 times as fast")]),
    ],
)
def test_relubrications(table, expected):
    """30 km are 1 h; an interval counts from the last of the given times."""
    found = told([WORN], {"lubrication": table, "service": {"km_per_hour": 30.0}})
    assert [(hours, text) for hours, part, text in found if part == "drive"] == [
        (hours, f"relubrication{text}") for hours, text in expected
    ]


def test_bedding_in_is_counted_where_the_case_gives_it():
    (_, _, text), *_ = told([WORN], {"wear": {"running_in_factor": 3.0, "running_in_distance_mm": 1e5}})
    assert text.endswith("counted by running_in_factor")
    assert told([WORN])[0][2].endswith("not counted in the life")


def test_the_band_of_a_bound_is_one():
    """Rates of a third to three times: at least 30 000 h over and times 3."""
    band = LowerBound(1.0, 10_000.0), LowerBound(9.0, 90_000.0)
    (end,) = ends_json(part_ends({"chain": LowerBound(3.0, 30_000.0)}, {"chain": band}, ()))
    hours = {key: value for key, value in end.items() if key.startswith("life_hours")}
    assert hours == {
        "life_hours": None,
        "life_hours_at_least": 30_000.0,
        "life_hours_low": None,
        "life_hours_low_at_least": 10_000.0,
        "life_hours_high": None,
        "life_hours_high_at_least": 90_000.0,
    }
    band = Life(1.0, 2000.0), Life(9.0, 18_000.0)
    (end,) = ends_json(part_ends({"chain": Life(3.0, 6000.0)}, {"chain": band}, ()))
    assert (end["life_hours_low"], end["life_hours_high"]) == (2000.0, 18_000.0)
    assert end["life_hours_low_at_least"] is end["life_hours_high_at_least"] is None


def test_what_ends_first_is_named():
    assert first_end_keys([IMPACT, WORN]) == {
        "first_end_hours": 2500.0,
        "first_end_mode": "roller and bush impact",
        "first_end_part": "chain",
    }
    assert set(first_end_keys([PartEnd("chain", "joint wear", 9.0, reached=False)]).values()) == {None}
    assert before_wear([IMPACT, WORN, TEETH]) == before_wear([IMPACT, WORN, TEETH], "chain") == IMPACT
    assert before_wear([IMPACT, WORN, TEETH], "a") is before_wear([WORN, TEETH]) is None
    assert wear_only([WORN, TEETH]) and not wear_only([WORN, IMPACT])
