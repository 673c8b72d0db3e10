"""The answer to a whole drive, from its layout to the lives of all of its parts."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from markupsafe import Markup

from wearsim.case.model import Case
from wearsim.drive.drive_case import DriveCase
from wearsim.drive.drive_result import DriveLife
from wearsim.drive.life import drive_life
from wearsim.drive.load_case import load_drive
from wearsim.drive.maintenance import drive_plan
from wearsim.errors import WearsimError
from wearsim.page.answers import ROUGH_TOLERANCE
from wearsim.page.chart_colours import Palette
from wearsim.page.drive_panel import DrivePanel
from wearsim.page.edited_input import EditedInput, edited_title
from wearsim.page.header import Header
from wearsim.report.drive.drive_drawings import layout_sketch, lives_bars
from wearsim.report.drive.page_tables import wheel_of
from wearsim.report.html.charts import Chart
from wearsim.report.html.tooth_chart import worn_out_chart
from wearsim.report.text_lines import listed
from wearsim.result import Life, LowerBound, WearResult
from wearsim.result.ends import first_hours

_ROUGH_PHASES, _ROUGH_NODES = 2, 101
"""Most of what a first estimate takes of a drive."""


class DriveAnswer:
    """The answer in the place where it is made."""

    def __init__(
        self, header: Header, on_sound: Callable[[Mapping[str, Any]], None], palette: Palette
    ) -> None:
        self._header, self._on_sound = header, on_sound
        self.panel = DrivePanel(palette)
        self.lives: Mapping[str, Life | LowerBound] = {}

    async def find(self, edited: EditedInput) -> dict[str, tuple[Case, WearResult]]:
        """Find the answer and show it step by step; return case and result of every sprocket."""
        drive = await edited.step(lambda: _edited_drive(edited))
        self._on_sound(taken_inputs(drive))
        self.panel.show_layout(await edited.step(lambda: layout_sketch(drive)))
        rough = await edited.step(lambda: _estimate(edited, drive))
        if rough is not None:
            self._header.show_life(f"about {drive_headline(rough)}")
            self._header.show_state("estimate", "first estimate, computing")
        found = await edited.step(lambda: drive_life(drive, progress=edited.watch))
        self.lives = found.parts
        self._header.show_life(drive_headline(found))
        self._header.show_state("drawing", "up to date, drawing")
        self.panel.show_lives(found)
        self.panel.show_pictures(*await edited.step(lambda: _pictures(found)))
        self._header.show_state("current", "up to date")
        cases = {one.name: one.case for one in drive.sprockets}
        return {name: (cases[name], result) for name, result in found.results.items()}


def drive_headline(found: DriveLife) -> str:
    """Return when something is replaced first and what, with the word where the drive is overloaded."""
    text = first_hours(found.ends, found.life) + (f", {found.first} first" if found.first else "")
    if found.failed:
        text += f", nothing known of {listed(list(found.failed))}"
    return f"{text} (overloaded)" if found.overloaded else text


def taken_inputs(drive: DriveCase) -> dict[str, Any]:
    """Return the tables of a drive with what it takes where they give nothing."""
    cases = {
        wheel.name: one.case for one, wheel in zip(drive.sprockets, wheel_of(drive).values(), strict=True)
    }
    sprockets = [
        {**cases[wheel.name].inputs["sprocket"], "name": wheel.name, "role": wheel.role}
        for wheel in drive.wheels
    ]
    return {**drive.driver.case.inputs, "title": drive.title, "sprocket": sprockets}


def _edited_drive(edited: EditedInput) -> DriveCase:
    drive = load_drive(edited.source)
    return replace(drive, title=edited_title(edited.source, edited.file) or drive.title)


def _estimate(edited: EditedInput, drive: DriveCase) -> DriveLife | None:
    """Return first lives, in few phases, on few points and with long steps; none where they fail."""
    case = drive.driver.case
    settings = [
        f"mechanism.phases={min(_ROUGH_PHASES, case.inputs['mechanism']['phases'])}",
        f"run.life_tolerance={max(ROUGH_TOLERANCE, case.run.life_tolerance)}",
    ]
    for number, sprocket in enumerate(taken_inputs(drive)["sprocket"], start=1):
        settings.append(f"sprocket.{number}.nodes={min(_ROUGH_NODES, sprocket['nodes'])}")
    try:
        return drive_life(load_drive(edited.source, settings), progress=edited.check).complete()
    except WearsimError:
        return None


def _pictures(found: DriveLife) -> tuple[Markup, dict[str, Chart]]:
    """Return the lives of all parts as bars, and the flank of every sprocket."""
    charts = {name: worn_out_chart(result) for name, result in found.results.items()}
    return lives_bars(drive_plan(found)), charts
