"""The diameter of a flexspline by several methods: text, tables and picture."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from wearsim.handbook.wave_drive.model import MethodComparison, MethodDiameter
from wearsim.report.answer_table import plain
from wearsim.report.calculation_sheet import CalculationSheet
from wearsim.report.text_lines import answer_text

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

_ASSUMPTIONS = (
    "the formulas are from six textbooks, as collected by Tkachenko (2010); some of its tables are lost",
    "the range of a method covers the values that the source recommends for its own keys, with all "
    "others as given",
    "two printed formulas cannot give the diameters printed with them; unless formula = printed, they "
    "are corrected: torsion has a cube root, and rim_bending 10 instead of 28.4",
)


def wave_drive_sheet(title: str, comparison: MethodComparison, defaults: Sequence[str]) -> CalculationSheet:
    """Return what ``wearsim handbook wave-drive`` shows."""
    found = comparison.diameters
    rows = [_row(one) for one in found]
    slopes = [
        {"sizing_method": one.method.name, "key": key, "elasticity": slope}
        for one in found
        for key, slope in one.elasticity.items()
    ]
    assumptions = (*_ASSUMPTIONS, *defaults)
    warnings = [f"left out: {reason}" for reason in comparison.left_out.values()]
    warnings += _warnings(found)

    def _made() -> dict[str, "pd.DataFrame"]:
        import pandas as pd

        return {"methods": pd.DataFrame(rows), "elasticities": pd.DataFrame(slopes)}

    def _drawn() -> dict[str, "Figure"]:
        from wearsim.handbook.wave_drive.figure import wave_drive_figure

        return {"wave_drive": wave_drive_figure(title, found)}

    return CalculationSheet(
        text=_text(title, found),
        content={
            "title": title,
            "methods": rows,
            "elasticities": slopes,
            "assumptions": list(assumptions),
            "warnings": warnings,
        },
        tables=_made,
        figures=_drawn,
        warnings=tuple(warnings),
    )


def _row(one: MethodDiameter) -> dict[str, Any]:
    return {
        "sizing_method": one.method.name,
        "textbook": one.method.source,
        "criterion": one.method.criterion,
        "flexspline_diameter_mm": one.diameter,
        "least_diameter_mm": one.least,
        "greatest_diameter_mm": one.greatest,
        "rank": one.rank,
        "least_rank": one.least_rank,
        "greatest_rank": one.greatest_rank,
        "published_diameter_mm": plain(one.published),
        "reproduces": None if math.isnan(one.published) else one.reproduces,
        "allowable": one.method.allowable,
        "needed_allowable": plain(one.needed),
    }


def _text(title: str, found: Sequence[MethodDiameter]) -> str:
    head = f"{'method':18s}{'ref.':5s}{'criterion':26s}{'d, mm':>8s}{'range, mm':>15s}{'rank':>9s}"
    lines = [title, "", f"  {head}{'published':>11s}"]
    for one in found:
        span = f"{one.least:.1f}-{one.greatest:.1f}" if one.greatest > one.least else "-"
        ranks = f"{one.rank}"
        if one.greatest_rank > one.least_rank:
            ranks += f" ({one.least_rank}-{one.greatest_rank})"
        shown = "" if math.isnan(one.published) else f"{one.published:g}"
        lines.append(
            f"  {one.method.name:18s}{one.method.source:5s}{one.method.criterion:26s}"
            f"{one.diameter:8.1f}{span:>15s}{ranks:>9s}{shown:>11s}".rstrip()
        )
    published = [f"  {_held(one)}" for one in found if not math.isnan(one.published)]
    lines += ["", *published] if published else []
    return answer_text(*lines)


def _held(one: MethodDiameter) -> str:
    name, key = one.method.name, one.method.allowable
    verdict = "reproduced" if one.reproduces else f"NOT reproduced ({one.diameter:.1f} mm)"
    if math.isnan(one.needed):
        return f"{name}: {one.published:g} mm {verdict}; no {key} gives it"
    low, high = one.method.ranges.get(key, (-math.inf, math.inf))
    fits = one.reproduces or low <= one.needed <= high
    beyond = "" if fits else f" instead of {low:g}-{high:g}"
    return f"{name}: {one.published:g} mm {verdict}; needs {key} = {one.needed:.4g}{beyond}"


def _warnings(found: Sequence[MethodDiameter]) -> list[str]:
    diameters = [one.diameter for one in found]
    warnings = []
    if max(diameters) > 1.3 * min(diameters):
        warnings.append(
            f"the methods differ by a factor of {max(diameters) / min(diameters):.2f}: they apply "
            "different criteria with different safety factors; use the one whose allowable values you know"
        )
    for one in found:
        if one.as_printed:
            warnings.append(
                f"{one.method.name}: the formula as printed is wrong: it does not give the diameter "
                "printed with it; use formula = corrected"
            )
        ranges = {**one.method.ranges, **one.method.drive_ranges}
        for key, value in one.outside.items():
            low, high = ranges[key]
            warnings.append(
                f"{one.method.name}: {key} = {value:g} is outside {low:g}-{high:g}, the range stated for "
                "the method"
            )
        steepest = max(one.elasticity.items(), key=lambda item: abs(item[1]))
        if abs(steepest[1]) > 1.01:
            warnings.append(
                f"{one.method.name}: 1 % of {steepest[0]} changes the diameter by {abs(steepest[1]):.2g} %: "
                "it is a small difference of large numbers"
            )
    return warnings
