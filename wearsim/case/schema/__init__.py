"""The whole input file, one module a table."""

from pydantic import Field

from wearsim.case.schema.calculation import FormatVersion
from wearsim.case.schema.chain import ChainTable
from wearsim.case.schema.drive import DriveTable
from wearsim.case.schema.duty import DutyBlock
from wearsim.case.schema.fatigue import SprocketFatigueTable
from wearsim.case.schema.joint import JointTable
from wearsim.case.schema.load import LoadTable
from wearsim.case.schema.maintenance import MaintenanceTable
from wearsim.case.schema.material import MaterialsTable, MaterialTable
from wearsim.case.schema.mechanism import MechanismTable
from wearsim.case.schema.optimise import OptimiseTable
from wearsim.case.schema.run import RunTable
from wearsim.case.schema.service import ServiceTable
from wearsim.case.schema.sprocket import SprocketTable
from wearsim.case.schema.stop import StopTable
from wearsim.case.schema.table import Table
from wearsim.case.schema.uncertainty import Uncertainty
from wearsim.case.schema.wear import WearTable

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
