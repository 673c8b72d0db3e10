"""What the commands of studies share: where they run, what is printed of it, and the exit code."""

import os
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import closing, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from wearsim.cli.standard import SOME_FAILED, warn
from wearsim.errors import StudyError

if TYPE_CHECKING:
    import pandas as pd

    from wearsim.study.runner.design import Design
    from wearsim.study.runner.run import Told
    from wearsim.study.runner.store import Store
    from wearsim.study.runner.workers import Workers

Function = TypeVar("Function", bound=Callable[..., Any])

INTERRUPTED = 130


@dataclass(frozen=True)
class Place:
    """Where a study runs and what is kept of it.

    Attributes
    ----------
    out : pathlib.Path or None
        Its folder.
    force : bool
        Replace the folder of another study.
    dry_run : bool
        Only tell what it would take.
    jobs : int or None
        Processes in place of threads.
    threads : int or None
        Threads; as many as there are cores where neither is given.
    scheduler : str or None
        Address of a Dask scheduler.
    scheduler_file : pathlib.Path or None
        File that it wrote.
    tls : mapping
        Files for encryption.
    """

    out: Path | None
    force: bool
    dry_run: bool
    jobs: int | None
    threads: int | None
    scheduler: str | None
    scheduler_file: Path | None
    tls: Mapping[str, str]

    def workers(self) -> "Workers":
        """Return the workers that were asked for."""
        from wearsim.study.runner.workers import Cluster, Processes, Threads

        asked = [
            name
            for name, value in (
                ("--jobs", self.jobs), ("--threads", self.threads), ("--scheduler", self.scheduler),
                ("--scheduler-file", self.scheduler_file),
            )
            if value is not None
        ]  # fmt: skip
        if len(asked) > 1:
            raise click.UsageError(f"{' and '.join(asked)} do not go together: give one of them")
        if self.tls and not {"--scheduler", "--scheduler-file"} & set(asked):
            raise click.UsageError("the --tls options need --scheduler or --scheduler-file")
        if self.scheduler is not None or self.scheduler_file is not None:
            return Cluster(self.scheduler, self.scheduler_file, dict(self.tls))
        if self.jobs is not None:
            return Processes(self.jobs)
        return Threads(self.threads or os.cpu_count() or 1)


def place_options(function: Function) -> Function:
    """Add the options that tell where a study runs, as the argument ``place``.

    Parameters
    ----------
    function : callable
        Command to be.

    Returns
    -------
    callable
        The same with more options.
    """
    from functools import wraps

    @wraps(function)
    def command(
        *arguments: Any, out: Path | None, force: bool, dry_run: bool, jobs: int | None,
        threads: int | None, scheduler: str | None, scheduler_file: Path | None,
        tls_ca_file: Path | None, tls_cert: Path | None, tls_key: Path | None, **others: Any,
    ) -> Any:  # fmt: skip
        files = {
            "tls_ca_file": tls_ca_file, "tls_client_cert": tls_cert, "tls_client_key": tls_key,
        }  # fmt: skip
        tls = {name: str(path) for name, path in files.items() if path is not None}
        place = Place(out, force, dry_run, jobs, threads, scheduler, scheduler_file, tls)
        return function(*arguments, place=place, **others)

    for option in reversed(_OPTIONS):
        command = option(command)
    return command  # type: ignore[return-value]


_FILE = click.Path(path_type=Path, exists=True, dir_okay=False)
_OPTIONS = (
    click.option(
        "--out", type=click.Path(path_type=Path),
        help="Folder of the study; run again, it goes on from what is finished there.",
    ),
    click.option("--force", is_flag=True, help="Take the folder of another study."),
    click.option(
        "--dry-run", is_flag=True, help="Tell the number of cases, the time and the files only."
    ),
    click.option("--threads", type=click.IntRange(min=1), help="Threads; else one a core."),
    click.option("--jobs", type=click.IntRange(min=1), help="Processes in place of threads."),
    click.option(
        "--scheduler", metavar="ADDRESS",
        help="Dask scheduler such as tcp://127.0.0.1:8786 (pip install 'wearsim[dask]').",
    ),
    click.option("--scheduler-file", type=_FILE, help="File that the Dask scheduler wrote."),
    click.option("--tls-ca-file", type=_FILE, help="Certificate of the authority, for TLS."),
    click.option("--tls-cert", type=_FILE, help="Own certificate, for TLS."),
    click.option("--tls-key", type=_FILE, help="Own key, for TLS."),
)  # fmt: skip


def run(
    design: "Design", place: Place, told: Mapping[str, Any], text: str
) -> "pd.DataFrame | None":
    """Run the cases of a study, or only tell what it would take.

    Parameters
    ----------
    design : Design
        Its cases.
    place : Place
        Where they run.
    told : mapping
        What the manifest of the folder tells of the study.
    text : str
        What is shown beside the bar.

    Returns
    -------
    pandas.DataFrame or None
        A row for each case; None for a dry run.
    """
    from wearsim.study.runner.run import run_study
    from wearsim.study.runner.store import check_store

    workers = place.workers()
    if place.dry_run:
        if place.out is not None:
            check_store(place.out, design, told, place.force)
        _show_plan(design, place)
        return None
    store = _store(design, place, told)
    with _interrupted(place), _counting(text) as count:
        return run_study(design, workers, store, count)


@contextmanager
def in_batches(
    design: "Design", place: Place, told: Mapping[str, Any], text: str, most: int
) -> "Iterator[Callable[[Design], pd.DataFrame]]":
    """Run cases of a study batch by batch, where each depends on the ones before.

    Parameters
    ----------
    design : Design
        What all batches have in common; its hash and ``told`` are those of the study.
    place : Place
        Where they run.
    told : mapping
        What the manifest of the folder tells of the study.
    text : str
        What is shown beside the bar.
    most : int
        Cases of all batches at most.

    Yields
    ------
    callable
        Runs a batch and returns a row for each case.
    """
    from wearsim.study.runner.run import run_study
    from wearsim.study.runner.workers import KeptOpen

    workers, done = KeptOpen(place.workers()), 0
    store = _store(design, place, told)
    with _interrupted(place), closing(workers), _counting(text) as count:

        def run_batch(part: "Design") -> "pd.DataFrame":
            nonlocal done
            table = run_study(part, workers, store, lambda now, _: count(done + now, most))
            done += len(part.rows)
            return table

        yield run_batch


def _store(design: "Design", place: Place, told: Mapping[str, Any]) -> "Store | None":
    if place.out is None:
        return None
    from wearsim.extras import library
    from wearsim.study.runner.store import open_store

    library("pyarrow", "study", "--out")
    return open_store(place.out, design, told, place.force)


@contextmanager
def _interrupted(place: Place) -> "Iterator[None]":
    """End on Ctrl-C, and say how to go on."""
    try:
        yield
    except KeyboardInterrupt:
        kept = "nothing is kept without --out"
        if place.out is not None:
            kept = f"what is finished is kept in {place.out}: run the same command again to go on"
        click.echo(f"interrupted: {kept}", err=True)
        raise click.exceptions.Exit(INTERRUPTED) from None


def exit_code(table: "pd.DataFrame") -> int:
    """Return 5 where cases have failed, and tell how many.

    Parameters
    ----------
    table : pandas.DataFrame
        A row for each case.

    Returns
    -------
    int
        Exit code.

    Raises
    ------
    StudyError
        All have failed.
    """
    failed = table[table["error"] != ""]
    if failed.empty:
        return 0
    first = failed.iloc[0]
    what = (
        f"{len(failed)} of {len(table)} cases failed, first case {first.case_index}: {first.error}"
    )
    if len(failed) == len(table):
        raise StudyError(what)
    warn(f"warning: {what}")
    return SOME_FAILED


def _show_plan(design: "Design", place: Place) -> None:
    from wearsim.study.runner.shard import shards
    from wearsim.study.runner.store import Store

    waiting, shard_count = 0, 0
    store = None if place.out is None else Store(place.out)
    for shard in shards(design):
        shard_count += 1
        if store is None or not store.path(shard).exists():
            waiting += shard.count
    seconds, count = timed(design)
    click.echo(f"cases        {len(design.rows)}, of which {waiting} are to be run")
    click.echo(f"time         about {seconds * waiting:.3g} s in one thread, from {count} cases")
    if place.out is not None:
        click.echo(f"files        {shard_count} in {place.out / 'shards'}, and tables beside it")


def timed(design: "Design") -> tuple[float, int]:
    """Return the time that a case takes.

    Parameters
    ----------
    design : Design
        Cases.

    Returns
    -------
    tuple of float and int
        Seconds in one thread, and from how many cases.
    """
    from wearsim.study.runner.shard import Shard, run_shard, shards

    first = next(shards(design))
    some = Shard(0, first.design.part(0, min(_TIMED, first.count)), first.engine)
    run_shard(Shard(0, first.design.part(0, 1), first.engine))
    start = time.perf_counter()
    run_shard(some)
    return (time.perf_counter() - start) / some.count, some.count


_TIMED = 4
"""Cases that a dry run times."""


@contextmanager
def _counting(text: str) -> "Iterator[Told]":
    """Show on a terminal how many cases are done, at what rate, and the time left."""
    import sys

    quiet = click.get_current_context().find_root().meta.get("wearsim.quiet")
    if quiet or not sys.stderr.isatty():
        yield lambda done, count: None
        return
    from wearsim.cli.counting import counting

    with counting(text) as told:
        yield told
