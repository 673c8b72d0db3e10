"""From the tables of a pair of gears to a complete case."""

from wearsim.case.model import Case
from wearsim.case.table_inputs import (
    contact_modulus_of,
    fatigue_input,
    film_input,
    run_input,
    take_defaults,
    wear_input,
)
from wearsim.input.document import Document, checked
from wearsim.input.faults import CaseRecord
from wearsim.lubrication.read import lubrication_input
from wearsim.mechanisms.gear_pair.build import gear_drive
from wearsim.mechanisms.gear_pair.keys import GearTable, GearTables


def read_gears(document: Document) -> Case:
    """Return the case of a gear pair, or raise all that is wrong with it."""
    tables, faults = checked(document, GearTables), document.faults
    case = CaseRecord(tables, document.folder, faults)
    take_defaults(case, tables)
    materials = tables.material
    modulus = contact_modulus_of(case, {"pinion": materials.pinion, "wheel": materials.wheel})
    wear = wear_input(case, tables.wear)
    if wear.pressure_exponent < 1.0:
        faults.add(
            "wear.pressure_exponent",
            "must be at least 1 on gears: below 1 a pit deepens itself and the problem is ill-posed "
            f"(got {wear.pressure_exponent:g})",
        )
    drive = gear_drive(case, tables, modulus)
    run = run_input(case, tables.run)
    limit = tables.stop.wheel_critical_depth_mm
    if limit is None:
        limit = tables.stop.critical_depth_mm
        case.take("stop.wheel_critical_depth_mm", limit, "as of the pinion")
    fatigue = fatigue_input(case, tables.fatigue)
    lubrication = lubrication_input(case, tables.lubrication, None, None, None)
    faults.check()
    assert drive is not None
    return Case(
        name=document.name,
        title=tables.title or _title(tables.gear),
        inputs=case.inputs,
        files=(),
        input_files={},
        drive=drive,
        modulus=modulus,
        speed_rpm=tables.load.speed_rpm,
        engaged_every=1,
        turns_per_cycle=1,
        wear=wear,
        critical_depth=tables.stop.critical_depth_mm,
        more_limits={"wheel_critical_depth_mm": limit},
        run=run,
        fatigue=fatigue,
        assumptions=tuple(case.assumptions),
        warnings=tuple(case.warnings),
        given=document.given,
        lubrication=lubrication,
        film=film_input(tables.film),
    )


def _title(gear: GearTable) -> str:
    """What a case is about that has no title of its own."""
    form = gear.profile.replace("_", "-").capitalize()
    return f"{form} gears {gear.pinion_teeth}/{gear.wheel_teeth}, module {gear.module_mm:g} mm"
