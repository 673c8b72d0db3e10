"""Pages of the documentation in a real browser: the switch of versions, roots that grow, and axe."""

import functools
import io
import runpy
import shutil
import subprocess
import sys
import threading
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest
from PIL import Image

pytestmark = [
    pytest.mark.slow,
    # Of pytest-playwright's own fixture under pytest 9.
    pytest.mark.filterwarnings("ignore:Session-scoped fixtures defined as instance methods"),
]

DOCS = Path(__file__).parents[2] / "docs"
PAGE = """\
<!doctype html><html lang="en" data-content_root="{root}"><meta charset="utf-8">
<link rel="stylesheet" href="{root}_static/math.css">
<script>const DOCUMENTATION_OPTIONS = {{VERSION: "{version}"}};</script>
<script defer src="{root}_static/version_switch.js"></script>
<p>{version}</p>{switch}
<math display="block"><msqrt><mfrac><mi>a</mi><mi>b</mi></mfrac></msqrt></math></html>
"""


@pytest.fixture
def site(tmp_path):
    """Two versions of two pages, one of them a folder deeper; of the older version only the front page."""
    switch = (DOCS / "_templates" / "versions.html").read_text("utf-8")
    for version, pages in (("0.2.0", ("index", "gallery/gauge")), ("0.1.0", ("index",))):
        shutil.copytree(DOCS / "_static", tmp_path / version / "_static")
        for name in pages:
            path = tmp_path / version / f"{name}.html"
            path.parent.mkdir(exist_ok=True)
            root = "../" * name.count("/") or "./"
            path.write_text(PAGE.format(root=root, version=version, switch=switch))
    runpy.run_path(str(DOCS / "site_versions.py"))["write_root"](tmp_path)
    return tmp_path


def test_switch_leads_to_the_other_version(page, site):
    page.goto((site / "0.2.0" / "gallery" / "gauge.html").as_uri())
    choice = page.get_by_label("Version")
    assert choice.locator("option").all_inner_texts() == ["0.2.0", "0.1.0"]
    assert choice.input_value() == "0.2.0"
    choice.select_option("0.1.0")
    page.wait_for_url("**/0.1.0/index.html")
    assert page.locator("p").inner_text() == "0.1.0"


def test_front_page_leads_to_the_newest_version(page, site):
    page.goto((site / "index.html").as_uri())
    page.wait_for_url("**/0.2.0/index.html")


def test_pages_that_stand_alone_have_no_switch(page, site):
    (site / "versions.js").unlink()
    page.goto((site / "0.2.0" / "index.html").as_uri())
    page.wait_for_load_state("networkidle")
    assert page.locator(".versions").is_hidden()


def test_sign_of_a_root_is_as_high_as_the_fraction_under_it(page, site):
    """By its ink; a browser without a maths font takes a sign of one size for all."""
    page.goto((site / "0.2.0" / "index.html").as_uri())
    page.evaluate("document.fonts.ready")
    root, fraction = (page.locator(name).bounding_box() for name in ("msqrt", "mfrac"))
    sign = {**root, "width": fraction["x"] - root["x"]}
    image = Image.open(io.BytesIO(page.screenshot(clip=sign))).convert("L")
    _, top, _, bottom = image.point(lambda grey: 255 * (grey < 128)).getbbox()
    assert bottom - top >= 0.9 * fraction["height"]


FRONT = """\
# Front

```{toctree}
:caption: Learn
other
```

## Deep

A word, zanzibar, that one section has.

## Wide

| a table | of words |
|---|---|
| WORDS | WORDS |

```text
LINE
```

$$LINE$$

![a wide picture](wide.svg)

<table><thead><tr><th></th><th>life_hours</th></tr></thead><tr><th>0</th><td>1</td></tr></table>
"""


@pytest.fixture(scope="module")
def pages(tmp_path_factory):
    """A site of two pages by the configuration, templates and styles of the real one."""
    pytest.importorskip("furo", reason="furo is not installed")
    folder = tmp_path_factory.mktemp("pages")
    front = FRONT.replace("WORDS", "w" * 200).replace("LINE", "a + " * 50 + "a")
    (folder / "wide.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg" width="700" height="9"/>')
    (folder / "index.md").write_text(front)
    (folder / "other.md").write_text("# Other\n")
    build = [sys.executable, "-m", "sphinx", "-q", "-W", "-c", DOCS, folder, folder / "html"]
    subprocess.run(build, check=True)
    return folder / "html"


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [390, 1440])
def test_axe_finds_nothing(page, pages, width, scheme):
    axe = pytest.importorskip(
        "axe_playwright_python.sync_playwright", reason="axe-playwright-python is not installed"
    )
    page.set_viewport_size({"width": width, "height": 900})
    page.emulate_media(color_scheme=scheme)
    for name in ("index", "other", "search", "genindex"):
        page.goto((pages / f"{name}.html").as_uri())
        assert axe.Axe().run(page).response["violations"] == []


def test_what_is_too_wide_scrolls_by_keys(page, pages):
    page.set_viewport_size({"width": 390, "height": 900})
    page.goto((pages / "index.html").as_uri())
    places = page.locator("pre, .table-wrapper, .formula, p:has(> img)")
    page.wait_for_selector("pre[tabindex='0']")
    assert [place.get_attribute("tabindex") for place in places.all()] == ["0"] * 4
    page.locator("pre").focus()
    page.keyboard.press("ArrowRight")
    page.wait_for_function("document.querySelector('pre').scrollLeft > 0")


@pytest.mark.parametrize("width", [390, 1440])
def test_a_page_is_as_wide_as_its_window(page, pages, width):
    page.set_viewport_size({"width": width, "height": 900})
    page.goto((pages / "index.html").as_uri())
    assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_a_picture_keeps_its_size_on_a_telephone(page, pages):
    """Letters of 13 px stay so: a picture of 700 px scrolls in its place."""
    page.set_viewport_size({"width": 390, "height": 900})
    page.goto((pages / "index.html").as_uri())
    assert page.locator("article img").bounding_box()["width"] == 700
    assert page.locator("p:has(> img)").bounding_box()["width"] <= 390


class _Silent(SimpleHTTPRequestHandler):
    """A server that logs nothing."""

    def log_message(self, *_):
        """Write no line of a log."""


@pytest.fixture
def served(pages):
    """Address of the pages on a server: a browser fetches none of a file's neighbours."""
    server = ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(_Silent, directory=pages))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}"
    server.shutdown()
    server.server_close()


def test_search_leads_to_the_section_and_narrows_to_a_part(page, served):
    page.goto(f"{served}/search.html?q=zanzibar")
    link = page.locator(".found-section a")
    link.wait_for()
    assert link.inner_text() == "Deep"
    assert link.get_attribute("href").endswith("index.html#deep")
    page.goto(f"{served}/search.html?q=other")
    page.locator(".found-part").wait_for()
    assert page.locator(".found-part").inner_text() == "Learn"
    assert page.locator(".search > li").first.is_visible()
    page.evaluate("document.querySelector('.search > li').dataset.part = 'Theory'")
    page.get_by_label("Show results of").select_option("Learn")
    assert page.locator(".search > li").first.is_hidden()
