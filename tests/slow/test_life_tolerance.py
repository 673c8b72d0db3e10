"""``life_tolerance`` is met on random feasible cases.

Expected: the same case with a tenth of the tolerance, on the same points and on four times as
many (twice where that would be more than 801).
"""

from collections.abc import Callable
from types import ModuleType
from typing import Any

import pytest

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def lives(research: Callable[[str], ModuleType]) -> ModuleType:
    """Return research/random_lives.py as a module."""
    return research("random_lives")


@pytest.fixture(scope="module")
def cases(lives: ModuleType) -> list[Any]:
    """Return all cases, measured."""
    found, _ = lives.measured(range(lives.CASES))
    return found


def told(case: Any) -> str:
    return (
        f"{case.name}: {case.draw.what}, {case.draw.points} points: t {case.draw.tolerance:g}, "
        f"steps {case.steps:.3g}, all {case.total:.3g}, stated {case.stated:.3g}"
    )


def test_there_are_cases_of_every_kind(lives: ModuleType, cases: list[Any]) -> None:
    assert len(cases) == lives.CASES == 200
    for kind in ("evolute", "points", "table"):
        assert sum(case.draw.kind == kind for case in cases) >= 20
    assert len({case.stop for case in cases}) == 5


def test_python_has_nothing_to_complain_of(cases: list[Any]) -> None:
    wrong = [f"{told(case)}: {case.complaints}" for case in cases if case.complaints]
    assert not wrong, "\n".join(wrong)


def test_steps_keep_to_a_tenth_of_the_tolerance(lives: ModuleType, cases: list[Any]) -> None:
    rounding = lives.ROUNDING
    wrong = [told(case) for case in cases if case.steps > 0.1 * case.draw.tolerance + rounding]
    assert not wrong, "\n".join(wrong)


def test_error_of_the_steps_is_not_above_the_one_stated(lives: ModuleType, cases: list[Any]) -> None:
    wrong = [told(case) for case in cases if case.steps > case.stated + lives.ROUNDING]
    assert not wrong, "\n".join(wrong)


def test_a_stated_error_above_the_tolerance_is_a_warning(cases: list[Any]) -> None:
    wrong = [told(case) for case in cases if case.warned != (case.stated > case.draw.tolerance)]
    assert not wrong, "\n".join(wrong)


def test_life_meets_its_tolerance_or_warns(lives: ModuleType, cases: list[Any]) -> None:
    silent = [case for case in cases if not case.warned]
    wrong = [told(case) for case in silent if case.total > case.draw.tolerance + lives.ROUNDING]
    assert not wrong, "\n".join(wrong)


def test_error_of_a_life_is_not_above_the_one_stated(cases: list[Any]) -> None:
    wrong = [told(case) for case in cases if case.total > case.allowed]
    assert not wrong, "\n".join(wrong)
