"""Running a study: what is not finished goes to the workers, and is kept as it comes back."""

import sys
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from contextlib import suppress
from itertools import islice

import numpy as np
import pandas as pd

from wearsim.errors import StudyError
from wearsim.runner.design import Design
from wearsim.runner.shard import COLUMNS, TEXTS, Rows, Shard, life_columns, run_shard, shards
from wearsim.runner.store import Store
from wearsim.runner.workers import Workers
from wearsim.wear.accuracy import EXCEEDS

_AHEAD = 3
"""Shards that wait with every worker."""

_MAX_LOSSES = 3
"""Times in a row that workers may die before anything is finished."""

_OFTEN = tuple(name for name in TEXTS if name != "case_sha256")
"""Texts that many cases have; a hash is its own case's, and the table of a million texts takes 60 MB."""

ProgressCount = Callable[[int, int], None]


def run_study(
    design: Design,
    workers: Workers,
    store: Store | None = None,
    progress: ProgressCount = lambda done, count: None,
) -> pd.DataFrame:
    """Run the cases of a study that are not finished yet."""
    done, waiting, losses = _Done(design), [], 0
    for shard in shards(design):
        rows = store.finished(shard) if store is not None else None
        if rows is None:
            waiting.append(shard.first)
        else:
            done.add(shard, rows)
    progress(done.count, len(design.rows))
    while waiting:
        before = done.count
        for shard, rows in _run(shards(design, waiting), workers):
            if store is not None:
                store.save(shard, rows)
            done.add(shard, rows)
            progress(done.count, len(design.rows))
        waiting = [first for first in waiting if not done.has(first)]
        losses = losses + 1 if done.count == before else 0
        if losses == _MAX_LOSSES:
            raise StudyError(
                f"workers died {losses} times before they had finished anything: take fewer of them "
                "or give them more memory; what is finished is kept"
            )
    return done.table()


def missed_tolerance(table: pd.DataFrame) -> str:
    """Return how many lives of a study miss their tolerance and by how much; empty where none does."""
    missed = table[table["warnings"].str.contains(EXCEEDS, regex=False)]
    if missed.empty:
        return ""
    what = "misses its" if len(missed) == 1 else "miss their"
    sound = (table["error"] == "").sum()
    return (
        f"{len(missed)} of {sound} cases {what} run.life_tolerance, with a stated error of up to "
        f"{100.0 * missed['numerical_error'].max():.2g} %"
    )


def failures(table: pd.DataFrame) -> str:
    """Return how many cases of a study have failed and why the first one has; empty where none has.

    Raises `StudyError` where all have.
    """
    failed = table[table["error"] != ""]
    if failed.empty:
        return ""
    first = failed.iloc[0]
    what = f"{len(failed)} of {len(table)} cases failed, first case {first.case_index}: {first.error}"
    if len(failed) == len(table):
        raise StudyError(what)
    return what


def _run(remaining: Iterator[Shard], workers: Workers) -> Iterator[tuple[Shard, Rows]]:
    """Give shards as they are finished, until all are or a worker has died."""
    with workers.open() as (executor, count):
        futures = _submitted(executor, workers, islice(remaining, (1 + _AHEAD) * count))
        try:
            while futures:
                finished, _ = wait(futures, return_when=FIRST_COMPLETED)
                lost = False
                for future in finished:
                    shard = futures.pop(future)
                    try:
                        rows = future.result()
                    except workers.losses:
                        lost = True
                    else:
                        yield shard, rows
                if lost:
                    remaining = iter(())
                futures |= _submitted(executor, workers, islice(remaining, len(finished)))
        finally:
            for future in futures:
                future.cancel()


def _submitted(executor: Executor, workers: Workers, shards: Iterator[Shard]) -> dict["Future[Rows]", Shard]:
    """Submit shards, no more once a worker has died: those are run when workers are opened again."""
    found = {}
    with suppress(*workers.losses):
        for shard in shards:
            found[executor.submit(run_shard, shard)] = shard
    return found


class _Done:
    """What is finished of a study: a million cases take some 250 MB, as equal texts are kept once."""

    def __init__(self, design: Design) -> None:
        self.count, self._design = 0, design
        self._runs = np.zeros(len(design.rows), bool)
        self._columns = {
            name: np.full(len(design.rows), None, object)
            if name in TEXTS
            else np.full(len(design.rows), np.nan)
            for name in (*COLUMNS[1:], *life_columns(design))
        }

    def has(self, first: int) -> bool:
        """Return whether the shard that begins there is finished."""
        return bool(self._runs[first])

    def add(self, shard: Shard, rows: Rows) -> None:
        """Take the rows of a shard."""
        place = slice(shard.first, shard.first + shard.count)
        for name, column in self._columns.items():
            often = name in _OFTEN
            column[place] = [text and sys.intern(text) for text in rows[name]] if often else rows[name]
        self._runs[place] = True
        self.count += shard.count

    def table(self) -> pd.DataFrame:
        """Return a row for each case: its number, the values of the keys, what is known of its life."""
        rows, keys = self._design.rows, self._design.keys
        given = {key: pd.Series([row[place] for row in rows]) for place, key in enumerate(keys)}
        found = {
            name: pd.Series(column, dtype=column.dtype, copy=False) for name, column in self._columns.items()
        }
        return pd.DataFrame({"case_index": np.arange(len(rows)), **given, **found}, copy=False)
