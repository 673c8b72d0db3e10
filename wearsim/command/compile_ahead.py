"""Kernels that the cache does not hold, compiled side by side before a run, and what is said of it."""

import contextlib
import math
import os
import sys
from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from graphlib import TopologicalSorter

import click

from wearsim.command.options import warn, working
from wearsim.kernels.compiled import Calls, Kernel
from wearsim.runner.workers import Processes

_MOST_PROCESSES = 4
_START, _EACH, _PER_BYTE = 1.0, 0.1, 4.5e-4
"""Seconds that a process takes to load numba, that any kernel takes, and more for a byte of its code."""

_UNTOLD = 2.0
"""Seconds up to which nobody is told, and the kernels are left to compile when they are called."""


def compile_ahead(context: click.Context, calls: Calls) -> None:
    """Compile what the command of a context is going to call, and say so on stderr, if it takes long."""
    if seconds_to_compile(calls) > _UNTOLD:
        compile_with_bar(context, calls)


def compile_with_bar(context: click.Context, calls: Calls) -> None:
    """Compile kernels for the command of a context, and say so on stderr."""
    seconds = seconds_to_compile(calls)
    text = f"compiling once, about {math.ceil(seconds)} s"
    with context.scope(cleanup=False):
        if not sys.stderr.isatty():
            warn(text)
        with working(text) as report_progress:
            compile_side_by_side(calls, report_progress)


def seconds_to_compile(calls: Calls) -> float:
    """Return about how long some kernels take to compile side by side, on the machine of the reports [s]."""
    total = sum(_seconds(one) for one in calls)
    return _START + max(total / _processes(), *_waits(calls).values())


def compile_side_by_side(calls: Calls, report_progress: Callable[[float], None]) -> None:
    """Compile kernels in this process and in others, so that the cache holds them.

    Parameters
    ----------
    calls : dict
        The kernels, with those of them that each calls.
    report_progress : callable
        Takes the part that is done, from 0 to 1.
    """
    others = _processes() - 1
    if not others:
        _Schedule(calls, report_progress).compile_here()
        return
    # Where a process dies what is missing is compiled when it is called.
    with contextlib.suppress(BrokenExecutor), Processes(others).open() as (executor, _):
        _Schedule(calls, report_progress).compile_with(executor, others)


class _Schedule:
    """Kernels in an order in which each comes after those that it calls."""

    def __init__(self, calls: Calls, report_progress: Callable[[float], None]) -> None:
        self._waits, self._report_progress = _waits(calls), report_progress
        self._order, self._ready = TopologicalSorter(calls), list[Kernel]()
        self._done, self._total = 0.0, sum(map(_seconds, calls))
        self._order.prepare()

    def _next(self) -> Kernel | None:
        """Return the kernel that others wait for longest, of those that can be compiled now."""
        self._ready = sorted([*self._ready, *self._order.get_ready()], key=self._waits.__getitem__)
        return self._ready.pop() if self._ready else None

    def _finish(self, one: Kernel) -> None:
        self._order.done(one)
        self._done += _seconds(one)
        self._report_progress(self._done / self._total)

    def compile_here(self) -> None:
        """Compile one after the other."""
        while one := self._next():
            _compile(one)
            self._finish(one)

    def compile_with(self, executor: Executor, others: int) -> None:
        """Compile here what the processes of an executor do not; each of these has one that waits."""
        running: dict[Future[None], Kernel] = {}
        try:
            while self._order.is_active():
                one = self._next()
                if one and len(running) < 2 * others:
                    running[executor.submit(_compile, one)] = one
                    continue
                if one:
                    _compile(one)
                    self._finish(one)
                for future in wait(running, 0.0 if one else None, FIRST_COMPLETED).done:
                    future.result()
                    self._finish(running.pop(future))
        finally:
            for future in running:
                future.cancel()


def _compile(one: Kernel) -> None:
    assert one.compiled is not None


def _seconds(one: Kernel) -> float:
    return _EACH + _PER_BYTE * len(one.function.__code__.co_code)


def _waits(calls: Calls) -> dict[Kernel, float]:
    """Return how long the last kernel takes to be ready from the start of each of those that it calls."""
    found = dict.fromkeys(calls, 0.0)
    for one in reversed([*TopologicalSorter(calls).static_order()]):
        found[one] += _seconds(one)
        for other in calls[one]:
            found[other] = max(found[other], found[one])
    return found


def _processes() -> int:
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return min(cores, _MOST_PROCESSES)
