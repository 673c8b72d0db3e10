"""The present state of a chain, and what is left of its life, from all that was read."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import date
from pathlib import Path

import numpy as np

from wearsim.case.model import Case, WearBand
from wearsim.drive.drive_case import DriveCase
from wearsim.drive.wrap_life import chain_band, chain_clock, chain_prior, wrap_of
from wearsim.errors import CaseError, Fault
from wearsim.geometry.profile_points import Vector
from wearsim.mechanisms.wrap.drive import instead_of
from wearsim.quantities import grouped
from wearsim.readings.chain_log import ChainLog, read_chain_log
from wearsim.readings.chain_readings import NO_GO, ChainReading
from wearsim.readings.contradictions import (
    CHAIN,
    JOINTS,
    Contradiction,
    WearReading,
    band_warning,
    contradiction_warnings,
    contradictions,
)
from wearsim.readings.posterior import LEVELS, FactorPosterior, FactorPrior, factor_posterior
from wearsim.readings.relubrications import relubricated
from wearsim.result.lives import day_after
from wearsim.wear.mate_clock import LubricatedClock

_BEYOND, _POINTS = 1.1, 400
"""Part of the latest end of the life up to which the elongation is told, and at how many times."""


@dataclass(frozen=True)
class Quantiles:
    """A quantity that is told with its intervals."""

    name: str  # column or key
    values: tuple[float | str, ...]  # at `LEVELS`; days as text, empty where no calendar goes so far

    @property
    def middle(self) -> float | str:
        """The median."""
        return self.values[len(LEVELS) // 2]


@dataclass(frozen=True)
class ChainNow:
    """Where one chain stands, at `LEVELS`."""

    run: float  # running time [h]
    elongation: tuple[float, ...]  # [%]
    left: tuple[float, ...]  # [h]


@dataclass(frozen=True, eq=False)
class ChainState:
    """What readings say about a chain."""

    case: Case
    log: ChainLog
    limit: float  # elongation at which its life ends [%]
    expected: tuple[float, ...]  # elongation at each reading with the case's own coefficient [%]
    course_hours: Vector  # from new to beyond the latest end of the life [h]
    course: Vector  # elongation then with the case's own coefficient [%]
    posterior: FactorPosterior  # of the coefficient over the case's
    quantiles: tuple[Quantiles, ...]  # of everything that is told
    chains: Mapping[str, ChainNow]  # by their names; a chain alone by ""
    assumptions: tuple[str, ...]
    warnings: tuple[str, ...]

    def day(self, hours: float) -> str:
        """Return the day after so many hours since the chain was new; empty where no day is known."""
        start, service = first_day(self.case, self.log), self.case.inputs.get("service") or {}
        if start is None or "hours_per_day" not in service:
            return ""
        return day_after(start, hours / service["hours_per_day"])

    @property
    def factor(self) -> float:
        """Median of the coefficient over the case's."""
        return self.posterior.quantiles[len(LEVELS) // 2]

    def of(self, name: str) -> Quantiles:
        """Return the quantiles of a quantity."""
        return next(one for one in self.quantiles if one.name == name)


def log_of_chain(case: Case | DriveCase, path: Path, usual_error: float) -> ChainLog:
    """Return what a table says of the chain of a case; a reading without an error has the usual one [%]."""
    first = case.chain_case
    if not first.drive.wear_coefficients:
        text = f"readings of a chain need one that wraps the sprocket: {instead_of(first)}"
        raise CaseError([Fault(text, "mechanism.kind", first.name)])
    return read_chain_log(path, first.inputs, wrap_of(first).chain.pitch, usual_error)


def chain_state(case: Case | DriveCase, path: Path, usual_error: float = 0.05) -> ChainState:
    """Return the state of a chain from a table of dated readings, as `logged_state` of its log."""
    return logged_state(case, log_of_chain(case, path, usual_error))


def logged_state(case: Case | DriveCase, log: ChainLog) -> ChainState:
    """Return the state of a chain from its log.

    The elongation is the case's own rate times the running time times one factor on the coefficient.
    Its distribution is the band of the case, as 90 % of a log-normal one, times the likelihood of
    all readings (Bayes' theorem); life is inverse to the factor.

    Parameters
    ----------
    case : Case or DriveCase
        With a chain that wraps its sprocket, or a whole drive.
    log : ChainLog
        Its readings and relubrications.

    Raises
    ------
    CaseError
        A reading beyond the limit that no other one contradicts.
    """
    first = case.chain_case
    limit = 100.0 * wrap_of(first).joint.elongation_limit
    as_logged = {name: relubricated(case, its) for name, its in log.lubricated.items()}
    return _state(first, as_logged, log, limit)


@dataclass(frozen=True)
class _Growth:
    """How a chain grows with the case's own coefficient, relubricated as it was logged."""

    clock: LubricatedClock
    per_hour: float  # cycles
    cycles: float  # of steady wear to the limit
    limit: float  # [%]

    @classmethod
    def of(cls, case: Case, limit: float) -> "_Growth":
        cycles = wrap_of(case).contact(case).cycles_per_mate
        return cls(chain_clock(case), case.cycles_per_hour, cycles, limit)

    def elongation(self, hours: float) -> float:
        """Return the elongation after so many hours [%]."""
        return self.limit / self.cycles * self.clock.steady_cycles(hours * self.per_hour)

    def lives(self, factors: Vector) -> tuple[float, ...]:
        """Return the lives by factors on the coefficient [h]."""
        return tuple((self.clock.running_cycles(self.cycles / factors) / self.per_hour).tolist())


def _state(case: Case, as_logged: Mapping[str, Case], log: ChainLog, limit: float) -> ChainState:
    """Return what a log says, by the clocks of the wear of its chains as they ran and go on."""
    growth = {name: _Growth.of(one, limit) for name, one in as_logged.items()}
    mounted, now = growth[log.mounted], as_logged[log.mounted]
    expected = tuple(growth[one.chain].elongation(one.hours) for one in log.readings)
    band = chain_band(now)
    posterior = factor_posterior(log.readings, expected, FactorPrior(*chain_prior(now)))
    factors = np.array(posterior.quantiles)
    lives = mounted.lives(factors[::-1])
    excluding = contradictions(
        [_beside(one, posterior.nearest * at) for one, at in zip(log.readings, expected, strict=True)]
    )
    _check_within(log, limit, excluding, lives[len(LEVELS) // 2])
    chains = {name: _now(one, log.lubricated[name].today, factors) for name, one in growth.items()}
    hours = np.linspace(0.0, _BEYOND * max(lives[-1], log.today), _POINTS)
    return ChainState(
        case=case,
        log=log,
        limit=limit,
        expected=expected,
        course_hours=hours,
        course=np.array([mounted.elongation(float(one)) for one in hours]),
        posterior=posterior,
        quantiles=(
            *_left(case, log, {name: one.left for name, one in chains.items()}),
            Quantiles("elongation_percent", chains[log.mounted].elongation),
            Quantiles("life_hours", lives),
            Quantiles("coefficient_factor", posterior.quantiles),
        ),
        chains=chains,
        assumptions=(*_assumptions(log, band), *case.assumptions),
        warnings=(
            *contradiction_warnings(excluding),
            *_warnings(case, log, posterior, band, lives),
            *case.warnings,
        ),
    )


def _now(growth: _Growth, run: float, factors: Vector) -> ChainNow:
    """Return the state of a chain that has run so long."""
    grown = tuple((growth.elongation(run) * factors).tolist())
    return ChainNow(run, grown, tuple(max(one - run, 0.0) for one in growth.lives(factors[::-1])))


def _left(case: Case, log: ChainLog, of_chains: Mapping[str, tuple[float, ...]]) -> Iterator[Quantiles]:
    """Give what is left from the last row on, in the measures that the case knows."""
    left = of_all = of_chains[log.mounted]
    service = case.inputs.get("service") or {}
    yield Quantiles("remaining_hours", left)
    if "km_per_hour" in service:
        yield Quantiles("remaining_km", tuple(service["km_per_hour"] * one for one in left))
    if log.rotation is not None:
        of_all = tuple(map(math.fsum, zip(*of_chains.values(), strict=True)))
        yield Quantiles("remaining_hours_of_all", of_all)
    start = first_day(case, log)
    if start is not None:
        ends = [log.machine + one for one in of_all]
        each = service["hours_per_day"]
        yield Quantiles("end_date", tuple(day_after(start, one / each) for one in ends))


def first_day(case: Case, log: ChainLog) -> date | None:
    """Return the day on which the chain was new; None where it is not known."""
    given = (case.inputs.get("service") or {}).get("start_date")
    return log.time.start or (date.fromisoformat(given) if given else None)


def _beside(one: ChainReading, predicted: float) -> WearReading:
    """Return a reading beside what a fit says of it [%]."""
    words = f"{one.mark:.4g} %" if one.measured else f"{one.result} at {one.mark:g} %"
    kind = f"{CHAIN} {one.chain}".strip()
    words += f" of {kind}" if one.chain else ""
    return WearReading(one.line, one.hours, kind, one.low, one.high, one.error, predicted, words)


def _check_within(log: ChainLog, limit: float, excluding: Sequence[Contradiction], life: float) -> None:
    """Raise where a reading says that the limit is reached, and no other one nor all together deny it."""
    if log.rotation is not None:
        return  # a chain that is worn out waits for the others
    denied = {one.line for pair in excluding for one in (pair.earlier, pair.later)}
    faults = []
    for one in log.readings:
        beyond = one.low >= limit if not one.measured else one.low > limit
        if beyond and one.line not in denied and life <= one.hours:
            what = f"{NO_GO} at {one.low:g} %" if not one.measured else f"{one.low:.4g} %"
            text = (
                f"{what} says that the limit of stop.elongation_percent = {limit:g} is reached and no hours "
                "are left: replace the chain, or raise the limit"
            )
            faults.append(Fault(text, "value", log.file, one.line))
    if faults:
        raise CaseError(faults)


def _assumptions(log: ChainLog, band: WearBand) -> Iterator[str]:
    if log.times_relubricated:
        yield (
            "the load does not change, and the chain on the drive is relubricated every "
            f"{grouped(log.relubrications.mean_interval)} h as before, instead of by [lubrication]"
        )
    else:
        yield "load and lubrication do not change"
    yield (
        f"before any reading the coefficient is {band.low:.3g} to {band.high:.3g} times the case's (90 % of "
        "a log-normal distribution, the band of the case)"
    )
    yield "errors of the readings are normal, independent and as stated; intervals include no model error"
    yield "a gauge reading only gives the side of its mark, within its error"
    yield from _of_lengths(log)


def _of_lengths(log: ChainLog) -> Iterator[str]:
    """Say what lengths count from, and what an odd number of links may hide."""
    if log.new.measured:
        yield (
            f"elongations count from the measured length of the new chain, {log.new.longer:+.2g} % from "
            "nominal, with the error of that reading"
        )
    if log.odd_links:
        yield (
            "an odd number of links has one outer link more or fewer than inner links, and only outer "
            "links elongate by wear: such readings have an additional relative error of 1/links"
        )
    if log.time.zero:
        yield "times count from the row 'new', where the hour meter or odometer did not show 0"


def _warnings(
    case: Case, log: ChainLog, posterior: FactorPosterior, band: WearBand, lives: tuple[float, ...]
) -> Iterator[str]:
    yield from band_warning(posterior.nearest, band, JOINTS)
    if posterior.scale > 1.0:
        yield (
            f"the readings scatter about one line {posterior.scale:.2g} times as much as their errors say: "
            "check them, the load and the lubrication; their errors are enlarged by this factor"
        )
    yield from log.time.warnings(log.readings[0].hours)
    of_which = f"chain {log.mounted}: " if log.mounted else ""
    yield from (of_which + text for text in log.relubrications.warnings(case.lubrication))
    if lives[-1] <= log.today:
        yield f"{of_which}the limit is reached, by all that was read: replace the chain"
    elif lives[0] <= log.today:
        yield f"{of_which}the limit may already be reached: measure again, with a smaller error"
