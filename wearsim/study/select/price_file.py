"""What chains and sprockets cost, from a table of one's own."""

import csv
import math
from pathlib import Path

from wearsim.catalogue.catalogues import chains
from wearsim.catalogue.chain_names import chain_name, nearest_chain
from wearsim.errors import CaseError, Fault
from wearsim.files import given_lines
from wearsim.input.csv_tables import header_faults
from wearsim.study.select.model import Price

_CHAIN, _LENGTH, _BLANK = "designation", "price_per_m", "sprocket_price_per_kg"
_COLUMNS = (_CHAIN, _LENGTH, _BLANK)
_MOST = 1e9


def read_prices(path: Path) -> dict[str, Price]:
    """Return the prices of a CSV file by the designations of the catalogue.

    Parameters
    ----------
    path : Path
        Columns ``designation``, ``price_per_m`` and ``sprocket_price_per_kg``, a row for every chain;
        lines that begin with # are left out.

    Raises
    ------
    CaseError
        Everything that is wrong with the file, with its lines.
    """
    rows = _rows(path)
    if not rows:
        raise CaseError([_fault("must hold a header and at least one chain below it: write them", path)])
    line, head = rows[0]
    names = ", ".join(_COLUMNS)
    faults = [
        _fault(f"{text}: name the columns {names}", path, line) for text in header_faults(head, _COLUMNS, ())
    ]
    if faults:
        raise CaseError(faults)
    found: dict[str, Price] = {}
    for line, cells in rows[1:]:
        problems = _add(found, dict(zip(head, cells, strict=False)))
        faults += [_fault(text, path, line) for text in problems]
    if not found and not faults:
        faults.append(_fault("must hold at least one chain below its header: write one", path))
    if faults:
        raise CaseError(faults)
    return found


def _rows(path: Path) -> list[tuple[int, list[str]]]:
    """Return the cells of all lines that hold any, with the numbers of the lines."""
    try:
        lines = [(number, [cell.strip() for cell in line]) for number, line in given_lines(path)]
    except (OSError, ValueError, csv.Error) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise CaseError([_fault(f"must be a readable CSV file ({reason}): give another one", path)]) from None
    return [(number, cells) for number, cells in lines if any(cells) and not cells[0].startswith("#")]


def _fault(message: str, path: Path, line: int = 0) -> Fault:
    return Fault(message, "", f"--price {path}", line)


def _add(found: dict[str, Price], cells: dict[str, str]) -> list[str]:
    """Add the price of a row; return what is wrong with it."""
    typed = cells.get(_CHAIN, "")
    name, problems = chain_name(typed), []
    designation = chains()[name].designation if name else ""
    if not name:
        problems.append(f"must name a chain of the catalogue (got {typed!r}){nearest_chain(typed)}")
    elif designation in found:
        problems.append(f"must price every chain once ({designation} again): remove one of the two rows")
    numbers = []
    for column in (_LENGTH, _BLANK):
        value = _number(cells.get(column, ""))
        numbers.append(value)
        if not 0.0 <= value <= _MOST:
            got = cells.get(column, "")
            problems.append(f"{column} must be a number from 0 to {_MOST:g} (got {got!r}): correct it")
    if not problems:
        found[designation] = Price(*numbers)
    return problems


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return math.nan
