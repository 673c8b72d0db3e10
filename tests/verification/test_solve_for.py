"""The value of a key for a required life, where the life follows it in closed form.

On a strand with m = 1 the life goes with 1/(k F): equation I = K q |v_s|/v_t of the physics.
"""

import functools
from typing import Any

import pytest

import wearsim
from wearsim.errors import CaseError
from wearsim.runner.solve_for import Solved, solve_for

STRAND: dict[str, Any] = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "sprocket": {"teeth": 20, "profile": "evolute", "evolute_offset_mm": 5.6, "nodes": 51},
    "load": {"tension_N": 5000, "speed_rpm": 100},
    "wear": {"specific_wear_rate_mm2_per_N": 5e-11},
    "stop": {"critical_depth_mm": 0.02},
}


def solved(key: str, start: float, hours: float, *settings: str, whole: bool = False) -> Solved:
    def at(value: float) -> wearsim.Case:
        number = int(value) if whole else value
        return wearsim.load_case(STRAND, [*settings, f"{key}={number!r}"])

    return solve_for(at, start, hours, whole)


@functools.cache
def life(*settings: str) -> float:
    return wearsim.simulate(wearsim.load_case(STRAND, settings)).life.hours


@pytest.mark.wide
@pytest.mark.parametrize(
    ("key", "start", "factor"),
    [
        ("wear.specific_wear_rate_mm2_per_N", 5e-11, 0.03),
        ("wear.specific_wear_rate_mm2_per_N", 5e-11, 12.0),
        ("load.tension_N", 5000.0, 0.4),
        ("load.tension_N", 5000.0, 1.0),
        ("load.tension_N", 5000.0, 30.0),
    ],
)
def test_value_follows_the_closed_form(key: str, start: float, factor: float) -> None:
    hours = factor * life()
    found = solved(key, start, hours)
    assert found.met
    assert found.trial.value == pytest.approx(start / factor, rel=1e-3)
    assert found.trial.hours == pytest.approx(hours, rel=1e-3)
    assert found.elasticity == pytest.approx(-1.0, rel=2e-3)


def test_rising_life() -> None:
    """Life goes with the width of the tooth."""
    found = solved("sprocket.face_width_mm", 10.0, 1.5 * life("sprocket.face_width_mm=10"))
    assert found.trial.value == pytest.approx(15.0, rel=1e-3)
    assert found.elasticity == pytest.approx(1.0, rel=2e-3)


@pytest.mark.wide
def test_whole_number_is_the_next_that_lives_as_long() -> None:
    hours = 1.4 * life()
    found = solved("sprocket.teeth", 20, hours, whole=True)
    teeth = found.trial.value
    assert found.met and teeth == int(teeth)
    assert life(f"sprocket.teeth={int(teeth)}") >= hours > life(f"sprocket.teeth={int(teeth) - 1}")


@pytest.mark.slow
def test_value_beyond_the_allowed_range_is_not_met() -> None:
    """The face width ends at the inner plates, 17.02 mm, and the pull at 60 kN."""
    wide = solved("sprocket.face_width_mm", 10.0, 3.0 * life("sprocket.face_width_mm=10"))
    assert not wide.met
    assert wide.high == wide.trial.value == pytest.approx(17.02, rel=1e-3)
    heavy = solved("load.tension_N", 5000.0, life() / 100.0)
    assert not heavy.met
    assert heavy.trial.value == pytest.approx(60_000.0, rel=1e-3)


def test_start_that_is_refused_says_why() -> None:
    with pytest.raises(CaseError, match="tensile strength"):
        solved("load.tension_N", 1e6, 100.0)
