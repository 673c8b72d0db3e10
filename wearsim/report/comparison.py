"""Several results side by side: a table and matplotlib figures."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from wearsim.files import new_folder
from wearsim.input.named_files import printable
from wearsim.quantities import grouped
from wearsim.report.answer import governing_text, headline, limit_text
from wearsim.report.answer_table import AnswerTable, Column, life_columns
from wearsim.report.chain_first import chain_first_of
from wearsim.report.figures import comparison_figures, save_figure
from wearsim.result import Life, LowerBound, WearResult
from wearsim.result.lives import hours


def comparison_table(results: Sequence[WearResult]) -> AnswerTable[WearResult]:
    """Return one row per result."""
    first = results[0].life
    governs = "governs" if any(result.fatigue for result in results) else None
    return AnswerTable(
        [
            Column("case", lambda one: one.case),
            Column("title", lambda one: one.title, "case"),
            Column("", headline, "life"),
            *life_columns("life_hours", lambda one: one.life),
            Column("life_reached", lambda one: isinstance(one.life, Life)),
            Column("hours_run", lambda one: one.hours_run),
            *life_columns("life_hours_low", lambda one: one.life_low),
            *life_columns("life_hours_high", lambda one: one.life_high),
            Column("", lambda one: limit_text(one.stop, one.stop_value), "limit"),
            Column("", lambda one: f"{hours(one.life_high)} / {hours(one.life_low)}", "at low / high wear"),
            *(column for name in ("chain", "sprocket") for column in _part_columns(results, name)),
            Column("ratio_to_first", lambda one: _ratio(one.life, first), "ratio to first", "{:.3g}"),
            Column("stop", lambda one: one.stop),
            Column("stop_value", lambda one: one.stop_value),
            Column("governing_life", lambda one: one.governing if one.fatigue else None),
            *life_columns("governing_life_hours", lambda one: one.earliest_life if one.fatigue else None),
            Column("initial_peak_pressure_MPa", lambda one: one.initial_peak_pressure),
            Column("final_peak_pressure_MPa", lambda one: one.final_peak_pressure),
            Column("", lambda one: f"{grouped(one.hours_run)} h", "end of run"),
            Column("", _pressures, "peak pressure, new -> end of run, MPa"),
            Column(
                "removed_area_mm2",
                lambda one: float(one.history_columns["removed_area_mm2"][-1]),
                "removed by then, mm2",
                "{:.3g}",
            ),
            Column("max_depth_mm", lambda one: one.max_depth),
            Column("max_depth_arc_length_mm", lambda one: one.max_depth_arc_length),
            Column("", _deepest, "deepest by then, mm"),
            Column("", lambda one: governing_text(one) if one.fatigue else "-", governs),
        ],
        results,
    )


def _part_columns(results: Sequence[WearResult], name: str) -> list[Column[WearResult]]:
    """Return the columns of the life of chain or sprocket, shown where a result has one."""
    known = any(name in result.parts for result in results)
    return life_columns(f"{name}_life_hours", lambda one: one.parts.get(name), name if known else None)


def _ratio(life: Life | LowerBound, first: Life | LowerBound) -> float | None:
    both = isinstance(life, Life) and isinstance(first, Life)
    return life.hours / first.hours if both else None


def _pressures(result: WearResult) -> str:
    return f"{result.initial_peak_pressure:.0f} -> {result.final_peak_pressure:.0f}"


def _deepest(result: WearResult) -> str:
    start = "right tip" if result.inputs["mechanism"]["kind"] == "wrap" else "root"
    return f"{result.max_depth:.3g} at {result.max_depth_arc_length:.1f} from the {start}"


def differing_limits(results: list[WearResult]) -> str:
    """Return a warning that results were run to different values of the same limit."""
    cases: dict[str, dict[str, list[str]]] = {}
    for result in results:
        for state in result.limits:
            values = cases.setdefault(state.name, {})
            values.setdefault(limit_text(state.name, state.limit), []).append(result.case)
    found = [
        f"{limit} ({', '.join(names)})"
        for values in cases.values()
        if len(values) > 1
        for limit, names in values.items()
    ]
    return f"limits differ between the cases: {', '.join(found)}" if found else ""


def distinct(results: list[WearResult], names: list[str]) -> list[WearResult]:
    """Return results whose titles tell them apart."""
    titles = [result.title for result in results]
    return [
        replace(result, title=f"{result.title} [{printable(name)}]")
        if titles.count(result.title) > 1
        else result
        for result, name in zip(results, names, strict=True)
    ]


def distinct_rows(results: list[WearResult], names: list[str]) -> list[WearResult]:
    """Return results whose titles and names of cases tell them apart."""
    cases = [result.case for result in results]
    return [
        replace(result, case=printable(name)) if cases.count(result.case) > 1 else result
        for result, name in zip(distinct(results, names), names, strict=True)
    ]


def save_comparison(results: list[WearResult], folder: Path, force: bool) -> None:
    """Write tables and figures into a folder, all of it or nothing."""
    table = comparison_table(results)
    with new_folder(folder, force) as place:
        table.write(place / "summary.csv")
        (place / "summary.md").write_text(_page(results, table.markdown()), encoding="utf-8")
        for name, figure in comparison_figures(results).items():
            save_figure(figure, place, name)


def _page(results: list[WearResult], table: str) -> str:
    parts = ["# Comparison", table]
    cautions = filter(None, (differing_limits(results), chain_first_of(results)))
    parts += [f"- warning: {text}" for text in cautions]
    for result in results:
        parts.append(f"## {result.title}")
        parts.append("\n".join(f"- warning: {text}" for text in result.warnings) or "No warnings.")
        parts.append("\n".join(f"{i}. {text}" for i, text in enumerate(result.assumptions, start=1)))
    pictures = ("flanks", "along_flank", "depth_over_hours")
    parts.append("\n".join(f"![{name.replace('_', ' ')}]({name}.svg)" for name in pictures))
    return "\n\n".join(parts) + "\n"
