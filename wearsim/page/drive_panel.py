"""The answer to a whole drive: its layout and flanks, lives, ratings, and what all of it rests on."""

from collections.abc import Mapping

from markupsafe import Markup
from nicegui import ui

from wearsim.drive.drive_result import DriveLife
from wearsim.drive.maintenance import drive_plan
from wearsim.page.chart_colours import Palette
from wearsim.page.chart_view import ChartView, LinkedDrawing
from wearsim.page.rating_lights import rating_list
from wearsim.page.text_elements import assumption_list, heading, row_list, warning_list
from wearsim.report.drive.drive_drawings import flank_place
from wearsim.report.drive.drive_words import (
    band_text,
    first_text,
    part_findings,
    ratings_text,
    taken_for_granted,
    worn_most_text,
)
from wearsim.report.html.charts import Chart
from wearsim.report.text_lines import unbroken
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
