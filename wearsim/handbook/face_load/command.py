"""``wearsim handbook face-load``: load along the face of a wide, misaligned pair of gears."""

from pathlib import Path
from typing import TYPE_CHECKING

from wearsim.command.calculation_command import calculation

if TYPE_CHECKING:
    from wearsim.report.calculation_sheet import CalculationSheet


@calculation("face-load", "Compute the face load factor of a misaligned pair.")
def face_load(case: Path, settings: tuple[str, ...]) -> "CalculationSheet":
    """Compute the load distribution over the face width of the pair of CASE, and wear the flanks.

    Misalignment that is the same at every mesh runs in; misalignment that changes from mesh to mesh
    does not. Both a fixed and a self-aligning pinion are computed.
    """
    from wearsim.handbook.face_load.keys import FaceLoadTables
    from wearsim.handbook.face_load.sheet import face_load_sheet
    from wearsim.input.document import defaults_taken, load_calculation

    tables = load_calculation(case, FaceLoadTables, settings)
    return face_load_sheet(tables.title, tables.factors(), defaults_taken(tables))
