"""What the teeth of a wrap carry, as a table and as JSON."""

import math
from typing import Any

import numpy as np

from wearsim._version import ANSWER_HEAD
from wearsim.mechanisms.wrap.tooth_loads import ToothLoads
from wearsim.quantities import grouped
from wearsim.report.answer import jumping

_COLUMNS = (
    "tension_N",
    "force_N",
    "load_per_width_N_per_mm",
    "pressure_angle_deg",
    "radius_shift_mm",
    "seat_radius_mm",
    "contact_arc_length_mm",
)


def loads_columns(found: ToothLoads) -> dict[str, list[float]]:
    """Return the columns of the table, in the units of their names."""
    loads = found.loads
    values = (
        loads.tension,
        loads.force,
        loads.force / found.face_width,
        np.degrees(loads.pressure_angle),
        loads.radius_shift,
        loads.seat_radius,
        loads.contact_arc_length,
    )
    return {name: np.asarray(value).tolist() for name, value in zip(_COLUMNS, values, strict=True)}


def loads_json(found: ToothLoads) -> dict[str, Any]:
    """Return the loads as ``wearsim loads --json`` prints them."""
    columns = loads_columns(found)
    teeth = [
        {"tooth": row + 1, **{name: values[row] for name, values in columns.items()}}
        for row in range(found.loads.force.size)
    ]
    return {
        **ANSWER_HEAD,
        "case": found.case,
        "phase": found.phase,
        "elongation_percent": 100.0 * found.elongation,
        "first_link": found.first_link,
        "teeth": teeth,
        "slack_tension_N": found.slack,
        "centrifugal_tension_N": found.centrifugal,
        "min_slack_tension_N": found.smallest_slack if math.isfinite(found.smallest_slack) else None,
        "assumptions": list(found.assumptions),
        "warnings": list(found.warnings),
    }


def loads_table(found: ToothLoads) -> str:
    """Return the loads as ``wearsim loads`` prints them."""
    columns = loads_columns(found)
    lines = [
        f"{found.title}: {found.loads.force.size} rollers in a wrap of {found.wrap_degrees:.1f} degrees, "
        f"elongation {100 * found.elongation:g} %, phase {found.phase:.3g}, "
        f"{found.first_link} link after tooth 1",
        "  tooth  tension    force     load  pressure   shift  contact",
        "               N        N     N/mm angle deg      mm at mm from the right tip",
    ]
    lines += [
        f"  {row + 1:5d} {columns['tension_N'][row]:8.1f} {columns['force_N'][row]:8.1f} "
        f"{columns['load_per_width_N_per_mm'][row]:8.2f} {columns['pressure_angle_deg'][row]:9.2f} "
        f"{columns['radius_shift_mm'][row]:z7.3f} {columns['contact_arc_length_mm'][row]:8.2f}"
        for row in range(found.loads.force.size)
    ]
    lines += [
        f"  {jumping(found.smallest_slack, found.slack)}",
        f"  slack strand {grouped(found.slack)} N; "
        f"{grouped(found.centrifugal)} N more in every link from the chain's own speed",
    ]
    return "\n".join(lines)
