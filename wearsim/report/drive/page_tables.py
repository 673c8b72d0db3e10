"""Tables of the sheet of a drive: geometry, forces, lubrication, lives and replacements, in words."""

import math
from functools import partial
from operator import itemgetter
from typing import Any

from wearsim.catalogue.catalogues import wear_laws
from wearsim.chain.drive_layout import DriveLayout, layout_with_links
from wearsim.chain.loop_layout import LoopLayout
from wearsim.drive.drive_case import DriveCase, DriveSprocket
from wearsim.drive.drive_result import DriveLife
from wearsim.drive.maintenance import DrivePlan
from wearsim.drive.replacement_rules import Stop
from wearsim.drive.wheels import DriveWheel
from wearsim.errors import CaseError, GeometryError
from wearsim.mechanisms.wrap.drive import PRESSURE_SPEED, JointInput
from wearsim.quantities import grouped
from wearsim.report.answer_table import AnswerTable, Column
from wearsim.report.drive.drive_words import part_ending
from wearsim.report.drive.layout import drive_forces, layout_json, loop_names
from wearsim.result import Life
from wearsim.result.lives import hours, service_measures


def wheel_of(drive: DriveCase) -> dict[str, DriveWheel]:
    """Return of every sprocket the wheel that it is, or that it is a cog of."""
    each = [wheel for wheel in drive.wheels for _ in wheel.parts]
    return {one.name: wheel for one, wheel in zip(drive.sprockets, each, strict=True)}


def geometry_table(drive: DriveCase) -> AnswerTable[DriveSprocket]:
    """Return the sizes of all sprockets, each cog of a cassette for itself."""
    columns: list[Column[DriveSprocket]] = [
        Column("", lambda one: one.name, "sprocket", side="<"),
        Column("", lambda one: one.role, "role", side="<"),
        Column("", lambda one: one.drive.gaps, "teeth"),
        Column("", _pitch_diameter, "pitch dia.", "{:.2f}"),
        Column("", lambda one: one.drive.root_diameter, "root dia.", "{:.2f}"),
        Column("", lambda one: one.drive.tip_diameter, "tip dia.", "{:.2f}"),
        Column("", lambda one: one.drive.over_pins, "over pins", "{:.2f}"),
        Column("", lambda one: math.degrees(one.drive.wrap_angle), "wrap", "{:.1f}"),
        Column("", lambda one: one.drive.wrap_angle / one.drive.pitch_angle, "in mesh", "{:.1f}"),
    ]
    hubs = [key for key in _HUB if any(getattr(one.drive.hub, key) for one in drive.sprockets)]
    columns += [Column("", partial(_hub_size, key), _HUB[key], "{:g}") for key in hubs]
    return AnswerTable(columns, drive.sprockets)


_HUB = {
    "bore": "bore",
    "keyway_width": "keyway width",
    "keyway_depth": "keyway depth",
    "hub_diameter": "hub dia.",
    "hub_length": "hub length",
}


def _pitch_diameter(one: DriveSprocket) -> float:
    return one.drive.layout.pitch / math.sin(0.5 * one.drive.pitch_angle)


def _hub_size(key: str, one: DriveSprocket) -> float | None:
    return getattr(one.drive.hub, key) or None


def chain_rows(drive: DriveCase) -> list[tuple[str, str]]:
    """Return what is to be known of the chain and of where it runs."""
    wrap, found = drive.driver.drive, layout_json(drive)
    layout, chain = wrap.layout, wrap.chain
    length = layout.links * layout.pitch
    mass = 1e3 * chain.mass_per_length * length  # mass in t/mm
    return [
        ("chain", f"{chain.in_words}, {chain.strands} strand{'s' if chain.strands > 1 else ''}"),
        ("pitch", f"{layout.pitch:g} mm"),
        ("length", f"{layout.links} links, {grouped(length, 5)} mm, {mass:.3g} kg"),
        ("speed of the chain", f"{found['chain_speed_m_per_s']:.4g} m/s"),
        ("centre distances", _centres(found["sprockets"])),
        *_take_up(wrap.layout, wrap.joint.elongation_limit),
    ]


def _centres(wheels: list[dict[str, Any]]) -> str:
    pairs = list(zip(wheels, [*wheels[1:], wheels[0]], strict=True))
    return "; ".join(
        f"{one['name']} to {other['name']} "
        f"{math.hypot(other['x_mm'] - one['x_mm'], other['y_mm'] - one['y_mm']):.2f} mm"
        for one, other in (pairs[:1] if len(wheels) == 2 else pairs)
    )


def _take_up(layout: DriveLayout | LoopLayout, limit: float) -> list[tuple[str, str]]:
    grown = f"at {100.0 * limit:.3g} % elongation"
    if isinstance(layout, DriveLayout):
        worn = layout_with_links(layout.pitch * (1.0 + limit), layout.teeth_1, layout.teeth_2, layout.links)
        more = worn.centre_distance - layout.centre_distance
        return [("take-up", f"nominal centre distance with a new chain, +{more:.2f} mm {grown}")]
    take_up = layout.drive.take_up
    if take_up is None:
        return [("take-up", "none")]
    try:
        worn_travel = f"{layout.travel_at(limit):.2f} mm {grown}"
    except (CaseError, GeometryError):
        worn_travel = f"no room {grown}"
    return [
        (
            "take-up",
            f"{take_up.wheel}: {layout.travel:.2f} mm with a new chain, {worn_travel}; "
            f"travel {take_up.least:g} to {take_up.most:g} mm",
        )
    ]


def shaft_table(drive: DriveCase) -> AnswerTable[dict[str, Any]]:
    """Return speed, torque, power and load of all shafts under the highest load."""
    found, loop = layout_json(drive), drive_forces(drive).loop
    speed = 6e4 * found["chain_speed_m_per_s"] / drive.driver.drive.layout.pitch
    links_round = dict(zip(loop_names(drive), loop.teeth.tolist(), strict=True))
    columns: list[Column[dict[str, Any]]] = [
        Column("", itemgetter("name"), "shaft", side="<"),
        Column("", lambda one: speed / links_round[one["name"]], "speed, rpm", grouped),
        Column("", itemgetter("torque_N_m"), "torque, N\u00a0m", grouped),
        Column("", itemgetter("power_kW"), "power, kW", grouped),
        Column("", itemgetter("shaft_load_N"), "load, N", grouped),
        Column("", itemgetter("shaft_direction_deg"), "direction, deg", "{:.1f}"),
    ]
    return AnswerTable(columns, found["sprockets"])


def span_table(drive: DriveCase) -> AnswerTable[dict[str, Any]]:
    """Return length and tension of all spans under the highest load."""
    columns: list[Column[dict[str, Any]]] = [
        Column("", lambda one: f"{one['from']} to {one['to']}", "span", side="<"),
        Column("", itemgetter("length_mm"), "length, mm", "{:.1f}"),
        Column("", itemgetter("tension_N"), "tension, N", grouped),
    ]
    return AnswerTable(columns, layout_json(drive)["spans"])


def loss_text(drive: DriveCase) -> str:
    """Return what holds beside the tensions, and what the joints lose."""
    found = layout_json(drive)
    return (
        f"Centrifugal tension: {grouped(found['centrifugal_tension_N'], 3)} N in every span; it loads joints "
        f"but no shaft. Joint friction loss: {found['friction_heat_W']:.3g} W, efficiency "
        f"{100.0 * found['efficiency']:.2f} %. Directions count from x (to the right) towards y (upwards); "
        "a negative power is an output. All values at the highest load."
    )


def lubrication_rows(found: DriveLife) -> list[tuple[str, str]]:
    """Return the wear conditions that lubrication stands for, and the factors on loads."""
    states: dict[str, list[str]] = {}
    for one in found.drive.sprockets:
        table, wear = one.case.inputs["wear"], one.case.wear
        unit = " mm2/N" if wear_laws()[wear.law].keys[0].endswith("_mm2_per_N") else ""
        condition = table.get("condition")
        name = f"'{condition}', " if condition else ""
        text = f"{name}{wear.law} {wear.coefficient:.3g}{unit}, band {wear.low:.3g} to {wear.high:.3g} times"
        states.setdefault(text, []).append(one.name)
    drive = found.drive.driver.drive
    return [
        *(
            ("wear of the teeth" if len(states) == 1 else f"wear of {', '.join(names)}", text)
            for text, names in states.items()
        ),
        ("wear of the joints", _joint_wear(drive.joint)),
        ("joint application factor K_e", f"{drive.joint_application_factor:g}, on the joint pressure"),
        ("friction of the joints", f"{drive.joint_friction or 0.0:g}"),
    ]


def _joint_wear(joint: JointInput) -> str:
    law, band = joint.law, joint.band
    text = f"{law.coefficient:.3g} mm2/N, band {band.low:.3g} to {band.high:.3g} times"
    if law.is_constant:
        return text
    return (
        f"{text}; at {law.reference_pressure:g} MPa and {law.reference_speed:g} rpm, law {PRESSURE_SPEED!r}"
    )


def life_table(found: DriveLife) -> AnswerTable[str]:
    """Return the lives of chain and sprockets on one clock."""
    measures = _measures(found, found.life.hours_run)
    columns: list[Column[str]] = [
        Column("", str, "part", side="<"),
        Column("", found.parts.get, "life", hours, missing="no life"),
        Column("", partial(_band, found), "over the band"),
        *(Column("", partial(_measured, found, measure), measure) for measure in measures),
        Column("", partial(_what_ends, found), "what ends it", side="<"),
    ]
    return AnswerTable(columns, [*found.parts, *found.failed])


def _what_ends(found: DriveLife, name: str) -> str:
    if name in found.failed:
        return f"its run failed: {found.failed[name]}"
    return part_ending(found, name)


def _measures(found: DriveLife, at: float) -> dict[str, float | str]:
    return service_measures(found.drive.driver.case.inputs, at)


def _measured(found: DriveLife, measure: str, name: str) -> str | None:
    """Return a life in a measure of the service; None where it is not known in it."""
    life = found.parts.get(name)
    text = None if life is None else _in_measure(found, measure, life.hours_run)
    return text if text is None or isinstance(life, Life) else f"> {text}"


def _in_measure(found: DriveLife, measure: str, at: float) -> str | None:
    value = _measures(found, at).get(measure)
    return value if value is None or isinstance(value, str) else grouped(value)


def _band(found: DriveLife, name: str) -> str | None:
    """Lives at both ends of the band."""
    if not isinstance(found.parts.get(name), Life):
        return None
    low, high = (end.hours_run for end in found.band(name))
    return f"{grouped(low)} to {grouped(high)} h"


def plan_table(plan: DrivePlan) -> AnswerTable[Stop]:
    """Return what is replaced when by the best rule of a plan, and with which chain."""
    measures = _measures(plan.found, plan.until)
    columns: list[Column[Stop]] = [
        Column("", lambda one: one.hours, "at", lambda at: f"{grouped(at)} h"),
        *(Column("", partial(_stop_measure, plan, measure), measure) for measure in measures),
        Column("", lambda one: ", ".join(one.parts), "replace", side="<"),
        Column("", lambda one: plan.best.chain_at(one.hours) or None, "chain removed"),
    ]
    return AnswerTable(columns, plan.stops)


def _stop_measure(plan: DrivePlan, measure: str, stop: Stop) -> str | None:
    return _in_measure(plan.found, measure, stop.hours)
