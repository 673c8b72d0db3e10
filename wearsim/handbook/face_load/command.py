"""``wearsim face-load``: load along the face of a wide, misaligned pair of gears."""

from pathlib import Path
from typing import TYPE_CHECKING

from wearsim.command.calculation_command import calculation

if TYPE_CHECKING:
    from wearsim.command.calculation_sheet import CalculationSheet


@calculation("face-load", "Face load factor of a misaligned pair, new and run in.")
def face_load(case: Path, settings: tuple[str, ...]) -> "CalculationSheet":
    """Spread the load of the pair of CASE over its face width, and wear the flanks.

    The part of the misalignment that is the same at every mesh runs in, the part that changes
    from mesh to mesh does not; with a fixed and with a self-aligning pinion.
    """
    from wearsim.handbook.face_load.keys import FaceLoadTables
    from wearsim.handbook.face_load.sheet import face_load_sheet
    from wearsim.input.calculation_file import defaults_taken, load_calculation

    tables = load_calculation(case, FaceLoadTables, settings)
    return face_load_sheet(tables.title, tables.factors(), defaults_taken(tables))
