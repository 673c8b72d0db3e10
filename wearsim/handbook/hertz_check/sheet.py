"""Contact stress at the pitch point against published ones: rows, tables and warnings."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd

from wearsim.contact.line_stress import (
    GreatestStress,
    axis_shear,
    axis_stresses,
    axis_von_mises,
    greatest_shear,
    greatest_von_mises,
)
from wearsim.handbook.hertz_check.figure import hertz_check_figure
from wearsim.handbook.hertz_check.hertz_fem import FemContact
from wearsim.handbook.hertz_check.model import ROUNDING, Comparison, HertzCheck
from wearsim.handbook.hertz_check.pitch_point_contact import InputChange, PitchPointContact, share_for
from wearsim.handbook.hertz_check.published import AxisFile
from wearsim.handbook.hertz_check.text import ASSUMPTIONS, hertz_check_text
from wearsim.report.calculation_sheet import CalculationSheet

_WIDE = 0.05
"""Half-width over the smaller radius beyond which a contact is no longer narrow."""

_GOALS = {"peak_pressure": 3.0, "surface": 5.0, "depth": 5.0}
"""Most that the finest mesh should be off [percent]."""


def hertz_check_sheet(
    title: str, check: HertzCheck, meshes: Sequence[FemContact], axis: AxisFile | None
) -> CalculationSheet:
    """Return what ``wearsim hertz-check`` shows."""
    contact = check.contact
    rows = {
        "combinations": [_combination(one, check) for one in check.literal],
        "changes": [_change(one) for one in check.changes],
        "comparison": [] if check.comparison is None else _comparison(check.comparison),
        "meshes": _meshes(contact, meshes),
    }
    rows = {name: found for name, found in rows.items() if found}
    head = _contact(check)
    if axis is not None:
        head["axis_file"] = _axis_file(axis, head["depth_von_mises_MPa"])
    warnings = [
        *_input_warnings(check),
        *_verdicts(check),
        *_mesh_warnings(check.contact, rows.get("meshes", [])),
    ]
    references = [] if check.comparison is None else list(check.comparison.references)
    tables = {name: pd.DataFrame(found) for name, found in rows.items()}
    tables["axis_stresses"] = _axis_stresses(contact)
    if meshes:
        tables |= _fields(meshes[-1])
    return CalculationSheet(
        text=hertz_check_text(title, check, head, rows),
        content={
            "title": title,
            "contact": head,
            **rows,
            **({"difference_references": references} if check.comparison else {}),
            "assumptions": list(ASSUMPTIONS),
            "warnings": warnings,
        },
        tables=lambda: tables,
        figures=lambda: {"hertz_check": hertz_check_figure(title, check, meshes, axis)},
        warnings=tuple(warnings),
    )


def _known(value: float) -> float | None:
    return None if math.isnan(value) else value


def _contact(check: HertzCheck) -> dict[str, Any]:
    contact = check.contact
    pressure, half_width = contact.peak_pressure, contact.half_width
    mises: GreatestStress = greatest_von_mises(contact.poissons_ratio)
    shear = greatest_shear()
    return {
        "normal_force_N": contact.normal_force,
        "load_per_width_N_per_mm": contact.load_per_width,
        "pinion_flank_radius_mm": contact.flank_radii[0],
        "wheel_flank_radius_mm": contact.flank_radii[1],
        "reduced_radius_mm": contact.reduced_radius,
        "reduced_modulus_MPa": contact.reduced_modulus,
        "contact_stress_MPa": contact.printed_stress,
        "peak_pressure_MPa": pressure,
        "exact_coefficient": contact.exact_coefficient,
        "half_width_mm": half_width,
        "surface_von_mises_MPa": pressure * float(axis_von_mises(0.0, contact.poissons_ratio)),
        "depth_von_mises_MPa": pressure * mises.stress,
        "depth_of_von_mises_mm": half_width * mises.depth,
        "greatest_shear_MPa": pressure * shear.stress,
        "depth_of_shear_mm": half_width * shear.depth,
        "contact_ratio": _known(check.contact_ratio),
    }


def _axis_file(axis: AxisFile, theory: float) -> dict[str, float]:
    greatest = int(axis.von_mises.argmax())
    found = float(axis.von_mises[greatest])
    return {
        "depth_von_mises_MPa": found,
        "depth_of_von_mises_mm": float(axis.depth[greatest]),
        "depth_error_percent": 100.0 * (found / theory - 1.0),
    }


def _combination(one: PitchPointContact, check: HertzCheck) -> dict[str, Any]:
    row: dict[str, Any] = {
        "torque_N_m": 1e-3 * one.torque,
        "gear_ratio": one.gear_ratio,
        "face_width_mm": one.face_width,
        "normal_force_N": one.normal_force,
        "load_per_width_N_per_mm": one.load_per_width,
        "reduced_radius_mm": one.reduced_radius,
        "contact_stress_MPa": one.printed_stress,
        "peak_pressure_MPa": one.peak_pressure,
    }
    if not math.isnan(check.contact_ratio):
        row["shared_contact_stress_MPa"] = one.printed_stress / math.sqrt(check.contact_ratio)
    if not math.isnan(check.target):
        row["load_share"] = share_for(one, check.target)
        row["least_load_share"] = share_for(one, check.target - ROUNDING)
        row["greatest_load_share"] = share_for(one, check.target + ROUNDING)
    return row


def _change(one: InputChange) -> dict[str, Any]:
    low, high = sorted(one.ends)
    return {
        "key": one.key,
        "given_value": one.present,
        "needed_value": _known(one.needed),
        "least_needed_value": _known(low),
        "greatest_needed_value": _known(high),
    }


def _comparison(comparison: Comparison) -> list[dict[str, Any]]:
    return [
        {
            "compared_stress": name,
            "hertz_MPa": column.hertz,
            "finite_elements_MPa": _known(column.finite_elements),
            "printed_difference_percent": _known(column.printed_percent),
            **{
                f"difference_of_{reference}_percent": _known(value)
                for reference, value in column.differences.items()
            },
            "lost_stress_MPa": list(column.candidates),
            "computed_MPa": column.computed,
            "computed_difference_percent": _known(column.computed_difference),
        }
        for name, column in comparison.columns.items()
    ]


def _meshes(contact: PitchPointContact, meshes: Sequence[FemContact]) -> list[dict[str, Any]]:
    pressure = contact.peak_pressure
    surface = pressure * float(axis_von_mises(0.0, contact.poissons_ratio))
    depth = pressure * greatest_von_mises(contact.poissons_ratio).stress
    return [
        {
            "elements_per_half_width": mesh.elements,
            "unknowns": mesh.unknowns,
            "time_s": mesh.seconds,
            "peak_pressure_MPa": mesh.peak_pressure,
            "peak_pressure_error_percent": 100.0 * (mesh.peak_pressure / pressure - 1.0),
            "half_width_mm": mesh.half_width,
            "half_width_error_percent": 100.0 * (mesh.half_width / contact.half_width - 1.0),
            "surface_von_mises_MPa": mesh.surface_von_mises,
            "surface_error_percent": 100.0 * (mesh.surface_von_mises / surface - 1.0),
            "depth_von_mises_MPa": mesh.depth_von_mises,
            "depth_error_percent": 100.0 * (mesh.depth_von_mises / depth - 1.0),
            "depth_of_von_mises_mm": mesh.depth_of_greatest,
        }
        for mesh in meshes
    ]


def _axis_stresses(contact: PitchPointContact) -> pd.DataFrame:
    depth, pressure = np.linspace(0.0, 3.0, 61), contact.peak_pressure
    along, across = axis_stresses(depth)
    return pd.DataFrame(
        {
            "below_surface_mm": depth * contact.half_width,
            "stress_along_MPa": pressure * along,
            "stress_across_MPa": pressure * across,
            "shear_MPa": pressure * axis_shear(depth),
            "von_mises_MPa": pressure * axis_von_mises(depth, contact.poissons_ratio),
        }
    )


def _fields(mesh: FemContact) -> dict[str, pd.DataFrame]:
    """Return what the finest mesh found: on the axis near the surface, and in the contact."""
    near = mesh.depth <= 6.0 * mesh.half_width
    return {
        "fem_axis": pd.DataFrame(
            {"below_surface_mm": mesh.depth[near], "von_mises_MPa": mesh.von_mises[near]}
        ),
        "fem_pressure": pd.DataFrame({"from_middle_mm": mesh.place, "pressure_MPa": mesh.pressure}),
    }


def _input_warnings(check: HertzCheck) -> list[str]:
    contact, teeth, warnings = check.contact, check.teeth, []
    if teeth is not None:
        ratio = teeth.wheel_teeth / teeth.pinion_teeth
        if abs(contact.gear_ratio / ratio - 1.0) > 1e-3:
            warnings.append(
                f"contact.gear_ratio = {contact.gear_ratio:g} contradicts the teeth, "
                f"{teeth.wheel_teeth}/{teeth.pinion_teeth} = {ratio:g}"
            )
        diameter = teeth.module * teeth.pinion_teeth
        if abs(contact.pitch_diameter / diameter - 1.0) > 1e-3:
            warnings.append(
                f"contact.pinion_pitch_diameter_mm = {contact.pitch_diameter:g} is not module_mm times "
                f"pinion_teeth, {diameter:g}: the contact ratio is that of teeth without profile shift"
            )
    if abs(contact.poissons_ratio - 0.3) > 0.02:
        warnings.append(
            f"the coefficient 0.418 is for a Poisson's ratio of 0.3; for {contact.poissons_ratio:g} it is "
            f"{contact.exact_coefficient:.4f}"
        )
    if contact.half_width > _WIDE * min(contact.flank_radii):
        warnings.append(
            f"the contact is {contact.half_width:.3g} mm wide on either side, more than "
            f"{_WIDE:g} of a radius: Hertz' theory is for narrow ones"
        )
    return warnings


def _verdicts(check: HertzCheck) -> list[str]:
    found, comparison, warnings = check.contact.printed_stress, check.comparison, []
    if comparison is None:
        return []
    if abs(found - check.target) > ROUNDING:
        warnings.append(
            f"{check.target:g} MPa is not what the formula gives for this contact, {found:.3f} MPa "
            f"({100.0 * (found / check.target - 1.0):+.2f} %)"
        )
    column = comparison.columns["contact"]
    if not math.isnan(column.computed_difference):
        warnings.append(
            f"from the finite elements' {column.finite_elements:g} MPa that differs by "
            f"{column.computed_difference:.1f} %, not by {column.differences['larger']:.1f} %"
        )
    if not comparison.references:
        warnings.append(
            "no one reference gives all printed differences: neither the larger stress nor Hertz nor the "
            "finite elements"
        )
    return warnings


def _mesh_warnings(contact: PitchPointContact, rows: Sequence[dict[str, Any]]) -> list[str]:
    wide = contact.half_width / min(contact.flank_radii)
    return [
        f"finite elements: the finest mesh is off by {rows[-1][f'{name}_error_percent']:+.1f} % in "
        f"{name}, more than {greatest:g} %: raise finite_elements.elements_per_half_width; what stays is the "
        f"size of the bodies (half-width {wide:.2g} of a radius)"
        for name, greatest in _GOALS.items()
        if rows and abs(rows[-1][f"{name}_error_percent"]) > greatest
    ]
