"""The go/no-go gauge of a case on a sheet to print 1:1, with a bar to check the print."""

import math
import textwrap

import numpy as np

from wearsim._version import __version__
from wearsim.cad.gauge import GaugeOutline, gauge
from wearsim.cad.printed_page import drawing_bytes
from wearsim.case.model import Case
from wearsim.errors import CaseError, Fault, GeometryError
from wearsim.geometry.outline_stretch import arc_about_axis
from wearsim.geometry.scene import Label, Scene, Shape, line, straight_arrow
from wearsim.geometry.wheel_outline import OutlineChain
from wearsim.quantities import grouped
from wearsim.report.flank_view import flanks
from wearsim.report.worn_flank import wheel_shapes
from wearsim.result import Life, WearResult

BAR = 50.0
SQUARE = 10.0
"""Length of the bar and side of the square that check the print [mm]."""

_SHEETS = ((210.0, 297.0), (297.0, 420.0), (420.0, 594.0), (594.0, 841.0), (841.0, 1189.0))
_MARGIN = 15.0
_TEXT, _LINE = 3.0, 5.2
_LETTER = 0.68
"""Height of letters, distance of lines [mm], and width of a letter over its height."""

_ARROW = 12.0
"""Length of the arrow along which the gauge is pushed in [mm]."""

_COARSE = 0.5
"""Depth of a limit [mm] below which paper is too coarse for it."""

_LONGER = 1000.0
"""Times the horizon of a case that the limit of a gauge is looked for in."""

_LAYERS = {
    "gauge": (7, 13, "Continuous"),
    "arrow": (7, 13, "Continuous"),
    "new": (8, 9, "DASHED"),
    "pitch_circle": (8, 9, "DASHDOT"),
    "check": (7, 25, "Continuous"),
    "notes": (7, 13, "Continuous"),
}


def is_worn_out(result: WearResult) -> bool:
    """Return whether a run ends at a limit of its teeth."""
    return isinstance(result.parts.get("sprocket", result.life), Life)


def long_enough(case: Case) -> Case:
    """Return a case with a horizon within which a limit of its teeth is met, if ever one is."""
    return case.with_horizon(_LONGER * case.run.horizon_hours)


def gauge_sheet(case: Case, result: WearResult, form: str) -> bytes:
    """Return the gauge of a case as the content of a file."""
    if not is_worn_out(result):
        message = (
            f"a gauge needs a tooth limit that is reached, but none is within "
            f"{grouped(result.hours_run)} h: lower the limit, or give one under [stop]"
        )
        raise CaseError([Fault(message, "stop", case.name)])
    return drawing_bytes(_sheet_scene(case, result), _LAYERS, form, f"Gauge: {case.title}")


def _sheet_scene(case: Case, result: WearResult) -> Scene:
    """The sheet, its lower left corner at (0, 0)."""
    gauges = [gauge(shape) for shape in wheel_shapes(case, result)]
    width, height, rows = _sheet(gauges, _text(case, result, gauges))
    drawn: list[Shape] = []
    top = height - _MARGIN
    for one in gauges:
        left, bottom, wide, tall = one.box
        drawn += _placed(one, (0.5 * (width - wide) - left, top - bottom - tall))
        top -= tall + 12.0
    base = _MARGIN + _LINE * len(rows)
    drawn += [_label(words, _MARGIN, base - _LINE * number) for number, words in enumerate(rows, 1)]
    return Scene((0.0, 0.0, width, height), (*drawn, *_check(_MARGIN, base + 8.0)))


def _label(text: str, x: float, y: float) -> Label:
    return Label("notes", text, (x, y), _TEXT)


def _sheet(gauges: list[GaugeOutline], text: list[str]) -> tuple[float, float, list[str]]:
    """Width and height of the smallest sheet, and the text in its lines."""
    wide = max(one.box[2] for one in gauges)
    tall = sum(one.box[3] + 12.0 for one in gauges)
    for width, height in _SHEETS:
        letters = int((width - 2.0 * _MARGIN) / (_TEXT * _LETTER))
        lines = [line for words in text for line in textwrap.wrap(words, letters)]
        below = _LINE * len(lines) + 8.0 + SQUARE + 8.0
        if wide <= width - 2.0 * _MARGIN and tall + below <= height - 2.0 * _MARGIN:
            return width, height, lines
    raise GeometryError(
        f"gauge: must fit on a sheet of {_SHEETS[-1][0]:g} by {_SHEETS[-1][1]:g} mm, is {wide:.0f} by "
        f"{tall:.0f} mm: use --out with --state worn instead"
    )


def _placed(one: GaugeOutline, shift: tuple[float, float]) -> list[Shape]:
    left, bottom, wide, tall = one.box
    x, y = shift[0] + left, shift[1] + bottom + tall - 6.0
    name = [] if one.name == "sprocket" else [_label(one.name, x + wide + 5.0, y)]
    return [
        one.outline.moved(shift).stroke("gauge"),
        *(chain.moved(shift).stroke("new") for chain in one.new),
        _pitch_arc(one).moved(shift).stroke("pitch_circle"),
        *_way_in((shift[0], y - 1.0), one.slant),
        _label("W", x + 4.0, y),
        _label("U", x + wide - 7.0, y),
        *name,
    ]


def _way_in(centre: tuple[float, float], slant: float) -> tuple[Shape, Shape]:
    """Arrow through a point, along the way in."""
    x, y = 0.5 * _ARROW * math.sin(slant), 0.5 * _ARROW * math.cos(slant)
    return straight_arrow((centre[0] + x, centre[1] + y), (centre[0] - x, centre[1] - y), 3.0)


def _pitch_arc(one: GaugeOutline) -> OutlineChain:
    """Pitch circle across the gauge."""
    half = min(0.5 * one.box[2] / one.pitch_radius, 1.0)
    x, y = one.pitch_radius * math.sin(half), one.pitch_radius * math.cos(half)
    ends = np.array([[x, y], [-x, y]])
    return OutlineChain(arc_about_axis("pitch_circle", ends[0], ends[1]), (1,), False)


def _check(x: float, y: float) -> list[Shape]:
    """Bar of 50 mm with a tick every 10 mm, and a square of 10 mm."""
    ticks = [(x + 10.0 * tick, 5.0 if tick in (0, 5) else 3.0) for tick in range(6)]
    left, right = x + BAR + 25.0, x + BAR + 25.0 + SQUARE
    return [
        line("check", [(x, y), (x + BAR, y)]),
        *(line("check", [(place, y), (place, y + high)]) for place, high in ticks),
        _label(f"{BAR:g} mm", x + BAR + 3.0, y),
        line("check", [(left, y), (right, y), (right, y + SQUARE), (left, y + SQUARE)], closed=True),
        _label(f"{SQUARE:g} x {SQUARE:g} mm", right + 3.0, y),
    ]


def _text(case: Case, result: WearResult, gauges: list[GaugeOutline]) -> list[str]:
    depth = float(flanks(result, -1)["depth_mm"].max())
    coarse = (
        f" {depth:.2g} mm is too little for paper to show reliably: have it cut from the DXF file."
        if depth < _COARSE
        else ""
    )
    return [
        f"Go/no-go gauge of wear: {case.title} (case {case.name}; {case.drive.teeth_in_words(case)})",
        f"Worn out at {_limit(case, result)}, {depth:.3g} mm of wear at the deepest point. There the gauge "
        f"has the shape of such a gap; elsewhere side W clears the new tooth by {gauges[0].clearance:.2g} "
        "mm.",
        "1. Print at 100 % (actual size, no fit to page). The bar must measure 50 mm and the square 10 mm "
        "by 10 mm, otherwise do not use this sheet.",
        f"2. Cut stiff paper or sheet metal along the middle of the solid line.{coarse} Clean the teeth.",
        f"3. Push it in from above along the arrow{_slants(gauges)}: edge W to the side of the gap that "
        "carries the load, edge U to the other, both shoulders on the tips. Check the most worn gap."
        f"{_edge(gauges)}",
        "4. Good: it does not go in far enough for both shoulders to touch the tips. Worn out, replace: "
        "both shoulders touch the tips; light along W then shows wear beyond the limit.",
        f"Dashed: the new tooth. Dash-dotted: the pitch circle. wearsim {__version__}",
    ]


def _slants(gauges: list[GaugeOutline]) -> str:
    """How far the way in slants, in words."""
    steepest = max(one.slant for one in gauges)
    return f", slanting by {math.degrees(steepest):.0f} degrees towards W" if steepest else ""


def _edge(gauges: list[GaugeOutline]) -> str:
    """What a rounded tip does to a gauge that touches no more of the tooth that is not loaded."""
    if not any(one.on_edge for one in gauges):
        return ""
    return " It touches the edge of tip U: if that is rounded, it shows more wear than there is."


def _limit(case: Case, result: WearResult) -> str:
    """The limit that ends the life of the teeth, in words."""
    name, value = result.stop, result.stop_value
    if name == "elongation_percent":
        name, value = _sprocket_limit(case, result)
    if name == "min_slack_tension_N":
        return "the wear at which the chain jumps"
    quantity, _, unit = name.rpartition("_")
    return f"the limit {quantity.replace('_', ' ')} = {value:.4g} {unit}"


def _sprocket_limit(case: Case, result: WearResult) -> tuple[str, float]:
    """The limit of the sprocket where the chain's comes before."""
    last = flanks(result, -1)
    columns = [last[name] for name in ("x_mm", "y_mm", "depth_mm")]
    kinds = [last["gap_kind"] == kind for kind in set(last["gap_kind"].tolist())]
    margins = [
        (stop_limit.margin(*(column[kind] for column in columns)) / stop_limit.limit, stop_limit)
        for stop_limit in case.drive.tooth_limits(case)
        for kind in kinds
    ]
    least, stop_limit = min(margins, key=lambda pair: pair[0])
    if least < 1e-3:
        return stop_limit.name, stop_limit.limit
    if "over_pins_change_mm" in case.more_limits:
        return "over_pins_change_mm", case.more_limits["over_pins_change_mm"]
    return "min_slack_tension_N", 0.0
