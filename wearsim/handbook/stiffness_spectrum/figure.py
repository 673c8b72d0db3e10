"""The picture of a stiffness spectrum: contacts over the turn, the lines, those about fz."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from wearsim.handbook.stiffness_spectrum.contact_number import StepFunction
from wearsim.handbook.stiffness_spectrum.model import SpectrumLine, StiffnessSpectrum
from wearsim.report.text_lines import literal

_COLOURS = {
    "mesh": ("black", "tooth frequency"),
    "pinion": ("tab:blue", "turns of the pinion"),
    "wheel": ("tab:orange", "turns of the wheel"),
    "both": ("tab:green", "both"),
}
_MESHES_SHOWN = 8
_DEEPEST = 1e-4
"""Of the strongest line: what is weaker is not drawn."""


def stiffness_spectrum_figure(title: str, spectrum: StiffnessSpectrum) -> Figure:
    """Return three panels."""
    figure = Figure(figsize=(7.4, 8.2))
    place = {"left": 0.1, "right": 0.92, "bottom": 0.06, "top": 0.93, "hspace": 0.38}
    steps, lines, about = figure.subplots(3, 1, height_ratios=(0.8, 1.2, 1.2), gridspec_kw=place)
    _draw_steps(steps, spectrum)
    strongest = max(line.one_sided for line in spectrum.lines)
    drawn = [line for line in spectrum.lines if line.one_sided > _DEEPEST * strongest]
    near = [line for line in drawn if abs(_order(line, spectrum) - 1.0) < 0.55]
    for panel, some, top in ((lines, drawn, 4.0), (about, near, 30.0)):
        _draw_lines(panel, some, spectrum)
        panel.set_ylim(0.5 * _DEEPEST * strongest, top * strongest)
    reach = 1.2 * max(0.1, *(abs(_order(line, spectrum) - 1.0) for line in near))
    _write_names(about, near, spectrum, 0.03 * reach)
    about.set_xlim(1.0 - reach, 1.0 + reach)
    lines.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=5, frameon=False, fontsize=8)
    figure.suptitle(literal(title), fontsize=9, y=0.985)
    return figure


def _write_names(
    panel: Axes, lines: list[SpectrumLine], spectrum: StiffnessSpectrum, distance: float
) -> None:
    """Name the strongest lines that are so far apart that their names do not touch."""
    named: list[float] = []
    for line in sorted(lines, key=lambda line: -line.one_sided):
        x = _order(line, spectrum)
        if all(abs(x - other) > distance for other in named):
            named.append(x)
            panel.annotate(
                line.short_name,
                (x, line.one_sided),
                (0, 5),
                textcoords="offset points",
                ha="center",
                va="bottom",
                fontsize=6.5,
                rotation=90,
            )


def _order(line: SpectrumLine, spectrum: StiffnessSpectrum) -> float:
    return line.harmonic / spectrum.pair.meshes


def _draw_steps(panel: Axes, spectrum: StiffnessSpectrum) -> None:
    count = min(_MESHES_SHOWN, spectrum.pair.meshes)
    for function, colour, width, label in (
        (spectrum.ideal, "0.7", 3.0, "without errors"),
        (spectrum.contacts, "tab:red", 1.2, "with pitch errors"),
    ):
        x, y = _stairs(function, count / spectrum.pair.meshes)
        panel.step(x * spectrum.pair.meshes, y, where="post", color=colour, linewidth=width, label=label)
    values = np.unique(spectrum.contacts.values)
    panel.set_xlim(0.0, count)
    panel.set_ylim(values[0] - 0.4, values[-1] + 0.4)
    panel.set_yticks(values)
    panel.set_ylabel("contacts")
    panel.set_xlabel("tooth periods")
    panel.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, frameon=False, fontsize=8)
    if spectrum.statics is not None:
        side = panel.secondary_yaxis("right")
        statics = spectrum.statics
        shown = np.isin(statics.contacts, values)
        kilo = [f"{1e-3 * value:.0f}" for value in statics.stiffnesses[shown]]
        side.set_yticks(statics.contacts[shown], kilo)
        side.set_ylabel("stiffness, kN/mm")


def _stairs(function: StepFunction, end: float) -> tuple[np.ndarray, np.ndarray]:
    """Return edges as parts of the period, and values, from 0 to the end."""
    edges = function.edges / (2.0 * np.pi)
    inside = edges[(edges > 0.0) & (edges < end)]
    x = np.concatenate(([0.0], inside, [end]))
    return x, function.at(2.0 * np.pi * (x + 1e-9))


def _draw_lines(panel: Axes, lines: list[SpectrumLine], spectrum: StiffnessSpectrum) -> None:
    for family, (colour, label) in _COLOURS.items():
        some = [line for line in lines if line.family == family]
        if not some:
            continue
        x = [_order(line, spectrum) for line in some]
        y = [line.one_sided for line in some]
        panel.vlines(x, 1e-12, y, color=colour, linewidth=1.2)
        panel.plot(x, y, "o", color=colour, markersize=3.5, label=label)
    if np.isfinite(spectrum.series_mean):
        panel.plot(
            [_order(line, spectrum) for line in lines],
            [line.series for line in lines],
            "x",
            color="tab:red",
            markersize=6,
            label="closed form",
        )
    panel.set_yscale("log")
    panel.set_ylabel("one-sided amplitude, contacts")
    known = np.isfinite(spectrum.mesh_frequency)
    hertz = f" of {spectrum.mesh_frequency:.5g} Hz" if known else ""
    panel.set_xlabel(f"frequency over the tooth frequency{hertz}")
    panel.grid(axis="y", alpha=0.3)
