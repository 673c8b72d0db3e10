"""The whole input file, one module a table."""

from pydantic import Field

from wearsim.input.schema.chain import ChainTable
from wearsim.input.schema.drive import DriveTable, JointTable, MechanismTable
from wearsim.input.schema.fatigue import SprocketFatigueTable
from wearsim.input.schema.load import DutyBlock, LoadTable
from wearsim.input.schema.maintenance import MaintenanceTable, ServiceTable
from wearsim.input.schema.material import MaterialsTable, MaterialTable
from wearsim.input.schema.optimise import OptimiseTable
from wearsim.input.schema.run import RunTable, StopTable
from wearsim.input.schema.sprocket import SprocketTable
from wearsim.input.schema.table import FormatVersion, Table
from wearsim.input.schema.uncertainty import Uncertainty
from wearsim.input.schema.wear import WearTable

__all__ = [
    "CaseTables",
    "ChainTable",
    "DriveTable",
    "DutyBlock",
    "JointTable",
    "LoadTable",
    "MaintenanceTable",
    "MaterialTable",
    "MaterialsTable",
    "MechanismTable",
    "RunTable",
    "ServiceTable",
    "SprocketTable",
    "StopTable",
    "Table",
    "WearTable",
]


class CaseTables(Table):
    """The tables of an input file as they were given."""

    format_version: FormatVersion
    title: str = ""
    chain: ChainTable
    sprocket: SprocketTable | None = None
    drive: DriveTable | None = None
    mechanism: MechanismTable = MechanismTable()
    joint: JointTable | None = None
    material: MaterialsTable = MaterialsTable()
    load: LoadTable = LoadTable()
    duty: list[DutyBlock] = Field(default_factory=list)
    wear: WearTable
    fatigue: SprocketFatigueTable | None = None
    stop: StopTable = StopTable()
    run: RunTable = RunTable()
    maintenance: MaintenanceTable | None = None
    service: ServiceTable | None = None
    uncertainty: Uncertainty | None = None
    optimise: OptimiseTable | None = None
