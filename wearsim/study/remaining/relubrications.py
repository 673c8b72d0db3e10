"""Relubrications as they were logged, and as they go on from there."""

from collections.abc import Sequence
from dataclasses import replace

from wearsim.case.model import Case
from wearsim.errors import CaseError, Fault
from wearsim.study.remaining.chain_readings import RELUBRICATION, ChainLog

_MOST = 100_000
"""Relubrications to come that are counted."""


def check_relubrications(case: Case, log: ChainLog) -> None:
    """Raise where the case does not know what a relubrication does."""
    if not log.relubricated:
        return
    if case.lubrication is None:
        text = (
            f"{RELUBRICATION} needs [lubrication] in the case, with a lubricant and how long it lasts: give "
            "them, or remove these rows"
        )
        raise CaseError([Fault(text, "quantity", log.file)])
    if case.lubrication.phases:
        text = (
            f"{RELUBRICATION} takes the place of a schedule, but the case has a programme of its own: "
            "remove [[lubrication.phase]], or these rows"
        )
        raise CaseError([Fault(text, "quantity", log.file)])
    if not log.relubricated[0] > 0.0:
        text = f"{RELUBRICATION} must be later than 0, as a new chain is lubricated: remove the row"
        raise CaseError([Fault(text, log.time.column, log.file)])


def mean_interval(log: ChainLog) -> float:
    """Return the mean time between relubrications, the first counted from the new chain [h]."""
    return log.relubricated[-1] / len(set(log.relubricated))


def as_logged(case: Case, log: ChainLog) -> Case:
    """Return the case relubricated when the log says, and never again; as it is without a log."""
    return _relubricated(case, log, log.relubricated)


def as_before(case: Case, log: ChainLog, hours: float) -> Case:
    """Return the case relubricated as logged and then, up to some hours, at the mean interval.

    Where the next one is overdue on the day of the last row it happens then.
    """
    if not log.relubricated:
        return case
    interval, end = mean_interval(log), min(hours, 0.999 * case.run.horizon_hours)
    first = max(log.relubricated[-1] + interval, log.today)
    count = min(max(int((end - first) / interval) + 1, 0), _MOST)
    to_come = (first + number * interval for number in range(count))
    return _relubricated(case, log, [*log.relubricated, *to_come])


def _relubricated(case: Case, log: ChainLog, hours: Sequence[float]) -> Case:
    """Return the case with other times of relubrication; those of one day are one."""
    if not hours:
        return case
    try:
        return case.with_({"lubrication.at_hours": sorted(set(hours))})
    except CaseError as error:
        where = f"{log.file}: {RELUBRICATION}, which sets lubrication.at_hours"
        raise CaseError([replace(fault, file=where) for fault in error.faults]) from None
