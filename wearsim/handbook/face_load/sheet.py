"""The load along the face of a wide pair: text, tables and picture."""

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from wearsim.handbook.face_load.face_slices import equivalent_misalignment
from wearsim.handbook.face_load.face_wear import FaceRunningIn, FaceState
from wearsim.handbook.face_load.model import FaceLoad
from wearsim.quantities import grouped
from wearsim.report.answer_table import plain
from wearsim.report.calculation_sheet import CalculationSheet
from wearsim.report.text_lines import Finding, answer_text

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

_ASSUMPTIONS = (
    "the equations are a reconstruction: only the abstract of Vinogradov and Fedin (2015) survives",
    "the slices of the face lie on an elastic foundation and are not coupled (ISO 6336-1 method C); "
    "the gap is that under load and includes the deflection of shafts and bodies",
    "wear follows Archard's law with one mean slip over the tooth height; every tooth of the "
    "pinion meets every tooth of the wheel",
)

_FEWEST_SLICES = 10
"""With fewer the load at an edge is off by more than about 1 %."""

_NAMES = {"fixed": "fixed", "self_aligning": "self-aligning"}
_STATES = {"new": "new", "after": "after", "run_in": "run in"}


def face_load_sheet(title: str, found: FaceLoad, defaults: Sequence[str]) -> CalculationSheet:
    """Return what ``wearsim handbook face-load`` shows."""
    assumptions = (*_ASSUMPTIONS, _pivot(found), *defaults)
    warnings = _warnings(found)
    states = [_state_row(found, name, state) for name, run in _runs(found) for state in run.states]
    history = [
        {"pinion_mounting": name, "time_hours": hours, "face_load_factor": factor}
        for name, run in _runs(found)
        for hours, factor in zip(run.hours.tolist(), run.factors.tolist(), strict=True)
    ]
    content = {
        "title": title,
        "mean_load_per_width_N_per_mm": found.mesh.mean_load,
        "fixed_running_in_hours": found.fixed_hours,
        "varying_running_in_hours": plain(found.varying_hours),
        "states": states,
        "history": history,
        "assumptions": list(assumptions),
        "warnings": warnings,
    }

    def _made() -> dict[str, "pd.DataFrame"]:
        import pandas as pd

        parts = [
            pd.DataFrame(_distribution(found, name, state))
            for name, run in _runs(found)
            for state in run.states
        ]
        return {
            "states": pd.DataFrame(states),
            "distribution": pd.concat(parts),
            "history": pd.DataFrame(history),
        }

    def _drawn() -> dict[str, "Figure"]:
        from wearsim.handbook.face_load.figure import face_load_figure

        return {"face_load": face_load_figure(title, found)}

    return CalculationSheet(
        text=_text(title, found, states),
        content=content,
        tables=_made,
        figures=_drawn,
        warnings=tuple(warnings),
    )


def _pivot(found: FaceLoad) -> str:
    follows = "only the mean gap" if found.lever is None else "every mesh beyond its friction"
    return f"starts and load changes bring a self-aligning pinion into balance; it then follows {follows}"


def _runs(found: FaceLoad) -> Iterator[tuple[str, FaceRunningIn]]:
    yield "fixed", found.fixed
    yield "self_aligning", found.self_aligning


def _loaded_share(found: FaceLoad, state: FaceState) -> float:
    """Part of the face that carries load in the mesh where that is least."""
    return float(((state.loads > 0.0) @ found.mesh.width).min()) / found.mesh.face_width


def _state_row(found: FaceLoad, name: str, state: FaceState) -> dict[str, Any]:
    return {
        "pinion_mounting": name,
        "face_state": state.name,
        "time_hours": state.hours,
        "face_load_factor": state.factor,
        "equivalent_misalignment_um": 1e3 * equivalent_misalignment(found.mesh, state.factor),
        "loaded_share": _loaded_share(found, state),
        "greatest_opening_mm": float(state.opening.max()),
    }


def _distribution(found: FaceLoad, name: str, state: FaceState) -> dict[str, Any]:
    return {
        "pinion_mounting": name,
        "face_state": state.name,
        "face_position_mm": found.mesh.position,
        "load_per_width_N_per_mm": found.share @ state.loads,
        "least_load_per_width_N_per_mm": state.loads.min(axis=0),
        "greatest_load_per_width_N_per_mm": state.loads.max(axis=0),
        "opening_mm": state.opening,
    }


def _text(title: str, found: FaceLoad, states: Sequence[dict[str, Any]]) -> str:
    mesh = found.mesh
    load = (
        f"{grouped(mesh.mean_load)} N/mm over {grouped(mesh.face_width)} mm; stiffness "
        f"{mesh.stiffness / 1e3:g} N/(mm um)"
    )
    lines = [
        f"  {'pinion':15s}{'state':10s}{'hours':>9s}{'K_Hbeta':>10s}{'equiv. F_beta, um':>19s}"
        f"{'loaded':>9s}{'wear, mm':>10s}"
    ]
    lines += [
        f"  {_NAMES[one['pinion_mounting']]:15s}{_STATES[one['face_state']]:10s}"
        f"{grouped(one['time_hours']):>9s}{one['face_load_factor']:10.3f}"
        f"{one['equivalent_misalignment_um']:19.1f}{one['loaded_share']:9.0%}"
        f"{one['greatest_opening_mm']:10.3f}"
        for one in states
    ]
    notes = (
        "K_Hbeta: greatest load per width in any mesh, over the mean; equiv. F_beta: linear gap with the "
        "same factor; loaded: smallest loaded part of the face; wear: greatest depth, both flanks "
        "together"
    )
    head = (title, Finding("Load", load), Finding("Run-in", _running_in(found)))
    return answer_text(*head, "", *lines, "", Finding("Columns", notes))


def _running_in(found: FaceLoad) -> str:
    text = f"constant misalignment falls to 1/e in {grouped(found.fixed_hours)} h"
    if len(found.share) == 1:
        return text
    if math.isinf(found.varying_hours):
        return f"{text}; misalignment that varies from mesh to mesh does not run in"
    return f"{text}, misalignment that rotates with one gear in {grouped(found.varying_hours)} h"


def _warnings(found: FaceLoad) -> list[str]:
    warnings = []
    for name, run in _runs(found):
        new, after, worn = run.states
        pinion = f"{_NAMES[name]} pinion"
        carrying = min(int((state.loads > 0.0).sum(axis=-1).min()) for state in run.states)
        if carrying < _FEWEST_SLICES:
            warnings.append(
                f"{pinion}: in the worst mesh {carrying} slices carry the load, so K_Hbeta is inaccurate: "
                "raise pair.slices"
            )
        if _loaded_share(found, new) < 1.0:
            warnings.append(
                f"{pinion}: only {_loaded_share(found, new):.0%} of the new face carries load in "
                "the worst mesh"
            )
        if after.factor > 1.05 * worn.factor:
            warnings.append(
                f"{pinion}: not yet run in after {grouped(after.hours)} h: K_Hbeta is {after.factor:.3g} "
                f"and tends to {worn.factor:.3g}"
            )
        if not run.settled:
            warnings.append(
                f"{pinion}: still running in after {grouped(worn.hours)} h; run_in is the state at that time"
            )
    lasting = [run.states[-1].factor for _, run in _runs(found)]
    if max(lasting) > 1.2:
        warnings.append(
            f"K_Hbeta stays at {lasting[0]:.3g} with a fixed pinion and at {lasting[1]:.3g} with a "
            "self-aligning one: misalignment that varies from mesh to mesh does not run in"
        )
    return warnings
