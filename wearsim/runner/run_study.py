"""Running a study: what is not finished goes to the workers, and is kept as it comes back."""

from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from contextlib import suppress
from itertools import islice

import pandas as pd

from wearsim.errors import StudyError
from wearsim.runner.design import Design
from wearsim.runner.shard import COLUMNS, Rows, Shard, life_columns, run_shard, shards
from wearsim.runner.store import Store
from wearsim.runner.workers import Workers
from wearsim.wear.accuracy import EXCEEDS

_AHEAD = 3
"""Shards that wait with every worker."""

_MAX_LOSSES = 3
"""Times in a row that workers may die before anything is finished."""

ProgressCount = Callable[[int, int], None]


def run_study(
    design: Design,
    workers: Workers,
    store: Store | None = None,
    progress: ProgressCount = lambda done, count: None,
) -> pd.DataFrame:
    """Run the cases of a study that are not finished yet."""
    done: dict[int, Rows] = {}
    waiting: list[Shard] = []
    for shard in shards(design):
        rows = store.finished(shard) if store is not None else None
        if rows is None:
            waiting.append(shard)
        else:
            done[shard.first] = rows
    count = sum(len(rows["case_index"]) for rows in done.values())
    progress(count, len(design.rows))
    losses = 0
    while waiting:
        before = len(done)
        for shard, rows in _run(waiting, workers):
            if store is not None:
                store.save(shard, rows)
            done[shard.first] = rows
            count += shard.count
            progress(count, len(design.rows))
        waiting = [shard for shard in waiting if shard.first not in done]
        losses = losses + 1 if len(done) == before else 0
        if losses == _MAX_LOSSES:
            raise StudyError(
                f"workers died {losses} times before they had finished anything: take fewer of them "
                "or give them more memory; what is finished is kept"
            )
    return _table(design, [done[first] for first in sorted(done)])


def missed_tolerance(table: pd.DataFrame) -> str:
    """Return how many cases of a study miss their tolerance and by how much; empty where none does."""
    missed = table[table["warnings"].str.contains(EXCEEDS, regex=False)]
    if missed.empty:
        return ""
    what = "misses its" if len(missed) == 1 else "miss their"
    return (
        f"{len(missed)} of {len(table)} cases {what} run.life_tolerance, with a stated error of up to "
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


def _run(waiting: list[Shard], workers: Workers) -> Iterator[tuple[Shard, Rows]]:
    """Give shards as they are finished, until all are or a worker has died."""
    remaining = iter(waiting)
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


def _table(design: Design, parts: list[Rows]) -> pd.DataFrame:
    lives = life_columns(design)
    columns = {name: [value for rows in parts for value in rows[name]] for name in (*COLUMNS, *lives)}
    given = pd.DataFrame(list(design.rows), columns=list(design.keys))
    table = pd.DataFrame(columns)
    floats = ("life_hours", "hours_run", "cycles_run", "numerical_error", *lives)
    table = table.astype(dict.fromkeys(floats, float))
    return pd.concat([table[["case_index"]], given, table.drop(columns="case_index")], axis=1)
