"""Profiles of a gear pair with a prescribed contact stress: text, tables and pictures."""

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd

from wearsim.contact.prescribed_stress import LoadedPair
from wearsim.errors import GeometryError
from wearsim.geometry.gear.path_of_contact import PathOfContact
from wearsim.geometry.gear.plane_gearing import Contacts
from wearsim.geometry.profile_points import Vector
from wearsim.handbook.synthesise.figure import direction_figure, field_figure, indices_figure, line_figure
from wearsim.handbook.synthesise.keys import SynthesisTables
from wearsim.handbook.synthesise.model import MeshField, MeshPhase, direction_fields, stress_fields
from wearsim.report.answer_table import records_of
from wearsim.report.calculation_sheet import CalculationSheet
from wearsim.report.text_lines import Finding, answer_text

_ASSUMPTIONS = (
    "the gears are rigid, one pair of teeth carries the whole load, and there is no friction",
    "the contact is that of two cylinders with the radii of curvature of the profiles (Hertz)",
    "the equations are derived here: only the conclusions of Babichev (2012) survive",
)

_STEEP = 30.0
"""Pressure angle [deg] beyond which a line is warned about."""

_ROWS = 9


def synthesis_sheet(
    tables: SynthesisTables, pair: LoadedPair, phases: Sequence[MeshPhase]
) -> CalculationSheet:
    """Return what ``wearsim handbook synthesise`` shows."""
    indices = _by_phase(_indices(pair, phase) for phase in phases)
    made = {
        "indices": indices,
        "line_of_action": _by_phase(_line(phase.line) for phase in phases),
        "pinion_profile": _by_phase(_pinion(phase.line) for phase in phases),
        "wheel_profile": _by_phase(_wheel(phase.line) for phase in phases),
    }
    figures = {
        "line_of_action": line_figure(tables.title, phases),
        "indices": indices_figure(tables.title, indices),
    }
    if tables.field is not None:
        stressed, directed = (
            stress_fields(pair, tables.field.plane),
            direction_fields(pair, tables.field.plane),
        )
        made["stress_fields"] = _fields(pair, "family", stressed)
        for family, field in stressed.items():
            lines = [phase.line for phase in phases if phase.family == family]
            name = "field_great_radii" if family == 1 else "field_small_radii"
            figures[name] = field_figure(tables.title, pair, field, family, lines)
        if directed:
            made["direction_fields"] = _fields(pair, "direction_deg", directed)
            figures["field_directions"] = direction_figure(tables.title, directed)
    return CalculationSheet(
        text=_text(tables.title, pair, phases, indices),
        content={
            "title": tables.title,
            "least_pitch_point_stress_MPa": pair.least_pitch_point_stress,
            "best_pitch_point_angle_deg": math.degrees(pair.load.best_pitch_point_angle),
            "pitch_point_pressure_angle_deg": _pitch_point_angle(pair),
            "mesh_phases": [_summary(number, phase) for number, phase in enumerate(phases, 1)],
            "indices": records_of(indices),
            "assumptions": list(_ASSUMPTIONS),
        },
        tables=lambda: made,
        figures=lambda: figures,
        warnings=tuple(_warnings(indices)),
    )


def _by_phase(columns: Iterable[Mapping[str, Vector]]) -> pd.DataFrame:
    """One below the other, with the number of each in the first column."""
    parts = [pd.DataFrame({"mesh_phase": n, **part}) for n, part in enumerate(columns, 1)]
    return pd.concat(parts, ignore_index=True)


def _indices(pair: LoadedPair, phase: MeshPhase) -> dict[str, Vector]:
    contacts, straight = phase.line.contacts, phase.involute.contacts
    return {
        "pitch_point_distance_mm": contacts.pitch_point_distance,
        "roll_angle_deg": np.degrees(phase.line.roll_angle),
        **_contact_columns(pair, contacts),
        "contact_stress_MPa": pair.contact_stress(contacts),
        "involute_contact_stress_MPa": pair.contact_stress(straight),
        "involute_pinion_specific_sliding": straight.pinion_specific_sliding,
        "involute_wheel_specific_sliding": straight.wheel_specific_sliding,
    }


def _contact_columns(pair: LoadedPair, contacts: Contacts) -> dict[str, Vector]:
    with np.errstate(divide="ignore", invalid="ignore"):
        return {
            "pressure_angle_deg": np.degrees(contacts.pressure_angle),
            "direction_deg": np.degrees(contacts.direction),
            "pinion_flank_radius_mm": 1.0 / contacts.pinion_curvature,
            "wheel_flank_radius_mm": 1.0 / contacts.wheel_curvature,
            "reduced_radius_mm": 1.0 / contacts.relative_curvature,
            "load_per_width_N_per_mm": pair.load.at(contacts.pressure_angle),
            "sliding_speed_mm_per_s": pair.speed * contacts.sliding,
            "pinion_rolling_speed_mm_per_s": pair.speed * contacts.pinion_rolling,
            "wheel_rolling_speed_mm_per_s": pair.speed * contacts.wheel_rolling,
            "rolling_speed_sum_mm_per_s": pair.speed * (contacts.pinion_rolling + contacts.wheel_rolling),
            "pinion_specific_sliding": contacts.pinion_specific_sliding,
            "wheel_specific_sliding": contacts.wheel_specific_sliding + 0.0,
        }


def _line(line: PathOfContact) -> dict[str, Vector]:
    contacts = line.contacts
    return {
        "pitch_point_distance_mm": contacts.pitch_point_distance,
        "contact_x_mm": contacts.points[:, 0],
        "contact_y_mm": contacts.points[:, 1],
        "pressure_angle_deg": np.degrees(contacts.pressure_angle),
        "direction_deg": np.degrees(contacts.direction),
        "roll_angle_deg": np.degrees(line.roll_angle),
    }


def _pinion(line: PathOfContact) -> dict[str, Vector]:
    return _profile(line, line.pinion_profile, line.roll_angle, line.contacts.pinion_curvature)


def _wheel(line: PathOfContact) -> dict[str, Vector]:
    roll = line.roll_angle / line.contacts.circles.gear_ratio
    return _profile(line, line.wheel_profile, roll, line.contacts.wheel_curvature)


def _profile(line: PathOfContact, points: Vector, roll_angle: Vector, curvature: Vector) -> dict[str, Vector]:
    return {
        "pitch_point_distance_mm": line.contacts.pitch_point_distance,
        "roll_angle_deg": np.degrees(roll_angle),
        "x_mm": points[:, 0],
        "y_mm": points[:, 1],
        "curvature_per_mm": curvature,
    }


def _fields(pair: LoadedPair, name: str, fields: Mapping[Any, MeshField]) -> pd.DataFrame:
    parts = []
    for key, field in fields.items():
        columns = {
            "contact_x_mm": field.x,
            "contact_y_mm": field.y,
            "pitch_point_distance_mm": field.contacts.pitch_point_distance,
            **_contact_columns(pair, field.contacts),
            "contact_stress_MPa": field.contact_stress,
        }
        part = pd.DataFrame({column: values.ravel() for column, values in columns.items()})
        reason = field.infeasibility.ravel()
        part.loc[reason != "", part.columns[2:]] = np.nan
        part[name], part["infeasibility"] = key, reason
        parts.append(part)
    return pd.concat(parts, ignore_index=True)


def _pitch_point_angle(pair: LoadedPair) -> float | None:
    """Return the pressure angle at the pitch point [deg]; none where the stress is too low there."""
    try:
        return math.degrees(pair.pitch_point_crossing().pressure_angle)
    except GeometryError:
        return None


def _summary(number: int, phase: MeshPhase) -> dict[str, Any]:
    l, end = phase.line.contacts.pitch_point_distance, phase.inner_end
    return {
        "mesh_phase": number,
        "family": phase.family,
        "through_pitch_point": phase.through_pitch_point,
        "first_pitch_point_distance_mm": float(l[0]),
        "last_pitch_point_distance_mm": float(l[-1]),
        "end_pitch_point_distance_mm": None if end is None else end[0],
        "end_pressure_angle_deg": None if end is None else math.degrees(end[1]),
    }


_HEAD = (
    f"{'l':>9s}{'alpha':>8s}{'phi1':>9s}{'rho1':>10s}{'rho2':>10s}{'sigma_H':>9s}{'involute':>10s}"
    f"{'v_s':>9s}{'theta1':>9s}{'theta2':>9s}\n"
    f"{'mm':>9s}{'deg':>8s}{'deg':>9s}{'mm':>10s}{'mm':>10s}{'MPa':>9s}{'MPa':>10s}{'mm/s':>9s}"
)


def _text(title: str, pair: LoadedPair, phases: Sequence[MeshPhase], indices: pd.DataFrame) -> str:
    circles, load, angle = pair.circles, pair.load, _pitch_point_angle(pair)
    kind = "at a pressure angle of 0, constant torque" if load.power else "at any angle"
    requested = f"{float(pair.stress.at(0.0)):.6g} MPa "
    takes = "is too low" if angle is None else f"requires a pressure angle of {angle:.6g} deg"
    parts: list[object] = [
        title,
        Finding(
            "Pair",
            f"pitch radii {circles.pinion_radius:.6g} and {circles.wheel_radius:.6g} mm, contact modulus "
            f"{pair.modulus:.6g} MPa, {load.base:.6g} N/mm {kind}",
        ),
        Finding(
            "Stress",
            f"minimum {pair.least_pitch_point_stress:.6g} MPa at the pitch point (at "
            f"{math.degrees(load.best_pitch_point_angle):g} deg); {requested}{takes}",
        ),
    ]
    for number, phase in enumerate(phases, 1):
        rows = indices[indices["mesh_phase"] == number]
        shown = np.unique(np.linspace(0, len(rows) - 1, _ROWS).astype(int))
        parts += ["", Finding(f"Phase {number}", _phase(phase, rows)), _HEAD]
        parts += [_row(rows.iloc[at]) for at in shown]
    return answer_text(*parts)


def _phase(phase: MeshPhase, rows: pd.DataFrame) -> str:
    where = "through the pitch point" if phase.through_pitch_point else "not through the pitch point"
    size = "large" if phase.family == 1 else "small"
    compared = math.degrees(phase.involute.contacts.pressure_angle[0])
    text = (
        f"{where}, family {phase.family:+d} ({size} radii): pinion {_form(rows, 'pinion')}, wheel "
        f"{_form(rows, 'wheel')}; compared with an involute of {compared:.4g} deg"
    )
    if phase.inner_end is None:
        return text
    end, angle = phase.inner_end[0], round(math.degrees(phase.inner_end[1]))
    return f"{text}; towards the pitch point it ends at l = {end:.6g} mm (pressure angle {angle} deg)"


def _form(rows: pd.DataFrame, wheel: str) -> str:
    signs = np.sign(rows[f"{wheel}_flank_radius_mm"].to_numpy())
    if signs.min() == signs.max():
        return "convex" if signs[0] > 0.0 else "concave"
    at = rows["pitch_point_distance_mm"].to_numpy()[np.flatnonzero(np.diff(signs))]
    return "convex and concave, straight near l = " + ", ".join(f"{l:.3g}" for l in at) + " mm"


def _row(one: "pd.Series[float]") -> str:
    return (
        f"{one['pitch_point_distance_mm']:9.3f}{one['pressure_angle_deg']:8.3f}{one['roll_angle_deg']:9.3f}"
        f"{one['pinion_flank_radius_mm']:10.3f}{one['wheel_flank_radius_mm']:10.3f}"
        f"{one['contact_stress_MPa']:9.2f}{one['involute_contact_stress_MPa']:10.2f}"
        f"{one['sliding_speed_mm_per_s']:9.1f}{one['pinion_specific_sliding']:9.4f}"
        f"{one['wheel_specific_sliding']:9.4f}"
    )


def _warnings(indices: pd.DataFrame) -> Iterable[str]:
    for number, rows in indices.groupby("mesh_phase"):
        steepest = rows["pressure_angle_deg"].max()
        if steepest > _STEEP:
            yield (
                f"phase {number}: the pressure angle reaches {steepest:.1f} deg: bearing "
                "forces are high, and teeth become pointed"
            )
        if rows["involute_contact_stress_MPa"].isna().any():
            yield (
                f"phase {number}: the involute interferes over part of this range; its stress is "
                "omitted there"
            )
