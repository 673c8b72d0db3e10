"""The input files of all calculations, by the command that reads them."""

from wearsim.case.schema.calculation import CalculationTables
from wearsim.case.schema.convex_concave import ConvexConcaveTables
from wearsim.case.schema.wave_drive import WaveDriveTables

CALCULATIONS: dict[str, type[CalculationTables]] = {
    "wave-drive": WaveDriveTables,
    "convex-concave": ConvexConcaveTables,
}
