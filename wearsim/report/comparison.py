"""Several results side by side: pandas tables and matplotlib figures."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from wearsim.files import new_folder
from wearsim.report.answer import governing_text, headline, limit_text
from wearsim.report.figures import comparison_figures, save_figure
from wearsim.result import Life, WearResult, life_keys
from wearsim.result.lives import hours

if TYPE_CHECKING:
    import pandas as pd


def comparison_table(results: list[WearResult]) -> pd.DataFrame:
    """Return one row per result."""
    import pandas as pd  # takes 0.3 s, and a page of one drive has no table

    first = results[0].life
    rows = []
    for result in results:
        life = result.life
        both = isinstance(life, Life) and isinstance(first, Life)
        rows.append(
            {
                "case": result.case,
                "title": result.title,
                **life_keys("life_hours", life),
                "life_reached": isinstance(life, Life),
                "hours_run": result.hours_run,
                **life_keys("life_hours_low", result.life_low),
                **life_keys("life_hours_high", result.life_high),
                "ratio_to_first": life.hours / first.hours if both else float("nan"),
                "stop": result.stop,
                "stop_value": result.stop_value,
                "governing_life": result.governing if result.fatigue else None,
                **life_keys("governing_life_hours", result.earliest_life if result.fatigue else None),
                "initial_peak_pressure_MPa": result.initial_peak_pressure,
                "final_peak_pressure_MPa": result.final_peak_pressure,
                "removed_area_mm2": float(result.history_columns["removed_area_mm2"][-1]),
                "max_depth_mm": result.max_depth,
                "max_depth_arc_length_mm": result.max_depth_arc_length,
            }
        )
    table = pd.DataFrame(rows)
    # A column of None alone is one of numbers too.
    numbers = [name for name in map(str, table.columns) if "life_hours" in name]
    return table.astype(dict.fromkeys(numbers, float))


def comparison_cells(results: list[WearResult]) -> tuple[list[str], list[list[str]]]:
    """Return the comparison in words, bounds with their sign."""
    head = [
        "case",
        "life",
        "limit",
        "at low / high wear",
        "ratio to first",
        "peak pressure, MPa",
        "removed area, mm2",
        "deepest, mm",
    ]
    rows = []
    for result, row in zip(results, comparison_table(results).to_dict("records"), strict=True):
        ratio = row["ratio_to_first"]
        start = "right tip" if result.inputs["mechanism"]["kind"] == "wrap" else "root"
        cells = [
            result.title,
            headline(result),
            limit_text(result.stop, result.stop_value),
            f"{hours(result.life_high)} / {hours(result.life_low)}",
            f"{ratio:.3g}" if ratio == ratio else "-",
            f"{result.initial_peak_pressure:.0f} -> {result.final_peak_pressure:.0f}",
            f"{row['removed_area_mm2']:.3g}",
            f"{result.max_depth:.3g} at {result.max_depth_arc_length:.1f} from the {start}",
        ]
        rows.append(cells)
    if any(result.fatigue for result in results):
        head.append("governs")
        for result, cells in zip(results, rows, strict=True):
            cells.append(governing_text(result) if result.fatigue else "-")
    return head, rows


def comparison_text(results: list[WearResult]) -> str:
    """Return the comparison as a Markdown table, bounds with their sign."""
    head, rows = comparison_cells(results)
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    lines += ["| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |" for cells in rows]
    return "\n".join(lines)


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
        replace(result, title=f"{result.title} [{name}]") if titles.count(result.title) > 1 else result
        for result, name in zip(results, names, strict=True)
    ]


def save_comparison(results: list[WearResult], folder: Path, force: bool) -> str:
    """Write tables and figures into a folder, all of it or nothing."""
    text = comparison_text(results)
    with new_folder(folder, force) as place:
        comparison_table(results).to_csv(place / "summary.csv", index=False)
        (place / "summary.md").write_text(_page(results, text), encoding="utf-8")
        for name, figure in comparison_figures(results).items():
            save_figure(figure, place, name)
    return text


def _page(results: list[WearResult], table: str) -> str:
    parts = ["# Comparison", table]
    limits = differing_limits(results)
    if limits:
        parts.append(f"- warning: {limits}")
    for result in results:
        parts.append(f"## {result.title}")
        parts.append("\n".join(f"- warning: {text}" for text in result.warnings) or "No warnings.")
        parts.append("\n".join(f"{i}. {text}" for i, text in enumerate(result.assumptions, start=1)))
    pictures = ("flanks", "along_flank", "depth_over_hours")
    parts.append("\n".join(f"![{name.replace('_', ' ')}]({name}.svg)" for name in pictures))
    return "\n\n".join(parts) + "\n"
