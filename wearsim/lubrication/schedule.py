"""What happens to a lubricant, and when: relubrications, dirt, and the programme of a case."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

from wearsim.lubrication.model import LubricationInput, RunningWay


class LubricantEvent(NamedTuple):
    """What happens to the lubricant at one time of a schedule."""

    after: float  # cycles from the begin of the schedule
    relubricated: bool = False
    held: float | None = None  # what dirt adds at least from here on; None where that stays as it was
    ageing: float | None = None  # how many cycles a cycle makes older from here on; None as before
    dirtied: float = 0.0  # what dirt adds at least at this time


@dataclass(frozen=True)
class LubricantSchedule:
    """What happens to the lubricant, in the order of time, and after how many cycles it begins anew."""

    events: tuple[LubricantEvent, ...] = ()
    repeats: float = math.inf  # [cycles]
    # factor g at which contacts are relubricated after the last event; above what dirt alone gives
    threshold: float = math.inf
    then_every: float = math.inf  # interval at which they are relubricated after the last event [cycles]
    # what happens once, before all that, and after how many cycles the schedule begins
    before: tuple[LubricantEvent, ...] = ()
    begins: float = 0.0

    @classmethod
    def every(cls, interval: float, dirt: float, ageing: float) -> "LubricantSchedule":
        """Return relubrications at an interval [cycles], in dirt that adds so much all the time."""
        begin = LubricantEvent(0.0, held=dirt, ageing=ageing)
        return cls((begin, LubricantEvent(interval, relubricated=True)), interval)


def schedule_of(
    given: LubricationInput, cycles_per_hour: float, cycles: Callable[[RunningWay], float]
) -> LubricantSchedule:
    """Return when contacts are relubricated and dirtied, where `cycles` tells those of a way."""
    dirt = given.dirt
    if given.phases:
        whole = math.fsum(phase.hours for phase in given.phases) * cycles_per_hour
        return LubricantSchedule(tuple(_of_phases(given, cycles_per_hour)), whole)
    every = math.inf if given.interval is None else cycles(given.interval)
    if given.interval is not None and not given.at_hours:
        return LubricantSchedule.every(every, dirt.excess, dirt.ageing)
    begin = LubricantEvent(0.0, held=dirt.excess, ageing=dirt.ageing)
    times = (LubricantEvent(hours * cycles_per_hour, relubricated=True) for hours in given.at_hours)
    return LubricantSchedule((begin, *times), math.inf, given.threshold, every)


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
