"""A pinned run beside the present one: what was changed, and what became of the lives."""

from collections.abc import Mapping

from nicegui import ui

from wearsim.input.document import leaves
from wearsim.page.text_elements import heading, row_list
from wearsim.page.toml_source import parsed_tables
from wearsim.result import Life, LowerBound
from wearsim.result.lives import hours

Lives = Mapping[str, Life | LowerBound]


class Comparison:
    """The pinned run in the place where it is made; nothing is seen while none is pinned."""

    def __init__(self) -> None:
        self._present: tuple[str, Lives] = "", {}
        self._pinned: tuple[str, Lives] | None = None
        self._card = ui.element("section").classes("ws-card ws-comparison")
        self._card.props('aria-label="Comparison with the pinned run"').set_visibility(False)

    def pin(self) -> None:
        """Keep the present run."""
        self._pinned = self._present
        self._fill()

    def show(self, text: str, lives: Lives) -> None:
        """Show the lives of an input beside those of the pinned run."""
        self._present = text, lives
        self._card.classes(remove="ws-old")
        self._fill()

    def mark_old(self) -> None:
        """Mark the comparison as that of an earlier input."""
        self._card.classes("ws-old")

    def _unpin(self) -> None:
        self._pinned = None
        self._fill()

    def _fill(self) -> None:
        self._card.set_visibility(self._pinned is not None)
        self._card.clear()
        if self._pinned is None:
            return
        with self._card:
            heading("Compared with the pinned run")
            row_list(compared_rows(*self._pinned, *self._present))
            ui.button("Unpin", icon="close", on_click=self._unpin).props("flat dense no-caps")


def compared_rows(before_text: str, before: Lives, after_text: str, after: Lives) -> list[tuple[str, str]]:
    """Return what was changed from one input to another, and their lives.

    Examples
    --------
    >>> compared_rows("a = 1", {"life": Life(1, 8000)}, "a = 2", {"life": Life(1, 10000)})
    [('life', 'before 8 000 h, after 10 000 h (+25 %)'), ('Changed', 'a: 1, now 2')]
    """
    rows = []
    for name in dict.fromkeys([*before, *after]):
        texts = [f"{word} {hours(lives[name])}" for word, lives in _sides(before, after) if name in lives]
        told = ", ".join(texts) + _change(before.get(name), after.get(name))
        rows.append((name, told))
    return [*rows, ("Changed", "; ".join(_changes(before_text, after_text)) or "nothing yet")]


def _sides(before: Lives, after: Lives) -> tuple[tuple[str, Lives], tuple[str, Lives]]:
    return ("before", before), ("after", after)


def _change(before: Life | LowerBound | None, after: Life | LowerBound | None) -> str:
    """Return how much longer a life has become, empty where a life is not known."""
    if not isinstance(before, Life) or not isinstance(after, Life):
        return ""
    return f" ({100.0 * (after.hours / before.hours - 1.0):+.3g} %)"


def _changes(before: str, after: str) -> list[str]:
    old, new = (dict(leaves(parsed_tables(text) or {})) for text in (before, after))
    keys = [key for key in dict.fromkeys([*old, *new]) if old.get(key) != new.get(key)]
    return [f"{key}: {old.get(key, 'not given')}, now {new.get(key, 'not given')}" for key in keys]
