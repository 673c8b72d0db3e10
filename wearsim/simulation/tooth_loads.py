"""What the teeth of a wrapped sprocket carry."""

import math
from dataclasses import dataclass

import numpy as np

from wearsim.case.model import Case, WrapDrive
from wearsim.errors import CaseError, Fault
from wearsim.mechanisms.wrap.equilibrium import WrapLoads, WrapMechanism
from wearsim.simulation.wrap_mechanism import wrap_mechanism


@dataclass(frozen=True, eq=False)
class ToothLoads:
    """What the teeth of a case's wrap carry in one phase."""

    case: str  # of the case
    title: str  # of the case
    phase: float  # phase of the pitch, relative elongation of the chain
    elongation: float  # phase of the pitch, relative elongation of the chain
    first_link: str  # `inner`, `outer` or, where all links are alike, `any`: the link after tooth 1
    loads: WrapLoads  # one entry a tooth
    wrap_degrees: float  # wrap angle [deg]
    face_width: float  # b [mm]
    slack: float  # tension of the slack strand, and what the chain's speed adds to all [N]
    centrifugal: float  # tension of the slack strand, and what the chain's speed adds to all [N]
    smallest_slack: float  # slack tension below which the chain jumps [N]
    assumptions: tuple[str, ...]  # of the case
    warnings: tuple[str, ...]  # of the case


def tooth_loads(case: Case, elongation: float = 0.0, phase: float | None = 1.0) -> ToothLoads:
    """Return what the teeth of a sprocket carry that a chain wraps."""
    drive = case.drive
    if not isinstance(drive, WrapDrive):
        message = "'loads' needs a chain that wraps the sprocket: set kind = 'wrap'"
        raise CaseError([Fault(message, "mechanism.kind", case.name)])
    mechanism = wrap_mechanism(case, drive)
    firsts = (0, 1) if drive.joint.alternating and elongation > 0.0 and phase is None else (0,)
    phases = [phase] if phase is not None else list(np.linspace(0.0, 1.0, drive.phases + 1))
    found = [(mechanism.loads(part, elongation, first), part, first) for part in phases for first in firsts]
    loads, part, first = max(found, key=lambda entry: (float(entry[0].force.max()), entry[1]))
    return ToothLoads(
        case=case.name,
        title=case.title,
        phase=part,
        elongation=elongation,
        first_link=("inner", "outer")[first] if drive.joint.alternating else "any",
        loads=loads,
        wrap_degrees=float(np.degrees(drive.wrap_angle)),
        face_width=drive.face_width,
        slack=drive.slack,
        centrifugal=drive.heaviest.centrifugal,
        smallest_slack=mechanism.smallest_slack_tension(elongation),
        assumptions=(*mechanism.assumptions(), *case.assumptions),
        warnings=case.warnings,
    )


def check_hold(case: Case) -> None:
    """Raise where the chain of a case jumps on new teeth, at no or at its limit of elongation."""
    drive = case.drive
    if not isinstance(drive, WrapDrive):
        return
    mechanism = wrap_mechanism(case, drive)
    if not all(mechanism.holds(elongation) for elongation in (0.0, drive.joint.elongation_limit)):
        raise CaseError([Fault(_jumping(drive, mechanism), "drive.slack_tension_N", case.name)])
    least = case.more_limits.get("min_slack_tension_N")
    if least is not None and not mechanism.with_slack(least).holds(0.0):
        needed = 1.005 * mechanism.smallest_slack_tension(0.0)  # rounded up
        message = f"must be above what a new drive needs not to jump, {needed:.3g} N (got {least:g})"
        raise CaseError([Fault(message, "stop.min_slack_tension_N", case.name)])


def _jumping(drive: WrapDrive, mechanism: WrapMechanism) -> str:
    """Say which slack tension holds the chain, new and stretched."""
    limit = drive.joint.elongation_limit
    least = max(mechanism.smallest_slack_tension(elongation) for elongation in (0.0, limit))
    remedy = (
        f"give a slack tension of at least {1.005 * least:.3g} N"
        if least < math.inf
        else "no slack tension holds it: use more teeth or a lower elongation_percent"
    )
    return (
        f"the rollers must hold the chain, new and stretched by {100 * limit:.3g} %, but with a slack "
        f"tension of {drive.slack:.4g} N the chain jumps: {remedy}"
    )
