"""``wearsim wave-drive``: diameter of a flexspline by several methods."""

from pathlib import Path
from typing import TYPE_CHECKING

from wearsim.command.calculation_command import calculation

if TYPE_CHECKING:
    from wearsim.command.calculation_sheet import CalculationSheet


@calculation("wave-drive", "Flexspline diameter of a wave gear by eight methods.")
def wave_drive(case: Path, settings: tuple[str, ...]) -> "CalculationSheet":
    """Size the flexspline of the wave drive of CASE by the methods of six textbooks side by side.

    Each gives its diameter, the range over the values recommended for it, and what its result
    rests on; diameters that were published are held against it.
    """
    from wearsim.handbook.wave_drive.keys import WaveDriveTables
    from wearsim.handbook.wave_drive.sheet import wave_drive_sheet
    from wearsim.input.calculation_file import defaults_taken, load_calculation

    tables = load_calculation(case, WaveDriveTables, settings)
    return wave_drive_sheet(tables.title, tables.diameters(), defaults_taken(tables))
