"""Where shards run: threads of this process, other processes, or a Dask cluster."""

import json
import os
import re
import signal
import socket
import threading
from collections.abc import Iterator
from concurrent.futures import BrokenExecutor, Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from multiprocessing import get_context, parent_process
from multiprocessing.connection import wait
from pathlib import Path
from typing import Any, Protocol

from wearsim.errors import StudyError
from wearsim.extras import library
from wearsim.files import given_text

_PATIENCE = 30.0
"""Seconds in which the first worker of a cluster must show up."""


class Workers(Protocol):
    """A kind of executor that can be opened anew when its workers have died."""

    def open(self) -> Any:
        """Return a context with an executor and the number of its workers."""

    @property
    def losses(self) -> tuple[type[BaseException], ...]:
        """What a future raises whose worker has died."""


@dataclass(frozen=True)
class Threads:
    """Threads of this process; compiled loops run side by side."""

    count: int  # how many
    losses: tuple[type[BaseException], ...] = ()

    @contextmanager
    def open(self) -> Iterator[tuple[Executor, int]]:
        """Give an executor and the number of its workers."""
        with ThreadPoolExecutor(self.count) as pool:
            yield pool, self.count


@dataclass(frozen=True)
class Processes:
    """Processes of this machine."""

    count: int  # how many
    losses: tuple[type[BaseException], ...] = (BrokenExecutor,)

    @contextmanager
    def open(self) -> Iterator[tuple[Executor, int]]:
        """Give an executor and the number of its workers."""
        context = get_context("spawn")
        with ProcessPoolExecutor(self.count, context, initializer=_obey_parent) as pool:
            with _interrupts_blocked():
                for _ in range(self.count):
                    pool.submit(int)
            yield pool, self.count


@contextmanager
def _interrupts_blocked() -> Iterator[None]:
    """Hold Ctrl-C back while processes start, which inherit that until they are deaf to it."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _obey_parent() -> None:
    """Leave it to the parent to end on Ctrl-C, after the shards that are under way, and never outlive it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """End this process when its parent has been killed, by whatever signal."""
    parent = parent_process()
    assert parent is not None
    wait([parent.sentinel])
    os._exit(1)


@dataclass(frozen=True)
class Cluster:
    """Workers of a Dask scheduler."""

    address: str | None  # such as `tcp://127.0.0.1:8786`
    scheduler_file: Path | None  # file that the scheduler wrote, in place of the address
    # `tls_ca_file`, `tls_client_cert` and `tls_client_key`, empty without TLS
    security: dict[str, str]

    @property
    def losses(self) -> tuple[type[BaseException], ...]:
        """What a future raises whose worker has died."""
        dask = library("distributed", "dask", "--scheduler")
        from concurrent.futures import CancelledError

        return (dask.KilledWorker, dask.CancelledError, CancelledError)

    @contextmanager
    def open(self) -> Iterator[tuple[Executor, int]]:
        """Give an executor and the number of its workers."""
        dask = library("distributed", "dask", "--scheduler")
        place = self.address or str(self.scheduler_file)
        address = self.address or _address(place)
        _reach(address, place)
        encrypted = {"require_encryption": True} if self.security else {}
        security = dask.Security(**encrypted, **self.security)
        _check_security(security, address, place)
        try:
            client = dask.Client(
                self.address,
                scheduler_file=None if self.scheduler_file is None else str(self.scheduler_file),
                security=security,
                timeout=_PATIENCE,
                set_as_default=False,
            )
        except (OSError, ValueError) as error:
            raise StudyError(f"{place}: must be a Dask scheduler that answers: {error}") from None
        with client:
            yield client.get_executor(pure=False), _checked(client, dask, place)


class SharedWorkers:
    """Workers that stay open from one batch of cases to the next, until one of them dies."""

    def __init__(self, workers: Workers) -> None:
        self._workers, self._stack = workers, ExitStack()
        self._opened: tuple[Executor, int] | None = None
        self._lost = False

    @property
    def losses(self) -> tuple[type[BaseException], ...]:
        """What a future raises whose worker has died."""
        return self._workers.losses

    @contextmanager
    def open(self) -> Iterator[tuple["SharedWorkers", int]]:
        """Give these workers and their number, anew where one has died."""
        if self._lost:
            self.close()
        if self._opened is None:
            self._opened = self._stack.enter_context(self._workers.open())
        yield self, self._opened[1]

    def submit(self, function: Any, *arguments: Any) -> "Future[Any]":
        """Return the future of a call."""
        assert self._opened is not None
        try:
            future = self._opened[0].submit(function, *arguments)
        except self.losses as error:
            future = Future()
            future.set_exception(error)
        future.add_done_callback(self._look)
        return future

    def close(self) -> None:
        """Let the workers go."""
        self._opened, self._lost = None, False
        self._stack.close()

    def _look(self, future: "Future[Any]") -> None:
        if not future.cancelled() and isinstance(future.exception(), self.losses):
            self._lost = True


def _address(place: str) -> str:
    """Address in the file of a scheduler."""
    try:
        found = json.loads(given_text(Path(place)))["address"]
    except (OSError, ValueError, KeyError, TypeError):
        found = None
    if not isinstance(found, str):
        raise StudyError(f"{place}: must be the file that a Dask scheduler wrote, but is not")
    return found


def _reach(address: str, place: str) -> None:
    """Find out whether anybody answers, before a client that would try for long."""
    match = re.fullmatch(r"(?:tcp|tls)://\[?([^\]/]+)\]?:(\d{1,5})", address)
    if match is None:
        raise StudyError(f"{place}: must be an address such as tcp://127.0.0.1:8786, not {address!r}")
    try:
        socket.create_connection((match[1], int(match[2])), timeout=_PATIENCE).close()
    except (OSError, OverflowError) as error:
        raise StudyError(f"{place}: must be a Dask scheduler that answers: {error}") from None


def _check_security(security: Any, address: str, place: str) -> None:
    """Find out whether TLS is given where the scheduler has it, of which a client makes no clean end."""
    try:
        found = security.get_connection_args("client")
    except (OSError, ValueError) as error:
        raise StudyError(
            f"{place}: must be reached with certificates and a key that belong together: {error}"
        ) from None
    has_tls = address.startswith("tls://")
    if has_tls and found.get("ssl_context") is None:
        raise StudyError(
            f"{place}: must be reached by TLS, as its address is {address}: give --tls-ca-file, "
            "--tls-cert and --tls-key"
        )
    if not has_tls and found.get("require_encryption"):
        raise StudyError(
            f"{place}: must be a scheduler with TLS (tls://HOST:PORT), but its address is {address}: "
            "start it with TLS, or leave the --tls options out"
        )


def _checked(client: Any, dask: Any, place: str) -> int:
    """Return the number of workers, all of which have this wearsim."""
    try:
        client.wait_for_workers(1, timeout=_PATIENCE)
    except (dask.TimeoutError, TimeoutError):
        raise StudyError(f"{place}: must have a worker, but has none: start some") from None
    from wearsim.runner.design import engine  # takes 0.3 s, which processes that only compile do without

    mine = engine()
    for worker, found in client.run(engine, on_error="return").items():
        if isinstance(found, BaseException):
            raise StudyError(f"{worker}: must have wearsim {mine.version}, but: {found}")
        if found != mine:
            raise StudyError(
                f"{worker}: must have this wearsim, {mine.version} (kernels {mine.kernels}), but has "
                f"{found.version} ({found.kernels}): install the same on all"
            )
    return sum(client.nthreads().values())
