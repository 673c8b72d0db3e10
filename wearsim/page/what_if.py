"""Sliders for what one tries first: teeth, load and speed."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

from nicegui import ui

from wearsim.input.units import MAX
from wearsim.page.field_words import label
from wearsim.page.fields import value_at
from wearsim.page.text_elements import heading
from wearsim.quantities import quantities

_LOADS = ("load.tension_N", "load.power_kW", "load.torque_N_m", "load.speed_rpm")
_LEAST_TEETH = 9
_MOST_SPROCKETS = 2
"""More sprockets have fields only."""

Range = tuple[float, float]


@dataclass(frozen=True)
class Knob:
    """A number of the input that a slider changes."""

    key: str
    words: str  # what the slider is called
    value: float

    @property
    def is_whole(self) -> bool:
        """Whether it counts something."""
        return self.key.endswith("teeth")

    @property
    def around(self) -> Range:
        """Ends of a slider whose middle is near the present value: from half of it to its double."""
        low, high = self.value / 2.0, self.value * 2.0
        return (min(self.value, max(_LEAST_TEETH, low // 1)), high) if self.is_whole else (low, high)

    def text(self, value: float) -> str:
        """Return a value as it is written in the input.

        Examples
        --------
        >>> Knob("load.speed_rpm", "Speed", 120.0).text(133.333333)
        '133.3'
        """
        return f"{round(value)}" if self.is_whole else f"{value:.4g}"


def knobs(data: Mapping[str, Any]) -> list[Knob]:
    """Return what sliders can change: plain numbers above zero that the input gives.

    Examples
    --------
    >>> tables = {"sprocket": {"teeth": 20}, "load": {"power_kW": "3 hp", "speed_rpm": 100}}
    >>> [(knob.words, knob.value, knob.around) for knob in knobs(tables)]
    [('Teeth', 20, (10.0, 40.0)), ('Speed', 100, (50.0, 200.0))]
    """
    found = [*_teeth(data), *((key, label(key.partition(".")[2])) for key in _LOADS)]
    given = [(key, words, value_at(data, key)) for key, words in found]
    return [Knob(key, words, value) for key, words, value in given if _is_amount(value)]


class WhatIf:
    """The sliders in the place where it is made."""

    def __init__(self, on_edit: Callable[[str, str], None]) -> None:
        self._on_edit = on_edit
        self._shown: list[Knob] = []
        self._ranges: dict[str, Range] = {}
        self._place = ui.element("section").classes("ws-what-if").props('aria-label="What if"')

    def show(self, data: Mapping[str, Any] | None) -> None:
        """Show what an input gives; a slider keeps its ends while the value lies between them."""
        found = knobs(data or {})
        if found == self._shown:
            return
        self._shown = found
        kept = {knob.key: self._ranges.get(knob.key, knob.around) for knob in found}
        self._ranges = {
            knob.key: kept[knob.key] if _between(knob.value, kept[knob.key]) else knob.around
            for knob in found
        }
        self._place.set_visibility(bool(found))
        self._place.clear()
        with self._place:
            heading("What if")
            for knob in found:
                self._add(knob)

    def _add(self, knob: Knob) -> None:
        low, high = self._ranges[knob.key]
        unit = quantities()[knob.key.rpartition(".")[2]].unit
        ui.label(knob.words)
        slider = ui.slider(
            min=low, max=high, step=1 if knob.is_whole else (high - low) / 100, value=knob.value
        )
        slider.props["aria-label"] = f"What if: {knob.words}"
        slider.props["data-what-if"] = knob.key
        amount = ui.label(f"{knob.text(knob.value)} {unit}")
        slider.on_value_change(partial(_show_amount, amount, knob, unit))
        slider.on("change", lambda: self._on_edit(knob.key, knob.text(slider.value)))


def _show_amount(amount: ui.label, knob: Knob, unit: str, event: Any) -> None:
    amount.text = f"{knob.text(event.value)} {unit}"


def _teeth(data: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    sprockets = data.get("sprocket")
    if not isinstance(sprockets, list):
        yield "sprocket.teeth", "Teeth"
        return
    for number, sprocket in enumerate(sprockets[:_MOST_SPROCKETS], start=1):
        named = sprocket.get("name") if isinstance(sprocket, Mapping) else None
        yield f"sprocket.{number}.teeth", f"Teeth, {named or f'sprocket {number}'}"


def _is_amount(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and 0.0 < value <= MAX


def _between(value: float, ends: Range) -> bool:
    return ends[0] <= value <= ends[1]
