"""Where a study runs and what is kept of it: options that all commands of studies take."""

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

if TYPE_CHECKING:
    from wearsim.runner.workers import Workers

Function = TypeVar("Function", bound=Callable[..., Any])


@dataclass(frozen=True)
class StudyOptions:
    """Where a study runs and what is kept of it."""

    out: Path | None  # its folder
    force: bool  # replace the folder of another study
    dry_run: bool  # only tell what it would take
    jobs: int | None  # processes in place of threads
    threads: int | None  # threads; as many as there are cores where neither is given
    scheduler: str | None  # address of a Dask scheduler
    scheduler_file: Path | None  # file that it wrote
    tls: Mapping[str, str]  # files for encryption

    def workers(self) -> "Workers":
        """Return the workers that were asked for."""
        from wearsim.runner.workers import Cluster, Processes, Threads

        requested = [
            name
            for name, value in (
                ("--jobs", self.jobs),
                ("--threads", self.threads),
                ("--scheduler", self.scheduler),
                ("--scheduler-file", self.scheduler_file),
            )
            if value is not None
        ]
        if len(requested) > 1:
            raise click.UsageError(f"{' and '.join(requested)} do not go together: give one of them")
        if self.tls and not {"--scheduler", "--scheduler-file"} & set(requested):
            raise click.UsageError("the --tls options need --scheduler or --scheduler-file")
        if self.scheduler is not None or self.scheduler_file is not None:
            return Cluster(self.scheduler, self.scheduler_file, dict(self.tls))
        if self.jobs is not None:
            return Processes(self.jobs)
        return Threads(self.threads or os.cpu_count() or 1)


def study_options(function: Function) -> Function:
    """Add the options that say where a study runs, as the argument ``options``."""
    from functools import wraps

    @wraps(function)
    def command(
        *arguments: Any,
        out: Path | None,
        force: bool,
        dry_run: bool,
        jobs: int | None,
        threads: int | None,
        scheduler: str | None,
        scheduler_file: Path | None,
        tls_ca_file: Path | None,
        tls_cert: Path | None,
        tls_key: Path | None,
        **others: Any,
    ) -> Any:
        files = {"tls_ca_file": tls_ca_file, "tls_client_cert": tls_cert, "tls_client_key": tls_key}
        tls = {name: str(path) for name, path in files.items() if path is not None}
        options = StudyOptions(out, force, dry_run, jobs, threads, scheduler, scheduler_file, tls)
        return function(*arguments, options=options, **others)

    for option in reversed(_OPTIONS):
        command = option(command)
    return command  # type: ignore[return-value]


_FILE = click.Path(path_type=Path, exists=True, dir_okay=False)
_OPTIONS = (
    click.option(
        "--out",
        type=click.Path(path_type=Path),
        help="Folder of the study. If it exists, the study continues where it stopped.",
    ),
    click.option("--force", is_flag=True, help="Replace a different study in that folder."),
    click.option("--dry-run", is_flag=True, help="Only print the number of cases, the time and the files."),
    click.option("--threads", type=click.IntRange(min=1), help="Number of threads; default: one per core."),
    click.option("--jobs", type=click.IntRange(min=1), help="Number of processes, instead of threads."),
    click.option(
        "--scheduler",
        metavar="ADDRESS",
        help="Address of a Dask scheduler, such as tcp://127.0.0.1:8786 (pip install 'wearsim[dask]').",
    ),
    click.option("--scheduler-file", type=_FILE, help="Scheduler file written by Dask."),
    click.option("--tls-ca-file", type=_FILE, help="TLS certificate of the authority (CA)."),
    click.option("--tls-cert", type=_FILE, help="TLS certificate of this client."),
    click.option("--tls-key", type=_FILE, help="TLS key of this client."),
)
