"""docs/laws.md holds a section of each test of the court, with its text."""

import runpy
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "laws.md").read_text(encoding="utf-8")
WRITER = runpy.run_path(str(ROOT / "docs" / "laws_page.py"))

LAW = {
    "law": "Archard",
    "scatter": "walk",
    "behind": 0.1,
    "behind_error": 0.25,
    "coverage_50": 0.5,
    "coverage_90": float("nan"),
    "median_error": 0.0953,
    "tied": True,
}


def test_page_has_the_text_of_every_test():
    texts = WRITER["texts"]()
    assert len(texts) == PAGE.count("\n## ")
    for heading, text in texts.values():
        assert f"\n## {heading}\n" in PAGE
        assert text in PAGE


def test_a_row_as_it_is_printed():
    assert WRITER["cells"](LAW) == ["Archard", "walk", "0.10 ± 0.25", "50 %", "", "1.10", "tied"]


def test_each_law_stands_once_with_the_better_scatter():
    other = LAW | {"scatter": "factor"}
    assert WRITER["better_scatter"]([LAW, other]) == [LAW]
