"""``wearsim handbook strength``: allowable stresses and life factors of a gear pair."""

from pathlib import Path
from typing import TYPE_CHECKING

from wearsim.command.calculation_command import calculation

if TYPE_CHECKING:
    from wearsim.report.calculation_sheet import CalculationSheet


@calculation("strength", "Compute allowable stresses and fatigue life of a pair.")
def strength(case: Path, settings: tuple[str, ...]) -> "CalculationSheet":
    """Compute the strength of the gear pair of CASE: contact, bending and overload.

    Gives equivalent cycles, life factors and allowable stresses of pinion and wheel from material,
    life and load spectrum; with a load, also the stresses, their margins and the allowed hours.
    """
    from wearsim.handbook.strength.keys import StrengthTables
    from wearsim.handbook.strength.sheet import strength_sheet
    from wearsim.input.document import load_calculation

    tables = load_calculation(case, StrengthTables, settings)
    return strength_sheet(tables, tables.strength())
