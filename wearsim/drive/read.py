"""A drive with all of its sprockets, `[[sprocket]]`, taken apart into the cases of each of them."""

import copy
import math
from collections.abc import Collection, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from wearsim.case.keys import CaseTables, DriveTables, WearTable
from wearsim.case.model import Case
from wearsim.drive.drive_case import DriveCase, DriveSprocket
from wearsim.drive.part_tables import part_tables
from wearsim.drive.read_sprocket import STAND_INS, complete_case, sound_tables
from wearsim.drive.wheels import (
    DRIVER,
    IDLER,
    DriveWheel,
    check_block_shares,
    check_prices,
    drive_wheels,
    place_of,
    power_shares,
)
from wearsim.errors import CaseError
from wearsim.input.document import Document
from wearsim.input.faults import Faults, PartFaults
from wearsim.mechanisms.wrap.build import wrapped_drive
from wearsim.mechanisms.wrap.drive import WrapLoad, wrap_drive
from wearsim.mechanisms.wrap.place_in_loop import LOOP_KEY

_OF_ONE_SPROCKET = {
    "fatigue": "contact fatigue applies to cases of one sprocket only: remove this table",
    "drive.mate_teeth": "the other [[sprocket]] gives this: remove it",
    "maintenance.turn_sprocket": (
        "applies to cases of one sprocket only, a drive is planned without turning: remove it"
    ),
    "maintenance.replace_at_percent": (
        "applies to cases of one sprocket only, the chain of a drive is replaced at "
        "stop.elongation_percent: remove it"
    ),
}
"""Tables and keys that a drive has no use for."""

_IN_NUMBERS = ("load", "duty", LOOP_KEY)
"""Tables of which each sprocket has the same fault in other numbers."""


def read_drive(document: Document) -> DriveCase:
    """Return the drive of a document; raises `CaseError` with everything that is wrong with it."""
    faults = document.faults
    tables, wrong = sound_tables(_of_a_drive(document), faults, DriveTables)
    before = faults.count
    wheels = drive_wheels(tables, faults)
    if faults.count > before:
        faults.check()
    check_prices(tables, faults)
    shares = power_shares(tables, wheels, faults)
    check_block_shares(tables, wheels, faults)
    if faults.count > before:
        faults.check()
    if tables.wear is None and any(table.wear is None for table in tables.sprocket):
        faults.add("wear", "this table is required and missing")
        tables = tables.model_copy(update={"wear": WearTable(**STAND_INS["wear"])})
        wrong |= {"wear"}
    faults.distrust(wrong)
    sprockets = _sprockets(document, tables, wheels, shares, wrong)
    faults.check()
    title = tables.title or _title(wheels, sprockets[0].case)
    assert document.given is not None
    return DriveCase(document.name, title, document.data, tuple(sprockets), tuple(wheels), document.given)


def _of_a_drive(document: Document) -> dict[str, Any]:
    """Return the tables of a drive without what is for the case of one sprocket, which is named."""
    faults, data, sprockets = document.faults, copy.deepcopy(document.data), document.data["sprocket"]
    for key, message in _OF_ONE_SPROCKET.items():
        table, _, name = key.rpartition(".")
        place = data.get(table) if table else data
        if isinstance(place, dict) and place.pop(name, False) is not False:
            faults.add(key, message)
    mechanism = data.get("mechanism")
    if isinstance(mechanism, dict) and (kind := mechanism.pop("kind", "wrap")) != "wrap":
        message = f"the chain of a drive wraps its sprockets: must be 'wrap', or left out (got {kind!r})"
        faults.add("mechanism.kind", message)
    if not all(isinstance(table, dict) for table in sprockets):
        faults.add("sprocket", "must be tables under headers [[sprocket]]")
        faults.check()
    if len(sprockets) < 2:
        message = f"a drive must have two sprockets, a driver and a driven one (got {len(sprockets)})"
        faults.add("sprocket", message)
        faults.check()
    return data


def _title(wheels: Sequence[DriveWheel], first: Case) -> str:
    teeth = " to ".join(_teeth_in_words(wheel) for wheel in wheels if wheel.role != IDLER)
    chain = first.inputs["chain"].get("designation", f"chain of {first.inputs['chain'].get('pitch_mm')} mm")
    idlers = sum(wheel.role == IDLER for wheel in wheels)
    more = f" and {idlers} idler{'s' if idlers > 1 else ''}" if idlers else ""
    return f"{chain}, {teeth} teeth{more}"


def _teeth_in_words(wheel: DriveWheel) -> str:
    if not wheel.cogs:
        return str(wheel.teeth)
    teeth = [teeth for teeth, _ in wheel.cogs]
    return f"{min(teeth)}-{max(teeth)}"


def _sprockets(
    document: Document,
    tables: DriveTables,
    wheels: Sequence[DriveWheel],
    shares: tuple[float, ...],
    wrong: Collection[str],
) -> list[DriveSprocket]:
    """Return the cases of all sprockets; what is wrong with them goes to the faults of the drive."""
    found: dict[int, list[DriveSprocket]] = {}
    links: int | None = None
    # What stands in for a wrong table says nothing of whether the drive works.
    unsure = not all(name.startswith("sprocket.") for name in wrong)
    first = sorted(enumerate(wheels), key=lambda entry: (bool(entry[1].cogs), entry[1].role != DRIVER))
    for number, wheel in first:
        found[number] = []
        if f"sprocket.{number + 1}" in wrong:
            continue
        all_teeth = [teeth for teeth, _ in wheel.cogs] or [wheel.teeth]
        # A smooth idler is no part that wears.
        for name, teeth in zip(wheel.parts, all_teeth, strict=False):
            running = [replace(one, teeth=teeth) if one is wheel else one for one in wheels]
            own = part_tables(tables, running, number, links if wheel.cogs else None)
            case = _case(document, own, running, shares, number)
            if case is not None and not unsure and _works(document.faults, case, running, number):
                found[number].append(DriveSprocket(name, wheel.role, case))
                # One chain runs on all cogs: that which fits the one that runs longest.
                links = links or wrap_drive(case, "a drive has a chain").layout.links
    sprockets = [one for number in range(len(wheels)) for one in found[number]]
    place = next((place for place, wheel in enumerate(wheels) if wheel.cogs), None)
    if place is None or document.faults.count:
        return sprockets
    return _sharing_time(sprockets, wheels[place], place)


def _sharing_time(sprockets: list[DriveSprocket], cassette: DriveWheel, place: int) -> list[DriveSprocket]:
    """Return sprockets of which several are cogs of one place, between which the chain changes.

    The chain grows on every cog by its share of time, and on the others under the mean of their tensions.
    """
    shares = [share for _, share in cassette.cogs]
    cogs = [one.drive for one in sprockets[place : place + len(shares)]]
    rollers = [2.0 * math.pi / drive.pitch_angle / share for drive, share in zip(cogs, shares, strict=True)]
    found = []
    for number, one in enumerate(sprockets):
        cog = number - place if 0 <= number - place < len(shares) else None
        wheel = number if number < place else number - len(shares) + 1
        drive = one.drive
        if cog is None:
            # The mates of a sprocket stand in the order of the loop, this place among them.
            at = place - (place > wheel)
            mates = (*drive.mates[:at], *drive.mates[at + 1 :], *rollers)
        else:
            mates = (*drive.mates, *rollers[:cog], *rollers[cog + 1 :])
        loads = [
            tuple(
                _shared(load, [getattr(of, kind)[i] for of in cogs], shares, cog, (wheel, place))
                for i, load in enumerate(getattr(drive, kind))
            )
            for kind in ("blocks", "rated")
        ]
        time_share = 1.0 if cog is None else shares[cog]
        case = replace(
            one.case,
            speed_rpm=one.case.speed_rpm * time_share,
            drive=replace(drive, mates=mates, time_share=time_share, blocks=loads[0], rated=loads[1]),
            assumptions=(
                *one.case.assumptions,
                "the chain runs on each cog for its share of the time; wrap angles are those of the most "
                "used cog"
                if cog is None
                else f"the chain runs on this cog {100.0 * time_share:.4g} % of the time and elongates on "
                "all cogs",
            ),
        )
        found.append(replace(one, case=case))
    return found


def _shared(
    load: WrapLoad, on_cogs: Sequence[WrapLoad], shares: Sequence[float], cog: int | None, at: tuple[int, int]
) -> WrapLoad:
    """Return a load of a cog, or of another sprocket in its place, while the chain changes between cogs."""
    turns = _turns(on_cogs, shares, cog, *at)
    of_cogs = [on.turning_factors[0] for on in on_cogs]
    turned = (share * factor for share, factor in zip(shares, of_cogs, strict=True))
    mean = math.fsum(turned) / math.fsum(shares)
    # In the order of the tensions: the others turn with the cog that is in use.
    others = (mean,) * (len(on_cogs[0].turns) - 1)
    if cog is None:
        factors = (*others, *of_cogs)
    else:
        factors = (of_cogs[cog], *others, *of_cogs[:cog], *of_cogs[cog + 1 :])
    return replace(load, turns=turns, turning_factors=factors)


def _turns(
    on_cogs: Sequence[WrapLoad], shares: Sequence[float], cog: int | None, wheel: int, place: int
) -> tuple[tuple[float, float], ...]:
    """Return the tensions on both sides of all sprockets while the chain changes between cogs.

    First those of a cog, or of another sprocket by its number, then those of the others, of the cogs last.
    """
    of_cogs = [load.turns[0] for load in on_cogs]
    others = [
        (
            math.fsum(share * on for share, (on, _) in zip(shares, sides, strict=True)),
            math.fsum(share * off for share, (_, off) in zip(shares, sides, strict=True)),
        )
        for sides in zip(*(load.turns[1:] for load in on_cogs), strict=True)
    ]
    if cog is not None:
        return (of_cogs[cog], *others, *of_cogs[:cog], *of_cogs[cog + 1 :])
    own = wheel - (wheel > place)
    return (others[own], *others[:own], *others[own + 1 :], *of_cogs)


def _case(
    document: Document,
    tables: CaseTables,
    wheels: Sequence[DriveWheel],
    shares: tuple[float, ...],
    number: int,
) -> Case | None:
    """Return the case of one sprocket; what is wrong with it is added to the faults of the drive."""
    placed = wheels[number].table.position_mm is not None
    place = place_of(wheels, shares, number) if placed else None
    faults = PartFaults(document.faults, _places(wheels[number], number + 1), _IN_NUMBERS)
    own = Document(document.name, document.folder, {}, faults)
    return complete_case(tables, own, partial(wrapped_drive, place=place))


def _works(faults: Faults, case: Case, wheels: Sequence[DriveWheel], number: int) -> bool:
    """Tell whether a sprocket can run in the drive; what is wrong is added to the faults of the drive."""
    try:
        case.drive.check(case)
    except CaseError as error:
        own = PartFaults(faults, _place_of_slack(wheels), _IN_NUMBERS)
        for fault in error.faults:
            alike = fault.key in _IN_NUMBERS
            own.add(fault.key, fault.message if alike else f"{wheels[number].name!r}: {fault.message}")
        return False
    return True


def _place_of_slack(wheels: Sequence[DriveWheel]) -> dict[str, str]:
    """Return where the file gives the slack tension of a drive, if that is a force of its own."""
    for number, wheel in enumerate(wheels, start=1):
        if wheel.table.take_up is not None and wheel.table.take_up.tensioner_force_N is not None:
            return {"drive.slack_tension_N": f"sprocket.{number}.take_up.tensioner_force_N"}
    return {}


def _places(wheel: DriveWheel, number: int) -> dict[str, str]:
    """Return where the file holds tables of the case of one sprocket."""
    table = f"sprocket.{number}"
    places = {"sprocket": table, LOOP_KEY: "sprocket"}
    if wheel.table.wear is not None:
        places["wear"] = f"{table}.wear"
    if wheel.table.material is not None:
        places["material.sprocket"] = f"{table}.material"
    return places
