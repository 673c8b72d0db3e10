"""The lubricant of a case as the clock of its wear."""

import math
from collections.abc import Iterator

import numpy as np

from wearsim.case.lubrication_input import LubricationInput, RunningWay
from wearsim.case.model import Case, heaviest_block
from wearsim.contact.engagement import ContactKind, FlankContact
from wearsim.contact.hertz import half_width
from wearsim.wear.lubricant_clock import (
    FRESH,
    LubricantClock,
    LubricantEvent,
    LubricantLaw,
    LubricantSchedule,
)


def lubricant_clock(case: Case, sliding_per_cycle: float) -> LubricantClock:
    """Return the clock of a lubricant, whose age may count what its contacts slide in a cycle [mm]."""
    given = case.lubrication
    if given is None:
        return FRESH

    def cycles(way: RunningWay) -> float:
        if way.sliding and not sliding_per_cycle > 0.0:
            return math.inf
        by_sliding = way.sliding / sliding_per_cycle if way.sliding else 0.0
        return way.hours * case.cycles_per_hour + by_sliding

    law = LubricantLaw(
        given.dry_factor, cycles(given.lasts), cycles(given.fades), given.completeness, given.dirt_removed
    )
    dirt = given.dirt
    if given.phases:
        whole = math.fsum(phase.hours for phase in given.phases) * case.cycles_per_hour
        return LubricantClock(law, LubricantSchedule(tuple(_of_phases(given, case.cycles_per_hour)), whole))
    every = math.inf if given.interval is None else cycles(given.interval)
    if given.interval is not None and not given.at_hours:
        return LubricantClock(law, LubricantSchedule.every(every, dirt.excess, dirt.ageing))
    begin = LubricantEvent(0.0, held=dirt.excess, ageing=dirt.ageing)
    times = (LubricantEvent(hours * case.cycles_per_hour, relubricated=True) for hours in given.at_hours)
    return LubricantClock(law, LubricantSchedule((begin, *times), math.inf, given.threshold, every))


def _of_phases(given: LubricationInput, cycles_per_hour: float) -> Iterator[LubricantEvent]:
    """Give the events of a programme in the order of time."""
    begin = 0.0
    for phase in given.phases:
        length, dirties = phase.hours * cycles_per_hour, phase.contaminations
        yield LubricantEvent(begin, held=0.0 if dirties else phase.dirt.excess, ageing=phase.dirt.ageing)
        events = [
            (number / phase.relubrications, LubricantEvent(0.0, relubricated=True))
            for number in range(phase.relubrications)
        ]
        events += [
            ((number + 0.5) / dirties, LubricantEvent(0.0, dirtied=phase.dirt.excess))
            for number in range(dirties)
        ]
        for part, event in sorted(events, key=lambda entry: entry[0]):
            yield event._replace(after=begin + part * length)
        begin += length


def sliding_per_cycle(case: Case, contact: FlankContact) -> float:
    """Mean path that the loaded stretch of the new flank slides in a cycle of the duty [mm]."""
    profile = contact.profile
    touch = contact.engage(profile.x.copy(), profile.y.copy(), np.zeros(profile.x.size))
    loaded = touch.load_per_width > 0.0
    if not loaded.any():
        return 0.0
    slip, stretch = touch.slip[loaded], np.gradient(contact.arc_length)[loaded]
    if contact.kind is ContactKind.TRAVELLING:
        load, relative = touch.load_per_width[loaded], touch.relative_curvature[loaded]
        slip = slip * 2.0 * half_width(load, np.maximum(relative, 1e-9), contact.modulus)
    path = float(np.average(slip, weights=stretch))
    blocks = case.drive.duty
    if not blocks:
        return path
    # The width of the contact goes with the root of the load.
    greatest = heaviest_block(blocks).tension
    return path * math.fsum(block.share * math.sqrt(block.tension / greatest) for block in blocks)
