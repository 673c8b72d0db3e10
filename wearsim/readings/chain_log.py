"""The log of a chain: a table of dated readings, relubrications and what was new when."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from wearsim.errors import CaseError, Fault
from wearsim.readings.chain_lengths import NewLength, new_length
from wearsim.readings.chain_readings import (
    GAUGE,
    LENGTH,
    READINGS,
    ChainReading,
    Rules,
    chain_cells,
    elongation_over,
    odd_error,
    side_of_mark,
)
from wearsim.readings.dated_rows import (
    CHAINS,
    NEW,
    SPROCKETS,
    DatedRows,
    ServiceTime,
    read_dated_rows,
    service_time,
)
from wearsim.readings.kept_tables import DATE, number
from wearsim.readings.relubrications import EVENTS, RelubricationLog, event_faults, late_new_faults
from wearsim.readings.rotation import (
    MOUNTED,
    Rotation,
    has_rotation,
    hours_of_chains,
    of_chain,
    relubrications_of_chains,
    rotation_faults,
)

_OF_TEETH = ("max_depth_mm", "depth_mm", "over_pins_mm", "profile")


_BELOW_NEW = 3.0
"""Errors by which a reading may lie below 0."""


@dataclass(frozen=True)
class ChainLog:
    """What was read and done since a chain was new."""

    file: str
    time: ServiceTime
    new: NewLength
    readings: tuple[ChainReading, ...]
    lubricated: Mapping[str, RelubricationLog]  # of each chain by its name; of a chain alone by ""
    # when sprockets that rows name were new, by the running time since the (first) chain was new [h]
    sprockets: Mapping[str, float]
    rotation: Rotation | None = None  # of several chains by turns

    @property
    def mounted(self) -> str:
        """Name of the chain that is on the drive at the last row; empty of a chain alone."""
        return "" if self.rotation is None else self.rotation.mounted

    @property
    def relubrications(self) -> RelubricationLog:
        """Those of the chain that is on the drive, by its running time."""
        return self.lubricated[self.mounted]

    @property
    def times_relubricated(self) -> int:
        """How many times all chains were relubricated."""
        return sum(len(log.hours) for log in self.lubricated.values())

    @property
    def schedule(self) -> dict[str, Any]:
        """Keys of [lubrication] that say the same of the drive; of several chains the interval of all."""
        of_chain = self.relubrications
        return of_chain.schedule if self.rotation is None else {"interval_hours": of_chain.mean_interval}

    @property
    def today(self) -> float:
        """Running time of the chain, of several the one that is on the drive, at the last row [h]."""
        return self.relubrications.today

    @property
    def machine(self) -> float:
        """Running time of the drive since the (first) chain was new [h]."""
        return self.today if self.rotation is None else self.rotation.machine

    @property
    def odd_links(self) -> bool:
        """Whether some readings are over an odd number of links."""
        return any(one.links % 2 for one in self.readings)


def read_chain_log(path: Path, inputs: Mapping[str, Any], pitch: float, usual_error: float) -> ChainLog:
    """Read a table of readings and relubrications of one chain.

    Parameters
    ----------
    path : Path
        CSV file.
    inputs : mapping
        Of the case, whose [service] turns km and days into hours.
    pitch : float
        Of the new chain [mm].
    usual_error : float
        Standard deviation of a reading that states none [%].

    Raises
    ------
    CaseError
        What is wrong with the table, every cell of it in one pass.
    """
    whole = read_dated_rows(path, ("quantity",), ("value", "error", "links", "result", SPROCKETS, CHAINS))
    of_sprockets = [row for row in whole.rows if row[1].get(SPROCKETS)]
    table = replace(whole, rows=tuple(row for row in whole.rows if not row[1].get(SPROCKETS)))
    time = service_time(table, inputs)
    in_turn = has_rotation(table)
    faults = [*_bad_cells(table, time, in_turn), *_backwards(table, time)]
    faults += [*event_faults(table, time, _events(in_turn))]
    faults += [*(rotation_faults(table) if in_turn else late_new_faults(table))]
    faults += _bad_sprockets(of_sprockets, table, time)
    if faults:
        raise CaseError(sorted(faults, key=lambda fault: fault.line))
    rotation, own = hours_of_chains(table, time) if in_turn else (None, _alone(table, time))
    chains = {cells.get(CHAINS, "") for _, cells in table.rows}
    new = {name: new_length(of_chain(table, name), pitch) for name in chains}
    readings = tuple(
        _reading(line, hours, cells, new[cells.get(CHAINS, "")], usual_error)
        for (_, hours), (line, cells) in zip(own, table.rows, strict=True)
        if cells["quantity"] in READINGS
    )
    if not readings:
        text = f"must hold at least one reading of the chain: {', '.join(READINGS)}"
        raise CaseError([Fault(text, "quantity", table.file)])
    log = ChainLog(
        file=table.file,
        time=time,
        new=next((one for one in new.values() if one.measured), next(iter(new.values()))),
        readings=readings,
        lubricated=relubrications_of_chains(table, own, rotation.hours if rotation else {"": own[-1][1]}),
        sprockets={cells[SPROCKETS]: time.hours(cells[table.time]) for _, cells in of_sprockets},
        rotation=rotation,
    )
    _check_times(log)
    return log


def _events(in_turn: bool) -> tuple[str, ...]:
    return (*EVENTS, MOUNTED) if in_turn else EVENTS


def _alone(table: DatedRows, time: ServiceTime) -> list[tuple[str, float]]:
    """Return no name and the running hours of each row of the log of a chain alone."""
    return [("", time.hours(cells[table.time])) for _, cells in table.rows]


def _bad_cells(table: DatedRows, time: ServiceTime, in_turn: bool) -> Iterator[Fault]:
    """Give every cell that cannot be in a row that is a reading."""
    words = tuple(dict.fromkeys((NEW, *READINGS, *_events(in_turn))))
    rules: Rules = {
        "quantity": (lambda text: text in words, f"must be one of {', '.join(words)}"),
        "error": (
            lambda text: text == "" or 0.0 < number(text) <= 1e6,
            "must be a number above 0, the standard deviation of the value in its unit, or empty",
        ),
    }
    for line, cells in table.rows:
        quantity = cells["quantity"]
        if quantity in _events(in_turn):
            continue
        wrong = time.fault(cells[table.time])
        if wrong:
            yield Fault(wrong, table.time, table.file, line)
        more = chain_cells(quantity) if quantity in READINGS else {}
        for name, (holds, must) in {**rules, **more}.items():
            text = cells.get(name, "")
            if not holds(text):
                hint = ": wearsim calibrate takes readings of the teeth" if text in _OF_TEETH else ""
                yield Fault(f"{must} (got {text!r}){hint}", name, table.file, line)


def _bad_sprockets(
    rows: Sequence[tuple[int, Mapping[str, str]]], table: DatedRows, time: ServiceTime
) -> Iterator[Fault]:
    """Give what is wrong in rows that say when a sprocket was new."""
    for line, cells in rows:
        if cells["quantity"] != NEW:
            text = f"must be {NEW} where a sprocket is named, as readings are those of the chain"
            yield Fault(text, "quantity", table.file, line)
        if not math.isfinite(time.hours(cells[table.time])):
            yield Fault(f"must be {time.must} (got {cells[table.time]!r})", table.time, table.file, line)


def _backwards(table: DatedRows, time: ServiceTime) -> Iterator[Fault]:
    """Give every row that comes before the one above it."""
    last, above = 0.0, ""
    for line, cells in table.rows:
        text = cells[table.time]
        hours = time.hours(text)
        if hours < last:
            message = f"must not go backwards: {text} comes after {above}; sort the rows, one chain per file"
            yield Fault(message, table.time, table.file, line)
        last, above = (hours, text) if hours >= last else (last, above)


def _reading(
    line: int, hours: float, cells: Mapping[str, str], new: NewLength, usual_error: float
) -> ChainReading:
    quantity, value, chain = cells["quantity"], number(cells["value"]), cells.get(CHAINS, "")
    error = number(cells.get("error", ""))
    if quantity == GAUGE:
        error = usual_error if math.isnan(error) else error
        return replace(side_of_mark(line, hours, value, cells["result"], error), chain=chain)
    links = int(number(cells["links"])) if cells.get("links") else 0
    if quantity == LENGTH:
        value = elongation_over(value, links, new.pitch)
        error *= 100.0 / (links * new.pitch)
    error = usual_error if math.isnan(error) else error
    if quantity == LENGTH:
        error = new.error_with(error)
    error = math.hypot(error, odd_error(value, links))
    return ChainReading(line, hours, quantity, value, value, error, links, chain)


def _check_times(log: ChainLog) -> None:
    """Raise for readings of a new chain, and for those of a chain shorter than new."""
    faults = []
    for one in log.readings:
        if not one.hours > 0.0:
            text = f"must be later than 0, when the chain was new: give that time in a first row {NEW!r}" + (
                " or as service.start_date" if log.time.column == DATE else ""
            )
            faults.append(Fault(text, log.time.column, log.file, one.line))
        if one.measured and one.low < -_BELOW_NEW * one.error:
            text = (
                f"must not be more than {_BELOW_NEW:g} errors shorter than new, is {one.low:.3g} % with an "
                f"error of {one.error:.2g} %: check value, links and chain.pitch_mm"
            )
            faults.append(Fault(text, "value", log.file, one.line))
    if faults:
        raise CaseError(faults)
