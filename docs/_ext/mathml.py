"""Formulas as MathML, which browsers set by themselves: no script and nothing to fetch."""

import re

from docutils import nodes
from latex2mathml.converter import convert
from sphinx.application import Sphinx
from sphinx.writers.html5 import HTML5Translator


def _inline(writer: HTML5Translator, node: nodes.math) -> None:
    writer.body.append(convert(node.astext()))
    raise nodes.SkipNode


def _block(writer: HTML5Translator, node: nodes.math_block) -> None:
    formula, number = node.astext(), ""
    if tag := re.search(r"\\tag\{(.*?)\}", formula):
        formula = formula.replace(tag[0], "")
        names = [f"eq-{name}" for name in tag[1].split(", ")]
        anchors = "".join(f'<span id="{name}"></span>' for name in names)
        number = f'{anchors}<a class="eqno" href="#{names[0]}">({tag[1]})</a>'
    shown = f'<div class="formula">{convert(formula, display="block")}</div>'
    writer.body.append(f'<div class="math">{shown}{number}</div>')
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the renderer ``mathml``."""
    app.add_html_math_renderer("mathml", (_inline, None), (_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
