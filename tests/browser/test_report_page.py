"""The pages of ``wearsim report`` in a real browser."""

import re
import time

import pytest

from wearsim.report.flank_view import snapshot

from .conftest import HOSTILE

pytestmark = [
    pytest.mark.slow,
    # Of pytest-playwright's own fixture under pytest 9.
    pytest.mark.filterwarnings("ignore:Session-scoped fixtures defined as instance methods"),
]

KINDS = ("strand", "wrap", "gears", "all")
TRACE = "([id, index]) => { const t = document.getElementById(id).data[index]; return [t.x, t.y]; }"


def shown(page, report, file="index.html"):
    page.goto((report / file).as_uri())
    page.wait_for_selector(".js-plotly-plot .main-svg")
    return page


def eventually(page, expression, right):
    """The page's own policy forbids playwright's wait_for_function, which evaluates text in it."""
    end = time.monotonic() + 10.0
    while not right(found := page.evaluate(expression)):
        assert time.monotonic() < end, (expression, found)
        page.wait_for_timeout(50)


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [360, 1440])
@pytest.mark.parametrize("kind", KINDS)
def test_a_page_says_nothing_asks_for_nothing_and_fits(watched, reports, kind, width, scheme):
    watched.set_viewport_size({"width": width, "height": 900})
    watched.emulate_media(color_scheme=scheme)
    shown(watched, reports / kind)
    watched.wait_for_timeout(200)
    beside = {(reports / kind / file).as_uri() for file in ("index.html", "plotly.min.js")}
    assert {url for url in watched.requested if not url.startswith("data:")} == beside
    assert watched.said == []
    assert watched.evaluate("document.documentElement.scrollWidth") <= width
    charts = watched.locator("[data-chart]")
    assert charts.count() == watched.locator(".js-plotly-plot .main-svg:first-child").count()
    for place in charts.all():
        box = place.bounding_box()
        assert box["x"] >= 0.0 and box["x"] + box["width"] <= width


@pytest.mark.parametrize("kind", KINDS[:3])
def test_a_single_file_needs_nothing_beside_it(watched, reports, kind, tmp_path):
    alone = tmp_path / "moved.html"
    alone.write_bytes((reports / f"{kind}_alone" / "index.html").read_bytes())
    shown(watched, tmp_path, alone.name)
    assert [url for url in watched.requested if not url.startswith("data:")] == [alone.as_uri()]
    assert watched.said == []


def test_a_title_stays_text(watched, reports):
    shown(watched, reports / "strand")
    assert watched.locator("h1").inner_text() == HOSTILE
    assert watched.title().startswith(HOSTILE)
    shown(watched, reports / "all")
    assert HOSTILE in watched.locator("tbody th").first.inner_text()


def test_an_injected_script_does_not_run(watched, reports):
    shown(watched, reports / "strand")
    watched.evaluate(
        "() => { const s = document.createElement('script'); s.textContent = 'window.taken = 1';"
        " document.body.append(s); }"
    )
    assert watched.evaluate("window.taken") is None
    assert any("Content Security Policy" in text for text in watched.said)


@pytest.mark.parametrize("key", [None, "Enter", " "])
def test_the_legend_hides_and_shows_by_mouse_and_keyboard(watched, reports, key):
    shown(watched, reports / "wrap")
    toggle = watched.locator("#loads .legendtoggle").first
    visible = "document.getElementById('loads').data[0].visible"
    for shows in (False, True):
        if key:
            toggle.focus()
            watched.keyboard.press(key)
        else:
            toggle.click()
        eventually(watched, visible, lambda found, shows=shows: (found is True) == shows)
        watched.wait_for_timeout(400)  # else two clicks are a double click
    assert toggle.get_attribute("aria-checked") == "true"
    assert toggle.get_attribute("aria-label") == "show new chain"


@pytest.mark.parametrize(("kind", "name"), [("strand", "tooth"), ("wrap", "tooth"), ("gears", "wheel")])
def test_the_slider_moves_the_worn_flank(watched, reports, results, kind, name):
    """The worn flank of the run at factor 1, twice as far from the new one at factor 2."""
    shown(watched, reports / kind)
    worn = snapshot(results[KINDS.index(kind)], -1)
    axis = "wheel_x_mm" if name == "wheel" else "x_mm"
    first = watched.evaluate("id => document.getElementById(id).data.findIndex(t => t.name === 'new')", name)
    new = watched.evaluate(TRACE, [name, first])[0]
    found = {}
    for factor in (1, 2):
        watched.locator(f"#{name}-slider").fill(str(factor))
        found[factor] = watched.evaluate(TRACE, [name, first + 1])[0]
        assert watched.locator(f"#{name}-factor").inner_text() == f"× {factor}"
    assert found[1] == pytest.approx(worn[axis].tolist(), rel=6e-5)
    twice = [2.0 * one - start for one, start in zip(found[1], new, strict=True)]
    assert found[2] == pytest.approx(twice, abs=1e-9)
    assert found[2] != pytest.approx(found[1], abs=1e-4)


def test_the_slider_is_reached_by_the_keyboard(watched, reports):
    shown(watched, reports / "strand")
    slider = watched.locator("#tooth-slider")
    before = int(slider.input_value())
    slider.focus()
    watched.keyboard.press("ArrowRight")
    assert watched.locator("#tooth-factor").inner_text() == f"× {before + 1}"


def test_colours_follow_the_scheme_and_keep_the_slider(watched, reports):
    shown(watched, reports / "strand")
    watched.locator("#tooth-slider").fill("7")
    worn = "document.getElementById('tooth').data.find(t => t.name === 'worn')"
    light, x = watched.evaluate(f"[{worn}.line.color, {worn}.x[3]]")
    watched.emulate_media(color_scheme="dark")
    eventually(watched, f"{worn}.line.color", lambda found: found != light)
    assert watched.evaluate(f"{worn}.x[3]") == x


def test_print_shows_still_pictures(watched, reports):
    shown(watched, reports / "wrap")
    assert not watched.locator("img.still").first.is_visible()
    pdf = watched.pdf(format="A4")
    assert pdf.startswith(b"%PDF") and len(pdf) > 20_000
    watched.emulate_media(media="print")
    assert watched.locator("img.still").first.is_visible()
    assert not watched.locator("[data-chart]").first.is_visible()
    width = "img => [img.complete, img.naturalWidth]"
    assert all(img.evaluate(width)[1] > 0 for img in watched.locator("img.still").all())


@pytest.mark.parametrize(("drive", "sheets"), [("strand", 5), ("wrap", 8)])
def test_a_printed_page_wastes_no_sheets(watched, reports, drive, sheets):
    """On A4 as the page itself asks for it; before, pictures that fill a sheet left others half empty."""
    shown(watched, reports / drive)
    pdf = watched.pdf(prefer_css_page_size=True)
    assert len(re.findall(rb"/Type\s*/Page\b", pdf)) <= sheets
    (width, height) = re.search(rb"/MediaBox\s*\[0 0 ([\d.]+) ([\d.]+)\]", pdf).groups()
    assert [float(width), float(height)] == pytest.approx([595.3, 841.9], abs=1.0)


def test_without_scripts_the_still_pictures_stand(new_context, reports):
    page = new_context(java_script_enabled=False).new_page()
    page.goto((reports / "gears" / "index.html").as_uri())
    assert page.locator("img.still").first.is_visible()
    assert not page.locator(".slider").first.is_visible()
    assert page.locator("h1").inner_text() == "Gears, with run.horizon_hours = 50000"


def test_the_comparison_leads_to_every_page_and_back(watched, reports):
    shown(watched, reports / "all")
    links = watched.locator("tbody a")
    assert links.count() == 3
    for row in range(3):
        links.nth(row).click()
        watched.wait_for_selector(".js-plotly-plot")
        watched.get_by_role("link", name="All drives").click()
        watched.wait_for_selector("#lives .main-svg")
    assert watched.said == []


def test_the_skip_link_comes_first(watched, reports):
    shown(watched, reports / "strand")
    watched.keyboard.press("Tab")
    assert watched.evaluate("document.activeElement.textContent") == "Skip to the answer"
    watched.keyboard.press("Enter")
    assert watched.evaluate("document.activeElement.id") == "answer"


def test_every_picture_has_words(watched, reports):
    for kind in KINDS:
        shown(watched, reports / kind)
        for image in watched.locator("img, svg.sketch").all():
            assert len(image.get_attribute("alt") or image.get_attribute("aria-label")) > 20
        for chart in watched.locator("[data-chart]").all():
            words = watched.locator(f"#{chart.get_attribute('aria-describedby')}")
            assert len(words.text_content()) > 20
        assert watched.locator("thead th:not([scope=col]), tbody th:not([scope=row])").count() == 0
    assert watched.locator("html").get_attribute("lang") == "en"
