"""The site: its versions, its links, the install page, and the font that formulas need."""

import re
import runpy
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from fontTools.ttLib import TTFont

import wearsim

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
LINKS = runpy.run_path(str(ROOT / ".ci" / "links.py"))


@pytest.fixture
def site(tmp_path):
    """A site of four versions, and a folder that is none."""
    for name in ("0.2.0", "0.10.0", "0.9.1", "1.0.0rc1", "_static"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "index.html").touch()
    return tmp_path


def test_newest_version_is_first_and_the_front_page_leads_to_the_newest_release(site):
    runpy.run_path(str(DOCS / "site_versions.py"))["write_root"](site)
    listed = (site / "versions.js").read_text()
    assert listed == 'window.siteVersions = ["1.0.0rc1", "0.10.0", "0.9.1", "0.2.0"];\n'
    assert 'url=0.10.0/index.html"' in (site / "index.html").read_text()


@pytest.mark.parametrize(
    ("link", "lost"),
    [
        ("b.html", False),
        ("b.html#there", False),
        ("#here", False),
        ("https://example.org/none", False),
        ("c.html", True),
        ("b.html#elsewhere", True),
        ("#nowhere", True),
    ],
)
def test_link_that_leads_nowhere_is_found(tmp_path, link, lost):
    at, other = tmp_path / "a.html", tmp_path / "b.html"
    at.write_text(f'<p id="here"><a href="{link}">x</a></p>')
    other.write_text('<p id="there"></p>')
    pages = {path: LINKS["Page"](path) for path in (at, other)}
    assert pages[at].links == [link]
    assert LINKS["broken"](at, link, pages) is lost


def test_install_page_has_every_extra():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    table = (DOCS / "installation.md").read_text("utf-8").split("## Extras")[1].split("\n## ")[0]
    first_cells = [row.split("|")[1] for row in table.splitlines() if row.startswith("| `")]
    stated = [name for cell in first_cells for name in cell.replace("`", "").replace(",", " ").split()]
    assert sorted(stated) == sorted(project["optional-dependencies"])


def test_every_page_of_the_gallery_is_in_its_list_and_has_a_picture():
    listed = [
        line for line in (DOCS / "gallery.md").read_text("utf-8").splitlines() if line.startswith("gallery/")
    ]
    pages = sorted((DOCS / "gallery").glob("*.md"))
    assert sorted(listed) == [f"gallery/{page.stem}" for page in pages]
    assert [page.name for page in pages if "```{picture} " not in page.read_text("utf-8")] == []


def test_font_of_the_formulas_can_draw_roots_and_comes_with_its_licence():
    folder = DOCS / "_static" / "maths-font"
    (file,) = re.findall(r'url\("maths-font/(.+?)"\)', (DOCS / "_static" / "math.css").read_text("utf-8"))
    font = TTFont(folder / file)
    growing = font["MATH"].table.MathVariants.VertGlyphCoverage.glyphs
    assert {font.getBestCmap()[ord(sign)] for sign in "\u221a()[]|"} <= set(growing)
    assert "SIL OPEN FONT LICENSE" in (folder / "OFL.txt").read_text("utf-8")


def test_commands_are_shown_and_not_their_source(tmp_path):
    """sphinx-click writes reStructuredText, which stays raw where a fence of Markdown reads it."""
    pytest.importorskip("furo", reason="furo is not installed")
    shutil.copy(DOCS / "commands.md", tmp_path / "index.md")
    build = [sys.executable, "-m", "sphinx", "-q", "-W", "-c", DOCS, tmp_path, tmp_path / "html"]
    subprocess.run(build, check=True)
    page = (tmp_path / "html" / "index.html").read_text("utf-8")
    assert ".. option::" not in page
    assert 'id="cmdoption-wearsim-life-set"' in page
    text = re.sub(r"<.*?>", "", page)
    assert "--out writes result.json" in text
    assert "wearsim life 16b-20t-oiled --explain\n" in text


def test_every_public_name_stands_on_one_page_of_a_topic():
    pages = sorted((DOCS / "api").glob("*.md"))
    shown = [
        name
        for page in pages
        for name in re.findall(r"^\.\. auto(?:function|class):: (\w+)$", page.read_text("utf-8"), re.M)
    ]
    assert sorted(shown) == sorted(set(wearsim.__all__) - {"__version__"})
    index = (DOCS / "python.md").read_text("utf-8").split("## All names")[1]
    assert sorted(re.findall(r"^api/(\w+)$", index, re.M)) == [page.stem for page in pages]
    rows = dict(re.findall(r"^\| \[.*?\]\(api/(\w+)\.md\) \| (.*) \|$", index, re.M))
    for page in pages:
        names = re.findall(r"^\.\. auto(?:function|class):: (\w+)$", page.read_text("utf-8"), re.M)
        assert not names or re.findall(r"`(\w+)`", rows[page.stem]) == names
