"""Running the cases of a study in threads of this process."""

import os
from collections.abc import Callable

import pandas as pd

from wearsim.runner.design import Design
from wearsim.runner.run_study import ProgressCount, run_study
from wearsim.runner.workers import Threads

Progress = Callable[[float], None]
"""Told how much is done, from 0 to 1."""


def silent(part: float) -> None:
    """Tell nobody."""


def run(design: Design, threads: int | None, progress: Progress) -> pd.DataFrame:
    """Return a row for each case of a study."""
    return run_study(design, threads_of(threads), None, counted(progress))


def threads_of(count: int | None) -> Threads:
    """Return so many threads, else one a core."""
    return Threads(count or os.cpu_count() or 1)


def counted(progress: Progress) -> ProgressCount:
    """Return what counts cases for a progress that takes a part of them."""
    return lambda done, count: progress(done / count)
