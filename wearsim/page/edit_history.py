"""The inputs before the present one, to go back to."""


class EditHistory:
    """Inputs that were left, and those that undoing left; what is typed into one field is one step."""

    def __init__(self) -> None:
        self._before: list[str] = []
        self._after: list[str] = []
        self._typing = ""

    @property
    def can_undo(self) -> bool:
        """Whether there is an earlier input."""
        return bool(self._before)

    @property
    def can_redo(self) -> bool:
        """Whether an input was undone and nothing edited since."""
        return bool(self._after)

    def leave(self, text: str, typing: str) -> None:
        """Note the input that an edit leaves, and the field that is typed into.

        Examples
        --------
        >>> history = EditHistory()
        >>> for left in ("z = 1", "z = 12"):
        ...     history.leave(left, "z")
        >>> history.undo("z = 120"), history.can_undo, history.redo("z = 1")
        ('z = 1', False, 'z = 120')
        """
        if not typing or typing != self._typing:
            self._before.append(text)
        self._after.clear()
        self._typing = typing

    def undo(self, text: str) -> str:
        """Return the input before the present one."""
        self._after.append(text)
        self._typing = ""
        return self._before.pop()

    def redo(self, text: str) -> str:
        """Return the input that undoing left."""
        self._before.append(text)
        return self._after.pop()
