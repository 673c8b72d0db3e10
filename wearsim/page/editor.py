"""One page: an input that is edited, and the answer that follows it."""

import asyncio
import threading
from collections.abc import Callable, Sequence
from typing import TypeVar

from nicegui import background_tasks, ui

from wearsim.case.model import Case
from wearsim.errors import Fault, WearsimError
from wearsim.input.document import CaseText
from wearsim.page.answer_panel import AnswerPanel
from wearsim.page.answers import StaleError, edited_case, error_faults, estimate, is_slow, life, pictures
from wearsim.page.case_file import CaseFile
from wearsim.page.chart_colours import palettes
from wearsim.page.chart_view import style
from wearsim.page.fields import Field
from wearsim.page.file_saver import FileSaver
from wearsim.page.form_panel import FormPanel
from wearsim.page.header import Header
from wearsim.page.threads import in_thread
from wearsim.page.toml_source import parsed_tables, shown_values, with_table, with_value, without_table
from wearsim.report.answer import headline
from wearsim.report.html.run_charts import tooth_load_chart
from wearsim.result import WearResult

Found = TypeVar("Found")

_SCHEME = """
const dark = matchMedia("(prefers-color-scheme: dark)");
const tell = () => emitEvent("scheme", dark.matches);
dark.addEventListener("change", tell);
tell();
"""


class CasePage:
    """A page of its own: no other one knows its input."""

    def __init__(self, file: CaseFile, text: str, stopping: threading.Event) -> None:
        self._text, self._stopping = text, stopping
        self._version, self._answered, self._gone = 1, 0, False
        self._task: asyncio.Task[None] | None = None
        self._result: tuple[int, Case, WearResult] | None = None
        self._client = ui.context.client
        self._keeper = FileSaver(file, lambda: self._text, self._found, self._reloaded, self._named)
        ui.add_css(style(palettes()))
        ui.dark_mode(None)
        self._build()
        ui.on("scheme", lambda event: self._draw(bool(event.args)))
        self._client.on_connect(self._arrived)
        self._client.on_disconnect(self._left)
        self._show_input("")
        self._named()

    def _build(self) -> None:
        self._header = Header(self._keeper.save, self._keeper.save_as, self._keeper.export)
        with ui.element("main").classes("ws-main"):
            with ui.element("section").classes("ws-input").props('aria-label="Input"'):
                with ui.tabs().classes("ws-tabs") as tabs:
                    form, source = ui.tab("Form"), ui.tab("TOML")
                with ui.tab_panels(tabs, value=form, animated=False).classes("ws-panels"):
                    with ui.tab_panel(form):
                        self._form = FormPanel(self._typed, self._add_table, self._remove_table)
                    with ui.tab_panel(source):
                        self._source = ui.codemirror(
                            self._text,
                            language="TOML",
                            line_wrapping=True,
                            on_change=lambda event: self._edit(event.value, "TOML"),
                        ).classes("ws-source")
            with ui.element("section").classes("ws-answer").props('aria-label="Answer"'):
                self._answer = AnswerPanel(palettes()[0])

    def _draw(self, dark: bool) -> None:
        self._source.set_theme("basicDark" if dark else "basicLight")
        self._answer.draw(palettes()[dark])

    def _typed(self, field: Field, typed: str) -> None:
        self._edit(with_value(self._text, field.key, typed, field.is_text), field.key)

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
        self._text = text
        self._version += 1
        self._show_input(typing)
        self._named()
        self._follow()

    def _show_input(self, typing: str) -> None:
        data = parsed_tables(self._text)
        self._form.show(data, {} if data is None else shown_values(self._text), typing)
        if typing != "TOML" and self._source.value != self._text:
            self._source.value = self._text

    def _named(self) -> None:
        dirty = self._text != self._keeper.file.text
        name = self._keeper.file.path.name
        self._header.show_file(name, dirty)
        asks = "(event) => event.preventDefault()" if dirty else "null"
        with self._client:
            ui.page_title(f"{'* ' if dirty else ''}{name} - wearsim")
            ui.run_javascript(f"window.onbeforeunload = {asks};")

    def _arrived(self) -> None:
        self._gone = False
        ui.run_javascript(_SCHEME)
        self._follow()

    def _left(self) -> None:
        self._gone = True

    def _follow(self) -> None:
        if self._answered == self._version:
            return
        self._header.show_state("computing", "computing")
        self._answer.mark_old()
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
            except WearsimError as error:
                self._fail(version, error_faults(error))
            except Exception as error:
                text = f"this is a bug in wearsim: {type(error).__name__}: {error}"
                self._fail(version, (Fault(text),))
            self._answered = version

    async def _find(self, version: int) -> None:
        source = CaseText(self._keeper.file.path, self._text)
        is_stale, report_progress = self._staleness(version), self._progress(version)
        case = await self._step(version, lambda: edited_case(source, self._keeper.file))
        if is_slow(case):
            await self._show_first(version, source, case)
        result = await self._step(version, lambda: life(case, is_stale, report_progress))
        self._result = (version, case, result)
        self._show_sound(case)
        self._header.show_life(headline(result))
        self._header.show_state("drawing", "of the present input, drawing")
        self._answer.show_life(result)
        if not is_slow(case):
            self._answer.show_loads(None)
        self._answer.show_pictures(await self._step(version, lambda: pictures(case, result)))
        self._header.show_state("current", "of the present input")

    async def _show_first(self, version: int, source: CaseText, case: Case) -> None:
        """Show what is known before a life that takes long: loads, and about how long it is."""
        is_stale = self._staleness(version)
        loads = await self._step(version, lambda: tooth_load_chart(case))
        self._show_sound(case)
        self._answer.show_loads(loads)
        rough = await self._step(version, lambda: estimate(source, case, is_stale))
        if rough is not None:
            self._header.show_life(f"about {headline(rough)}")
            self._header.show_state("estimate", "first estimate, computing")

    def _show_sound(self, case: Case) -> None:
        self._form.show_faults(())
        self._answer.show_faults(())
        self._form.show_taken({**case.inputs, "title": case.title})

    async def _step(self, version: int, work: Callable[[], Found]) -> Found:
        found = await in_thread(work)
        if self._staleness(version)():
            raise StaleError
        return found

    def _staleness(self, version: int) -> Callable[[], bool]:
        return lambda: self._version != version or self._gone or self._stopping.is_set()

    def _progress(self, version: int) -> Callable[[float], None]:
        """Show how far a run is, from whichever thread it tells."""
        loop, shown, is_stale = asyncio.get_running_loop(), [-1], self._staleness(version)

        def _show(percent: int) -> None:
            if not is_stale() and self._answered != version:
                self._header.show_progress(percent)

        def report_progress(part: float) -> None:
            percent = int(100.0 * part)
            if percent != shown[0]:
                shown[0] = percent
                loop.call_soon_threadsafe(_show, percent)

        return report_progress

    def _fail(self, version: int, faults: Sequence[Fault]) -> None:
        if self._staleness(version)():
            return
        self._form.show_faults(faults)
        self._answer.show_faults(faults)
        what = "a fault" if len(faults) == 1 else f"{len(faults)} faults"
        self._header.show_state("old", f"{what}: the answer is of an earlier input")

    def _found(self) -> tuple[Case, WearResult] | None:
        """Give case and result of the present input, if they are there."""
        if self._result is None or self._result[0] != self._version:
            return None
        return self._result[1:]
