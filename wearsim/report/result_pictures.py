"""Pictures of results for a Python session: matplotlib figures that a notebook shows by themselves."""

from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from wearsim.case.model import Case
from wearsim.mechanisms.wrap.tooth_loads import ToothLoads, tooth_loads
from wearsim.notebook import show_after_semicolon
from wearsim.report.figures import depth_figure, draw_worn_flank, flanks_figure, picture_bytes
from wearsim.report.flank_view import at_life, case_of, snapshot
from wearsim.report.text_lines import literal
from wearsim.result import WearResult

_LOAD = "load_per_width_N_per_mm"


def shown(figure: Figure) -> Figure:
    """Return a figure that a notebook shows though pyplot does not know it."""
    vars(figure)["_repr_svg_"] = partial(_svg, figure)
    show_after_semicolon(figure)
    return figure


def _svg(figure: Figure) -> str:
    return picture_bytes(figure, "svg").decode("utf-8")


def flank_picture(results: Sequence[WearResult], axes: Axes | None = None) -> Figure:
    """Return flanks new and worn, that of one result on axes if some are given."""
    if axes is None:
        return shown(flanks_figure(list(results)))
    (result,) = results
    draw_worn_flank(axes, result)
    return _figure_of(axes)


def history_picture(results: Sequence[WearResult]) -> Figure:
    """Return depth, and elongation where there is one, over running time."""
    return shown(depth_figure(list(results)))


def loads_picture(result: WearResult) -> Figure:
    """Return what the teeth of a wrap or the flank of another case carry, new and worn."""
    if "sprocket" in result.parts:
        return tooth_loads_picture({result.title: new_and_grown(case_of(result))})
    figure = Figure(figsize=(7.0, 3.6), layout="constrained")
    panel = figure.subplots()
    _draw_flank_load(panel, result)
    panel.set_title(literal(result.title), fontsize=9, loc="left")
    return shown(figure)


def tooth_loads_picture(loads: Mapping[str, Sequence[ToothLoads]]) -> Figure:
    """Return the forces on the teeth of wraps by their titles, each under one chain or several."""
    figure = Figure(figsize=(7.0, 0.4 + 3.2 * len(loads)), layout="constrained")
    panels = figure.subplots(len(loads), 1, squeeze=False).ravel()
    for panel, (title, found) in zip(panels, loads.items(), strict=True):
        _draw_tooth_loads(panel, found)
        panel.set_title(literal(title), fontsize=9, loc="left")
    return shown(figure)


def new_and_grown(case: Case) -> tuple[ToothLoads, ToothLoads]:
    """Return what teeth carry under a new chain, and under one at its limit of elongation."""
    limit = 0.01 * case.inputs["stop"]["elongation_percent"]
    return tooth_loads(case), tooth_loads(case, limit)


def _draw_tooth_loads(panel: Axes, loads: Sequence[ToothLoads]) -> None:
    width = 0.8 / len(loads)
    for number, found in enumerate(loads):
        teeth = np.arange(1, found.loads.force.size + 1)
        grown = f"chain elongation {100.0 * found.elongation:.3g} %"
        places = teeth + width * (number - 0.5 * (len(loads) - 1))
        panel.bar(places, found.loads.force, width, label=grown if found.elongation else "new chain")
    panel.xaxis.set_major_locator(MaxNLocator(integer=True))
    panel.set_xlabel("tooth, from the tight end")
    panel.set_ylabel("normal force, N")
    panel.grid(axis="y", alpha=0.3)
    panel.legend(title="on new teeth", title_fontsize=8, frameon=False, fontsize=8)


def _draw_flank_load(panel: Axes, result: WearResult) -> None:
    new, worn = snapshot(result, 0), at_life(result)
    panel.plot(new["arc_length_mm"], new[_LOAD], "--", color="0.3", label="new")
    panel.plot(worn["arc_length_mm"], worn[_LOAD], color="tab:red", label="at the end of the life")
    panel.set_xlabel("arc length from the root of the flank, mm")
    panel.set_ylabel("load per width, N/mm")
    panel.set_ylim(bottom=0.0)
    panel.grid(alpha=0.3)
    panel.legend(frameon=False, fontsize=8)


def _figure_of(axes: Axes) -> Figure:
    found = axes.get_figure(root=True)
    assert found is not None
    return found
