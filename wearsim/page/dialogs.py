"""What is asked before a file is written."""

from collections.abc import Mapping, Sequence
from typing import Any

from nicegui import ui


def named_dialog(name: str) -> ui.dialog:
    """Return a dialog with a name that a screen reader says."""
    dialog = ui.dialog()
    dialog.props["aria-label"] = name
    return dialog


async def choose(question: str, answers: Sequence[str]) -> str | None:
    """Ask for one of several answers."""
    with named_dialog("Question") as dialog, ui.card().classes("ws-dialog"):
        ui.label(question)
        with ui.row():
            for text in answers:
                ui.button(text, on_click=_submit(dialog, text)).props("flat no-caps")
    answer: str | None = await dialog
    dialog.delete()
    return answer


async def ask_name(name: str) -> str | None:
    """Ask for the name of a file."""
    with named_dialog("Save as") as dialog, ui.card().classes("ws-dialog"):
        field = ui.input("File name", value=name).props("outlined dense autofocus spellcheck=false")
        field.on("keydown.enter", lambda: dialog.submit(field.value))
        with ui.row():
            ui.button("Save", on_click=lambda: dialog.submit(field.value)).props("flat no-caps")
            ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
    answer: str | None = await dialog
    dialog.delete()
    return answer


async def ask_example(titles: Mapping[str, str]) -> str | None:
    """Ask for one of the shipped cases, by its title and name."""
    options = {name: f"{title} ({name})" for name, title in titles.items()}
    with named_dialog("Examples") as dialog, ui.card().classes("ws-dialog ws-questions"):
        ui.label("Start from an example").classes("ws-caption")
        chosen = ui.select(options, label="Example", value=next(iter(options)), with_input=True)
        chosen.props("outlined dense")
        with ui.row():
            ui.button("Open", on_click=lambda: dialog.submit(chosen.value)).props("flat no-caps")
            ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
    answer: str | None = await dialog
    dialog.delete()
    return answer


async def ask_export(
    wheels: Sequence[str], formats: Sequence[str], states: Sequence[str]
) -> tuple[str, str, str] | None:
    """Ask which wheel is to be exported, and how."""
    with named_dialog("Export wheel") as dialog, ui.card().classes("ws-dialog"):
        ui.label("Export for CAD").classes("ws-caption")
        wheel = ui.select(list(wheels), label="Sprocket", value=wheels[0]).props("outlined dense")
        wheel.set_visibility(len(wheels) > 1)
        form = ui.select(list(formats), label="Format", value=formats[0]).props("outlined dense")
        state = ui.select(list(states), label="State", value=states[0]).props("outlined dense")
        with ui.row():
            button = ui.button("Download").props("flat no-caps")
            button.on_click(lambda: dialog.submit((wheel.value, form.value, state.value)))
            ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
    answer: tuple[str, str, str] | None = await dialog
    dialog.delete()
    return answer


def _submit(dialog: ui.dialog, answer: str) -> Any:
    return lambda: dialog.submit(answer)
