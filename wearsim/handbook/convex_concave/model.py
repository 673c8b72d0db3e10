"""A pair of convex-concave gears from its input: contact, rack, rollers and outlines."""

import math
from dataclasses import dataclass

import numpy as np

from wearsim.geometry.gear.circle_fit import CircleFit, rack_arc
from wearsim.geometry.gear.convex_concave import ConvexConcave, Zone
from wearsim.geometry.gear.convex_concave_flank import ConvexConcaveFlank
from wearsim.geometry.gear.convex_concave_gear import ConvexConcaveGear, MeasuringRoller
from wearsim.geometry.gear.convex_concave_outline import gear_outline, root_radius, tip_overlap
from wearsim.geometry.gear.involute import InvolutePair
from wearsim.geometry.gear.involute_function import involute_over_pins
from wearsim.geometry.outline import Outline
from wearsim.handbook.convex_concave.keys import ConvexConcaveTables, GearsTable

OUTLINE_TOLERANCE = 1e-4
"""Of the polygons that stand for the outlines [mm]."""

_ANGLES = 401
_USUAL_ROLLER = 1.728
"""Diameter over the module of the roller that rests near the pitch circle of an involute gear."""


@dataclass(frozen=True)
class ZoneContact:
    """A place of contact."""

    zone: Zone  # where on the path of contact
    place: str  # `pitch_point`, `best` (greatest reduced radius of the zone) or `end`
    alpha: float  # pressure angle [rad]
    # reduced radius of the involute pair at the same distance from the pitch point [mm]; nan where that is
    # out of contact
    involute_radius: float


@dataclass(frozen=True)
class RackArc:
    """The arc in place of one half of the rack's flank."""

    flank: ConvexConcaveFlank  # flank of the pinion that this half cuts
    fit: CircleFit  # the arc, in coordinates from the pitch point
    deviation: float  # greatest distance of the flank from it [mm]


@dataclass(frozen=True)
class OverRollers:
    """A roller in the gaps of a gear."""

    roller: MeasuringRoller  # where it rests and what it measures
    involute_over: float  # measurement on the involute gear of the same size [mm]; nan where it rests on none


@dataclass(frozen=True, eq=False)
class MeasuredGear:
    """What a gear comes to."""

    name: str  # `pinion` or `wheel`
    gear: ConvexConcaveGear  # its teeth
    root: float  # radius of the root circle [mm]
    outline: Outline  # all of it
    measured: tuple[OverRollers, ...]  # by roller
    overlap: float  # how deep the mate's tips enter it [mm]; up to the tolerance of the outlines nothing


@dataclass(frozen=True, eq=False)
class PairLayout:
    """A pair with everything that the command shows."""

    pair: ConvexConcave  # the pair
    # standard gears of the same module, teeth, addendum, and of the pressure angle in the pitch point
    involute: InvolutePair
    contacts: tuple[ZoneContact, ...]  # pole, best place and end of both zones
    rack_arcs: tuple[RackArc, ...]  # of the halves that cut the pinion's head and foot
    bodies: tuple[MeasuredGear, MeasuredGear]  # pinion and wheel
    face_width: float  # of the solids [mm]


def convex_concave(tables: ConvexConcaveTables) -> PairLayout:
    """Lay out a pair of gears.

    Parameters
    ----------
    tables : ConvexConcaveTables
        The input.

    Returns
    -------
    Layout
        The pair with what follows from it.

    Raises
    ------
    GeometryError
        The teeth cannot be, or a roller does not rest on them.
    """
    given, body = tables.convex_concave, tables.gears
    foot_arc = given.dedendum_arc_radius_mm
    pair = ConvexConcave(
        given.module_mm,
        given.pinion_teeth,
        given.wheel_teeth,
        math.radians(given.pitch_point_angle_deg),
        given.addendum_arc_radius_mm,
        given.addendum_arc_radius_mm if foot_arc is None else foot_arc,
        given.addendum_ratio * given.module_mm,
        given.backlash_mm,
    )
    teeth = pair.teeth
    pinion_tip, wheel_tip = (0.5 * pair.module * count + pair.addendum for count in teeth)
    involute = InvolutePair(teeth, pair.module, pair.pitch_point_angle, (0.0, 0.0), (pinion_tip, wheel_tip))
    width = body.face_width_mm
    return PairLayout(
        pair,
        involute,
        tuple(contact for zone in pair.zones for contact in _contacts(zone, involute)),
        tuple(_arc(flank, pair.pinion.foot_angle) for flank in (pair.pinion.head, pair.pinion.foot)),
        _bodies(pair, body),
        10.0 * pair.module if width is None else width,
    )


def _contacts(zone: Zone, involute: InvolutePair) -> list[ZoneContact]:
    """Pole, best place and end of a zone."""
    alpha = zone.angles(_ANGLES)
    best = alpha[zone.reduced_radius(alpha).argmax()]
    places = {"pole": alpha[0], "best": best, "end": zone.end}
    return [
        ZoneContact(zone, place, float(at), involute_radius(zone, float(at), involute))
        for place, at in places.items()
    ]


def involute_radius(zone: Zone, alpha: float, involute: InvolutePair) -> float:
    """Return the reduced radius of the involute pair as far from the pitch point as a contact.

    Parameters
    ----------
    zone : Zone
        Where on the path of contact.
    alpha : float
        Pressure angle [rad].
    involute : InvolutePair
        The pair.

    Returns
    -------
    float
        Radius [mm]; nan beyond its path of contact.
    """
    path = float(zone.pinion.path_coordinate(alpha))
    if not -involute.approach <= path <= involute.recess:
        return math.nan
    return float(involute.reduced_radius(np.array(involute.pitch_point + path)))


def _arc(flank: ConvexConcaveFlank, end: float) -> RackArc:
    """Arc for the rack's flank, whose depth is the addendum of the gears."""
    fit = rack_arc(flank, end)
    points = flank.rack_points(np.linspace(flank.pitch_point_angle, end, _ANGLES))
    return RackArc(flank, fit, float(np.abs(fit.distances(points)).max()))


def _bodies(pair: ConvexConcave, body: GearsTable) -> tuple[MeasuredGear, MeasuredGear]:
    gears = pair.pinion, pair.wheel
    ratio, form = body.root_clearance_ratio, body.root_form
    clearance = None if ratio is None else ratio * pair.module
    outlines = [gear_outline(gear, clearance, form) for gear in gears]
    polygons = [outline.polygon(OUTLINE_TOLERANCE) for outline in outlines]
    overlaps = tip_overlap(pair, *polygons)
    diameters = body.roller_diameters_mm or [_USUAL_ROLLER * pair.module]
    pinion, wheel = (
        MeasuredGear(
            name,
            gear,
            root_radius(gear, clearance, form),
            outline,
            tuple(_measured(gear, diameter) for diameter in diameters),
            overlap,
        )
        for name, gear, outline, overlap in zip(("pinion", "wheel"), gears, outlines, overlaps, strict=True)
    )
    return pinion, wheel


def _measured(gear: ConvexConcaveGear, diameter: float) -> OverRollers:
    over = involute_over_pins(gear.module, gear.teeth, gear.pitch_point_angle, diameter, gear.thinning)
    return OverRollers(gear.over_rollers(diameter), over)
