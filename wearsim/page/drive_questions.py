"""What is known of a new drive, asked in a dialog as ``wearsim init`` asks it."""

import re
from collections.abc import Callable, Sequence
from typing import Any

from nicegui import ui

from wearsim.drive.drive_start import start_text
from wearsim.drive.known_drive import KNOWN, Known, read_known
from wearsim.errors import CaseError, Fault
from wearsim.page.choice_lists import choice_list
from wearsim.page.dialogs import named_dialog
from wearsim.page.field_words import choice_words
from wearsim.page.fields import catalogue_words
from wearsim.page.threads import in_thread

_LOOK = "outlined dense stack-label hide-bottom-space"


async def ask_drive() -> str | None:
    """Ask what is known of a drive; return the text of its case, or nothing."""
    with named_dialog("New drive") as dialog, ui.card().classes("ws-dialog ws-questions"):
        ui.label("New drive: one chain on two sprockets").classes("ws-caption")

        async def _create() -> None:
            create.props("loading")
            text = await questions.answer()
            create.props(remove="loading")
            if text is not None:
                dialog.submit(text)

        questions = _Questions(_create)
        with ui.row():
            create = ui.button("Create", on_click=_create).props("flat no-caps")
            ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
    answer: str | None = await dialog
    dialog.delete()
    return answer


class _Questions:
    """A field for everything that may be known, in the place where it is made."""

    def __init__(self, on_enter: Callable[[], Any]) -> None:
        with ui.element("div").classes("ws-fields"):
            self._fields = {known.name: self._field(known, on_enter) for known in KNOWN if known.asked}
        self._wrong: set[str] = set()  # options that show a fault
        self._others = ui.label().classes("ws-fault")
        self._follow("")

    async def answer(self) -> str | None:
        """Return the text of the case, or show what is wrong."""
        typed = self._typed()
        try:
            return await in_thread(lambda: start_text(typed))
        except CaseError as error:
            self._show(error.faults)
            return None

    def _field(self, known: Known, on_enter: Callable[[], Any]) -> Any:
        label, _, more = re.split("([:;,(])", known.what + ";", maxsplit=1)
        field: Any
        if known.words:
            field = ui.select(
                {word: choice_words(known.name, word) for word in known.words},
                label=label,
                value=known.words[0],
            )
        elif known.name == "chain":
            field = choice_list("designation", catalogue_words("chain.designation"), "", label)
        else:
            field = ui.input(label).props("autocomplete=off spellcheck=false")
            field.props.set_optional("hint", more.strip(" ;") or None)
            field.on("keydown.enter", on_enter)
            field.on("blur", lambda: self._follow(""))
        field.classes("ws-field").props(_LOOK)
        field.props["data-known"] = known.name
        field.on_value_change(lambda: self._follow("" if known.name == "chain" else known.option))
        return field

    def _typed(self) -> dict[str, str | None]:
        return {name: (field.value or "").strip() or None for name, field in self._fields.items()}

    def _follow(self, typing: str) -> None:
        """Show what is taken where nothing is typed, and what cannot be read but for what is typed now."""
        values, faults = read_known(self._typed())
        for known in KNOWN:
            if known.asked:
                self._fields[known.name].props["placeholder"] = known.default(values)
        self._show([fault for fault in faults if fault.file != typing or typing in self._wrong])

    def _show(self, faults: Sequence[Fault]) -> None:
        texts = {fault.file: fault.message for fault in faults}
        self._wrong = {*texts}
        for known in KNOWN:
            if known.asked:
                self._fields[known.name].error = texts.pop(known.option, None)
        self._others.text = "\n".join(texts.values())
