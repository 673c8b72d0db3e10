"""The lubricant of a case as the clock of its wear."""

import math
from collections.abc import Iterator

from wearsim.case.lubrication_input import LubricationInput, RunningWay
from wearsim.case.model import Case
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
        by_sliding = way.sliding / sliding_per_cycle if way.sliding else 0.0
        return way.hours * case.cycles_per_hour + by_sliding

    law = LubricantLaw(
        given.dry_factor, cycles(given.lasts), cycles(given.fades), given.completeness, given.dirt_removed
    )
    begin = LubricantEvent(0.0, held=given.dirt.excess, ageing=given.dirt.ageing)
    if given.phases:
        whole = math.fsum(phase.hours for phase in given.phases) * case.cycles_per_hour
        return LubricantClock(law, LubricantSchedule(tuple(_of_phases(given, case.cycles_per_hour)), whole))
    if given.interval is not None:
        interval = cycles(given.interval)
        return LubricantClock(
            law, LubricantSchedule((begin, LubricantEvent(interval, relubricated=True)), interval)
        )
    times = (LubricantEvent(hours * case.cycles_per_hour, relubricated=True) for hours in given.at_hours)
    return LubricantClock(law, LubricantSchedule((begin, *times), threshold=given.threshold))


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
