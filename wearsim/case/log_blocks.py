"""The blocks of a log, and what is said of its stops and of the loads on the other flank."""

import math
from dataclasses import dataclass

from wearsim.catalogue.catalogues import Chain
from wearsim.input.case_record import ChainRecord
from wearsim.input.duty_log import LogBin, log_bins, merged
from wearsim.input.log_file import LogFile, read_log

BINS = [20, 8]
"""Bins of load and speed that a log is sorted into."""

_KEY = "load.duty_file"
_DAY = 24.0


@dataclass(frozen=True)
class LogBlocks:
    """A log in blocks."""

    kind: str  # of their load, `tension_N` or `torque_N_m`
    blocks: list[LogBin]  # that load the flank of positive loads
    reverse: list[LogBin]  # that load the other one


def log_blocks(case: ChainRecord, greatest: int, chain: Chain) -> LogBlocks | None:
    """Return the blocks of the log of a case, of each flank so many at most; 0 for no limit."""
    table = case.tables.load
    assert table.duty_file is not None
    path = case.path(_KEY, table.duty_file)
    found = read_log(path, _KEY, case.faults)
    bins = table.duty_bins
    if bins is None:
        bins = BINS
        case.take("load.duty_bins", bins, "bins of load and speed of the log")
    if found is None or not _within_strength(case, found, path.name, chain):
        return None
    sorted_in = [log_bins(found.log.of_flank(other), *bins) for other in (False, True)]
    kept = [merged(blocks, greatest) if greatest else blocks for blocks in sorted_in]
    case.assumptions.append(_summary(path.name, found, sum(sorted_in, []), sum(kept, [])))
    _say_stops(case, path.name, found)
    _say_reverse(case, path.name, *kept)
    return LogBlocks(found.kind, *kept)


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
        f"{name}:{found.lines[heaviest]}: {found.column} must keep the pull below the chain's tensile strength "
        f"{chain.tensile:g} N (got {pull:.6g} N)",
    )
    return False


def _summary(name: str, found: LogFile, sorted_in: list[LogBin], blocks: list[LogBin]) -> str:
    held = f"every row holds {'for one step' if found.gaps else 'until the next'}"
    text = f"{name}: {found.duration:.6g} s, {held}, {len(sorted_in)} blocks"
    if len(blocks) < len(sorted_in):
        square = [sum(b.revolutions * b.load**2 for b in part) for part in (blocks, sorted_in)]
        text += (
            f", the smallest joined with their neighbours to {len(blocks)}, which keeps time, cycles and "
            f"mean load and takes {100 * (1 - square[0] / square[1]):.2g} % off its mean square"
        )
    if found.renamed:
        text += f"; columns {', '.join(found.renamed)} are read as seconds, rpm and watts of a power meter"
    return text


def _say_stops(case: ChainRecord, name: str, found: LogFile) -> None:
    """Say how long the drive stands, what of it follows from missing rows, and what calendar time it takes."""
    if found.gaps:
        of = "the sample step" if found.even else "the usual step"
        text = (
            f"{name}: {found.gaps} step{'s' if found.gaps > 1 else ''} much longer than {of} of {found.usual:.4g} s: the row before "
            f"holds for that, and the rest, {found.missing:.6g} s, counts as standstill"
        )
        if found.even:
            case.assumptions.append(text)
        else:
            case.warnings.append(f"{text}; if the drive ran on there, add rows")
    standing = found.duration - found.running
    if not (found.gaps or standing > 1e-9 * found.duration):
        return
    per_hour = found.duration / found.running
    case.assumptions.append(
        f"{name}: the drive stands for {100 * standing / found.duration:.3g} % of the time, which counts no cycles "
        f"and no running hours: 1000 running hours take {1000 * per_hour:.4g} h with the stops"
    )
    day = case.tables.service.hours_per_day if case.tables.service else None
    if day is None:
        return
    text = f"service.hours_per_day = {day:g} running hours take {day * per_hour:.4g} h with the stops of {name}"
    if day * per_hour > _DAY * (1.0 + 1e-6):
        case.warnings.append(f"{text}, more than a day has: give the running hours alone")
    else:
        case.assumptions.append(text)


def _say_reverse(case: ChainRecord, name: str, blocks: list[LogBin], reverse: list[LogBin]) -> None:
    """Say which part of the cycles loads the other flank."""
    if not reverse:
        return
    turns, work = (
        [math.fsum(values) for values in of]
        for of in (
            [[block.revolutions for block in part] for part in (blocks, reverse)],
            [[block.revolutions * block.load for block in part] for part in (blocks, reverse)],
        )
    )
    case.assumptions.append(
        f"{name}: for {100 * turns[1] / sum(turns):.3g} % of the cycles the load is negative: tight and slack "
        "strand change places, the joints wear under its size, and the teeth wear on their other flank, which "
        "is not calculated"
    )
    if work[1] > work[0]:
        case.warnings.append(
            f"{name}: negative loads do {work[1] / work[0]:.3g} times the work of positive ones: the other flank "
            "of the teeth wears faster than the one calculated: reverse the signs of the log, and the role of "
            "the sprocket, to calculate that"
        )
