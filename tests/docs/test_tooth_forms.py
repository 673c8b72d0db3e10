"""The page of tooth forms has the figures of the comparison that research/tooth_forms.py wrote."""

import re
import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "tooth_forms.md").read_text("utf-8")
REPORT = (ROOT / "reports" / "reference" / "tooth_forms.md").read_text("utf-8")
DRAWING = runpy.run_path(str(ROOT / "docs" / "form_drawings.py"))
FORMS = ("ISO 606 min", "ISO 606 max", "evolute", "GOST 591")
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")


def runs():
    """Cells of every run that the report has, by drive and form."""
    found = {}
    for section in REPORT.split("\n### Drive ")[1:]:
        for line in section.split("\n## ")[0].splitlines():
            form, *cells = [cell.strip() for cell in line.strip("|").split("|")]
            if form in (*FORMS, "ANSI B29.1") and not cells[0].startswith("case:"):
                found[section[0], form] = cells
    return found


RUNS = runs()
HOURS = {key: float(cells[0].replace(" ", "")) for key, cells in RUNS.items()}


def percent(drive, form):
    """Life over that of ANSI B29.1, as the page writes it."""
    hours = HOURS.get((drive, form))
    return "-" if hours is None else f"{100.0 * hours / HOURS[drive, 'ANSI B29.1']:.0f}"


@pytest.mark.parametrize("drive", "ABCDEFG")
def test_row_of_a_drive(drive):
    (row,) = re.findall(rf"^\| {drive}: .*? \| (.*) \|$", PAGE, re.M)
    assert row.split(" | ")[:-1] == [percent(drive, form) for form in FORMS]
    assert row.split(" | ")[-1] == RUNS[drive, "ANSI B29.1"][0]


def test_ranges_of_the_first_lines():
    iso = [int(percent(drive, form)) for drive, form in RUNS if form.startswith("ISO")]
    evolute = [int(percent(drive, form)) for drive, form in RUNS if form == "evolute"]
    said = (
        f"reach {min(iso)} to {max(iso)} % of that life, the evolute flank {min(evolute)} to {max(evolute)} %"
    )
    assert said in " ".join(PAGE.split())


def test_how_often_the_chain_ends_first():
    first = sum(cells[2] == "elongation_percent" for cells in RUNS.values())
    assert f"In {first} of the {len(RUNS)} runs above the chain" in " ".join(PAGE.split())


def test_errors_are_below_what_is_stated():
    assert max(float(cells[-1].removesuffix(" %")) for cells in RUNS.values()) < 5.0


def test_drawing_has_the_angles_of_the_report():
    """Drive E: the angle and the part of the pull under a new chain."""
    drawing = (ROOT / "docs" / "tooth_forms.svg").read_text("utf-8")
    texts = re.findall(r"<text[^>]*>(.*?)</text>", drawing)
    for name, said in zip(texts[::2], texts[1::2], strict=True):
        force, angle = (RUNS["E", name][column].split(" / ")[0] for column in (4, 5))
        assert said == f"{float(angle):.0f}°, {force} of the pull"
    assert len(texts) == 10


def test_drawing_is_what_the_script_draws():
    kept = (ROOT / "docs" / "tooth_forms.svg").read_text("utf-8")
    fresh = DRAWING["SVG"](DRAWING["scene"]())
    assert NUMBER.sub("n", kept) == NUMBER.sub("n", fresh)
    numbers = [[float(value) for value in NUMBER.findall(text)] for text in (kept, fresh)]
    assert numbers[0] == pytest.approx(numbers[1], abs=0.011)


def test_first_line_of_the_readme_leads_to_the_page():
    first = (ROOT / "README.md").read_text("utf-8").split("\n\n")[1].splitlines()[0]
    assert "](docs/tooth_forms.md)" in first
