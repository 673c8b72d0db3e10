"""``wearsim strength``: allowable stresses and life factors of a gear pair."""

from pathlib import Path
from typing import TYPE_CHECKING

from wearsim.command.calculation_command import calculation

if TYPE_CHECKING:
    from wearsim.command.calculation_sheet import CalculationSheet


@calculation("strength", "Allowable stresses and fatigue life of a gear pair.")
def strength(case: Path, settings: tuple[str, ...]) -> "CalculationSheet":
    """Find what the teeth of the gear pair of CASE endure, in contact, in bending, in overloads.

    From material, life and load spectrum follow equivalent cycles, life factors and allowable
    stresses of pinion and wheel; with a load also the stress, its margins and the hours for
    which it is allowed.
    """
    from wearsim.handbook.strength.keys import StrengthTables
    from wearsim.handbook.strength.sheet import strength_sheet
    from wearsim.input.calculation_file import load_calculation

    tables = load_calculation(case, StrengthTables, settings)
    return strength_sheet(tables, tables.strength())
