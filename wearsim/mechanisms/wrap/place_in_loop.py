"""A sprocket in its place in a loop of many: the layout that fits, and the tensions on its two sides."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import pairwise

from wearsim.case.chain_record import ChainRecord
from wearsim.case.duty_blocks import GivenDuty, GivenLoad
from wearsim.case.keys import DriveTable, TakeUpTable
from wearsim.case.table_inputs import chain_pull, chain_speed, within_strength
from wearsim.catalogue.catalogues import Chain
from wearsim.chain.chain_length import STRETCH, odd_links_warning
from wearsim.chain.chain_loop import ChainLoop, Wheel
from wearsim.chain.drive_layout import DriveLayout
from wearsim.chain.joint_wear import JointLaw
from wearsim.chain.loop_forces import LoopForces, SpanLevel, direction_angles
from wearsim.chain.loop_layout import LoopDrive, LoopLayout, loop_layout, seen_from
from wearsim.chain.span_tension import centrifugal_tension
from wearsim.chain.take_up import TakeUp
from wearsim.errors import CaseError, GeometryError
from wearsim.mechanisms.wrap.drive import WrapLoad

LOOP_KEY = "loop"
"""Key of faults that are about the loop as a whole, with the number of a wheel where they name one."""

_GIVEN_BY_PLACES = ("mate_teeth", "centre_distance_mm", "inclination_deg")

_NO_TENSION = 1e-6
"""Tension below which a span has none of its own [N]."""

_TRAVEL = 2.0
"""Travel of a take-up to both sides where a case gives none, in pitches."""


@dataclass(frozen=True)
class PlaceInLoop:
    """The sprockets of a loop, and which of them a case is about."""

    wheels: tuple[Wheel, ...]
    # share of each wheel in the power of the drivers: above 0 for drivers, below for driven, 0 for idlers
    shares: tuple[float, ...]
    wheel: int  # the one that the case is about
    taker: str = ""  # the wheel that takes up the slack, empty for none
    take_up: TakeUpTable | None = None

    @property
    def force(self) -> float:
        """Force of a spring or a weight along the direction of the take-up [N]; 0 where it is fixed."""
        return (self.take_up.tensioner_force_N or 0.0) if self.take_up else 0.0


def laid_out(case: ChainRecord, chain: Chain, table: DriveTable, place: PlaceInLoop) -> LoopLayout | None:
    """Return the loop with a whole number of links; what is wrong with it goes to the faults."""
    before = case.faults.count
    for key in _GIVEN_BY_PLACES:
        if getattr(table, key) is not None:
            case.faults.add(
                f"drive.{key}", "this follows from the sprockets and their position_mm: remove it"
            )
    if place.take_up is None and table.sag_percent is not None:
        case.faults.add("drive.sag_percent", "without a take_up the number of links sets the sag: remove it")
    if place.force:
        for key in ("slack_tension_N", "sag_percent"):
            if getattr(table, key) is not None:
                case.faults.add(
                    f"drive.{key}", "the force of the take_up already gives this: remove one of the two"
                )
    if case.faults.count > before:
        return None
    try:
        loop = _loop(chain, place.wheels)
        drive = LoopDrive(loop, place.shares, _take_up(case, loop, place), place.force)
        layout = seen_from(loop_layout(drive, table.links), place.wheel)
    except (CaseError, GeometryError) as error:
        faults = error.faults if isinstance(error, CaseError) else ()
        for text in [fault.message for fault in faults] or [str(error)]:
            case.faults.add(_key_of(text, place.wheels), text)
        return None
    if table.links is None:
        case.take("drive.links", layout.links, "the even number that fits the sprockets as placed")
    if len(place.wheels) == 2:
        case.assumptions.append(_sense_of_two(place))
    case.assumptions += [
        f"{wheel.name!r} is smooth: rollers run on it, and joints articulate as on a sprocket of "
        f"{links:.4g} teeth; neither its wear nor that of the rollers on it is calculated"
        for wheel, links in zip(loop.wheels, loop.teeth, strict=True)
        if not wheel.teeth
    ]
    if layout.links % 2:
        case.warnings.append(odd_links_warning(layout.links))
    if drive.take_up is not None:
        case.assumptions.append(
            f"take-up {drive.take_up.wheel!r} is {layout.travel:.4g} mm from its given position with a new "
            "chain"
        )
    return layout


def _key_of(text: str, wheels: Sequence[Wheel]) -> str:
    """Return the key of a fault of the loop, that of the wheel which it names first."""
    places = ((text.find(repr(wheel.name)), number) for number, wheel in enumerate(wheels, start=1))
    named = min((place for place in places if place[0] >= 0), default=None)
    return f"{LOOP_KEY}.{named[1]}" if named else LOOP_KEY


def _loop(chain: Chain, wheels: tuple[Wheel, ...]) -> ChainLoop:
    """Return the loop in the sense in which it is one; the faults are those of the sense of its centres."""
    centres = [wheel.centre for wheel in wheels]
    turned = math.fsum(x * v - u * y for (x, y), (u, v) in pairwise([*centres, centres[0]]))
    clockwise = turned < 0.0
    of = partial(ChainLoop, chain.pitch, wheels, roller_radius=0.5 * chain.roller_diameter)
    try:
        return of(clockwise=clockwise)
    except CaseError:
        try:
            return of(clockwise=not clockwise)
        except CaseError:
            pass
        raise


def _sense_of_two(place: PlaceInLoop) -> str:
    """Say which way round two wheels run, whose places are the same either way, and where it is slack."""
    driver, driven = sorted(zip(place.shares, place.wheels, strict=True), key=lambda one: -one[0])
    across = driven[1].centre[0] - driver[1].centre[0]
    up = driven[1].centre[1] - driver[1].centre[1]
    # The span that leaves the driver, to the right of the line from its centre to the other.
    if abs(across) >= abs(up):
        side = "below" if across > 0.0 else "above"
    else:
        side = "to the right of" if up > 0.0 else "to the left of"
    return (
        "two sprockets with position_mm: the chain runs counter-clockwise (y upwards), its slack span lies "
        f"{side} the line of centres; if it runs clockwise, change the sign of both x"
    )


def _take_up(case: ChainRecord, loop: ChainLoop, place: PlaceInLoop) -> TakeUp | None:
    given, taker = place.take_up, place.taker
    if given is None:
        return None
    if given.guide_deg is not None:
        angle = math.radians(given.guide_deg)
        direction = math.cos(angle), math.sin(angle)
    else:
        at = loop.index(taker)
        pulled = loop.directions[at] - loop.directions[at - 1]
        direction = -float(pulled[0]), -float(pulled[1])
        degrees = math.degrees(float(direction_angles(-pulled[None, :])[0]))
        case.assumptions.append(
            f"take-up {taker!r} moves against the pull of its two spans, at {degrees:.4g} degrees"
        )
    travel = given.travel_mm
    if travel is None:
        travel = -_TRAVEL * loop.pitch, _TRAVEL * loop.pitch
        case.assumptions.append(
            f"take-up {taker!r} can move by {travel[1]:.4g} mm either way, {_TRAVEL:g} pitches"
        )
    least, most = travel
    return TakeUp(taker, direction, least, most)


def check_travel(case: ChainRecord, layout: LoopLayout, elongation: float) -> None:
    """Warn where the take-up has no room for the chain that has grown to its limit."""
    take_up = layout.drive.take_up
    if take_up is None:
        return
    try:
        travel = layout.travel_at(elongation)
    except (CaseError, GeometryError):
        case.warnings.append(
            f"the travel of take-up {take_up.wheel!r}, {take_up.least:.4g} to {take_up.most:.4g} mm, has no "
            f"room for an elongation of {100.0 * elongation:.3g} %: remove two links then, or give more "
            "travel"
        )
        return
    case.assumptions.append(
        f"take-up {take_up.wheel!r} moves to {travel:.4g} mm as the chain elongates by "
        f"{100.0 * elongation:.3g} %"
    )


def loop_loads(
    case: ChainRecord, chain: Chain, layout: LoopLayout, duty: GivenDuty, law: JointLaw, link_stiffness: float
) -> tuple[tuple[WrapLoad, ...], tuple[WrapLoad, ...]] | None:
    """Return the blocks of the duty and the rated loads with the tensions on both sides of the sprocket."""
    table = case.tables.drive or DriveTable()
    before = case.faults.count
    for load in (*duty.rated, *duty.blocks):
        if load.kind == "tension_N":
            case.faults.add(
                load.key, "each span has its own tension here: give power_kW or torque_N_m of the driver"
            )
    sag = None if table.sag_percent is None else 0.01 * table.sag_percent
    if sag is None and layout.drive.take_up is not None and not layout.drive.take_up_force:
        sag = 0.02
        if table.slack_tension_N is None:
            case.take("drive.sag_percent", 100.0 * sag, "default")
    loads = (*duty.blocks, *duty.rated)
    sides = [layout.braked if load.reverse else layout for load in loads]
    # Where blocks share the power in other ways, other spans are the loosest.
    levels = [
        side.level(
            chain.mass_per_length, table.slack_tension_N, sag, link_stiffness, _shares(side, load.power_share)
        )
        for side, load in zip(sides, loads, strict=True)
    ]
    if not all(level.force > _NO_TENSION for level in levels):
        case.faults.add(
            "drive.slack_tension_N",
            "the loosest span is vertical and has no tension of its own: give this, or take_up with a force",
        )
    if case.faults.count > before:
        return None
    taut = layout.drive.take_up is None and layout.excess < STRETCH * layout.links
    if taut and table.slack_tension_N is None:
        case.assumptions.append(
            f"the chain fits without slack ({layout.excess * layout.pitch:+.3g} mm): with "
            f"drive.link_stiffness_N_per_mm its tension at rest is {levels[0].force:.4g} N, which the "
            "loosest span keeps"
        )
    try:
        forces = [
            _forces(case, chain, side, load, level, table)
            for side, load, level in zip(sides, loads, levels, strict=True)
        ]
    except CaseError as error:
        braking = any(load.reverse for load in loads)
        braked = " (negative loads of the log swap tight and slack spans)" if braking else ""
        for fault in error.faults:
            case.faults.add(_key_of(fault.message, layout.loop.wheels), f"{fault.message}{braked}")
        return None
    found, rated = forces[: len(duty.blocks)], forces[len(duty.blocks) :]
    heaviest = max(rated, key=lambda forces: float(forces.tensions.max()))
    spans = ", ".join(
        f"{layout.loop.span_name(i)} {tension:.4g}" for i, tension in enumerate(heaviest.tensions)
    )
    case.assumptions.append(
        f"tensions of the spans at the highest load: {spans} N, and {heaviest.centrifugal:.3g} N "
        "centrifugal tension in each, which loads joints but not teeth"
    )
    strained = float(heaviest.tensions.max()) + heaviest.centrifugal
    key = duty.rated[rated.index(heaviest)].key
    if not within_strength(case, strained, chain, key):
        return None
    blocks, ratings = (
        tuple(
            _block(layout, load, one, turning_factor(case, chain, layout, load, law))
            for load, one in zip(given, of, strict=True)
        )
        for given, of in ((duty.blocks, found), (duty.rated, rated))
    )
    return blocks, ratings


def _forces(
    case: ChainRecord, chain: Chain, layout: LoopLayout, load: GivenLoad, level: SpanLevel, table: DriveTable
) -> LoopForces:
    return layout.forces(
        load.part * chain_pull(case, chain, load),
        level,
        0.5 * chain.pin_diameter * (table.joint_friction or 0.0),
        centrifugal_tension(chain.mass_per_length, chain_speed(case, chain, load)),
        _shares(layout, load.power_share),
    )


def _shares(layout: LoopLayout, given: Mapping[str, float]) -> tuple[float, ...]:
    """Return the shares of a block that gives those of some driven wheels, else those of the drive."""
    if not given:
        return layout.drive.shares
    shares = (max(share, 0.0) for share in layout.drive.shares)
    return tuple(
        share - given.get(wheel.name, 0.0) for share, wheel in zip(shares, layout.loop.wheels, strict=True)
    )


def turning_factor(
    case: ChainRecord, chain: Chain, layout: DriveLayout | LoopLayout, load: GivenLoad, law: JointLaw
) -> float:
    """Return what the joints' law says of the speed of the smallest sprocket that drives or is driven."""
    small = 60.0 * chain_speed(case, chain, load) / (chain.pitch * min(layout.rated_teeth))
    return law.turning_factor(small, chain.pitch)


def _block(layout: LoopLayout, load: GivenLoad, forces: LoopForces, turning: float) -> WrapLoad:
    arriving, leaving = forces.arriving.tolist(), forces.tensions.tolist()
    own = layout.wheel
    order = [own, *(i for i in range(len(leaving)) if i != own)]
    pull = abs(float(forces.pulls[[share > 0.0 for share in layout.drive.shares]].sum()))
    return WrapLoad(
        share=load.share,
        speed_rpm=load.speed_rpm,
        tension=max(arriving[own], leaving[own]),
        centrifugal=forces.centrifugal,
        wear_factor=load.wear_factor,
        joint_factor=load.joint_factor,
        slack=min(arriving[own], leaving[own]),
        pull=pull,
        base=max(leaving) - pull,
        turns=tuple((arriving[i], leaving[i]) for i in order),
        turning_factors=(turning,) * len(order),
        spans=tuple(leaving),
    )
