"""A still picture inside a page."""

import base64
import io
import re

import matplotlib as mpl
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

_PATH = re.compile(r'(?<=\sd=")[^"]*')


def picture(figure: Figure) -> str:
    """Return a figure as a data URI, the same for the same figure."""
    drawn = io.BytesIO()
    with mpl.rc_context({"svg.hashsalt": "wearsim", "svg.fonttype": "none"}):
        _lay_out(figure)
        figure.savefig(drawn, format="svg", metadata={"Date": None})
    lean = _PATH.sub(_two_decimals, drawn.getvalue().decode("utf-8"))
    return "data:image/svg+xml;base64," + base64.b64encode(lean.encode("utf-8")).decode("ascii")


def _lay_out(figure: Figure) -> None:
    """Place the panels as savefig would, which draws all of them once more to do so."""
    FigureCanvasSVG(figure)
    figure.dpi = 72  # of SVG
    engine = figure.get_layout_engine()
    if engine is not None:
        engine.execute(figure)
    figure.set_layout_engine(None)


def _two_decimals(path: re.Match[str]) -> str:
    """Points to a hundredth of a point, which is finer than any print."""
    return re.sub(r"(\.\d\d)\d+", r"\1", path[0])
