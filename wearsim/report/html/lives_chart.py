"""Lives side by side."""

import html
import math
from collections.abc import Sequence

from wearsim.quantities import grouped
from wearsim.report.answer import limit_text
from wearsim.report.html.charts import Chart, ValueTable, panels, rounded_numbers, series
from wearsim.result import Life, WearResult
from wearsim.result.lives import hours


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
