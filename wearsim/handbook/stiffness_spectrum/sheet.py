"""The spectrum of a mesh stiffness: text, tables and warnings."""

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from wearsim.handbook.stiffness_spectrum.keys import StiffnessSpectrumTables
from wearsim.handbook.stiffness_spectrum.mesh_statics import MeshStatics
from wearsim.handbook.stiffness_spectrum.model import SpectrumLine, StiffnessSpectrum
from wearsim.quantities import grouped
from wearsim.report.answer_table import AnswerTable, Column, plain
from wearsim.report.calculation_sheet import CalculationSheet
from wearsim.report.text_lines import Finding, answer_text

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_COUNTED = {
    "pairs": "only mating teeth touch, and only while the contact intervals of both overlap",
    "double_sum": "as in the source, every tooth in its contact interval touches every such tooth of the "
    "other gear: two pairs in mesh count as four contacts",
}
_ASSUMPTIONS = (
    "a pitch error shifts the contact of its tooth but changes neither its length nor the load sharing",
    "the teeth are standard spur teeth without profile shift, in contact between the tip circles",
    "two-sided is |S| of exp(2 pi j f t), one-sided the amplitude 2|S| of the cosine",
)


def stiffness_spectrum_sheet(given: StiffnessSpectrumTables, spectrum: StiffnessSpectrum) -> CalculationSheet:
    """Return what ``wearsim handbook stiffness-spectrum`` shows."""
    tables: dict[str, AnswerTable[Any]] = {"lines": _lines_table(spectrum, spectrum.lines)}
    content: dict[str, Any] = {
        "title": given.title,
        "contact_ratio": spectrum.pair.contact_ratio,
        "model": given.spectrum.model,
        "mesh_frequency_Hz": plain(spectrum.mesh_frequency),
        "mean_contacts": spectrum.contacts.mean,
        "series_mean_contacts": plain(spectrum.series_mean),
        "variance_share": spectrum.variance_share,
        "lines": tables["lines"].records(),
        "assumptions": [_COUNTED[given.spectrum.model], *_ASSUMPTIONS],
    }
    if spectrum.statics is not None:
        tables["statics"] = _deflections(spectrum.statics)
        content["statics"] = {
            "force_N": spectrum.statics.force,
            "mean_stiffness_N_per_mm": spectrum.statics.stiffness.mean,
            "deflections": tables["statics"].records(),
        }

    def _drawn() -> dict[str, "Figure"]:
        from wearsim.handbook.stiffness_spectrum.figure import stiffness_spectrum_figure

        return {"stiffness_spectrum": stiffness_spectrum_figure(given.title, spectrum)}

    return CalculationSheet(
        text=_text(given, spectrum),
        content=content,
        tables=lambda: tables,
        figures=_drawn,
        warnings=tuple(_warnings(given, spectrum)),
    )


def _lines_table(spectrum: StiffnessSpectrum, lines: Sequence[SpectrumLine]) -> AnswerTable[SpectrumLine]:
    """Return a row for each line; on the screen with the columns that there are."""
    meshes, frequency = spectrum.pair.meshes, spectrum.mesh_frequency
    hertz = "f, Hz" if math.isfinite(frequency) else None
    closed = "closed form" if math.isfinite(spectrum.series_mean) else None
    stiffness = None if spectrum.statics is None else "C one-sided, N/mm"
    return AnswerTable(
        [
            Column("line", lambda one: one.name),
            Column("", lambda one: one.short_name, "line", side="<"),
            Column("line_family", lambda one: one.family),
            Column("tooth_harmonic", lambda one: one.combinations[0][0]),
            Column("pinion_sideband", lambda one: one.combinations[0][1]),
            Column("wheel_sideband", lambda one: one.combinations[0][2]),
            Column("mesh_order", lambda one: one.harmonic / meshes, "f/fz", "{:.5f}"),
            Column("frequency_Hz", lambda one: one.harmonic / meshes * frequency, hertz, "{:.2f}"),
            Column("two_sided_coefficient", lambda one: one.two_sided, "two-sided", "{:.4e}"),
            Column("one_sided_amplitude", lambda one: one.one_sided, "one-sided", "{:.4e}"),
            Column("series_one_sided_amplitude", lambda one: one.series, closed, "{:.4e}"),
            Column("stiffness_one_sided_amplitude_N_per_mm", lambda one: one.stiffness, stiffness, "{:.4g}"),
        ],
        lines,
    )


def _deflections(statics: MeshStatics) -> AnswerTable[tuple[float, float, float]]:
    """Return deflection and stiffness by the number of contacts."""
    columns = (statics.contacts, statics.deflections, statics.stiffnesses)
    return AnswerTable(
        [
            Column("contacts", lambda one: one[0], "contacts N", "{:g}", "<12"),
            Column("deflection_mm", lambda one: one[1], "deflection, mm", "{:.6g}", ">16"),
            Column("stiffness_N_per_mm", lambda one: one[2], "stiffness, N/mm", "{:.6g}", ">18"),
        ],
        list(zip(*(column.tolist() for column in columns), strict=True)),
    )


def _text(tables: StiffnessSpectrumTables, spectrum: StiffnessSpectrum) -> str:
    pair, contacts = spectrum.pair, spectrum.contacts
    mean = f"{contacts.mean:.6g} contacts"
    if math.isfinite(spectrum.series_mean):
        mean += f" (closed form {spectrum.series_mean:.6g})"
    shown = tables.spectrum.lines_shown
    strongest = sorted(spectrum.lines, key=lambda line: -line.two_sided)[:shown]
    period = f"{pair.pinion_turns} revolutions of the pinion, {pair.wheel_turns} of the wheel"
    frequency = spectrum.mesh_frequency
    rows = [
        Finding("Contact", f"ratio {pair.contact_ratio:.6g}; mean {mean}; model {tables.spectrum.model}"),
        Finding("Period", f"{period}, {pair.meshes} meshes"),
        *(
            [Finding("Frequency", _frequencies(pair.pinion.teeth, pair.wheel.teeth, frequency))]
            if math.isfinite(frequency)
            else []
        ),
        Finding(
            "Lines",
            f"the {len(strongest)} strongest of {len(spectrum.lines)}; all lines contain "
            f"{100.0 * spectrum.variance_share:.3g} % of the variance of the number of contacts",
        ),
    ]
    ordered = _lines_table(spectrum, sorted(strongest, key=lambda line: line.harmonic))
    statics = [] if spectrum.statics is None else ["", *_statics_parts(spectrum.statics)]
    return answer_text(tables.title, *rows, "", *ordered.lines(""), *statics)


def _frequencies(pinion_teeth: int, wheel_teeth: int, frequency: float) -> str:
    turns = f"f1 = {frequency / pinion_teeth:.5g} Hz, f2 = {frequency / wheel_teeth:.5g} Hz"
    return f"fz = {frequency:.5g} Hz; {turns}"


def _statics_parts(statics: MeshStatics) -> list[object]:
    law = f"{statics.constant:.6g} N/mm^{statics.exponent - 1.0:g}"
    force = f"{grouped(statics.force, 6)} N along the common normal; one contact has B = {law}"
    return [
        Finding("Load", force),
        Finding("Stiffness", f"mean {grouped(statics.stiffness.mean, 6)} N/mm"),
        "",
        *_deflections(statics).lines(""),
    ]


def _warnings(tables: StiffnessSpectrumTables, spectrum: StiffnessSpectrum) -> list[str]:
    warnings = []
    if spectrum.beyond_involute:
        warnings.append(
            f"the tips of the {spectrum.beyond_involute} reach beyond the involute of the mate: the "
            "contact ratio includes a path that does not exist; use more teeth or a larger pressure_angle_deg"
        )
    free = float(spectrum.contacts.widths[spectrum.contacts.values == 0.0].sum()) / math.tau
    if free > 0.0:
        warnings.append(
            f"no teeth touch for {100.0 * free:.3g} % of the time: lower pitch_error_mm for gears that "
            "carry a load"
        )
    given: Mapping[str, Any] = {} if tables.statics is None else tables.statics.model_dump()
    if given.get("energy_exponent", 2.5) != 2.5:
        warnings.append(
            "energy_exponent: radii and modulus give the constant of a point contact, whose exponent is "
            f"2.5; with {given['energy_exponent']:g} the constant has no physical meaning"
        )
    formula = tables.spectrum.formula or "corrected"
    if formula != "corrected":
        worst = max(spectrum.lines, key=lambda line: abs(line.series - line.one_sided))
        warnings.append(
            f"formula = {formula}: the closed form gives {worst.series:.4g} at {worst.short_name}, where "
            f"{worst.one_sided:.4g} is exact"
        )
    return warnings
