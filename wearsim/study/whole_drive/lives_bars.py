"""Lives of all parts on one clock as bars, in SVG that is as wide as its page."""

import math
from collections.abc import Iterator
from itertools import pairwise

from markupsafe import Markup

from wearsim.geometry.scene import round_length
from wearsim.quantities import grouped
from wearsim.report.answer import hours
from wearsim.report.service import service_measures
from wearsim.result import Life
from wearsim.study.whole_drive.model import DriveLife
from wearsim.study.whole_drive.replacement_plan import plan_hours

_ROW, _BAR, _AXIS = 29, 9, 36
"""Heights of a row, of the bar in it and of the axis [px]."""

_END = 96.0
"""Where the plan ends, in percent of the width."""

_BEYOND = 1.05
"""What is shown over the longest life."""

_TIMES = {1: "once", 2: "twice"}

_MOST = 25
"""Lives of the part that is replaced most often that are shown at most."""


def lives_bars(found: DriveLife) -> Markup:
    """Return a bar for every part: each stretch is the life of one, dashed where nothing is known of it."""
    until = _shown_hours(found)
    height = _ROW * len(found.parts) + _AXIS
    alt = f"Bars of the lives of {', '.join(found.parts)} over {grouped(until)} h."
    lines = [
        Markup('<svg class="lives" width="100%" height="{}" role="img" aria-label="{}">').format(height, alt),
        *_rows(found, until),
        *_axis(found, until, _ROW * len(found.parts)),
        Markup("</svg>"),
    ]
    return Markup("\n").join(lines)


def _shown_hours(found: DriveLife) -> float:
    """Return the time that the bars cover: the plan, and beyond it the lives of all parts if they fit in."""
    ended = [life.hours for life in found.parts.values() if isinstance(life, Life)]
    lives = min(_BEYOND * max(ended), _MOST * min(ended)) if ended else 0.0
    return max(plan_hours(found), lives)


def _rows(found: DriveLife, until: float) -> Iterator[Markup]:
    for number, (name, life) in enumerate(found.parts.items()):
        top = _ROW * number
        count = math.floor(until / life.hours * (1.0 + 1e-9)) if isinstance(life, Life) else 0
        again = f", replaced {_TIMES.get(count, f'{count} times')}" if count else ""
        yield Markup('<text x="0" y="{}">{}: {}{}</text>').format(top + 13, name, hours(life), again)
        ends = [min(until, step * life.hours_run) for step in range(count + 2)]
        for step, (start, end) in enumerate(pairwise(ends)):
            if end > start:
                yield _bar(("bar", "bar next")[step % 2], start / until, end / until, top + 17)
        if not isinstance(life, Life) and ends[-1] < until:
            yield _bar("bar open", ends[-1] / until, 1.0, top + 17)
        for end in ends[1:-1]:
            yield _tick("replaced", end / until, top + 15, top + 19 + _BAR)


def _bar(look: str, start: float, end: float, top: int) -> Markup:
    x, width = _END * start, _END * (end - start)
    return Markup('<rect class="{}" x="{:.3f}%" y="{}" width="{:.3f}%" height="{}"/>').format(
        look, x, top, width, _BAR
    )


def _tick(look: str, part: float, top: int, bottom: int) -> Markup:
    x = f"{_END * part:.3f}%"
    return Markup('<line class="{0}" x1="{1}" y1="{2}" x2="{1}" y2="{3}"/>').format(look, x, top, bottom)


def _axis(found: DriveLife, until: float, top: int) -> Iterator[Markup]:
    step = round_length(0.5 * until)
    for count in range(math.floor(until / step * (1.0 + 1e-9)) + 1):
        at = count * step
        yield _tick("axis", at / until, top, top + 5)
        day = service_measures(found.drive.inputs, at).get("date")
        anchor = "start" if count == 0 else "end" if at > 0.9 * until else "middle"
        text = Markup('<text class="axis" x="{:.3f}%" y="{}" text-anchor="{}">{}</text>')
        yield text.format(_END * at / until, top + 18, anchor, f"{grouped(at)} h" if at else "0")
        if day:
            yield text.format(_END * at / until, top + 32, anchor, day)
    yield Markup('<line class="axis" x1="0" y1="{0}" x2="{1}%" y2="{0}"/>').format(top, _END)
