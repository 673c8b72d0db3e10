"""What ends a life, by hand."""

import numpy as np

from wearsim.contact.stop_limits import depth_limit, first_limit_met, tip_land_limit

ZERO = np.zeros(3)


def test_depth_limit_looks_at_the_deepest_point() -> None:
    stop_limit = depth_limit(0.2)
    assert stop_limit.name == "critical_depth_mm"
    assert stop_limit.limit == 0.2
    assert stop_limit.margin(ZERO, ZERO, np.array([0.0, 0.15, 0.1])) == 0.2 - 0.15


def test_tip_land_limit_asks_the_tooth() -> None:
    stop_limit = tip_land_limit(3.0, lambda x, y: 5.0 - float(x[-1]))
    assert stop_limit.name == "min_tip_land_mm"
    assert stop_limit.margin(np.array([0.0, 0.0, 1.5]), ZERO, ZERO) == 0.5


def test_no_limit_is_met_while_all_hold() -> None:
    assert first_limit_met((depth_limit(0.2),), ZERO, ZERO, np.full(3, 0.19)) is None


def test_limit_is_met_when_it_is_reached_exactly() -> None:
    stop_limit = depth_limit(0.2)
    assert first_limit_met((stop_limit,), ZERO, ZERO, np.full(3, 0.2)) is stop_limit


def test_limit_that_fails_by_most_is_named() -> None:
    depth, tip = depth_limit(0.2), tip_land_limit(3.0, lambda x, y: 2.5)
    assert first_limit_met((depth, tip), ZERO, ZERO, np.full(3, 0.3)) is tip
    assert first_limit_met((depth, tip), ZERO, ZERO, np.full(3, 0.9)) is depth
