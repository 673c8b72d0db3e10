"""Kernels that the cache does not hold, compiled side by side before a run, and what is said of it."""

import math
import os
import sys
from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Future, wait
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
    """Compile kernels in several processes, so that the cache holds them.

    Parameters
    ----------
    calls : dict
        The kernels, with those of them that each calls.
    report_progress : callable
        Takes the part that is done, from 0 to 1.
    """
    order, waits = TopologicalSorter(calls), _waits(calls)
    order.prepare()
    total, done = sum(_seconds(one) for one in calls), 0.0
    ready: list[Kernel] = []
    running: dict[Future[None], Kernel] = {}
    with Processes(_processes()).open() as (executor, count):
        try:
            while order.is_active():
                ready = sorted([*ready, *order.get_ready()], key=waits.__getitem__)
                while ready and len(running) < count:
                    one = ready.pop()
                    running[executor.submit(_compile, one)] = one
                for future in wait(running, return_when=FIRST_COMPLETED).done:
                    one = running.pop(future)
                    future.result()
                    order.done(one)
                    done += _seconds(one)
                    report_progress(done / total)
        except BrokenExecutor:
            # What is missing is compiled when it is called.
            return
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
