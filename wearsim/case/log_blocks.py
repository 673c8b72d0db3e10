"""The blocks of a log, and what is said of its stops and of the loads on the other flank."""

import math
from dataclasses import dataclass

from wearsim.case.chain_record import ChainRecord
from wearsim.catalogue.catalogues import Chain
from wearsim.input.duty_log import LogBin, LogFile, log_bins, merged, read_log

BINS = [20, 8]
"""Bins of load and speed that a log is sorted into."""

_KEY = "load.duty_file"
_DAY, _ROUNDING = 24.0, 1e-9


@dataclass(frozen=True)
class LogBlocks:
    """A log in blocks."""

    kind: str  # of their load, `tension_N` or `torque_N_m`
    blocks: list[LogBin]  # that load the flank of positive loads
    reverse: list[LogBin]  # that load the other one


def log_blocks(case: ChainRecord, most_blocks: int, chain: Chain) -> LogBlocks | None:
    """Return the blocks of the log of a case, of each flank so many at most; 0 for no limit."""
    table = case.tables.load
    assert table.duty_file is not None
    path = case.path(table.duty_file)
    found = read_log(path, _KEY, case.faults)
    bins = table.duty_bins
    if bins is None:
        bins = BINS
        case.take("load.duty_bins", bins, "bins of load and speed of the log")
    if found is None or not _within_strength(case, found, path.name, chain):
        return None
    sorted_in = [log_bins(found.log.of_flank(other), *bins) for other in (False, True)]
    blocks, reverse = (merged(part, most_blocks) if most_blocks else part for part in sorted_in)
    case.assumptions.append(_summary(path.name, found, [*sorted_in[0], *sorted_in[1]], [*blocks, *reverse]))
    _say_gaps(case, path.name, found)
    _say_stops(case, path.name, found)
    if reverse:
        _say_reverse(case, path.name, blocks, reverse)
    return LogBlocks(found.kind, blocks, reverse)


def _within_strength(case: ChainRecord, found: LogFile, name: str, chain: Chain) -> bool:
    """Compare the largest pull of the log with the chain's tensile strength."""
    sprocket, ratio = case.tables.sprocket, case.tables.load.duty_speed_ratio or 1.0
    if not chain.tensile or sprocket is None:
        return True
    lever = chain.pitch * sprocket.teeth / (2.0 * math.pi * sprocket.engaged_every)
    newtons = 1.0 if found.kind == "tension_N" else 1e3 / (ratio * lever)
    heaviest = int(abs(found.log.load).argmax())
    pull = newtons * abs(float(found.log.load[heaviest]))
    if pull < chain.tensile:
        return True
    case.faults.add(
        _KEY,
        f"{name}:{found.lines[heaviest]}: {found.column} must keep the pull below the chain's tensile "
        f"strength {chain.tensile:g} N (got {pull:.6g} N)",
    )
    return False


def _summary(name: str, found: LogFile, sorted_in: list[LogBin], blocks: list[LogBin]) -> str:
    held = f"each row counts {'for one step at most' if found.gaps else 'until the next'}"
    text = f"{name}: {found.duration:.6g} s, {held}, {len(sorted_in)} blocks"
    if len(blocks) < len(sorted_in):
        square = [sum(b.revolutions * b.load**2 for b in part) for part in (blocks, sorted_in)]
        text += (
            f", the smallest merged with their neighbours to leave {len(blocks)}, which keeps time, cycles "
            f"and mean load and lowers the mean square load by {100 * (1 - square[0] / square[1]):.2g} %"
        )
    if found.renamed:
        text += f"; columns {', '.join(found.renamed)} are read as {' and '.join(found.renamed.values())}"
    return text


def _say_gaps(case: ChainRecord, name: str, found: LogFile) -> None:
    """Say what is taken for standstill as rows are missing: beyond doubt only in an evenly sampled log."""
    if not found.gaps:
        return
    text = (
        f"{name}: {found.gaps} steps are much longer than the usual {found.usual:.4g} s: the row before "
        f"each counts for that time, the remaining {found.missing:.6g} s count as standstill"
    )
    if found.even:
        case.assumptions.append(text)
    else:
        case.warnings.append(f"{text}; if the drive ran on there, add rows")


def _say_stops(case: ChainRecord, name: str, found: LogFile) -> None:
    """Say which part of the time the drive stands, and what calendar time it takes."""
    standing = 1.0 - found.running / found.duration
    if standing < _ROUNDING:
        return
    per_hour = found.duration / found.running
    case.assumptions.append(
        f"{name}: the drive stands still for {100 * standing:.3g} % of the time, which adds no cycles and "
        f"no running hours: 1000 running hours take {1000 * per_hour:.4g} h including stops"
    )
    day = case.tables.service.hours_per_day if case.tables.service else None
    if day is None:
        return
    text = (
        f"service.hours_per_day = {day:g} running hours take {day * per_hour:.4g} h including the stops of "
        f"{name}"
    )
    if day * per_hour > _DAY * (1.0 + _ROUNDING):
        case.warnings.append(f"{text}, more than a day has: give the running hours without stops")
    else:
        case.assumptions.append(text)


def _say_reverse(case: ChainRecord, name: str, blocks: list[LogBin], reverse: list[LogBin]) -> None:
    """Say which part of the cycles loads the other flank."""
    ahead, turned = (math.fsum(block.revolutions for block in part) for part in (blocks, reverse))
    case.assumptions.append(
        f"{name}: for {100 * turned / (ahead + turned):.3g} % of the cycles the load is negative: tight and "
        "slack strands swap, the joints wear under the absolute load, and the teeth wear on the other "
        "flank, which is not calculated"
    )
    work, more = (math.fsum(block.revolutions * block.load for block in part) for part in (blocks, reverse))
    if more > work:
        case.warnings.append(
            f"{name}: negative loads do {more / work:.3g} times the work of positive ones, so the other "
            "flank of the teeth wears faster than the one calculated: to calculate that one, reverse the "
            "signs of the log and, on a wrap, the role of the sprocket"
        )
