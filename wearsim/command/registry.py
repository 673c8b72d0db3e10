"""The one list of the input files other than that of a chain drive: whose tables they hold."""

from importlib import import_module

from wearsim.input.table import CalculationTables

_HANDBOOK = {
    "strength": "StrengthTables",
    "stiffness-spectrum": "StiffnessSpectrumTables",
    "wave-drive": "WaveDriveTables",
    "face-load": "FaceLoadTables",
    "convex-concave": "ConvexConcaveTables",
    "synthesise": "SynthesisTables",
    "hertz-check": "HertzCheckTables",
}
CALCULATIONS = tuple(_HANDBOOK)
"""Commands that read an input file of their own."""

_PLACES = {
    "gear": ("wearsim.mechanisms.gear_pair.keys", "GearTables"),
    "sweep": ("wearsim.study.sweep.keys", "SweepTables"),
    "reading": ("wearsim.readings.shared_reading", "SharedReading"),
    **{
        command: (f"wearsim.handbook.{command.replace('-', '_')}.keys", name)
        for command, name in _HANDBOOK.items()
    },
}
OTHER_FILES = tuple(_PLACES)
"""Names of all such files."""


def tables_of(name: str) -> type[CalculationTables]:
    """Return the tables of one of `OTHER_FILES`; only these are imported."""
    module, tables = _PLACES[name]
    found: type[CalculationTables] = getattr(import_module(module), tables)
    return found
