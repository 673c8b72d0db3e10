"""The answer: faults, lives, ratings, margins, pictures, and what all of it rests on."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from markupsafe import Markup
from nicegui import ui

from wearsim.chain.rating_findings import RATINGS, RatingFinding, deciding
from wearsim.page.answers import (
    Answered,
    DriveAnswer,
    FirstLooks,
    Pictures,
    Rows,
    SprocketAnswer,
    Words,
    answer_to,
)
from wearsim.page.chart_colours import Palette
from wearsim.page.chart_view import ChartView, Drawing
from wearsim.page.edited_input import EditedInput
from wearsim.page.header import Header
from wearsim.page.text_elements import (
    assumption_list,
    heading,
    row_list,
    text_element,
    used_part,
    warning_list,
)
from wearsim.quantities import grouped
from wearsim.report.html.charts import Chart
from wearsim.report.html.margins import Margin
from wearsim.result import Life, LowerBound


class AnswerPanel:
    """The answer in the place where it is made, of one sprocket or of several."""

    def __init__(self, palette: Palette) -> None:
        self._palette = palette
        self._charts: dict[ui.element, Sequence[Chart]] = {}
        self._views: dict[str, ChartView] = {}
        self._pictures = Pictures({})
        self._life = ui.element("section").classes("ws-life-card ws-card")
        with ui.element("div").classes("ws-pair") as self._drive:
            self._drawing = Drawing(self._choose_place)
            with ui.element("section").classes("ws-stack") as self._tooth:
                self._places = ui.html("", sanitize=False)
                self._chosen = ui.select([], label="Flank of", on_change=self._show_flank)
                self._chosen.classes("ws-chosen").props("outlined dense")
                self._flanks = ui.element("div").classes("ws-stack")
        self._loads = ui.element("div")
        with ui.element("section").classes("ws-card") as self._lives:
            heading("Service life of all parts")
            self._bars = ui.html("", sanitize=False)
        self._ratings = ui.element("section").classes("ws-card")
        self._margins = ui.element("section").classes("ws-card")
        self._runs = ui.element("div").classes("ws-pair")
        self._text = ui.element("section").classes("ws-card")
        for place in self._all:
            place.set_visibility(False)

    @property
    def _all(self) -> tuple[ui.element, ...]:
        lives = self._life, self._loads, self._lives, self._ratings, self._margins
        return *lives, self._drive, self._tooth, self._runs, self._text

    def mark_old(self) -> None:
        """Mark everything as the answer to an earlier input."""
        for place in self._all:
            place.classes("ws-old")

    def show_first(self, looks: FirstLooks) -> None:
        """Show what is known before a life, or nothing."""
        if looks.layout is not None:
            self._show_drawing(looks.layout, "Layout, to scale: choose a sprocket")
            _show(self._drive, True)
        self._show_charts(self._loads, [] if looks.loads is None else [looks.loads])
        _show(self._loads, looks.loads is not None)

    def show_words(self, words: Words) -> None:
        """Show the lives and everything in words."""
        self._fill_life(words)
        self._ratings.clear()
        with self._ratings:
            rating_list(words.ratings)
        self._text.clear()
        with self._text:
            for name, rows in words.findings.items():
                heading(name)
                row_list(rows)
            assumption_list(words.stated, words.defaults)
        for place in (self._life, self._text):
            _show(place, True)
        _show(self._ratings, bool(words.ratings))

    def show_pictures(self, pictures: Pictures) -> None:
        """Show flanks, drawings, charts and margins."""
        self._pictures = pictures
        if not pictures.places:
            self._show_drawing(pictures.drawing, "Drive, to scale")
        self._bars.content = str(pictures.bars or "")  # every text escaped
        self._places.content = "".join(f'<span id="{place}"></span>' for place in pictures.places)
        names, chosen = list(pictures.flanks), self._chosen.value
        self._chosen.set_options(names, value=chosen if chosen in names else names[0])
        self._chosen.set_visibility(len(names) > 1)
        self._show_flank()
        self._show_charts(self._runs, pictures.charts)
        self._fill_margins(pictures.margins)
        for place in (self._drive, self._tooth):
            _show(place, True)
        _show(self._lives, pictures.bars is not None)
        _show(self._margins, bool(pictures.margins))
        _show(self._runs, bool(pictures.charts))

    def draw(self, palette: Palette) -> None:
        """Draw the charts in other colours."""
        self._palette = palette
        for place, charts in self._charts.items():
            self._show_charts(place, charts)

    def _show_drawing(self, drawing: Markup | None, title: str) -> None:
        self._drawing.show(drawing, title)

    def _choose_place(self, place: str) -> None:
        """Show the flank that a link of the layout leads to."""
        if place in self._pictures.places:
            self._chosen.value = self._pictures.places[place]
            ui.run_javascript(f'getHtmlElement({self._tooth.id}).scrollIntoView({{block: "nearest"}})')

    def _show_flank(self) -> None:
        self._show_charts(self._flanks, self._pictures.flanks.get(self._chosen.value or "", ()))

    def _show_charts(self, place: ui.element, charts: Sequence[Chart]) -> None:
        self._charts[place] = charts
        # A chart of other panels is another element.
        wanted = [f"{place.id}:{chart.name}:{chart.tall}" for chart in charts]
        shown = [name for name in self._views if name.startswith(f"{place.id}:")]
        if wanted == shown:
            for name, chart in zip(wanted, charts, strict=True):
                self._views[name].show(chart, self._palette)
            return
        for name in shown:
            del self._views[name]
        place.clear()
        with place:
            for name, chart in zip(wanted, charts, strict=True):
                self._views[name] = ChartView(chart, self._palette)

    def _fill_life(self, words: Words) -> None:
        self._life.clear()
        with self._life:
            ui.label(words.title).classes("ws-title").props("role=heading aria-level=2")
            ui.label(words.hours).classes("ws-hours")
            ui.label(words.lines[0])
            if words.alarm:
                ui.label(words.alarm).classes("ws-overloaded")
            for line in words.lines[1:]:
                ui.label(line)
            _fill_band(words.band)
            if words.note:
                ui.label(words.note).classes("ws-muted")
            if words.rows:
                row_list(words.rows)
            warning_list(words.warnings)

    def _fill_margins(self, found: Sequence[Margin]) -> None:
        self._margins.clear()
        with self._margins:
            heading("Margins of the limits")
            with ui.element("dl").classes("ws-margins"):
                for one in found:
                    text_element("dt", f"{one.name}{' (ended the life)' if one.ended else ''}")
                    used_part(one.name, one.used, f"{one.value} of {one.limit} {one.unit}")


def _show(place: ui.element, seen: bool) -> None:
    """Show a place as the answer to the present input, or hide it."""
    place.set_visibility(seen)
    place.classes(remove="ws-old")


def _fill_band(band: Rows) -> None:
    if not band:
        return
    with ui.element("dl").classes("ws-band"):
        for what, life in band:
            with ui.element("div"):
                text_element("dt", what)
                text_element("dd", life)


_NEAR = 0.9
"""Part of a limit from which a rating counts as near it."""


def light(one: RatingFinding) -> str:
    """Return whether a rating is within, near or outside its limit; empty for one that is no rating.

    Examples
    --------
    >>> light(RatingFinding("plate fatigue", 4.3, 4.6, "kW", "ISO 10823"))
    'near'
    """
    if not one.ok:
        return "outside"
    if one.name not in RATINGS:
        return ""
    return "near" if one.used >= _NEAR else "within"


def rating_list(ratings: Sequence[RatingFinding]) -> None:
    """Add every rating with its light, how much of its limit is used, and both numbers."""
    heading("Ratings")
    judging = deciding(ratings)
    with ui.element("dl").classes("ws-margins"):
        for one in ratings:
            text_element("dt", one.name)
            sign = "≥" if one.at_least else "≤"
            text = f"{grouped(one.value)} {sign} {grouped(one.limit)} {one.unit}".rstrip()
            if word := light(one):
                said, colour = (word, word) if one in judging else (f"{word} (for information)", "informs")
                with used_part(one.name, one.used, text):
                    ui.label(said).classes("ws-light").props(f"data-light={colour}")
            else:
                text_element("dd", f"{text}; it defines the life and is no rating")


class AnswerFinder:
    """Finds the answer to an input and shows it step by step, in the place where it is made."""

    def __init__(
        self, header: Header, on_sound: Callable[[Mapping[str, Any]], None], palette: Palette
    ) -> None:
        self._header, self._on_sound = header, on_sound
        self.panel = AnswerPanel(palette)
        self.lives: Mapping[str, Life | LowerBound] = {}

    async def find(self, edited: EditedInput) -> Answered:
        """Show the answer to an input; return what can be saved of it."""
        answer = await edited.step(lambda: answer_to(edited))
        if answer.is_slow:
            await self._show_first(edited, answer)
        return await self._show_all(edited, answer)

    async def _show_first(self, edited: EditedInput, answer: SprocketAnswer | DriveAnswer) -> None:
        """Show what is known before a life that takes long, and about how long it is."""
        looks = await edited.step(answer.first_looks)
        self._on_sound(answer.taken())
        self.panel.show_first(looks)
        rough: Any = await edited.step(lambda: answer.estimate(edited.check))
        if rough is not None:
            self._header.show_life(f"about {answer.headline(rough)}")
            self._header.show_state("estimate", "first estimate, computing")

    async def _show_all(self, edited: EditedInput, answer: SprocketAnswer | DriveAnswer) -> Answered:
        edited.check()
        result: Any = await edited.step(lambda: answer.life(edited.watch))
        words = await edited.step(lambda: answer.words(result))
        self.lives = answer.lives(result)
        self._on_sound(answer.taken())
        self._header.show_life(answer.headline(result))
        self._header.show_state("drawing", "up to date, drawing")
        self.panel.show_words(words)
        if not answer.is_slow:
            self.panel.show_first(FirstLooks())
        self.panel.show_pictures(await edited.step(lambda: answer.pictures(result)))
        self._header.show_state("current", "up to date")
        return Answered(answer.runs(result), lambda: answer.sheet(result))
