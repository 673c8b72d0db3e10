"""Every number that wearsim gives for what it ships is what it was: ``net.py`` renews the file.

These numbers are wearsim's own. They show that nothing moved, not that anything is right.
"""

import importlib.util
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.wide


def module(name):
    """Return a file of this folder as a module, so that processes may find it by its name."""
    found = importlib.util.spec_from_file_location(name, Path(__file__).with_name(f"{name}.py"))
    loaded = importlib.util.module_from_spec(found)
    sys.modules[name] = loaded
    found.loader.exec_module(loaded)
    return loaded


net = module("net")
MADE_ON, ROWS = net.read()
LONG = {f"{word} {name}" for name in net.WRAPS for word in ("life", "maintain")}
NAMES = [pytest.param(name, marks=[pytest.mark.slow] * (name in LONG)) for name in net.runs()]


def test_every_run_is_held():
    assert {row.run for row in ROWS} == set(net.runs())


@pytest.mark.parametrize("name", NAMES)
def test_numbers_are_what_they_were(name):
    expected = {(row.table, row.column): row for row in ROWS if row.run == name}
    found = {(row.table, row.column): row for row in net.rows_of(name)}
    assert found.keys() == expected.keys()
    if net.machine() == MADE_ON:
        assert found == expected
    for key, row in found.items():
        if name in LONG and row.column not in net.LIVES:
            continue
        assert row.count == expected[key].count
        part = net.STEP_DIGITS.get(name, net.FEW_DIGITS.get(row.column, net.LAST_DIGITS))
        part = net.WRAP_DIGITS if name in LONG else part
        allowed = part * expected[key].size + net.ROUNDING
        assert abs(row.size - expected[key].size) <= allowed, key
        assert abs(row.sum - expected[key].sum) <= allowed, key


@pytest.mark.parametrize("text", ["a,b\n1.5,x\n2.5,y\n", "a,b\n1.5,x\n2.5,nan\n"])
def test_last_bit_of_a_number_shows(text):
    before = net.columns("t.csv", text)
    moved = net.columns("t.csv", text.replace("2.5", "2.5000000000000004"))
    assert net.bits(before["a"]) != net.bits(moved["a"])
    assert before.get("b") == moved.get("b") or net.bits(before["b"]) == net.bits(moved["b"])
