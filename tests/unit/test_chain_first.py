"""Comparing tooth forms says where the chain ends first, with what compares them."""

from types import SimpleNamespace

import pandas as pd
import pytest

from wearsim.report.chain_first import chain_first_of
from wearsim.result import Life
from wearsim.study.sweep.sheet import sweep_caution

CHAIN, TOOTH = "elongation_percent", "critical_depth_mm"


def result(name, profile, stop, hours):
    """What the warning reads of a result."""
    life = Life(cycles=60.0 * hours, hours=hours)
    return SimpleNamespace(
        case=name, inputs={"sprocket": {"profile": profile}}, stop=stop, parts={"sprocket": life}
    )


@pytest.mark.parametrize(
    ("second", "stops", "says"),
    [
        ("iso606", (CHAIN, CHAIN), "the chain ends first in 2 of 2 cases"),
        ("iso606", (TOOTH, CHAIN), "the chain ends first in 1 of 2 cases"),
        ("iso606", (TOOTH, TOOTH), ""),
        ("ansi_b29", (CHAIN, CHAIN), ""),
    ],
)
def test_warning_where_forms_differ_and_the_chain_ends(second, stops, says):
    text = chain_first_of([result("a", "ansi_b29", stops[0], 200), result("b", second, stops[1], 300)])
    assert text.startswith(says)
    assert bool(text) == bool(says)
    if says:
        assert text.endswith("; the sprockets last 200 h (a), 300 h (b)")


@pytest.mark.parametrize(
    ("keys", "parts", "says"),
    [
        (("sprocket.profile",), (), "the chain ends first in 1 of 2 cases"),
        (("sprocket.teeth", "sprocket.form"), (), "the chain ends first in 1 of 2 cases"),
        (("sprocket.teeth",), (), ""),
        (("sprocket.1.profile",), ("chain", "motor"), ""),  # the table has the lives of all parts
    ],
)
def test_sweep_over_forms_warns(keys, parts, says):
    sweep = SimpleNamespace(design=SimpleNamespace(keys=keys, parts=parts))
    table = pd.DataFrame({"stop": [CHAIN, TOOTH, None], "error": ["", "", "does not fit"]})
    text = sweep_caution(sweep, table)
    assert text.startswith(says)
    assert bool(text) == bool(says)
