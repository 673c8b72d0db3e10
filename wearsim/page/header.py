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
            with ui.element("div").classes("ws-now").props("role=status aria-live=polite"):
                self._hours = ui.label().classes("ws-now-hours")
                self._state = ui.label().classes("ws-state")
            with ui.element("div").classes("ws-buttons").props('role=group aria-label="Actions"'):
                self._buttons = {action.name: _button(action) for action in actions}

    def show_file(self, name: str, dirty: bool) -> None:
        """Show which file is edited."""
        self._name.text = name
        self._dirty.set_visibility(dirty)

    def enable(self, name: str, can_run: bool) -> None:
        """Let a button be pressed, or not."""
        self._buttons[name].set_enabled(can_run)

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


def _button(action: Action) -> Any:
    shown = "" if action.is_icon_only else action.name
    button = ui.button(shown, icon=action.icon, on_click=action.run)
    return button.props(f'flat dense no-caps aria-label="{action.name}"')
