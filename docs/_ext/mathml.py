"""Formulas as MathML, which browsers set by themselves: no script and nothing to fetch."""

import re
from typing import Literal

from docutils import nodes
from latex2mathml.converter import convert
from sphinx.application import Sphinx
from sphinx.writers.html5 import HTML5Translator

_FUNCTION = "<m[io]>(sin|cos|tan|arcsin|arccos|ln|max|min|gcd)</m[io]>"
_OPENING = "&#x00028;|&#x0005B;"
_SPACES = (
    (rf"{_FUNCTION}(?=<mo[^>]*>(?:{_OPENING}))", r'<mo lspace="0.17em" rspace="0">\1</mo>'),
    (_FUNCTION, r'<mo lspace="0.17em" rspace="0.17em">\1</mo>'),
    (r"<mo([^>]*)>(&#x0007C;|&#x0002F;)", r'<mo\1 lspace="0.06em" rspace="0.06em">\2'),
    (rf"((?:{_OPENING}|&#x0003D;|&#x0002C;)</mo><mo)>&#x02212;", r'\1 form="prefix">&#x02212;'),
)
"""Spaces as in print around functions, bars, slashes and signs, which the converter leaves to the browser."""


def mathml(formula: str, display: Literal["inline", "block"] = "inline") -> str:
    """A formula of LaTeX as MathML."""
    found = convert(formula, display=display)
    for pattern, better in _SPACES:
        found = re.sub(pattern, better, found)
    return found


def _inline(writer: HTML5Translator, node: nodes.math) -> None:
    writer.body.append(mathml(node.astext()))
    raise nodes.SkipNode


def _block(writer: HTML5Translator, node: nodes.math_block) -> None:
    formula, number = node.astext(), ""
    if tag := re.search(r"\\tag\{(.*?)\}", formula):
        formula = formula.replace(tag[0], "")
        names = [f"eq-{name}" for name in tag[1].split(", ")]
        anchors = "".join(f'<span id="{name}"></span>' for name in names)
        number = f'{anchors}<a class="eqno" href="#{names[0]}">({tag[1]})</a>'
    shown = f'<div class="formula">{mathml(formula, "block")}</div>'
    writer.body.append(f'<div class="math">{shown}{number}</div>')
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the renderer ``mathml``."""
    app.add_html_math_renderer("mathml", (_inline, None), (_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
