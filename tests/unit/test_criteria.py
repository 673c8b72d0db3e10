"""What ends a life, by hand."""

import numpy as np

from wearsim.contact.criteria import depth_criterion, first_met, tip_land_criterion

ZERO = np.zeros(3)


def test_depth_criterion_looks_at_the_deepest_point() -> None:
    criterion = depth_criterion(0.2)
    assert criterion.name == "critical_depth_mm"
    assert criterion.limit == 0.2
    assert criterion.margin(ZERO, ZERO, np.array([0.0, 0.15, 0.1])) == 0.2 - 0.15


def test_tip_land_criterion_asks_the_tooth() -> None:
    criterion = tip_land_criterion(3.0, lambda x, y: 5.0 - float(x[-1]))
    assert criterion.name == "min_tip_land_mm"
    assert criterion.margin(np.array([0.0, 0.0, 1.5]), ZERO, ZERO) == 0.5


def test_no_limit_is_met_while_all_hold() -> None:
    assert first_met((depth_criterion(0.2),), ZERO, ZERO, np.full(3, 0.19)) is None


def test_limit_is_met_when_it_is_reached_exactly() -> None:
    criterion = depth_criterion(0.2)
    assert first_met((criterion,), ZERO, ZERO, np.full(3, 0.2)) is criterion


def test_limit_that_fails_by_most_is_named() -> None:
    depth, tip = depth_criterion(0.2), tip_land_criterion(3.0, lambda x, y: 2.5)
    assert first_met((depth, tip), ZERO, ZERO, np.full(3, 0.3)) is tip
    assert first_met((depth, tip), ZERO, ZERO, np.full(3, 0.9)) is depth
