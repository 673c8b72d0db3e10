"""The page of published rules of chain wear life: the rules, and what the drives of its tests are printed as.

The tests hand their drives over where pytest runs with ``--practice-page FILE``; see
tests/conftest.py and the fixture ``on_page`` of tests/practice.
"""

import math
import runpy
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from wearsim.catalogue.catalogues import catalogue_rows

HERE = Path(__file__).parent
HEAD = HERE / "practice_head.md"

RULES = ("rule", "formula", "range", "source", "trust")
DRIVES = ("no.", "drive", "chain", "teeth", "rpm", "m/s", "MPa")
WITHIN = 2.5
"""Factor of the mean within which the engine is counted."""

table = runpy.run_path(str(HERE / "measured_page.py"))["table"]

Row = tuple[str, int, Mapping[str, Any]]


def thousands(hours: float | None) -> str:
    """Hours in thousands, above 100 whole ones; empty for none."""
    if hours is None:
        return ""
    digits = 0 if hours >= 99_950.0 else 1
    return f"{1e-3 * hours:.{digits}f}"


def cells(row: Mapping[str, Any]) -> list[str]:
    """A drive as a row of the table."""
    teeth = f"{row['teeth']}/{row['mate_teeth']}"
    first = [str(row["no"]), row["drive"], row["chain"], teeth, f"{row['speed_rpm']:.0f}"]
    first += [f"{row['speed_m_per_s']:.2f}", f"{row['pressure_MPa']:.1f}"]
    hours = [thousands(hours) for hours in (*row["hours"].values(), row["mean"], row["engine"])]
    return [*first, *hours, f"{ratio(row):.1f}"]


def ratio(row: Mapping[str, Any]) -> float:
    """Hours of the engine over the mean of the rules."""
    return row["engine"] / row["mean"]


def summary(rows: list[Mapping[str, Any]]) -> str:
    """How far engine and single rules are from the mean, in words."""
    ratios = sorted(map(ratio, rows))
    near = sum(1.0 / WITHIN <= one <= WITHIN for one in ratios)
    logs = [math.log(h / row["mean"]) for row in rows for h in row["hours"].values() if h is not None]
    spread = math.exp(math.sqrt(sum(log**2 for log in logs) / len(logs)))
    middle = ratios[len(ratios) // 2]
    return (
        f"Engine over mean: {ratios[0]:.1f} to {ratios[-1]:.1f}, median {middle:.1f}, and within a factor of "
        f"{WITHIN:g} on {near} of {len(rows)} drives. Single rules deviate from the mean by a factor of "
        f"{spread:.1f} (root mean square)."
    )


def held(rows: Iterable[Mapping[str, Any]]) -> tuple[int, int]:
    """How many hours of single rules lie in the band of the engine, and how many there are."""
    inside = [
        row["band"][0] <= hours <= row["band"][1]
        for row in rows
        for hours in row["hours"].values()
        if hours is not None
    ]
    return sum(inside), len(inside)


def coverage(rows: list[Mapping[str, Any]]) -> str:
    """How often the band holds the hours of a single rule, within the window of the rate and outside."""
    parts = {"all drives": rows}
    parts["within the window"] = [row for row in rows if not row["outside"]]
    parts["outside"] = [row for row in rows if row["outside"]]
    lines = []
    for name, some in parts.items():
        inside, count = held(some)
        lines.append([name, str(len(some)), f"{inside} of {count}", f"{100.0 * inside / count:.0f} %"])
    return table(["drives", "number", "hours of rules in the band", "part"], lines)


def page(rows: Iterable[Row]) -> str:
    """The whole page of drives as test, line of the test, and what the fixture recorded."""
    drives = sorted((row for _, _, row in rows), key=lambda row: row["no"])
    names = [*drives[0]["hours"], "mean", "engine"]
    parts = {
        "RULES": table(RULES, ([rule[key] for key in RULES] for rule in catalogue_rows("practice_rules"))),
        "DRIVES": table([*DRIVES, *names, "engine over mean"], map(cells, drives)),
        "SUMMARY": summary(drives),
        "COVERAGE": coverage(drives),
        "LIMITS": whole("recommended_lubrication"),
        "FACTORS": whole("lubrication_life_factors"),
    }
    text = HEAD.read_text(encoding="utf-8")
    for word, part in parts.items():
        text = text.replace(f"\n{word}\n", f"\n{part}\n")
    return text


def whole(name: str) -> str:
    """A table of the catalogue."""
    rows = catalogue_rows(name)
    return table(list(rows[0]), (list(row.values()) for row in rows))
