"""The pages as files in a folder."""

import hashlib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from markupsafe import Markup
from plotly.offline import get_plotlyjs

from wearsim._version import __version__
from wearsim.files import file_names, new_folder, write_file
from wearsim.report.html.environment import environment
from wearsim.report.html.page_content import case_page, comparison_page
from wearsim.report.html.paper import SheetHead
from wearsim.report.html.pdf import is_page, is_pdf, save_pdf
from wearsim.result import WearResult

_HERE = Path(__file__).parent
_SCRIPT = "plotly.min.js"


def save_report(
    results: Sequence[WearResult],
    out: Path,
    force: bool,
    single_file: bool,
    detail: str,
    head: SheetHead | None = None,
) -> list[Path]:
    """Write a page for each result, and one that compares them where there are several; return the files.

    They lie in a new folder; the page of a single result may be one file, *.html or *.pdf.
    """
    names = file_names([result.case for result in results])
    brief = detail == "brief"
    pages = {
        f"{name}.html": ("case.html.j2", case_page(result, name, brief, head))
        for name, result in zip(names, results, strict=True)
    }
    if is_pdf(out):
        ((template, page),) = pages.values()
        save_pdf(render(template, page, single_file=False, several=False), out, force)
        return [out]
    if is_page(out):
        ((template, page),) = pages.values()
        write_file(out, render(template, page, single_file=True, several=False), force)
        return [out]
    written: dict[str, tuple[str, Any]] = dict(pages)
    if len(results) == 1:
        written = {"index.html": pages[f"{names[0]}.html"]}
    else:
        written = {"index.html": ("comparison.html.j2", comparison_page(results, names)), **pages}
    with new_folder(out, force) as place:
        for file, (template, page) in written.items():
            text = render(template, page, single_file, several=len(results) > 1)
            (place / file).write_text(text, encoding="utf-8", newline="\n")
        if not single_file:
            (place / _SCRIPT).write_text(get_plotlyjs(), encoding="utf-8", newline="\n")
    return [out / file for file in written]


def render(template: str, page: Any, single_file: bool, several: bool) -> str:
    """Return a page as HTML."""
    own = (_HERE / "report.js").read_text(encoding="utf-8")
    charts = [*getattr(page, "tooth", ()), *page.charts]
    content = {chart.name: chart.content for chart in charts}
    # Not to be guessed by whoever writes a title: it follows from all that the page holds.
    nonce = hashlib.sha256(repr((__version__, content, page)).encode()).hexdigest()[:32]
    return (
        environment()
        .get_template(template)
        .render(
            page=page,
            content=content,
            version=__version__,
            several=several,
            nonce=nonce,
            style=Markup((_HERE / "style.css").read_text(encoding="utf-8")),  # noqa: S704
            script=Markup(own),  # noqa: S704
            plotly=Markup(get_plotlyjs()) if single_file else None,  # noqa: S704
            plotly_file=_SCRIPT,
        )
    )
