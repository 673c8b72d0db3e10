"""What is asked before a file is written."""

from collections.abc import Sequence
from typing import Any

from nicegui import ui


async def choose(question: str, answers: Sequence[str]) -> str | None:
    """Ask for one of several answers.

    Parameters
    ----------
    question : str
        What is to be decided.
    answers : sequence of str
        The buttons, the harmless one last.

    Returns
    -------
    str or None
        The answer; None where the question was closed.
    """
    with ui.dialog() as dialog, ui.card().classes("ws-dialog"):
        ui.label(question)
        with ui.row():
            for text in answers:
                ui.button(text, on_click=_submit(dialog, text)).props("flat no-caps")
    answer: str | None = await dialog
    dialog.delete()
    return answer


async def ask_name(name: str) -> str | None:
    """Ask for the name of a file.

    Parameters
    ----------
    name : str
        A proposal.

    Returns
    -------
    str or None
        What was typed; None where nothing is to be written.
    """
    with ui.dialog() as dialog, ui.card().classes("ws-dialog"):
        field = ui.input("File name", value=name).props("outlined dense autofocus spellcheck=false")
        field.on("keydown.enter", lambda: dialog.submit(field.value))
        with ui.row():
            ui.button("Save", on_click=lambda: dialog.submit(field.value)).props("flat no-caps")
            ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
    answer: str | None = await dialog
    dialog.delete()
    return answer


async def ask_export(formats: Sequence[str], states: Sequence[str]) -> tuple[str, str] | None:
    """Ask what is to be exported.

    Parameters
    ----------
    formats, states : sequence of str
        Of the file, and of the wheel.

    Returns
    -------
    tuple of str or None
        A format and a state.
    """
    with ui.dialog() as dialog, ui.card().classes("ws-dialog"):
        ui.label("The wheel for CAD").classes("ws-caption")
        form = ui.select(list(formats), label="Format", value=formats[0]).props("outlined dense")
        state = ui.select(list(states), label="State", value=states[0]).props("outlined dense")
        with ui.row():
            ui.button("Download", on_click=lambda: dialog.submit((form.value, state.value))).props(
                "flat no-caps"
            )
            ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
    answer: tuple[str, str] | None = await dialog
    dialog.delete()
    return answer


def _submit(dialog: ui.dialog, answer: str) -> Any:
    return lambda: dialog.submit(answer)
