"""``wearsim handbook wave-drive``: diameter of a flexspline by several methods."""

from pathlib import Path
from typing import TYPE_CHECKING

from wearsim.command.calculation_command import calculation

if TYPE_CHECKING:
    from wearsim.report.calculation_sheet import CalculationSheet


@calculation("wave-drive", "Size the flexspline of a wave gear by eight methods.")
def wave_drive(case: Path, settings: tuple[str, ...]) -> "CalculationSheet":
    """Size the flexspline of the wave drive of CASE by the methods of six textbooks.

    Each method gives a diameter, its range over the recommended values, and what it rests on.
    Published diameters are compared.
    """
    from wearsim.handbook.wave_drive.keys import WaveDriveTables
    from wearsim.handbook.wave_drive.sheet import wave_drive_sheet
    from wearsim.input.document import defaults_taken, load_calculation

    tables = load_calculation(case, WaveDriveTables, settings)
    return wave_drive_sheet(tables.title, tables.diameters(), defaults_taken(tables))
