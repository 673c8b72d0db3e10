"""Pieces of text that answers are made of; every text is shown as it is, never as markup."""

from collections.abc import Iterable, Sequence

from nicegui import ui

from wearsim.errors import Fault


class FaultList:
    """What is wrong with the input, in the place where it is made."""

    def __init__(self) -> None:
        self._place = ui.element("section").classes("ws-faults").props("role=alert")
        self.show(())

    @property
    def is_shown(self) -> bool:
        """Whether there are faults to be seen."""
        return bool(self._place.visible)

    def show(self, faults: Sequence[Fault]) -> None:
        """Show faults, or nothing."""
        self._place.set_visibility(bool(faults))
        self._place.clear()
        with self._place:
            for fault in faults:
                ui.label(str(fault)).classes("ws-fault")


def text_element(tag: str, text: str) -> ui.element:
    """Add an element that holds a text."""
    with ui.element(tag) as element:
        ui.label(text)
    return element


def heading(text: str) -> None:
    """Add the heading of a card."""
    ui.label(text).classes("ws-caption").props("role=heading aria-level=2")


def row_list(rows: Iterable[tuple[str, str]]) -> None:
    """Add texts with their labels."""
    with ui.element("dl").classes("ws-findings"):
        for label, text in rows:
            text_element("dt", label)
            text_element("dd", text)


def warning_list(warnings: Sequence[str]) -> None:
    """Add warnings, nothing of none."""
    if not warnings:
        return
    with ui.element("ul").classes("ws-warnings").props('aria-label="Warnings"'):
        for text in warnings:
            text_element("li", text)


def assumption_list(stated: Sequence[str], defaults: Sequence[str]) -> None:
    """Add what an answer takes for granted."""
    heading("Assumptions")
    with ui.element("ol"):
        for text in stated:
            text_element("li", text)
    if defaults:
        text_element("p", f"Defaults taken: {'; '.join(defaults)}").classes("ws-muted")


def used_part(name: str, used: float, text: str) -> ui.element:
    """Add how much of a limit is used, in words and as a meter; return what holds both."""
    with ui.element("dd") as place:
        meter = ui.element("meter").props("min=0 max=1.01 low=0.9 high=1 optimum=0")
        meter.props["value"] = round(min(used, 1.01), 4)
        meter.props["aria-label"] = f"used part of {name}"
        ui.label(f"{text} ({100.0 * used:.0f} %)")
    return place
