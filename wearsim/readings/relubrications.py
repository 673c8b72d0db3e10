"""Relubrications as they were logged, and as they go on from there."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from wearsim.case.model import Case
from wearsim.catalogue.catalogues import lubricants
from wearsim.drive.drive_case import DriveCase
from wearsim.drive.part_life import case_clock
from wearsim.errors import CaseError, Fault
from wearsim.lubrication.model import ENDLESS, LubricationInput, RunningWay, lasting_not_known
from wearsim.quantities import grouped
from wearsim.readings.dated_rows import CHAINS, NEW, DatedRows, ServiceTime

RELUBRICATION = "relubrication"
EVENTS = (NEW, RELUBRICATION)
"""Rows that are no readings."""

_BASELINE = ("value", "links", "error")
"""Columns of a row `NEW` that tell the length of the new chain."""

_AT = "lubrication.at_hours"

_LEAST = 1e-3
"""Mean interval over what the lubricant lasts below which nobody relubricates."""


@dataclass(frozen=True)
class RelubricationLog:
    """When a part was relubricated since it was new."""

    file: str
    column: str  # of the times
    line: int  # of the first relubrication; 0 without one
    hours: tuple[float, ...]  # running times, rising, those of one day once [h]
    today: float  # running time of the last row of the file [h]
    # mean time between relubrications, the first counted from the new part, of chains in rotation that of all
    # of them [h]; 0 where nobody relubricated
    logged_interval: float = 0.0
    mean_interval: float = 0.0  # the same where those that are overdue come today, and count too [h]

    @property
    def last(self) -> float:
        """Running time of the last one; 0 without one, as a new part is lubricated [h]."""
        return self.hours[-1] if self.hours else 0.0

    @property
    def is_overdue(self) -> bool:
        """Whether more time has passed since the last one than between them in the mean."""
        return self.today - self.last > self.logged_interval

    @property
    def to_come(self) -> float:
        """Running time of the next one, at the mean interval; today where that is overdue [h]."""
        return self.today if self.is_overdue else self.last + self.mean_interval

    @property
    def schedule(self) -> dict[str, Any]:
        """Keys of [lubrication] that say the same."""
        return {"at_hours": [*self.hours, self.to_come], "interval_hours": self.mean_interval}

    def warnings(self, given: LubricationInput | None) -> Iterator[str]:
        """Say that the log changes no wear of a case, and that a relubrication is overdue."""
        if self.logged_interval and given is not None and given.lasts is ENDLESS and not given.first:
            yield lasting_not_known(given.name, "this log")
        if self.logged_interval and self.is_overdue:
            since, before, then = (
                grouped(hours) for hours in (self.today - self.last, self.logged_interval, self.mean_interval)
            )
            yield (
                f"no relubrication was logged in the last {since} h, but they came every {before} h before: "
                f"the next is assumed now, then one every {then} h; without relubrication less life is left. "
                "Log any that are missing"
            )


def event_faults(table: DatedRows, time: ServiceTime, events: Sequence[str] = EVENTS) -> Iterator[Fault]:
    """Give every cell that cannot be in rows that are no readings."""
    for line, cells in table.rows:
        event = cells["quantity"]
        if event not in events:
            continue
        known = (table.time, "quantity", CHAINS, *(_BASELINE if event == NEW else ()))
        for name, text in cells.items():
            if name not in known and text:
                yield Fault(f"must be empty for {event} (got {text!r})", name, table.file, line)
        wrong = time.fault(cells[table.time])
        if wrong:
            yield Fault(wrong, table.time, table.file, line)


def late_new_faults(table: DatedRows) -> Iterator[Fault]:
    """Give the rows ``new`` below others, where a table is of one part."""
    for line, cells in table.rows[1:]:
        if cells["quantity"] == NEW:
            text = f"{NEW} must be the first row: begin a file for each part"
            yield Fault(text, "quantity", table.file, line)


def relubrication_log(table: DatedRows, hours: Sequence[float]) -> RelubricationLog:
    """Return the relubrications of a table whose cells are checked, from the running time of each row."""
    rows = [
        (at, line) for at, (line, cells) in zip(hours, table.rows, strict=True) if is_relubrication(cells)
    ]
    times = tuple(sorted({at for at, _ in rows}))
    return RelubricationLog(
        file=table.file,
        column=table.time,
        line=min(rows)[1] if rows else 0,
        hours=times,
        today=max(hours, default=0.0),
    )


def at_one_interval(logs: Mapping[str, RelubricationLog]) -> dict[str, RelubricationLog]:
    """Return the relubrications of parts that go on alike, at the mean interval of all.

    Examples
    --------
    Every 100 h until 200 h, where 50 more have run, and never in 130 h, which is overdue: 330 h for three.

    >>> late = RelubricationLog("log.csv", "time_hours", 0, (), 130.0)
    >>> logs = {"A": RelubricationLog("log.csv", "time_hours", 2, (100.0, 200.0), 250.0), "B": late}
    >>> one, other = at_one_interval(logs).values()
    >>> one.logged_interval, one.mean_interval, one.to_come, other.to_come
    (100.0, 110.0, 310.0, 130.0)
    """
    count = sum(len(log.hours) for log in logs.values())
    if not count:
        return dict(logs)
    logged = sum(log.last for log in logs.values()) / count
    found = [replace(log, logged_interval=logged) for log in logs.values()]
    counted = sum(log.today if log.is_overdue else log.last for log in found)
    mean = counted / (count + sum(log.is_overdue for log in found))
    return {name: replace(log, mean_interval=mean) for name, log in zip(logs, found, strict=True)}


def is_relubrication(cells: Mapping[str, str]) -> bool:
    """Whether a row says that a part was relubricated."""
    return cells["quantity"] == RELUBRICATION


def relubricated(case: Case | DriveCase, log: RelubricationLog) -> Case:
    """Return a case, or that of the chain of a drive, relubricated as logged and then at the mean interval.

    Without a log it is as it was.

    Raises
    ------
    CaseError
        The case does not know what a relubrication does, or they are too many to be meant.
    """
    first = case.chain_case
    if not log.hours and not log.logged_interval:
        return first
    given = _as_logged(case, first, log)
    going_on = replace(given, at_hours=(*log.hours, log.to_come), interval=RunningWay(log.mean_interval))
    found = replace(first, lubrication=going_on)
    _check_interval(found, log)
    return found


def _as_logged(case: Case | DriveCase, first: Case, log: RelubricationLog) -> LubricationInput:
    """Return how the case is lubricated with the logged times in the place of its schedule."""
    given = first.lubrication
    if given is None:
        text = (
            f"{RELUBRICATION} needs [lubrication] in the case: add lubricant = 'manual' or 'greased' to it "
            "(--set lubrication.lubricant=manual), or remove these rows"
        )
        raise _fault(log, "quantity", text)
    row = lubricants().get(given.name)
    if row is not None and row.supply != "applied":
        text = (
            f"{RELUBRICATION} needs a lubricant that is applied by hand, not lubrication.lubricant = "
            f"{given.name!r}: make it 'manual' or 'greased' (--set lubrication.lubricant=manual), or remove "
            "these rows"
        )
        raise _fault(log, "quantity", text)
    if given.phases:
        text = (
            f"{RELUBRICATION} replaces a schedule, but the case has a programme of its own: "
            "remove [[lubrication.phase]], or these rows"
        )
        raise _fault(log, "quantity", text)
    if 0.0 in log.hours:
        text = f"{RELUBRICATION} must be later than 0, as a new part is lubricated: remove the row"
        raise _fault(log, log.column, text)
    try:
        changed = case.with_({_AT: list(log.hours) or [log.to_come]})
    except CaseError as error:
        faults = []
        for fault in error.faults:
            what = "" if fault.key == _AT else f"{fault.key}: "
            text = f"{RELUBRICATION} sets {_AT}: {what}{fault.message}: give it, or take these rows out"
            faults.append(Fault(text, "quantity", log.file, log.line))
        raise CaseError(faults) from None
    found = changed.chain_case.lubrication
    assert found is not None
    return found


def _check_interval(case: Case, log: RelubricationLog) -> None:
    """Raise where the mean interval is one at which nobody relubricates."""
    law, given = case_clock(case).lubricant.law, case.lubrication
    assert given is not None
    effect = (law.lasts + law.fades) / (case.cycles_per_hour * given.dirt.ageing)
    if log.logged_interval < _LEAST * effect < math.inf:
        text = (
            f"{RELUBRICATION} must come every {_LEAST * effect:.3g} h or later on average, a thousandth of "
            f"the {grouped(effect)} h after which the lubricant is gone, but comes every "
            f"{log.logged_interval:.3g} h: remove this row if the part was new, as that is lubricated, or "
            "correct its time"
        )
        raise _fault(log, log.column, text)


def _fault(log: RelubricationLog, column: str, text: str) -> CaseError:
    return CaseError([Fault(text, column, log.file, log.line)])


def relubrication_rows(log: RelubricationLog, times: int) -> list[tuple[str, str]]:
    """Return how many times a part, or chains in rotation, were relubricated; nothing where they were not."""
    if not times:
        return []
    count = "once" if times == 1 else f"{times} times"
    every = grouped(log.mean_interval)
    return [("Lubricated", f"{count}, every {every} h on average, and so on from here")]
