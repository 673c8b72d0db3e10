"""The next twelve months of a drive from the readings of its chain."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from wearsim.case.keys import maintenance_of
from wearsim.case.model import Case
from wearsim.drive.drive_case import DriveCase
from wearsim.drive.life import drive_life
from wearsim.drive.maintenance import drive_prices, part_lives
from wearsim.drive.part_life import simulate
from wearsim.drive.replacement_rules import Prices
from wearsim.errors import CaseError, Fault
from wearsim.quantities import grouped
from wearsim.readings.chain_log import ChainLog
from wearsim.readings.chain_state import ChainState, first_day, log_of_chain, logged_state
from wearsim.readings.teeth_as_read import TEETH_WORDS, Teeth, teeth_warning
from wearsim.result.ends import CHAIN, PartEnd
from wearsim.runner.in_threads import Progress
from wearsim.study.maintain.as_read import drive_as_read
from wearsim.study.maintain.year_plan import (
    KEEP,
    REPLACE,
    Job,
    PartNow,
    kept_parts,
    relubrications,
    replacements,
    total,
    year_of_hours,
)

SPROCKET = "sprocket"


@dataclass(frozen=True, eq=False)
class YearPlan:
    """What to do in the next twelve months."""

    given: Case | DriveCase
    state: ChainState
    parts: tuple[PartNow, ...]  # the chain first
    prices: Prices | None
    currency: str  # of the prices; empty where none is named
    teeth: Teeth
    jobs: tuple[Job, ...]  # in the order of time
    warnings: tuple[str, ...]

    @property
    def hours(self) -> float:
        """Running hours of twelve months."""
        return year_of_hours(self.state.case.inputs["service"]["hours_per_day"])

    @cached_property
    def rows(self) -> tuple[Job, ...]:
        """Jobs, and below them the parts that are kept."""
        return (*self.jobs, *kept_parts(self.parts, self.jobs))

    @property
    def total(self) -> float | None:
        """What all jobs cost; None where a price is missing."""
        return total(self.jobs)

    @property
    def assumptions(self) -> tuple[str, ...]:
        """What the plan takes for granted."""
        of_case = self.state.case.assumptions
        return (*_conventions(self), *(text for text in self.state.assumptions if text not in of_case))


def year_plan(
    given: Case | DriveCase, path: Path, teeth: Teeth, error: float, progress: Progress
) -> YearPlan:
    """Return the plan of the next twelve months, counted from the last row of a log.

    The chain stands where its readings say, with the interval of its life. Sprockets have run since they were
    new, by rows ``new`` with their names, else since the chain was new.

    Raises
    ------
    CaseError
        What is wrong with case or readings, or what a plan by days needs beside.
    ContactError, ConvergenceError
        The run of a sprocket fails.
    """
    log = log_of_chain(given, path, error)
    _check_days(given.chain_case, log)
    state = logged_state(given, log)
    ends = _ends(drive_as_read(given, state, teeth), progress)
    _check_names(state, ends)
    parts = _parts(state, ends)
    prices = _of_all_chains(_prices(given), state)
    until = year_of_hours(state.case.inputs["service"]["hours_per_day"])
    replaced = replacements(parts, until, prices)
    jobs = [*replaced, *_beside_new_chains(state, _relubrications(state, until), replaced)]
    return YearPlan(
        given=given,
        state=state,
        parts=parts,
        prices=prices,
        currency=maintenance_of(given.chain_case.inputs).currency or "",
        teeth=teeth,
        jobs=tuple(sorted(jobs, key=lambda job: job.hours)),
        warnings=(*teeth_warning(state.factor, teeth), *state.warnings, *_not_known(parts, until)),
    )


def _check_days(case: Case, log: ChainLog) -> None:
    """Raise where hours have no days."""
    service = case.inputs.get("service") or {}
    if "hours_per_day" not in service:
        text = "a plan of twelve months needs it, or --set service.hours_per_day=VALUE"
        raise CaseError([Fault(text, "service.hours_per_day", case.name)])
    if first_day(case, log) is None:
        text = "a plan by days needs it, or a log by date; or --set service.start_date=DAY"
        raise CaseError([Fault(text, "service.start_date", case.name)])


def _check_names(state: ChainState, known: Iterable[str]) -> None:
    """Raise where a row is of a sprocket that the drive has not."""
    faults = [
        Fault(f"must be one of {', '.join(known)} (got {name!r})", SPROCKET, state.log.file)
        for name in state.log.sprockets
        if name not in known
    ]
    if faults:
        raise CaseError(faults)


def _ends(case: Case | DriveCase, progress: Progress) -> Mapping[str, PartEnd]:
    """Return what ends each sprocket first, with its band."""
    if not isinstance(case, DriveCase):
        result = simulate(case, progress)
        return {SPROCKET: _end(result.ends, (SPROCKET,), result.parts[SPROCKET].hours_run)}
    found = drive_life(case, progress).complete()
    lives = part_lives(found)
    return {
        wheel.name: _end(found.ends, wheel.parts, lives[wheel.name].hours_run) for wheel in case.worn_wheels
    }


def _end(ends: Iterable[PartEnd], parts: Sequence[str], hours: float) -> PartEnd:
    return next(end for end in ends if end.part in parts and end.hours == hours)


def _parts(state: ChainState, ends: Mapping[str, PartEnd]) -> tuple[PartNow, ...]:
    """Return chain and sprockets as they are on the day of the last row."""
    today, new, rotation = state.log.machine, state.log.sprockets, state.log.rotation
    life = state.of("life_hours").middle
    left = state.of("remaining_hours" if rotation is None else "remaining_hours_of_all").values
    low, _, middle, _, high = (value for value in left if isinstance(value, float))
    assert isinstance(life, float)
    whole = life if rotation is None else life * len(rotation.hours)
    used = today if rotation is None else whole - middle
    chain = PartNow(CHAIN, whole, used, True, low, high)
    return (chain, *(_sprocket(name, end, today - new.get(name, 0.0)) for name, end in ends.items()))


def _sprocket(name: str, end: PartEnd, used: float) -> PartNow:
    """Return a sprocket with the band of its life; where it outlived its run only the low end is known."""
    low, high = (math.nan if one is None else max(one - used, 0.0) for one in (end.low, end.high))
    return PartNow(name, end.life.hours_run, used, end.reached, low, high if end.reached else math.nan)


def _prices(given: Case | DriveCase) -> Prices | None:
    if isinstance(given, DriveCase):
        return drive_prices(given)
    table = maintenance_of(given.inputs)
    if table.chain_price is None or table.sprocket_price is None:
        return None
    return Prices(table.chain_price, {SPROCKET: table.sprocket_price}, table.stop_cost)


def _of_all_chains(prices: Prices | None, state: ChainState) -> Prices | None:
    """Return prices with that of all chains in rotation."""
    rotation = state.log.rotation
    if prices is None or rotation is None:
        return prices
    return replace(prices, chain=len(rotation.hours) * prices.chain)


def _relubrications(state: ChainState, until: float) -> list[Job]:
    """Return relubrications as they were logged and go on, else as the case says."""
    log, given = state.log.relubrications, state.case.lubrication
    if given is None:
        return []
    if log.logged_interval:
        return relubrications(log.to_come - log.today, log.mean_interval, until, given.application_cost)
    every = given.interval.hours if given.interval is not None else 0.0
    if not every > 0.0:
        return []
    done = max((hours for hours in (*given.at_hours, 0.0) if hours <= log.today), default=0.0)
    first = done + every * math.ceil((log.today - done) / every) - log.today
    return relubrications(first, every, until, given.application_cost)


def _beside_new_chains(state: ChainState, jobs: Sequence[Job], replaced: Sequence[Job]) -> list[Job]:
    """Return relubrications but those on the day of a new chain, which comes lubricated."""
    now = state.log.machine
    new = {state.day(now + job.hours) for job in replaced if CHAIN in job.parts}
    return [job for job in jobs if state.day(now + job.hours) not in new]


def _not_known(parts: tuple[PartNow, ...], until: float) -> Iterator[str]:
    """Say of which parts it is not known whether they last for the year."""
    for one in parts:
        if not one.worn_out and one.left < until:
            run, left = grouped(one.life), grouped(one.left)
            yield (
                f"{one.name} did not wear out in its run of {run} h, of which {left} h are left: "
                "whether it lasts for the year is not known, a longer run.horizon_hours may show"
            )
        if one.used < 0.0:
            yield f"{one.name} is fitted only {grouped(-one.used)} h after the last row of the log"


def _conventions(plan: YearPlan) -> Iterator[str]:
    yield TEETH_WORDS[plan.teeth]
    yield "days count from the last row of the log, at the running hours of a day in [service]"
    rotation, new = plan.state.log.rotation, plan.state.log.sprockets
    if rotation is not None:
        yield f"the {len(rotation.hours)} chains in rotation are replaced together, when all are worn out"
    alike = [one.name for one in plan.parts if one.name != CHAIN and one.name not in new]
    if alike:
        which = "this chain" if rotation is None else "the first chain"
        yield f"{', '.join(alike)}: new with {which}, as no row 'new' says otherwise"
    if any(job.job == REPLACE for job in plan.jobs):
        yield (
            "replacement parts last as long as the present ones; a stop costs the same whatever is replaced "
            "in it; a part is replaced early if its unused life costs no more than a stop"
            + ("" if plan.prices else " (without prices: where it makes the fewest stops)")
        )
    if any(row.job == KEEP for row in plan.rows):
        yield "parts that stay are shown with the day on which they are worn out"
