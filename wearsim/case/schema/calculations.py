"""The input files of all calculations, by the command that reads them."""

from wearsim.case.schema.calculation import CalculationTables
from wearsim.case.schema.synthesis import SynthesisTables
from wearsim.case.schema.wave_drive import WaveDriveTables

CALCULATIONS: dict[str, type[CalculationTables]] = {
    "wave-drive": WaveDriveTables,
    "synthesise": SynthesisTables,
}
