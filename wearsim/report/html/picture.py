"""A still picture inside a page."""

import base64
import io

import matplotlib as mpl
from matplotlib.figure import Figure


def picture(figure: Figure) -> str:
    """Return a figure as a data URI, the same for the same figure.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        The figure.

    Returns
    -------
    str
        An SVG image that no rule of the page reaches into.
    """
    drawn = io.BytesIO()
    with mpl.rc_context({"svg.hashsalt": "wearsim", "svg.fonttype": "none"}):
        figure.savefig(drawn, format="svg", metadata={"Date": None})
    return "data:image/svg+xml;base64," + base64.b64encode(drawn.getvalue()).decode("ascii")
