"""Shipped cases cycle by cycle and in long steps: the source's (10) to (13) as they stand are the reference.

Wear coefficients of teeth and joints are raised by one factor, so that the sprocket lives 10 000 cycles.
Some flanks need more of them: a step of the loop that wears more than a small part of the spacing of the
points squared is refused.
"""

from pathlib import Path

import pytest

import wearsim
from wearsim.runner.scatter import coefficient_key

pytestmark = pytest.mark.slow

CASES = sorted((Path(__file__).parents[2] / "cases").glob("*.toml"))

HALF_SPACE = 0.025
"""What a life of a wrap moves by, relative, as the loop presses its rollers on a half-space and the steps
press them on an elastic foundation: 2.2 % at most, on a40-19t-rating, where loops of 2500 to 20 000 cycles
agree to 0.3 %."""

CYCLES = 1e4
MORE_CYCLES = dict.fromkeys(
    (
        "08b-57t-oiled",
        "beet-harvester-18t-soil",
        "conveyor-27t-greased",
        "d6-crawler-27t-soil",
        "hertz-arc-prescribed",
    ),
    1e5,
)


def raised(case: wearsim.Case, method: str, factor: float) -> wearsim.Case:
    """Return a case whose parts all wear so many times as fast."""
    rates = {coefficient_key(case): case.wear.coefficient, **case.drive.wear_coefficients}
    tables = {name: dict(table) if isinstance(table, dict) else table for name, table in case.inputs.items()}
    tables.setdefault("wear", {}).pop("condition", None)
    for key, rate in rates.items():
        table, name = key.split(".")
        tables.setdefault(table, {})[name] = factor * rate
    if "lubrication" in tables:
        # As many applications of the lubricant in a life that is shorter.
        tables["service"]["km_per_hour"] *= factor
    tables["run"] = {**tables.get("run", {}), "method": method}
    tables["run"].pop("cycles_per_update", None)
    return wearsim.load_case(tables)


@pytest.mark.parametrize("path", CASES, ids=[path.stem for path in CASES])
def test_both_methods_agree_within_the_stated_error(path, monkeypatch):
    monkeypatch.chdir(path.parent)
    case, cycles = wearsim.load_case(path).with_horizon(1e7), MORE_CYCLES.get(path.stem, CYCLES)
    first = wearsim.simulate(case)
    sprocket = first.parts.get("sprocket", first.life)
    factor = sprocket.cycles_run / cycles
    stepped, loop = (wearsim.simulate(raised(case, method, factor)) for method in ("advance", "per_cycle"))
    # One for each cycle with a fresh lubricant: the clock of one that ages runs faster.
    assert loop.updates >= 0.9 * cycles
    assert loop.stop == stepped.stop
    allowed = stepped.numerical_error + (HALF_SPACE if case.drive.rests else 0.0)
    # Half a cycle is what the loop can tell.
    assert stepped.cycles_run == pytest.approx(loop.cycles_run, rel=allowed, abs=0.5)
