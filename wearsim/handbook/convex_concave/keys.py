"""The input of ``wearsim handbook convex-concave``: a pair of gears with convex-concave teeth."""

import math
from typing import Annotated, Literal

from pydantic import Field

from wearsim.handbook.convex_concave.model import GearBlanks, PairLayout, pair_layout
from wearsim.input.table import CalculationTables, Table
from wearsim.input.units import NotNegative, Number, Positive, PositiveNumber

Teeth = Annotated[int, Field(ge=5, le=400)]


class ConvexConcaveTable(Table):
    """The pair."""

    module_mm: Positive
    pinion_teeth: Teeth
    wheel_teeth: Teeth
    pitch_point_angle_deg: Annotated[Positive, Field(lt=45.0)] = 20.0
    addendum_arc_radius_mm: Positive
    dedendum_arc_radius_mm: Positive | None = None
    addendum_ratio: PositiveNumber = 1.0
    backlash_mm: NotNegative = 0.0


class GearsTable(Table):
    """Data that outlines and measurement need in addition to the flanks."""

    face_width_mm: Positive | None = None
    root_form: Literal["fillet", "radial"] = "fillet"
    root_clearance_ratio: Annotated[Number, Field(ge=0.0)] | None = None
    roller_diameters_mm: Annotated[list[Positive], Field(min_length=1)] | None = None


class ConvexConcaveTables(CalculationTables):
    """The whole file."""

    convex_concave: ConvexConcaveTable
    gears: GearsTable = GearsTable()

    def layout(self) -> PairLayout:
        """Return the pair as it is laid out."""
        given = self.convex_concave
        return pair_layout(
            module=given.module_mm,
            pinion_teeth=given.pinion_teeth,
            wheel_teeth=given.wheel_teeth,
            addendum_arc_radius=given.addendum_arc_radius_mm,
            dedendum_arc_radius=given.dedendum_arc_radius_mm,
            pitch_point_angle=math.radians(given.pitch_point_angle_deg),
            addendum_ratio=given.addendum_ratio,
            backlash=given.backlash_mm,
            blanks=self.gears.plain(GearBlanks, roller_diameters=self.gears.roller_diameters_mm),
        )
