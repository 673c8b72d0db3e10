"""Faults of the input: shown when a field is left, not while it is still being typed into."""

from collections.abc import Sequence

from wearsim.errors import Fault
from wearsim.page.form_panel import FormPanel
from wearsim.page.header import Header
from wearsim.page.text_elements import FaultList


class FaultView:
    """What is wrong with the input: beside its fields, in a list, and in the bar above."""

    def __init__(self, form: FormPanel, faults: FaultList, header: Header) -> None:
        self._form, self._list, self._header = form, faults, header
        self._typing = False
        self._held: Sequence[Fault] = ()  # not shown yet
        self._has_result = False

    def begin(self, typing: bool) -> None:
        """Note another input, and whether it is still being typed."""
        self._typing, self._held = typing, ()

    def complete(self) -> None:
        """Note that what was typed is complete, and show what is wrong with it."""
        self._typing = False
        if self._held:
            self._show(self._held)

    def clear(self) -> None:
        """Show that nothing is wrong."""
        self._has_result = True
        self._form.show_faults(())
        self._list.show(())

    def fail(self, faults: Sequence[Fault]) -> None:
        """Show faults, or where something is being typed that there is no answer to it yet."""
        if self._typing and not self._list.is_shown:
            self._held = faults
            self._tell("incomplete", "input incomplete")
        else:
            self._show(faults)

    def _show(self, faults: Sequence[Fault]) -> None:
        self._held = ()
        self._form.show_faults(faults)
        self._list.show(faults)
        self._tell("old", "input error" if len(faults) == 1 else f"{len(faults)} input errors")

    def _tell(self, state: str, what: str) -> None:
        shown = "showing the previous result" if self._has_result else "no result yet"
        self._header.show_state(state, f"{what}: {shown}")
