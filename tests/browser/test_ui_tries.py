"""Examples, sliders, a pinned run and undo on the page of ``wearsim ui``, and whether all can read it."""

import re

import pytest

from .ui_server import comes_to, eventually, field, forget_states, opened, settled, shown_hours, source

pytestmark = [
    pytest.mark.slow,
    # Of pytest-playwright's own fixture under pytest 9.
    pytest.mark.filterwarnings("ignore:Session-scoped fixtures defined as instance methods"),
]

STRAND = """\
format_version = 1
title = "Strand"
[chain]
designation = "16B-1"
[sprocket]
teeth = 20
profile = "evolute"
nodes = 51
[load]
tension_N = 5000
speed_rpm = 100
[wear]
condition = "hardened, oiled"
[stop]
critical_depth_mm = 0.02
"""
WRAP = """\
format_version = 1
[chain]
designation = "ANSI 40"
[sprocket]
teeth = 19
profile = "ansi_b29"
nodes = 101
[mechanism]
phases = 2
[load]
power_kW = 4.4
speed_rpm = 1000
[wear]
condition = "hardened, oiled"
[run]
horizon_hours = 100
life_tolerance = 0.1
"""


def click(page, name):
    page.get_by_role("button", name=name, exact=True).click()


def compared(page):
    return page.locator(".ws-comparison dd").all_inner_texts()


def answered(page, key, value):
    """Type a value and wait for its answer."""
    forget_states(page)
    field(page, key).fill(value)
    comes_to(page, "computing")
    settled(page)


def open_example(page, name):
    click(page, "Examples")
    page.get_by_label("Example", exact=True).fill(name)
    page.get_by_role("option", name=f"({name})").click()
    click(page, "Open")


def test_a_pinned_run_stays_beside_the_present_one_until_it_is_unpinned(watched, serve):
    page = opened(watched, serve(STRAND))
    before = shown_hours(page)
    click(page, "Pin")
    eventually(lambda: compared(page), lambda found: found[1:] == ["nothing yet"])
    answered(page, "load.speed_rpm", "50")
    # Half the speed is twice the hours: the wear of a turn is the same.
    life, changed = eventually(lambda: compared(page), lambda found: "50" in found[1])
    assert life == f"before {before}, after {shown_hours(page)} (+100 %)"
    assert changed == "load.speed_rpm: 100, now 50"
    click(page, "Unpin")
    page.wait_for_selector(".ws-comparison", state="hidden")
    assert watched.said == []


def test_undo_and_redo(watched, serve):
    page = opened(watched, serve(STRAND))
    undo, redo = (page.get_by_role("button", name=name, exact=True) for name in ("Undo", "Redo"))
    assert undo.is_disabled() and redo.is_disabled()
    first = shown_hours(page)
    field(page, "load.tension_N").press_sequentially("00")
    answered(page, "load.speed_rpm", "80")
    undo.click()
    eventually(lambda: field(page, "load.speed_rpm").input_value(), lambda found: found == "100")
    undo.click()
    eventually(lambda: field(page, "load.tension_N").input_value(), lambda found: found == "5000")
    settled(page)
    assert shown_hours(page) == first and undo.is_disabled()
    assert source(page).strip().splitlines()[9] == "tension_N = 5000"
    redo.click()
    redo.click()
    eventually(lambda: field(page, "load.speed_rpm").input_value(), lambda found: found == "80")
    eventually(redo.is_disabled, bool)
    assert watched.said == []


def test_sliders_change_the_input_and_follow_it(watched, serve):
    page = opened(watched, serve(STRAND))
    sliders = page.locator("[data-what-if]")
    keys = sliders.evaluate_all("all => all.map(one => one.dataset.whatIf)")
    assert keys == ["sprocket.teeth", "load.tension_N", "load.speed_rpm"]
    teeth = page.get_by_role("slider", name="What if: Teeth")
    teeth.locator("[tabindex]").press("ArrowRight")
    eventually(lambda: field(page, "sprocket.teeth").input_value(), lambda found: found == "21")
    settled(page)
    assert "teeth = 21" in source(page)
    field(page, "sprocket.teeth").fill("24")
    eventually(lambda: teeth.get_attribute("aria-valuenow"), lambda found: found == "24")
    assert watched.said == []


def test_no_field_is_wider_than_its_panel(watched, serve):
    page = opened(watched, serve(STRAND))
    edge = "parts => Math.max(...parts.map(part => part.getBoundingClientRect().right))"
    fields = page.locator(".ws-field").evaluate_all(edge)
    assert fields <= page.locator(".ws-input").evaluate_all(edge)


def test_an_example_begins_a_file_of_ones_own(watched, serve, tmp_path):
    server = serve(STRAND)
    page = opened(watched, server)
    open_example(page, "16b-20t-oiled")
    eventually(lambda: page.locator(".ws-name").inner_text(), lambda found: found == "16b-20t-oiled.toml")
    eventually(lambda: page.locator(".ws-title").inner_text(), lambda found: found.startswith("Evolute"))
    settled(page)
    answered(page, "sprocket.teeth", "21")
    assert page.locator(".ws-title").inner_text().endswith("with sprocket.teeth = 21")
    open_example(page, "packaging-conveyor")
    page.get_by_text("has unsaved changes").wait_for()
    click(page, "Cancel")
    page.wait_for_selector(".q-dialog", state="detached")
    assert page.locator(".ws-name").inner_text() == "16b-20t-oiled.toml"
    assert [path.name for path in tmp_path.iterdir()] == ["drive.toml"]
    assert server.path.read_text() == STRAND


def test_a_shipped_case_opens_without_a_question(watched, serve):
    page = opened(watched, serve(None, "16b-20t-oiled"))
    assert page.locator(".q-dialog").count() == 0
    assert page.locator(".ws-name").inner_text() == "16b-20t-oiled.toml"


def test_first_field_is_the_title_and_labels_are_words_with_the_key_beneath(watched, serve):
    page = opened(watched, serve(STRAND))
    keys = page.locator("[data-key]").evaluate_all("all => all.map(one => one.dataset.key)")
    assert keys[0] == "title" and keys[-1] == "format_version"
    box = page.locator(".ws-field", has=field(page, "load.tension_N"))
    assert box.locator(".q-field__label").inner_text() == "Tension"
    assert box.locator(".q-field__bottom").inner_text().startswith("tension_N: ")
    field(page, "wear.condition").click()
    page.get_by_role("option", name="hardened, dry: hardened teeth, no lubricant").click()
    eventually(lambda: 'condition = "hardened, dry"' in source(page), bool)


def test_a_chain_is_chosen_from_a_list_and_half_of_its_name_is_no_fault(watched, serve):
    page = opened(watched, serve(STRAND))
    before, chain = shown_hours(page), field(page, "chain.designation")
    chain.click()
    eventually(page.get_by_role("option").count, lambda found: found > 20)
    page.keyboard.press("Control+A")
    page.keyboard.type("10")
    page.get_by_role("option", name="10B-1: 15.875 mm pitch").wait_for()
    page.wait_for_timeout(500)
    assert page.locator(".ws-state").inner_text() == "up to date" and shown_hours(page) == before
    page.keyboard.type("B-1")
    eventually(page.get_by_role("option").count, lambda found: found == 1)
    page.wait_for_timeout(300)  # the list opens again where a key was pressed while it was searched
    page.keyboard.press("Enter")
    page.wait_for_selector(".q-menu", state="detached")
    eventually(lambda: 'designation = "10B-1"' in source(page), bool)
    chain.click()
    page.keyboard.press("Control+A")
    page.keyboard.type("ANSI 60")
    page.get_by_role("option", name="12A-1 (ANSI 60, ANSI 60-1)").click()
    page.wait_for_selector(".q-menu", state="detached")
    eventually(lambda: 'designation = "12A-1"' in source(page), bool)
    settled(page)
    chain.click()
    page.keyboard.press("Control+A")
    page.keyboard.type("12B-1")
    page.locator(".ws-answer").click(position={"x": 5, "y": 5})
    eventually(lambda: 'designation = "12B-1"' in source(page), bool)
    assert watched.said == []


def test_a_telephone_shows_the_answer_first_and_links_to_the_input(watched, serve):
    watched.set_viewport_size({"width": 390, "height": 844})
    page = opened(watched, serve(STRAND))
    tops = {name: page.locator(name) for name in (".ws-header", ".ws-hours", ".ws-what-if")}

    def top(name):
        return tops[name].bounding_box()["y"]

    assert top(".ws-hours") < 300 and top(".ws-what-if") > 844
    page.get_by_role("link", name="Input").click()
    head = tops[".ws-header"].bounding_box()["height"]
    eventually(lambda: top(".ws-what-if"), lambda found: head - 2 <= found < head + 20)
    page.get_by_role("link", name="Answer").click()
    eventually(lambda: top(".ws-hours"), lambda found: head < found < 300)
    watched.set_viewport_size({"width": 1440, "height": 900})
    assert page.get_by_role("link", name="Input").count() == 0
    assert top(".ws-what-if") < 150 and top(".ws-hours") < 200


def test_progress_only_rises(watched, serve):
    page = opened(watched, serve(WRAP.replace("phases = 2", "phases = 8").replace("100\nl", "20000\nl")))
    page.evaluate(
        "() => { window.seen = []; new MutationObserver(() => window.seen.push("
        "document.querySelector('.ws-state').innerText)).observe(document.querySelector('.ws-state'),"
        " {subtree: true, childList: true, characterData: true}); }"
    )
    answered(page, "load.power_kW", "4.3")
    percent = [int(found[1]) for text in page.evaluate("seen") if (found := re.search(r"\((\d+) %\)", text))]
    assert len(percent) > 2 and percent == sorted(percent)


def test_lights_of_a_drive_near_its_rating(watched, serve):
    """No. 40 with 19 teeth at 1000 rpm may carry 4.60 kW: 4.4 kW is 96 % of it."""
    page = opened(watched, serve(WRAP))
    lights = page.locator(".ws-light")
    assert lights.first.inner_text() == "near"
    answered(page, "load.power_kW", "7")
    eventually(lights.first.inner_text, lambda found: found == "outside")
    answered(page, "load.power_kW", "2")
    eventually(lights.first.inner_text, lambda found: found == "within")


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [390, 1440])
@pytest.mark.parametrize("text", [STRAND, WRAP, "packaging-conveyor"], ids=["strand", "wrap", "drive"])
def test_axe_finds_nothing(watched, serve, text, width, scheme):
    """Contrast, names, language, landmarks and the one first heading, by axe-core."""
    axe = pytest.importorskip(
        "axe_playwright_python.sync_playwright", reason="axe-playwright-python is not installed"
    )
    watched.set_viewport_size({"width": width, "height": 900})
    watched.emulate_media(color_scheme=scheme)
    page = opened(watched, serve(None, text) if text == "packaging-conveyor" else serve(text))
    for name in ("Examples", "New", "Save as", "Export wheel", "Scan a photo", "Pin"):
        click(page, name)
        if name != "Pin":
            page.locator(".ws-dialog").wait_for()
        # Colours are wrong while a dialog opens.
        eventually(lambda: axe.Axe().run(page).response["violations"], lambda found: not found)
        if name != "Pin":
            page.keyboard.press("Escape")
            page.wait_for_selector(".q-dialog", state="detached")
    headings = page.locator("h1, [role=heading][aria-level='1']")
    assert headings.count() == 1 and page.locator("html").get_attribute("lang") == "en-GB"
