"""Equation numbers as links: from the text, from docstrings, and in the list of what computes them."""

import re
from pathlib import Path
from typing import Any

from citations import CITATION, Equation, citations, equations
from docutils import nodes
from docutils.parsers.rst import Directive
from sphinx import addnodes
from sphinx.application import Sphinx
from sphinx.transforms import SphinxTransform

import wearsim

_NUMBER = re.compile(r"\((\w+)\)")
_OPAQUE = (nodes.literal, nodes.math, nodes.reference, nodes.FixedTextElement, nodes.title)


def anchor(number: str) -> str:
    """Id of an equation on its page."""
    return f"eq-{number}"


def label(equation: Equation) -> str:
    """Label of an equation in all pages."""
    return f"equation-{equation.page}-{equation.number}".lower()


def _link(equation: Equation, text: str) -> addnodes.pending_xref:
    """A reference that Sphinx resolves; it warns where there is no such equation."""
    return addnodes.pending_xref(
        "",
        nodes.inline(text=text),
        refdomain="std",
        reftype="ref",
        reftarget=label(equation),
        refexplicit=True,
        refwarn=True,
    )


class EquationNumbers(SphinxTransform):
    """Numbers of a page's own equations and citations of others become links, in table cells anchors."""

    default_priority = 800

    def apply(self, **kwargs: Any) -> None:
        """Register the equations of the page and link their numbers."""
        page = self.env.docname
        own = {e.number for e in equations(Path(self.app.srcdir)) if e.page == page}
        labels = self.env.domains.standard_domain.anonlabels
        labels |= {label(Equation(page, number)): (page, anchor(number)) for number in own}
        for text in list(self.document.findall(nodes.Text)):
            if not any(isinstance(above, _OPAQUE) for above in _above(text)):
                _replace(text, page, own)


def _above(node: nodes.Node) -> list[nodes.Node]:
    return [] if node.parent is None else [node.parent, *_above(node.parent)]


def _replace(text: nodes.Text, page: str, own: set[str]) -> None:
    """Put links and anchors in the place of the numbers in a piece of text."""
    whole, parent = text.astext(), text.parent
    elsewhere = {
        number.start(): Equation(citation[1], number[1])
        for citation in CITATION.finditer(whole)
        for number in _NUMBER.finditer(whole, citation.start(), citation.end())
    }
    at, new = 0, []
    place = parent.index(text)
    is_cell = isinstance(parent.parent, nodes.entry) and isinstance(parent[max(place - 1, 0)], nodes.math)
    for match in _NUMBER.finditer(whole):
        if match[1] not in own and match.start() not in elsewhere:
            continue
        new.append(nodes.Text(whole[at : match.start()]))
        if is_cell and match.end() == len(whole):
            new.append(nodes.inline(text=match[0], ids=[anchor(match[1])]))
        else:
            equation = elsewhere.get(match.start(), Equation(page, match[1]))
            new.append(_link(equation, match[0]))
        at = match.end()
    if new:
        parent[place : place + 1] = [*new, nodes.Text(whole[at:])]


class EquationIndex(Directive):
    """What computes each equation, page by page."""

    def run(self) -> list[nodes.Node]:
        """Return a list for every page with numbered equations."""
        env = self.state.document.settings.env
        known = citations(Path(wearsim.__file__).parent)
        found: list[nodes.Node] = []
        pages: dict[str, list[Equation]] = {}
        for equation in equations(Path(env.srcdir)):
            if equation in known:
                pages.setdefault(equation.page, []).append(equation)
        for page, own in pages.items():
            found.append(nodes.rubric(text=f"{page}.md"))
            lines = nodes.bullet_list()
            for equation in own:
                line = nodes.paragraph("", "", _link(equation, f"({equation.number})"))
                for index, name in enumerate(known[equation]):
                    line += nodes.Text(", " if index else " ")
                    line += nodes.literal(text=name)
                lines += nodes.list_item("", line)
            found.append(lines)
        return found


def _cite(app: Sphinx, what: str, name: str, thing: Any, options: Any, lines: list[str]) -> None:
    """Turn citations in a docstring into references."""

    def links(match: re.Match[str]) -> str:
        return _NUMBER.sub(lambda n: f":ref:`{n[0]} <{label(Equation(match[1], n[1]))}>`", f"{match[0]}")

    lines[:] = [CITATION.sub(links, line) for line in lines]


def setup(app: Sphinx) -> dict[str, bool]:
    """Register links, list and docstrings."""
    app.add_transform(EquationNumbers)
    app.add_directive("equation-index", EquationIndex)
    app.connect("autodoc-process-docstring", _cite)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
