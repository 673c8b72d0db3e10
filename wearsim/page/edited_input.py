"""An input on its way to its answer."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

from wearsim.input.document import CaseText, retitled
from wearsim.page.case_file import CaseFile
from wearsim.page.threads import in_thread
from wearsim.page.toml_source import parsed_tables

Found = TypeVar("Found")


class StaleError(Exception):
    """Nobody waits for the answer any more."""


@dataclass(frozen=True)
class EditedInput:
    """An input that is answered until there is a newer one."""

    source: CaseText
    file: CaseFile  # as it is on disk
    is_stale: Callable[[], bool]
    report_progress: Callable[[float], None]

    async def step(self, work: Callable[[], Found]) -> Found:
        """Wait for work in a thread, or raise where nobody waits for it any more."""
        found = await in_thread(work)
        self.check()
        return found

    def check(self, part: float = 0.0) -> None:
        """Raise where nobody waits for the answer any more, however much of a run is done."""
        if self.is_stale():
            raise StaleError

    def watch(self, part: float) -> None:
        """Tell how much of a run is done, or end it where nobody waits for it."""
        self.check()
        self.report_progress(part)


def edited_title(source: CaseText, file: CaseFile) -> str:
    """Return a title that tells what is no longer as it began, empty where the input has none."""
    tables, written = parsed_tables(source.text) or {}, parsed_tables(file.begun) or {}
    return str(retitled(tables, written).get("title") or "")
