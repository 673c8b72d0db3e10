"""The page of ``wearsim ui`` on a whole drive, in a real browser."""

import re
import subprocess

import pytest

from wearsim.drive.life import drive_life
from wearsim.drive.load_case import load_drive
from wearsim.report.drive.drive_text import drive_text

from .ui_server import (
    COMMAND,
    comes_to,
    eventually,
    field,
    forget_states,
    opened,
    settled,
    shown_hours,
    source,
)

pytestmark = [
    pytest.mark.slow,
    # Of pytest-playwright's own fixture under pytest 9.
    pytest.mark.filterwarnings("ignore:Session-scoped fixtures defined as instance methods"),
]

DRIVE = """\
format_version = 1
[chain]
designation = "08B-1"

[[sprocket]]
teeth = 17  # in stock
profile = "iso606"
nodes = 51

[[sprocket]]
name = "roll"
teeth = 20
profile = "iso606"
nodes = 51

[drive]
links = 110
[mechanism]
phases = 2
[load]
power_kW = 1.3
speed_rpm = 300
[joint]
specific_wear_rate_mm2_per_N = 1e-8
[wear]
specific_wear_rate_mm2_per_N = 5e-9
[run]
life_tolerance = 0.1
horizon_hours = 100
"""

SLOW_DRIVE = (
    DRIVE.replace("phases = 2", "phases = 8")
    .replace("nodes = 51", "nodes = 201")
    .replace("life_tolerance = 0.1\nhorizon_hours = 100", "life_tolerance = 0.001\nhorizon_hours = 1000")
)
"""Takes longer than its estimate, so that it can be seen."""


def answer_of(path):
    return " ".join(drive_text(drive_life(load_drive(path)), str(path)).split())


def rows(page):
    """Labels and texts of the answer, as the command prints them."""
    found = page.locator(".ws-life-card .ws-findings").evaluate(
        "all => [...all.children].map(one => one.innerText)"
    )
    return [f"{label} {' '.join(text.split())}" for label, text in zip(found[::2], found[1::2], strict=True)]


def pulls(page):
    """Tensions of the spans in the drawing of the layout [N]."""
    texts = page.locator(".ws-layout text").all_text_contents()
    return [float(text.removesuffix(" N").replace(" ", "")) for text in texts if text.endswith(" N")]


def test_a_drive_shows_what_the_command_prints_and_follows_an_edit(watched, serve):
    server = serve(DRIVE)
    page = opened(watched, server)
    assert len(rows(page)) == 5 and all(row in answer_of(server.path) for row in rows(page))
    assert page.locator(".ws-now").inner_text().startswith(page.locator(".ws-hours").inner_text())
    # P/v of 1.3 kW at 17 x 12.7 mm x 300 rpm.
    assert abs(max(pulls(page)) - min(pulls(page)) - 1.3e6 / (17 * 12.7 * 300 / 60)) < 1.0
    page.locator(".ws-layout a").nth(1).click()
    eventually(lambda: page.locator(".ws-chosen input").input_value(), lambda found: found == "roll")
    assert page.locator(".lives text").first.text_content().startswith("chain: ")
    for width in (1440, 390):
        page.set_viewport_size({"width": width, "height": 900})
        page.wait_for_function(f"document.documentElement.scrollWidth <= {width}")

    forget_states(page)
    field(page, "sprocket.1.teeth").fill("18")
    comes_to(page, "computing")
    settled(page)
    eventually(lambda: page.get_by_text("Sprocket 1: 18 teeth").count(), bool)
    page.get_by_role("button", name="Save", exact=True).click()
    expected = DRIVE.replace("teeth = 17  #", "teeth = 18  #")
    eventually(server.path.read_text, lambda found: found == expected)
    assert all(row in answer_of(server.path) for row in rows(page))
    assert watched.said == []


def test_faults_and_new_tables_of_a_sprocket(watched, serve):
    page = opened(watched, serve(DRIVE))
    field(page, "sprocket.2.teeth").fill("3")
    field(page, "sprocket.2.teeth").blur()
    page.wait_for_selector('.ws-state[data-state="old"]')
    message = page.locator(".ws-fault").inner_text()
    assert re.search(r"drive\.toml:12: sprocket\.2\.teeth: must be a whole number .* \(got 3\)", message)
    assert page.locator(".q-field--error .q-field__messages").inner_text() == message
    assert page.locator(".ws-life-card.ws-old").count() == 1
    field(page, "sprocket.2.teeth").fill("20")
    settled(page)
    page.locator(".q-field--error").wait_for(state="detached")
    page.locator(".ws-form").get_by_text("Sprocket: add one", exact=True).click()
    page.get_by_role("button", name="Add a table [[sprocket]]").click()
    page.get_by_text("Sprocket 3").wait_for()
    page.wait_for_selector('.ws-state[data-state="old"]')
    page.get_by_role("button", name="Remove this table").last.click()
    settled(page)
    assert source(page).count("[[sprocket]]") == 2


def test_only_the_last_of_several_edits_is_answered(watched, serve):
    server = serve(SLOW_DRIVE)
    page = opened(watched, server)
    page.evaluate(
        "() => { window.seen = []; new MutationObserver(() => window.seen.push("
        "document.querySelector('.ws-now').innerText)).observe(document.querySelector('.ws-now'),"
        " {subtree: true, childList: true, characterData: true}); }"
    )
    for value in ("2.1", "2.2", "2.3"):
        forget_states(page)
        field(page, "load.power_kW").fill(value)
        comes_to(page, "estimate")
    before = page.evaluate("seen.length")
    settled(page)
    said = page.evaluate("seen")
    assert any(re.search(r"\(\d+ %\)", text) for text in said)
    # An earlier edit may be answered before the next one is made, never after the last one.
    after = {text.split("\n")[0] for text in said[before:] if "up to date" in text}
    assert after == {shown_hours(page)}


def test_a_new_drive_is_that_of_wearsim_init(watched, serve, tmp_path):
    server = serve(None)
    watched.goto(server.url)
    known = {
        "chain": "08B-1",
        "driver": "17",
        "driven": "38",
        "rpm": "300",
        "power": "1.3 kW",
        "centre": "60",
    }
    for name, value in known.items():
        watched.locator(f'[data-known="{name}"]').fill(value)
        if name == "chain":  # its list opens late on a busy machine, and would then lie over other fields
            watched.get_by_role("option", name=value).first.wait_for()
        watched.keyboard.press("Tab")
    watched.locator('[data-known="shock"]').click()
    watched.get_by_role("option", name="moderate").click()
    watched.get_by_role("button", name="Create").click()
    error = watched.locator(".ws-questions .q-field--error")
    eventually(lambda: error.all_inner_texts(), lambda found: "must not overlap" in "".join(found))
    watched.locator('[data-known="centre"]').fill("500")
    watched.get_by_role("button", name="Create").click()
    watched.wait_for_selector(".q-dialog", state="detached")
    watched.get_by_role("button", name="Save", exact=True).click()
    watched.get_by_label("File name").fill("mine")
    watched.locator(".q-dialog").get_by_role("button", name="Save", exact=True).click()
    eventually((tmp_path / "mine.toml").exists, bool)
    options = [part for name, value in (known | {"centre": "500"}).items() for part in (f"--{name}", value)]
    done = subprocess.run(
        [*COMMAND, "init", *options, "--shock", "moderate"], capture_output=True, text=True, check=True
    )
    assert (tmp_path / "mine.toml").read_text() == done.stdout
    assert watched.said == []
