"""The bar that shows on a terminal how far a study is."""

from collections.abc import Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    ProgressColumn,
    Task,
    TextColumn,
    TimeRemainingColumn,
)
from rich.text import Text

from wearsim.quantities import grouped
from wearsim.runner.run_study import ProgressCount


@contextmanager
def progress_count(text: str) -> Iterator[ProgressCount]:
    """Show on stderr how many cases are done, at what rate, and the time left."""
    columns = (
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        MofNCompleteColumn(),
        _Rate(),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(text, total=None)
        yield lambda done, count: bar.update(task, completed=done, total=count)


class _Rate(ProgressColumn):
    """Cases in a second, once that is known."""

    def render(self, task: Task) -> Text:
        speed = task.finished_speed or task.speed
        return Text("" if speed is None else f"{grouped(speed, 3)}/s", style="progress.data.speed")
