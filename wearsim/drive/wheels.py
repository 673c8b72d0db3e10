"""The sprockets of a drive by their tables: who drives, who is driven, where each one stands."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from wearsim.case.keys import DriveTables, LoadTable, PlacedSprocketTable
from wearsim.chain.chain_loop import Wheel
from wearsim.input.faults import Faults
from wearsim.mechanisms.wrap.place_in_loop import PlaceInLoop

DRIVER, DRIVEN, IDLER = "driver", "driven", "idler"

_SUM_TOLERANCE = 1e-6
_POWER_TOLERANCE = 0.01
"""Part of the driver's power by which torques may miss it."""


@dataclass(frozen=True)
class DriveWheel:
    """A sprocket of a drive as its table gives it."""

    name: str
    role: str  # `driver`, `driven` or `idler`
    # of a cassette those of the cog that the chain runs on, first of the one that runs longest; 0 of a
    # smooth idler
    teeth: int
    table: PlacedSprocketTable

    @property
    def rollers(self) -> int:
        """Rollers that it takes along in a turn."""
        return self.teeth // self.table.engaged_every

    @property
    def cogs(self) -> tuple[tuple[int, float], ...]:
        """Teeth and share of time of the cogs of a cassette; none of a single sprocket."""
        return tuple((cog.teeth, cog.share_of_time) for cog in self.table.cog or ())

    @property
    def is_smooth(self) -> bool:
        """Whether it is an idler without teeth, which does not wear."""
        return not self.parts

    @property
    def parts(self) -> tuple[str, ...]:
        """Names under which it is run: its own, those of all cogs of a cassette, none of a smooth idler."""
        if self.table.smooth_diameter_mm is not None:
            return ()
        return tuple(f"{self.name} {teeth}T" for teeth, _ in self.cogs) or (self.name,)

    @property
    def turning(self) -> float:
        """Joints that turn on it while the chain goes round, over the angle of one: 1/z, a mean over time."""
        if not self.cogs:
            return 1.0 / self.rollers
        return math.fsum(share / teeth for teeth, share in self.cogs)


def drive_wheels(tables: DriveTables, faults: Faults) -> list[DriveWheel]:
    """Return the sprockets in the order of the file; what is wrong between them goes to the faults."""
    count = len(tables.sprocket)
    wheels = [_wheel(number, table, count) for number, table in enumerate(tables.sprocket, start=1)]
    for number, wheel in enumerate(wheels, start=1):
        every = wheel.table.engaged_every
        if wheel.teeth % every:
            message = f"must divide the number of teeth of a whole drive, {wheel.teeth} (got {every})"
            faults.add(f"sprocket.{number}.engaged_every", message)
    _check_together(wheels, faults)
    return wheels


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
    return "chain", *(
        wheel_name(table.get("name"), table.get("role"), number, len(named))
        for number, table in enumerate(named, start=1)
        if "smooth_diameter_mm" not in table
    )


def wheel_name(name: object, role: object, number: int, count: int) -> str:
    """Return the name of a sprocket; its role where it has none, with its number where there are many.

    Examples
    --------
    >>> wheel_name(None, None, 1, 2), wheel_name(None, "idler", 2, 3), wheel_name("a", None, 2, 2)
    ('driver', 'idler 2', 'a')
    """
    role = role or _usual_role(number)
    return str(name or (role if count == 2 else f"{role} {number}"))


def _usual_role(number: int) -> str:
    return DRIVER if number == 1 else DRIVEN


def _wheel(number: int, table: PlacedSprocketTable, count: int) -> DriveWheel:
    teeth = max(table.cog, key=lambda cog: cog.share_of_time).teeth if table.cog else table.teeth or 0
    name = wheel_name(table.name, table.role, number, count)
    return DriveWheel(name, table.role or _usual_role(number), teeth, table)


def _check_together(wheels: Sequence[DriveWheel], faults: Faults) -> None:
    _check_names(wheels, faults)
    roles = [wheel.role for wheel in wheels]
    for role in (DRIVER, DRIVEN):
        if role not in roles:
            other = ", ".join(repr(one) for one in roles)
            faults.add(
                f"sprocket.{len(wheels)}.role", f"at least one sprocket must be {role!r} (got {other})"
            )
    placed = [wheel.table.position_mm is not None for wheel in wheels]
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
                if getattr(wheel.table, key) not in (None, False):
                    faults.add(f"sprocket.{number}.{key}", "needs position_mm of both sprockets")
    takers = [number for number, wheel in enumerate(wheels, start=1) if wheel.table.take_up is not None]
    if len(takers) > 1:
        first = wheels[takers[0] - 1].name
        faults.add(
            f"sprocket.{takers[1]}.take_up",
            f"one sprocket takes up the slack, {first!r} does already: remove one of the two",
        )
    cassettes = [number for number, wheel in enumerate(wheels, start=1) if wheel.cogs]
    if len(cassettes) > 1:
        faults.add(f"sprocket.{cassettes[1]}.cog", "one sprocket can have cogs: remove those of the other")
    smooth = [number for number, wheel in enumerate(wheels, start=1) if wheel.is_smooth]
    if cassettes and smooth:
        text = "a drive with cogs cannot have a smooth idler yet: give the idler teeth"
        faults.add(f"sprocket.{smooth[0]}.smooth_diameter_mm", text)


def _check_names(wheels: Sequence[DriveWheel], faults: Faults) -> None:
    taken: set[str] = set()
    for number, wheel in enumerate(wheels, start=1):
        key = f"sprocket.{number}.name"
        if wheel.name != wheel.name.strip():
            faults.add(key, f"must be without leading or trailing blanks (got {wheel.name!r})")
        if wheel.name.startswith(("=", "+", "-", "@")):
            faults.add(
                key, f"must not begin with =, +, - or @, like a spreadsheet formula (got {wheel.name!r})"
            )
        if wheel.name.lower() == "chain":
            faults.add(key, "must be another name: the chain is a part too")
        names = {wheel.name, *wheel.parts}
        if twice := sorted(names & taken):
            faults.add(key, f"sprockets need different names (got {twice[0]!r} twice)")
        taken |= names


def power_shares(tables: DriveTables, wheels: Sequence[DriveWheel], faults: Faults) -> tuple[float, ...]:
    """Return the share of each sprocket in the power: above 0 for drivers, below for driven, 0 for idlers."""
    found = dict.fromkeys((wheel.name for wheel in wheels), 0.0)
    driver = next(wheel for wheel in wheels if wheel.role == DRIVER)
    for role, sign in ((DRIVER, 1.0), (DRIVEN, -1.0)):
        of_role = [(number, wheel) for number, wheel in enumerate(wheels, start=1) if wheel.role == role]
        for name, share in _shares_of(tables.load, of_role, driver, faults).items():
            found[name] = sign * share
    return tuple(found.values())


def _shares_of(
    load: LoadTable, wheels: Sequence[tuple[int, DriveWheel]], driver: DriveWheel, faults: Faults
) -> dict[str, float]:
    role = wheels[0][1].role
    torques = [(number, wheel) for number, wheel in wheels if wheel.table.torque_N_m is not None]
    if torques and role == DRIVER:
        faults.add(
            f"sprocket.{torques[0][0]}.torque_N_m", "[load] gives that of the driver: remove one of the two"
        )
        return {}
    if torques:
        return _shares_by_torque(load, wheels, driver, faults)
    if len(wheels) == 1:
        number, wheel = wheels[0]
        share = 1.0 if wheel.table.power_share is None else wheel.table.power_share
        if abs(share - 1.0) > _SUM_TOLERANCE:
            message = f"the only {role} sprocket has all of the power: must be 1 (got {share:g})"
            faults.add(f"sprocket.{number}.power_share", message)
        return {wheel.name: 1.0}
    given = {wheel.name: wheel.table.power_share for _, wheel in wheels}
    for number, wheel in wheels:
        if wheel.table.power_share is None:
            message = f"required: {len(wheels)} {role} sprockets share the power"
            faults.add(f"sprocket.{number}.power_share", message)
    shares = {name: share for name, share in given.items() if share is not None}
    total = math.fsum(shares.values())
    if len(shares) == len(wheels) and abs(total - 1.0) > _SUM_TOLERANCE:
        message = f"the power must balance: shares of all {role} sprockets must sum to 1 (got {total:.9g})"
        faults.add(f"sprocket.{wheels[-1][0]}.power_share", message)
    return {name: share / total for name, share in shares.items()}


def _shares_by_torque(
    load: LoadTable, wheels: Sequence[tuple[int, DriveWheel]], driver: DriveWheel, faults: Faults
) -> dict[str, float]:
    """Return the shares of driven sprockets whose torques are given, which must balance the driver's."""
    work = {}
    for number, wheel in wheels:
        if wheel.table.torque_N_m is None:
            faults.add(f"sprocket.{number}.torque_N_m", "required, as other sprockets give theirs")
            continue
        work[wheel.name] = 2.0 * math.pi * wheel.table.torque_N_m * wheel.turning
    total = math.fsum(work.values())
    turn = _work_of_driver(load, driver.rollers)
    if turn and abs(total / turn - 1.0) > _POWER_TOLERANCE:
        faults.add(
            f"sprocket.{wheels[-1][0]}.torque_N_m",
            f"the power must balance: torques of the driven sprockets sum to {100.0 * total / turn:.4g} % "
            "of what [load] gives: correct one of them",
        )
    return {name: one / total for name, one in work.items()} if total else {}


def _work_of_driver(load: LoadTable, rollers: float) -> float | None:
    """Return the work of the driver while the chain goes on by one pitch [N m]."""
    if load.torque_N_m is not None:
        return 2.0 * math.pi * load.torque_N_m / rollers
    if load.power_kW is not None and load.speed_rpm is not None:
        return 6e4 * load.power_kW / (load.speed_rpm * rollers)
    return None


def check_block_shares(tables: DriveTables, wheels: Sequence[DriveWheel], faults: Faults) -> None:
    """Name what is wrong with the power_share of the blocks of a duty."""
    driven = [wheel.name for wheel in wheels if wheel.role == DRIVEN]
    for number, block in enumerate(tables.duty, start=1):
        key, shares = f"duty.{number}.power_share", block.power_share
        if shares is None:
            continue
        if len(wheels) == 2:
            faults.add(key, "the only driven sprocket has all of the power: remove this")
        elif strange := [name for name in shares if name not in driven]:
            message = f"must name driven sprockets, {', '.join(map(repr, driven))} (got {strange[0]!r})"
            faults.add(f"{key}.{strange[0]}", message)
        elif abs((total := math.fsum(shares.values())) - 1.0) > _SUM_TOLERANCE:
            faults.add(key, f"the power must balance: shares must sum to 1 (got {total:.9g})")


def check_prices(tables: DriveTables, faults: Faults) -> None:
    """Name the prices of sprockets that need that of the chain."""
    if tables.maintenance is not None and tables.maintenance.chain_price is not None:
        return
    for number, table in enumerate(tables.sprocket, start=1):
        if table.price is not None:
            text = "the cost needs maintenance.chain_price too: give both or neither"
            faults.add(f"sprocket.{number}.price", text)


def place_of(wheels: Sequence[DriveWheel], shares: tuple[float, ...], number: int) -> PlaceInLoop:
    """Return the loop as one of its sprockets sees it."""
    take_ups = ((wheel.name, wheel.table.take_up) for wheel in wheels if wheel.table.take_up is not None)
    in_loop = []
    for wheel in wheels:
        assert wheel.table.position_mm is not None
        x, y = wheel.table.position_mm
        radius = 0.5 * (wheel.table.smooth_diameter_mm or 0.0)
        in_loop.append(Wheel(wheel.name, (x, y), wheel.rollers, bool(wheel.table.outside), radius))
    return PlaceInLoop(tuple(in_loop), shares, number, *next(take_ups, ()))
