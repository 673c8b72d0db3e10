"""The tables of one sprocket of a drive, as those of a case of it alone: its teeth, speed and torque."""

from collections.abc import Sequence
from typing import Any, TypeVar

from wearsim.case.keys import (
    CaseTables,
    DriveTable,
    DriveTables,
    DutyBlock,
    JointTable,
    LoadTable,
    MaintenanceTable,
    RunTable,
    Table,
)
from wearsim.catalogue.catalogues import USUAL_CONDITION
from wearsim.drive.wheels import DRIVEN, DRIVER, DriveWheel
from wearsim.quantities import DAYS_OF_YEAR

SERVICE_YEARS, LONGEST = 100.0, 7e4
"""Years of service, and hours, after which the runs of a drive with [service] end that gives no horizon.

Nobody plans a part for more: 70 000 h are eight years without a stop.
"""

JOINT_FRICTION = 0.11
"""Coefficient of friction of the joints where a drive gives none, of lubricated steel at the boundary."""

_Table = TypeVar("_Table", bound=Table)


def part_tables(
    tables: DriveTables, wheels: Sequence[DriveWheel], number: int, links: int | None
) -> CaseTables:
    """Return the tables of the case of one sprocket, with these links where they are known."""
    wheel, driver = wheels[number], next(one for one in wheels if one.role == DRIVER)
    own = wheel.table
    parts: dict[str, Any] = {
        "title": "",
        "run": _run(tables),
        "sprocket": own.alone(teeth=wheel.teeth, role=DRIVER if wheel.role == DRIVER else DRIVEN),
        "drive": _drive(tables, wheels, number, links),
        "mechanism": tables.mechanism.model_copy(update={"kind": "wrap"}),
    }
    if own.wear is not None:
        # All sprockets have one chain: its joints take the state of the drive, not that of this sprocket.
        of_drive = tables.wear or driver.table.wear
        condition = (of_drive.condition if of_drive else None) or USUAL_CONDITION
        parts |= {"wear": own.wear, "joint": _filled(tables.joint or JointTable(), condition=condition)}
    if own.price is not None:
        prices = tables.maintenance or MaintenanceTable()
        parts["maintenance"] = prices.model_copy(update={"sprocket_price": own.price})
    if own.material is not None:
        parts["material"] = tables.material.model_copy(update={"sprocket": own.material})
    if wheel is not driver:
        ratio = driver.rollers / wheel.rollers
        if "load" in tables.model_fields_set:
            parts["load"] = _turned(tables.load, ratio)
        parts["duty"] = [_turned(block, ratio) for block in tables.duty]
    of_all = {name: getattr(tables, name) for name in CaseTables.model_fields}
    return CaseTables.model_construct(tables.model_fields_set | parts.keys(), **{**of_all, **parts})


def _filled(table: _Table, **values: Any) -> _Table:
    """Return a table with values of keys that it does not give."""
    return table.model_copy(
        update={key: value for key, value in values.items() if key not in table.model_fields_set}
    )


def _run(tables: DriveTables) -> RunTable:
    per_day = tables.service.hours_per_day if tables.service else None
    if per_day is None:
        return tables.run
    return _filled(tables.run, horizon_hours=min(LONGEST, SERVICE_YEARS * DAYS_OF_YEAR * per_day))


def _drive(tables: DriveTables, wheels: Sequence[DriveWheel], number: int, links: int | None) -> DriveTable:
    drive = _filled(tables.drive or DriveTable(), joint_friction=JOINT_FRICTION)
    if wheels[number].table.position_mm is None:
        drive = drive.model_copy(update={"mate_teeth": wheels[1 - number].rollers})
    if links is None:
        return drive
    # The centre distance would give them anew.
    return drive.model_copy(update={"links": links, "centre_distance_mm": None})


def _turned(load: LoadTable | DutyBlock, ratio: float) -> Any:
    """Return a load of the driver as that of a sprocket that turns by ``ratio`` times its speed."""
    turned: dict[str, float] = {}
    if load.speed_rpm is not None:
        turned["speed_rpm"] = load.speed_rpm * ratio
    if load.torque_N_m is not None:
        turned["torque_N_m"] = load.torque_N_m * (1.0 / ratio)
    if isinstance(load, LoadTable) and load.duty_file is not None:
        # The log stays that of the driver.
        turned["duty_speed_ratio"] = ratio * (load.duty_speed_ratio or 1.0)
    return load.model_copy(update=turned)
