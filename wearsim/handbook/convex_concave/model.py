"""A pair of convex-concave gears from its input: contact, rack, rollers and outlines."""

import math
from dataclasses import dataclass

import numpy as np

from wearsim.geometry.gear.circle_fit import CircleFit, rack_arc
from wearsim.geometry.gear.convex_concave import ConvexConcave, Zone
from wearsim.geometry.gear.convex_concave_flank import Flank
from wearsim.geometry.gear.convex_concave_gear import ConvexConcaveGear, Roller
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
class Contact:
    """A place of contact.

    Attributes
    ----------
    zone : Zone
        Where on the line of action.
    place : str
        ``pole``, ``best`` (greatest reduced radius of the zone) or ``end``.
    alpha : float
        Pressure angle [rad].
    involute_radius : float
        Reduced radius of the involute pair at the same distance from the pole [mm]; nan
        where that is out of contact.
    """

    zone: Zone
    place: str
    alpha: float
    involute_radius: float


@dataclass(frozen=True)
class RackArc:
    """The arc in place of one half of the rack's flank.

    Attributes
    ----------
    flank : Flank
        Flank of the pinion that this half cuts.
    fit : CircleFit
        The arc, in coordinates from the pole.
    deviation : float
        Greatest distance of the flank from it [mm].
    """

    flank: Flank
    fit: CircleFit
    deviation: float


@dataclass(frozen=True)
class Measured:
    """A roller in the gaps of a gear.

    Attributes
    ----------
    roller : Roller
        Where it rests and what it measures.
    involute_over : float
        Measurement on the involute gear of the same size [mm]; nan where it rests on none.
    """

    roller: Roller
    involute_over: float


@dataclass(frozen=True, eq=False)
class Body:
    """What a gear comes to.

    Attributes
    ----------
    name : str
        ``pinion`` or ``wheel``.
    gear : ConvexConcaveGear
        Its teeth.
    root : float
        Radius of the root circle [mm].
    outline : Outline
        All of it.
    measured : tuple of Measured
        By roller.
    overlap : float
        How deep the mate's tips enter it [mm]; up to the tolerance of the outlines nothing.
    """

    name: str
    gear: ConvexConcaveGear
    root: float
    outline: Outline
    measured: tuple[Measured, ...]
    overlap: float


@dataclass(frozen=True, eq=False)
class Layout:
    """A pair with everything that the command shows.

    Attributes
    ----------
    pair : ConvexConcave
        The pair.
    involute : InvolutePair
        Standard gears of the same module, teeth, addendum, and of the pressure angle in the pole.
    contacts : tuple of Contact
        Pole, best place and end of both zones.
    rack_arcs : tuple of RackArc
        Of the halves that cut the pinion's head and foot.
    bodies : tuple of Body
        Pinion and wheel.
    face_width : float
        Of the solids [mm].
    """

    pair: ConvexConcave
    involute: InvolutePair
    contacts: tuple[Contact, ...]
    rack_arcs: tuple[RackArc, ...]
    bodies: tuple[Body, Body]
    face_width: float


def convex_concave(tables: ConvexConcaveTables) -> Layout:
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
    involute = InvolutePair(teeth, pair.module, pair.pole_angle, (0.0, 0.0), (pinion_tip, wheel_tip))
    width = body.face_width_mm
    return Layout(
        pair,
        involute,
        tuple(contact for zone in pair.zones for contact in _contacts(zone, involute)),
        tuple(_arc(flank, pair.pinion.foot_angle) for flank in (pair.pinion.head, pair.pinion.foot)),
        _bodies(pair, body),
        10.0 * pair.module if width is None else width,
    )


def _contacts(zone: Zone, involute: InvolutePair) -> list[Contact]:
    """Pole, best place and end of a zone."""
    alpha = zone.angles(_ANGLES)
    best = alpha[zone.reduced_radius(alpha).argmax()]
    places = {"pole": alpha[0], "best": best, "end": zone.end}
    return [
        Contact(zone, place, float(at), involute_radius(zone, float(at), involute))
        for place, at in places.items()
    ]


def involute_radius(zone: Zone, alpha: float, involute: InvolutePair) -> float:
    """Return the reduced radius of the involute pair as far from the pole as a contact.

    Parameters
    ----------
    zone : Zone
        Where on the line of action.
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
    return float(involute.reduced_radius(np.array(involute.pole + path)))


def _arc(flank: Flank, end: float) -> RackArc:
    """Arc for the rack's flank, whose depth is the addendum of the gears."""
    fit = rack_arc(flank, end)
    points = flank.rack_points(np.linspace(flank.pole_angle, end, _ANGLES))
    return RackArc(flank, fit, float(np.abs(fit.distances(points)).max()))


def _bodies(pair: ConvexConcave, body: GearsTable) -> tuple[Body, Body]:
    gears = pair.pinion, pair.wheel
    ratio, form = body.root_clearance_ratio, body.root_form
    clearance = None if ratio is None else ratio * pair.module
    outlines = [gear_outline(gear, clearance, form) for gear in gears]
    polygons = [outline.polygon(OUTLINE_TOLERANCE) for outline in outlines]
    overlaps = tip_overlap(pair, *polygons)
    diameters = body.roller_diameters_mm or [_USUAL_ROLLER * pair.module]
    pinion, wheel = (
        Body(
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


def _measured(gear: ConvexConcaveGear, diameter: float) -> Measured:
    over = involute_over_pins(gear.module, gear.teeth, gear.pole_angle, diameter, gear.thinning)
    return Measured(gear.over_rollers(diameter), over)
