"""What is shown of an optimisation: text, JSON, tables, and the best designs as case files."""

import math
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from wearsim._version import ANSWER_HEAD
from wearsim.quantities import grouped
from wearsim.report.answer_table import AnswerTable, Column, plain
from wearsim.report.chain_first import STOP, is_of_form
from wearsim.report.study_files import save_figures, save_files
from wearsim.report.text_lines import closing_lists, counts_by_kind
from wearsim.result.ends import CHAIN
from wearsim.runner.store import DESIGN_MARK, DESIGNS
from wearsim.study.optimise.design_files import save_designs
from wearsim.study.optimise.model import OptimiseStudy
from wearsim.study.optimise.trials import (
    MAXIMISED,
    Candidate,
    OptimiseOutcome,
    commonest_reason,
    limit_names,
    margins,
)

_SAME = 1e-6
"""Relative scatter of a measure that is none."""

_MAX_SHOWN = 20
"""Designs of a front in the text; the files hold all."""


def candidates_table(outcome: OptimiseOutcome, candidates: Sequence[Candidate]) -> AnswerTable[Candidate]:
    """Return a row for each design."""
    study = outcome.study
    names = {one.number: _name(number, outcome) for number, one in enumerate(outcome.front, 1)}
    return AnswerTable(
        [
            Column("design", lambda one: one.number),
            Column("", lambda one: names.get(one.number, "as given"), "design"),
            *(Column(key, partial(_chosen, at), key, _shown) for at, key in enumerate(study.space.keys)),
            *(column for name in study.measures for column in _measured(name)),
            Column("life_reached", lambda one: one.reached),
            Column("stop", lambda one: one.stop),
            *(_margin(study, name) for name in limit_names(study)),
            Column("feasible", lambda one: one.feasible),
            Column("error", lambda one: one.error),
            Column("warnings", lambda one: one.warnings),
        ],
        candidates,
    )


def _measured(name: str) -> Iterator[Column[Candidate]]:
    yield Column(name, lambda one: one.measures.get(name))
    yield Column("", lambda one: None if one.error else _measure(one, name), name, missing="failed")


def _chosen(at: int, one: Candidate) -> Any:
    return one.values[at]


def _margin(study: OptimiseStudy, name: str) -> Column[Candidate]:
    return Column(
        f"margin_{name}",
        lambda one: None if one.error else margins(study, one)[name],
        f"to {name}",
        lambda part: f"{100.0 * part:+.3g} %",
        missing="failed",
    )


def optimise_warnings(outcome: OptimiseOutcome) -> tuple[str, ...]:
    """Return what is doubtful about the best designs."""
    study, found = outcome.study, []
    for at, parameter in enumerate(study.space.parameters):
        ends = [parameter.end_of(one.values[at]) for one in outcome.front]
        for end in ("low", "high"):
            if ends.count(end) == len(ends):
                which = "the best design" if len(ends) == 1 else f"all {len(ends)} designs"
                found.append(
                    f"{parameter.key} of {which} lies on its {end} end: a wider range may give better ones"
                )
    for name in study.objectives:
        values = [one.measures[name] for one in outcome.candidates if one.feasible]
        if len(values) > 1 and max(values) - min(values) <= _SAME * max(values):
            found.append(
                f"no parameter changes {name}: it is governed by something else (wearsim life says what "
                "ends the life)"
            )
    if "life_hours" in study.objectives and not all(one.reached for one in outcome.front):
        found.append(
            "lives beyond run.horizon_hours count as lives up to it, and which of them is longest is not "
            "known: raise it"
        )
    by_chain = [one.number for one in outcome.front if one.stop in (STOP, CHAIN)]
    if by_chain and "life_hours" in study.objectives and any(map(is_of_form, study.space.keys)):
        found.append(
            f"the chain ends first in {len(by_chain)} of {len(outcome.front)} best designs: their lives are "
            "those of the chain, and rank tooth forms by how they wear it, not by their own wear (wearsim "
            "compare gives the lives of the teeth)"
        )
    if not outcome.unchanged.feasible:
        why = "fails" if outcome.unchanged.error else "breaks limits"
        found.append(f"the case as given {why}: what the best design gains has no measure")
    else:
        found += [
            f"the case as given has a better {name} than every design that was tried: it lies outside the "
            "parameters, or more trials are needed"
            for name in study.objectives
            if outcome.unchanged.cost(name) < min(one.cost(name) for one in outcome.front) - _SAME
        ]
    if not outcome.settled:
        found.append(
            f"the search ended at --evaluations {study.evaluations} while it was still improving: more may "
            "give better designs"
        )
    return (*found, *study.space.warnings, *_of_designs(outcome))


def _of_designs(outcome: OptimiseOutcome) -> list[str]:
    """Warnings of the best designs, those that differ in their numbers only as one."""
    counts = counts_by_kind(
        f"design {_name(number, outcome)}: {text}"
        for number, one in enumerate(outcome.front, 1)
        for text in filter(None, one.warnings.split("\n"))
    )
    return [first if count == 1 else f"{first} (and of {count - 1} more designs)" for first, count in counts]


def optimise_text(outcome: OptimiseOutcome, explain: bool = False) -> str:
    """Return the best designs as text."""
    study, front = outcome.study, outcome.front
    kind = "best design" if len(study.objectives) == 1 else f"front of {len(front)} designs"
    sought = ", ".join(f"{'longest' if name in MAXIMISED else 'least'} {name}" for name in study.objectives)
    shown = candidates_table(outcome, (outcome.unchanged, *front[:_MAX_SHOWN]))
    lines = [study.case.title, "", f"{kind}: {sought}", "", shown.markdown()]
    if len(front) > _MAX_SHOWN:
        lines.append(f"and {len(front) - _MAX_SHOWN} more: front.csv of --out holds all")
    lines += ["", *_gains(outcome)]
    failed = [one for one in outcome.candidates if not one.feasible]
    lines.append(f"tried        {len(outcome.candidates)} designs, {len(failed)} not feasible")
    if failed:
        lines.append(f"             {commonest_reason(study, failed)}")
    lines += closing_lists(study.assumptions(outcome.cases), optimise_warnings(outcome), explain)
    return "\n".join(lines)


def _name(number: int, outcome: OptimiseOutcome) -> str:
    return f"{number:0{_digits(outcome)}d}"


def _digits(outcome: OptimiseOutcome) -> int:
    return max(2, len(str(len(outcome.front))))


def _shown(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _measure(one: Candidate, name: str) -> str:
    value = grouped(one.measures[name])
    return f"> {value}" if name == "life_hours" and not one.reached else value


def _gains(outcome: OptimiseOutcome) -> list[str]:
    """What the best designs gain against the case as given, where that runs."""
    if outcome.unchanged.error:
        return []
    lines = []
    for name in outcome.study.objectives:
        best = min(outcome.front, key=lambda one, name=name: one.cost(name))  # type: ignore[misc]
        change = 100.0 * (best.measures[name] / outcome.unchanged.measures[name] - 1.0)
        values = f"{_measure(outcome.unchanged, name)} -> {_measure(best, name)}"
        lines.append(f"{name:<20} {values} ({change:+.3g} % against the case as given)")
    return lines


def optimise_json(outcome: OptimiseOutcome) -> dict[str, Any]:
    """Return the best designs as plain values."""
    study = outcome.study
    failed = [one for one in outcome.candidates if not one.feasible]
    return {
        **ANSWER_HEAD,
        "case": study.case.name,
        "objectives": list(study.objectives),
        "seed": study.seed,
        "evaluations": len(outcome.candidates),
        "infeasible": len(failed),
        "commonest_reason": commonest_reason(study, failed),
        "given": _plain(outcome, outcome.unchanged),
        "designs": [_plain(outcome, one) for one in outcome.front],
        "assumptions": list(study.assumptions(outcome.cases)),
        "warnings": list(optimise_warnings(outcome)),
    }


def _plain(outcome: OptimiseOutcome, one: Candidate) -> dict[str, Any]:
    study = outcome.study
    return {
        "inputs": dict(zip(study.space.keys, one.values, strict=True)),
        **{name: plain(one.measures.get(name, math.nan)) for name in study.measures},
        "life_reached": one.reached,
        "stop": one.stop,
        "margins": {} if one.error else margins(study, one),
        "feasible": one.feasible,
        "error": one.error,
        "warnings": list(filter(None, one.warnings.split("\n"))),
    }


def write_candidates(outcome: OptimiseOutcome, folder: Path) -> None:
    """Write the table of all designs that were tried into the folder of a study."""
    tried = candidates_table(outcome, (outcome.unchanged, *outcome.candidates))
    save_files(folder, {"candidates.csv": tried.csv()})


def write_optimise(outcome: OptimiseOutcome, folder: Path) -> None:
    """Write the best designs, as a table, as pictures and as cases, into the folder of a study."""
    from wearsim.study.optimise.figure import optimise_figures

    texts = {
        "front.csv": candidates_table(outcome, outcome.front).csv(),
        "summary.md": f"# {outcome.study.case.title}\n\n{optimise_text(outcome, explain=True)}\n",
    }
    save_files(folder, texts)
    save_figures(folder, outcome.study.case.title, optimise_figures(outcome))
    _save_designs(outcome, folder / DESIGNS)


def _save_designs(outcome: OptimiseOutcome, folder: Path) -> None:
    """Write each of the best designs as a case of its own, with the files that it names."""
    study = outcome.study
    heads = {
        f"{_name(number, outcome)}.toml": _head(outcome, one) for number, one in enumerate(outcome.front, 1)
    }
    save_designs(folder, heads, study.design([one.values for one in outcome.front]))


def _head(outcome: OptimiseOutcome, one: Candidate) -> str:
    study = outcome.study
    found = ", ".join(f"{name} {_measure(one, name)}" for name in study.measures)
    return f"design {one.number}{DESIGN_MARK}{study.case.name}: {found}"
