"""The page of ``wearsim ui`` in a real browser, served by the real command."""

import http.client
import json
import os
import re
import signal
import socket
import subprocess
import sys
import time

import numpy as np
import pytest

import wearsim
from wearsim.result.lives import hours

from .conftest import HOSTILE
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

STRAND = """\
# A drive of a test.
format_version = 1
title = "Test drive"
[sprocket]
teeth = 20
profile = "evolute"   # and nothing else
nodes = 51
[chain]
designation = "16B-1"
[load]
power_kW = 3  # at the shaft
speed_rpm = 100
[wear]
condition = "hardened, oiled"
[stop]
critical_depth_mm = 0.02
"""
WRAP = """\
format_version = 1
title = "A wrap"
[chain]
designation = "08B-1"
[sprocket]
teeth = 19
profile = "iso606"
nodes = 301
[drive]
mate_teeth = 57
links = 120
[mechanism]
kind = "wrap"
[load]
power_kW = 2
speed_rpm = 900
[wear]
condition = "hardened, oiled"
"""
SLOW_WRAP = WRAP.replace("nodes = 301", "nodes = 601") + "[run]\nlife_tolerance = 0.01\n"
"""Takes longer than its estimate, so that it can be seen."""
GEARS = """\
format_version = 1
title = "Gears"
[gear]
pinion_teeth = 19
wheel_teeth = 61
module_mm = 3
face_width_mm = 30
nodes = 61
[load]
torque_N_m = 100
speed_rpm = 1450
[wear]
specific_wear_rate_mm2_per_N = 1e-11
[stop]
critical_depth_mm = 0.02
"""


def life(path, *settings):
    return hours(wearsim.simulate(wearsim.load_case(path, settings)).life)


def typed(page, key, value, expected):
    """Type a value and wait for the answer to it."""
    field(page, key).fill(value)
    eventually(lambda: shown_hours(page), lambda found: found == expected)
    settled(page)


def test_life_follows_a_changed_value(watched, serve):
    server = serve(STRAND)
    page = opened(watched, server)
    assert shown_hours(page) == life(server.path)
    for value in ("4", "2.5", "3.5 kW"):
        expected = life(server.path, f"load.power_kW={value}")
        typed(page, "load.power_kW", value, expected)
        assert page.locator(".ws-hours").inner_text() == expected
    expected = life(server.path, "load.power_kW=3.5 kW", "sprocket.back_flank=mirrored")
    page.get_by_text("more").nth(1).click()
    field(page, "sprocket.back_flank").click()
    page.get_by_role("option", name="mirrored").click()
    eventually(lambda: 'back_flank = "mirrored"' in source(page), bool)
    settled(page)
    assert shown_hours(page) == expected
    assert watched.said == []


def test_a_bad_value_says_what_the_command_line_says(watched, serve, tmp_path):
    server = serve(STRAND)
    page = opened(watched, server)
    good = shown_hours(page)
    bad = STRAND.replace("power_kW = 3 ", "power_kW = -3 ")
    field(page, "load.power_kW").fill("-3")
    page.wait_for_selector('.ws-state[data-state="incomplete"]')
    assert page.locator(".ws-fault").count() == 0 and page.locator(".q-field--error").count() == 0
    assert shown_hours(page) == good
    field(page, "load.power_kW").blur()
    page.wait_for_selector('.ws-state[data-state="old"]')
    server.path.write_text(bad)
    done = subprocess.run([*COMMAND, "check", server.path], capture_output=True, text=True)
    assert done.returncode == 2
    message = done.stderr.strip()
    assert message.startswith(f"{server.path}:11: load.power_kW: ")
    assert page.locator(".ws-fault").inner_text() == message
    beside = page.locator(".q-field--error .q-field__messages")
    assert beside.inner_text() == message
    assert shown_hours(page) == good
    assert page.locator(".ws-life-card.ws-old .ws-hours").inner_text() == good
    assert page.locator(".ws-chart").first.is_visible()
    server.path.write_text(STRAND)
    typed(page, "load.power_kW", "4", life(server.path, "load.power_kW=4"))
    assert page.locator(".ws-fault").count() == 0
    assert page.locator(".ws-old").count() == 0


def test_source_that_is_no_toml_keeps_the_answer_as_an_old_one(watched, serve):
    page = opened(watched, serve(STRAND))
    good = shown_hours(page)
    page.get_by_role("tab", name="TOML").click()
    page.locator(".cm-content").click()
    page.keyboard.press("Control+End")
    page.keyboard.type("broken")
    page.wait_for_selector('.ws-state[data-state="incomplete"]')
    page.locator(".cm-content").blur()
    page.wait_for_selector('.ws-state[data-state="old"]')
    assert "not valid TOML" in page.locator(".ws-fault").inner_text()
    assert shown_hours(page) == good
    page.locator(".cm-content").focus()
    page.keyboard.press("Control+End")
    for _ in "broken":
        page.keyboard.press("Backspace")
    settled(page)
    page.keyboard.type("[run]\nhorizon_hours = 10")
    eventually(lambda: shown_hours(page), lambda found: found == "> 10 h")
    page.get_by_role("tab", name="Form").click()
    assert field(page, "run.horizon_hours").input_value() == "10"


def test_two_pages_do_not_disturb_each_other(watched, context, serve):
    server = serve(STRAND)
    one, other = opened(watched, server), opened(context.new_page(), server)
    before = shown_hours(other)
    typed(one, "load.power_kW", "6", life(server.path, "load.power_kW=6"))
    typed(other, "load.speed_rpm", "50", life(server.path, "load.speed_rpm=50"))
    assert field(other, "load.power_kW").input_value() == "3"
    assert field(one, "load.speed_rpm").input_value() == "100"
    assert shown_hours(one) == life(server.path, "load.power_kW=6") != before


def test_save_keeps_comments_and_order(watched, serve):
    server = serve(STRAND)
    page = opened(watched, server)
    typed(page, "load.power_kW", "4", life(server.path, "load.power_kW=4"))
    assert page.locator(".ws-dirty").is_visible()
    page.get_by_role("button", name="Save", exact=True).click()
    expected = STRAND.replace("power_kW = 3 ", "power_kW = 4 ")
    eventually(server.path.read_text, lambda found: found == expected)
    eventually(page.locator(".ws-dirty").is_visible, lambda found: not found)
    assert list(server.path.parent.iterdir()) == [server.path]


def test_a_file_that_changed_on_disk_is_not_replaced_unasked(watched, serve):
    server = serve(STRAND)
    page = opened(watched, server)
    other = STRAND.replace("Test drive", "Of another editor")
    for answer in ("Cancel", "Load it and discard the changes on this page", "Replace it"):
        value = {"Cancel": "4", "Replace it": "6"}.get(answer, "5")
        field(page, "load.power_kW").fill(value)
        server.path.write_text(other)
        page.get_by_role("button", name="Save", exact=True).click()
        page.get_by_role("button", name=answer).click()
        page.wait_for_selector(".q-dialog", state="detached")
        if answer == "Replace it":
            eventually(server.path.read_text, lambda found: "power_kW = 6" in found)
        else:
            assert server.path.read_text() == other
        if answer.startswith("Load"):
            eventually(lambda: field(page, "title").input_value(), lambda found: found == "Of another editor")
            settled(page)
            other = STRAND.replace("Test drive", "Of a third one")


def test_save_as_stays_in_the_folder_and_asks_before_it_replaces(watched, serve, tmp_path):
    (tmp_path / "taken.toml").write_text("mine")
    page = opened(watched, serve(STRAND))

    def save_as(name):
        page.get_by_role("button", name="Save as").click()
        page.get_by_label("File name").fill(name)
        page.locator(".q-dialog").get_by_role("button", name="Save", exact=True).click()

    save_as("../elsewhere")
    page.get_by_text("without a folder").wait_for()
    save_as("taken")
    page.get_by_role("button", name="Cancel").click()
    page.wait_for_selector(".q-dialog", state="detached")
    assert (tmp_path / "taken.toml").read_text() == "mine"
    save_as("mine")
    eventually((tmp_path / "mine.toml").exists, bool)
    assert wearsim.load_case(tmp_path / "mine.toml").name == "mine"
    eventually(lambda: page.locator(".ws-name").inner_text(), lambda found: found == "mine.toml")
    assert not (tmp_path.parent / "elsewhere.toml").exists()


def undated(content):
    """A file without what differs from one export to the next: dates, marks and orders of a DXF."""
    marks = rb"\{[-0-9A-F]{36}\}|@ [-0-9T:.+]+|\b24\d{5}\.\d+"
    return sorted(re.sub(marks, b"", content).splitlines())  # classes come in any order


@pytest.mark.parametrize(("form", "state"), [("dxf", "both"), ("svg", "new"), ("csv", "worn")])
def test_exported_wheel_is_that_of_the_command(watched, serve, tmp_path, form, state):
    server = serve(STRAND)
    page = opened(watched, server)
    page.get_by_role("button", name="Export wheel").click()
    for label, value in (("Format", form), ("State", state)):
        page.locator(".q-dialog").get_by_label(label).click()
        page.get_by_role("option", name=value, exact=True).click()
    with page.expect_download() as download:
        page.get_by_role("button", name="Download", exact=True).click()
    assert download.value.suggested_filename == f"drive.{form}"
    out = tmp_path / f"out.{form}"
    subprocess.run([*COMMAND, "export", server.path, "--out", out, "--state", state], check=True)
    assert undated(download.value.path().read_bytes()) == undated(out.read_bytes())


def undated_sheet(text):
    return re.sub(r"\d{4}-\d{2}-\d{2}", "", text)


@pytest.mark.parametrize("text", [STRAND, "packaging-conveyor"], ids=["strand", "drive"])
def test_sheet_is_that_of_the_command(watched, serve, tmp_path, text):
    server = serve(STRAND) if text == STRAND else serve(None, text)
    page = opened(watched, server)
    with page.expect_download() as download:
        page.get_by_role("button", name="Sheet", exact=True).click()
    case, out = (server.path, tmp_path / "out") if text == STRAND else (text, tmp_path / "out.html")
    assert download.value.suggested_filename == ("drive.html" if text == STRAND else f"{text}.html")
    single = ["--single-file"] if text == STRAND else []
    subprocess.run([*COMMAND, "report", case, "--out", out, *single], check=True)
    written = out / "index.html" if text == STRAND else out
    assert undated_sheet(download.value.path().read_text()) == undated_sheet(written.read_text())


def test_a_hostile_title_stays_text(watched, serve):
    text = STRAND.replace('"Test drive"', json.dumps(HOSTILE + "</script><img src=x onerror=alert(1)>"))
    server = serve(text, name="a'b<i>.toml")
    page = opened(watched, server)
    title = page.locator(".ws-title")
    assert title.inner_text().startswith(HOSTILE)
    assert page.locator(".ws-name").inner_text() == "a'b<i>.toml"
    assert page.locator("main img").count() == 0
    field(page, "title").fill("<img src=x onerror=alert(2)>")
    eventually(title.inner_text, lambda found: found == "<img src=x onerror=alert(2)>")
    field(page, "chain.designation").fill("<img src=x onerror=alert(3)>")
    page.keyboard.press("Enter")
    page.wait_for_selector('.ws-state[data-state="old"]')
    assert "<img" in page.locator(".ws-fault").inner_text()
    assert page.locator("main img").count() == 0
    assert page.title() == "* a'b<i>.toml - wearsim"
    assert watched.said == []


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [360, 1440])
@pytest.mark.parametrize("text", [STRAND, WRAP, GEARS], ids=["strand", "wrap", "gears"])
def test_a_page_fits_and_asks_nobody_else(watched, serve, text, width, scheme):
    watched.set_viewport_size({"width": width, "height": 900})
    watched.emulate_media(color_scheme=scheme)
    server = serve(text)
    opened(watched, server)
    watched.wait_for_selector(".ws-plot .main-svg")
    origins = {re.match(r"\w+://[^/]*|\w+:", url)[0] for url in watched.requested}
    assert origins <= {server.url.rstrip("/"), "data:", "blob:"}
    assert watched.said == []
    eventually(lambda: watched.evaluate("document.documentElement.scrollWidth"), lambda found: found <= width)
    ground = watched.evaluate("getComputedStyle(document.body).backgroundColor")
    assert ground == {"light": "rgb(255, 255, 255)", "dark": "rgb(20, 23, 26)"}[scheme]
    page = {"light": "rgb(255, 255, 255)", "dark": "rgb(20, 23, 26)"}[scheme]
    plots = "getComputedStyle(document.querySelector('.ws-plot .bg')).fill"
    eventually(lambda: watched.evaluate(plots), lambda found: found == page)


def test_fields_are_named_and_reached_by_the_keyboard(watched, serve):
    server = serve(STRAND)
    page = opened(watched, server)
    expected = life(server.path, "load.power_kW=4")
    named = page.get_by_role("textbox", name="load.power_kW kW")
    page.get_by_role("textbox", name="title").focus()
    for _ in range(40):
        page.keyboard.press("Tab")
        if named.evaluate("element => element === document.activeElement"):
            break
    page.keyboard.press("Control+A")
    page.keyboard.type("4")
    eventually(lambda: shown_hours(page), lambda found: found == expected)
    for key in page.locator("[data-key]").evaluate_all("all => all.map(e => e.ariaLabel)"):
        assert key


def test_a_table_of_the_duty_is_added_filled_and_removed(watched, serve):
    text = STRAND.replace("power_kW = 3  # at the shaft\nspeed_rpm = 100\n", "")
    text = text.replace("[load]\n", "") + "[[duty]]\nspeed_rpm = 100\npower_kW = 3\nshare_of_time = 1\n"
    server = serve(text)
    page = opened(watched, server)
    page.get_by_text("Load block: add one", exact=True).click()
    page.wait_for_timeout(400)  # opens slowly
    page.get_by_role("button", name="Add a table [[duty]]").click()
    page.wait_for_selector('.ws-state[data-state="old"]')
    for key, value in (("speed_rpm", "50"), ("power_kW", "4"), ("share_of_time", "1")):
        field(page, f"duty.2.{key}").fill(value)
    field(page, "duty.1.share_of_time").fill("0.5")
    field(page, "duty.2.share_of_time").fill("0.5")
    settled(page)
    server.path.write_text(
        text.replace("time = 1", "time = 0.5")
        + "[[duty]]\nspeed_rpm = 50\npower_kW = 4\nshare_of_time = 0.5\n"
    )
    assert shown_hours(page) == life(server.path)
    page.get_by_role("button", name="Remove this table").last.click()
    eventually(lambda: "speed_rpm = 50" not in source(page), bool)


def test_a_wrap_shows_an_estimate_then_its_life_and_only_of_the_last_input(watched, serve):
    server = serve(SLOW_WRAP)
    page = opened(watched, server)
    page.evaluate(
        "() => { window.seen = []; new MutationObserver(() => window.seen.push("
        "document.querySelector('.ws-now').innerText)).observe(document.querySelector('.ws-now'),"
        " {subtree: true, childList: true, characterData: true}); }"
    )
    forget_states(page)
    values = ("2.1", "2.2", "2.3")
    for value in values:
        field(page, "load.power_kW").fill(value)
        page.wait_for_timeout(300)
    comes_to(page, "estimate")
    settled(page)
    lives = [life(server.path, f"load.power_kW={value}") for value in values]
    assert shown_hours(page) == lives[-1]
    # One that is done before the next edit may show; none after a later one.
    current = [text.split("\n")[0] for text in page.evaluate("seen") if "up to date" in text]
    assert current == sorted(current, key=lives.index)
    assert page.locator(".ws-chart").filter(has_text="tooth").count() >= 1


def test_fifty_edits_and_absurd_values(watched, serve):
    server = serve(STRAND)
    page = opened(watched, server)
    for value in (
        "1e400",
        "nan",
        "-1e15",
        "0",
        "1e15",
        "[1, 2]",
        "{a = 1}",
        '"',
        "\\",
        "\u0000",
        "9" * 500,
        "=",
        "'''",
    ):
        field(page, "load.power_kW").fill(value)
    field(page, "sprocket.teeth").fill("1000000")
    field(page, "sprocket.teeth").fill("20")
    for number in range(50):
        field(page, "load.power_kW").fill(f"{1 + 0.1 * number:.1f}")
    expected = life(server.path, "load.power_kW=5.9")
    eventually(lambda: shown_hours(page), lambda found: found == expected)
    settled(page)
    field(page, "load.power_kW").fill("")
    field(page, "load.power_kW").press_sequentially("6.1234567", delay=1)
    expected = life(server.path, "load.power_kW=6.1234567")
    eventually(lambda: shown_hours(page), lambda found: found == expected)
    settled(page)
    assert watched.said == []


def test_closing_the_page_ends_its_calculation(watched, context, serve):
    server = serve(SLOW_WRAP)
    page = context.new_page()
    page.goto(server.url)
    comes_to(page, "estimate", 300)
    page.close()
    other = opened(watched, server)
    assert shown_hours(other) == life(server.path)


def test_the_server_stops_while_it_computes(watched, serve):
    server = serve(SLOW_WRAP)
    watched.goto(server.url)
    comes_to(watched, "estimate")
    start = time.monotonic()
    code, said = server.stop()
    assert code == 130
    assert "Traceback" not in said and "interrupted" in said
    assert time.monotonic() - start < 8.0


def test_a_reloaded_page_begins_with_the_file(watched, serve):
    server = serve(STRAND, "--set", "load.power_kW=5")
    page = opened(watched, server)
    assert field(page, "load.power_kW").input_value() == "5"
    assert shown_hours(page) == life(server.path, "load.power_kW=5")
    assert server.path.read_text() == STRAND
    server.path.write_text(STRAND.replace("Test drive", "Renamed"))
    # Text that is not saved is not left without a question.
    page.on("dialog", lambda dialog: dialog.accept())
    opened(page, server)
    assert len(watched.said) == 1 and watched.said[0].startswith("dialog")
    assert field(page, "title").input_value() == "Renamed"
    server.path.unlink()
    page.goto(server.url)
    page.get_by_text("must be a readable file").wait_for()


def status_of(server, path="/", method="GET", **headers):
    """Status of the answer to a request."""
    connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=20)
    connection.request(method, path, headers=headers)
    status = connection.getresponse().status
    connection.close()
    return status


def handshake(server, **headers):
    """Status line of the answer to a websocket of the page."""
    given = {
        "Host": f"127.0.0.1:{server.port}",
        "Upgrade": "websocket",
        "Connection": "Upgrade",
        "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ==",
        "Sec-WebSocket-Version": "13",
        **headers,
    }
    lines = [f"GET {SOCKET}&transport=websocket HTTP/1.1", *(f"{k}: {v}" for k, v in given.items())]
    with socket.create_connection(("127.0.0.1", server.port), timeout=20) as connection:
        connection.sendall(("\r\n".join(lines) + "\r\n\r\n").encode())
        return connection.recv(4096).decode("latin-1").splitlines()[0]


SOCKET = "/_nicegui_ws/socket.io/?EIO=4"


def test_other_sites_are_refused_on_http_polling_and_websocket(serve):
    server = serve(STRAND)
    own, evil = f"127.0.0.1:{server.port}", "evil.example"
    polling = f"{SOCKET}&transport=polling"
    assert status_of(server) == 200
    assert status_of(server, Host=f"localhost:{server.port}") == 200
    assert status_of(server, polling) == 200
    assert status_of(server, polling, Origin=f"http://{own}") == 200
    assert "101" in handshake(server, Origin=f"http://{own}")
    for headers in (
        {"Origin": f"http://{evil}"},
        {"Origin": "null"},
        {"Host": evil},
        {"Host": f"{evil}:{server.port}"},
        {"Origin": f"http://{own}.{evil}"},
        {"Origin": f"https://{own}"},
        {"Origin": "http://127.0.0.1:1"},
    ):
        assert status_of(server, **headers) == 403, headers
        assert status_of(server, polling, **headers) == 403, headers
        assert status_of(server, polling, "POST", **headers) == 403, headers
        assert " 403 " in handshake(server, **headers) + " ", headers


def test_a_page_of_another_site_cannot_talk_to_it(watched, serve, tmp_path):
    """In a real browser: fetch, websocket, frame and script of another origin."""
    server = serve(STRAND)
    opened(watched, server)
    other = serve(STRAND)
    watched.goto(other.url)
    tried = watched.evaluate(
        """async ([url, socket]) => {
            const found = {};
            try { found.fetch = (await fetch(url)).status; } catch { found.fetch = "refused"; }
            found.socket = await new Promise((done) => {
                const one = new WebSocket(socket);
                one.onopen = () => done("open"); one.onerror = () => done("refused");
            });
            return found;
        }""",
        [server.url, f"ws://127.0.0.1:{server.port}{SOCKET}&transport=websocket"],
    )
    assert tried == {"fetch": "refused", "socket": "refused"}


def test_only_the_loopback_address_listens(serve):
    server = serve(STRAND)
    own = {entry[4][0] for entry in socket.getaddrinfo(socket.gethostname(), None)}
    for address in own - {"127.0.0.1", "::1"}:
        if address.startswith("127."):
            continue
        with pytest.raises(OSError), socket.create_connection((address, server.port), timeout=2):
            pass


@pytest.mark.skipif(os.name != "posix", reason="needs a shell")
def test_the_browser_is_opened(serve, tmp_path):
    """One that keeps its caller waiting does not keep the page waiting."""
    browser, told = tmp_path / "browser", tmp_path / "told"
    browser.write_text(f'#!/bin/sh\necho "$1" > {told}\nsleep 2\n')
    browser.chmod(0o700)
    server = serve(STRAND, browser=browser)
    eventually(told.exists, bool)
    eventually(told.read_text, lambda found: found == f"{server.url}\n")
    assert status_of(server) == 200


def test_nothing_is_left_behind(watched, serve, tmp_path):
    server = serve(STRAND)
    opened(watched, server)
    assert list(tmp_path.iterdir()) == [server.path]


WATCH = """() => {
    const bar = document.querySelector(".ws-state");
    document.addEventListener("input", () => {
        window.typed = performance.now();
        window.after = {};
    }, true);
    new MutationObserver(() => {
        const state = bar.dataset.state;
        if (window.after && !(state in window.after)) {
            window.after[state] = performance.now() - window.typed;
        }
    }).observe(bar, { attributes: true });
}"""


@pytest.mark.parametrize(
    ("text", "edits", "first"),
    [(STRAND.replace("nodes = 51\n", ""), 9, "drawing"), (WRAP.replace("nodes = 301\n", ""), 3, "estimate")],
    ids=["strand", "wrap"],
)
def test_seconds_from_an_edit_to_its_answer(watched, serve, text, edits, first):
    """Printed, and bounded loosely: machines differ."""
    page = opened(watched, serve(text))
    page.wait_for_timeout(3000)
    page.evaluate(WATCH)
    found = []
    for number in range(edits):
        field(page, "load.power_kW").fill(f"{2.5 + 0.01 * number:.2f}")
        page.wait_for_function("window.after && window.after.current", timeout=60_000)
        found.append(page.evaluate("window.after"))
    for state in ("computing", first, "drawing", "current"):
        times = sorted(after[state] for after in found)
        print(f"\n{state}: {times[len(times) // 2]:.0f} ms ({times[0]:.0f} to {times[-1]:.0f})", end="")
    assert min(after[first] for after in found) < 3000.0


TOLD = """\
import ctypes, gc, os, signal
from pathlib import Path

def tell(*_):
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)
    pages = Path("/proc/self/statm").read_text().split()[1]
    held = [pages, *(len(os.listdir(f"/proc/self/{kind}")) for kind in ("task", "fd"))]
    Path(PLACE + ".new").write_text(" ".join(map(str, held)))
    os.replace(PLACE + ".new", PLACE)

signal.signal(signal.SIGUSR1, tell)
"""
"""Has a server tell its pages of memory, threads and files when it gets a signal, without garbage."""


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="memory is read from /proc")
def test_five_hundred_edits_leave_memory_threads_and_files(watched, serve, tmp_path, monkeypatch):
    """The last 300 leave less than 1 kB each: threads share one heap, whose free end is given back."""
    told = tmp_path / "told"
    (tmp_path / "sitecustomize.py").write_text(f"PLACE = {str(told)!r}\n{TOLD}")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path), prepend=os.pathsep)
    monkeypatch.setenv("MALLOC_ARENA_MAX", "1")
    monkeypatch.setenv("MALLOC_TRIM_THRESHOLD_", "131072")
    server = serve(STRAND)
    page = opened(watched, server)
    page.evaluate(WATCH)
    readings = []
    for number in range(1, 501):
        field(page, "load.power_kW").fill(f"{2.5 + 0.001 * number:.3f}")
        page.wait_for_function("window.after && window.after.current", timeout=60_000)
        if number >= 200 and number % 10 == 0:
            server.process.send_signal(signal.SIGUSR1)
            eventually(told.exists, bool)
            readings.append((number, *map(int, told.read_text().split())))
            told.unlink()
    number, pages, threads, files = np.array(readings).T
    memory = pages * os.sysconf("SC_PAGE_SIZE")
    (slope, _), spread = np.polyfit(number, memory, 1, cov=True)
    error = np.sqrt(spread[0, 0])
    print(
        f"\n{memory[-1] / 1e6:.1f} MB, {slope:.0f} bytes an edit with a standard error of {error:.0f}", end=""
    )
    assert slope - 2.0 * error < 1000.0
    assert error < 1000.0
    assert max(threads[-5:]) <= max(threads[:5])
    assert max(files[-5:]) <= max(files[:5])
