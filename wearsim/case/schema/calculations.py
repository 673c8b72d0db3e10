"""The input files other than that of a chain drive: of a gear pair, and by commands that read them."""

from wearsim.case.schema.calculation import CalculationTables
from wearsim.case.schema.gear import GearTables
from wearsim.case.schema.hertz_check import HertzCheckTables
from wearsim.case.schema.wave_drive import WaveDriveTables

CALCULATIONS: dict[str, type[CalculationTables]] = {
    "gear": GearTables,
    "hertz-check": HertzCheckTables,
    "wave-drive": WaveDriveTables,
}
