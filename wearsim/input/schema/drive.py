"""The tables [drive], [mechanism] and [joint]: what runs on the sprocket, and how."""

from typing import Annotated, Literal

from pydantic import Field

from wearsim.input.schema.table import Table
from wearsim.input.units import NotNegative, Positive, PositiveNumber


class MechanismTable(Table):
    """The picture of what touches the flank."""

    kind: Literal["strand", "prescribed", "wrap"] | None = None
    table_file: str | None = None
    phases: Annotated[int, Field(ge=1, le=720)] | None = None
    roller_slip_fraction: Annotated[PositiveNumber, Field(ge=1e-6, le=1.0)] | None = None
    """Below the least what slides is lost in the rounding of the flank's points."""
    friction_roller_tooth: Annotated[NotNegative, Field(le=1.0)] | None = None
    friction_roller_bush: Annotated[NotNegative, Field(le=1.0)] | None = None


class JointTable(Table):
    """Wear of pin and bush, which makes the chain grow."""

    specific_wear_rate_mm2_per_N: Positive | None = None
    pitch: Literal["alternating", "uniform"] | None = None


class DriveTable(Table):
    """The other sprocket, the length of the chain, its slack span and how hard the drive is used."""

    mate_teeth: Annotated[int, Field(ge=5, le=1000)] | None = None
    links: Annotated[int, Field(ge=10, le=100000)] | None = None
    centre_distance_mm: Positive | None = None
    slack_tension_N: Positive | None = None
    sag_percent: Annotated[PositiveNumber, Field(le=20.0)] | None = None
    inclination_deg: Annotated[NotNegative, Field(le=90.0)] | None = None
    link_stiffness_N_per_mm: Positive | None = None
    service_factor: Annotated[PositiveNumber, Field(ge=1.0, le=10.0)] | None = None
    joint_application_factor: Annotated[PositiveNumber, Field(ge=0.5, le=10.0)] | None = None

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        pairs = (("links", "centre_distance_mm"), ("slack_tension_N", "sag_percent"))
        found = [
            (second, f"{first} gives this already: remove one of both")
            for first, second in pairs
            if getattr(self, first) is not None and getattr(self, second) is not None
        ]
        if self.slack_tension_N is not None and self.inclination_deg is not None:
            found.append(("inclination_deg", "slack_tension_N is given: remove one of both"))
        return found
