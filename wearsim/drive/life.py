"""Lives of all parts of a drive on one clock."""

import math
import os
import threading
from collections.abc import Callable
from concurrent.futures import FIRST_EXCEPTION, ThreadPoolExecutor, wait

from wearsim.drive.drive_case import DriveCase, DriveSprocket
from wearsim.drive.drive_result import DriveLife
from wearsim.drive.part_life import simulate
from wearsim.errors import ContactError, ConvergenceError, WearsimError
from wearsim.result import WearResult


class _GivenUpError(Exception):
    """Nobody waits for the runs of a drive any more."""


def drive_life(
    drive: DriveCase, progress: Callable[[float], None] = lambda part: None, threads: int | None = None
) -> DriveLife:
    """Wear all sprockets of a drive, each with the chains that run on it.

    The chain grows by its joints alone, at all sprockets: every sprocket meets the same chains at the
    same times, and each is worn on its own. Where the run of one fails the others go on.

    Parameters
    ----------
    drive : DriveCase
        Sprockets and chain.
    progress : callable, optional
        Told how much of the runs is done, from 0 to 1.
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
    done = dict.fromkeys((one.name for one in drive.sprockets), 0.0)
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
        runs = {one.name: pool.submit(_run, one) for one in drive.sprockets}
        try:
            ended, _ = wait(runs.values(), return_when=FIRST_EXCEPTION)
        finally:
            given_up.set()  # the user has stopped them
        ends = {name: run.result() for name, run in runs.items() if run in ended}
    results = {name: end for name, end in ends.items() if isinstance(end, WearResult)}
    failed = {name: end for name, end in ends.items() if isinstance(end, WearsimError)}
    found = DriveLife(drive, results, failed)
    return found if results else found.complete()
