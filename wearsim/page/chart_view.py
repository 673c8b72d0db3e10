"""A chart on the page, with the slider that enlarges a depth."""

from collections.abc import Callable
from importlib import resources

from markupsafe import Markup
from nicegui import ui

from wearsim.page.chart_colours import Palette, figure
from wearsim.report.html.charts import Chart

_LINK = """(event) => {
    const link = event.target.closest("a");
    if (link) { event.preventDefault(); emit(link.getAttribute("href").slice(1)); }
}"""
"""Tells the place that a link of a drawing leads to, and does not go there."""


class ChartView:
    """A chart in the place where it is made."""

    def __init__(self, chart: Chart, palette: Palette) -> None:
        self._chart, self._palette = chart, palette
        self._chosen: float | None = None
        with ui.element("figure").classes("ws-card ws-chart"):
            self._title = ui.label().classes("ws-caption").props("role=heading aria-level=3")
            self._plot = ui.plotly(figure(chart, palette, self._factor()))
            self._plot.classes(f"ws-plot ws-tall-{chart.tall}").props("role=group")
            if chart.slider:
                self._add_slider()
        self.show(chart, palette)

    def show(self, chart: Chart, palette: Palette) -> None:
        """Show a chart of the same kind, with the depth enlarged as the user chose."""
        self._chart, self._palette = chart, palette
        self._title.text = chart.title[0].upper() + chart.title[1:]
        self._plot.props["aria-label"] = chart.alt
        if chart.slider:
            self._slider.props["max"] = chart.slider["most"]
            if self._slider.value != self._factor():
                self._slider.value = self._factor()
            self._depth.text = f"greatest depth {chart.slider['depth']}"
        self._draw()

    def _add_slider(self) -> None:
        slider = self._chart.slider
        with ui.element("div").classes("ws-slider"):
            ui.label("Depth enlarged")
            self._slider = ui.slider(min=1, max=slider["most"], value=slider["factor"])
            self._slider.props('aria-label="Depth enlarged"')
            self._slider.on("update:model-value", lambda event: self._choose(event.args), throttle=0.05)
            self._times = ui.label().classes("ws-times")
            self._depth = ui.label().classes("ws-muted")

    def _factor(self) -> float:
        slider = self._chart.slider
        if not slider:
            return 1.0
        return float(min(self._chosen or slider["factor"], slider["most"]))

    def _choose(self, factor: float) -> None:
        if factor == self._factor():
            return
        self._chosen = factor
        self._draw()

    def _draw(self) -> None:
        if self._chart.slider:
            self._times.text = f"× {self._factor():g}"
        self._plot.update_figure(figure(self._chart, self._palette, self._factor()))


class Drawing:
    """A drawing to scale in the place where it is made; a link in it chooses something."""

    def __init__(self, on_choose: Callable[[str], None]) -> None:
        with ui.element("figure").classes("ws-card ws-layout") as self._place:
            self._title = ui.label().classes("ws-caption").props("role=heading aria-level=3")
            self._drawing = ui.html("", sanitize=False)
        self._drawing.on("click", lambda event: on_choose(str(event.args)), js_handler=_LINK)

    def show(self, drawing: Markup | None, title: str) -> None:
        """Show a drawing, of which every text is escaped, or nothing."""
        self._place.set_visibility(drawing is not None)
        self._title.text = title
        self._drawing.content = str(drawing or "")


def style(palettes: tuple[Palette, Palette]) -> str:
    """Return the rules of the page."""
    named = ["".join(f"--{name}: {colour};" for name, colour in palette.items()) for palette in palettes]
    drawings = [
        line
        for package, name in (
            ("wearsim.report.html", "style.css"),
            ("wearsim.report.drive", "templates/drive_sheet.css"),
        )
        for line in resources.files(package).joinpath(name).read_text("utf-8").splitlines()
        if line.startswith((".sketch", ".notes", ".lives"))
    ]
    own = resources.files("wearsim.page").joinpath("style.css").read_text("utf-8")
    return "\n".join([f":root {{{named[0]}}} .body--dark {{{named[1]}}}", *drawings, own])
