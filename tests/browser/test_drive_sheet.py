"""The sheet of a whole drive in a real browser, and on paper."""

import re
from datetime import date
from pathlib import Path

import pytest

from wearsim.drive.life import drive_life
from wearsim.drive.load_case import load_drive
from wearsim.input.document import CaseText
from wearsim.report.drive.report_page import save_sheet
from wearsim.report.html.paper import SheetHead
from wearsim.report.html.pdf import save_pdf

pytestmark = [
    pytest.mark.slow,
    # Of pytest-playwright's own fixture under pytest 9.
    pytest.mark.filterwarnings("ignore:Session-scoped fixtures defined as instance methods"),
]

DRIVES = Path(__file__).parents[2] / "cases" / "drives"
KINDS = ("motorcycle-520", "bicycle-cassette")
"""Two sprockets, and a chainring with eleven cogs."""


@pytest.fixture(scope="module")
def sheets(tmp_path_factory):
    """Folder with a sheet of each drive, on coarse grids and under fast wear."""
    folder = tmp_path_factory.mktemp("sheets")
    for kind in KINDS:
        text = (DRIVES / f"{kind}.toml").read_text(encoding="utf-8")
        text = re.sub(r"nodes = \d+", "nodes = 61", text)
        text = re.sub(r'"\de-\d mm\^3/\(N\*m\)"', "1e-6", text).replace("life_tolerance = 0.1\n", "")
        text = text.replace("[run]\n", "") + "\n[run]\nlife_tolerance = 0.1\nhorizon_hours = 4\n"
        drive = load_drive(CaseText(folder / f"{kind}.toml", text))
        head = SheetHead(date(2026, 11, 24), "A project", "An author", "D-17")
        save_sheet(drive_life(drive), head, folder / f"{kind}.html", force=False)
    return folder


def shown(page, sheets, kind):
    page.goto((sheets / f"{kind}.html").as_uri())
    return page


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [390, 1440])
@pytest.mark.parametrize("kind", KINDS)
def test_a_sheet_says_nothing_asks_for_nothing_and_fits(watched, sheets, kind, width, scheme):
    watched.set_viewport_size({"width": width, "height": 900})
    watched.emulate_media(color_scheme=scheme)
    shown(watched, sheets, kind)
    here = (sheets / f"{kind}.html").as_uri()
    assert {url for url in watched.requested if not url.startswith("data:")} == {here}
    assert watched.said == []
    assert watched.evaluate("document.documentElement.scrollWidth") <= width


@pytest.mark.parametrize("kind", KINDS)
def test_a_telephone_shows_cards_with_the_verdict_first_and_nothing_cut(watched, sheets, kind):
    watched.set_viewport_size({"width": 390, "height": 900})
    shown(watched, sheets, kind)
    cards = watched.locator(".scroll:has(> .cards)").all()
    assert len(cards) > 3
    assert all(card.evaluate("one => one.scrollWidth <= one.clientWidth") for card in cards)
    verdict = watched.locator("#ratings tbody td").first
    assert verdict.get_attribute("data-label") == "verdict"
    assert verdict.bounding_box()["x"] < 30
    letters = watched.locator("#layout svg text").first
    assert letters.evaluate("one => parseFloat(getComputedStyle(one).fontSize) * one.getScreenCTM().a") >= 9


@pytest.mark.parametrize("kind", KINDS)
def test_a_sheet_prints_on_four_pages_with_nothing_cut(watched, sheets, kind):
    shown(watched, sheets, kind)
    pdf = watched.pdf(format="A4", prefer_css_page_size=True)
    assert 1 <= len(re.findall(rb"/Type\s*/Page\b", pdf)) <= 4
    # What A4 leaves beside the margins of the sheet, in CSS pixels.
    watched.set_viewport_size({"width": int((210 - 2 * 13) / 25.4 * 96), "height": 1000})
    watched.emulate_media(media="print")
    assert watched.evaluate(
        "[...document.querySelectorAll('table, .scroll, svg')]"
        ".every(one => one.scrollWidth <= one.clientWidth + 1 || one.tagName == 'svg')"
    )
    assert watched.evaluate("document.documentElement.scrollWidth <= window.innerWidth")


@pytest.mark.usefixtures("browser_type_launch_args")
def test_a_browser_prints_the_sheet_as_pdf(sheets, tmp_path):
    page = (sheets / "motorcycle-520.html").read_text(encoding="utf-8")
    out = tmp_path / "sheet.pdf"
    save_pdf(page, out, force=False)
    content = out.read_bytes()
    assert content.startswith(b"%PDF-")
    assert 1 <= len(re.findall(rb"/Type\s*/Page\b", content)) <= 4
    assert list(tmp_path.iterdir()) == [out]


@pytest.mark.parametrize("kind", KINDS)
def test_labels_of_the_layout_cover_nothing_of_each_other(watched, sheets, kind):
    shown(watched, sheets, kind)
    boxes = [text.bounding_box() for text in watched.locator("#layout svg text").all()]
    frame = watched.locator("#layout svg").bounding_box()
    for number, one in enumerate(boxes):
        assert one["x"] >= frame["x"] and one["x"] + one["width"] <= frame["x"] + frame["width"]
        for other in boxes[:number]:
            across = min(one["x"] + one["width"], other["x"] + other["width"]) - max(one["x"], other["x"])
            down = min(one["y"] + one["height"], other["y"] + other["height"]) - max(one["y"], other["y"])
            assert across <= 0.0 or down <= 0.0


def test_a_click_on_a_sprocket_leads_to_its_flank(watched, sheets):
    watched.emulate_media(reduced_motion="reduce")
    shown(watched, sheets, "motorcycle-520")
    watched.locator("#layout svg a").nth(1).click()
    assert watched.evaluate("location.hash") == "#flank-2"
    flank = watched.locator("#flank-2")
    assert flank.locator("h3").inner_text() == "rear"
    assert flank.locator("path.worn").count() == 1
    box = flank.bounding_box()
    assert 0 <= box["y"] < watched.viewport_size["height"]
