"""What a case asks of the wear engine: its law, its limits, and a flank to wear."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from wearsim.case.model import Case, WearInput, heaviest
from wearsim.contact.criteria import Criterion
from wearsim.contact.engagement import Contact, Kind
from wearsim.contact.hertz import half_width, peak_pressure
from wearsim.geometry.profile import Vector
from wearsim.result import LimitState
from wearsim.wear.advance import run_advance
from wearsim.wear.law import DutyPart, Law, archard, drozdov, equivalent_factor, power
from wearsim.wear.running_in import CONSTANT, RunningIn
from wearsim.wear.trajectory import Trajectory


@dataclass(frozen=True, eq=False)
class Task:
    """A flank to wear."""

    contact: Contact  # the flank and its contact
    law: Law  # the wear law, for the mean over the duty
    criteria: tuple[Criterion, ...]  # limits, the depth criterion first
    running_in: RunningIn  # between the cycles run and those of constant coefficient
    horizon: float  # cycles of constant coefficient at which the run ends in any case
    life_tolerance: float  # relative tolerance of the life in such cycles

    def run(self) -> tuple[Trajectory, float]:
        """Wear the flank with step control."""
        run, change = run_advance(self.contact, self.law, self.criteria, self.horizon, self.life_tolerance)
        return self.run_in(run), change * self.running_in.amplification

    def run_in(self, run: Trajectory) -> Trajectory:
        """Return a run over cycles of constant coefficient over the cycles run."""
        return replace(run, cycles=self.running_in.running_cycles(run.cycles))


def task(case: Case, contact: Contact) -> Task:
    """Return what a case asks of the wear engine."""
    runs_in = case.wear.running_in_factor != 1.0
    warp = running_in(case.wear, _sliding_per_cycle(case, contact) if runs_in else 0.0)
    return Task(
        contact,
        replace(_law(case), running_in=warp),
        case.drive.stop_limits(case, contact),
        warp,
        warp.constant_cycles(case.run.horizon_hours * case.cycles_per_hour),
        case.run.life_tolerance / warp.amplification,
    )


def _law(case: Case) -> Law:
    law = wear_law(case.wear, case.wear.coefficient)
    blocks = case.drive.duty
    if not blocks:
        return law
    most = heaviest(blocks)
    parts = [
        DutyPart(
            block.share, block.tension / most.tension, block.speed_rpm / most.speed_rpm, block.wear_factor
        )
        for block in blocks
    ]
    equivalent = equivalent_factor(law, Kind.TRAVELLING, parts)
    return replace(law, coefficient=law.coefficient * equivalent)


def _sliding_per_cycle(case: Case, contact: Contact) -> float:
    """Mean path that the loaded stretch of the new flank slides in a cycle of the duty [mm]."""
    profile = contact.profile
    touch = contact.engage(profile.x.copy(), profile.y.copy(), np.zeros(profile.x.size))
    loaded = touch.load_per_width > 0.0
    if not loaded.any():
        return 0.0
    slip, stretch = touch.slip[loaded], np.gradient(contact.arc_length)[loaded]
    if contact.kind is Kind.TRAVELLING:
        load, relative = touch.load_per_width[loaded], touch.relative_curvature[loaded]
        slip = slip * 2.0 * half_width(load, np.maximum(relative, 1e-9), contact.modulus)
    path = float(np.average(slip, weights=stretch))
    blocks = case.drive.duty
    if not blocks:
        return path
    # The width of the contact goes with the root of the load.
    most = heaviest(blocks).tension
    return path * math.fsum(block.share * math.sqrt(block.tension / most) for block in blocks)


def wear_law(wear: WearInput, coefficient: float) -> Law:
    """Return the law of a case with a coefficient of one's own."""
    laws: dict[str, Callable[[], Law]] = {
        "archard": lambda: archard(coefficient),
        "power": lambda: power(coefficient, wear.pressure_exponent),
        "drozdov": lambda: drozdov(
            coefficient, wear.pressure_exponent, wear.hardness, wear.reference_speed, wear.speed_exponent
        ),
    }
    return replace(laws[wear.law](), case_depth=wear.case_depth, core_factor=wear.core_factor)


def running_in_assumptions(warp: RunningIn) -> tuple[str, ...]:
    """Return what running-in takes for granted."""
    if warp.factor == 1.0:
        return ()
    return (
        f"running-in: the coefficients of teeth and joints are {warp.factor:g} times as high at first, "
        f"the excess falls to 1/e in {warp.cycles:.3g} cycles; joints of every new chain run in as well",
    )


def running_in(wear: WearInput, sliding_per_cycle: float) -> RunningIn:
    """Return how the law of a case runs in."""
    if wear.running_in_factor == 1.0 or not sliding_per_cycle > 0.0:
        return CONSTANT
    return RunningIn(wear.running_in_factor, wear.running_in_distance / sliding_per_cycle)


def limit_states(
    criteria: tuple[Criterion, ...], x: Vector, y: Vector, depth: Vector
) -> tuple[LimitState, ...]:
    """Return what the quantity of every limit has come to."""
    return tuple(
        LimitState(criterion.name, criterion.limit, criterion.value(x, y, depth)) for criterion in criteria
    )


def new_flank_pressure(contact: Contact) -> float:
    """Return the highest pressure on a flank that has not worn, by Hertz's theory."""
    flank = contact.profile
    touch = contact.engage(flank.x.copy(), flank.y.copy(), np.zeros(flank.x.size))
    relative = np.maximum(touch.relative_curvature, 0.0)
    return float(peak_pressure(touch.load_per_width, relative, contact.modulus).max())
