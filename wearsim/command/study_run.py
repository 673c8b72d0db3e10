"""Running the cases of a study for its command, and what is told of that."""

import sys
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import closing, contextmanager
from typing import TYPE_CHECKING, Any

import click

from wearsim.command.options import SOME_FAILED, warn
from wearsim.command.study import StudyOptions
from wearsim.quantities import time_in_words

if TYPE_CHECKING:
    import pandas as pd

    from wearsim.runner.design import Design
    from wearsim.runner.run_study import ProgressCount
    from wearsim.runner.store import Store

INTERRUPTED = 130


def run(
    design: "Design", options: StudyOptions, identity: Mapping[str, Any], text: str
) -> "pd.DataFrame | None":
    """Run the cases of a study, or only tell what it would take."""
    from wearsim.runner.run_study import run_study
    from wearsim.runner.store import check_store

    workers = options.workers()
    if options.dry_run:
        if options.out is not None:
            check_store(options.out, design, identity, options.force)
        _show_plan(design, options)
        return None
    store = _store(design, options, identity)
    if len(design.rows) > _LARGE:
        _say_time(design, store)
    with _interrupted(options), _counting(text) as count:
        return run_study(design, workers, store, count)


@contextmanager
def in_batches(
    design: "Design", options: StudyOptions, identity: Mapping[str, Any], text: str, most_cases: int
) -> "Iterator[Callable[[Design], pd.DataFrame]]":
    """Run cases of a study batch by batch, where each depends on the ones before."""
    from wearsim.runner.run_study import run_study
    from wearsim.runner.workers import SharedWorkers

    workers, done = SharedWorkers(options.workers()), 0
    store = _store(design, options, identity)
    with _interrupted(options), closing(workers), _counting(text) as count:

        def run_batch(part: "Design") -> "pd.DataFrame":
            nonlocal done
            table = run_study(part, workers, store, lambda now, _: count(done + now, most_cases))
            done += len(part.rows)
            return table

        yield run_batch


def _store(design: "Design", options: StudyOptions, identity: Mapping[str, Any]) -> "Store | None":
    if options.out is None:
        return None
    from wearsim.extras import library
    from wearsim.runner.store import open_store

    library("pyarrow", "study", "--out")
    return open_store(options.out, design, identity, options.force)


@contextmanager
def _interrupted(options: StudyOptions) -> "Iterator[None]":
    """End on Ctrl-C, and say how to go on."""
    try:
        yield
    except KeyboardInterrupt:
        kept = "nothing is kept without --out"
        if options.out is not None:
            kept = f"what is finished is kept in {options.out}: run the same command again to go on"
        click.echo(f"interrupted: {kept}", err=True)
        raise click.exceptions.Exit(INTERRUPTED) from None


def exit_code(table: "pd.DataFrame") -> int:
    """Return 5 where cases have failed, and tell how many."""
    from wearsim.runner.run_study import failures

    what = failures(table)
    if not what:
        return 0
    warn(f"warning: {what}")
    return SOME_FAILED


_LARGE = 10_000
"""Cases of a study that says how long it takes before it begins."""


def _say_time(design: "Design", store: "Store | None") -> None:
    waiting, _ = _to_run(design, store)
    seconds, _ = timed(design)
    warn(f"{waiting} cases are to be run, about {time_in_words(seconds * waiting)} in one thread")


def _to_run(design: "Design", store: "Store | None") -> tuple[int, int]:
    """Return how many cases are not finished, and the number of all shards."""
    from wearsim.runner.shard import shards

    waiting, shard_count = 0, 0
    for shard in shards(design):
        shard_count += 1
        if store is None or not store.path(shard).exists():
            waiting += shard.count
    return waiting, shard_count


def _show_plan(design: "Design", options: StudyOptions) -> None:
    from wearsim.runner.store import Store

    waiting, shard_count = _to_run(design, None if options.out is None else Store(options.out))
    seconds, count = timed(design)
    click.echo(f"cases        {len(design.rows)}, of which {waiting} are to be run")
    click.echo(f"time         about {time_in_words(seconds * waiting)} in one thread, from {count} cases")
    if options.out is not None:
        click.echo(f"files        {shard_count} in {options.out / 'shards'}, and tables beside it")


def timed(design: "Design") -> tuple[float, int]:
    """Return the time that a case takes."""
    from wearsim.runner.shard import Shard, run_shard, shards

    first = next(shards(design))
    some = Shard(0, first.design.part(0, min(_TIMED, first.count)), first.engine)
    run_shard(Shard(0, first.design.part(0, 1), first.engine))
    start = time.perf_counter()
    run_shard(some)
    return (time.perf_counter() - start) / some.count, some.count


_TIMED = 4
"""Cases that a dry run times."""


@contextmanager
def _counting(text: str) -> "Iterator[ProgressCount]":
    """Show on a terminal how many cases are done, at what rate, and the time left."""
    from wearsim.jit.compiled import compile_expected

    compile_expected()
    quiet = click.get_current_context().find_root().meta.get("wearsim.quiet")
    if quiet or not sys.stderr.isatty():
        yield lambda done, count: None
        return
    from wearsim.command.progress_bar import progress_count

    with progress_count(text) as progress:
        yield progress
