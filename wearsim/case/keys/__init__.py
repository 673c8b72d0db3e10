"""The whole input file of a drive with a chain."""

from typing import Any

from pydantic import ConfigDict, Field, model_validator

from wearsim.case.keys.drive_tables import (
    ChainTable,
    DriveTable,
    DutyBlock,
    JointTable,
    LoadTable,
    MechanismTable,
    PlacedSprocketTable,
    PlaceTable,
    SprocketTable,
    TakeUpTable,
)
from wearsim.case.keys.maintenance_table import MaintenanceTable, maintenance_of
from wearsim.case.keys.study_tables import OptimiseTable, ServiceTable, Uncertainty
from wearsim.case.keys.wear_tables import (
    FilmTable,
    MaterialsTable,
    MaterialTable,
    RunTable,
    SprocketFatigueTable,
    StopTable,
    WearTable,
)
from wearsim.input.table import FormatVersion, Table, describe
from wearsim.input.texts import Title
from wearsim.lubrication.keys import LubricationTable, with_wear_condition

__all__ = [
    "CaseTables",
    "CaseTablesOrDrive",
    "ChainTable",
    "DriveTable",
    "DriveTables",
    "DutyBlock",
    "JointTable",
    "LoadTable",
    "LubricationTable",
    "MaintenanceTable",
    "MaterialTable",
    "MaterialsTable",
    "MechanismTable",
    "PlaceTable",
    "PlacedSprocketTable",
    "RunTable",
    "ServiceTable",
    "SprocketTable",
    "StopTable",
    "Table",
    "TakeUpTable",
    "WearTable",
    "maintenance_of",
]


def _wear_or_lubricant(schema: dict[str, Any]) -> None:
    """Let a schema ask for [wear] only where no lubricant gives the wear condition."""
    describe(schema)
    schema["required"] = [name for name in schema["required"] if name != "wear"]
    schema["anyOf"] = [{"required": ["wear"]}, {"required": ["lubrication"]}]


class CaseTables(Table):
    """The tables of an input file as they were given."""

    model_config = ConfigDict(json_schema_extra=_wear_or_lubricant)

    @model_validator(mode="before")
    @classmethod
    def _wear_of_lubricant(cls, tables: Any) -> Any:
        return with_wear_condition(tables)

    format_version: FormatVersion
    title: Title = ""
    chain: ChainTable
    sprocket: SprocketTable | None = None
    drive: DriveTable | None = None
    mechanism: MechanismTable = MechanismTable()
    joint: JointTable | None = None
    material: MaterialsTable = MaterialsTable()
    load: LoadTable = LoadTable()
    duty: list[DutyBlock] = Field(default_factory=list)
    lubrication: LubricationTable | None = None
    wear: WearTable
    film: FilmTable | None = None
    fatigue: SprocketFatigueTable | None = None
    stop: StopTable = StopTable()
    run: RunTable = RunTable()
    maintenance: MaintenanceTable | None = None
    service: ServiceTable | None = None
    uncertainty: Uncertainty | None = None
    optimise: OptimiseTable | None = None

    @classmethod
    def gives_way(cls, key: str, value: Any) -> tuple[str, ...]:
        """Return the keys whose place a new value of a key takes: a load that of a duty, and back."""
        if key == "duty":
            return tuple(f"load.{name}" for name in LoadTable.model_fields)
        return ("duty",) if key.partition(".")[0] == "load" else ()


class DriveTables(CaseTables):
    """The tables of a drive with all of its sprockets."""

    sprocket: list[PlacedSprocketTable]  # type: ignore[assignment]
    wear: WearTable | None = None  # type: ignore[assignment]
    """None where every sprocket has its own."""


class CaseTablesOrDrive(CaseTables):
    """The same, or those of a drive with all of its sprockets, for the schema."""

    sprocket: SprocketTable | list[PlacedSprocketTable] | None = None  # type: ignore[assignment]
