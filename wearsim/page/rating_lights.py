"""The ratings of a drive as lights: within, near or outside what a handbook allows."""

from collections.abc import Iterable

from nicegui import ui

from wearsim.chain.selection import RatingFinding
from wearsim.page.text_elements import heading, text_element, used_part
from wearsim.quantities import grouped

_NEAR = 0.9
"""Part of a limit from which a rating counts as near it."""


def light(one: RatingFinding) -> str:
    """Return whether a rating is within, near or outside its limit.

    Examples
    --------
    >>> light(RatingFinding("power", 4.3, 4.6, "kW", "ISO 10823"))
    'near'
    """
    if not one.ok:
        return "outside"
    return "near" if one.used >= _NEAR else "within"


def rating_list(ratings: Iterable[RatingFinding]) -> None:
    """Add every rating with its light, how much of its limit is used, and both numbers."""
    heading("Ratings")
    with ui.element("dl").classes("ws-margins"):
        for one in ratings:
            text_element("dt", one.name)
            sign = "≥" if one.at_least else "≤"
            text = f"{grouped(one.value)} {sign} {grouped(one.limit)} {one.unit}".rstrip()
            with used_part(one.name, one.used, text):
                ui.label(light(one)).classes("ws-light").props(f"data-light={light(one)}")
