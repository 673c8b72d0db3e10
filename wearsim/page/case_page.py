"""One page: an input that is edited, and the answer that follows it."""

import asyncio
import threading
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from nicegui import background_tasks, ui

from wearsim.drive.load_case import load_case
from wearsim.errors import Fault, WearsimError
from wearsim.input.document import CaseText
from wearsim.page.answer_panel import AnswerFinder
from wearsim.page.answers import Answered, error_faults
from wearsim.page.case_file import CaseFile
from wearsim.page.chart_colours import palettes
from wearsim.page.chart_view import style
from wearsim.page.comparison_panel import Comparison
from wearsim.page.edit_history import EditHistory
from wearsim.page.edited_input import EditedInput, StaleError
from wearsim.page.fault_view import FaultView
from wearsim.page.fields import Field
from wearsim.page.file_saver import FileSaver
from wearsim.page.form_panel import FormPanel
from wearsim.page.header import Action, Header
from wearsim.page.text_elements import FaultList
from wearsim.page.threads import in_thread
from wearsim.page.toml_source import parsed_tables, shown_values, with_table, with_value, without_table
from wearsim.page.what_if import WhatIf

if TYPE_CHECKING:
    from wearsim.page.scan_dialog import ScanDialog

_ARRIVED = """
const bar = document.querySelector(".ws-header");
new ResizeObserver(() => {
    document.documentElement.style.setProperty("--ws-head", `${bar.offsetHeight}px`);
}).observe(bar);
const dark = matchMedia("(prefers-color-scheme: dark)");
const tell = () => emitEvent("scheme", dark.matches);
dark.addEventListener("change", tell);
tell();
"""


def _scan_dialog() -> "type[ScanDialog]":
    """Return the dialog of a photograph; its imports take long, and few pages need it."""
    from wearsim.page.scan_dialog import ScanDialog

    return ScanDialog


class CasePage:
    """A page of its own: no other one knows its input."""

    def __init__(self, file: CaseFile, text: str, stopping: threading.Event) -> None:
        self._text, self._stopping = text, stopping
        self._version, self._answered, self._gone = 1, 0, False
        self._task: asyncio.Task[None] | None = None
        self._found: tuple[int, Answered | None] = 0, None
        self._palette = palettes()[0]
        self._history = EditHistory()
        self._client = ui.context.client
        self._keeper = FileSaver(file, lambda: self._text, self._present, self._reloaded, self._named)
        ui.add_css(style(palettes()))
        ui.dark_mode(None)
        self._build()
        ui.on("scheme", lambda event: self._draw(bool(event.args)))
        self._client.on_connect(self._arrived)
        self._client.on_disconnect(self._left)
        self._show_input("")
        self._named()
        if file.is_blank:
            ui.timer(0.0, self._keeper.begin, once=True)

    def _build(self) -> None:
        keeper = self._keeper
        actions = (
            Action("New", "add", keeper.begin),
            Action("Examples", "menu_book", keeper.begin_with_example),
            Action("Undo", "undo", lambda: self._go(self._history.undo), True),
            Action("Redo", "redo", lambda: self._go(self._history.redo), True),
            Action("Pin", "push_pin", self._pin),
            Action("Save", "save", keeper.save),
            Action("Save as", "save_as", keeper.save_as),
            Action("Sheet", "description", keeper.sheet),
            Action("Export wheel", "download", keeper.export),
            Action("Scan a photo", "photo_camera", self._scan),
        )
        self._header = Header(actions)
        with ui.element("div").classes("ws-main"):
            with ui.element("section").classes("ws-input").props('aria-label="Input"') as given:
                self._what_if = WhatIf(self._turned)
                with ui.tabs().classes("ws-tabs") as tabs:
                    form, source = ui.tab("Form"), ui.tab("TOML")
                with ui.tab_panels(tabs, value=form, animated=False).classes("ws-panels"):
                    with ui.tab_panel(form):
                        self._form = FormPanel(
                            self._typed, self._completed, self._add_table, self._remove_table
                        )
                    with ui.tab_panel(source):
                        self._source = ui.codemirror(
                            self._text,
                            language="TOML",
                            line_wrapping=True,
                            on_change=lambda event: self._edit(event.value, "TOML"),
                        ).classes("ws-source")
                        self._source.on("focusout", self._completed)
            with ui.element("section").classes("ws-answer").props('aria-label="Answer"') as answer:
                self._faults = FaultView(self._form, FaultList(), self._header)
                self._comparison = Comparison()
                with ui.element("div").classes("ws-answer-place"):
                    self._answer = AnswerFinder(self._header, self._show_sound, self._palette)
        self._header.link("Answer", answer)
        self._header.link("Input", given)

    def _draw(self, dark: bool) -> None:
        self._source.set_theme("basicDark" if dark else "basicLight")
        self._palette = palettes()[dark]
        self._answer.panel.draw(self._palette)

    def _typed(self, field: Field, typed: str) -> None:
        self._edit(with_value(self._text, field.key, typed, field.is_text), field.key)

    def _turned(self, key: str, value: str) -> None:
        self._edit(with_value(self._text, key, value), "")

    def _add_table(self, name: str) -> None:
        self._edit(with_table(self._text, name), "")

    def _remove_table(self, name: str, number: int) -> None:
        self._edit(without_table(self._text, name, number), "")

    def _reloaded(self, text: str) -> None:
        self._edit(text, "")

    def _edit(self, text: str, typing: str) -> None:
        """Take another input; the field that it was typed into is left alone."""
        text = text.encode("utf-8", "replace").decode("utf-8")
        if text == self._text:
            return
        self._history.leave(self._text, typing)
        self._take(text, typing)

    def _go(self, step: Callable[[str], str]) -> None:
        """Take an input from before or after the present one."""
        self._take(step(self._text), "")

    def _completed(self) -> None:
        self._faults.complete()

    def _take(self, text: str, typing: str) -> None:
        self._text = text
        self._faults.begin(typing != "")
        self._version += 1
        self._show_input(typing)
        self._named()
        self._follow()

    def _pin(self) -> None:
        """Keep the answer to the present input to compare later ones with."""
        self._comparison.pin()

    async def _scan(self) -> None:
        """Measure the wear of a sprocket of the present input in a photograph."""
        source = CaseText(self._keeper.file.path, self._text)
        try:
            make, case = await in_thread(lambda: (_scan_dialog(), load_case(source)))
        except WearsimError as error:
            ui.notify(str(error), type="negative", multi_line=True)
            return
        await make(case, lambda: self._gone or self._stopping.is_set()).run()

    def _show_input(self, typing: str) -> None:
        data = parsed_tables(self._text)
        self._what_if.show(data)
        self._form.show(data, {} if data is None else shown_values(self._text), typing)
        if typing != "TOML" and self._source.value != self._text:
            self._source.value = self._text

    def _named(self) -> None:
        dirty = self._text != self._keeper.file.text
        name = self._keeper.file.path.name
        self._header.show_file(name, dirty)
        self._header.enable("Undo", self._history.can_undo)
        self._header.enable("Redo", self._history.can_redo)
        asks = "(event) => event.preventDefault()" if dirty else "null"
        with self._client:
            ui.page_title(f"{'* ' if dirty else ''}{name} - wearsim")
            ui.run_javascript(f"window.onbeforeunload = {asks};")

    def _arrived(self) -> None:
        self._gone = False
        ui.run_javascript(_ARRIVED)
        self._follow()

    def _left(self) -> None:
        self._gone = True

    def _follow(self) -> None:
        if self._answered == self._version:
            return
        self._header.show_state("computing", "computing")
        self._header.enable("Pin", False)
        self._comparison.mark_old()
        self._answer.panel.mark_old()
        if self._task is None or self._task.done():
            self._task = background_tasks.create(self._catch_up(), name="answer")

    async def _catch_up(self) -> None:
        """Answer the input until there is no newer one."""
        while self._answered != self._version and not self._gone:
            version = self._version
            try:
                await self._find(version)
            except StaleError:
                if self._stopping.is_set():
                    return
                continue
            except Exception as error:
                self._fail(version, error_faults(error))
            self._answered = version

    async def _find(self, version: int) -> None:
        source = CaseText(self._keeper.file.path, self._text)
        edited = EditedInput(source, self._keeper.file, self._staleness(version), self._progress(version))
        self._found = version, await self._answer.find(edited)
        self._comparison.show(self._text, self._answer.lives)
        self._header.enable("Pin", True)

    def _show_sound(self, taken: Mapping[str, Any]) -> None:
        """Show that the input has no faults, and what it takes where it gives nothing."""
        self._faults.clear()
        self._form.show_taken(taken)

    def _staleness(self, version: int) -> Callable[[], bool]:
        return lambda: self._version != version or self._gone or self._stopping.is_set()

    def _progress(self, version: int) -> Callable[[float], None]:
        """Show how far a run is, from whichever thread it tells."""
        loop, shown, is_stale = asyncio.get_running_loop(), [0], self._staleness(version)

        def _show(percent: int) -> None:
            if not is_stale() and self._answered != version:
                self._header.show_progress(percent)

        def report_progress(part: float) -> None:
            percent = int(100.0 * part)
            if percent > shown[0]:
                shown[0] = percent
                loop.call_soon_threadsafe(_show, percent)

        return report_progress

    def _fail(self, version: int, faults: Sequence[Fault]) -> None:
        if self._staleness(version)():
            return
        self._faults.fail(faults)

    def _present(self) -> Answered | None:
        """Give the answer to the present input, nothing before it is there."""
        version, found = self._found
        return found if version == self._version else None
