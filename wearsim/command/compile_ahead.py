"""Kernels that the cache does not hold, compiled side by side before a run, and what is said of it."""

import contextlib
import math
import os
import sys
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, Executor, as_completed

import click

from wearsim.command.options import warn, working
from wearsim.jit.compiled import Kernel
from wearsim.runner.workers import Processes

_MOST_PROCESSES = 4
_START, _EACH, _PER_BYTE = 1.0, 0.02, 1.8e-4
"""Seconds that a process takes to load numba, that any kernel takes, and more for a byte of its code."""

_UNTOLD = 2.0
"""Seconds up to which nobody is told, and the kernels are left to compile when they are called."""


def compile_ahead(context: click.Context, kernels: list[Kernel]) -> None:
    """Compile what the command of a context is going to call, and say so on stderr, if it takes long."""
    if seconds_to_compile(kernels) > _UNTOLD:
        compile_with_bar(context, kernels)


def compile_with_bar(context: click.Context, kernels: list[Kernel]) -> None:
    """Compile kernels for the command of a context, and say so on stderr."""
    seconds = seconds_to_compile(kernels)
    text = f"compiling once, about {math.ceil(seconds)} s"
    with context.scope(cleanup=False):
        if not sys.stderr.isatty():
            warn(text)
        with working(text) as report_progress:
            compile_side_by_side(kernels, report_progress)


def seconds_to_compile(kernels: list[Kernel]) -> float:
    """Return about how long some kernels take to compile side by side, on the machine of the reports [s]."""
    groups = _groups(kernels)
    seconds = list(map(_seconds, groups))
    return _START + max(sum(seconds) / (1 + _other_processes(groups)), *seconds)


def compile_side_by_side(kernels: list[Kernel], report_progress: Callable[[float], None]) -> None:
    """Compile kernels in this process and in others, so that the cache holds them.

    Parameters
    ----------
    kernels : list of Kernel
        What to compile.
    report_progress : callable
        Takes the part that is done, from 0 to 1.
    """
    groups = _groups(kernels)
    done, total = 0.0, sum(map(_seconds, groups))

    def finish(group: _Group) -> None:
        nonlocal done
        done += _seconds(group)
        report_progress(done / total)

    others = _other_processes(groups)
    if not others:
        for group in groups:
            _compile(group)
            finish(group)
        return
    # Where a process dies what is missing is compiled when it is called.
    with contextlib.suppress(BrokenExecutor), Processes(others).open() as (executor, _):
        _compile_with(executor, groups, finish)


_Group = list[Kernel]
"""Kernels that are compiled in one process, because what most of them calls is then lowered once."""


def _groups(kernels: list[Kernel]) -> list[_Group]:
    """Return groups of kernels, the longest first."""
    found: list[_Group] = []
    for one in sorted(kernels, key=lambda one: (-_seconds([one]), one.name)):
        for group in found:
            if 2.0 * _seconds_of(one.tree - _tree(group)) < _seconds([one]):
                group.append(one)
                break
        else:
            found.append([one])
    return sorted(found, key=_seconds, reverse=True)


def _compile_with(executor: Executor, groups: list[_Group], finish: Callable[[_Group], None]) -> None:
    """Compile the first group here, the others in an executor, and of these here what it has not come to."""
    first, *others = groups
    started = {executor.submit(_compile, group): group for group in others}
    try:
        _compile(first)
        finish(first)
        for future in reversed([*started]):
            if future.cancel():
                group = started.pop(future)
                _compile(group)
                finish(group)
        for future in as_completed(started):
            future.result()
            finish(started[future])
    finally:
        for future in started:
            future.cancel()


def _compile(group: _Group) -> None:
    for one in group:
        assert one.compiled is not None


def _tree(group: _Group) -> set[Kernel]:
    return set[Kernel]().union(*(one.tree for one in group))


def _seconds(group: _Group) -> float:
    return _seconds_of(_tree(group))


def _seconds_of(kernels: set[Kernel]) -> float:
    return sum(_EACH + _PER_BYTE * len(one.function.__code__.co_code) for one in kernels)


def _other_processes(groups: list[_Group]) -> int:
    """Return how many processes are worth their start."""
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    worth = math.floor(sum(map(_seconds, groups[1:])) / _START)
    return min(cores, _MOST_PROCESSES, len(groups), 1 + worth) - 1
