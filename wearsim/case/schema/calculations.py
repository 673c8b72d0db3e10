"""The input files other than that of a chain drive."""

from wearsim.case.schema.calculation import CalculationTables
from wearsim.case.schema.convex_concave import ConvexConcaveTables
from wearsim.case.schema.face_load import FaceLoadTables
from wearsim.case.schema.gear import GearTables
from wearsim.case.schema.hertz_check import HertzCheckTables
from wearsim.case.schema.stiffness_spectrum import StiffnessSpectrumTables
from wearsim.case.schema.strength import StrengthTables
from wearsim.case.schema.sweep import SweepTables
from wearsim.case.schema.synthesis import SynthesisTables
from wearsim.case.schema.wave_drive import WaveDriveTables

CALCULATIONS: dict[str, type[CalculationTables]] = {
    "strength": StrengthTables,
    "stiffness-spectrum": StiffnessSpectrumTables,
    "wave-drive": WaveDriveTables,
    "face-load": FaceLoadTables,
    "convex-concave": ConvexConcaveTables,
    "synthesise": SynthesisTables,
    "hertz-check": HertzCheckTables,
}
"""By the command that reads them."""

OTHER_FILES: dict[str, type[CalculationTables]] = {
    "gear": GearTables,
    "sweep": SweepTables,
    **CALCULATIONS,
}
