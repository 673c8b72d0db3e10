"""The `[[sprocket]]` tables of a drive: who drives, who is driven, where each one stands."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from pydantic import ValidationError

from wearsim.case.keys import PlaceTable
from wearsim.chain.chain_loop import Wheel
from wearsim.input.document import Document
from wearsim.input.faults import Faults, validation_faults
from wearsim.input.units import convert
from wearsim.mechanisms.wrap.place_in_loop import GivenTakeUp, PlaceInLoop

DRIVER, DRIVEN, IDLER = "driver", "driven", "idler"

_OWN = ("wear", "material")
"""Tables of a sprocket that a case of one has in other places."""

_SUM_TOLERANCE = 1e-6
_POWER_TOLERANCE = 0.01
"""Part of the driver's power by which torques may miss it."""


@dataclass(frozen=True)
class DriveWheel:
    """A sprocket of a drive as its table gives it."""

    name: str
    role: str  # `driver`, `driven` or `idler`
    place: PlaceTable  # its own keys
    table: Mapping[str, Any]  # those of [sprocket]
    own: Mapping[str, Any]  # tables that take the place of [wear] and [material.sprocket], where it has some

    @property
    def every(self) -> int:
        """Gaps from one roller to the next."""
        every = self.table.get("engaged_every", 1)
        return every if type(every) is int and every >= 1 else 1

    @property
    def rollers(self) -> int:
        """Rollers that it takes along in a turn; of a cassette those of the cog that runs longest."""
        return int(self.table["teeth"]) // self.every

    @property
    def cogs(self) -> tuple[tuple[int, float], ...]:
        """Teeth and share of time of the cogs of a cassette; none of a single sprocket."""
        return tuple((cog.teeth, cog.share_of_time) for cog in self.place.cog or ())

    @property
    def parts(self) -> tuple[str, ...]:
        """Names under which it is run: its own, or those of all cogs of a cassette."""
        return tuple(f"{self.name} {teeth}T" for teeth, _ in self.cogs) or (self.name,)

    @property
    def turning(self) -> float:
        """Joints that turn on it while the chain goes round, over the angle of one: 1/z, a mean over time."""
        if not self.cogs:
            return 1.0 / self.rollers
        return math.fsum(share / teeth for teeth, share in self.cogs)


def drive_wheels(document: Document) -> list[DriveWheel]:
    """Return the sprockets of a drive in the order of the file; faults of them go to the document's."""
    faults, tables = document.faults, document.data["sprocket"]
    if not all(isinstance(table, dict) for table in tables):
        faults.add("sprocket", "must be tables under headers [[sprocket]]")
        return []
    if len(tables) < 2:
        faults.add(
            "sprocket", f"a drive must have two sprockets, a driver and a driven one (got {len(tables)})"
        )
        return []
    before = faults.count
    wheels = [_wheel(number, table, len(tables), faults) for number, table in enumerate(tables, start=1)]
    found = [wheel for wheel in wheels if wheel is not None]
    if faults.count == before:
        _check_together(found, faults)
    return found if faults.count == before else []


def part_names(tables: Mapping[str, Any]) -> tuple[str, ...]:
    """Return the names of the parts of a whole drive, the chain first; none of other cases.

    Examples
    --------
    >>> part_names({"sprocket": [{"name": "motor", "teeth": 21}, {"teeth": 57}]})
    ('chain', 'motor', 'driven')
    >>> part_names({"sprocket": {"teeth": 21}})
    ()
    """
    sprockets = tables.get("sprocket")
    if not isinstance(sprockets, list):
        return ()
    named = [table if isinstance(table, Mapping) else {} for table in sprockets]
    return "chain", *(wheel_name(table, number, len(named)) for number, table in enumerate(named, start=1))


def wheel_name(table: Mapping[str, Any], number: int, count: int) -> str:
    """Return the name of a sprocket; its role where it has none, with its number where there are many.

    Examples
    --------
    >>> wheel_name({"teeth": 17}, 1, 2), wheel_name({"role": "idler"}, 2, 3), wheel_name({"name": "a"}, 2, 2)
    ('driver', 'idler 2', 'a')
    """
    role = table.get("role") or (DRIVER if number == 1 else DRIVEN)
    return str(table.get("name") or (role if count == 2 else f"{role} {number}"))


def _wheel(number: int, table: Mapping[str, Any], count: int, faults: Faults) -> DriveWheel | None:
    own = set(PlaceTable.model_fields)
    try:
        place = PlaceTable.model_validate({key: value for key, value in table.items() if key in own})
    except ValidationError as error:
        for key, message, _ in validation_faults(error, PlaceTable):
            faults.add(f"sprocket.{number}.{key}", message)
        return None
    rest = {key: value for key, value in table.items() if key not in own}
    role = place.role or (DRIVER if number == 1 else DRIVEN)
    if place.cog:
        if "teeth" in rest:
            faults.add(f"sprocket.{number}.teeth", "the cogs give their own: remove one of both")
        rest["teeth"] = max(place.cog, key=lambda cog: cog.share_of_time).teeth
    teeth, key = rest.get("teeth"), f"sprocket.{number}"
    if not isinstance(teeth, int) or isinstance(teeth, bool) or teeth < 5:
        faults.add(f"{key}.teeth", f"must be a whole number of at least 5 (got {teeth!r})")
        return None
    name = wheel_name(table, number, count)
    wheel = DriveWheel(name, role, place, rest, {key: table[key] for key in _OWN if key in table})
    if wheel.every > 1 and teeth % wheel.every:
        message = f"must divide the number of teeth of a whole drive, {teeth} (got {wheel.every})"
        faults.add(f"{key}.engaged_every", message)
    return wheel


def _check_together(wheels: Sequence[DriveWheel], faults: Faults) -> None:
    _check_names(wheels, faults)
    roles = [wheel.role for wheel in wheels]
    for role in (DRIVER, DRIVEN):
        if role not in roles:
            other = ", ".join(repr(one) for one in roles)
            faults.add(
                f"sprocket.{len(wheels)}.role", f"at least one sprocket must be {role!r} (got {other})"
            )
    placed = [wheel.place.position_mm is not None for wheel in wheels]
    if any(placed) or len(wheels) > 2:
        missing = [number for number, there in enumerate(placed, start=1) if not there]
        if missing:
            which = ", ".join(repr(wheels[number - 1].name) for number in missing)
            message = (
                f"every sprocket of more than two, or of two with one placed, needs this: give {which} one"
            )
            faults.add(f"sprocket.{missing[0]}.position_mm", message)
    else:
        for number, wheel in enumerate(wheels, start=1):
            for key in ("outside", "take_up"):
                if getattr(wheel.place, key) not in (None, False):
                    faults.add(f"sprocket.{number}.{key}", "needs position_mm of both sprockets")
    takers = [number for number, wheel in enumerate(wheels, start=1) if wheel.place.take_up is not None]
    if len(takers) > 1:
        first = wheels[takers[0] - 1].name
        faults.add(
            f"sprocket.{takers[1]}.take_up",
            f"one sprocket takes up the slack, {first!r} does already: remove one of both",
        )
    cassettes = [number for number, wheel in enumerate(wheels, start=1) if wheel.cogs]
    if len(cassettes) > 1:
        faults.add(f"sprocket.{cassettes[1]}.cog", "one sprocket can have cogs: remove those of the other")


def _check_names(wheels: Sequence[DriveWheel], faults: Faults) -> None:
    taken: set[str] = set()
    for number, wheel in enumerate(wheels, start=1):
        key = f"sprocket.{number}.name"
        if wheel.name != wheel.name.strip() or not wheel.name.isprintable():
            faults.add(key, f"must be one line without blanks at its ends (got {wheel.name!r})")
        if wheel.name.lower() == "chain":
            faults.add(key, "must be another one: the chain is a part of its own")
        names = {wheel.name, *wheel.parts}
        if twice := sorted(names & taken):
            faults.add(key, f"sprockets need different names (got {twice[0]!r} twice)")
        taken |= names


def power_shares(document: Document, wheels: Sequence[DriveWheel]) -> tuple[float, ...]:
    """Return the share of each sprocket in the power: above 0 for drivers, below for driven, 0 for idlers."""
    found = dict.fromkeys((wheel.name for wheel in wheels), 0.0)
    driver = next(wheel for wheel in wheels if wheel.role == DRIVER)
    for role, sign in ((DRIVER, 1.0), (DRIVEN, -1.0)):
        of_role = [(number, wheel) for number, wheel in enumerate(wheels, start=1) if wheel.role == role]
        for name, share in _shares_of(document, of_role, driver).items():
            found[name] = sign * share
    return tuple(found.values())


def _shares_of(
    document: Document, wheels: Sequence[tuple[int, DriveWheel]], driver: DriveWheel
) -> dict[str, float]:
    faults, role = document.faults, wheels[0][1].role
    torques = [(number, wheel) for number, wheel in wheels if wheel.place.torque_N_m is not None]
    if torques and role == DRIVER:
        faults.add(
            f"sprocket.{torques[0][0]}.torque_N_m", "[load] gives that of the driver: remove one of both"
        )
        return {}
    if torques:
        return _shares_by_torque(document, wheels, driver)
    if len(wheels) == 1:
        number, wheel = wheels[0]
        share = 1.0 if wheel.place.power_share is None else wheel.place.power_share
        if abs(share - 1.0) > _SUM_TOLERANCE:
            message = f"the only {role} sprocket has all of the power: must be 1 (got {share:g})"
            faults.add(f"sprocket.{number}.power_share", message)
        return {wheel.name: 1.0}
    given = {wheel.name: wheel.place.power_share for _, wheel in wheels}
    for number, wheel in wheels:
        if wheel.place.power_share is None:
            message = f"required: {len(wheels)} {role} sprockets share the power"
            faults.add(f"sprocket.{number}.power_share", message)
    shares = {name: share for name, share in given.items() if share is not None}
    total = math.fsum(shares.values())
    if len(shares) == len(wheels) and abs(total - 1.0) > _SUM_TOLERANCE:
        message = f"the power must balance: shares of all {role} sprockets must sum to 1 (got {total:.9g})"
        faults.add(f"sprocket.{wheels[-1][0]}.power_share", message)
    return {name: share / total for name, share in shares.items()}


def _shares_by_torque(
    document: Document, wheels: Sequence[tuple[int, DriveWheel]], driver: DriveWheel
) -> dict[str, float]:
    """Return the shares of driven sprockets whose torques are given, which must balance the driver's."""
    faults = document.faults
    work = {}
    for number, wheel in wheels:
        if wheel.place.torque_N_m is None:
            faults.add(f"sprocket.{number}.torque_N_m", "required: others give theirs")
            continue
        work[wheel.name] = 2.0 * math.pi * wheel.place.torque_N_m * wheel.turning
    total = math.fsum(work.values())
    load = document.data.get("load")
    if isinstance(load, dict):
        turn = _work_of_driver(load, driver.rollers)
        if turn and abs(total / turn - 1.0) > _POWER_TOLERANCE:
            faults.add(
                f"sprocket.{wheels[-1][0]}.torque_N_m",
                f"the power must balance: torques of the driven sprockets take {100.0 * total / turn:.4g} % "
                "of what [load] gives: correct one of them",
            )
    return {name: one / total for name, one in work.items()} if total else {}


def _work_of_driver(load: Mapping[str, Any], rollers: float) -> float | None:
    """Return the work of the driver while the chain goes on by one pitch [N m]."""
    units = (("power_kW", "kW"), ("torque_N_m", "N*m"), ("speed_rpm", "rpm"))
    power, torque, speed = (plain_number(load.get(key), unit) or 0.0 for key, unit in units)
    if torque > 0.0:
        return 2.0 * math.pi * torque / rollers
    if power > 0.0 and speed > 0.0:
        return 6e4 * power / (speed * rollers)
    return None


def plain_number(value: object, unit: str) -> float | None:
    """Return a number, or a text with a unit in another one; None where it is neither.

    Examples
    --------
    >>> plain_number("2 kW", "kW"), plain_number(3, "kW"), plain_number("fast", "rpm")
    (2.0, 3, None)
    """
    if isinstance(value, str):
        try:
            return convert(value, unit)
        except ValueError:
            return None
    return value if isinstance(value, int | float) and not isinstance(value, bool) else None


def check_block_shares(document: Document, wheels: Sequence[DriveWheel]) -> None:
    """Name what is wrong with the power_share of the blocks of a duty."""
    duty = document.data.get("duty")
    driven = [wheel.name for wheel in wheels if wheel.role == DRIVEN]
    for number, block in enumerate(duty if isinstance(duty, list) else (), start=1):
        shares = block.get("power_share") if isinstance(block, dict) else None
        if not isinstance(shares, dict):
            continue
        key = f"duty.{number}.power_share"
        strange = [name for name in shares if name not in driven]
        if strange:
            message = f"must name driven sprockets, {', '.join(map(repr, driven))} (got {strange[0]!r})"
            document.faults.add(f"{key}.{strange[0]}", message)
        elif all(isinstance(share, int | float) for share in shares.values()):
            total = math.fsum(shares.values())
            if abs(total - 1.0) > _SUM_TOLERANCE:
                document.faults.add(key, f"the power must balance: shares must sum to 1 (got {total:.9g})")


def place_of(wheels: Sequence[DriveWheel], shares: tuple[float, ...], number: int) -> PlaceInLoop:
    """Return the loop as one of its sprockets sees it."""
    taker = next((wheel for wheel in wheels if wheel.place.take_up is not None), None)
    take_up = None
    if taker is not None and taker.place.take_up is not None:
        given = taker.place.take_up
        take_up = GivenTakeUp(
            taker.name,
            None if given.guide_deg is None else math.radians(given.guide_deg),
            None if given.travel_mm is None else (given.travel_mm[0], given.travel_mm[1]),
            given.tensioner_force_N or 0.0,
        )
    in_loop = []
    for wheel in wheels:
        assert wheel.place.position_mm is not None
        x, y = wheel.place.position_mm
        in_loop.append(Wheel(wheel.name, (x, y), wheel.rollers, bool(wheel.place.outside)))
    return PlaceInLoop(tuple(in_loop), shares, number, take_up)
