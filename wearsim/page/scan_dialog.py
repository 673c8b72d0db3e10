"""The dialog that scans a photograph of the sprocket of the page's case."""

from collections.abc import Callable

from nicegui import events, ui

from wearsim.case.model import Case
from wearsim.drive.drive_case import DriveCase
from wearsim.errors import Fault, GeometryError
from wearsim.page.answers import error_faults
from wearsim.page.dialogs import named_dialog
from wearsim.page.edited_input import StaleError
from wearsim.page.photo_scan import (
    PhotoView,
    ScanWish,
    close_view,
    crosses,
    depth_colours,
    drawn_larger,
    overlay,
    scanned,
    sprocket_names,
    whole_view,
)
from wearsim.page.request_guard import MOST_BYTES
from wearsim.page.text_elements import FaultList, heading, row_list, text_element, warning_list
from wearsim.page.threads import in_thread
from wearsim.scanning.answer import ScanResult
from wearsim.scanning.photograph import Photograph, photograph_of
from wearsim.scanning.sheet import scan_findings, tooth_table

_LOOK = "outlined dense stack-label"

_FORM, _BORE, _POINTS = "tooth form", "bore diameter", "two points"
"""What the scale is known from."""


class ScanDialog:
    """A photograph, what the user says of it, and the wear that it shows."""

    def __init__(self, case: Case | DriveCase, is_stopping: Callable[[], bool]) -> None:
        self._case, self._is_stopping = case, is_stopping
        self._version, self._closed, self._marking = 0, False, False
        self._photograph: Photograph | None = None
        self._whole: PhotoView | None = None
        self._close: PhotoView | None = None  # in which the next point is marked
        self._points: list[tuple[float, float]] = []
        self._drawing = ""
        self._shown_width = self._loaded_width = 0  # of the view, and of what the browser shows by now [px]
        with named_dialog("Scan a photo") as self._dialog, ui.card().classes("ws-dialog ws-scan"):
            ui.label("Scan a photo").classes("ws-caption")
            ui.label(
                "Measures the wear of a sprocket of this case. The photo stays in the memory of this machine."
            )
            self._upload = self._add_upload()
            self._add_questions()
            self._faults = FaultList()
            self._hint = ui.label().classes("ws-muted").props("role=status")
            with ui.element("div").classes("ws-scan-found"):
                self._image = ui.interactive_image(on_mouse=self._click, sanitize=False, cross=False)
                self._image.classes("ws-photo").set_visibility(False)
                self._image.on("loaded", self._note_loaded, args=["width"])
                self._answer = ui.element("section").props('aria-label="Wear"')
            ui.button("Close", on_click=self._dialog.close).props("flat no-caps")

    async def run(self) -> None:
        """Show the dialog until it is closed."""
        await self._dialog
        self._closed = True
        self._dialog.delete()

    def _add_upload(self) -> ui.upload:
        upload = ui.upload(
            label="Drop a photo here (PNG, JPEG, TIFF)",
            auto_upload=True,
            max_file_size=MOST_BYTES,
            on_upload=self._take,
            on_rejected=self._reject,
        )
        upload.classes("ws-drop").props('accept=".png,.jpg,.jpeg,.tif,.tiff" flat bordered')
        # Not by way of the server: a browser opens files only for who has just clicked.
        pick = f'() => runMethod({upload.id}, "pickFiles", [])'
        button = ui.button("Choose a photo", icon="photo_camera").props("flat no-caps")
        button.on("click", js_handler=pick)
        return upload

    def _add_questions(self) -> None:
        names = sprocket_names(self._case)
        with ui.element("div").classes("ws-scan-questions"):
            self._sprocket = ui.select(names, label="Sprocket", value=names[0] if names else None).props(
                _LOOK
            )
            self._sprocket.set_visibility(bool(names))
            self._teeth = self._number("Teeth", "of the case")
            self._hours = self._number("Running hours, h", "for the hours left")
            self._by = ui.select(
                [_FORM, _BORE, _POINTS], label="Scale", value=_FORM, on_change=self._choose_scale
            ).props(_LOOK)
            self._length = self._number("Length, mm", "")
        with ui.row():
            self._measure = ui.button("Measure", on_click=self._scan).props("flat no-caps")
            self._mark = ui.button("Mark the points", on_click=self._begin_marking).props("flat no-caps")
        self._choose_scale()

    def _number(self, label: str, placeholder: str) -> ui.number:
        field = ui.number(label).props(_LOOK)
        field.props["placeholder"] = placeholder
        field.on("keydown.enter", self._scan)
        return field

    def _choose_scale(self) -> None:
        """Show what belongs to a scale."""
        self._length.set_visibility(self._by.value != _FORM)
        self._length.props["label"] = "Diameter, mm" if self._by.value == _BORE else "Distance, mm"
        self._mark.set_visibility(self._by.value == _POINTS)
        self._measure.set_enabled(self._photograph is not None)

    def _reject(self) -> None:
        text = f"must be one PNG, JPEG or TIFF of at most {MOST_BYTES // 1_000_000} MB: save it as one"
        self._faults.show((Fault(text, "", "photo"),))

    async def _take(self, event: events.UploadEventArguments) -> None:
        """Take another photograph and scan it."""
        content, name = await event.file.read(), event.file.name
        self._upload.reset()
        version = self._begin()
        self._photograph, self._whole, self._close, self._points = None, None, None, []
        self._drawing, self._marking = "", False
        self._show_answer(None)
        try:
            photograph = await in_thread(lambda: photograph_of(content, name))
            whole = await in_thread(lambda: whole_view(photograph))
        except Exception as error:
            if self._is_present(version):
                self._image.set_visibility(False)
                self._faults.show(error_faults(error))
            return
        if not self._is_present(version):
            return
        self._photograph, self._whole = photograph, whole
        self._show_view(whole)
        self._choose_scale()
        await self._scan()

    def _begin(self) -> int:
        """Drop the scan that is running, and return the number of what follows."""
        self._version += 1
        self._measure.props(remove="loading")
        return self._version

    def _begin_marking(self) -> None:
        """Let the user mark both ends of a known length."""
        if self._photograph is None or self._whole is None:
            return
        self._begin()
        self._points, self._close, self._drawing, self._marking = [], None, "", True
        self._show_answer(None)

    async def _click(self, event: events.MouseEventArguments) -> None:
        """Look closer where a point is to be, then mark it."""
        if self._photograph is None or self._whole is None or not self._marking:
            return
        if self._loaded_width != self._shown_width:  # as the second half of a double click
            return
        if self._close is None:
            self._close = close_view(self._photograph, *self._whole.place(event.image_x, event.image_y))
            self._show_view(self._close)
            return
        self._points.append(self._close.place(event.image_x, event.image_y))
        self._close = None
        self._marking = len(self._points) < 2
        self._show_view(self._whole)
        if len(self._points) == 2 and self._length.value:
            await self._scan()

    def _note_loaded(self, event: events.GenericEventArguments) -> None:
        """Note that the browser shows another view."""
        self._loaded_width = int(event.args["width"])

    def _show_view(self, view: PhotoView) -> None:
        """Show a view of the photograph with what is drawn on it."""
        self._shown_width = view.width
        self._image.props["cross"] = self._marking
        self._image.set_source(view.source)
        self._image.content = view.layer(self._drawing + crosses(self._points, 8.0 * view.step))
        self._image.set_visibility(True)
        self._hint.text = self._what_to_do()

    def _what_to_do(self) -> str:
        """Return what the next click does."""
        if not self._marking:
            return ""
        which = ("first", "second")[len(self._points)]
        if self._close is None:
            return f"Click near the {which} point: the photo is then enlarged there."
        return f"Click on the {which} point."

    def _wish(self) -> ScanWish:
        """Return what the user says; raise where something is missing."""
        by, length, scale = self._by.value, self._length.value, None
        if by != _FORM and length is None:
            raise GeometryError(f"scan: a scale by {by} needs its length in mm: type it")
        if by == _POINTS:
            if len(self._points) != 2:
                raise GeometryError("scan: a scale by two points needs both of them: mark them on the photo")
            (x1, y1), (x2, y2) = self._points
            scale = (x1, y1, x2, y2, length)
        teeth = self._teeth.value
        return ScanWish(
            sprocket=self._sprocket.value,
            teeth=int(teeth) if teeth is not None and teeth == int(teeth) else teeth,
            hours=self._hours.value,
            bore=length if by == _BORE else None,
            scale=scale,
        )

    async def _scan(self) -> None:
        """Measure the photograph anew."""
        photograph = self._photograph
        if photograph is None:
            return
        version = self._begin()

        def watch(part: float) -> None:
            if self._is_stopping() or not self._is_present(version):
                raise StaleError

        def work() -> tuple[ScanResult, str]:
            found = scanned(photograph, self._case, wish, watch)
            return found, overlay(found.found)

        self._measure.props("loading")
        self._faults.show(())
        try:
            wish = self._wish()
            found, drawing = await in_thread(work)
            watch(1.0)
            self._drawing = drawing
            self._show_answer(found)
        except StaleError:
            pass
        except Exception as error:
            if self._is_present(version):
                self._drawing = ""
                self._show_answer(None)
                self._faults.show(error_faults(error))
        if self._is_present(version):
            self._measure.props(remove="loading")

    def _is_present(self, version: int) -> bool:
        """Whether nothing has been begun since, and the dialog is open."""
        return not self._closed and version == self._version

    def _show_answer(self, found: ScanResult | None) -> None:
        """Show the wear beside the photograph, or nothing."""
        self._answer.clear()
        self._close, self._marking = None, self._marking and found is None
        if self._whole is not None:
            self._show_view(self._whole)
        if found is None:
            return
        self._faults.show(())
        with self._answer:
            _legend(found)
            heading(found.headline)
            row_list(scan_findings(found.found))
            warning_list(found.warnings)
            _tooth_rows(found)
            if found.found.hours and found.found.is_worn:
                text = found.shared_reading()
                save = ui.button(
                    "Save the reading", on_click=lambda: ui.download.content(text, "reading.toml")
                )
                save.props("flat no-caps")


def _legend(found: ScanResult) -> None:
    """Add what the colours of the overlay stand for."""
    with ui.element("ul").classes("ws-legend").props('aria-label="Depth by colour"'):
        for colour, text in depth_colours(found.found):
            with ui.element("li"):
                ui.element("span").style(f"background: {colour}").props("aria-hidden=true")
                ui.label(text)
    ui.label(f"Blue: the new form. The wear is drawn {drawn_larger(found.found)} times as deep.").classes(
        "ws-muted"
    )


def _tooth_rows(found: ScanResult) -> None:
    """Add a row for each tooth, numbered as on the photograph."""
    table = tooth_table(found.found)
    with ui.element("table").classes("ws-teeth"):
        with ui.element("thead"), ui.element("tr"):
            for head in table.head:
                text_element("th", head).props("scope=col")
        with ui.element("tbody"):
            for row in table.cells:
                with ui.element("tr"):
                    for cell in row:
                        text_element("td", cell)
