"""The answer: faults, life, margins, pictures, and what all of it rests on."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from nicegui import ui

from wearsim.case.model import Case
from wearsim.chain.selection import RatingFinding
from wearsim.drive.part_life import simulate
from wearsim.page.answers import Pictures, edited_case, estimate, is_slow, pictures
from wearsim.page.chart_colours import Palette
from wearsim.page.chart_view import ChartView, SketchView
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
from wearsim.report.answer import OVERLOADED, chain_findings, ending, headline, overload_text, page_findings
from wearsim.report.html.charts import Chart
from wearsim.report.html.margins import Margin
from wearsim.report.html.run_charts import tooth_load_chart
from wearsim.report.text_lines import stated_and_defaults
from wearsim.result import Life, LowerBound, WearResult
from wearsim.result.lives import hours


class AnswerPanel:
    """The answer in the place where it is made."""

    def __init__(self, palette: Palette) -> None:
        self._palette = palette
        self._pictures: Pictures | None = None
        self._loads: Chart | None = None
        self._views: dict[str, ChartView] = {}
        self._life = ui.element("section").classes("ws-life-card ws-card")
        self._tooth = ui.element("div").classes("ws-pair")
        with self._tooth:
            self._teeth = ui.element("div").classes("ws-stack")
            self._sketch = SketchView()
        self._load = ui.element("div")
        self._ratings = ui.element("section").classes("ws-card")
        self._margins = ui.element("section").classes("ws-card")
        self._charts = ui.element("div").classes("ws-pair")
        self._text = ui.element("section").classes("ws-card")
        for place in (self._life, self._tooth, self._ratings, self._margins, self._text):
            place.set_visibility(False)

    def mark_old(self) -> None:
        """Mark everything as the answer to an earlier input."""
        answers = self._life, self._tooth, self._load, self._ratings
        for place in (*answers, self._margins, self._charts, self._text):
            place.classes("ws-old")

    def show_life(self, result: WearResult) -> None:
        """Show the life and everything in words."""
        self._fill_life(result)
        self._fill_text(result)
        for place in (self._life, self._text, self._ratings):
            place.set_visibility(True)
            place.classes(remove="ws-old")
        self._fill_ratings(result)

    def show_loads(self, chart: Chart | None) -> None:
        """Show what the teeth carry, or nothing."""
        self._loads = chart
        self._load.set_visibility(chart is not None)
        self._show_charts(self._load, [] if chart is None else [chart])
        self._load.classes(remove="ws-old")

    def show_pictures(self, pictures: Pictures) -> None:
        """Show charts, sketch and margins."""
        self._pictures = pictures
        self._show_charts(self._teeth, pictures.tooth)
        self._show_charts(self._charts, pictures.charts)
        self._sketch.show(pictures.scene)
        self._fill_margins(pictures.margins)
        for place in (self._tooth, self._margins, self._charts):
            place.set_visibility(True)
            place.classes(remove="ws-old")

    def draw(self, palette: Palette) -> None:
        """Draw the charts in other colours."""
        self._palette = palette
        if self._loads is not None:
            self._show_charts(self._load, [self._loads])
        if self._pictures is not None:
            self._show_charts(self._teeth, self._pictures.tooth)
            self._show_charts(self._charts, self._pictures.charts)

    def _show_charts(self, place: ui.element, charts: Sequence[Chart]) -> None:
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

    def _fill_life(self, result: WearResult) -> None:
        reached = isinstance(result.life, Life)
        self._life.clear()
        with self._life:
            ui.label(result.title).classes("ws-title").props("role=heading aria-level=2")
            ui.label(headline(result)).classes("ws-hours")
            ui.label(ending(result) + ("" if reached else " (limit not reached)"))
            if result.overloaded:
                ui.label(f"{OVERLOADED} {overload_text(result)}").classes("ws-overloaded")
            with ui.element("dl").classes("ws-band"):
                for what, life in (
                    ("at the high end of the wear coefficient", result.life_low),
                    ("as given", result.life),
                    ("at the low end", result.life_high),
                ):
                    with ui.element("div"):
                        text_element("dt", what)
                        text_element("dd", hours(life))
            ui.label(f"Band: {result.band}.").classes("ws-muted")
            warning_list(result.warnings)

    def _fill_ratings(self, result: WearResult) -> None:
        self._ratings.set_visibility(bool(result.ratings))
        self._ratings.clear()
        with self._ratings:
            rating_list(result.ratings)

    def _fill_text(self, result: WearResult) -> None:
        taken, defaults = stated_and_defaults(result.assumptions)
        self._text.clear()
        with self._text:
            heading("Findings")
            row_list(page_findings(result))
            if result.practice is not None:
                heading("What ends first, published rules, events")
                row_list(chain_findings(result.ends, result.practice, result.events))
            assumption_list(taken, defaults)

    def _fill_margins(self, found: Sequence[Margin]) -> None:
        self._margins.clear()
        with self._margins:
            heading("Margins of the limits")
            with ui.element("dl").classes("ws-margins"):
                for one in found:
                    text_element("dt", f"{one.name}{' (ended the life)' if one.ended else ''}")
                    used_part(one.name, one.used, f"{one.value} of {one.limit} {one.unit}")


_NEAR = 0.9
"""Part of a limit from which a rating counts as near it."""


def light(one: RatingFinding) -> str:
    """Return whether a rating is within, near or outside its limit.

    Examples
    --------
    >>> light(RatingFinding("power", 4.3, 4.6, "kW", "ISO 10823"))
    'near'
    """
    if not one.ok:
        return "outside"
    return "near" if one.used >= _NEAR else "within"


def rating_list(ratings: Iterable[RatingFinding]) -> None:
    """Add every rating with its light, how much of its limit is used, and both numbers."""
    heading("Ratings")
    with ui.element("dl").classes("ws-margins"):
        for one in ratings:
            text_element("dt", one.name)
            sign = "≥" if one.at_least else "≤"
            text = f"{grouped(one.value)} {sign} {grouped(one.limit)} {one.unit}".rstrip()
            with used_part(one.name, one.used, text):
                ui.label(light(one)).classes("ws-light").props(f"data-light={light(one)}")


class CaseAnswer:
    """The answer in the place where it is made."""

    def __init__(
        self, header: Header, on_sound: Callable[[Mapping[str, Any]], None], palette: Palette
    ) -> None:
        self._header, self._on_sound = header, on_sound
        self.panel = AnswerPanel(palette)
        self.lives: Mapping[str, Life | LowerBound] = {}

    async def find(self, edited: EditedInput) -> dict[str, tuple[Case, WearResult]]:
        """Find the answer and show it step by step; return case and result of the only wheel."""
        case = await edited.step(lambda: edited_case(edited.source, edited.file))
        if is_slow(case):
            await self._show_first(edited, case)
        edited.check()
        result = await edited.step(lambda: simulate(case, edited.watch))
        self.lives = {"life": result.life}
        self._show_sound(case)
        self._header.show_life(headline(result))
        self._header.show_state("drawing", "up to date, drawing")
        self.panel.show_life(result)
        if not is_slow(case):
            self.panel.show_loads(None)
        self.panel.show_pictures(await edited.step(lambda: pictures(case, result)))
        self._header.show_state("current", "up to date")
        return {case.name: (case, result)}

    async def _show_first(self, edited: EditedInput, case: Case) -> None:
        """Show what is known before a life that takes long: loads, and about how long it is."""
        loads = await edited.step(lambda: tooth_load_chart(case))
        self._show_sound(case)
        self.panel.show_loads(loads)
        rough = await edited.step(lambda: estimate(edited.source, case, edited.check))
        if rough is not None:
            self._header.show_life(f"about {headline(rough)}")
            self._header.show_state("estimate", "first estimate, computing")

    def _show_sound(self, case: Case) -> None:
        self._on_sound({**case.inputs, "title": case.title})
