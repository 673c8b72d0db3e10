"""The marker sheet as a page to print."""

import io
from collections.abc import Iterator
from itertools import pairwise

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from wearsim._version import __version__
from wearsim.scanning.marker_grid import DOT, HOLE, RULER, MarkerSheet, dot_points, is_ring, largest_wheel

_DOTS_PER_INCH = 300
_TEXT, _LINE = 9.0, 5.2
"""Size of letters [points], and distance of lines [mm]."""

_BELOW_DOTS = 12.0
"""Way from the middle of the last row to the ruler [mm]."""


def marker_page(paper: str, form: str) -> bytes:
    """Return the marker sheet in its true size as the content of a file, of `PAGE_FORMATS`."""
    sheet = MarkerSheet(paper)
    width, height = sheet.size
    figure = Figure(figsize=(width / 25.4, height / 25.4))
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set(xlim=(0.0, width), ylim=(0.0, height))
    axes.set_axis_off()
    _draw_dots(axes, sheet)
    base = sheet.origin[1] + float(dot_points(sheet.dots)[:, 1].min()) - _BELOW_DOTS
    left = 0.5 * (width - RULER)
    _draw_ruler(axes, left, base)
    for number, words in enumerate(_words(sheet)):
        axes.text(0.5 * width - 90.0, base - 9.0 - _LINE * number, words, fontsize=_TEXT, va="center")
    stream = io.BytesIO()
    dates = {"pdf": {"CreationDate": None}, "svg": {"Date": None}}
    with mpl.rc_context({"svg.hashsalt": "wearsim"}):
        figure.savefig(stream, format=form, dpi=_DOTS_PER_INCH, metadata=dates.get(form))
    return stream.getvalue()


def _draw_dots(axes: Axes, sheet: MarkerSheet) -> None:
    rings = is_ring(*sheet.dots.T)
    for point, ring in zip(dot_points(sheet.dots) + sheet.origin, rings, strict=True):
        axes.add_patch(Circle(point, DOT, color="black", linewidth=0.0))
        if ring:
            axes.add_patch(Circle(point, HOLE, color="white", linewidth=0.0))


def _draw_ruler(axes: Axes, left: float, base: float) -> None:
    """Draw the ruler from the left edge of its first tick to that of its last one, a tick every 10 mm."""
    places = [left + 0.1 * RULER * tick for tick in range(11)]
    for one, following in pairwise(places):
        axes.plot([one, following], [base, base], color="black", linewidth=0.5)
    for place in places:
        long = 4.0 if place in (places[0], places[-1]) else 2.5
        axes.plot([place, place], [base, base + long], color="black", linewidth=0.5)
    axes.text(places[-1] + 3.0, base + 1.5, f"{RULER:g} mm", fontsize=_TEXT, va="center")


def _words(sheet: MarkerSheet) -> Iterator[str]:
    yield (
        f'1. Print at 100 % (actual size, not "fit to page"). The ruler above must measure {RULER:g} mm; '
        "if it does"
    )
    yield "    not, measure it and give its length to the scan, such as --ruler-mm 99.2."
    yield (
        f"2. Put the sheet on a hard, flat table. Lay the sprocket in the free circle (up to "
        f"{largest_wheel(sheet):g} mm), teeth"
    )
    yield "    flat on the paper, hub up. Leave the dots uncovered."
    yield "3. Photograph from straight above, at least five sprocket diameters away, with all dots in the"
    yield "    picture and without shadows. Do not crop the picture."
    yield f"4. wearsim scan PHOTO --chain 08B          (marker sheet {sheet.paper}, wearsim {__version__})"
