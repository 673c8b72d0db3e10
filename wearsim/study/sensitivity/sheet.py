"""What is shown of a sensitivity study: text, JSON, a table and a tornado."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pandas as pd
from matplotlib.figure import Figure

from wearsim._version import ANSWER_HEAD
from wearsim.case.model import Case
from wearsim.quantities import grouped
from wearsim.report.answer_table import AnswerTable, Column, csv_parts
from wearsim.report.figures import number_ticks
from wearsim.report.key_words import key_words
from wearsim.report.study_files import save_figures, save_files
from wearsim.report.text_lines import closing_lists, fenced
from wearsim.runner.design import value_at
from wearsim.runner.scatter import coefficient_key
from wearsim.study.sensitivity.model import HIGH, LOW, KeyEffect, SensitivityStudy

_ALONE = (
    "only wear coefficients scatter, so load, speed and geometry are not compared with them: say in "
    "[uncertainty] how they scatter"
)

_OFFER = "usual scatters to put into the case as a start (10 % of load, 3 % of speed, 2 % of sizes):"

_NO_VALUE = "no feasible value"
_NOT_FELT = "changes the life by less than 1 %"
_NOT_DOUBLED = "values that double the life are not calculated: contact fatigue can change the life abruptly"


@dataclass(frozen=True)
class SensitivityAnswer:
    """What of the input matters."""

    study: SensitivityStudy  # what was asked
    hours: float  # life with every key in its middle [h]
    effects: Sequence[KeyEffect]  # of the keys, the largest first
    doubled: Mapping[str, float]  # values that double the life of the case, nan where none does
    warnings: tuple[str, ...]  # what is doubtful about the indices


def sensitivity_warnings(effects: Sequence[KeyEffect], case: Case) -> tuple[str, ...]:
    """Return what is doubtful about indices."""
    found = (_NOT_DOUBLED,) if case.fatigue is not None else ()
    if only_coefficients(case, [effect.scatter.key for effect in effects]):
        found = (*found, _ALONE)
    loose = [e.scatter.key for e in effects if e.total_error > max(0.1, 0.3 * e.total)]
    # The index of a key that scatters alone is 1 whatever its estimate.
    if not loose or len(effects) == 1:
        return found
    return (*found, f"the indices of {', '.join(loose)} are poorly determined: use more --samples")


def sensitivity_table(answer: SensitivityAnswer) -> AnswerTable[KeyEffect]:
    """Return a row for each key."""
    return AnswerTable(
        [
            Column("key", lambda one: one.scatter.key),
            Column("value", lambda one: one.scatter.value),
            Column("low_life_hours", lambda one: one.low_hours),
            Column("high_life_hours", lambda one: one.high_hours),
            Column("first_order_index", lambda one: one.first),
            Column("first_order_error", lambda one: one.first_error),
            Column("total_index", lambda one: one.total),
            Column("total_error", lambda one: one.total_error),
            Column("morris_mu_star", lambda one: one.morris),
            Column("morris_error", lambda one: one.morris_error),
            Column("morris_sigma", lambda one: one.interaction),
            Column("value_for_double_life", lambda one: answer.doubled[one.scatter.key]),
        ],
        answer.effects,
    )


def sensitivity_text(answer: SensitivityAnswer, explain: bool = False) -> str:
    """Return what matters as text."""
    scattered = answer.study.scattered
    width = max(len(key) for key in scattered.keys)
    lines = [
        scattered.case.title,
        "",
        f"life         {grouped(answer.hours)} h with all inputs at their medians",
    ]
    lines += ["", "part of the variance of ln L, and life with one key low and high (10 and 90 %):"]
    for effect in answer.effects:
        lines.append(
            f"  {effect.scatter.key:<{width}}  total {effect.total:5.2f} +-{effect.total_error:.2f}"
            f"  alone {effect.first:5.2f} +-{effect.first_error:.2f}"
            f"  {grouped(effect.low_hours):>9} to {grouped(effect.high_hours):>9} h"
        )
    lines += ["", "Morris: mean size of the effects on ln L, and their scatter:"]
    for effect in answer.effects:
        lines.append(
            f"  {effect.scatter.key:<{width}}  {effect.morris:6.3f} +-{effect.morris_error:.3f}  scatter "
            f"{effect.interaction:.3f}"
        )
    lines += ["", "value that would double the life, the others unchanged:"]
    for effect in answer.effects:
        value = answer.doubled[effect.scatter.key]
        if not math.isnan(value):
            shown = f"{value:.4g}"
        elif scattered.case.fatigue is not None:
            shown = "not calculated"
        else:
            shown = _NO_VALUE if effect.is_felt else _NOT_FELT
        lines.append(f"  {effect.scatter.key:<{width}}  {effect.scatter.value:.4g} -> {shown}")
    lines += ["", "scattering inputs:"]
    lines += [f"  {scatter.key}: {scatter.text}" for scatter in scattered.scatters]
    assumptions = [*scattered.assumptions, *scattered.case.assumptions]
    lines += closing_lists(assumptions, [*answer.warnings, *scattered.case.warnings], explain)
    if only_coefficients(scattered.case, scattered.keys):
        lines += ["", _OFFER, "", "[uncertainty]", *usual_scatters(scattered.case)]
    return "\n".join(lines)


def sensitivity_json(answer: SensitivityAnswer) -> dict[str, Any]:
    """Return what matters as plain values."""
    scattered = answer.study.scattered
    return {
        **ANSWER_HEAD,
        "case": scattered.case.name,
        "life_hours": answer.hours,
        "seed": answer.study.seed,
        "keys": sensitivity_table(answer).records(),
        "assumptions": [*scattered.assumptions, *scattered.case.assumptions],
        "warnings": [*answer.warnings, *scattered.case.warnings],
    }


def write_sensitivity(answer: SensitivityAnswer, table: pd.DataFrame, folder: Path) -> None:
    """Write tables and the tornado into the folder of a study."""
    texts = {
        "cases.csv": csv_parts(table),
        "sensitivity.csv": sensitivity_table(answer).csv(),
        "summary.md": fenced(sensitivity_text(answer, explain=True)),
    }
    save_files(folder, texts)
    save_figures(folder, answer.study.scattered.case.title, {"tornado": tornado(answer)})


def tornado(answer: SensitivityAnswer) -> Figure:
    """Return the picture of one key at a time, the widest on top."""
    effects = sorted(answer.effects, key=lambda e: abs(math.log(e.high_hours / e.low_hours)))
    figure = Figure(figsize=(7.5, 1.6 + 0.55 * len(effects)), layout="constrained")
    panel = figure.subplots()
    for place, effect in enumerate(effects):
        for hours, colour in ((effect.low_hours, "tab:blue"), (effect.high_hours, "tab:red")):
            panel.barh(place, hours - answer.hours, left=answer.hours, color=colour, height=0.6)
    for share, colour in ((LOW, "tab:blue"), (HIGH, "tab:red")):
        panel.barh(0, 0, color=colour, label=f"key at its {100 * share:.0f} % point")
    panel.axvline(answer.hours, color="black", linewidth=1.0)
    panel.set_xscale("log")
    number_ticks(panel.xaxis)
    keys = [effect.scatter.key for effect in effects]
    panel.set_yticks(range(len(effects)), [key_words(key, keys) for key in keys], fontsize=8)
    alone = "\nnothing else of this case scatters" if len(effects) == 1 else ""
    panel.set_xlabel(f"life, h{alone}")
    panel.grid(alpha=0.3, axis="x", which="both")
    panel.legend(frameon=False, fontsize=8, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2)
    return figure


_USUAL = {
    "load.tension_N": 0.1,
    "load.torque_N_m": 0.1,
    "load.power_kW": 0.1,
    "load.speed_rpm": 0.03,
    "sprocket.evolute_offset_mm": 0.02,
    "sprocket.face_width_mm": 0.02,
    "gear.face_width_mm": 0.02,
}
"""Standard deviations of load, speed and geometry, as parts of their values."""


def only_coefficients(case: Case, keys: Sequence[str]) -> bool:
    """Return whether no key but wear coefficients scatters."""
    return set(keys) <= {coefficient_key(case), *case.drive.wear_coefficients}


def usual_scatters(case: Case) -> list[str]:
    """Return lines of a table [uncertainty] for load, speed and geometry of a case."""
    found = ((key, share, value_at(case.inputs, key)) for key, share in _USUAL.items())
    return [
        f'"{key}" = {{distribution = "normal", standard_deviation = {share * value:.3g}}}'
        for key, share, value in found
        if isinstance(value, float)
    ]
