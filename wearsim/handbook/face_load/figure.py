"""The picture of a face load: over the face, and its factor over the hours."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from wearsim.handbook.face_load.face_wear import FaceState
from wearsim.handbook.face_load.model import FaceLoad


def face_load_figure(title: str, found: FaceLoad) -> Figure:
    """Return the load over the face, and the face load factor over the hours."""
    figure = Figure(figsize=(9.0, 4.4), layout="constrained")
    face, time = figure.subplots(1, 2)
    fixed, aligning = found.fixed.states, found.self_aligning.states
    for state, label, colour, style in (
        (fixed[0], "fixed pinion, new", "tab:red", "-"),
        (fixed[2], "fixed pinion, run in", "tab:blue", "-"),
        (aligning[0], "self-aligning pinion, new", "tab:green", "--"),
    ):
        _draw_load(face, found, state, label, colour, style)
    face.axhline(1.0, color="0.5", linewidth=0.8)
    face.set_xlabel("position from mid-face, mm")
    face.set_ylabel("load per width over its mean")
    face.set_ylim(bottom=0.0)
    face.set_title("lines: maximum over all meshes; bands: down to the minimum", fontsize=8, loc="left")
    for run, label, colour, style in (
        (found.fixed, "fixed pinion", "tab:blue", "-"),
        (found.self_aligning, "self-aligning pinion", "tab:green", "--"),
    ):
        time.plot(run.hours[1:], run.factors[1:], style, color=colour, label=label)
    time.axvline(fixed[1].hours, ymax=0.74, color="0.5", linewidth=0.8, linestyle=":", label="given time")
    time.set_xscale("log")
    time.set_xlabel("running time, h")
    time.set_ylabel(r"face load factor $K_{H\beta}$")
    time.set_ylim(bottom=0.95)
    for panel in (face, time):
        panel.grid(alpha=0.3)
        low, high = panel.get_ylim()
        panel.set_ylim(low, high + 0.35 * (high - low))
        panel.legend(loc="upper right", frameon=False, fontsize=8)
    figure.suptitle(title, fontsize=9, x=0.01, ha="left")
    return figure


def _draw_load(panel: Axes, found: FaceLoad, state: FaceState, label: str, colour: str, style: str) -> None:
    over_mean = state.loads / found.mesh.mean_load
    least, greatest = over_mean.min(axis=0), over_mean.max(axis=0)
    panel.plot(found.mesh.position, greatest, style, color=colour, label=label)
    if not np.array_equal(least, greatest):
        panel.fill_between(found.mesh.position, least, greatest, color=colour, alpha=0.12, lw=0)
