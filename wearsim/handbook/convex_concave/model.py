"""A pair of convex-concave gears from its input: contact, rack, rollers and outlines."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from wearsim.errors import ABOVE_0, AT_LEAST_0, Allowed, Range, check_ranges, check_series
from wearsim.geometry.gear.circle_fit import CircleFit, rack_arc
from wearsim.geometry.gear.convex_concave import ConvexConcave, Zone
from wearsim.geometry.gear.convex_concave_flank import ConvexConcaveFlank
from wearsim.geometry.gear.convex_concave_gear import ConvexConcaveGear, MeasuringRoller
from wearsim.geometry.gear.convex_concave_outline import gear_outline, root_radius, tip_overlap
from wearsim.geometry.gear.involute import InvolutePair
from wearsim.geometry.gear.involute_function import involute_over_pins
from wearsim.geometry.outline import Outline

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

    pair: ConvexConcave  #: the pair
    #: standard gears of the same module, teeth, addendum, and of the pressure angle in the pitch point
    involute: InvolutePair
    contacts: tuple[ZoneContact, ...]  #: pitch point, best place and end of both zones
    rack_arcs: tuple[RackArc, ...]  #: of the halves that cut the pinion's head and foot
    bodies: tuple[MeasuredGear, MeasuredGear]  #: pinion and wheel
    face_width: float  #: of the solids [mm]


@dataclass(frozen=True)
class GearBlanks:
    """What outlines and measurement need besides the flanks."""

    face_width: float | None = None  #: [mm]; ten modules if left out
    root_form: Literal["fillet", "radial"] = "fillet"
    root_clearance_ratio: float | None = None  #: over the module
    roller_diameters: Sequence[float] | None = None  #: [mm]


_PAIR: Mapping[str, Allowed] = {
    **dict.fromkeys(("module", "addendum_arc_radius", "addendum_ratio"), ABOVE_0),
    "dedendum_arc_radius": Range(above=0.0, optional=True),
    **dict.fromkeys(("pinion_teeth", "wheel_teeth"), Range(5, 400, whole=True)),
    "backlash": AT_LEAST_0,
    "pitch_point_angle": Range(above=0.0, most=math.radians(45.0)),
}
_BLANKS: Mapping[str, Allowed] = {
    "face_width": Range(above=0.0, optional=True),
    "root_form": ("fillet", "radial"),
    "root_clearance_ratio": Range(least=0.0, optional=True),
}


def pair_layout(
    *,
    module: float,
    pinion_teeth: int,
    wheel_teeth: int,
    addendum_arc_radius: float,
    dedendum_arc_radius: float | None = None,
    pitch_point_angle: float = math.radians(20.0),
    addendum_ratio: float = 1.0,
    backlash: float = 0.0,
    blanks: GearBlanks = GearBlanks(),
) -> PairLayout:
    """Return contact, rack, rollers and outlines of a pair of gears with convex-concave teeth.

    The path of contact is two circular arcs that meet in the pitch point; flanks, radii and contact
    ratio follow by convex-concave.md. J. Bosansky et al. (2012), source document 004.

    Parameters
    ----------
    module : float
        m [mm], above 0.
    pinion_teeth, wheel_teeth : int
        z1 and z2.
    addendum_arc_radius, dedendum_arc_radius : float
        Radii of both arcs of the path of contact [mm]; the second as the first if left out.
    pitch_point_angle : float, optional
        Pressure angle in the pitch point [rad].
    addendum_ratio, backlash : float, optional
        Addendum over the module, and play along the pitch circle [mm].
    blanks : GearBlanks, optional
        Face width, roots and rollers.

    Returns
    -------
    PairLayout
        Beside the involute pair of the same size.

    Raises
    ------
    GeometryError
        A number cannot be, or there are no such teeth.

    Examples
    --------
    In the pitch point both zones have the reduced radius of the involute there,
    r1 r2/(r1 + r2) sin(20 degrees) = 14.875*29.75/44.625*0.342 mm:

    >>> found = pair_layout(module=1.75, pinion_teeth=17, wheel_teeth=34, addendum_arc_radius=11.0)
    >>> round(found.contacts[0].involute_radius, 4)
    3.3917
    """
    numbers = {
        "module": module,
        "pinion_teeth": pinion_teeth,
        "wheel_teeth": wheel_teeth,
        "addendum_arc_radius": addendum_arc_radius,
        "dedendum_arc_radius": dedendum_arc_radius,
        "pitch_point_angle": pitch_point_angle,
        "addendum_ratio": addendum_ratio,
        "backlash": backlash,
    }
    check_ranges("convex-concave", numbers, _PAIR)
    check_ranges("convex-concave", vars(blanks), _BLANKS)
    if blanks.roller_diameters is not None:
        check_series("convex-concave", "roller_diameters", blanks.roller_diameters, ABOVE_0)
    second = addendum_arc_radius if dedendum_arc_radius is None else dedendum_arc_radius
    pair = ConvexConcave(
        module,
        pinion_teeth,
        wheel_teeth,
        pitch_point_angle,
        addendum_arc_radius,
        second,
        addendum_ratio * module,
        backlash,
    )
    teeth = pair.teeth
    pinion_tip, wheel_tip = (0.5 * pair.module * count + pair.addendum for count in teeth)
    involute = InvolutePair(teeth, pair.module, pair.pitch_point_angle, (0.0, 0.0), (pinion_tip, wheel_tip))
    return PairLayout(
        pair,
        involute,
        tuple(contact for zone in pair.zones for contact in _contacts(zone, involute)),
        tuple(_arc(flank, pair.pinion.foot_angle) for flank in (pair.pinion.head, pair.pinion.foot)),
        _bodies(pair, blanks),
        10.0 * pair.module if blanks.face_width is None else blanks.face_width,
    )


def _contacts(zone: Zone, involute: InvolutePair) -> list[ZoneContact]:
    """Pole, best place and end of a zone."""
    alpha = zone.angles(_ANGLES)
    best = alpha[zone.reduced_radius(alpha).argmax()]
    places = {"pitch_point": alpha[0], "best": best, "end": zone.end}
    return [
        ZoneContact(zone, place, float(at), involute_radius(zone, float(at), involute))
        for place, at in places.items()
    ]


def involute_radius(zone: Zone, alpha: float, involute: InvolutePair) -> float:
    """Return the reduced radius of the involute pair as far from the pitch point as a contact."""
    path = float(zone.pinion.path_coordinate(alpha))
    if not -involute.approach <= path <= involute.recess:
        return math.nan
    return float(involute.reduced_radius(np.array(involute.pitch_point + path)))


def _arc(flank: ConvexConcaveFlank, end: float) -> RackArc:
    """Arc for the rack's flank, whose depth is the addendum of the gears."""
    fit = rack_arc(flank, end)
    points = flank.rack_points(np.linspace(flank.pitch_point_angle, end, _ANGLES))
    return RackArc(flank, fit, float(np.abs(fit.distances(points)).max()))


def _bodies(pair: ConvexConcave, body: GearBlanks) -> tuple[MeasuredGear, MeasuredGear]:
    gears = pair.pinion, pair.wheel
    ratio, form = body.root_clearance_ratio, body.root_form
    clearance = None if ratio is None else ratio * pair.module
    outlines = [gear_outline(gear, clearance, form) for gear in gears]
    polygons = [outline.polygon(OUTLINE_TOLERANCE) for outline in outlines]
    overlaps = tip_overlap(pair, *polygons)
    diameters = body.roller_diameters or [_USUAL_ROLLER * pair.module]
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
    measured = gear.over_rollers(diameter)
    over = involute_over_pins(gear.module, gear.teeth, gear.pitch_point_angle, diameter, gear.thinning)
    return OverRollers(measured, over)
