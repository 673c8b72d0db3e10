"""Contact stress at the pitch point against published ones: rows, tables and warnings."""

import math
from collections.abc import Callable, Sequence
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
from wearsim.handbook.hertz_check.model import ROUNDING, Comparison, ComparisonColumn, HertzCheck
from wearsim.handbook.hertz_check.pitch_point_contact import InputChange, PitchPointContact, share_for
from wearsim.handbook.hertz_check.published import AxisFile
from wearsim.handbook.hertz_check.text import ASSUMPTIONS, hertz_check_text
from wearsim.report.answer_table import AnswerTable, Column, plain
from wearsim.report.calculation_sheet import CalculationSheet

_WIDE = 0.05
"""Half-width over the smaller radius beyond which a contact is no longer narrow."""

_GOALS = {"peak_pressure": 3.0, "surface": 5.0, "depth": 5.0}
"""Most that the finest mesh should be off [percent]."""


def hertz_check_sheet(
    title: str, check: HertzCheck, meshes: Sequence[FemContact], axis: AxisFile | None
) -> CalculationSheet:
    """Return what ``wearsim handbook hertz-check`` shows."""
    contact = check.contact
    shown: dict[str, AnswerTable[Any]] = {
        "combinations": _combinations(check),
        "changes": _changes(check),
        "comparison": _comparison(check.comparison),
        "meshes": _meshes(contact, meshes),
    }
    shown = {name: table for name, table in shown.items() if table.rows}
    head = _contact(check)
    if axis is not None:
        head["axis_file"] = _axis_file(axis, head["depth_von_mises_MPa"])
    warnings = [
        *_input_warnings(check),
        *_verdicts(check),
        *_mesh_warnings(contact, shown["meshes"].records() if meshes else []),
    ]
    references = [] if check.comparison is None else list(check.comparison.references)
    tables: dict[str, AnswerTable[Any] | pd.DataFrame] = {**shown, "axis_stresses": _axis_stresses(contact)}
    if meshes:
        tables |= _fields(meshes[-1])
    return CalculationSheet(
        text=hertz_check_text(title, check, head, shown),
        content={
            "title": title,
            "contact": head,
            **{name: table.records() for name, table in shown.items()},
            **({"difference_references": references} if check.comparison else {}),
            "assumptions": list(ASSUMPTIONS),
            "warnings": warnings,
        },
        tables=lambda: tables,
        figures=lambda: {"hertz_check": hertz_check_figure(title, check, meshes, axis)},
        warnings=tuple(warnings),
    )


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
        "contact_ratio": plain(check.contact_ratio),
    }


def _axis_file(axis: AxisFile, theory: float) -> dict[str, float]:
    greatest = int(axis.von_mises.argmax())
    found = float(axis.von_mises[greatest])
    return {
        "depth_von_mises_MPa": found,
        "depth_of_von_mises_mm": float(axis.depth[greatest]),
        "depth_error_percent": 100.0 * (found / theory - 1.0),
    }


def _combinations(check: HertzCheck) -> AnswerTable[PitchPointContact]:
    """Return a row for each combination of the inputs."""
    columns: list[Column[PitchPointContact]] = [
        Column("torque_N_m", lambda one: 1e-3 * one.torque, "T1, N m", "{:g}", ">11"),
        Column("gear_ratio", lambda one: one.gear_ratio, "u", "{:g}", ">7"),
        Column("face_width_mm", lambda one: one.face_width, "b, mm", "{:g}", ">8"),
        Column("normal_force_N", lambda one: one.normal_force, "F_n, N", "{:.3f}", ">13"),
        Column("load_per_width_N_per_mm", lambda one: one.load_per_width, "q, N/mm", "{:.5f}", ">12"),
        Column("reduced_radius_mm", lambda one: one.reduced_radius, "rho, mm", "{:.6f}", ">11"),
        Column("contact_stress_MPa", lambda one: one.printed_stress, "0.418", "{:.3f}", ">9"),
        Column("peak_pressure_MPa", lambda one: one.peak_pressure, "exact", "{:.3f}", ">9"),
    ]
    if not math.isnan(check.contact_ratio):
        shared = math.sqrt(check.contact_ratio)
        columns.append(
            Column(
                "shared_contact_stress_MPa", lambda one: one.printed_stress / shared, "shared", "{:.3f}", ">9"
            )
        )
    if not math.isnan(check.target):
        low, high = check.target - ROUNDING, check.target + ROUNDING
        columns += [
            Column("load_share", lambda one: share_for(one, check.target), "load x", "{:.5f}", ">9"),
            Column("least_load_share", lambda one: share_for(one, low)),
            Column("greatest_load_share", lambda one: share_for(one, high)),
        ]
    return AnswerTable(columns, check.literal)


def _changes(check: HertzCheck) -> AnswerTable[InputChange]:
    """Return what each key alone must be."""
    low, high = check.target - ROUNDING, check.target + ROUNDING
    return AnswerTable(
        [
            Column("key", lambda one: one.key, "key", side="<28"),
            Column("given_value", lambda one: one.present, "given", "{:g}", ">12"),
            Column("needed_value", lambda one: one.needed, "needed", "{:.6g}", ">12", "none"),
            Column("least_needed_value", lambda one: sorted(one.ends)[0]),
            Column("greatest_needed_value", lambda one: sorted(one.ends)[1]),
            Column("", _span, f"    range for {low:g}-{high:g} MPa", side="<"),
        ],
        check.changes,
    )


def _span(one: InputChange) -> str:
    ends = ("none" if math.isnan(end) else f"{end:.6g}" for end in sorted(one.ends))
    return "" if math.isnan(one.needed) else f"    {' to '.join(ends)}"


def _comparison(comparison: Comparison | None) -> AnswerTable[tuple[str, ComparisonColumn]]:
    """Return a row for each stress that was published."""

    def relative(reference: str, head: str, width: int) -> Column[tuple[str, ComparisonColumn]]:
        key = f"difference_of_{reference}_percent"
        return Column(key, lambda one: one[1].differences[reference], head, "{:.2f}", f">{width}")

    return AnswerTable(
        [
            Column("compared_stress", lambda one: one[0], "stress, MPa", side="<12"),
            Column("hertz_MPa", lambda one: one[1].hertz, "Hertz", "{:.2f}", ">10"),
            Column("finite_elements_MPa", lambda one: one[1].finite_elements, "FE", "{:g}", ">8"),
            Column(
                "printed_difference_percent", lambda one: one[1].printed_percent, "printed, %", "{:g}", ">12"
            ),
            relative("larger", "of larger", 11),
            relative("hertz", "of Hertz", 10),
            relative("finite_elements", "of FE", 9),
            Column("lost_stress_MPa", lambda one: list(one[1].candidates)),
            Column("computed_MPa", lambda one: one[1].computed, "Hertz here", "{:.3f}", ">13"),
            Column(
                "computed_difference_percent",
                lambda one: one[1].computed_difference,
                "of larger",
                "{:.3f}",
                ">11",
            ),
        ],
        [] if comparison is None else list(comparison.columns.items()),
    )


def _meshes(contact: PitchPointContact, meshes: Sequence[FemContact]) -> AnswerTable[FemContact]:
    """Return a row for each mesh, with its errors against the closed forms."""
    pressure = contact.peak_pressure
    surface = pressure * float(axis_von_mises(0.0, contact.poissons_ratio))
    depth = pressure * greatest_von_mises(contact.poissons_ratio).stress

    def error(
        name: str, of: Callable[[FemContact], float], closed: float, head: str = "error"
    ) -> Column[FemContact]:
        key = f"{name}_error_percent"
        return Column(key, lambda one: 100.0 * (of(one) / closed - 1.0), head, "{:+.2f} %", ">9")

    return AnswerTable(
        [
            Column("elements_per_half_width", lambda one: one.elements, "per a", side=">5"),
            Column("unknowns", lambda one: one.unknowns, "unknowns", side=">10"),
            Column("time_s", lambda one: one.seconds),
            Column("peak_pressure_MPa", lambda one: one.peak_pressure, "p0, MPa", "{:.3f}", ">11"),
            error("peak_pressure", lambda one: one.peak_pressure, pressure),
            Column("half_width_mm", lambda one: one.half_width),
            error("half_width", lambda one: one.half_width, contact.half_width, "a"),
            Column("surface_von_mises_MPa", lambda one: one.surface_von_mises, "surface", "{:.2f}", ">10"),
            error("surface", lambda one: one.surface_von_mises, surface),
            Column("depth_von_mises_MPa", lambda one: one.depth_von_mises, "below", "{:.2f}", ">10"),
            error("depth", lambda one: one.depth_von_mises, depth),
            Column("depth_of_von_mises_mm", lambda one: one.depth_of_greatest),
            Column("", lambda one: one.seconds, "time", "{:.1f} s", ">9"),
        ],
        meshes,
    )


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
            f"the half-width of the contact, {contact.half_width:.3g} mm, is more than "
            f"{_WIDE:g} of a radius: Hertz theory assumes a narrow contact"
        )
    return warnings


def _verdicts(check: HertzCheck) -> list[str]:
    found, comparison, warnings = check.contact.printed_stress, check.comparison, []
    if comparison is None:
        return []
    if abs(found - check.target) > ROUNDING:
        warnings.append(
            f"{check.target:g} MPa does not follow from the formula, which gives {found:.3f} MPa for "
            f"this contact ({100.0 * (found / check.target - 1.0):+.2f} %)"
        )
    column = comparison.columns["contact"]
    if not math.isnan(column.computed_difference):
        warnings.append(
            f"this differs from the finite-element stress, {column.finite_elements:g} MPa, by "
            f"{column.computed_difference:.1f} %, not {column.differences['larger']:.1f} %"
        )
    if not comparison.references:
        warnings.append(
            "no single reference gives all printed differences: neither the larger stress nor Hertz nor the "
            "finite elements"
        )
    return warnings


def _mesh_warnings(contact: PitchPointContact, rows: Sequence[dict[str, Any]]) -> list[str]:
    wide = contact.half_width / min(contact.flank_radii)
    return [
        f"finite elements: the finest mesh is off by {rows[-1][f'{name}_error_percent']:+.1f} % in "
        f"{name}, more than {greatest:g} %: raise finite_elements.elements_per_half_width; the rest is due "
        f"to the size of the bodies (half-width {wide:.2g} of a radius)"
        for name, greatest in _GOALS.items()
        if rows and abs(rows[-1][f"{name}_error_percent"]) > greatest
    ]
