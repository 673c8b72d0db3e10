"""What a case asks of the wear engine: its law, its limits, and a flank to wear."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import partial
from typing import TypeVar

import numpy as np

from wearsim.case.model import Case, WearInput, heaviest_block
from wearsim.catalogue.own_wear_laws import own_wear_laws
from wearsim.contact.engagement import ContactKind, FlankContact
from wearsim.contact.hertz import peak_pressure
from wearsim.contact.stop_limits import StopLimit
from wearsim.drive.lubricant import sliding_per_cycle
from wearsim.errors import CaseError, Fault
from wearsim.geometry.profile_points import Vector
from wearsim.kernels.severity import FIRST, SECOND
from wearsim.lubrication.clock import clock_ends, lubricant_clock
from wearsim.result import LimitState
from wearsim.wear.advance import run_advance
from wearsim.wear.law import (
    LAWS,
    RelativeLoad,
    WearLaw,
    archard,
    equivalent_factor,
    mean_pressure_factor,
    with_pressure_speed_limit,
)
from wearsim.wear.mate_clock import LubricatedClock
from wearsim.wear.problem import AnyContact, WearProblem
from wearsim.wear.running_in import NO_RUNNING_IN, CyclesPower, RunningIn, WearClock
from wearsim.wear.severe_wear import on_level_branch, t_gamma_energy
from wearsim.wear.trajectory import Trajectory

AnyRun = TypeVar("AnyRun", bound=Trajectory)


@dataclass(frozen=True, eq=False, kw_only=True)
class WearTask(WearProblem[AnyContact]):
    """What a case asks of the wear engine: a problem, over the cycles that the case runs."""

    clock: LubricatedClock  # between the cycles run and those of constant coefficient
    life_tolerance: float  # relative tolerance of the life in such cycles

    def run(self) -> tuple[Trajectory, float]:
        """Wear the bodies with step control."""
        run, change = run_advance(self, self.life_tolerance)
        return self.run_in(run), change * self.clock.amplification

    def run_in(self, run: AnyRun) -> AnyRun:
        """Return a run over cycles of constant coefficient over the cycles run."""
        return replace(run, cycles=self.clock.running_cycles(run.cycles))


def wear_task(case: Case, contact: FlankContact) -> WearTask[FlankContact]:
    """Return what a case asks of the wear engine on one flank."""
    [task] = wear_tasks(case, [contact])
    return task


def wear_tasks(case: Case, contacts: Iterable[FlankContact]) -> list[WearTask[FlankContact]]:
    """Return what a case asks of the wear engine on each of some flanks."""
    law = _law(case)
    return [_task(case, law, contact) for contact in contacts]


def _task(case: Case, law: WearLaw, contact: FlankContact) -> WearTask[FlankContact]:
    if case.wear.law == "t_gamma":
        _check_t_gamma(case, contact)
    worn_by = contact
    if case.wear.is_own:
        law, worn_by = _own_law(case, law, contact)
    changes = case.wear.running_in_factor != 1.0 or case.lubrication is not None
    sliding = sliding_per_cycle(case, contact) if changes else 0.0
    clock = contact_clock(case, sliding, sliding)
    law = replace(law, running_in=clock.part)
    return task_of(case, worn_by, law, case.drive.stop_limits(case, contact), clock)


def _own_law(case: Case, law: WearLaw, contact: FlankContact) -> tuple[WearLaw, FlankContact]:
    """Return the law of a program in the place of one with its coefficient, and the contact it wears by."""
    from wearsim.wear.own_law import DepthFunction, own_law

    depth = DepthFunction(own_wear_laws()[case.wear.law], dict(case.wear.constants), case.name)
    if case.run.method != "advance":
        text = f"must be 'advance' with a user-defined wear law (got {case.run.method!r})"
        raise CaseError([Fault(text, "run.method", case.name)])
    if "gear" in case.inputs and depth.depends_on_slip(contact.new_engagement(), contact.modulus):
        raise depth.fault("must not depend on the slip on gears, as the slip of the two flanks differs")
    made, worn_by = own_law(depth, contact, law.coefficient)
    same = {name: getattr(law, name) for name in ("case_depth", "core_factor", "severity")}
    return replace(made, **same), worn_by


def task_of(
    case: Case, contact: AnyContact, law: WearLaw, stop_limits: tuple[StopLimit, ...], clock: LubricatedClock
) -> WearTask[AnyContact]:
    """Return the task of a case with its horizon and its tolerance, in cycles of constant coefficient."""
    return WearTask(
        contact,
        law,
        stop_limits,
        clock.steady_cycles(case.run.horizon_hours * case.cycles_per_hour),
        clock=clock,
        life_tolerance=case.run.life_tolerance / clock.amplification,
    )


def _check_t_gamma(case: Case, contact: FlankContact) -> None:
    """Raise where the law by T-gamma does not tell how the shape of the new flank goes on."""
    touch = contact.new_engagement()
    pressure = peak_pressure(touch.load_per_width, np.maximum(touch.relative_curvature, 0.0), contact.modulus)
    energy = t_gamma_energy(
        mean_pressure_factor(1.0) * pressure, touch.slip, case.wear.constants["friction_coefficient"]
    )
    if on_level_branch(energy[touch.load_per_width > 0.0]):
        message = (
            f"T-gamma over the contact area must lie below {FIRST:g} or above {SECOND:g} N/mm2 all along "
            f"the new flank, but is {energy.min():.3g} to {energy.max():.3g}: in between the rate does not "
            "rise with the pressure, a pit deepens itself and the problem is ill-posed; use another law or "
            "load"
        )
        raise CaseError([Fault(message, "wear.law", case.name)])


def _law(case: Case) -> WearLaw:
    law = wear_law(case.wear, case.wear.coefficient)
    blocks = case.drive.duty
    if not blocks:
        return law
    heaviest = heaviest_block(blocks)
    parts = [
        RelativeLoad(
            block.share,
            block.tension / heaviest.tension,
            block.speed_rpm / heaviest.speed_rpm,
            block.wear_factor,
        )
        for block in blocks
    ]
    equivalent = equivalent_factor(law, ContactKind.TRAVELLING, parts)
    return replace(law, coefficient=law.coefficient * equivalent)


def wear_law(wear: WearInput, coefficient: float) -> WearLaw:
    """Return the law of a case with a coefficient of one's own."""
    law = archard(coefficient) if wear.is_own else LAWS[wear.law](coefficient, *wear.constants.values())
    law = with_pressure_speed_limit(law, wear.pv_limit, wear.severe_factor)
    return replace(law, case_depth=wear.case_depth, core_factor=wear.core_factor)


def clock_assumptions(clock: WearClock) -> tuple[str, ...]:
    """Return what a coefficient that changes with the cycles takes for granted."""
    return () if clock.is_steady else (clock.assumption(),)


def contact_clock(case: Case, sliding: float, of_lubricant: float) -> LubricatedClock:
    """Return the clock of contacts, from what they and those of the lubricant slide in a cycle [mm]."""
    given = case.lubrication, case.cycles_per_hour, of_lubricant
    return LubricatedClock(_part_clock(case, sliding), lubricant_clock(*given), partial(clock_ends, *given))


def _part_clock(case: Case, sliding_per_cycle: float) -> WearClock:
    """Return how the coefficient of a new part changes with the cycles."""
    wear = case.wear
    if wear.cycles_exponent != 1.0:
        return CyclesPower(wear.cycles_exponent, wear.reference_hours * case.cycles_per_hour)
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
    touch = contact.new_engagement()
    relative = np.maximum(touch.relative_curvature, 0.0)
    return float(peak_pressure(touch.load_per_width, relative, contact.modulus).max())
