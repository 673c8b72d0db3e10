"""The length of a new chain, from which the elongation of later lengths counts."""

import math
from dataclasses import dataclass

from wearsim.errors import CaseError, Fault
from wearsim.readings.chain_readings import LENGTH, chain_cells
from wearsim.readings.dated_rows import NEW, DatedRows
from wearsim.readings.kept_tables import number

_FROM_NOMINAL = 1.0
"""Percent by which a new chain may differ from its pitch; ISO 606 allows 0.15 % under its measuring load."""


@dataclass(frozen=True)
class NewLength:
    """The length of the new chain, from which elongations count."""

    pitch: float  # mean of its links [mm]
    nominal: float  # pitch of the case [mm]
    error: float = 0.0  # standard deviation of a pitch that was measured, nan if not stated [%]

    @property
    def measured(self) -> bool:
        """Whether it was read, not taken from the case."""
        return self.error != 0.0

    @property
    def longer(self) -> float:
        """How much longer than its pitch the new chain was [%]."""
        return 100.0 * (self.pitch / self.nominal - 1.0)

    def error_with(self, error: float) -> float:
        """Return the error of an elongation over it; a length of the new chain without one has the same."""
        if not self.measured:
            return error
        return math.hypot(error, error if math.isnan(self.error) else self.error)


def new_length(table: DatedRows, pitch: float) -> NewLength:
    """Return the length of the new chain by a first row ``new``, without it that of the pitch.

    Raises
    ------
    CaseError
        What is wrong with that row.
    """
    line, cells = table.rows[0] if table.rows else (0, {})
    given = {name: cells.get(name, "") for name in ("value", "links", "error")}
    if cells.get("quantity") != NEW or not any(given.values()):
        return NewLength(pitch, pitch)
    rules = {
        **{name: rule for name, rule in chain_cells(LENGTH).items() if name != "result"},
        "error": (lambda text: text == "" or 0.0 < number(text) <= 1e6, "must be a number above 0, or empty"),
    }
    faults = [
        Fault(f"{must} (got {given[name]!r})", name, table.file, line)
        for name, (holds, must) in rules.items()
        if not holds(given[name])
    ]
    if faults:
        raise CaseError(faults)
    length, links = number(given["value"]), int(number(given["links"]))
    found = NewLength(length / links, pitch, 100.0 * number(given["error"]) / length)
    if abs(found.longer) > _FROM_NOMINAL:
        text = (
            f"{length:g} mm over {links} new links differ by {found.longer:.3g} % from a pitch of {pitch:g} "
            f"mm, must be {_FROM_NOMINAL:g} % at most: check value, links and chain.pitch_mm"
        )
        raise CaseError([Fault(text, "value", table.file, line)])
    return found
