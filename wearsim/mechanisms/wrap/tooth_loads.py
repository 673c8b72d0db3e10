"""What the teeth of a wrapped sprocket carry."""

from dataclasses import dataclass

import numpy as np

from wearsim.case.model import Case
from wearsim.mechanisms.wrap.drive import wrap_drive
from wearsim.mechanisms.wrap.wrap_mechanism import WrapLoads


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


_LOADS_OF_A_FLANK = "the loads of this flank are in flank.csv of wearsim life --out"


def tooth_loads(case: Case, elongation: float = 0.0, phase: float | None = 1.0) -> ToothLoads:
    """Return what the teeth of a sprocket carry that a chain wraps."""
    drive = wrap_drive(case, "'loads' needs a chain that wraps the sprocket", others=_LOADS_OF_A_FLANK)
    mechanism = drive.rollers
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
