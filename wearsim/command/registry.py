"""The input files other than that of a chain drive."""

from wearsim.handbook.convex_concave.keys import ConvexConcaveTables
from wearsim.handbook.face_load.keys import FaceLoadTables
from wearsim.handbook.hertz_check.keys import HertzCheckTables
from wearsim.handbook.stiffness_spectrum.keys import StiffnessSpectrumTables
from wearsim.handbook.strength.keys import StrengthTables
from wearsim.handbook.synthesise.keys import SynthesisTables
from wearsim.handbook.wave_drive.keys import WaveDriveTables
from wearsim.input.schema.calculation import CalculationTables
from wearsim.input.schema.gear import GearTables
from wearsim.study.sweep.keys import SweepTables

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
