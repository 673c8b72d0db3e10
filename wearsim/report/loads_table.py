"""What the teeth of a wrap carry, as a table and as JSON."""

import math
from typing import Any

import numpy as np

from wearsim._version import ANSWER_HEAD
from wearsim.mechanisms.wrap.tooth_loads import ToothLoads
from wearsim.quantities import grouped
from wearsim.report.answer import jumping
from wearsim.report.answer_table import AnswerTable, Column


def teeth_table(found: ToothLoads) -> AnswerTable[int]:
    """Return a row for each tooth in the wrap, by its place from the tight end."""
    loads = found.loads
    load = (loads.force / found.face_width).tolist()
    pressure_angle = np.degrees(loads.pressure_angle).tolist()

    def column(key: str, values: list[float], form: str = "", width: int = 0) -> Column[int]:
        return Column(key, values.__getitem__, key if form else None, form, f">{width}")

    return AnswerTable(
        [
            Column("tooth", lambda place: place + 1, "tooth", side=">5"),
            column("tension_N", loads.tension.tolist(), "{:.1f}", 9),
            column("force_N", loads.force.tolist(), "{:.1f}", 9),
            column("load_per_width_N_per_mm", load, "{:.2f}", 9),
            column("pressure_angle_deg", pressure_angle, "{:.2f}", 10),
            column("radius_shift_mm", loads.radius_shift.tolist(), "{:z.3f}", 8),
            column("seat_radius_mm", loads.seat_radius.tolist()),
            column("contact_arc_length_mm", loads.contact_arc_length.tolist(), "{:.2f}", 9),
        ],
        range(loads.force.size),
    )


def loads_json(found: ToothLoads) -> dict[str, Any]:
    """Return the loads as ``wearsim loads --json`` prints them."""
    return {
        **ANSWER_HEAD,
        "case": found.case,
        "phase": found.phase,
        "elongation_percent": 100.0 * found.elongation,
        "first_link": found.first_link,
        "teeth": teeth_table(found).records(),
        "slack_tension_N": found.slack,
        "centrifugal_tension_N": found.centrifugal,
        "min_slack_tension_N": found.smallest_slack if math.isfinite(found.smallest_slack) else None,
        "assumptions": list(found.assumptions),
        "warnings": list(found.warnings),
    }


def loads_table(found: ToothLoads) -> str:
    """Return the loads as ``wearsim loads`` prints them."""
    lines = [
        f"{found.title}: {found.loads.force.size} rollers, wrap angle {found.wrap_degrees:.1f} degrees, "
        f"elongation {100 * found.elongation:g} %, phase {found.phase:.3g}, "
        f"{found.first_link} link after tooth 1",
        "  tooth  tension    force     load  pressure   shift  contact",
        "               N        N     N/mm angle deg      mm at mm from the right tip",
    ]
    lines += teeth_table(found).lines()[1:]
    lines += [
        f"  {jumping(found.smallest_slack, found.slack)}",
        f"  slack span {grouped(found.slack)} N; "
        f"{grouped(found.centrifugal)} N more in every link: centrifugal tension",
    ]
    return "\n".join(lines)
