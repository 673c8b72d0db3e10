"""A drive with all of its sprockets, `[[sprocket]]`, taken apart into the cases of each of them."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from wearsim.case.model import Case
from wearsim.catalogue.catalogues import USUAL_CONDITION
from wearsim.drive.drive_case import DriveCase, DriveSprocket
from wearsim.drive.refused_keys import GIVEN_BY_WHEELS, check_prices, check_tables, table_of
from wearsim.drive.wheels import (
    DRIVEN,
    DRIVER,
    IDLER,
    DriveWheel,
    check_block_shares,
    drive_wheels,
    place_of,
    plain_number,
    power_shares,
)
from wearsim.errors import CaseError, Fault
from wearsim.input.document import Document
from wearsim.input.faults import Faults
from wearsim.lubrication.keys import with_wear_condition
from wearsim.mechanisms.wrap.build import read
from wearsim.mechanisms.wrap.drive import WrapLoad, wrap_drive
from wearsim.mechanisms.wrap.place_in_loop import LOOP_KEY
from wearsim.quantities import DAYS_OF_YEAR

SERVICE_YEARS, LONGEST = 100.0, 7e4
"""Years of service, and hours, after which the runs of a drive with [service] end that gives no horizon.

Nobody plans a part for more: 70 000 h are eight years without a stop.
"""

JOINT_FRICTION = 0.11
"""Coefficient of friction of the joints where a drive gives none, of lubricated steel at the boundary."""


_GIVES_LINKS = "centre_distance_mm"
"""Key of [drive] from which the links follow."""


def read_drive(document: Document) -> DriveCase:
    """Return the drive of a document; raises `CaseError` with everything that is wrong with it."""
    check_tables(document)
    wheels = drive_wheels(document)
    document.faults.check()
    check_prices(document, wheels)
    shares = power_shares(document, wheels)
    check_block_shares(document, wheels)
    document.faults.check()
    sprockets = _sprockets(document, wheels, shares)
    document.faults.check()
    title = document.data.get("title") or _title(wheels, sprockets[0].case)
    assert document.given is not None
    return DriveCase(document.name, title, document.data, tuple(sprockets), tuple(wheels), document.given)


def _title(wheels: Sequence[DriveWheel], first: Case) -> str:
    teeth = " to ".join(_teeth_in_words(wheel) for wheel in wheels if wheel.role != IDLER)
    chain = first.inputs["chain"].get("designation", f"chain of {first.inputs['chain'].get('pitch_mm')} mm")
    idlers = sum(wheel.role == IDLER for wheel in wheels)
    more = f" and {idlers} idler{'s' if idlers > 1 else ''}" if idlers else ""
    return f"{chain}, {teeth} teeth{more}"


def _teeth_in_words(wheel: DriveWheel) -> str:
    if not wheel.cogs:
        return str(wheel.table["teeth"])
    teeth = [teeth for teeth, _ in wheel.cogs]
    return f"{min(teeth)}-{max(teeth)}"


def _sprockets(
    document: Document, wheels: Sequence[DriveWheel], shares: tuple[float, ...]
) -> list[DriveSprocket]:
    """Return the cases of all sprockets; what is wrong with them goes to the faults of the drive."""
    seen: set[tuple[str, str]] = set()
    found: dict[int, list[DriveSprocket]] = {}
    links: int | None = None
    first = sorted(enumerate(wheels), key=lambda entry: (bool(entry[1].cogs), entry[1].role != DRIVER))
    for number, wheel in first:
        found[number] = []
        all_teeth = [teeth for teeth, _ in wheel.cogs] or [int(wheel.table["teeth"])]
        for name, teeth in zip(wheel.parts, all_teeth, strict=True):
            running = [
                replace(one, table={**one.table, "teeth": teeth}) if one is wheel else one for one in wheels
            ]
            case = _case(document, running, shares, number, seen, links if wheel.cogs else None)
            if case is not None:
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
                "the chain turns on the cogs by their shares of time; wrap as on the one used most"
                if cog is None
                else f"the chain runs on this cog {100.0 * time_share:.4g} % of the time and grows on all",
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
    wheels: Sequence[DriveWheel],
    shares: tuple[float, ...],
    number: int,
    seen: set[tuple[str, str]],
    links: int | None,
) -> Case | None:
    """Return the case of one sprocket; what is wrong with it is added to the faults of the drive."""
    tables = _tables(document.data, wheels, number)
    if links is not None:
        tables["drive"] = {key: value for key, value in tables["drive"].items() if key != _GIVES_LINKS}
        tables["drive"]["links"] = links
    own = Document(document.name, document.folder, tables, Faults("", "", ()))
    place = None if wheels[number].place.position_mm is None else place_of(wheels, shares, number)
    case = None
    try:
        case = read(own, place)
        case.drive.check(case)
        return case
    except CaseError as error:
        for fault in error.faults:
            key, message = _key(fault, wheels, number), fault.message
            # Of loop and load each sprocket has the same fault in other numbers.
            alike = fault.key == LOOP_KEY or key.partition(".")[0] in ("load", "duty")
            if case is not None and not alike:
                message = f"{wheels[number].name!r}: {message}"
                key = _slack_key(key, wheels)
            same = (key, "" if alike else message)
            if same not in seen:
                document.faults.add(key, message)
            seen.add(same)
        return None


def _slack_key(key: str, wheels: Sequence[DriveWheel]) -> str:
    """Return the key that gives the slack tension of a drive, where it is about that: a force of its own."""
    forced = [
        number
        for number, wheel in enumerate(wheels, start=1)
        if wheel.place.take_up is not None and wheel.place.take_up.tensioner_force_N is not None
    ]
    if key != "drive.slack_tension_N" or not forced:
        return key
    return f"sprocket.{forced[0]}.take_up.tensioner_force_N"


def _key(fault: Fault, wheels: Sequence[DriveWheel], number: int) -> str:
    """Return the key of the file that a fault of the case of one sprocket comes from."""
    key = fault.key
    if key == LOOP_KEY:
        named = [
            (fault.message.find(repr(wheel.name)), place)
            for place, wheel in enumerate(wheels, start=1)
            if repr(wheel.name) in fault.message
        ]
        return f"sprocket.{min(named)[1]}" if named else "sprocket"
    table, _, name = key.partition(".")
    if table == "sprocket":
        return f"sprocket.{number + 1}.{name}".rstrip(".")
    own = wheels[number].own
    if table in own and table == "wear":
        return f"sprocket.{number + 1}.{key}"
    if key.startswith("material.sprocket") and "material" in own:
        return f"sprocket.{number + 1}.material{key.removeprefix('material.sprocket')}"
    return key


def _tables(data: Mapping[str, Any], wheels: Sequence[DriveWheel], number: int) -> dict[str, Any]:
    """Return the tables of the case of one sprocket: its teeth, its speed and its torque."""
    wheel = wheels[number]
    driver = next(one for one in wheels if one.role == DRIVER)
    drive = {"joint_friction": JOINT_FRICTION, **table_of(data, "drive")}
    if wheel.place.position_mm is None:
        drive[GIVEN_BY_WHEELS] = wheels[1 - number].rollers
    run, service = table_of(data, "run"), table_of(data, "service")
    hours_per_day = service.get("hours_per_day")
    if isinstance(hours_per_day, int | float) and 0.0 < hours_per_day <= 24.0:
        run = {"horizon_hours": min(LONGEST, SERVICE_YEARS * DAYS_OF_YEAR * hours_per_day), **run}
    tables: dict[str, Any] = {
        **{key: value for key, value in data.items() if key != "title"},
        "run": run,
        "sprocket": {**wheel.table, "role": DRIVER if wheel.role == DRIVER else DRIVEN},
        "drive": drive,
        "mechanism": {"kind": "wrap", **table_of(data, "mechanism")},
    }
    if "wear" in wheel.own:
        tables["wear"] = wheel.own["wear"]
        # All sprockets have one chain: its joints take the state of the drive, not that of this sprocket.
        shared = with_wear_condition(data).get("wear", driver.own.get("wear", {}))
        of_drive = table_of({"wear": shared}, "wear").get("condition")
        tables["joint"] = {"condition": of_drive or USUAL_CONDITION, **table_of(data, "joint")}
    if wheel.place.price is not None:
        tables["maintenance"] = {**table_of(data, "maintenance"), "sprocket_price": wheel.place.price}
    if "material" in wheel.own:
        tables["material"] = {**table_of(data, "material"), "sprocket": wheel.own["material"]}
    if wheel is not driver:
        ratio = driver.rollers / wheel.rollers
        if isinstance(data.get("load"), dict):
            tables["load"] = _turned(data["load"], ratio)
        if isinstance(data.get("duty"), list):
            tables["duty"] = [
                _turned(block, ratio) if isinstance(block, dict) else block for block in data["duty"]
            ]
    return tables


def _turned(load: Mapping[str, Any], ratio: float) -> dict[str, Any]:
    """Return a load of the driver as that of a sprocket that turns by ``ratio`` times its speed."""
    turned = dict(load)
    for key, unit, factor in (("speed_rpm", "rpm", ratio), ("torque_N_m", "N*m", 1.0 / ratio)):
        value = plain_number(load.get(key), unit)
        if value is not None:
            turned[key] = value * factor
    if "duty_file" in load:
        # The log stays that of the driver.
        turned["duty_speed_ratio"] = ratio * (plain_number(load.get("duty_speed_ratio"), "") or 1.0)
    return turned
