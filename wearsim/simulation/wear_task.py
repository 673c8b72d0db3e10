"""What a case asks of the wear engine: its law, its limits, and a flank to wear."""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

import numpy as np

from wearsim.case.model import Case, WearInput, heaviest_block
from wearsim.contact.engagement import ContactKind, FlankContact
from wearsim.contact.hertz import half_width, peak_pressure
from wearsim.contact.stop_limits import StopLimit
from wearsim.geometry.profile_points import Vector
from wearsim.result import LimitState
from wearsim.simulation.lubricant import lubricant_clock
from wearsim.wear.advance import run_advance
from wearsim.wear.law import RelativeLoad, WearLaw, archard, drozdov, equivalent_factor, power
from wearsim.wear.lubricant_clock import WearClock
from wearsim.wear.running_in import NO_RUNNING_IN, RunningIn
from wearsim.wear.trajectory import Trajectory


@dataclass(frozen=True, eq=False)
class WearTask:
    """A flank to wear."""

    contact: FlankContact  # the flank and its contact
    law: WearLaw  # the wear law, for the mean over the duty
    stop_limits: tuple[StopLimit, ...]  # limits, the depth stop limit first
    clock: WearClock  # between the cycles run and those of constant coefficient
    horizon: float  # cycles of constant coefficient at which the run ends in any case
    life_tolerance: float  # relative tolerance of the life in such cycles

    def run(self) -> tuple[Trajectory, float]:
        """Wear the flank with step control."""
        run, change = run_advance(self.contact, self.law, self.stop_limits, self.horizon, self.life_tolerance)
        return self.run_in(run), change * self.clock.amplification

    def run_in(self, run: Trajectory) -> Trajectory:
        """Return a run over cycles of constant coefficient over the cycles run."""
        return replace(run, cycles=self.clock.running_cycles(run.cycles))


def wear_task(case: Case, contact: FlankContact) -> WearTask:
    """Return what a case asks of the wear engine on one flank."""
    [task] = wear_tasks(case, [contact])
    return task


def wear_tasks(case: Case, contacts: Iterable[FlankContact]) -> list[WearTask]:
    """Return what a case asks of the wear engine on each of some flanks."""
    law = _law(case)
    return [_task(case, law, contact) for contact in contacts]


def _task(case: Case, law: WearLaw, contact: FlankContact) -> WearTask:
    changes = case.wear.running_in_factor != 1.0 or case.lubrication is not None
    sliding = _sliding_per_cycle(case, contact) if changes else 0.0
    running_in = case_running_in(case.wear, sliding)
    clock = WearClock(running_in, lubricant_clock(case, sliding))
    return WearTask(
        contact,
        replace(law, running_in=running_in),
        case.drive.stop_limits(case, contact),
        clock,
        clock.steady_cycles(case.run.horizon_hours * case.cycles_per_hour),
        case.run.life_tolerance / clock.amplification,
    )


def _law(case: Case) -> WearLaw:
    law = wear_law(case.wear, case.wear.coefficient)
    blocks = case.drive.duty
    if not blocks:
        return law
    greatest = heaviest_block(blocks)
    parts = [
        RelativeLoad(
            block.share,
            block.tension / greatest.tension,
            block.speed_rpm / greatest.speed_rpm,
            block.wear_factor,
        )
        for block in blocks
    ]
    equivalent = equivalent_factor(law, ContactKind.TRAVELLING, parts)
    return replace(law, coefficient=law.coefficient * equivalent)


def _sliding_per_cycle(case: Case, contact: FlankContact) -> float:
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


def wear_law(wear: WearInput, coefficient: float) -> WearLaw:
    """Return the law of a case with a coefficient of one's own."""
    laws: dict[str, Callable[[], WearLaw]] = {
        "archard": lambda: archard(coefficient),
        "power": lambda: power(coefficient, wear.pressure_exponent),
        "drozdov": lambda: drozdov(
            coefficient, wear.pressure_exponent, wear.hardness, wear.reference_speed, wear.speed_exponent
        ),
    }
    return replace(laws[wear.law](), case_depth=wear.case_depth, core_factor=wear.core_factor)


def running_in_assumptions(running_in: RunningIn) -> tuple[str, ...]:
    """Return what running-in takes for granted."""
    if running_in.factor == 1.0:
        return ()
    return (
        f"running-in: the coefficients of teeth and joints are {running_in.factor:g} times as high at first, "
        f"the excess falls to 1/e in {running_in.cycles:.3g} cycles; joints of every new chain run in as "
        "well",
    )


def case_running_in(wear: WearInput, sliding_per_cycle: float) -> RunningIn:
    """Return how the law of a case runs in."""
    if wear.running_in_factor == 1.0 or not sliding_per_cycle > 0.0:
        return NO_RUNNING_IN
    return RunningIn(wear.running_in_factor, wear.running_in_distance / sliding_per_cycle)


def limit_states(
    stop_limits: tuple[StopLimit, ...], x: Vector, y: Vector, depth: Vector
) -> tuple[LimitState, ...]:
    """Return what the quantity of every limit has come to."""
    return tuple(
        LimitState(stop_limit.name, stop_limit.limit, stop_limit.value(x, y, depth))
        for stop_limit in stop_limits
    )


def new_flank_pressure(contact: FlankContact) -> float:
    """Return the highest pressure on a flank that has not worn, by Hertz's theory."""
    flank = contact.profile
    touch = contact.engage(flank.x.copy(), flank.y.copy(), np.zeros(flank.x.size))
    relative = np.maximum(touch.relative_curvature, 0.0)
    return float(peak_pressure(touch.load_per_width, relative, contact.modulus).max())
