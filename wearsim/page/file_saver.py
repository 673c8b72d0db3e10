"""Saving a case, its sheet and its wheel, with the questions that come before."""

from collections.abc import Callable
from pathlib import Path

from nicegui import ui

from wearsim.cad import STATES, WHEELS
from wearsim.cad.wheel_formats import export
from wearsim.errors import WearsimError
from wearsim.page.answers import Answered
from wearsim.page.case_file import NEW, CaseFile, example, example_titles, named_beside, new_file, read_file
from wearsim.page.dialogs import ask_example, ask_export, ask_name, choose
from wearsim.page.drive_questions import ask_drive
from wearsim.page.threads import in_thread

_FORMATS = tuple(name for name, wheel in WHEELS.items() if not wheel.solid)
"""A solid takes long, and may hold one state only: that is for the command."""

_NO_RESULT = "There is no result for this input yet: wait for it, or correct the input."


class FileSaver:
    """The file of a page."""

    def __init__(
        self,
        file: CaseFile,
        text: Callable[[], str],
        found: Callable[[], Answered | None],
        on_reload: Callable[[str], None],
        on_change: Callable[[], None],
    ) -> None:
        self.file = file
        self._text, self._found = text, found
        self._on_reload, self._on_change = on_reload, on_change

    async def save(self) -> None:
        """Write the file; ask where the disk holds something that the page does not know."""
        if self.file.content is None:
            await self.save_as()
            return
        if not self.file.changed:
            self._write(self.file)
            return
        answer = await choose(
            f"{self.file.path} has changed on disk since it was loaded here.",
            ("Replace it", "Load it and discard the changes on this page", "Cancel"),
        )
        if answer == "Replace it":
            self._write(self.file)
        elif answer and answer.startswith("Load"):
            self._reload()

    async def save_as(self) -> None:
        """Write a file of another name in the same folder; ask where it is taken."""
        name = await ask_name(self.file.path.name)
        if name is None:
            return
        try:
            place = named_beside(self.file.path, name)
        except WearsimError as error:
            ui.notify(str(error), type="negative", multi_line=True)
            return
        file = self.file if _same(place, self.file) else self.file.renamed(place)
        if file.changed:
            if await choose(f"{place} already exists.", ("Replace it", "Cancel")) != "Replace it":
                return
            file = self.file.renamed(place)
        self._write(file)

    async def begin(self) -> None:
        """Ask what is known of another drive and begin with it; ask before that where a file is not saved."""
        text = await ask_drive()
        if text is None or not await self._may_leave():
            return
        if not self.file.is_blank:
            self.file = new_file(self.file.path.with_name(NEW.name))
        self._on_reload(text)
        self._on_change()

    async def begin_with_example(self) -> None:
        """Ask for a shipped case and begin with it; ask before that where a file is not saved."""
        name = await ask_example(example_titles())
        if name is None or not await self._may_leave():
            return
        self.file = example(name)
        self._on_reload(self.file.begun)
        self._on_change()

    async def _may_leave(self) -> bool:
        """Return whether what is on the page may be left: it is as it began, or the user says so."""
        if self.file.is_blank or self._text() == self.file.begun:
            return True
        lose = "Discard the changes on this page"
        question = f"{self.file.path} has unsaved changes."
        return await choose(question, (lose, "Cancel")) == lose

    async def export(self) -> None:
        """Send the wheel as a file to the browser."""
        found = self._found()
        if found is None:
            ui.notify(_NO_RESULT)
            return
        names = tuple(found.runs)
        wanted = await ask_export(names, _FORMATS, tuple(STATES))
        found = self._found()
        if wanted is None or found is None or wanted[0] not in found.runs:
            return
        name, form, state = wanted
        case, result = found.runs[name]
        states = STATES[state]
        worn = result if "worn" in states else None
        called = case.name if len(names) == 1 else name
        await self._send(lambda: export(case, worn, states, form), f"{called}.{form}")

    async def sheet(self) -> None:
        """Send the page of ``wearsim report`` as a file to the browser."""
        found = self._found()
        if found is None:
            ui.notify(_NO_RESULT)
            return
        await self._send(found.sheet, f"{self.file.path.stem}.html")

    async def _send(self, make: Callable[[], str | bytes], name: str) -> None:
        """Make a file and send it to the browser."""
        try:
            content = await in_thread(make)
        except WearsimError as error:
            ui.notify(str(error), type="negative", multi_line=True)
            return
        ui.download.content(content, name)

    def _write(self, file: CaseFile) -> None:
        try:
            self.file = file.saved(self._text())
        except WearsimError as error:
            ui.notify(str(error), type="negative", multi_line=True)
            return
        self._on_change()
        ui.notify(f"saved to {self.file.path}", type="positive")

    def _reload(self) -> None:
        try:
            self.file = read_file(self.file.path)
        except WearsimError as error:
            ui.notify(str(error), type="negative", multi_line=True)
            return
        self._on_reload(self.file.text)
        self._on_change()


def _same(place: Path, file: CaseFile) -> bool:
    return file.content is not None and place == file.path
