"""The bar above: the file, what can be done with it, and the life always in sight."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from nicegui import ui


@dataclass(frozen=True)
class Action:
    """Something that a button of the bar does."""

    name: str
    icon: str
    run: Callable[[], Any]
    is_icon_only: bool = False


class Header:
    """The bar of the page."""

    def __init__(self, actions: Sequence[Action]) -> None:
        with ui.header().classes("ws-header"):
            with ui.element("div").classes("ws-file"):
                ui.label("wearsim").classes("ws-brand").props("role=heading aria-level=1")
                self._name = ui.label().classes("ws-name")
                self._dirty = ui.label("not saved").classes("ws-dirty")
            self._places = ui.element("nav").classes("ws-places").props('aria-label="On this page"')
            with ui.element("div").classes("ws-now").props("role=status aria-live=polite"):
                self._hours = ui.label().classes("ws-now-hours")
                with ui.element("div").classes("ws-state") as self._state:
                    self._words = ui.label()
                    # Not said by a screen reader at every percent.
                    self._percent = ui.label().props("aria-hidden=true")
            with ui.element("div").classes("ws-buttons").props('role=group aria-label="Actions"'):
                self._buttons = {action.name: _button(action) for action in actions}

    def show_file(self, name: str, dirty: bool) -> None:
        """Show which file is edited."""
        self._name.text = name
        self._dirty.set_visibility(dirty)

    def link(self, name: str, place: ui.element) -> None:
        """Add a link to a part of the page, for screens on which the parts stand one below the other."""
        with self._places:
            ui.link(name, place)

    def enable(self, name: str, can_run: bool) -> None:
        """Let a button be pressed, or not."""
        self._buttons[name].set_enabled(can_run)

    def show_life(self, text: str) -> None:
        """Show the life, of whichever input the state says."""
        self._hours.text = text

    def show_state(self, state: str, text: str) -> None:
        """Show how the life belongs to the present input."""
        self._words.text, self._percent.text = text, ""
        self._hours.props["data-state"] = state
        self._state.props["data-state"] = state

    def show_progress(self, percent: int) -> None:
        """Show how far the calculation is."""
        self._percent.text = f"({percent} %)"


def _button(action: Action) -> Any:
    shown = "" if action.is_icon_only else action.name
    button = ui.button(shown, icon=action.icon, on_click=action.run)
    return button.props(f'flat dense no-caps aria-label="{action.name}"')
