"""The answer to a whole drive: its layout and flanks, lives, ratings, and what all of it rests on."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from markupsafe import Markup
from nicegui import ui

from wearsim.case.model import Case
from wearsim.drive.drive_case import DriveCase
from wearsim.drive.drive_result import DriveLife
from wearsim.drive.life import drive_life
from wearsim.drive.load_case import load_drive
from wearsim.drive.maintenance import drive_plan
from wearsim.errors import WearsimError
from wearsim.page.answer_panel import rating_list
from wearsim.page.answers import ROUGH_TOLERANCE
from wearsim.page.chart_colours import Palette
from wearsim.page.chart_view import ChartView, LinkedDrawing
from wearsim.page.edited_input import EditedInput, edited_title
from wearsim.page.header import Header
from wearsim.page.text_elements import assumption_list, heading, row_list, warning_list
from wearsim.report.drive.drive_drawings import flank_place, layout_sketch, lives_bars
from wearsim.report.drive.drive_words import (
    band_text,
    first_text,
    part_findings,
    ratings_text,
    taken_for_granted,
    worn_most_text,
)
from wearsim.report.drive.page_tables import wheel_of
from wearsim.report.html.charts import Chart
from wearsim.report.html.tooth_chart import worn_out_chart
from wearsim.report.text_lines import listed, unbroken
from wearsim.result import Life, LowerBound, WearResult
from wearsim.result.ends import first_hours


class DrivePanel:
    """The answer in the place where it is made."""

    def __init__(self, palette: Palette) -> None:
        self._palette = palette
        self._flanks: Mapping[str, Chart] = {}
        self._names: list[str] = []  # of all sprockets, those that have no flank too
        self._flank: ChartView | None = None
        self._life = ui.element("section").classes("ws-life-card ws-card")
        with ui.element("div").classes("ws-pair") as self._drive:
            self._layout = LinkedDrawing("Layout, to scale: choose a sprocket", self._choose_place)
            self._tooth = ui.element("section").classes("ws-stack")
        with self._tooth:
            self._places = ui.html("", sanitize=False)
            self._chosen = ui.select([], label="Flank of", on_change=lambda: self._show_flank())
            self._chosen.classes("ws-chosen").props("outlined dense")
        with ui.element("section").classes("ws-card") as self._lives:
            heading("Service life of all parts")
            self._bars = ui.html("", sanitize=False)
        self._ratings = ui.element("section").classes("ws-card")
        self._text = ui.element("section").classes("ws-card")
        for place in (self._life, self._drive, self._tooth, self._lives, self._ratings, self._text):
            place.set_visibility(False)

    def mark_old(self) -> None:
        """Mark everything as the answer to an earlier input."""
        for place in (self._life, self._drive, self._lives, self._ratings, self._text):
            place.classes("ws-old")
        self._tooth.classes("ws-old")

    def show_layout(self, drawing: Markup) -> None:
        """Show where the chain runs and how hard it pulls, which is known before any life."""
        self._layout.show(drawing)
        self._drive.set_visibility(True)
        self._drive.classes(remove="ws-old")

    def show_lives(self, found: DriveLife) -> None:
        """Show the lives and everything in words."""
        self._names = [one.name for one in found.drive.sprockets]
        self._fill_life(found)
        self._fill_ratings(found)
        self._text.clear()
        with self._text:
            assumption_list(*taken_for_granted(found))
        for place in (self._life, self._ratings, self._text):
            place.set_visibility(True)
            place.classes(remove="ws-old")

    def show_pictures(self, bars: Markup, flanks: Mapping[str, Chart]) -> None:
        """Show all lives over time, and the flank of the sprocket that is chosen."""
        self._bars.content = str(bars)  # every text escaped
        self._flanks = flanks
        places = self._places_of(flanks)
        self._places.content = "".join(f'<span id="{place}"></span>' for place in places)
        chosen = self._chosen.value
        self._chosen.set_options(list(flanks), value=chosen if chosen in flanks else next(iter(flanks)))
        self._show_flank()
        for place in (self._tooth, self._lives):
            place.set_visibility(True)
            place.classes(remove="ws-old")

    def draw(self, palette: Palette) -> None:
        """Draw the chart in other colours."""
        self._palette = palette
        self._show_flank()

    def _choose_place(self, place: str) -> None:
        """Show the flank that a link of the layout leads to."""
        places = self._places_of(self._flanks)
        if place in places:
            self._chosen.value = places[place]
            ui.run_javascript(f'getHtmlElement({self._tooth.id}).scrollIntoView({{block: "nearest"}})')

    def _places_of(self, flanks: Mapping[str, Chart]) -> dict[str, str]:
        """Return the sprockets that have a flank by the places that links of the layout lead to."""
        named = enumerate(self._names, start=1)
        return {flank_place(number): name for number, name in named if name in flanks}

    def _show_flank(self) -> None:
        chart = self._flanks.get(self._chosen.value or "")
        if chart is None:
            return
        if self._flank is None:
            with self._tooth:
                self._flank = ChartView(chart, self._palette)
        else:
            self._flank.show(chart, self._palette)

    def _fill_life(self, found: DriveLife) -> None:
        self._life.clear()
        with self._life:
            ui.label(found.drive.title).classes("ws-title").props("role=heading aria-level=2")
            ui.label(first_hours(found.ends, found.life)).classes("ws-hours")
            ui.label(unbroken(first_text(drive_plan(found))))
            if found.overloaded:
                ui.label(ratings_text(found)).classes("ws-overloaded")
            else:
                ui.label(f"Ratings: {ratings_text(found)}.")
            rows = [("Band", band_text(found)), ("Worn most", worn_most_text(found))]
            row_list([*part_findings(found), *rows])
            warning_list(found.doubts)

    def _fill_ratings(self, found: DriveLife) -> None:
        self._ratings.clear()
        with self._ratings:
            rating_list(found.reference.ratings)


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
        cases = drive.single_cases
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
