"""The state of the lubricant as a clock: cycles run, and lubricated ones that wear as much."""

import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from wearsim.errors import ConvergenceError
from wearsim.geometry.profile_points import Vector
from wearsim.lubrication.law import LubricantLaw
from wearsim.lubrication.model import LubricationInput, RunningWay
from wearsim.lubrication.schedule import LubricantEvent, LubricantSchedule, schedule_of

_MOST = 100_000
"""Stretches between two events that a schedule may have before it repeats itself."""

_ALONG_FADING = 5
"""Ages from where a lubricant fades to where it is gone, between which the wear is nearly straight."""

_SAME = 1e-14
"""Part of the age up to which two states of a lubricant are one."""


class _Stretch(NamedTuple):
    """The begin of the cycles between two events."""

    begin: float  # [cycles]
    worn: float  # M up to there
    age: float  # [cycles]
    dirt: float  # C
    held: float  # what dirt adds at least
    ageing: float  # how many cycles a cycle makes older
    events: tuple[LubricantEvent, ...] = ()  # what happened where it begins

    def near(self, other: "_Stretch", scale: float) -> bool:
        """Return whether age and dirt are those of another time."""
        return (
            abs(self.age - other.age) <= _SAME * scale
            and abs(self.dirt - other.dirt) <= _SAME * (1.0 + self.dirt)
            and (self.held, self.ageing) == (other.held, other.ageing)
        )


class LubricantClock:
    """Between cycles run and the cycles of well lubricated contacts that wear as much.

    M(N), the integral of g over N cycles, is found event by event until the schedule repeats a state;
    from there on it is periodic. All of it is exact but for rounding.

    Equation physics.md (O2).

    Parameters
    ----------
    law : LubricantLaw
        How the coefficient goes with age and dirt.
    schedule : LubricantSchedule
        What happens to the lubricant.

    Raises
    ------
    ConvergenceError
        A schedule that does not repeat a state after very many events.

    Examples
    --------
    Relubricated every 150 cycles, of which the last 50 are at four times the wear:

    >>> every = LubricantSchedule((LubricantEvent(150.0, relubricated=True),), 150.0)
    >>> clock = LubricantClock(LubricantLaw(4.0, 100.0), every)
    >>> clock.steady_cycles(300.0), clock.steady_cycles(310.0)
    (600.0, 610.0)
    """

    def __init__(self, law: LubricantLaw, schedule: LubricantSchedule) -> None:
        self.law = law
        self._stretches: list[_Stretch] = []
        # Where the schedule begins to repeat itself, and its cycles and wear from then on.
        self._first, self._cycles, self._worn = 0, math.inf, math.inf
        # What has happened since the last stretch began, and what happens where the first one comes again.
        self._happened: list[LubricantEvent] = []
        self._again: tuple[LubricantEvent, ...] = ()
        state = _Stretch(0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
        for event in schedule.before:
            state = self._changed(self._run(state, event.after), event)
        state = self._run(state, schedule.begins)
        if schedule.events:
            state = self._rounds(schedule, state)
        if math.isinf(schedule.repeats):
            self._afterwards(schedule, state)
        self._begins = np.array([stretch.begin for stretch in self._stretches])
        self._wears = np.array([stretch.worn for stretch in self._stretches])

    def _rounds(self, schedule: LubricantSchedule, state: _Stretch) -> _Stretch:
        """Follow a schedule, time and again where it repeats itself, until a state comes again."""
        while True:
            start, first, last = state, len(self._stretches), len(self._happened)
            for event in schedule.events:
                state = self._changed(self._run(state, start.begin + event.after), event)
            if math.isinf(schedule.repeats):
                return state
            state = self._run(state, start.begin + schedule.repeats)
            if state.near(start, schedule.repeats):
                self._repeat(first, last, start, state)
                return state

    def _afterwards(self, schedule: LubricantSchedule, state: _Stretch) -> None:
        """Go on after the last event, with relubrications at an interval or where the wear asks for them."""

        def age_at_end(state: _Stretch) -> float:
            at_interval = state.age + state.ageing * schedule.then_every
            return min(self.law.age_of(schedule.threshold, state.dirt), at_interval)

        age = age_at_end(state)
        while age < math.inf:
            start, first, last = state, len(self._stretches), len(self._happened)
            state = self._run(state, state.begin + max(age - state.age, 0.0) / state.ageing)
            state = self._changed(state, LubricantEvent(0.0, relubricated=True))
            if state.near(start, age):
                self._repeat(first, last, start, state)
                return
            age = age_at_end(state)
        self._keep(state)

    def _repeat(self, first: int, last: int, start: _Stretch, end: _Stretch) -> None:
        """Go on for ever with the stretches from the first on; ``last`` events before it are of no round."""
        self._first, self._cycles, self._worn = first, end.begin - start.begin, end.worn - start.worn
        self._again = (*self._happened, *self._stretches[first].events[last:])

    def _run(self, state: _Stretch, end: float) -> _Stretch:
        """Let the lubricant age until a time."""
        cycles = end - state.begin
        if not cycles > 0.0:
            return state
        self._keep(state)
        worn = state.worn + self.law.worn(state.age, cycles, state.dirt, state.ageing)
        # It ages no more once it is dry, or while it does not age at all.
        dry = 0.0 if math.isinf(self.law.lasts) else self.law.lasts + self.law.fades
        return state._replace(begin=end, worn=worn, age=min(state.age + state.ageing * cycles, dry))

    def _keep(self, state: _Stretch) -> None:
        if len(self._stretches) == _MOST:
            raise ConvergenceError(
                f"lubrication: the schedule must repeat itself, but does not within {_MOST} stretches "
                "between events: use fewer events, or more complete relubrications"
            )
        self._stretches.append(state._replace(events=tuple(self._happened)))
        self._happened.clear()

    def _changed(self, state: _Stretch, event: LubricantEvent) -> _Stretch:
        """Return the lubricant after an event."""
        age, dirt = state.age, state.dirt
        if event.relubricated:
            age *= 1.0 - self.law.completeness
            dirt *= 1.0 - self.law.dirt_removed
        self._happened.append(event)
        held = state.held if event.held is None else event.held
        ageing = state.ageing if event.ageing is None else event.ageing
        return state._replace(age=age, dirt=max(dirt, held, event.dirtied), held=held, ageing=ageing)

    def steady_cycles(self, cycles: float) -> float:
        """Return the cycles of well lubricated contacts that wear as much.

        Equation physics.md (O2).

        Parameters
        ----------
        cycles : float
            N, cycles run.

        Returns
        -------
        float
            M.
        """
        rounds, rest, stretch = self._place(cycles)
        worn = stretch.worn + self.law.worn(
            stretch.age, max(rest - stretch.begin, 0.0), stretch.dirt, stretch.ageing
        )
        return worn + rounds * self._worn if rounds else worn

    def _place(self, cycles: float) -> tuple[int, float, _Stretch]:
        """Return the rounds before a time, the same time in the first round, and its stretch."""
        start = self._stretches[self._first]
        rounds = max(math.floor((cycles - start.begin) / self._cycles), 0)
        rest = cycles - rounds * self._cycles if rounds else cycles
        at = max(int(np.searchsorted(self._begins, rest, side="right")) - 1, 0)
        return rounds, rest, self._stretches[at]

    def running_cycles(self, constant: Vector) -> Vector:
        """Return the cycles run after which as much has worn.

        Equation physics.md (O2), solved for N in the stretch in which it lies.

        Parameters
        ----------
        constant : numpy.ndarray
            M, cycles of well lubricated contacts.

        Returns
        -------
        numpy.ndarray
            N.
        """
        steady = np.asarray(constant, dtype=float)
        return np.array([self._run_for(float(worn)) for worn in steady.flat]).reshape(steady.shape)

    def _run_for(self, worn: float) -> float:
        start = self._stretches[self._first]
        rounds = max(math.floor((worn - start.worn) / self._worn), 0)
        rest = worn - rounds * self._worn if rounds else worn
        at = max(int(np.searchsorted(self._wears, rest, side="right")) - 1, 0)
        stretch = self._stretches[at]
        left = max(rest - stretch.worn, 0.0)
        cycles = stretch.begin + self.law.cycles_for(stretch.age, left, stretch.dirt, stretch.ageing)
        return cycles + rounds * self._cycles if rounds else cycles

    def renewed(self, at: float) -> "LubricantClock":
        """Return the clock of a part that is put on at a time, lubricated and clean, counted from there on.

        What happens to the lubricant by the schedule happens to that of the part too, at the same times.

        Examples
        --------
        Relubricated every 150 cycles, dry from the hundredth on. A part put on at 120 is lubricated, and
        again at 150 and at 300, and dry from 250 on:

        >>> every = LubricantSchedule((LubricantEvent(150.0, relubricated=True),), 150.0)
        >>> part = LubricantClock(LubricantLaw(4.0, 100.0), every).renewed(120.0)
        >>> part.steady_cycles(30.0), part.steady_cycles(140.0), part.steady_cycles(180.0)
        (30.0, 170.0, 330.0)
        """
        _, rest, stretch = self._place(at)
        number = self._stretches.index(stretch) + 1
        begin = LubricantEvent(0.0, held=stretch.held, ageing=stretch.ageing)

        def events(stretches: list[_Stretch], start: float) -> Iterator[LubricantEvent]:
            for later in stretches:
                yield from (event._replace(after=later.begin - start) for event in later.events)

        before = begin, *events(self._stretches[number:], rest)
        if math.isinf(self._cycles):
            return LubricantClock(self.law, LubricantSchedule(before=before))
        first = self._stretches[self._first]
        again = (event._replace(after=0.0) for event in self._again)
        once_more = events(self._stretches[self._first + 1 :], first.begin)
        return LubricantClock(
            self.law,
            LubricantSchedule(
                (*again, *once_more), self._cycles, before=before, begins=first.begin + self._cycles - rest
            ),
        )

    def factor(self, cycles: float) -> float:
        """Return g at a time."""
        _, rest, stretch = self._place(cycles)
        age = stretch.age + stretch.ageing * max(rest - stretch.begin, 0.0)
        return self.law.factor(age, stretch.dirt)

    def knees(self, end: float, most: int = 200) -> Vector:
        """Return the times before an end between which the wear is nearly straight, thinned out to so many.

        Examples
        --------
        Relubricated every 150 cycles, dry from the hundredth on:

        >>> every = LubricantSchedule((LubricantEvent(150.0, relubricated=True),), 150.0)
        >>> LubricantClock(LubricantLaw(4.0, 100.0), every).knees(310.0).tolist()
        [100.0, 150.0, 250.0, 300.0]
        """
        once = [at for number in range(self._first) for at in self._bends(number)]
        again = [at for number in range(self._first, len(self._stretches)) for at in self._bends(number)]
        later = np.zeros(1)
        if again and math.isfinite(self._cycles):
            rounds = max(math.ceil((end - self._stretches[self._first].begin) / self._cycles), 1)
            kept = np.linspace(0, rounds - 1, min(rounds, max(most // len(again), 1)))
            later = self._cycles * np.unique(kept.round())
        found = [*once, *(at + by for by in later.tolist() for at in again)]
        inside = [at for at in found if 0.0 < at < end]
        return np.array(inside[:: max(math.ceil(len(inside) / most), 1)])

    def _bends(self, number: int) -> list[float]:
        """Return the begin of a stretch, where g jumps there, and where its lubricant gives out."""
        law, stretch, end = self.law, self._stretches[number], self._end(number)
        before = number - 1 if number > self._first else len(self._stretches) - 1
        last = self._stretches[before]
        age = last.age + last.ageing * (self._end(before) - last.begin)
        jumps = law.factor(age, last.dirt) != law.factor(stretch.age, stretch.dirt)
        found = [stretch.begin] if jumps else []
        if law.dry_factor > 1.0 and math.isfinite(law.lasts):
            parts = np.linspace(0.0, 1.0, _ALONG_FADING) if law.fades else np.zeros(1)
            ages = law.lasts + law.fades * parts
            times = stretch.begin + (ages - stretch.age) / stretch.ageing
            found += [at for at in times.tolist() if stretch.begin < at < end]
        return found

    def _end(self, number: int) -> float:
        """Return when a stretch ends; infinite for the last one of a schedule that does not repeat itself."""
        if number + 1 < len(self._stretches):
            return self._stretches[number + 1].begin
        return self._stretches[self._first].begin + self._cycles

    @property
    def repeats(self) -> float:
        """Cycles after which the schedule begins anew; infinite where it does not."""
        return self._cycles

    @property
    def lasting_factor(self) -> float:
        """Mean of g once the schedule repeats itself; in the end where it does not."""
        if math.isinf(self._cycles):
            last = self._stretches[-1]
            return self.law.factor(math.inf, last.dirt)
        return self._worn / self._cycles

    @property
    def amplification(self) -> float:
        """Greatest relative error of the cycles run for one of the lubricated ones, M/(N g).

        Within a stretch g does not fall, so it is greatest where one begins, at the latest in the
        mean over a round.
        """
        greatest = 1.0
        for number, stretch in enumerate(self._stretches):
            mean = stretch.worn / stretch.begin if stretch.begin > 0.0 else 1.0
            if number >= self._first and not math.isinf(self._cycles):
                mean = max(mean, self._worn / self._cycles)
            greatest = max(greatest, mean / self.law.factor(stretch.age, stretch.dirt))
        return greatest


FRESH = LubricantClock(LubricantLaw(), LubricantSchedule())
"""A lubricant that stays as it is."""


def lubricant_clock(
    given: LubricationInput | None, cycles_per_hour: float, sliding_per_cycle: float
) -> LubricantClock:
    """Return the clock of a lubricant, whose age may count what its contacts slide in a cycle [mm]."""
    if given is None:
        return FRESH

    def cycles(way: RunningWay) -> float:
        if way.sliding and not sliding_per_cycle > 0.0:
            return math.inf
        by_sliding = way.sliding / sliding_per_cycle if way.sliding else 0.0
        return way.hours * cycles_per_hour + by_sliding

    law = LubricantLaw(
        given.dry_factor, cycles(given.lasts), cycles(given.fades), given.completeness, given.dirt_removed
    )
    return LubricantClock(law, schedule_of(given, cycles_per_hour, cycles))


class ClockEnds(NamedTuple):
    """The clock of a lubricant at both ends of something that is not known of it exactly."""

    unsure: str  # what that is
    stated: bool  # whether the case says how unsure it is
    worse: LubricantClock
    better: LubricantClock


def clock_ends(
    given: LubricationInput | None, cycles_per_hour: float, sliding_per_cycle: float
) -> tuple[ClockEnds, ...]:
    """Return the clocks at the ends of everything that is not known of a lubricant exactly."""
    if given is None:
        return ()
    return tuple(
        ClockEnds(
            unsure,
            stated,
            lubricant_clock(worse, cycles_per_hour, sliding_per_cycle),
            lubricant_clock(better, cycles_per_hour, sliding_per_cycle),
        )
        for unsure, stated, worse, better in given.ends
    )


def band_of_causes(middle: float, ends: Iterable[tuple[float, float]]) -> tuple[float, float]:
    """Return the ends of a life that has a lower and an upper one by each of some independent causes.

    Logarithms of independent causes add as squares.

    Examples
    --------
    A life of 100 h that one cause halves or doubles, another one makes shorter only:

    >>> low, high = band_of_causes(100.0, [(50.0, 200.0), (25.0, 100.0)])
    >>> round(100.0 / low, 4), round(high, 4)  # 2^sqrt(1 + 4), 2^1
    (4.7111, 200.0)
    """
    # The better end of a cause may be the shorter life, as where it is relubricated less often.
    spans = [(min(middle, *lives), max(middle, *lives)) for lives in ends]
    low, high = (
        math.sqrt(math.fsum(math.log(end / middle) ** 2 for end in side)) for side in zip(*spans, strict=True)
    )
    return middle * math.exp(-low), middle * math.exp(high)
