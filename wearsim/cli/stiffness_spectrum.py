"""``wearsim stiffness-spectrum``: lines of the mesh stiffness of gears with pitch errors."""

from pathlib import Path
from typing import TYPE_CHECKING

from wearsim.cli.calculation import calculation

if TYPE_CHECKING:
    from wearsim.report.sheet import Sheet


@calculation("stiffness-spectrum", "Spectrum of the mesh stiffness of gears with pitch errors.")
def stiffness_spectrum(case: Path, settings: tuple[str, ...]) -> "Sheet":
    """Give the lines of the mesh stiffness of the gear pair of CASE with its pitch errors.

    Harmonics of the tooth frequency fz and their sidebands at the turns f1 of the pinion and f2
    of the wheel, exactly and by the closed form of the source; with a load also deflection and
    stiffness.
    """
    from wearsim.case.calculation import load_calculation
    from wearsim.case.schema.stiffness_spectrum import StiffnessSpectrumTables
    from wearsim.report.stiffness_spectrum import stiffness_spectrum_sheet
    from wearsim.sizing.stiffness_spectrum import stiffness_spectrum as spectrum

    tables = load_calculation(case, StiffnessSpectrumTables, settings)
    return stiffness_spectrum_sheet(tables, spectrum(tables))
