"""What a case asks of the wear engine where every point of the flank is loaded once a cycle."""

import math
from dataclasses import dataclass, replace

import numpy as np

from wearsim.case.model import Case, StrandDrive
from wearsim.contact.engagement import Contact, Kind
from wearsim.contact.hertz import half_width
from wearsim.simulation.law_of_case import running_in, wear_law
from wearsim.simulation.limits import mate_criteria, tooth_criteria
from wearsim.wear.advance import run_advance
from wearsim.wear.criteria import Criterion
from wearsim.wear.duty_average import DutyPart, equivalent_factor
from wearsim.wear.law import Law
from wearsim.wear.running_in import RunningIn
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
        (*tooth_criteria(case), *mate_criteria(case, contact)),
        warp,
        warp.constant_cycles(case.run.horizon_hours * case.cycles_per_hour),
        case.run.life_tolerance / warp.amplification,
    )


def _law(case: Case) -> Law:
    law = wear_law(case.wear, case.wear.coefficient)
    if not isinstance(case.drive, StrandDrive):
        return law
    most = case.drive.heaviest
    parts = [
        DutyPart(
            block.share, block.tension / most.tension, block.speed_rpm / most.speed_rpm, block.wear_factor
        )
        for block in case.drive.blocks
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
    if not isinstance(case.drive, StrandDrive):
        return path
    # The width of the contact goes with the root of the load.
    most, blocks = case.drive.pull, case.drive.blocks
    return path * math.fsum(block.share * math.sqrt(block.tension / most) for block in blocks)
