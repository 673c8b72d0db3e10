"""docs/validation.md names the tests that hold its rows, and its numbers are printed as it says."""

import ast
import re
import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "validation.md").read_text(encoding="utf-8")
WRITER = runpy.run_path(str(ROOT / "docs" / "validation_page.py"))


def uses(tree, before=""):
    """Names of the tests that ask for the fixture, as pytest writes them."""
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            yield from uses(node, f"{before}{node.name}::")
        elif isinstance(node, ast.FunctionDef) and node.name.startswith("test_"):
            yield from [before + node.name for a in node.args.args if a.arg == "validated"]


def test_page_has_every_test_with_the_fixture_and_no_other():
    files = sorted((ROOT / "tests" / "verification").glob("test_*.py"))
    trees = {file.name: ast.parse(file.read_text(encoding="utf-8")) for file in files}
    expected = {f"{name}::{test}" for name, tree in trees.items() for test in uses(tree)}
    assert set(re.findall(r"\[(test_\w+\.py::[\w:]+)\]", PAGE)) == expected
    sections = {f"{stem}.py" for stems in WRITER["SECTIONS"].values() for stem in stems}
    assert sections == {name.split("::")[0] for name in expected}


@pytest.mark.parametrize(
    ("value", "digits", "printed"),
    [
        (453.938082, 6, "453.938"),
        (26_102_090.0, 6, "2.61021e7"),
        (7.93e-8, 6, "7.93e-8"),
        (0.0, 6, "0"),
        (14_603.7, 4, "14600"),
    ],
)
def test_numbers(value, digits, printed):
    assert WRITER["number"](value, digits) == printed


@pytest.mark.parametrize(("tolerance", "digits"), [(0.29, 3), (0.05, 4), (5e-3, 5), (1e-4, 6), (1e-14, 6)])
def test_digits_show_a_hundredth_of_the_tolerance(tolerance, digits):
    assert WRITER["digits_for"](tolerance) == digits


ROW = {"quantity": "life", "value": 1001.0, "expected": 1000.0, "unit": "h", "source": "by hand"}


@pytest.mark.parametrize(
    ("changes", "difference", "tolerance"),
    [
        ({}, "< 0.001", "0.01"),
        ({"value": 1000.0}, "< 1e-5", "0.01"),
        ({"value": 1000.0, "allowed": 1e-5}, "< 1e-9", "1e-8"),
        ({"value": 1003.0}, "< 0.01", "0.01"),
        ({"value": 1003.0, "allowed": 5.0}, "< 0.005", "0.005"),
        ({"value": 1e-6, "expected": 0.0, "allowed": 1e-3}, "< 1e-6 h", "0.001 h"),
    ],
)
def test_difference_is_a_decade_within_the_tolerance(changes, difference, tolerance):
    row = {**ROW, "allowed": 10.0, "count": 1, **changes}
    cells = WRITER["cells"]("tests/verification/test_x.py::test_y[a::b]", row)
    assert cells[3:5] == [difference, tolerance]
    assert cells[-1] == "[test_x.py::test_y](../tests/verification/test_x.py)"


def test_a_file_without_a_section_is_named():
    row = {**ROW, "allowed": 10.0, "count": 3}
    with pytest.raises(LookupError, match="section of test_new"):
        WRITER["page"]([("tests/verification/test_new.py::test_it", 3, row)])
