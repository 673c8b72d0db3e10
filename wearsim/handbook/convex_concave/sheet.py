"""A pair of convex-concave gears: text, tables and files."""

import math
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from wearsim.cad.dxf_writer import write_dxf
from wearsim.cad.stl import prism, write_stl
from wearsim.geometry.gear.convex_concave import SignCondition
from wearsim.geometry.gear.convex_concave_flank import ConvexConcaveFlank
from wearsim.geometry.outline import rotated
from wearsim.geometry.profile_points import Vector
from wearsim.handbook.convex_concave.figure import convex_concave_figure
from wearsim.handbook.convex_concave.model import (
    OUTLINE_TOLERANCE,
    MeasuredGear,
    PairLayout,
    RackArc,
    ZoneContact,
)
from wearsim.report.answer_table import plain
from wearsim.report.calculation_sheet import CalculationSheet
from wearsim.report.text_lines import Finding, answer_text

_POINTS = 101

_PARTS = {"head": "addendum", "foot": "dedendum"}
"""Words of the answer for the parts of a flank."""

_ASSUMPTIONS = (
    "the line of action has two arcs, after Bosansky (2015); its eq. (1) has a wrong sign in y, so the "
    "flank here follows its listing",
    "curvatures follow Euler and Savary; the source gives only their signs",
    "addendum, root and backlash are not in the source; backlash turns the flanks about the axis here, "
    "while its listing shifts them along x, which is right only for a rack",
    "the involute pair has the same module, teeth, addendum and centre distance, and the pressure angle "
    "at the pitch point; its path ends at the base circles where these come before the tips",
)


def convex_concave_sheet(title: str, layout: PairLayout) -> CalculationSheet:
    """Return what ``wearsim handbook convex-concave`` shows."""
    pair = layout.pair
    rollers = [one for body in layout.bodies for one in _rollers(body)]
    content = {
        "title": title,
        "centre_distance_mm": pair.centre_distance,
        "contact_ratio": pair.contact_ratio,
        "recess_ratio": pair.recess_ratio,
        "approach_ratio": pair.approach_ratio,
        "involute_contact_ratio": layout.involute.contact_ratio,
        "gears": [_gear(body) for body in layout.bodies],
        "contacts": [_contact(one) for one in layout.contacts],
        "sign_conditions": [_condition(one) for one in pair.sign_conditions],
        "rack_arcs": [_rack_arc(one) for one in layout.rack_arcs],
        "rollers": rollers,
        "assumptions": list(_ASSUMPTIONS),
    }
    return CalculationSheet(
        text=_text(title, layout),
        content=content,
        tables=lambda: {
            "flanks": pd.concat([_flank_table(layout, body) for body in layout.bodies]),
            "rack": _rack_table(layout),
            "rollers": pd.DataFrame(rollers),
        },
        figures=lambda: {"convex_concave": convex_concave_figure(title, layout)},
        warnings=tuple(_warnings(layout)),
        files={
            **{f"{one.name}.dxf": partial(write_dxf, one.outline) for one in layout.bodies},
            **{f"{one.name}.stl": partial(_write_solid, layout, one) for one in layout.bodies},
        },
    )


def _write_solid(layout: PairLayout, body: MeasuredGear, path: Path) -> None:
    write_stl(prism(body.outline.polygon(OUTLINE_TOLERANCE), layout.face_width), path)


def _gear(body: MeasuredGear) -> dict[str, Any]:
    gear = body.gear
    return {
        "gear": body.name,
        "teeth": gear.teeth,
        "pitch_radius_mm": gear.pitch_radius,
        "tip_radius_mm": gear.tip_radius,
        "root_radius_mm": body.root,
        "tip_angle_deg": math.degrees(gear.tip_angle),
        "tip_thickness_mm": gear.tip_thickness,
        "foot_angle_deg": math.degrees(gear.foot_angle),
        "foot_end_radius_mm": float(gear.foot.radius(gear.foot_angle)),
    }


def _contact(one: ZoneContact) -> dict[str, Any]:
    zone, alpha = one.zone, one.alpha
    return {
        "zone": zone.name,
        "place": one.place,
        "pressure_angle_deg": math.degrees(alpha),
        "path_coordinate_mm": float(zone.pinion.path_coordinate(alpha)) + 0.0,
        "pinion_flank_radius_mm": plain(float(zone.pinion.curvature_radius(alpha))),
        "wheel_flank_radius_mm": plain(float(zone.wheel.curvature_radius(alpha))),
        "rack_flank_radius_mm": float(zone.pinion.rack_radius(alpha)),
        "reduced_radius_mm": float(zone.reduced_radius(alpha)),
        "involute_reduced_radius_mm": plain(one.involute_radius),
    }


def _condition(one: SignCondition) -> dict[str, Any]:
    return {
        "equation": one.number,
        "curvature_sign": one.radius,
        "holds": one.holds,
        "arc_radius_mm": one.flank.arc_radius,
        "arc_limit_mm": plain(one.arc_limit),
    }


def _rack_arc(one: RackArc) -> dict[str, Any]:
    return {
        "part": one.flank.part,
        "rack_arc_radius_mm": one.fit.radius,
        "rack_arc_x_mm": one.fit.centre[0],
        "rack_arc_y_mm": one.fit.centre[1],
        "max_deviation_mm": one.deviation,
        "rms_deviation_mm": one.fit.rms,
    }


def _rollers(body: MeasuredGear) -> list[dict[str, Any]]:
    return [
        {
            "gear": body.name,
            "roller_mm": one.roller.diameter,
            "part": one.roller.part,
            "pressure_angle_deg": math.degrees(one.roller.alpha),
            "centre_radius_mm": one.roller.centre_radius,
            "over_pins_mm": one.roller.over,
            "involute_over_pins_mm": plain(one.involute_over),
        }
        for one in body.measured
    ]


def _flank_table(layout: PairLayout, body: MeasuredGear) -> pd.DataFrame:
    """Points of a gear's flank from the end of the foot to the tip, as finished."""
    tables = []
    (head, tip), (foot, end) = body.gear.flanks()
    spans = [(foot, np.linspace(end, foot.pitch_point_angle, _POINTS))]
    spans += [(head, np.linspace(head.pitch_point_angle, tip, _POINTS))]
    for flank, alpha in spans:
        after_pitch_point = (flank.part == "head") == (body.name == "pinion")
        zone = layout.pair.zones[0 if after_pitch_point else 1]
        reduced = zone.reduced_radius(alpha)
        points = rotated(flank.points(alpha), -body.gear.turn)
        tables.append(
            pd.DataFrame(
                {
                    "gear": body.name,
                    "part": flank.part,
                    "zone": zone.name,
                    "pressure_angle_deg": np.degrees(alpha),
                    "path_coordinate_mm": zone.pinion.path_coordinate(alpha),
                    "roll_angle_deg": np.degrees(flank.roll_angle(alpha)),
                    "x_mm": points[:, 0],
                    "y_mm": points[:, 1],
                    "radius_mm": flank.radius(alpha),
                    "curvature_per_mm": flank.curvature(alpha),
                    "reduced_radius_mm": np.where(alpha <= zone.end, reduced, np.nan),
                }
            )
        )
    return pd.concat(tables)


def _rack_table(layout: PairLayout) -> pd.DataFrame:
    """Points of the rack's flank from the pitch point, the half that cuts the pinion's foot first."""
    pinion = layout.pair.pinion

    def half(flank: ConvexConcaveFlank, alpha: Vector) -> pd.DataFrame:
        points = flank.rack_points(alpha)
        return pd.DataFrame(
            {
                "part": flank.part,
                "pressure_angle_deg": np.degrees(alpha),
                "rolled_length_mm": flank.rolled_length(alpha),
                "x_mm": points[:, 0],
                "y_mm": points[:, 1],
                "rack_flank_radius_mm": flank.rack_radius(alpha),
            }
        )

    alpha = np.linspace(pinion.pitch_point_angle, pinion.foot_angle, _POINTS)
    return pd.concat([half(pinion.foot, alpha[::-1]), half(pinion.head, alpha)])


def _text(title: str, layout: PairLayout) -> str:
    pair = layout.pair
    ratio = (
        f"{pair.contact_ratio:.4f} ({pair.approach_ratio:.4f} before the pitch point, "
        f"{pair.recess_ratio:.4f} after it); involute {layout.involute.contact_ratio:.4f}"
    )
    return answer_text(
        title,
        "",
        *_gear_lines(layout),
        "",
        *_contact_lines(layout),
        "",
        Finding("Contact", f"ratio {ratio}"),
        Finding("Reduced", _reduced(layout)),
        Finding("Signs", _signs(pair.sign_conditions)),
        Finding("Rack", _rack_text(layout)),
        "",
        *_roller_lines(layout),
    )


def _gear_lines(layout: PairLayout) -> list[str]:
    names = {
        "teeth": "teeth",
        "pitch_radius_mm": "pitch radius, mm",
        "tip_radius_mm": "tip radius, mm",
        "root_radius_mm": "root radius, mm",
        "tip_angle_deg": "pressure angle at the tip, deg",
        "tip_thickness_mm": "tip thickness, mm",
        "foot_angle_deg": "pressure angle at end of dedendum, deg",
        "foot_end_radius_mm": "radius at end of dedendum, mm",
    }
    gears = [_gear(body) for body in layout.bodies]
    lines = [f"{'':41s}{'pinion':>10s}{'wheel':>10s}"]
    for key, name in names.items():
        form = "d" if key == "teeth" else ".4f"
        lines.append(f"{name:41s}" + "".join(f"{gear[key]:10{form}}" for gear in gears))
    return lines


def _contact_lines(layout: PairLayout) -> list[str]:
    lines = [
        f"{'zone':6s}{'place':12s}{'alpha, deg':>11s}{'l, mm':>9s}{'rho_1, mm':>12s}{'rho_2, mm':>12s}"
        f"{'rack, mm':>11s}{'rho, mm':>10s}{'involute, mm':>14s}"
    ]
    ends = {one.zone.name: one.alpha for one in layout.contacts if one.place == "end"}
    for contact in layout.contacts:
        if contact.place == "best" and contact.alpha == ends[contact.zone.name]:
            continue
        one = _contact(contact)
        numbers = zip(list(one.values())[2:], (11, 9, 12, 12, 11, 10, 14), strict=True)
        lines.append(
            f"{one['zone']:6s}{one['place'].replace('_', ' '):12s}"
            + "".join(f"{'-':>{n}s}" if v is None else f"{v:{n}.4f}" for v, n in numbers)
        )
    return lines


def _reduced(layout: PairLayout) -> str:
    pitch_point = layout.contacts[0]
    best = max((one for one in layout.contacts if one.place == "best"), key=_radius)
    against = f", where the involute pair has {best.involute_radius:.4g} mm"
    return (
        f"radius {_radius(pitch_point):.4g} mm at the pitch point, as for the involute pair; best "
        f"{_radius(best):.4g} mm "
        f"at l = {float(best.zone.pinion.path_coordinate(best.alpha)):.4g} mm"
        + ("" if math.isnan(best.involute_radius) else against)
    )


def _radius(one: ZoneContact) -> float:
    return float(one.zone.reduced_radius(one.alpha))


def _signs(conditions: tuple[SignCondition, ...]) -> str:
    found = []
    for one in conditions:
        verdict = "holds" if one.holds else "does NOT hold"
        limit = "for any arc"
        if math.isfinite(one.arc_limit):
            limit = f"arc radius {one.flank.arc_radius:g} mm, limit at the pitch point {one.arc_limit:.4g} mm"
        found.append(f"({one.number}) {one.radius} {verdict} ({limit})")
    return "; ".join(found)


def _rack_text(layout: PairLayout) -> str:
    return "; ".join(
        f"flank that cuts the pinion {_PARTS[one.flank.part]}: arc of {one.fit.radius:.4f} mm about "
        f"({one.fit.centre[0]:.4f}, {one.fit.centre[1]:.4f}) mm, deviation at most {one.deviation:.4f} mm, "
        f"{one.fit.rms:.4f} mm rms"
        for one in layout.rack_arcs
    )


def _roller_lines(layout: PairLayout) -> list[str]:
    lines = [
        f"{'rollers':9s}{'D, mm':>9s}  {'rests on':10s}{'alpha, deg':>11s}{'at radius, mm':>15s}"
        f"{'over rollers, mm':>18s}{'involute, mm':>14s}"
    ]
    for body in layout.bodies:
        for one in _rollers(body):
            involute = one["involute_over_pins_mm"]
            shown = "-" if involute is None else f"{involute:.4f}"
            lines.append(
                f"{body.name:9s}{one['roller_mm']:9.4g}  {_PARTS[one['part']]:10s}"
                f"{one['pressure_angle_deg']:11.4f}{one['centre_radius_mm']:15.4f}{one['over_pins_mm']:18.4f}{shown:>14s}"
            )
    return lines


def _warnings(layout: PairLayout) -> list[str]:
    pair, found = layout.pair, []
    if pair.contact_ratio < 1.0:
        found.append(
            f"the contact ratio is {pair.contact_ratio:.3f}, below 1: a tooth pair separates before "
            "the next one engages: raise addendum_ratio, or use helical teeth"
        )
    found += [
        f"({one.number}) {one.radius} does not hold up to the end of contact: the dedendum is convex "
        f"beyond {math.degrees(max(one.flank.straight_angle, pair.pitch_point_angle)):.4g} deg; "
        "reduce the radius of its arc"
        for one in pair.sign_conditions
        if not one.holds
    ]
    for body in layout.bodies:
        if body.overlap > 10.0 * OUTLINE_TOLERANCE:
            found.append(
                f"the tips of the mating gear cut {body.overlap:.3f} mm into the root of the {body.name}: "
                'raise root_clearance_ratio or set root_form = "radial"'
            )
        for measured in body.measured:
            roller = measured.roller
            if roller.centre_radius - 0.5 * roller.diameter < body.root:
                found.append(f"the roller of {roller.diameter:g} mm meets the root of the {body.name}")
            if roller.centre_radius + 0.5 * roller.diameter < body.gear.tip_radius:
                found.append(
                    f"the roller of {roller.diameter:g} mm lies below the tips of the {body.name}: "
                    "a gauge cannot reach it"
                )
    return found
