"""What ends a life, by hand."""

from types import SimpleNamespace

import numpy as np
import pytest

from tests.drives import STRAND, changed, depth_limit
from wearsim.case.keys.wear_tables import StopTable
from wearsim.case.model import Drive
from wearsim.cli.schema import result_schema
from wearsim.contact.stop_limits import LIMITS, stop_limit
from wearsim.drive.load_case import load_case
from wearsim.mechanisms.gear_pair.keys import GearStopTable
from wearsim.page.field_words import label
from wearsim.wear.problem import WearProblem

ZERO = np.zeros(3)
ON_A_STRAND = ["critical_depth_mm", "case_depth_mm", "min_tip_land_mm", "min_tooth_thickness_mm"]


def first_limit_met(limits, x, y, depth):
    return WearProblem(None, None, limits, 1.0).met(x, y, depth)


def tip_land(value):
    return stop_limit("min_tip_land_mm", 3.0, value)


def test_depth_limit_looks_at_the_deepest_point() -> None:
    limit = depth_limit(0.2)
    assert limit.name == "critical_depth_mm"
    assert limit.limit == 0.2
    assert limit.margin(ZERO, ZERO, np.array([0.0, 0.15, 0.1])) == 0.2 - 0.15


def test_tip_land_limit_asks_the_tooth() -> None:
    limit = tip_land(lambda x, y, depth: 5.0 - float(x[-1]))
    assert limit.name == "min_tip_land_mm"
    assert limit.margin(np.array([0.0, 0.0, 1.5]), ZERO, ZERO) == 0.5


def test_no_limit_is_met_while_all_hold() -> None:
    assert first_limit_met((depth_limit(0.2),), ZERO, ZERO, np.full(3, 0.19)) is None


def test_limit_is_met_when_it_is_reached_exactly() -> None:
    limit = depth_limit(0.2)
    assert first_limit_met((limit,), ZERO, ZERO, np.full(3, 0.2)) is limit


def test_limit_that_fails_by_most_is_named() -> None:
    depth, tip = depth_limit(0.2), tip_land(lambda x, y, depth: 2.5)
    assert first_limit_met((depth, tip), ZERO, ZERO, np.full(3, 0.3)) is tip
    assert first_limit_met((depth, tip), ZERO, ZERO, np.full(3, 0.9)) is depth


def test_every_key_of_the_input_is_in_the_list_and_the_other_way_round() -> None:
    keys = {*StopTable.model_fields, *GearStopTable.model_fields}
    assert keys == set(LIMITS) == set(result_schema()["$defs"]["life"]["properties"]["stop"]["enum"][:-1])


@pytest.mark.parametrize("row", LIMITS.values(), ids=LIMITS)
def test_every_limit_has_its_words(row) -> None:
    assert label(row.key) == row.label
    ending = (row.ending_unset or row.ending).format(value=1.0, depth="1.0")
    assert ending.startswith("until ")
    assert bool(row.new) == bool(row.needs) == bool(row.new_words) == row.falling


def test_limits_on_the_depth_come_first_and_those_of_a_tooth_need_one() -> None:
    case = load_case(changed(STRAND, {f"stop.{key}": 0.1 for key in LIMITS if key in ON_A_STRAND}))
    assert [one.name for one in case.drive.tooth_limits(case)] == ON_A_STRAND
    flank = SimpleNamespace(critical_depth=0.1, more_limits=case.more_limits)
    assert [one.name for one in Drive().tooth_limits(flank)] == ON_A_STRAND[:2]
