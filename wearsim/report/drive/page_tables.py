"""Tables of the sheet of a drive: geometry, forces, ratings, lives and replacements, in words."""

import math
from dataclasses import dataclass
from typing import Any

from wearsim.catalogue.catalogues import wear_laws
from wearsim.chain.drive_layout import DriveLayout, layout_with_links
from wearsim.chain.loop_layout import LoopLayout
from wearsim.drive.drive_case import DriveCase, DriveSprocket
from wearsim.drive.drive_result import DriveLife
from wearsim.drive.maintenance import DrivePlan
from wearsim.drive.wheels import DriveWheel
from wearsim.errors import CaseError, GeometryError
from wearsim.mechanisms.wrap.drive import PRESSURE_SPEED, JointInput
from wearsim.quantities import grouped
from wearsim.report.drive.drive_words import part_ending
from wearsim.report.drive.layout import layout_json
from wearsim.result import Life, LowerBound
from wearsim.result.lives import hours, service_measures


@dataclass(frozen=True)
class PageTable:
    """A table of the page."""

    name: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    text: tuple[int, ...] = (0,)  # columns of words, the others are numbers


def rating_table(found: DriveLife) -> tuple[PageTable, tuple[str, ...]]:
    """Return the ratings with their margins, and the notes that their sources point to."""
    ratings = found.reference.ratings
    notes = tuple(dict.fromkeys(one.note for one in ratings if one.note))
    rows = []
    for one in ratings:
        unit = f" {one.unit}" if one.unit else ""
        mark = f" [{notes.index(one.note) + 1}]" if one.note else ""
        rows.append(
            (
                one.name,
                f"{grouped(one.value)}{unit}",
                f"{'≥' if one.at_least else '≤'} {grouped(one.limit)}{unit}",
                f"{grouped(one.margin)}{unit}",
                f"{grouped(100.0 * one.used, 3)} %",
                "ok" if one.ok else "outside",
                "; ".join(text for text in (one.source, one.load) if text) + mark,
            )
        )
    head = ("rating", "value", "allowed", "margin", "used", "verdict", "source")
    return PageTable("Ratings", head, tuple(rows), (0, 5, 6)), notes


def wheel_of(drive: DriveCase) -> dict[str, DriveWheel]:
    """Return of every sprocket the wheel that it is, or that it is a cog of."""
    each = [wheel for wheel in drive.wheels for _ in wheel.cogs or (None,)]
    return {one.name: wheel for one, wheel in zip(drive.sprockets, each, strict=True)}


def geometry_table(drive: DriveCase) -> PageTable:
    """Return the sizes of all sprockets, each cog of a cassette for itself."""
    head = [
        "sprocket",
        "role",
        "teeth",
        "pitch dia.",
        "root dia.",
        "tip dia.",
        "over pins",
        "wrap",
        "in mesh",
    ]
    hubs = [key for key in _HUB if any(getattr(one.drive.hub, key) for one in drive.sprockets)]
    rows = [(*_sizes(one), *(_given(one, key) for key in hubs)) for one in drive.sprockets]
    return PageTable("Sprockets, mm and degrees", (*head, *(_HUB[key] for key in hubs)), tuple(rows), (0, 1))


_HUB = {
    "bore": "bore",
    "keyway_width": "keyway width",
    "keyway_depth": "keyway depth",
    "hub_diameter": "hub dia.",
    "hub_length": "hub length",
}


def _sizes(one: DriveSprocket) -> tuple[str, ...]:
    drive = one.drive
    pitch = drive.layout.pitch / math.sin(0.5 * drive.pitch_angle)
    sizes = (pitch, drive.root_diameter, drive.tip_diameter, drive.over_pins)
    return (
        one.name,
        one.role,
        str(drive.gaps),
        *(f"{size:.2f}" for size in sizes),
        f"{math.degrees(drive.wrap_angle):.1f}",
        f"{drive.wrap_angle / drive.pitch_angle:.1f}",
    )


def _given(one: DriveSprocket, key: str) -> str:
    value: float = getattr(one.drive.hub, key)
    return f"{value:g}" if value else "-"


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
    grown = f"grown by {100.0 * limit:.3g} %"
    if isinstance(layout, DriveLayout):
        worn = layout_with_links(layout.pitch * (1.0 + limit), layout.teeth_1, layout.teeth_2, layout.links)
        more = worn.centre_distance - layout.centre_distance
        return [("take-up", f"nominal centre distance with a new chain, +{more:.2f} mm with one {grown}")]
    take_up = layout.drive.take_up
    if take_up is None:
        return [("take-up", "none")]
    try:
        worn_travel = f"{layout.travel_at(limit):.2f} mm with one {grown}"
    except (CaseError, GeometryError):
        worn_travel = f"no room for one {grown}"
    return [
        (
            "take-up",
            f"{take_up.wheel}: {layout.travel:.2f} mm with a new chain, {worn_travel}; "
            f"travel {take_up.least:g} to {take_up.most:g} mm",
        )
    ]


def shaft_table(drive: DriveCase) -> PageTable:
    """Return speed, torque, power and load of all shafts under the highest load."""
    found = layout_json(drive)
    speed = 6e4 * found["chain_speed_m_per_s"] / drive.driver.drive.layout.pitch
    rows = tuple(
        (
            one["name"],
            grouped(speed / one["teeth"]),
            grouped(one["torque_N_m"]),
            grouped(one["power_kW"]),
            grouped(one["shaft_load_N"]),
            f"{one['shaft_direction_deg']:.1f}",
        )
        for one in found["sprockets"]
    )
    head = ("shaft", "speed, rpm", "torque, N\u00a0m", "power, kW", "load, N", "direction, deg")
    return PageTable("Shafts", head, rows)


def span_table(drive: DriveCase) -> PageTable:
    """Return length and tension of all spans under the highest load."""
    rows = tuple(
        (f"{one['from']} to {one['to']}", f"{one['length_mm']:.1f}", grouped(one["tension_N"]))
        for one in layout_json(drive)["spans"]
    )
    return PageTable("Spans", ("span", "length, mm", "tension, N"), rows)


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
        ("service factor f1", f"{drive.service_factor:g}, on the power in the ratings"),
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


def life_table(found: DriveLife) -> PageTable:
    """Return the lives of chain and sprockets on one clock."""
    measures = list(_measures(found, found.life.hours_run))
    rows = []
    for name, life in found.parts.items():
        rows.append(
            (
                name,
                hours(life),
                _band(found, name, life),
                *(_measured(found, life, measure) for measure in measures),
                part_ending(found, name),
            )
        )
    rows += [
        (name, "no life", "-", *["-"] * len(measures), f"its run failed: {error}")
        for name, error in found.failed.items()
    ]
    head = ("part", "life", "over the band", *measures, "what ends it")
    return PageTable("Lives", head, tuple(rows), (0, len(head) - 1))


def _measures(found: DriveLife, at: float) -> dict[str, float | str]:
    return service_measures(found.drive.driver.case.inputs, at)


def _measured(found: DriveLife, life: Life | LowerBound, measure: str) -> str:
    value = _measures(found, life.hours_run).get(measure, "-")
    text = value if isinstance(value, str) else grouped(value)
    return text if isinstance(life, Life) or text == "-" else f"> {text}"


def _band(found: DriveLife, name: str, life: Life | LowerBound) -> str:
    """Lives at both ends of the band."""
    if not isinstance(life, Life):
        return "-"
    low, high = (end.hours_run for end in found.band(name))
    return f"{grouped(low)} to {grouped(high)} h"


def plan_table(plan: DrivePlan) -> PageTable:
    """Return what is replaced when by the best rule of a plan, and with which chain."""
    measures = list(_measures(plan.found, plan.until))
    rows = tuple(
        (
            f"{grouped(stop.hours)} h",
            *(_measured(plan.found, Life(0.0, stop.hours), measure) for measure in measures),
            ", ".join(stop.parts),
            str(plan.best.chain_at(stop.hours) or "-"),
        )
        for stop in plan.stops
    )
    head = ("at", *measures, "replace", "chain removed")
    return PageTable("Replacements", head, rows, (len(head) - 2,))
