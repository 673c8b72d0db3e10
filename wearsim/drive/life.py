"""Lives of all parts of a drive on one clock."""

import math
import os
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_EXCEPTION, ThreadPoolExecutor, wait

from wearsim.drive.drive_case import DriveCase, DriveSprocket
from wearsim.drive.drive_result import DriveLife
from wearsim.drive.part_life import simulate
from wearsim.errors import ContactError, ConvergenceError, WearsimError
from wearsim.result import WearResult
from wearsim.result.kept_runs import case_content, of_case


class _GivenUpError(Exception):
    """Nobody waits for the runs of a drive any more."""


def drive_life(
    drive: DriveCase, progress: Callable[[float], None] = lambda part: None, threads: int | None = None
) -> DriveLife:
    """Wear all sprockets of a drive, each with the chains that run on it.

    The chain grows by its joints alone, at all sprockets: every sprocket meets the same chains at the
    same times, and each is worn on its own, those that wear alike once. Where the run of one fails the
    others go on.

    Parameters
    ----------
    drive : DriveCase
        Sprockets and chain.
    progress : callable, optional
        Called with the fraction of the runs done, from 0 to 1.
    threads : int, optional
        Sprockets that run side by side; as many as there are cores where it is left out.

    Returns
    -------
    DriveLife
        Results of all sprockets, and what the runs of some have failed with.

    Raises
    ------
    WearsimError
        As `wearsim.simulate` does for the case of a sprocket, where no run comes to its end.
    """
    groups = _alike(drive.sprockets)
    done = dict.fromkeys((first.name for first, *_ in groups), 0.0)
    lock, given_up = threading.Lock(), threading.Event()

    def _watch(name: str) -> Callable[[float], None]:
        def _report(part: float) -> None:
            if given_up.is_set():
                raise _GivenUpError
            with lock:
                done[name] = part
                progress(math.fsum(done.values()) / len(done))

        return _report

    def _run(one: DriveSprocket) -> WearResult | WearsimError:
        report = _watch(one.name)
        report(0.0)  # may end what nobody waits for before it begins
        try:
            return simulate(one.case, report)
        except (ContactError, ConvergenceError) as error:
            report(1.0)
            return error

    with ThreadPoolExecutor(max_workers=threads or os.cpu_count()) as pool:
        runs = [pool.submit(_run, first) for first, *_ in groups]
        try:
            ended, _ = wait(runs, return_when=FIRST_EXCEPTION)
        finally:
            given_up.set()  # the user has stopped them
        ends = [(group, run.result()) for group, run in zip(groups, runs, strict=True) if run in ended]
    of_wheel = {one.name: _end_of(one, end) for group, end in ends for one in group}
    in_order = {one.name: of_wheel[one.name] for one in drive.sprockets if one.name in of_wheel}
    results = {name: end for name, end in in_order.items() if isinstance(end, WearResult)}
    failed = {name: end for name, end in in_order.items() if isinstance(end, WearsimError)}
    found = DriveLife(drive, results, failed)
    return found if results else found.complete()


def _alike(sprockets: Sequence[DriveSprocket]) -> list[list[DriveSprocket]]:
    """Return the sprockets, those together that wear alike: one run tells the lives of all."""
    groups: dict[bytes, list[DriveSprocket]] = {}
    for one in sprockets:
        try:
            content = case_content(one.case)
        except TypeError:  # of what a user has made there is no hash
            content = one.name.encode()
        groups.setdefault(content, []).append(one)
    return list(groups.values())


def _end_of(one: DriveSprocket, end: WearResult | WearsimError) -> WearResult | WearsimError:
    return of_case(end, one.case) if isinstance(end, WearResult) else end
