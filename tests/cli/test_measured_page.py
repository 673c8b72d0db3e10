"""docs/measured.md names the tests that hold its rows, and says of each what was allowed."""

import ast
import re
import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "measured.md").read_text(encoding="utf-8")
WRITER = runpy.run_path(str(ROOT / "docs" / "measured_page.py"))
FILES = sorted((ROOT / "tests" / "validation").glob("test_*.py"))


def test_page_has_every_test_with_the_fixture_and_no_other():
    expected = {
        f"{file.name}::{node.name}"
        for file in FILES
        for node in ast.parse(file.read_text(encoding="utf-8")).body
        if isinstance(node, ast.FunctionDef)
        and node.name.startswith("test_")
        and "measured" in [argument.arg for argument in node.args.args]
    }
    links = re.findall(r"\[(test_\w+)\]\(\.\./tests/validation/(test_\w+\.py)\)", PAGE)
    assert {f"{file}::{name}" for name, file in links} == expected
    assert sorted(WRITER["SECTIONS"]) == [file.stem for file in FILES]


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_every_set_says_what_it_cannot_show(file):
    heading, text = WRITER["section"](file.stem)
    assert f"## {heading}\n\n{text}\n\n| quantity |" in PAGE
    assert "Not shown:" in text


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_a_set_with_failures_says_so(file):
    heading, text = WRITER["section"](file.stem)
    passed, failed = re.search(rf"^\| {re.escape(heading)} \| (\d+) \| (\d+) \|$", PAGE, re.M).groups()
    rows = PAGE.partition(f"## {heading}\n")[2].partition("\n## ")[0]
    assert (rows.count("| passed |"), rows.count("| **failed** |")) == (int(passed), int(failed))
    assert ("Failures:" in text) == (int(failed) > 0)


def test_every_table_of_data_says_where_it_comes_from():
    tables = sorted((ROOT / "tests" / "validation" / "data").glob("*.csv"))
    assert tables
    for table in tables:
        comments = [line for line in table.read_text(encoding="utf-8").splitlines() if line.startswith("#")]
        assert any(line.startswith("# From: ") for line in comments), table.name
        assert any("carried over" in line or "licence MIT" in line for line in comments), table.name


ROW = {
    "quantity": "reading",
    "predicted": 133.2938,
    "reading": 133.5,
    "unit": "mm",
    "scatter": "sd 0.1 mm",
    "kind": "within",
    "size": 0.15,
    "verdict": "failed",
    "digits": 5,
}


@pytest.mark.parametrize(
    ("changes", "allowed"),
    [
        ({}, "+-0.15 mm"),
        ({"kind": "percent", "size": 15}, "15 %"),
        ({"kind": "factor", "size": 2}, "factor 2"),
        ({"kind": "range", "size": (1, 2.5)}, "1 to 2.5 mm"),
        ({"kind": "found", "size": (10, 12), "unit": ""}, "10 to 12"),
        ({"kind": "below", "size": 0.1}, "below 0.1 mm"),
    ],
)
def test_what_was_allowed(changes, allowed):
    cells = WRITER["cells"]("tests/validation/test_x.py::test_y[a::b]", {**ROW, **changes})
    assert cells[4] == allowed
    assert cells[-1] == "[test_y](../tests/validation/test_x.py)"


def test_a_row_as_it_is_printed():
    cells = WRITER["cells"]("tests/validation/test_x.py::test_y", ROW)
    assert cells[:4] == ["reading", "133.29 mm", "133.5 mm", "sd 0.1 mm"]
    assert cells[5] == "**failed**"
    worded = WRITER["cells"]("tests/validation/test_x.py::test_y", {**ROW, "reading": "a knee"})
    assert worded[2] == "a knee"


def test_a_file_without_a_section_is_named():
    with pytest.raises(LookupError, match="section of test_new"):
        WRITER["page"]([("tests/validation/test_new.py::test_it", 3, ROW)])
