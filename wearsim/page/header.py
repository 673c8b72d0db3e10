"""The bar above: the file, what can be done with it, and the life always in sight."""

from collections.abc import Callable
from typing import Any

from nicegui import ui


class Header:
    """The bar of the page."""

    def __init__(
        self,
        on_new: Callable[[], Any],
        on_save: Callable[[], Any],
        on_save_as: Callable[[], Any],
        on_export: Callable[[], Any],
    ) -> None:
        with ui.header().classes("ws-header"):
            with ui.element("div").classes("ws-file"):
                ui.label("wearsim").classes("ws-brand")
                self._name = ui.label().classes("ws-name")
                self._dirty = ui.label("not saved").classes("ws-dirty")
            with ui.element("div").classes("ws-now").props("role=status aria-live=polite"):
                self._hours = ui.label().classes("ws-now-hours")
                self._state = ui.label().classes("ws-state")
            with ui.element("div").classes("ws-buttons"):
                for text, icon, action in (
                    ("New", "add", on_new),
                    ("Save", "save", on_save),
                    ("Save as", "save_as", on_save_as),
                    ("Export wheel", "download", on_export),
                ):
                    button = ui.button(text, icon=icon, on_click=action)
                    button.props(f'flat dense no-caps aria-label="{text}"')

    def show_file(self, name: str, dirty: bool) -> None:
        """Show which file is edited."""
        self._name.text = name
        self._dirty.set_visibility(dirty)

    def show_life(self, text: str) -> None:
        """Show the life, of whichever input the state says."""
        self._hours.text = text

    def show_state(self, state: str, text: str) -> None:
        """Show how the life belongs to the present input."""
        self._state.text = text
        self._hours.props["data-state"] = state
        self._state.props["data-state"] = state

    def show_progress(self, percent: int) -> None:
        """Show how far the calculation is."""
        lead = self._state.text.partition(" (")[0]
        self._state.text = f"{lead} ({percent} %)"
