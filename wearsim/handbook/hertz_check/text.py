"""Contact stress at the pitch point against published ones, in words."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from wearsim.handbook.hertz_check.model import ROUNDING, HertzCheck
from wearsim.report.text_lines import numbered_assumptions, row

Rows = Sequence[Mapping[str, Any]]

_REFERENCES = {"larger": "the larger of both", "hertz": "Hertz", "finite_elements": "the finite elements"}

ASSUMPTIONS = (
    "one pair of teeth carries the whole load at the pitch point, evenly along the face",
    "the teeth are smooth elastic cylinders in plane strain; friction is left out (it changes nothing "
    "where both bodies have the same elastic constants)",
)


def hertz_check_text(title: str, check: HertzCheck, head: Mapping[str, Any], rows: Mapping[str, Rows]) -> str:
    """Return what ``wearsim hertz-check`` prints."""
    blocks = [[title, *_contact(check, head)]]
    if "combinations" in rows:
        blocks.append(_combinations(check, rows["combinations"]))
    if "changes" in rows:
        blocks.append(_changes(check, rows["changes"]))
    if "comparison" in rows:
        blocks.append(_comparison(check, rows["comparison"]))
    if "meshes" in rows:
        blocks.append(_meshes(rows["meshes"]))
    blocks.append([row("Assumes", numbered_assumptions(ASSUMPTIONS))])
    return "\n\n".join("\n".join(line.rstrip() for line in block) for block in blocks)


def _contact(check: HertzCheck, head: Mapping[str, Any]) -> list[str]:
    contact, pressure = check.contact, head["peak_pressure_MPa"]
    ratio = head["contact_ratio"]
    lines = [
        ("Load", f"F_n = {head['normal_force_N']:.2f} N, q = {head['load_per_width_N_per_mm']:.4f} N/mm"),
        (
            "Flanks",
            f"radii {head['pinion_flank_radius_mm']:.4f} and {head['wheel_flank_radius_mm']:.4f} mm, "
            f"reduced {head['reduced_radius_mm']:.6f} mm; E = {head['reduced_modulus_MPa']:g} MPa, "
            f"nu = {contact.poissons_ratio:g}",
        ),
        (
            "Hertz",
            f"{head['contact_stress_MPa']:.3f} MPa with the coefficient 0.418, {pressure:.3f} MPa with "
            f"the exact {head['exact_coefficient']:.6f}; half-width {head['half_width_mm']:.5f} mm",
        ),
        (
            "von Mises",
            f"{head['surface_von_mises_MPa']:.2f} MPa on the surface "
            f"({head['surface_von_mises_MPa'] / pressure:.4f} p0), at most "
            f"{head['depth_von_mises_MPa']:.2f} MPa ({head['depth_von_mises_MPa'] / pressure:.4f} p0), "
            f"{head['depth_of_von_mises_mm']:.5f} mm below",
        ),
        (
            "Shear",
            f"at most {head['greatest_shear_MPa']:.2f} MPa "
            f"({head['greatest_shear_MPa'] / pressure:.4f} p0), {head['depth_of_shear_mm']:.5f} mm below",
        ),
        ("File", _file(head.get("axis_file"))),
        ("Teeth", "" if ratio is None else f"contact ratio {ratio:.6f} without profile shift"),
    ]
    return [row(label, text) for label, text in lines if text]


def _file(found: Mapping[str, float] | None) -> str:
    if found is None:
        return ""
    return (
        f"axis_file: von Mises at most {found['depth_von_mises_MPa']:.2f} MPa, "
        f"{found['depth_of_von_mises_mm']:.5f} mm below ({found['depth_error_percent']:+.2f} %)"
    )


def _combinations(check: HertzCheck, rows: Rows) -> list[str]:
    head = f"{'T1, N m':>11s}{'u':>7s}{'b, mm':>8s}{'F_n, N':>13s}{'q, N/mm':>12s}{'rho, mm':>11s}"
    head += f"{'0.418':>9s}{'exact':>9s}"
    shared, known = "shared_contact_stress_MPa" in rows[0], "load_share" in rows[0]
    head += f"{'shared':>9s}" if shared else ""
    lines = [head + (f"{'load x':>9s}" if known else "")]
    for one in rows:
        line = (
            f"{one['torque_N_m']:11g}{one['gear_ratio']:7g}{one['face_width_mm']:8g}"
            f"{one['normal_force_N']:13.3f}{one['load_per_width_N_per_mm']:12.5f}"
            f"{one['reduced_radius_mm']:11.6f}{one['contact_stress_MPa']:9.3f}"
            f"{one['peak_pressure_MPa']:9.3f}"
        )
        line += f"{one['shared_contact_stress_MPa']:9.3f}" if shared else ""
        lines.append(line + (f"{one['load_share']:9.5f}" if known else ""))
    said = "stresses in MPa"
    if shared:
        said += f"; shared: 0.418 with the load over the contact ratio {check.contact_ratio:.4f}"
    if known:
        said += f"; load x: share of the load that gives {check.target:g} MPa"
        nearest = min(rows, key=lambda one: abs(one["contact_stress_MPa"] - check.target))
        said += (
            f"; nearest {nearest['contact_stress_MPa']:.3f} MPa, "
            f"{100.0 * (nearest['contact_stress_MPa'] / check.target - 1.0):+.2f} %"
        )
    return ["  Inputs combined", *lines, row("", said)]


def _changes(check: HertzCheck, rows: Rows) -> list[str]:
    low, high = check.target - ROUNDING, check.target + ROUNDING
    lines = [
        f"  What one key alone must be for {check.target:g} MPa",
        f"    {'key':28s}{'given':>12s}{'needed':>12s}    range for {low:g}-{high:g} MPa",
    ]
    for one in rows:
        if one["needed_value"] is None:
            lines.append(f"    {one['key']:28s}{one['given_value']:12g}{'none':>12s}")
            continue
        ends = [one["least_needed_value"], one["greatest_needed_value"]]
        span = " to ".join("none" if end is None else f"{end:.6g}" for end in ends)
        lines.append(f"    {one['key']:28s}{one['given_value']:12g}{one['needed_value']:12.6g}    {span}")
    return lines


def _comparison(check: HertzCheck, rows: Rows) -> list[str]:
    assert check.comparison is not None
    lines = [
        "  Published comparison, completed",
        f"    {'stress, MPa':12s}{'Hertz':>10s}{'FE':>8s}{'printed, %':>12s}{'of larger':>11s}"
        f"{'of Hertz':>10s}{'of FE':>9s}{'Hertz here':>13s}{'of larger':>11s}",
    ]
    lines += [
        f"    {one['compared_stress']:12s}{one['hertz_MPa']:10.2f}"
        f"{_cell(one['finite_elements_MPa'], 'g'):>8s}"
        f"{_cell(one['printed_difference_percent'], 'g'):>12s}"
        f"{_cell(one['difference_of_larger_percent'], '.2f'):>11s}"
        f"{_cell(one['difference_of_hertz_percent'], '.2f'):>10s}"
        f"{_cell(one['difference_of_finite_elements_percent'], '.2f'):>9s}"
        f"{one['computed_MPa']:13.3f}{_cell(one['computed_difference_percent'], '.3f'):>11s}"
        for one in rows
    ]
    said = [_convention(check.comparison.references, rows)]
    for one in rows:
        name, found = one["compared_stress"], one["lost_stress_MPa"]
        lost = check.comparison.columns[name]
        if math.isnan(lost.printed_percent) or not (found or math.isnan(lost.finite_elements)):
            continue
        values = ", ".join(str(value) for value in found) or "no whole value"
        said.append(
            f"the lost finite-element cell of {name}: {values} MPa has the printed {lost.printed_percent:g} %"
        )
    return [*lines, row("", "; ".join(text for text in said if text))]


def _convention(references: Sequence[str], rows: Rows) -> str:
    if all(one["printed_difference_percent"] is None for one in rows):
        return ""
    named = " or ".join(_REFERENCES[name] for name in references)
    return f"the printed differences are relative to {named}" if named else ""


def _cell(value: float | None, form: str) -> str:
    return "-" if value is None else format(value, form)


def _meshes(rows: Rows) -> list[str]:
    lines = [
        "  Finite elements here, error against the closed forms",
        f"    {'per a':>5s}{'unknowns':>10s}{'p0, MPa':>11s}{'error':>9s}{'a':>9s}{'surface':>10s}"
        f"{'error':>9s}{'below':>10s}{'error':>9s}{'time':>9s}",
    ]
    lines += [
        f"    {one['elements_per_half_width']:5d}{one['unknowns']:10d}{one['peak_pressure_MPa']:11.3f}"
        f"{one['peak_pressure_error_percent']:+7.2f} %{one['half_width_error_percent']:+7.2f} %"
        f"{one['surface_von_mises_MPa']:10.2f}{one['surface_error_percent']:+7.2f} %"
        f"{one['depth_von_mises_MPa']:10.2f}{one['depth_error_percent']:+7.2f} %"
        f"{one['time_s']:7.1f} s"
        for one in rows
    ]
    said = "per a: number of elements along the half-width a; surface and below: von Mises in MPa"
    return [*lines, row("", said)]
