"""Pages of the documentation in a real browser: the switch of versions, and roots that grow."""

import io
import runpy
import shutil
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
