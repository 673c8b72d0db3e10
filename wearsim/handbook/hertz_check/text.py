"""Contact stress at the pitch point against published ones, in words."""

import math
from collections.abc import Mapping
from typing import Any

from wearsim.handbook.hertz_check.model import Comparison, ComparisonColumn, HertzCheck
from wearsim.handbook.hertz_check.pitch_point_contact import PitchPointContact
from wearsim.report.answer_table import AnswerTable
from wearsim.report.text_lines import row

_REFERENCES = {"larger": "the larger of the two", "hertz": "Hertz", "finite_elements": "the finite elements"}

ASSUMPTIONS = (
    "one pair of teeth carries the whole load at the pitch point, evenly along the face",
    "the teeth are smooth elastic cylinders in plane strain; friction is left out (it changes nothing "
    "where both bodies have the same elastic constants)",
)


def hertz_check_text(
    title: str, check: HertzCheck, head: Mapping[str, Any], tables: Mapping[str, AnswerTable[Any]]
) -> str:
    """Return what ``wearsim handbook hertz-check`` prints."""
    said = {"combinations": _combinations, "changes": _changes, "comparison": _comparison, "meshes": _meshes}
    blocks = [[title, *_contact(check, head)]]
    blocks += [said[name](check, table) for name, table in tables.items()]
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
            f"({head['surface_von_mises_MPa'] / pressure:.4f} p0), maximum "
            f"{head['depth_von_mises_MPa']:.2f} MPa ({head['depth_von_mises_MPa'] / pressure:.4f} p0) "
            f"at a depth of {head['depth_of_von_mises_mm']:.5f} mm",
        ),
        (
            "Shear",
            f"maximum {head['greatest_shear_MPa']:.2f} MPa "
            f"({head['greatest_shear_MPa'] / pressure:.4f} p0) "
            f"at a depth of {head['depth_of_shear_mm']:.5f} mm",
        ),
        ("File", _file(head.get("axis_file"))),
        ("Teeth", "" if ratio is None else f"contact ratio {ratio:.6f} without profile shift"),
    ]
    return [row(label, text) for label, text in lines if text]


def _file(found: Mapping[str, float] | None) -> str:
    if found is None:
        return ""
    return (
        f"axis_file: maximum von Mises stress {found['depth_von_mises_MPa']:.2f} MPa "
        f"at a depth of {found['depth_of_von_mises_mm']:.5f} mm ({found['depth_error_percent']:+.2f} %)"
    )


def _combinations(check: HertzCheck, table: AnswerTable[PitchPointContact]) -> list[str]:
    said = "stresses in MPa"
    if not math.isnan(check.contact_ratio):
        said += f"; shared: 0.418, load divided by the contact ratio {check.contact_ratio:.4f}"
    if not math.isnan(check.target):
        said += f"; load x: factor on the load that gives {check.target:g} MPa"
        stresses = [one.printed_stress for one in table.rows]
        nearest = min(stresses, key=lambda stress: abs(stress - check.target))
        said += f"; nearest {nearest:.3f} MPa, {100.0 * (nearest / check.target - 1.0):+.2f} %"
    return ["  Combinations of inputs", *table.lines(""), row("", said)]


def _changes(check: HertzCheck, table: AnswerTable[Any]) -> list[str]:
    return [f"  Value of one key, all others unchanged, for {check.target:g} MPa", *table.lines("    ")]


def _comparison(check: HertzCheck, table: AnswerTable[tuple[str, ComparisonColumn]]) -> list[str]:
    assert check.comparison is not None
    said = [_convention(check.comparison)]
    for name, column in table.rows:
        if math.isnan(column.printed_percent) or not (
            column.candidates or math.isnan(column.finite_elements)
        ):
            continue
        values = ", ".join(map(str, column.candidates)) or "no whole value"
        said.append(
            f"missing finite-element value for {name}: {values} MPa gives the printed "
            f"{column.printed_percent:g} %"
        )
    lines = table.lines("    ")
    return ["  Published comparison, completed", *lines, row("", "; ".join(filter(None, said)))]


def _convention(comparison: Comparison) -> str:
    if all(math.isnan(column.printed_percent) for column in comparison.columns.values()):
        return ""
    named = " or ".join(_REFERENCES[name] for name in comparison.references)
    return f"the printed differences are relative to {named}" if named else ""


def _meshes(_: HertzCheck, table: AnswerTable[Any]) -> list[str]:
    said = "per a: number of elements along the half-width a; surface and below: von Mises in MPa"
    title = "  Finite elements here, error against the closed forms"
    return [title, *table.lines("    "), row("", said)]
