"""Chains in rotation: several chains on one drive by turns, each with running hours of its own."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from wearsim.errors import Fault
from wearsim.readings.dated_rows import CHAINS, NEW, DatedRows, ServiceTime
from wearsim.readings.relubrications import (
    RelubricationLog,
    at_one_interval,
    is_relubrication,
    relubrication_log,
)

MOUNTED = "mounted"
"""Row from which its chain runs again."""


@dataclass(frozen=True)
class Rotation:
    """How long each chain of a drive has run by the last row of the log."""

    hours: Mapping[str, float]  # by the name of the chain [h]
    mounted: str  # the chain that runs now
    machine: float  # running time of the drive since the first chain was new [h]


def has_rotation(table: DatedRows) -> bool:
    """Whether rows name their chain."""
    return any(cells.get(CHAINS) for _, cells in table.rows)


def rotation_faults(table: DatedRows) -> Iterator[Fault]:
    """Give what is wrong in the order in which chains come onto the drive."""
    known: set[str] = set()
    for line, cells in table.rows:
        name, quantity = cells.get(CHAINS, ""), cells["quantity"]
        if not name:
            if is_relubrication(cells) and known:
                continue
            yield Fault("must name the chain of every row, where one row does", CHAINS, table.file, line)
            continue
        if quantity == NEW and name in known:
            yield Fault(f"{name!r} was new before: give a new chain a new name", CHAINS, table.file, line)
        if quantity != NEW and name not in known:
            yield Fault(f"{name!r} must have a row {NEW!r} first", CHAINS, table.file, line)
        known.add(name)


def hours_of_chains(table: DatedRows, time: ServiceTime) -> tuple[Rotation, list[tuple[str, float]]]:
    """Return the rotation, and for each row its chain and the running hours of that.

    A row without a name is of the chain that is on the drive.

    Examples
    --------
    A runs 100 h, B 50 h, and A another 30:

    >>> rows = ["0 new A", "100 new B", "150 mounted A", "180 gauge_percent A"]
    >>> cells = [dict(zip(("time_hours", "quantity", "chain"), row.split())) for row in rows]
    >>> table = DatedRows("log.csv", "time_hours", 1, tuple(enumerate(cells, start=2)))
    >>> rotation, own = hours_of_chains(table, ServiceTime("time_hours", 1.0, None))
    >>> rotation.hours, rotation.mounted, own
    ({'A': 130.0, 'B': 50.0}, 'A', [('A', 0.0), ('B', 0.0), ('A', 100.0), ('A', 130.0)])
    """
    run: dict[str, float] = {}
    mounted, last, own = "", 0.0, []
    for _, cells in table.rows:
        now, name = time.hours(cells[table.time]), cells[CHAINS] or mounted
        if mounted:
            run[mounted] += now - last
        last = now
        if cells["quantity"] in (NEW, MOUNTED):
            mounted = name
        own.append((name, run.setdefault(name, 0.0)))
    return Rotation(run, mounted, last), own


def of_chain(table: DatedRows, name: str) -> DatedRows:
    """Return the rows of one chain."""
    return replace(table, rows=tuple(row for row in table.rows if row[1].get(CHAINS, "") == name))


def relubrications_of_chains(
    table: DatedRows, own: Sequence[tuple[str, float]], run: Mapping[str, float]
) -> dict[str, RelubricationLog]:
    """Return the relubrications of each chain by its own running hours, all going on at one mean interval."""
    logs = {}
    for name, today in run.items():
        rows = [(row, hours) for row, (chain, hours) in zip(table.rows, own, strict=True) if chain == name]
        its = replace(table, rows=tuple(row for row, _ in rows))
        logs[name] = replace(relubrication_log(its, [hours for _, hours in rows]), today=today)
    return at_one_interval(logs)
