"""``wearsim handbook synthesise``: profiles of a gear pair with a prescribed contact stress."""

from pathlib import Path
from typing import TYPE_CHECKING

from wearsim.command.calculation_command import calculation

if TYPE_CHECKING:
    from wearsim.report.calculation_sheet import CalculationSheet


@calculation("synthesise", "Find gear profiles for a prescribed contact stress.")
def synthesise(case: Path, settings: tuple[str, ...]) -> "CalculationSheet":
    """Find paths of contact and both profiles for the contact stress that CASE prescribes.

    Works phase by phase, through the pitch point, or from a point beside it, where two pairs of
    profiles have the same stress. Each is compared with the involute pair. Fields show where in the
    plane of mesh such profiles exist, and of which kind.
    """
    from wearsim.handbook.synthesise.keys import SynthesisTables
    from wearsim.handbook.synthesise.sheet import synthesis_sheet
    from wearsim.input.document import load_calculation

    tables = load_calculation(case, SynthesisTables, settings)
    pair = tables.pair()
    return synthesis_sheet(tables, pair, tables.phases(pair))
