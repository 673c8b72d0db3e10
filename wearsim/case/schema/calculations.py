"""The input files of all calculations, by the command that reads them."""

from wearsim.case.schema.calculation import CalculationTables
from wearsim.case.schema.face_load import FaceLoadTables
from wearsim.case.schema.wave_drive import WaveDriveTables

CALCULATIONS: dict[str, type[CalculationTables]] = {
    "wave-drive": WaveDriveTables,
    "face-load": FaceLoadTables,
}
