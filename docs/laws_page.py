"""The page of the laws of wear: what the tables of its tests are printed as.

The tests hand their tables over where pytest runs with ``--laws-page FILE``; see tests/conftest.py
and the fixture ``judged`` of tests/laws. The text of each section is the docstring of its test.
"""

import ast
import inspect
import math
import runpy
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
HEAD = HERE / "laws_head.md"
TESTS = HERE.parent / "tests" / "laws" / "test_sets.py"

SUMMARY = ("set", "fitted to; judged by", "preferred law", "good enough", "off by")
COLUMNS = ("law", "scatter", "behind the best", "in 50 %", "in 90 %", "off by", "")

table = runpy.run_path(str(HERE / "measured_page.py"))["table"]

Row = tuple[str, int, Mapping[str, Any]]


def texts() -> dict[str, tuple[str, str]]:
    """Heading and text of each test: its docstring."""
    tree = ast.parse(TESTS.read_text(encoding="utf-8"))
    found = {}
    for node in tree.body:
        if isinstance(node, ast.FunctionDef) and node.name.startswith("test_"):
            heading, _, text = inspect.cleandoc(ast.get_docstring(node) or "").partition("\n")
            found[node.name] = heading, text.strip()
    return found


def percent(share: float) -> str:
    """A part of the readings."""
    return "" if math.isnan(share) else f"{100 * share:.0f} %"


def cells(law: Mapping[str, Any]) -> list[str]:
    """A row of a table of laws."""
    behind = f"{law['behind']:.2f}"
    if math.isfinite(law["behind_error"]):
        behind += f" ± {law['behind_error']:.2f}"
    off = "" if math.isnan(law["median_error"]) else f"{math.exp(law['median_error']):.2f}"
    shares = [percent(law["coverage_50"]), percent(law["coverage_90"])]
    return [law["law"], law["scatter"], behind, *shares, off, "tied" if law["tied"] else ""]


def better_scatter(laws: Iterable[Mapping[str, Any]]) -> list[Mapping[str, Any]]:
    """Each law once, with the scatter that scores higher."""
    found: dict[str, Mapping[str, Any]] = {}
    for law in laws:
        found.setdefault(law["law"], law)
    return list(found.values())


def constants(law: Mapping[str, Any]) -> str:
    """The constants of a law with their 90 % intervals."""
    return ", ".join(
        f"`{name}` {mid:.2g} ({low:.2g} to {high:.2g})" for name, low, mid, high in law["constants"]
    )


def page(rows: Iterable[Row]) -> str:
    """The whole page of tables as test, line of the test, and what the fixture recorded."""
    written, summary, parts = texts(), [], []
    for place, _, row in sorted(rows, key=lambda entry: entry[1]):
        heading, text = written[place.split("::")[1].split("[")[0]]
        laws = better_scatter(row["laws"])
        taken = next(law for law in laws if law["law"] == row["take"])
        verdict = "yes" if row["good"] else "**no**"
        summary.append(
            [heading, row["split"], row["take"], verdict, f"{math.exp(taken['median_error']):.1f}"]
        )
        lines = table(COLUMNS, map(cells, laws))
        scale = f"Constants of *{row['take']}*, {taken['scatter']}: {constants(taken)}."
        split = f"Fitted to {row['split'].replace('; ', '; judged by ')}."
        parts.append("\n\n".join([f"## {heading}", split, text, lines, scale]))
    head = HEAD.read_text(encoding="utf-8").rstrip("\n")
    return head.replace("SUMMARY", table(SUMMARY, summary)) + "\n\n" + "\n\n".join(parts) + "\n"
