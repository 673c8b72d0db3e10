"""Drawings of a drive in SVG: its layout to scale, and the lives of all parts on one clock as bars."""

import math
from collections.abc import Iterator
from itertools import pairwise

from markupsafe import Markup

from wearsim.drive.drive_case import DriveCase
from wearsim.drive.maintenance import DrivePlan
from wearsim.geometry.scene import Circle, round_length
from wearsim.mechanisms.wrap.loop_scene import loop_scene
from wearsim.quantities import grouped
from wearsim.report.drive.layout import drive_forces, loop_names
from wearsim.report.drive.page_tables import wheel_of
from wearsim.report.html.sketch import sketch
from wearsim.result.lives import hours, service_measures

_ROW, _BAR, _AXIS = 29, 9, 36
"""Heights of a row, of the bar in it and of the axis [px]."""

_END = 96.0
"""Where the plan ends, in percent of the width."""

_BEYOND = 1.05
"""What is shown over the longest life."""

_TIMES = {1: "once", 2: "twice"}


def flank_place(number: int) -> str:
    """Return the place on a page where the flank of a sprocket is shown, by its number from 1."""
    return f"flank-{number}"


def layout_sketch(drive: DriveCase) -> Markup:
    """Return the drawing of the loop; a click on a sprocket leads to its flank, of a cassette the first."""
    forces = drive_forces(drive)
    of = [wheel.name for wheel in wheel_of(drive).values()]
    links = [
        (
            flank_place(of.index(name) + 1),
            Circle("link", (float(x), float(y)), float(radius), f"flank of {name}"),
        )
        for name, (x, y), radius in zip(
            loop_names(drive), forces.loop.centres, forces.loop.pitch_radii, strict=True
        )
        if name in of  # a smooth idler has no flank
    ]
    return sketch(loop_scene(forces, 0.5 * drive.driver.drive.chain.roller_diameter), links)


def lives_bars(plan: DrivePlan) -> Markup:
    """Return a bar for every part: each stretch is one of them, dashed where nothing is known of it."""
    until = _shown_hours(plan)
    height = _ROW * len(plan.lives) + _AXIS
    alt = f"Bars of the lives of {', '.join(plan.lives)} over {grouped(until)} h."
    lines = [
        Markup('<svg class="lives" width="100%" height="{}" role="img" aria-label="{}">').format(height, alt),
        *_rows(plan, until),
        *_axis(plan, until, _ROW * len(plan.lives)),
        Markup("</svg>"),
    ]
    return Markup("\n").join(lines)


def _shown_hours(plan: DrivePlan) -> float:
    """Return the time that the bars cover: the plan, and beyond it a life of every part if that is known."""
    longest = max((stop.hours for stop in plan.first_stops), default=0.0)
    return min(plan.known, max(plan.until, _BEYOND * longest))


def _rows(plan: DrivePlan, until: float) -> Iterator[Markup]:
    for number, (name, life) in enumerate(plan.lives.items()):
        top = _ROW * number
        stops = [stop.hours for stop in plan.best.schedule if name in stop.parts and stop.hours <= until]
        count = len(stops)
        again = f", replaced {_TIMES.get(count, f'{count} times')}" if count else ""
        yield Markup('<text x="0" y="{}">{}: {}{}</text>').format(top + 13, name, hours(life), again)
        open_end = name in plan.best.at_most and life.hours_run < until
        end = life.hours_run if open_end else until
        for step, (start, stop) in enumerate(pairwise([0.0, *stops, end])):
            if stop > start:
                yield _bar(("bar", "bar next")[step % 2], start / until, stop / until, top + 17)
        if open_end:
            yield _bar("bar open", end / until, 1.0, top + 17)
        for stop in stops:
            yield _tick("replaced", stop / until, top + 15, top + 19 + _BAR)


def _bar(look: str, start: float, end: float, top: int) -> Markup:
    x, width = _END * start, _END * (end - start)
    return Markup('<rect class="{}" x="{:.3f}%" y="{}" width="{:.3f}%" height="{}"/>').format(
        look, x, top, width, _BAR
    )


def _tick(look: str, part: float, top: int, bottom: int) -> Markup:
    x = f"{_END * part:.3f}%"
    return Markup('<line class="{0}" x1="{1}" y1="{2}" x2="{1}" y2="{3}"/>').format(look, x, top, bottom)


def _axis(plan: DrivePlan, until: float, top: int) -> Iterator[Markup]:
    step = round_length(0.5 * until)
    for count in range(math.floor(until / step * (1.0 + 1e-9)) + 1):
        at = count * step
        yield _tick("axis", at / until, top, top + 5)
        day = service_measures(plan.drive.driver.case.inputs, at).get("date")
        anchor = "start" if count == 0 else "end" if at > 0.9 * until else "middle"
        text = Markup('<text class="axis" x="{:.3f}%" y="{}" text-anchor="{}">{}</text>')
        yield text.format(_END * at / until, top + 18, anchor, f"{grouped(at)} h" if at else "0")
        if day:
            yield text.format(_END * at / until, top + 32, anchor, day)
    yield Markup('<line class="axis" x1="0" y1="{0}" x2="{1}%" y2="{0}"/>').format(top, _END)
