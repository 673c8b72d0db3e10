"""The validation page: what the rows of the verification tests are printed as.

The tests hand their rows over where pytest runs with ``--validation-page FILE``; see
tests/conftest.py and the fixture ``validated`` of tests/verification. Numbers are printed to at
most six digits and differences to a decade, so that the page is the same on any machine.
"""

import math
import re
from collections.abc import Iterable, Mapping
from pathlib import Path

HEAD = Path(__file__).with_name("validation_head.md")
SECTIONS = {
    "Line contact": ("test_hertz_line", "test_line_stress"),
    "Wear laws": ("test_archard", "test_laws_closed_form", "test_wear_laws", "test_film_ratio"),
    "Strand: the evolute flank": ("test_evolute_closed_form", "test_strand_closed_form"),
    "Strand: lives": ("test_reference_run", "test_reference_life_b9", "test_removed_area"),
    "Duty": ("test_duty_closed_form",),
    "Wrap: loads of the teeth": ("test_wrap_loads",),
    "Wrap: a resting contact that wears": ("test_half_space_contact", "test_resting_b4"),
    "Elongation of the chain": ("test_elongation",),
    "Layout of a chain drive": ("test_drive_layout", "test_chain_loop", "test_loop_forces"),
    "Ratings of a chain drive": ("test_selection",),
    "Selection of a chain drive": ("test_select",),
    "Wear of gear pairs": ("test_gear_pair", "test_gear_forms"),
    "Convex-concave gears": ("test_convex_concave",),
    "Profiles for a contact stress": ("test_plane_gearing",),
    "Hertz against finite elements": ("test_hertz_check",),
    "Strength of gears": ("test_strength",),
    "Mesh stiffness spectrum": ("test_stiffness_spectrum", "test_mesh_statics"),
    "Wave drives": ("test_wave_drive",),
    "Face load factor": ("test_face_load",),
}
"""Heading, and the files whose rows stand under it."""

NEGLIGIBLE = 1e-9
"""Relative differences below it, or a thousandth of the tolerance, are those of a machine."""

COLUMNS = ("quantity", "wearsim", "expected", "difference", "tolerance", "source", "test")


def number(value: float, digits: int = 6) -> str:
    """A number rounded to so many digits, at most six, exponents without zeros."""
    text = f"{float(f'{value:.{digits}g}'):.6g}"
    return re.sub(r"e([+-])0*(\d)", lambda e: f"e{e[1].strip('+')}{e[2]}", text)


def digits_for(tolerance: float) -> int:
    """Digits that show a hundredth of a relative tolerance, 3 to 6."""
    return min(6, max(3, math.ceil(-math.log10(tolerance)) + 2))


def below(difference: float, tolerance: float, least: float) -> str:
    """The decade that a difference stays below, no more than the tolerance."""
    above = max(difference, least)
    decade = 10.0 ** math.ceil(math.log10(above) - 1e-12)
    return f"< {number(min(decade, tolerance), 2)}"


def cells(place: str, row: Mapping[str, object]) -> list[str]:
    """A row of a table; differences are absolute, in its unit, only where zero is expected."""
    value, expected, tolerance = row["value"], row["expected"], row["allowed"]
    off, unit = abs(value - expected), f" {row['unit']}" if row["unit"] else ""
    digits, least, kind = 3, 1e-3 * tolerance, unit
    if expected:
        off, tolerance, kind = off / abs(expected), tolerance / abs(expected), ""
        digits, least = digits_for(tolerance), max(NEGLIGIBLE, 1e-3 * tolerance)
    file, *names = place.split("[")[0].split("::")
    count = f" ({row['count']} values)" if row["count"] > 1 else ""
    return [
        f"{row['quantity']}{count}",
        number(value, digits) + unit,
        number(expected, digits) + unit,
        below(off, tolerance, least) + kind,
        number(tolerance, 2) + kind,
        row["source"],
        f"[{Path(file).name}::{'::'.join(names)}](../{file})",
    ]


def table(rows: Iterable[list[str]]) -> str:
    """Rows as a table of the page."""
    lines = [COLUMNS, ["---"] * len(COLUMNS), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def page(rows: Iterable[tuple[str, int, Mapping[str, object]]]) -> str:
    """The whole page of rows as test, line of the test, and what the fixture recorded.

    Rows of one test stay in their order.
    """
    by_file: dict[str, list[tuple[int, list[str]]]] = {}
    for place, line, row in rows:
        stem = Path(place.split("::")[0]).stem
        by_file.setdefault(stem, []).append((line, cells(place, row)))
    parts = [HEAD.read_text(encoding="utf-8").rstrip("\n")]
    for heading, files in SECTIONS.items():
        found = [
            row for file in files for _, row in sorted(by_file.pop(file, []), key=lambda entry: entry[0])
        ]
        if found:
            parts.append(f"## {heading}\n\n{table(found)}")
    if by_file:
        raise LookupError(f"docs/validation_page.py: name a section of {', '.join(sorted(by_file))}")
    return "\n\n".join(parts) + "\n"
