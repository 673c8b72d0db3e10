"""``wearsim handbook stiffness-spectrum``: lines of the mesh stiffness of gears with pitch errors."""

from pathlib import Path
from typing import TYPE_CHECKING

from wearsim.command.calculation_command import calculation

if TYPE_CHECKING:
    from wearsim.report.calculation_sheet import CalculationSheet


@calculation("stiffness-spectrum", "Compute the mesh stiffness spectrum with pitch errors.")
def stiffness_spectrum(case: Path, settings: tuple[str, ...]) -> "CalculationSheet":
    """Compute the spectrum of the mesh stiffness of the gear pair of CASE with its pitch errors.

    Gives the harmonics of the tooth frequency fz and their sidebands at the turns f1 of the pinion
    and f2 of the wheel, exactly and by the closed form of the source; with a load, also deflection
    and stiffness.
    """
    from wearsim.handbook.stiffness_spectrum.keys import StiffnessSpectrumTables
    from wearsim.handbook.stiffness_spectrum.sheet import stiffness_spectrum_sheet
    from wearsim.input.document import load_calculation

    tables = load_calculation(case, StiffnessSpectrumTables, settings)
    return stiffness_spectrum_sheet(tables, tables.answer())
