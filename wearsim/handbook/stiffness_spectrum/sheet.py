"""The spectrum of a mesh stiffness: text, tables and warnings."""

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from wearsim.handbook.stiffness_spectrum.keys import StiffnessSpectrumTables
from wearsim.handbook.stiffness_spectrum.mesh_statics import MeshStatics
from wearsim.handbook.stiffness_spectrum.model import SpectrumLine, StiffnessSpectrum
from wearsim.quantities import grouped
from wearsim.report.calculation_sheet import CalculationSheet
from wearsim.report.text_lines import numbered_assumptions, row, table_lines

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

_COUNTED = {
    "pairs": "only teeth that mate touch, and only while both are in their pulses of contact",
    "double_sum": "every tooth in its pulse touches every such tooth of the other wheel, as the source "
    "sums: two pairs in mesh count as four contacts",
}
_ASSUMPTIONS = (
    "a pitch error moves the pulse of its tooth but changes neither its length nor the load sharing",
    "the teeth are standard spur teeth without profile shift, in contact between the tip circles",
    "two-sided is |S| of exp(2 pi j f t), one-sided the amplitude 2|S| of the cosine",
)


def stiffness_spectrum_sheet(
    tables: StiffnessSpectrumTables, spectrum: StiffnessSpectrum
) -> CalculationSheet:
    """Return what ``wearsim stiffness-spectrum`` shows."""
    lines = [_row(line, spectrum) for line in spectrum.lines]
    content: dict[str, Any] = {
        "title": tables.title,
        "contact_ratio": spectrum.pair.contact_ratio,
        "model": tables.spectrum.model,
        "mesh_frequency_Hz": _plain(spectrum.mesh_frequency),
        "mean_contacts": spectrum.contacts.mean,
        "series_mean_contacts": _plain(spectrum.series_mean),
        "variance_share": spectrum.variance_share,
        "lines": lines,
    }
    rows = {"lines": lines}
    if spectrum.statics is not None:
        content["statics"] = _statics(spectrum.statics)
        rows["statics"] = content["statics"]["deflections"]

    def _made() -> dict[str, "pd.DataFrame"]:
        import pandas as pd

        return {name: pd.DataFrame(found) for name, found in rows.items()}

    def _drawn() -> dict[str, "Figure"]:
        from wearsim.handbook.stiffness_spectrum.figure import stiffness_spectrum_figure

        return {"stiffness_spectrum": stiffness_spectrum_figure(tables.title, spectrum)}

    return CalculationSheet(
        text=_text(tables, spectrum),
        content=content,
        tables=_made,
        figures=_drawn,
        warnings=tuple(_warnings(tables, spectrum)),
    )


def _plain(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _row(line: SpectrumLine, spectrum: StiffnessSpectrum) -> dict[str, Any]:
    order = line.harmonic / spectrum.pair.meshes
    harmonic, pinion, wheel = line.combinations[0]
    return {
        "line": line.name,
        "line_family": line.family,
        "tooth_harmonic": harmonic,
        "pinion_sideband": pinion,
        "wheel_sideband": wheel,
        "mesh_order": order,
        "frequency_Hz": _plain(order * spectrum.mesh_frequency),
        "two_sided_coefficient": line.two_sided,
        "one_sided_amplitude": line.one_sided,
        "series_one_sided_amplitude": _plain(line.series),
        "stiffness_one_sided_amplitude_N_per_mm": _plain(line.stiffness),
    }


def _statics(statics: MeshStatics) -> dict[str, Any]:
    columns = (statics.contacts, statics.deflections, statics.stiffnesses)
    return {
        "force_N": statics.force,
        "mean_stiffness_N_per_mm": statics.stiffness.mean,
        "deflections": [
            {"contacts": n, "deflection_mm": delta, "stiffness_N_per_mm": stiffness}
            for n, delta, stiffness in zip(*(c.tolist() for c in columns), strict=True)
        ],
    }


def _text(tables: StiffnessSpectrumTables, spectrum: StiffnessSpectrum) -> str:
    pair, contacts = spectrum.pair, spectrum.contacts
    mean = f"{contacts.mean:.6g} contacts"
    if math.isfinite(spectrum.series_mean):
        mean += f" (closed form {spectrum.series_mean:.6g})"
    shown = tables.spectrum.lines_shown
    strongest = sorted(spectrum.lines, key=lambda line: -line.two_sided)[:shown]
    period = f"{pair.pinion_turns} turns of the pinion, {pair.wheel_turns} of the wheel"
    frequency = spectrum.mesh_frequency
    rows = [
        row("Contact", f"ratio {pair.contact_ratio:.6g}; mean {mean}; model {tables.spectrum.model}"),
        row("Period", f"{period}, {pair.meshes} meshes"),
        *(
            [row("Frequency", _frequencies(pair.pinion.teeth, pair.wheel.teeth, frequency))]
            if math.isfinite(frequency)
            else []
        ),
        row(
            "Lines",
            f"the {len(strongest)} strongest of {len(spectrum.lines)}; all of them hold "
            f"{100.0 * spectrum.variance_share:.3g} % of the variance of the contacts",
        ),
    ]
    assumed = numbered_assumptions((_COUNTED[tables.spectrum.model], *_ASSUMPTIONS))
    statics = [] if spectrum.statics is None else ["", *_statics_text(spectrum.statics)]
    return "\n".join(
        [tables.title, *rows, "", *_table(strongest, spectrum), *statics, "", row("Assumes", assumed)]
    )


def _frequencies(pinion_teeth: int, wheel_teeth: int, frequency: float) -> str:
    turns = f"f1 = {frequency / pinion_teeth:.5g} Hz, f2 = {frequency / wheel_teeth:.5g} Hz"
    return f"fz = {frequency:.5g} Hz; {turns}"


def _table(lines: list[SpectrumLine], spectrum: StiffnessSpectrum) -> list[str]:
    """Give the lines in the order of their frequency, with the columns that there are."""
    columns: dict[str, Any] = {
        "line": lambda line: line.short_name,
        "f/fz": lambda line: f"{line.harmonic / spectrum.pair.meshes:.5f}",
    }
    if math.isfinite(spectrum.mesh_frequency):
        hertz = spectrum.mesh_frequency / spectrum.pair.meshes
        columns["f, Hz"] = lambda line: f"{line.harmonic * hertz:.2f}"
    columns["two-sided"] = lambda line: f"{line.two_sided:.4e}"
    columns["one-sided"] = lambda line: f"{line.one_sided:.4e}"
    if math.isfinite(spectrum.series_mean):
        columns["closed form"] = lambda line: f"{line.series:.4e}"
    if spectrum.statics is not None:
        columns["C one-sided, N/mm"] = lambda line: f"{line.stiffness:.4g}"
    ordered = sorted(lines, key=lambda line: line.harmonic)
    cells = [[name, *(show(line) for line in ordered)] for name, show in columns.items()]
    return table_lines(zip(*cells, strict=True), words=1)


def _statics_text(statics: MeshStatics) -> list[str]:
    law = f"{statics.constant:.6g} N/mm^{statics.exponent - 1.0:g}"
    lines = [f"{'contacts N':12s}{'deflection, mm':>16s}{'stiffness, N/mm':>18s}"]
    found = zip(statics.contacts, statics.deflections, statics.stiffnesses, strict=True)
    lines += [f"{n:<12g}{delta:16.6g}{stiffness:18.6g}" for n, delta, stiffness in found]
    return [
        row("Load", f"{grouped(statics.force, 6)} N along the common normal; one contact has B = {law}"),
        row("Stiffness", f"mean {grouped(statics.stiffness.mean, 6)} N/mm"),
        "",
        *lines,
    ]


def _warnings(tables: StiffnessSpectrumTables, spectrum: StiffnessSpectrum) -> list[str]:
    warnings = []
    if spectrum.beyond_involute:
        warnings.append(
            f"the tips of the {spectrum.beyond_involute} reach beyond the involute of the mate: the "
            "contact ratio counts a path that is not there; take more teeth or a larger pressure_angle_deg"
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
            f"2.5; with {given['energy_exponent']:g} it is only a number"
        )
    formula = tables.spectrum.formula or "corrected"
    if formula != "corrected":
        worst = max(spectrum.lines, key=lambda line: abs(line.series - line.one_sided))
        warnings.append(
            f"formula = {formula}: the closed form gives {worst.series:.4g} at {worst.short_name}, where "
            f"{worst.one_sided:.4g} is exact"
        )
    return warnings
