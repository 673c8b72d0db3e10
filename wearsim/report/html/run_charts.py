"""Charts of a run, or of several: loads, wear along the flank, wear over time, lives."""

import html
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from wearsim.case.model import Case
from wearsim.quantities import grouped
from wearsim.report.answer import limit_text
from wearsim.report.flank_view import at_life, snapshot
from wearsim.report.html.charts import (
    Chart,
    Trace,
    ValueTable,
    curve,
    json_numbers,
    panels,
    rounded_numbers,
    series,
)
from wearsim.result import Life, WearResult
from wearsim.result.lives import hours

if TYPE_CHECKING:
    from wearsim.mechanisms.wrap.tooth_loads import ToothLoads

_ROWS = 21
"""Rows of a table of values beside a chart."""

_ALONG = (
    ("depth_mm", "depth", "mm"),
    ("pressure_MPa", "Hertz pressure", "MPa"),
    ("sliding_speed_mm_per_s", "sliding speed", "mm/s"),
)


def along_chart(results: Sequence[WearResult], labels: Sequence[str]) -> Chart:
    """Return depth, pressure and sliding along the flanks, at the end of the life and new."""
    shown = [row for row in _ALONG if any(row[0] in result.flank_columns for result in results)]
    figure = panels(len(shown))
    alone = len(results) == 1
    for number, (result, label) in enumerate(zip(results, labels, strict=True), start=1):
        role = "worn" if alone else series(number)
        for row, (name, what, unit) in enumerate(shown, start=1):
            traces = _along(result, name, unit, "" if alone else label, what, role)
            figure.add(traces, row)
    for row, (_, what, unit) in enumerate(shown, start=1):
        figure.set_axis("y", f"{what}, {unit}", row, rangemode="tozero")
    start = " or ".join(dict.fromkeys(_start(result) for result in results))
    figure.set_axis("x", "arc length, mm", len(shown))
    more = "; solid at the end of the life, dashed when new" if len(shown) > 1 else ""
    return Chart(
        name="along",
        title=f"{', '.join(what for _, what, _ in shown)} along the flank, {start}",
        alt=f"Curves of {', '.join(what for _, what, _ in shown)} over the arc length {start}{more}.",
        figure=figure,
        values=_along_values(results[0]) if len(results) == 1 else ValueTable((), ()),
        tall=len(shown),
        still="along_flank",
    )


def _along(result: WearResult, column: str, unit: str, label: str, what: str, role: str) -> list[Trace]:
    """One quantity at the end, and when new or of the wheel; the depth has the legend."""
    first, last = snapshot(result, 0), at_life(result)
    if column not in last:
        return []
    place, gears = last["arc_length_mm"], "wheel_depth_mm" in last
    end = curve(place, last[column], label or ("pinion" if gears else what), role, unit)
    end |= {"legendgroup": label, "showlegend": column == "depth_mm" and bool(label or gears)}
    if column != "depth_mm":
        new = curve(place, first[column], f"{label or what}, new", role, unit, "dash")
        new |= {"legendgroup": label, "showlegend": False, "opacity": 0.7}
        return [end, new]
    if not gears:
        return [end]
    name = f"{label}, wheel" if label else "wheel"
    wheel = curve(place, last["wheel_depth_mm"], name, role, unit, "dot")
    wheel |= {"legendgroup": label or "wheel", "showlegend": not label}
    return [end, wheel]


def _start(result: WearResult) -> str:
    """Where the arc length of a flank begins."""
    if "gap_kind" in result.flank_columns:
        return "from the gap's right tip"
    gears = "path_mm" in result.flank_columns
    return "from where contact starts" if gears else "from the root"


def _along_values(result: WearResult) -> ValueTable:
    last = at_life(result)
    columns = [("arc length, mm", last["arc_length_mm"])]
    columns += [(f"{what}, {unit}", last[name]) for name, what, unit in _ALONG if name in last]
    if "wheel_depth_mm" in last:
        columns.append(("depth of the wheel, mm", last["wheel_depth_mm"]))
    return _sampled(columns)


def history_chart(results: Sequence[WearResult], labels: Sequence[str]) -> Chart:
    """Return greatest depth and elongation against running time, with their limits."""
    shown = [("max_depth_mm", "depth", "mm", "critical_depth_mm")]
    if any("elongation_percent" in result.history_columns for result in results):
        shown.append(("elongation_percent", "elongation", "%", "elongation_percent"))
    figure = panels(len(shown))
    alone = len(results) == 1
    for number, (result, label) in enumerate(zip(results, labels, strict=True), start=1):
        columns = result.history_columns
        role = "worn" if alone else series(number)
        limits = {state.name: state.limit for state in result.limits}
        for row, (name, what, unit, limit) in enumerate(shown, start=1):
            if name not in columns:
                continue
            time = columns["time_hours"]
            trace = curve(time, columns[name], what if alone else label, role, unit, at="h")
            trace |= {"legendgroup": label, "showlegend": row == 1 and not alone}
            figure.add([trace], row)
            if limit in limits:
                ends, level = [0.0, time[-1]], [limits[limit]] * 2
                bound = curve(ends, level, "limit", "limit" if alone else role, unit, "dash", "h")
                bound |= {"legendgroup": label, "showlegend": False}
                figure.add([bound], row)
        figure.add([_life_mark(result, label, role)], 1)
    for row, (_, what, unit, _) in enumerate(shown, start=1):
        figure.set_axis("y", f"{what}, {unit}", row, rangemode="tozero")
        figure.set_axis("x", "running time, h" if row == len(shown) else "", row, rangemode="tozero")
    what = " and ".join(name for _, name, _, _ in shown)
    return Chart(
        name="history",
        title=f"greatest {what} against hours",
        alt=f"Curves of the greatest {what} over running time with their limits dashed; a mark at the life.",
        figure=figure,
        values=_history_values(results[0]) if alone else ValueTable((), ()),
        tall=len(shown),
        still="depth_over_hours",
    )


def _life_mark(result: WearResult, label: str, role: str) -> Trace:
    """Mark of the life on the curve of depth, or of the run's end where it was not reached."""
    columns, end = result.history_columns, result.life.hours_run
    depth = float(np.interp(end, columns["time_hours"], columns["max_depth_mm"]))
    reached = isinstance(result.life, Life)
    return {
        "type": "scatter",
        "x": [rounded_numbers(end)],
        "y": [rounded_numbers(depth)],
        "mode": "markers",
        "marker": {"symbol": "circle" if reached else "triangle-right-open", "size": 10},
        "name": "life" if reached else "run ends",
        "legendgroup": label,
        "showlegend": False,
        "meta": {"role": role},
        "hovertemplate": f"{hours(result.life)}<br>%{{y:.4g}} mm<extra>%{{fullData.name}}</extra>",
    }


def _history_values(result: WearResult) -> ValueTable:
    columns = result.history_columns
    shown = [("running time, h", columns["time_hours"])]
    shown.append(("greatest depth, mm", columns["max_depth_mm"]))
    if "elongation_percent" in columns:
        shown.append(("elongation, %", columns["elongation_percent"]))
        shown.append(("chain", columns["chain"]))
    shown.append(("peak pressure, MPa", columns["peak_pressure_MPa"]))
    return _sampled(shown)


def tooth_load_chart(case: Case) -> Chart | None:
    """Return what the teeth of a wrap carry, under a new chain and one at its limit."""
    if not case.drive.rests:
        return None
    from wearsim.mechanisms.wrap.tooth_loads import tooth_loads

    limit = 0.01 * case.inputs["stop"]["elongation_percent"]
    return _loads_chart(tooth_loads(case), tooth_loads(case, limit))


def _loads_chart(new: "ToothLoads", grown: "ToothLoads") -> Chart:
    figure = panels(1)
    rows = []
    for found, label, role in (
        (new, "new chain", "new"),
        (grown, f"chain elongation {100 * grown.elongation:.3g} %", "worn"),
    ):
        teeth = np.arange(1, found.loads.force.size + 1)
        rows.append(found.loads.force)
        bars = {
            "type": "bar",
            "x": teeth.tolist(),
            "y": json_numbers(found.loads.force),
            "name": label,
            "meta": {"role": role},
            "hovertemplate": f"tooth %{{x}}: %{{y:.4g}} N<extra>{label}</extra>",
        }
        figure.add([bars])
    figure.layout.update(barmode="group", bargap=0.25)
    figure.set_axis("x", "tooth, from the tight end", dtick=max(1, len(rows[0]) // 12))
    figure.set_axis("y", "normal force, N")
    cells = tuple(
        (
            str(tooth + 1),
            *(_cell(force[tooth]) if tooth < force.size else "-" for force in rows),
            _cell(new.loads.force[tooth] / new.face_width) if tooth < rows[0].size else "-",
        )
        for tooth in range(max(force.size for force in rows))
    )
    head = ("tooth", "force, new chain, N", "force, worn chain, N", "load, new chain, N/mm")
    return Chart(
        name="loads",
        title="tooth loads over the wrap",
        alt="Bars of the normal force on every tooth of the wrap, of a new chain and of one at its "
        f"limit of elongation; the largest is {grouped(float(new.loads.force.max()))} N on a new chain.",
        figure=figure,
        values=ValueTable(head, cells),
    )


def _sampled(columns: Sequence[tuple[str, Any]]) -> ValueTable:
    """Some rows of columns of the same length, first and last included."""
    size = len(columns[0][1])
    at = np.unique(np.linspace(0, size - 1, min(_ROWS, size)).round().astype(int))
    rows = tuple(tuple(_cell(values[row]) for _, values in columns) for row in at)
    return ValueTable(tuple(head for head, _ in columns), rows)


def _cell(value: float) -> str:
    return grouped(float(value)) if np.isfinite(value) else "-"


def lives_chart(results: Sequence[WearResult], labels: Sequence[str]) -> Chart:
    """Return the lives of several drives with their bands."""
    figure = panels(1)
    for number, (result, label) in enumerate(zip(results, labels, strict=True), start=1):
        life, low, high = (one.hours_run for one in (result.life, result.life_low, result.life_high))
        reached = isinstance(result.life, Life)
        mark = {
            "type": "scatter",
            "x": [rounded_numbers(life)],
            "y": [html.escape(label, quote=False)],
            "mode": "markers" if reached else "markers+text",
            "text": ["" if reached else html.escape(hours(result.life))],
            "textposition": "top right",
            "name": html.escape(label, quote=False),
            "showlegend": False,
            "marker": {"size": 12, "symbol": "circle" if reached else "triangle-right-open"},
            "error_x": {
                "array": [rounded_numbers(max(high - life, 0.0))],
                "arrayminus": [rounded_numbers(max(life - low, 0.0))],
            },
            "meta": {"role": series(number)},
            "hovertemplate": f"{hours(result.life)}, {limit_text(result.stop, result.stop_value)}<br>"
            f"band {hours(result.life_low)} to {hours(result.life_high)}<extra></extra>",
        }
        figure.add([mark])
    figure.layout["hovermode"] = "closest"
    ends = [one.hours_run for result in results for one in (result.life_low, result.life_high)]
    ticks = _log_ticks(min(ends), max(ends))
    named = [grouped(tick) for tick in ticks]
    figure.set_axis("x", "life, h", type="log", tickvals=ticks, ticktext=named)
    figure.set_axis("y", autorange="reversed", type="category")
    return Chart(
        name="lives",
        title="lives and their bands",
        alt="A dot for the life of each drive with the band of its wear coefficient; an open arrow where "
        "no limit was reached. The table above holds the values.",
        figure=figure,
        values=ValueTable((), ()),
    )


def _log_ticks(low: float, high: float) -> list[float]:
    """Powers of ten over a wide range, 1, 2 and 5 times them over a narrow one."""
    factors = (1.0,) if high > 20.0 * low else (1.0, 2.0, 5.0)
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    return [factor * 10.0**power for power in powers for factor in factors]
