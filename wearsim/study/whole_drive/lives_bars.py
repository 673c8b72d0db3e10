"""Lives of all parts on one clock as bars, in SVG that is as wide as its page."""

import math
from collections.abc import Iterator

from markupsafe import Markup

from wearsim.geometry.scene import round_length
from wearsim.quantities import grouped
from wearsim.report.answer import hours
from wearsim.report.service import service_measures
from wearsim.result import Life
from wearsim.study.whole_drive.model import DriveLife
from wearsim.study.whole_drive.replacement_plan import plan_hours

_ROW, _BAR, _AXIS = 34, 12, 36
"""Heights of a row, of the bar in it and of the axis [px]."""

_END = 96.0
"""Where the plan ends, in percent of the width."""

_BEYOND = 1.1
"""What is shown at least, over the first life."""

_TIMES = {1: "once", 2: "twice"}

_MOST = 200
"""Bars a row that can still be told apart."""


def lives_bars(found: DriveLife) -> Markup:
    """Return a bar for every part: each stretch is the life of one, up to the end of the plan.

    Where nothing is replaced by then, up to a little more than the first life.
    """
    until = max(plan_hours(found), _BEYOND * found.life.hours_run)
    height = _ROW * len(found.parts) + _AXIS
    alt = f"Bars of the lives of {', '.join(found.parts)} over {grouped(until)} h."
    lines = [
        Markup('<svg class="lives" width="100%" height="{}" role="img" aria-label="{}">').format(height, alt),
        *_rows(found, until),
        *_axis(found, until, _ROW * len(found.parts)),
        Markup("</svg>"),
    ]
    return Markup("\n").join(lines)


def _rows(found: DriveLife, until: float) -> Iterator[Markup]:
    for number, (name, life) in enumerate(found.parts.items()):
        top = _ROW * number
        count = math.floor(until / life.hours * (1.0 + 1e-9)) if isinstance(life, Life) else 0
        again = f", replaced {_TIMES.get(count, f'{count} times')}" if count else ""
        yield Markup('<text x="0" y="{}">{}: {}{}</text>').format(top + 14, name, hours(life), again)
        if isinstance(life, Life) and count < _MOST:
            ends = [min(until, step * life.hours) for step in range(count + 2)]
        else:
            ends = [0.0, min(until, life.hours_run if count == 0 else until)]
        for step, (start, end) in enumerate(zip(ends[:-1], ends[1:], strict=True)):
            look = ("bar", "bar next")[step % 2]
            if not isinstance(life, Life):
                look = "bar open"
            if end > start:
                yield _bar(look, start / until, end / until, top + 19)
        for end in ends[1:-1] if count else ():
            yield _tick("replaced", end / until, top + 17, top + 21 + _BAR)


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
