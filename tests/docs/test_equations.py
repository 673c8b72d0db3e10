"""Every equation that a docstring cites exists, and every numbered equation is accounted for."""

import importlib.util
from collections import Counter
from pathlib import Path

import pytest

import wearsim

DOCS = Path(__file__).parents[2] / "docs"
_spec = importlib.util.spec_from_file_location("citations", DOCS / "_ext" / "citations.py")
citations = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(citations)
Equation = citations.Equation

EQUATIONS = citations.equations(DOCS)
CITED = citations.citations(Path(wearsim.__file__).parent)
TABLE = (DOCS / "equations.md").read_text("utf-8").split("\n## Computed\n")[0]
ROWS = [row for row in TABLE.splitlines() if row.startswith("| ") and ".md (" in row]
DERIVED = [equation for row in ROWS for equation in citations.cited(row.split("|")[1])]


def test_numbers_are_unique_on_their_page():
    assert [e for e, count in Counter(EQUATIONS).items() if count > 1] == []


def test_every_display_equation_of_the_theory_has_a_number():
    for page in {equation.page for equation in EQUATIONS}:
        shown = (DOCS / f"{page}.md").read_text("utf-8").split("$$")[1::2]
        assert [formula for formula in shown if r"\tag{" not in formula] == [], page


def test_cited_equations_exist():
    missing = {e: names for e, names in CITED.items() if e not in EQUATIONS}
    assert missing == {}


def test_equations_are_cited_or_listed_as_derivations():
    assert sorted(set(EQUATIONS) - set(CITED)) == sorted(DERIVED)


def test_derivations_name_a_test_that_exists():
    for row in ROWS:
        name = row.rsplit("`", 2)[1]
        assert (DOCS.parent / name).exists(), name


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("physics.md (10) to (12), in place", ["10", "11", "12"]),
        ("Equations physics.md (S8) to (S11).", ["S8", "S9", "S10", "S11"]),
        ("physics.md (S7), with (S3) and (S4).", ["S7", "S3", "S4"]),
        ("equation\n    physics.md (W3). Teeth (rigid)", ["W3"]),
        ("physics.md 4, source 001 (22)", []),
    ],
)
def test_citations_are_read(text, expected):
    assert [equation.number for equation in citations.cited(text)] == expected
