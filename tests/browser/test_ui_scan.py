"""A photograph scanned on the page of ``wearsim ui``: dropped, measured, corrected, refused."""

import contextlib
import http.client
import re

import pytest
from PIL import Image

import wearsim
from tests.photographs import Camera, new_gap, picture, wheel, with_pocket
from wearsim.result.lives import hours

from .ui_server import eventually, opened

pytestmark = [
    pytest.mark.slow,
    # Of pytest-playwright's own fixture under pytest 9.
    pytest.mark.filterwarnings("ignore:Session-scoped fixtures defined as instance methods"),
]

WRAP = """\
format_version = 1
title = "A wrap"
[chain]
designation = "08B-1"
[sprocket]
teeth = 19
profile = "iso606"
nodes = 101
[drive]
mate_teeth = 57
links = 120
[mechanism]
kind = "wrap"
phases = 1
[load]
power_kW = 3
speed_rpm = 1000
[wear]
condition = "hardened, oiled"
[run]
life_tolerance = 0.1
"""
DEPTH = 0.3
SIZE = (1600, 1200)


@pytest.fixture(scope="module")
def photo(tmp_path_factory):
    """A photograph of 19 teeth, 0.3 mm deep."""
    path = tmp_path_factory.mktemp("photo") / "wheel.jpg"
    picture(wheel([with_pocket(new_gap(12.7, 8.51, 19), DEPTH)] * 19), Camera(size=SIZE)).save(path)
    return path


def dialog(page):
    page.get_by_role("button", name="Scan a photo", exact=True).click()
    page.locator(".ws-scan").wait_for()
    return page.locator(".ws-scan")


def choose(page, path):
    page.locator(".ws-scan input[type=file]").set_input_files(path)


def findings(page):
    """Function that returns what the answer says."""
    return page.locator(".ws-scan .ws-findings").inner_text


def measured(page):
    """Depth in the answer [mm]."""
    text = eventually(findings(page), lambda text: "Depth" in text)
    return float(re.search(r"([\d.]+) mm \+-", text)[1])


def field(page, label):
    return page.locator(".ws-scan").get_by_label(label, exact=True)


def measure(page):
    page.locator(".ws-scan").get_by_role("button", name="Measure", exact=True).click()


def click_photo(page, across, down):
    """Click on a part of the width and of the height of what is shown."""
    image = page.locator(".ws-photo img")
    box = image.bounding_box()
    image.click(position={"x": across * box["width"], "y": down * box["height"]})


def hint(page, words):
    eventually(page.locator(".ws-scan [role=status]").inner_text, lambda text: words in text)


def shows(page, pixels):
    """Wait for a view of so many pixels across."""
    page.wait_for_function("n => document.querySelector('.ws-photo img').naturalWidth === n", arg=pixels)


@pytest.mark.parametrize("width", [390, 1440])
def test_a_photo_is_measured(watched, serve, photo, width, tmp_path):
    watched.set_viewport_size({"width": width, "height": 900})
    page = opened(watched, serve(WRAP))
    found = dialog(page)
    choose(page, photo)
    assert measured(page) == pytest.approx(wearsim.scan(photo, chain="08B").depth, abs=2e-3)
    assert found.locator(".ws-teeth tbody tr").count() == 19
    assert found.locator("polyline").count() > 19 * 2
    page.screenshot(path=tmp_path / "scan.png")
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    card = found.bounding_box()
    assert card["x"] >= 0.0 and card["x"] + card["width"] <= width
    assert not any("://" in url and "127.0.0.1" not in url for url in page.requested if url[:4] == "http")


@pytest.mark.parametrize("width", [390, 1440])
def test_two_points_are_the_scale(watched, serve, photo, width):
    """Both ends of the middle half of the picture, whose pixels are known."""
    watched.set_viewport_size({"width": width, "height": 900})
    page = opened(watched, serve(WRAP))
    dialog(page)
    choose(page, photo)
    measured(page)
    pixels = wearsim.scan(photo, chain="08B").summary()["scale_px_per_mm"]
    field(page, "Scale").click()
    page.get_by_role("option", name="two points").click()
    field(page, "Distance, mm").fill(f"{0.5 * SIZE[0] / pixels:.6f}")
    page.get_by_role("button", name="Mark the points").click()
    for which, across in (("first", 0.25), ("second", 0.75)):
        hint(page, f"near the {which}")
        shows(page, SIZE[0] // 2)
        click_photo(page, across, 0.5)
        hint(page, f"on the {which}")
        # The enlarged part has the place that was clicked in its middle.
        shows(page, 200)
        click_photo(page, 0.5, 0.5)
    text = eventually(findings(page), lambda text: "two points" in text)
    found = float(re.search(r"([\d.]+) pixels per mm", text)[1])
    assert found == pytest.approx(pixels, rel=4e-3)


def test_hours_left_are_those_of_the_command(watched, serve, photo, tmp_path):
    server = serve(WRAP)
    page = opened(watched, server)
    dialog(page)
    field(page, "Running hours, h").fill("4200")
    choose(page, photo)
    measured(page)
    text = findings(page)()
    said = dict(
        line.split(None, 1)
        for line in wearsim.scan(photo, server.path, hours=4200).text.splitlines()
        if line.split()[:1] in (["Remaining"], ["Band"])
    )
    assert said["Remaining"] in text and said["Band"] in text
    with page.expect_download() as saved:
        page.get_by_role("button", name="Save the reading").click()
    saved.value.save_as(tmp_path / "reading.toml")
    left = wearsim.remaining(server.path, reading=tmp_path / "reading.toml")
    assert f"{hours(left.remaining)} after" in said["Remaining"]


def test_the_button_asks_for_a_file(watched, serve, photo):
    page = opened(watched, serve(WRAP))
    dialog(page)
    with page.expect_file_chooser() as asked:
        page.get_by_role("button", name="Choose a photo").click()
    asked.value.set_files(photo)
    measured(page)


def test_teeth_are_corrected(watched, serve, photo):
    page = opened(watched, serve(WRAP.replace("teeth = 19", "teeth = 20", 1)))
    found = dialog(page)
    choose(page, photo)
    faults = found.locator(".ws-faults")
    eventually(faults.inner_text, lambda text: "20 teeth as given, but 19 are counted" in text)
    field(page, "Teeth").fill("19")
    measure(page)
    assert measured(page) == pytest.approx(DEPTH, abs=0.03)
    assert not faults.is_visible()
    field(page, "Teeth").fill("2")
    measure(page)
    eventually(faults.inner_text, lambda text: "teeth" in text)


def test_what_is_no_photo_is_refused(watched, serve, tmp_path):
    page = opened(watched, serve(WRAP))
    faults = dialog(page).locator(".ws-faults")
    (tmp_path / "text.jpg").write_text("no picture")
    choose(page, tmp_path / "text.jpg")
    eventually(faults.inner_text, lambda text: "text.jpg: must be a PNG, JPEG or TIFF" in text)
    Image.new("L", (400, 400), 128).save(tmp_path / "grey.png")
    choose(page, tmp_path / "grey.png")
    eventually(faults.inner_text, lambda text: "no two shades" in text)
    (tmp_path / "large.jpg").write_bytes(bytes(64_000_001))
    choose(page, tmp_path / "large.jpg")
    eventually(faults.inner_text, lambda text: "at most 64 MB" in text)


def test_uploads_of_other_sites_and_sizes_are_refused(watched, serve, photo):
    server = serve(WRAP)
    page = opened(watched, server)
    dialog(page)
    with page.expect_request(re.compile("/upload/")) as sent:
        choose(page, photo)
    measured(page)
    path = sent.value.url.partition(str(server.port))[2]

    def status(**headers):
        with contextlib.closing(http.client.HTTPConnection("127.0.0.1", server.port)) as client:
            client.putrequest("POST", path, skip_host="Host" in headers)
            for name, value in headers.items():
                client.putheader(name.replace("_", "-"), value)
            client.endheaders()
            return client.getresponse().status

    assert status(Content_Length="0", Origin="http://evil.example") == 403
    assert status(Content_Length="0", Host=f"evil.example:{server.port}") == 403
    assert status(Content_Length="64000001") == 413
    assert status(Transfer_Encoding="chunked") == 411


def test_marking_ends_when_a_photo_is_measured(watched, serve, photo):
    """By the tooth form after all, while a part is enlarged."""
    page = opened(watched, serve(WRAP))
    found = dialog(page)
    choose(page, photo)
    measured(page)
    field(page, "Scale").click()
    page.get_by_role("option", name="two points").click()
    page.get_by_role("button", name="Mark the points").click()
    hint(page, "near the first")
    shows(page, SIZE[0] // 2)
    click_photo(page, 0.3, 0.5)
    hint(page, "on the first")
    measure(page)
    eventually(found.locator(".ws-faults").inner_text, lambda text: "needs its length" in text)
    hint(page, "near the first")
    field(page, "Scale").click()
    page.get_by_role("option", name="tooth form").click()
    measure(page)
    measured(page)
    assert page.locator(".ws-scan [role=status]").inner_text() == ""
    assert not found.locator(".ws-faults").is_visible()
