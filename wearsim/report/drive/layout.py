"""Where the chain runs, how hard it pulls, what the shafts bear and what its joints lose."""

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from wearsim._version import ANSWER_HEAD
from wearsim.case.model import Case
from wearsim.chain.loop_forces import LoopForces
from wearsim.drive.drive_case import DriveCase
from wearsim.drive.wheels import DRIVER
from wearsim.mechanisms.wrap.tooth_loads import ToothLoads
from wearsim.quantities import grouped
from wearsim.report.loads_table import loads_json, loads_table
from wearsim.report.text_lines import answer_text, assumed, row


def drive_forces(drive: DriveCase) -> LoopForces:
    """Return the forces in the loop under the highest load, of a cassette on the cog that runs longest."""
    found = drive.driver.drive
    forces = found.forces(found.heaviest)
    wheels = zip(forces.loop.wheels, loop_names(drive), strict=True)
    loop = replace(forces.loop, wheels=tuple(replace(wheel, name=name) for wheel, name in wheels))
    return replace(forces, loop=loop)


def chain_speed(drive: DriveCase) -> float:
    """Return the speed of the chain under the highest load [m/s]."""
    found = drive.driver.drive
    return found.rated_drive(drive.driver.case, found.heaviest).chain_speed


def layout_json(drive: DriveCase) -> dict[str, Any]:
    """Return layout and forces of a drive as JSON."""
    forces, speed = drive_forces(drive), chain_speed(drive)
    loop = forces.loop
    return {
        "links": drive.driver.drive.layout.links,
        "chain_speed_m_per_s": speed,
        "sprockets": [
            {
                "name": name,
                "teeth": wheel.teeth or None,
                **({"smooth_diameter_mm": 2.0 * wheel.radius} if wheel.radius else {}),
                "x_mm": wheel.centre[0],
                "y_mm": wheel.centre[1],
                "wrap_deg": math.degrees(float(loop.wrap_angles[i])),
                "teeth_in_mesh": float(loop.teeth_in_mesh[i]),
                "shaft_load_N": float(forces.shaft_loads[i]),
                "shaft_direction_deg": math.degrees(float(forces.shaft_directions[i])),
                "torque_N_m": 1e-3 * float(forces.torques[i]),
                "power_kW": 1e-3 * speed * float(forces.shaft_pulls[i]),
            }
            for i, (name, wheel) in enumerate(zip(loop_names(drive), loop.wheels, strict=True))
        ],
        "spans": [
            {
                "from": loop_names(drive)[i],
                "to": loop_names(drive)[(i + 1) % len(loop.wheels)],
                "length_mm": float(loop.span_lengths[i]),
                "tension_N": float(forces.tensions[i]),
            }
            for i in range(len(loop.wheels))
        ],
        "centrifugal_tension_N": forces.centrifugal,
        "efficiency": forces.efficiency,
        "friction_heat_W": speed * float(forces.losses.sum()),
    }


def loads_json_of(case: Case | DriveCase, teeth: Mapping[str, ToothLoads]) -> dict[str, Any]:
    """Return what teeth, and of a drive spans and shafts, carry as ``wearsim loads --json`` prints it."""
    if isinstance(case, Case):
        (found,) = teeth.values()
        return loads_json(found)
    sprockets = [{"name": name, **loads_json(found)} for name, found in teeth.items()]
    return {**ANSWER_HEAD, "case": case.name, "layout": layout_json(case), "sprockets": sprockets}


def loads_text(case: Case | DriveCase, teeth: Mapping[str, ToothLoads], explain: bool = False) -> str:
    """Return what teeth, and of a drive spans and shafts, carry in words."""
    if isinstance(case, Case):
        (found,) = teeth.values()
        return answer_text(loads_table(found), assumed(found.assumptions, explain))
    tables = (loads_table(replace(found, title=name)) for name, found in teeth.items())
    return answer_text(case.title, layout_text(case), *tables, assumed(case.assumptions, explain))


def loop_names(drive: DriveCase) -> list[str]:
    """Names of the sprockets in the order of the loop, which begins with the driver where none is placed."""
    wheels = drive.wheels
    if wheels[0].table.position_mm is None:
        wheels = tuple(sorted(wheels, key=lambda wheel: wheel.role != DRIVER))
    return [wheel.name for wheel in wheels]


def _wheel_in_words(wheel: Mapping[str, Any]) -> str:
    return (
        f"{wheel['teeth']} teeth" if wheel["teeth"] else f"smooth, {grouped(wheel['smooth_diameter_mm'])} mm"
    )


def layout_text(drive: DriveCase) -> str:
    """Return layout and forces of a drive in lines of text."""
    found = layout_json(drive)
    lines = [
        row("Chain", f"{found['links']} links at {found['chain_speed_m_per_s']:.4g} m/s"),
        *(
            row(
                one["name"],
                f"{_wheel_in_words(one)}, wrap angle {one['wrap_deg']:.1f} degrees, "
                f"{one['teeth_in_mesh']:.1f} in mesh; shaft {grouped(one['shaft_load_N'])} N at "
                f"{one['shaft_direction_deg']:.4g} degrees"
                + (f", {grouped(abs(one['torque_N_m']))} N m" if one["torque_N_m"] else ", idle"),
            )
            for one in found["sprockets"]
        ),
        row(
            "Spans",
            "; ".join(
                f"{one['from']} to {one['to']} {grouped(one['length_mm'])} mm, {grouped(one['tension_N'])} N"
                for one in found["spans"]
            ),
        ),
        row(
            "Losses",
            f"joint friction {found['friction_heat_W']:.3g} W: efficiency "
            f"{100.0 * found['efficiency']:.2f} %",
        ),
    ]
    return "\n".join(lines)
