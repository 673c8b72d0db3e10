"""A page as PDF: the browser that prints it, the foot of its pages, and what is said where there is none."""

import os
from datetime import date

import pytest

from wearsim.errors import OutputError
from wearsim.report.html import pdf
from wearsim.report.html.paper import SheetHead, foot

PRINTS = """\
#!/bin/sh
for one; do case "$one" in --print-to-pdf=*) out="${one#*=}";; file://*) page="${one#file://}";; esac; done
{ printf '%%PDF of '; cat "$page"; } > "$out"
"""
FAILS = "#!/bin/sh\necho 'no display' >&2\nexit 21\n"

needs_sh = pytest.mark.skipif(os.name == "nt", reason="the stand-in for a browser is a script of sh")


@pytest.fixture
def browser(tmp_path, monkeypatch):
    """Function that puts a script in the place of the browser."""
    monkeypatch.setattr(pdf, "_PLACES", {})

    def put(text):
        folder = tmp_path / "bin"
        folder.mkdir()
        (folder / "chromium").write_text(text)
        (folder / "chromium").chmod(0o755)
        monkeypatch.setenv("PATH", f"{folder}{os.pathsep}{os.environ['PATH']}")

    return put


@needs_sh
def test_the_page_is_printed_and_nothing_stays_beside_it(browser, tmp_path):
    browser(PRINTS)
    out = tmp_path / "new" / "sheet.pdf"
    pdf.check_pdf(out, force=False)
    pdf.save_pdf("<p>°</p>", out, force=False)
    assert out.read_text(encoding="utf-8") == "%PDF of <p>°</p>"
    assert list(out.parent.iterdir()) == [out]
    with pytest.raises(OutputError, match="--force"):
        pdf.save_pdf("<p>2</p>", out, force=False)


@needs_sh
def test_a_browser_that_fails_is_named_and_leaves_nothing(browser, tmp_path):
    browser(FAILS)
    out = tmp_path / "sheet.pdf"
    with pytest.raises(OutputError, match=r"must print the page.*exit code 21, no display.*sheet\.html"):
        pdf.save_pdf("x", out, force=False)
    assert not out.exists() and not list(tmp_path.glob("wearsim-print-*"))


def test_without_a_browser_it_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setattr(pdf, "_PLACES", {})
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(OutputError, match=r"printed by Chromium, Chrome or Edge, and none is installed"):
        pdf.check_pdf(tmp_path / "sheet.pdf", force=False)


def test_the_foot_names_the_revision_and_counts_pages():
    head = SheetHead(date(2026, 11, 24), "Line 4", "A. Author", 'D"17', "B", "C. Hecker")
    style = foot("No. 7 </style>", head)
    assert 'content: "No. 7 \\3c \\2f style\\3e  | D\\22 17 | revision B | 2026-11-24"' in style
    assert 'content: "page " counter(page) " of " counter(pages)' in style
    assert head.rows == [
        ("project", "Line 4"),
        ("drawing", 'D"17'),
        ("revision", "B"),
        ("author", "A. Author"),
        ("checked by", "C. Hecker"),
        ("date", "2026-11-24"),
    ]
