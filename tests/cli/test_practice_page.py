"""docs/practice.md holds every drive and rule, and the ratio of engine and rules that it sums up."""

import csv
import re
import runpy
from pathlib import Path

import pytest

from wearsim.chain.practice_rules import RULES

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "practice.md").read_text(encoding="utf-8")
WRITER = runpy.run_path(str(ROOT / "docs" / "practice_page.py"))
HOURS = {"rating rule": 9213.0, "Vorobyev 5200": None}
ROW = {"no": 1, "drive": "conveyor", "chain": "12B-1", "teeth": 21, "mate_teeth": 57, "speed_rpm": 120.0}
ROW |= {"speed_m_per_s": 0.8001, "pressure_MPa": 41.99, "hours": HOURS, "mean": 7020.0, "engine": 140_400.0}


def test_page_has_every_drive_and_rule():
    lines = (ROOT / "tests" / "practice" / "drives.csv").read_text(encoding="utf-8").splitlines()
    drives = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    shown = re.findall(r"^\| (\d+) \| (.+?) \| (.+?) \|", PAGE, re.M)
    assert shown == [(row["no"], row["drive"], row["chain"]) for row in drives]
    for rule in RULES:
        assert f"| {rule.name} | {rule.formula} | {rule.valid} | {rule.source} | {rule.trust} |" in PAGE


def test_text_is_that_of_the_head():
    head = (ROOT / "docs" / "practice_head.md").read_text(encoding="utf-8")
    for paragraph in head.split("\n\n"):
        assert paragraph in PAGE or paragraph in (
            "RULES",
            "DRIVES",
            "SUMMARY",
            "COVERAGE",
            "LIMITS",
            "FACTORS",
        )


def test_summary_counts_the_rows():
    ratios = sorted(float(one) for one in re.findall(r"^\| \d+ \| .* \| ([\d.]+) \|$", PAGE, re.M))
    least, most, middle = re.search(r"mean: ([\d.]+) to ([\d.]+), median ([\d.]+),", PAGE).groups()
    assert [float(least), float(most), float(middle)] == [ratios[0], ratios[-1], ratios[13]]


def test_a_row_as_it_is_printed():
    cells = WRITER["cells"](ROW)
    assert cells == [
        "1",
        "conveyor",
        "12B-1",
        "21/57",
        "120",
        "0.80",
        "42.0",
        "9.2",
        "",
        "7.0",
        "140",
        "20.0",
    ]


def test_summary_of_one_drive():
    text = WRITER["summary"]([ROW])
    assert "20.0 to 20.0, median 20.0, and within a factor of 2.5 on 0 of 1 drives" in text
    assert f"a factor of {9213 / 7020:.1f}" in text


@pytest.mark.parametrize(
    ("hours", "text"), [(None, ""), (9949.0, "9.9"), (99_940.0, "99.9"), (99_960.0, "100")]
)
def test_hours_in_thousands(hours, text):
    assert WRITER["thousands"](hours) == text
