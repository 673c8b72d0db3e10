"""How hard and how fast the drive runs: blocks of constant load, one for a constant drive."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

from wearsim.case.chain_record import ChainRecord
from wearsim.case.keys import DutyBlock
from wearsim.case.keys.drive_tables import LOAD_KEYS
from wearsim.case.log_blocks import log_blocks
from wearsim.catalogue.catalogues import Chain, regimes

_MAX_BLOCKS = 12
"""Blocks of a log on a wrap, where every block adds its contacts to a cycle."""

_SUM_TOLERANCE = 1e-6


@dataclass(frozen=True)
class GivenLoad:
    """A part of the duty as the case gives it."""

    share: float  # of the cycles
    speed_rpm: float  # of this sprocket
    kind: str  # `tension_N`, `power_kW` or `torque_N_m`
    value: float  # of that key
    wear_factor: float  # on the wear coefficient of the tooth; 0 where the other flank bears the load
    joint_factor: float  # on that of the chain's joints
    key: str  # of the case, for faults
    part: float = 1.0  # of the useful pull, for typical regimes
    measured: bool = False  # whether it comes from a log, which may hold idling
    # whether it loads the other flank of the teeth, so that the tight and the slack strand change places
    reverse: bool = False
    # shares of the power that driven sprockets take here, by their names; none for those of the drive
    power_share: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class GivenDuty:
    """What a drive does, in blocks."""

    # their shares sum to 1; none where a table of loads takes their place
    blocks: tuple[GivenLoad, ...]
    speed_rpm: float  # mean over the time
    # the loads that strength and ratings are judged by: the blocks, but of a typical regime the
    # load given
    rated: tuple[GivenLoad, ...]


def complete_duty(case: ChainRecord, kind: str, chain: Chain) -> GivenDuty | None:
    """Return the duty of a case: from [[duty]], a log, a typical regime or constant."""
    tables, load, faults = case.tables, case.tables.load, case.faults
    if not tables.duty:
        case.inputs.pop("duty", None)
    if kind == "prescribed" and (tables.duty or load.duty_file or load.regime):
        key = "duty" if tables.duty else f"load.{'duty_file' if load.duty_file else 'regime'}"
        faults.add(key, "a table of loads already holds the load of a cycle: remove this")
        return None
    if tables.duty:
        return _given(case, kind)
    if load.duty_file is not None:
        return _logged(case, _MAX_BLOCKS if kind == "wrap" else 0, chain)
    if "load" not in tables.model_fields_set:
        return None
    name = next((key for key in LOAD_KEYS if getattr(load, key) is not None), None)
    if name is None and kind != "prescribed":
        faults.add("load.tension_N", f"give exactly one of {', '.join(LOAD_KEYS)} (got none)")
        return None
    if load.speed_rpm is None:
        return None
    if name is None or kind == "prescribed":
        return GivenDuty((), load.speed_rpm, ())
    block = GivenLoad(1.0, load.speed_rpm, name, getattr(load, name), 1.0, 1.0, f"load.{name}")
    return GivenDuty(_regime(case, block), load.speed_rpm, (block,))


def _regime(case: ChainRecord, block: GivenLoad) -> tuple[GivenLoad, ...]:
    """Return a constant load, or the parts of it in the given typical regime."""
    name = case.tables.load.regime
    if name is None:
        return (block,)
    parts = regimes()[name]
    case.assumptions.append(
        f"typical regime {name}: the load given is its highest; "
        + ", ".join(f"{part:.3g} of it for {100 * share:.3g} %" for part, share in parts)
        + " of the cycles, which reproduces the published equivalence factors"
    )
    _say_heaviest(case, len(parts))
    return tuple(replace(block, share=share, part=part) for part, share in parts)


def _given(case: ChainRecord, kind: str) -> GivenDuty | None:
    """Return the blocks of [[duty]] on a mechanism of this kind."""
    tables, faults = case.tables, case.faults
    before, blocks = faults.count, tables.duty
    for key in sorted(tables.load.model_fields_set):
        if getattr(tables.load, key) is not None:
            faults.add(f"load.{key}", "[[duty]] gives load and speed: remove one of the two")
    kinds = ("share_of_time", "share_of_cycles")
    first = next(kind for kind in kinds if getattr(blocks[0], kind) is not None)
    for number, block in enumerate(blocks, start=1):
        if block.applies_to == "joints" and kind != "wrap":
            faults.add(
                f"duty.{number}.applies_to",
                f"joints wear only where a chain wraps the sprocket, here kind = {kind!r}: "
                "use 'all' or 'teeth', or set mechanism.kind = 'wrap'",
            )
        if getattr(block, first) is None:
            other = kinds[1 - kinds.index(first)]
            faults.add(
                f"duty.{number}.{other}",
                f"all blocks must give their share by the same key, in block 1 it is {first}",
            )
    if faults.count > before:
        return None
    shares = [getattr(block, first) for block in blocks]
    total = math.fsum(shares)
    if abs(total - 1.0) > _SUM_TOLERANCE:
        faults.add("duty", f"{first} of all blocks must sum to 1 (got {total:.9g})")
        return None
    cycles, speed = _shares_of_cycles(
        [share / total for share in shares], [block.speed_rpm for block in blocks], first == "share_of_time"
    )
    found = _joined(
        _load_block(block, number, share)
        for number, (block, share) in enumerate(zip(blocks, cycles, strict=True), start=1)
    )
    case.assumptions.append(f"speed {speed:.6g} rpm is the time average of the duty")
    _say_heaviest(case, len(found))
    return GivenDuty(found, speed, found)


def _load_block(block: DutyBlock, number: int, share: float) -> GivenLoad:
    kind = next(key for key in LOAD_KEYS if getattr(block, key) is not None)
    return GivenLoad(
        share=share,
        speed_rpm=block.speed_rpm,
        kind=kind,
        value=getattr(block, kind),
        wear_factor=1.0 if block.applies_to == "joints" else block.wear_factor,
        joint_factor=1.0 if block.applies_to == "teeth" else block.wear_factor,
        key=f"duty.{number}.{kind}",
        power_share=block.power_share or {},
    )


def _shares_of_cycles(shares: list[float], speeds: list[float], of_time: bool) -> tuple[list[float], float]:
    """Return the shares of the cycles and the mean speed over the time."""
    if of_time:
        mean = math.fsum(share * speed for share, speed in zip(shares, speeds, strict=True))
        return [share * speed / mean for share, speed in zip(shares, speeds, strict=True)], mean
    # Relative to the first speed: a constant one comes out to the last digit.
    slow = math.fsum(share * (speeds[0] / speed) for share, speed in zip(shares, speeds, strict=True))
    return shares, speeds[0] / slow


def _joined(blocks: Iterable[GivenLoad]) -> tuple[GivenLoad, ...]:
    """Join blocks of the same load and speed: shares add up, the factors on wear are their means."""
    found: dict[tuple[object, ...], GivenLoad] = {}
    for block in blocks:
        alike = block.kind, block.value, block.speed_rpm, *sorted(block.power_share.items())
        same = found.get(alike)
        if same is not None:
            block = replace(
                same,
                share=same.share + block.share,
                wear_factor=_mean(same, block, same.wear_factor, block.wear_factor),
                joint_factor=_mean(same, block, same.joint_factor, block.joint_factor),
            )
        found[alike] = block
    return tuple(found.values())


def _mean(one: GivenLoad, other: GivenLoad, first: float, second: float) -> float:
    """Return the mean of a number of two blocks by their shares; equal ones stay to the last digit."""
    if first == second:
        return first
    return (one.share * first + other.share * second) / (one.share + other.share)


def _logged(case: ChainRecord, most_blocks: int, chain: Chain) -> GivenDuty | None:
    """Return the blocks of a log of load and speed."""
    logged = log_blocks(case, most_blocks, chain)
    if logged is None:
        return None
    blocks, ratio = (*logged.blocks, *logged.reverse), case.tables.load.duty_speed_ratio or 1.0
    _say_heaviest(case, len(blocks))
    cycles = math.fsum(block.revolutions for block in blocks)
    found = tuple(
        GivenLoad(
            share=block.revolutions / cycles,
            speed_rpm=60.0 * ratio * block.revolutions / block.time,
            kind=logged.kind,
            value=block.load if logged.kind == "tension_N" else block.load / ratio,
            wear_factor=float(number < len(logged.blocks)),
            joint_factor=1.0,
            key="load.duty_file",
            measured=True,
            reverse=number >= len(logged.blocks),
        )
        for number, block in enumerate(blocks)
    )
    return GivenDuty(found, 60.0 * ratio * cycles / math.fsum(block.time for block in blocks), found)


def _say_heaviest(case: ChainRecord, count: int) -> None:
    if count > 1:
        case.assumptions.append(
            f"wear per cycle is the mean over {count} blocks of the duty, weighted by their cycles; "
            "pressure is that of the heaviest block"
        )
