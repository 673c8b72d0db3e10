"""A table of readings in series, from a CSV file, checked to the cell."""

import csv
import math
from collections import Counter
from dataclasses import replace
from pathlib import Path

from wearsim.errors import CaseError, Fault, quoted
from wearsim.files import given_lines
from wearsim.input.csv_tables import header_faults
from wearsim.input.texts import line_fault
from wearsim.study.judge.falling import WearFall, falls
from wearsim.study.judge.wear_series import WearReading, WearSeries, wear_series

EXPOSURES = {"cycles": "cycles", "time_hours": "h", "distance_km": "km", "distance_m": "m"}
WEARS = {"wear_um": "um", "wear_mm": "mm", "wear_mg": "mg", "elongation_percent": "%"}
NUMBERS = ("load_N", "slip_percent", "reading_error", "t_gamma_N_per_mm2", "speed_m_per_s")
YES_OR_NO = ("relubricated", "held_out")
COLUMNS = ("series", *EXPOSURES, *WEARS, *NUMBERS, "censored", "environment", *YES_OR_NO)
"""Columns of the table; of the exposures and of the wears one each."""

_CENSORED = {"": 0, "above": 1, "below": -1}
_LEAST, _MOST, _MOST_ROWS = 1e-12, 1e12, 2000
_LEAST_FITTED = 3


def read_series(path: Path) -> WearSeries:
    """Return the readings of a file, some of them held out.

    Parameters
    ----------
    path : Path
        A row for each reading; lines that begin with # are left out. Without a column ``held_out``
        the later half of each series is held out.

    Returns
    -------
    WearSeries
        The readings.

    Raises
    ------
    CaseError
        Everything that is wrong with the file, with its lines.
    """
    lines = _lines(path)
    line, head = lines[0] if lines else (1, [])
    faults = [_fault(text, path, line) for text in _head_faults(head)]
    if faults:
        raise CaseError(faults)
    exposure, wear = (next(name for name in names if name in head) for names in (EXPOSURES, WEARS))
    readings = []
    for line, cells in lines[1:]:
        if len(cells) != len(head):
            faults.append(_fault(f"needs {len(head)} values, has {len(cells)}: complete it", path, line))
            continue
        texts = dict(zip(head, cells, strict=True))
        problems = _cell_faults(texts, exposure, wear)
        faults += [Fault(text, column, str(path), line) for column, text in problems]
        if not problems:
            readings.append(_reading(texts, exposure, wear, line))
    if len(lines) - 1 > _MOST_ROWS:
        faults.append(_fault(f"must have at most {_MOST_ROWS} readings: remove some", path))
    if not faults:
        readings = readings if "held_out" in head else _later_half_held_out(readings)
        faults = [_fault(text, path) for text in _set_faults(readings, "held_out" in head)]
    if faults:
        raise CaseError(faults)
    found = wear_series(readings, EXPOSURES[exposure], WEARS[wear], "relubricated" in head)
    return replace(found, warnings=tuple(_fall(fall, path, wear) for fall in falls(readings)))


def _fall(fall: WearFall, path: Path, wear: str) -> str:
    later, earlier = fall
    return (
        f"{path.name}:{later.line}: {wear}: {later.wear:g} of series {later.series!r} is below "
        f"{earlier.wear:g} of line {earlier.line}, by more than gauge and scatter explain: wear does not "
        "fall, correct it, or give a replacement part a series of its own"
    )


def _lines(path: Path) -> list[tuple[int, list[str]]]:
    """Return the cells of all lines that hold any, with the numbers of the lines."""
    try:
        lines = [(number, [cell.strip() for cell in line]) for number, line in given_lines(path)]
    except (OSError, ValueError, csv.Error) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise CaseError([_fault(f"must be a readable CSV file ({reason}): give another one", path)]) from None
    return [(number, cells) for number, cells in lines if any(cells) and not cells[0].startswith("#")]


def _fault(message: str, path: Path, line: int = 0) -> Fault:
    return Fault(message, "", str(path), line)


def _head_faults(head: list[str]) -> list[str]:
    if len(head) == 1 and any(mark in head[0] for mark in ";\t"):
        return ["cells must be separated by commas, with points in numbers: export it as such"]
    found = header_faults(head, ("series",), COLUMNS[1:])
    for names, what in ((EXPOSURES, "exposure"), (WEARS, "wear")):
        given = [name for name in names if name in head]
        if len(given) != 1:
            listed = ", ".join(names)
            found.append(
                f"must have exactly one column of {what} ({listed}), has "
                f"{', '.join(given) or 'none'}: name it"
            )
    return found


def _cell_faults(texts: dict[str, str], exposure: str, wear: str) -> list[tuple[str, str]]:
    found = []
    if not texts["series"]:
        found.append(("series", "must name what was read (got ''): name it"))
    found += [
        (column, wrong)
        for column in ("series", "environment")
        if (wrong := line_fault(texts.get(column, "")))
    ]
    for column in (exposure, wear, *NUMBERS):
        text = texts.get(column)
        optional = column == "reading_error"
        if text is None or (optional and text == ""):
            continue
        if not _LEAST <= _number(text) <= _MOST and not (optional and _number(text) == 0.0):
            hint = (
                "delete readings below the resolution of the gauge, or set censored = below"
                if column == wear
                else "correct it"
            )
            found.append(
                (column, f"must be a number above 0 and at most {_MOST:g} (got {quoted(text)}): {hint}")
            )
    if texts.get("censored", "") not in _CENSORED:
        got = texts["censored"]
        found.append(("censored", f"must be above, below or empty (got {quoted(got)}): correct it"))
    if texts.get("environment") == "":
        found.append(("environment", "must be named in every row (got ''): name it"))
    found += [
        (column, f"must be 0 or 1 (got {quoted(texts[column])}): correct it")
        for column in YES_OR_NO
        if texts.get(column, "0") not in ("0", "1")
    ]
    return found


def _number(text: str) -> float:
    """Read a number; nan for anything else, also what only Python takes for one."""
    try:
        return float(text) if "_" not in text else math.nan
    except ValueError:
        return math.nan


def _reading(texts: dict[str, str], exposure: str, wear: str, line: int) -> WearReading:
    return WearReading(
        series=texts["series"],
        exposure=float(texts[exposure]),
        wear=float(texts[wear]),
        load=float(texts.get("load_N", "1")),
        slip=0.01 * float(texts.get("slip_percent", "100")),
        error=float(texts.get("reading_error") or "0"),
        censored=_CENSORED[texts.get("censored", "")],
        environment=texts.get("environment", ""),
        relubricated=texts.get("relubricated") == "1",
        t_gamma=float(texts.get("t_gamma_N_per_mm2", "nan")),
        speed=float(texts.get("speed_m_per_s", "nan")),
        held_out=texts.get("held_out") == "1",
        line=line,
    )


def _later_half_held_out(readings: list[WearReading]) -> list[WearReading]:
    count, seen, found = Counter(one.series for one in readings), Counter[str](), []
    for one in sorted(readings, key=lambda one: one.exposure):
        seen[one.series] += 1
        found.append(replace(one, held_out=2 * seen[one.series] > count[one.series] + 1))
    first = {name: index for index, name in enumerate(dict.fromkeys(one.series for one in readings))}
    return sorted(found, key=lambda one: first[one.series])


def _set_faults(readings: list[WearReading], stated: bool) -> list[str]:
    """Return why the readings as a whole cannot be judged."""
    if not readings:
        return ["must have at least one reading below its header: add some"]
    fitted = sum(not one.held_out and not one.censored for one in readings)
    held = sum(one.held_out for one in readings)
    hint = "change held_out" if stated else "add later readings of a series, or a column held_out"
    found = []
    if not held:
        found.append(f"must have held-out readings for scoring, has none: {hint}")
    if fitted < _LEAST_FITTED:
        found.append(
            f"must have at least {_LEAST_FITTED} readings to fit, neither censored nor held out "
            f"(has {fitted}): add some"
        )
    return found
