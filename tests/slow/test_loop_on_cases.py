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
    tables["wear"].pop("condition", None)
    for key, rate in rates.items():
        table, name = key.split(".")
        tables.setdefault(table, {})[name] = factor * rate
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
    assert loop.updates == pytest.approx(cycles, rel=0.1)
    assert loop.stop == stepped.stop
    # Half a cycle is what the loop can tell.
    assert stepped.cycles_run == pytest.approx(loop.cycles_run, rel=stepped.numerical_error, abs=0.5)
