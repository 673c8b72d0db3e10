"""The input files of all calculations, by the command that reads them."""

from wearsim.case.schema.calculation import CalculationTables
from wearsim.case.schema.stiffness_spectrum import StiffnessSpectrumTables
from wearsim.case.schema.wave_drive import WaveDriveTables

CALCULATIONS: dict[str, type[CalculationTables]] = {
    "stiffness-spectrum": StiffnessSpectrumTables,
    "wave-drive": WaveDriveTables,
}
