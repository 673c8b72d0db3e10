"""The page of measured data: what the rows of the validation tests are printed as.

The tests hand their rows over where pytest runs with ``--measured-page FILE``; see
tests/conftest.py and the fixture ``measured`` of tests/validation. The text of each section is the
docstring of its tests.
"""

import ast
import runpy
from collections.abc import Iterable, Mapping
from pathlib import Path

HERE = Path(__file__).parent
HEAD = HERE / "measured_head.md"
TESTS = HERE.parent / "tests" / "validation"
SECTIONS = (
    "test_metal_wear",
    "test_commuter_chains",
    "test_odd_and_even_spans",
    "test_run_in_shapes",
    "test_sealed_chain",
    "test_life_bands",
    "test_pin_on_disc",
    "test_carbon_fibre_plastic",
    "test_twin_disc",
    "test_lubricants",
    "test_chain_losses",
)
"""Files of tests in the order of the page."""

COLUMNS = ("quantity", "predicted", "measured", "scatter", "allowed", "verdict", "test")
SUMMARY = ("set", "passed", "failed")

number = runpy.run_path(str(HERE / "validation_page.py"))["number"]

Row = tuple[str, int, Mapping[str, object]]


def allowed(kind: str, size: object, unit: str) -> str:
    """What a prediction may be, in words."""
    match kind:
        case "percent":
            return f"{number(size)} %"
        case "within":
            return f"+-{number(size)}{unit}"
        case "factor":
            return f"factor {number(size)}"
        case "range" | "found":
            return f"{number(size[0])} to {number(size[1])}{unit}"
        case _:
            return f"{kind} {number(size)}{unit}"


def cells(place: str, row: Mapping[str, object]) -> list[str]:
    """A row of a table."""
    unit = f" {row['unit']}" if row["unit"] else ""
    reading = row["reading"]
    file, name = place.split("[")[0].split("::")
    return [
        row["quantity"],
        number(row["predicted"], row["digits"]) + unit,
        reading if isinstance(reading, str) else number(reading, row["digits"]) + unit,
        row["scatter"],
        allowed(row["kind"], row["size"], unit),
        row["verdict"] if row["verdict"] == "passed" else f"**{row['verdict']}**",
        f"[{name}](../{file})",
    ]


def table(columns: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    """Rows as a table of the page."""
    columns = list(columns)
    lines = [columns, ["---"] * len(columns), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def section(stem: str) -> tuple[str, str]:
    """Heading and text of a set: the docstring of its tests."""
    source = (TESTS / f"{stem}.py").read_text(encoding="utf-8")
    heading, _, text = (ast.get_docstring(ast.parse(source)) or "").partition("\n")
    return heading, text.strip()


def page(rows: Iterable[Row]) -> str:
    """The whole page of rows as test, line of the test, and what the fixture recorded.

    Rows of one test stay in their order.
    """
    by_file: dict[str, list[Row]] = {}
    for row in rows:
        by_file.setdefault(Path(row[0].split("::")[0]).stem, []).append(row)
    if unknown := set(by_file) - set(SECTIONS):
        raise LookupError(f"docs/measured_page.py: name a section of {', '.join(sorted(unknown))}")
    summary, parts = [], []
    for stem in SECTIONS:
        found = sorted(by_file.get(stem, []), key=lambda entry: entry[1])
        verdicts = [row["verdict"] for _, _, row in found]
        heading, text = section(stem)
        lines = table(COLUMNS, [cells(place, row) for place, _, row in found])
        parts.append(f"## {heading}\n\n{text}\n\n{lines}")
        summary.append([heading, *(str(verdicts.count(one)) for one in ("passed", "failed"))])
    head = HEAD.read_text(encoding="utf-8").rstrip("\n")
    return "\n\n".join([head, table(SUMMARY, summary), *parts]) + "\n"
