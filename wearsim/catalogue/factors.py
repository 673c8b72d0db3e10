"""The factors and limits of the handbooks, read from the data files beside this one."""

import csv
from functools import cache
from pathlib import Path

from wearsim.catalogue.catalogues import nearest
from wearsim.errors import CaseError, Fault


@cache
def rows(table: str) -> tuple[dict[str, str], ...]:
    """Return a table as it stands in its file."""
    path = Path(__file__).with_name(f"{table}.csv")
    with path.open(encoding="utf-8", newline="") as file:
        return tuple(csv.DictReader(file))


def factor(table: str, **keys: str) -> float:
    """Return the factor of the row whose columns hold given words.

    Examples
    --------
    >>> factor("application_factors", driver="smooth", driven="heavy shocks")
    1.8
    """
    left = rows(table)
    for column, word in keys.items():
        known = dict.fromkeys(row[column] for row in left)
        if word not in known:
            allowed = f"{', '.join(known)}, is {word!r}{nearest(word, list(known))}"
            place = table.replace("_", " ")
            raise CaseError([Fault(f"{place}: {column} must be one of {allowed}")])
        left = tuple(row for row in left if row[column] == word)
    return float(left[0]["factor"])
