"""Running the cases of a study in threads of this process."""

import os
from collections.abc import Callable
from typing import TYPE_CHECKING

from wearsim.errors import Range

if TYPE_CHECKING:
    import pandas as pd

    from wearsim.runner.design import Design
    from wearsim.runner.workers import Threads

Progress = Callable[[float], None]
"""Called with the fraction done, from 0 to 1."""


THREADS, SEED = Range(1, whole=True, optional=True), Range(0, whole=True)
"""What the arguments of these names may be."""


def silent(part: float) -> None:
    """Tell nobody."""


def run(design: "Design", threads: int | None, progress: Progress) -> "pd.DataFrame":
    """Return a row for each case of a study."""
    from wearsim.runner.run_study import run_study

    return run_study(design, threads_of(threads), None, lambda done, count: progress(done / count))


def threads_of(count: int | None) -> "Threads":
    """Return so many threads, else one a core."""
    from wearsim.runner.workers import Threads

    return Threads(count or os.cpu_count() or 1)
