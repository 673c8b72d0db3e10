"""``wearsim handbook convex-concave``: geometry of a pair of gears with convex-concave teeth."""

from pathlib import Path
from typing import TYPE_CHECKING

from wearsim.command.calculation_command import calculation

if TYPE_CHECKING:
    from wearsim.report.calculation_sheet import CalculationSheet


@calculation("convex-concave", "Lay out flanks and contact of convex-concave gears.")
def convex_concave(case: Path, settings: tuple[str, ...]) -> "CalculationSheet":
    """Lay out the convex-concave gears of CASE, whose path of contact is two circular arcs.

    Prints radii of curvature, contact ratio and reduced radius beside those of the involute pair of
    the same size, the sign conditions, an arc for the rack flank, and the measurement over rollers.
    --out also writes flanks and outlines (CSV, DXF, STL).
    """
    from wearsim.handbook.convex_concave.keys import ConvexConcaveTables
    from wearsim.handbook.convex_concave.sheet import convex_concave_sheet
    from wearsim.input.document import load_calculation

    tables = load_calculation(case, ConvexConcaveTables, settings)
    return convex_concave_sheet(tables.title, tables.layout())
