"""From the tables of a chain around a sprocket to its drive: gap, layout, tensions, joints."""

import math
from functools import partial

from wearsim.case.chain_record import ChainRecord
from wearsim.case.duty_blocks import GivenDuty, GivenLoad
from wearsim.case.keys import DriveTable
from wearsim.case.model import WearInput, heaviest_block
from wearsim.case.sprocket_inputs import hub_input
from wearsim.case.table_inputs import chain_pull, chain_speed, face_width, slip_fraction, within_strength
from wearsim.catalogue.catalogues import Chain
from wearsim.chain.chain_length import belt_links, even_links, odd_links_warning
from wearsim.chain.drive_layout import DriveLayout, layout_with_centre, layout_with_links
from wearsim.chain.joint_pressure import joint_application
from wearsim.chain.joint_wear import JointLaw
from wearsim.chain.loop_layout import LoopLayout
from wearsim.chain.service_conditions import LUBRICATIONS, STEADY, load_of, shifts_in_words, shifts_of
from wearsim.chain.span_tension import catenary_tension, centrifugal_tension
from wearsim.errors import GeometryError
from wearsim.geometry.blank import gap_space
from wearsim.mechanisms.wrap.drive import WrapDrive, WrapLoad
from wearsim.mechanisms.wrap.gap_shape import gap_shape
from wearsim.mechanisms.wrap.joints import joint_input, joint_law_of, with_teeth_alike
from wearsim.mechanisms.wrap.place_in_loop import (
    PlaceInLoop,
    check_travel,
    laid_out,
    loop_loads,
    turning_factor,
)
from wearsim.quantities import grouped

CENTRE_IN_PITCHES = 40.0
SAG_PERCENT = 2.0
LINK_STIFFNESS_PER_PITCH = 5e4 / 12.7
SLIP_FRACTION = 0.1
PHASES = 6
_ONE_SHIFT = 8.0
"""Hours a day where a case gives none."""
_OF_POWER = "it changes the power in the ratings, not the wear"
_OF_PRESSURE = "it changes the joint pressure in the ratings, not the wear"


def wrapped_drive(
    case: ChainRecord, wear: WearInput, chain: Chain, duty: GivenDuty | None, place: PlaceInLoop | None = None
) -> WrapDrive | None:
    """Complete a chain around a sprocket."""
    tables, faults = case.tables, case.faults
    table = tables.sprocket
    if table is None:
        faults.add("sprocket", "this table is required and missing")
        return None
    before = faults.count
    _check_chain(case, chain)
    if wear.changes_with_load:
        faults.add(
            f"wear.{wear.changes_with_load}",
            "needs the pressure and the slip of a travelling contact, but rollers of a wrap rest in their "
            "gaps: remove it, or use kind = 'strand', 'prescribed' or gears",
        )
    if tables.film is not None:
        faults.add("film", "is for a rolling contact, but rollers of a wrap rest in their gaps: remove it")
    if table.role is None:
        case.take("sprocket.role", "driver", "default")
    given = tables.drive or DriveTable()
    layout = laid_out(case, chain, given, place) if place else _layout(case, chain, given)
    shape = gap_shape(case, table, chain)
    sound = faults.count == before
    hub = hub_input(case, table, None if shape is None else partial(gap_space, shape.outline, shape.gap))
    if layout is None or shape is None or duty is None or not sound:
        return None
    driver = table.role != "driven"
    law = joint_law_of(case)
    if isinstance(layout, LoopLayout):
        loads = loop_loads(case, chain, layout, duty, law, _link_stiffness(case, chain))
    else:
        loads = _tensions(case, chain, layout, duty, law)
    if loads is None:
        return None
    blocks, rated = loads
    slack = heaviest_block(rated).slack
    width = face_width(case, table, chain)
    joint = joint_input(case, chain, layout, law, blocks, wear)
    blocks = with_teeth_alike(case, chain, law, blocks)
    if isinstance(layout, LoopLayout):
        check_travel(case, layout, joint.elongation_limit)
    mechanism = tables.mechanism
    if mechanism.phases is None:
        case.take("mechanism.phases", PHASES, "default")
    frictions = mechanism.friction_roller_tooth, mechanism.friction_roller_bush
    for key, value in zip(("tooth", "bush"), frictions, strict=True):
        if value is None:
            case.take(f"mechanism.friction_roller_{key}", 0.0, "default")
    least = tables.stop.min_slack_tension_N
    if least is not None and least > slack:
        faults.add(
            "stop.min_slack_tension_N",
            f"must not exceed the slack tension of the drive, {grouped(slack)} N (got {least:g})",
        )
    return WrapDrive(
        outline=shape.outline,
        gap=shape.gap,
        gaps=table.teeth,
        pitch_angle=2.0 * math.pi * table.engaged_every / table.teeth,
        layout=layout,
        driver=driver,
        mates=_mates(layout, driver),
        wrap_angle=_wrap_angle(layout, driver),
        face_width=width,
        blocks=blocks,
        rated=rated,
        link_stiffness=_taken_stiffness(case, chain),
        bush_radius=0.5 * _bush_diameter(case, chain),
        phases=mechanism.phases or PHASES,
        slip_fraction=slip_fraction(case, SLIP_FRACTION),
        friction_roller_tooth=frictions[0] or 0.0,
        friction_roller_bush=frictions[1] or 0.0,
        joint=joint,
        service_factor=_service_factor(case),
        joint_application_factor=_joint_application_factor(case),
        chain=chain,
        joint_friction=_joint_friction(case),
        hub=hub,
    )


def _joint_friction(case: ChainRecord) -> float | None:
    given = (case.tables.drive or DriveTable()).joint_friction
    if given is not None:
        case.assumptions.append(
            f"coefficient of friction of the joints {given:g}: it affects the efficiency, and "
            "no tension except after idlers"
        )
    return given


def _mates(layout: DriveLayout | LoopLayout, driver: bool) -> tuple[float, ...]:
    if isinstance(layout, LoopLayout):
        return layout.mates
    return (layout.teeth_2 if driver else layout.teeth_1,)


def _wrap_angle(layout: DriveLayout | LoopLayout, driver: bool) -> float:
    if isinstance(layout, LoopLayout):
        return layout.wrap_angle
    return layout.wrap_angle_1 if driver else layout.wrap_angle_2


def _service_factor(case: ChainRecord) -> float:
    given = (case.tables.drive or DriveTable()).service_factor
    if given is None:
        case.take("drive.service_factor", 1.0, f"smooth load; {_OF_POWER}")
        return 1.0
    case.assumptions.append(f"service factor {given:g}: {_OF_POWER}")
    return given


def _joint_application_factor(case: ChainRecord) -> float:
    """Return K_e, by default that of the shocks of f1, the lubricant and the hours of the case."""
    table = case.tables.drive or DriveTable()
    given, shocks = table.joint_application_factor, table.service_factor or 1.0
    lubricant = (case.inputs.get("lubrication") or {}).get("lubricant")
    load, lubrication = load_of(shocks), LUBRICATIONS.get(str(lubricant), "drip")
    if given is None:
        shifts = shifts_of((case.inputs.get("service") or {}).get("hours_per_day") or _ONE_SHIFT)
        factor = joint_application(load, lubrication, shifts).factor
        why = f"{load} by f1, {lubrication} lubrication, {shifts_in_words(shifts)} a day; {_OF_PRESSURE}"
        case.take("drive.joint_application_factor", factor, why)
        return factor
    case.assumptions.append(f"joint application factor {given:g}: {_OF_PRESSURE}")
    causes = [f"lubricant {lubricant!r}"] if lubricant is not None else []
    causes += [f"{load} (service_factor = {shocks:g})"] if load != STEADY else []
    least = joint_application(load, lubrication).factor
    if given < least and causes:
        case.warnings.append(
            f"drive.joint_application_factor = {given:g} is below the {least:g} that GOST practice gives "
            f"for {' and '.join(causes)} alone: raise it, or delete it to use the default"
        )
    return given


def _check_chain(case: ChainRecord, chain: Chain) -> None:
    for key, value in (
        ("pin_diameter_mm", chain.pin_diameter),
        ("bearing_area_mm2", chain.bearing_area),
        ("mass_kg_per_m", chain.mass_per_length),
    ):
        if not value:
            known = f"the catalogue has none for {chain.designation}" if chain.designation else ""
            case.faults.add(f"chain.{key}", f"kind = 'wrap' needs this key{': ' if known else ''}{known}")


def _layout(case: ChainRecord, chain: Chain, table: DriveTable) -> DriveLayout | None:
    sprocket = case.tables.sprocket
    assert sprocket is not None
    if sprocket.engaged_every > 1 and sprocket.teeth % sprocket.engaged_every:
        case.warnings.append(
            f"{sprocket.teeth} gaps, a roller in one out of {sprocket.engaged_every}: the drive is laid out "
            f"with {sprocket.teeth // sprocket.engaged_every} teeth"
        )
    teeth = sprocket.teeth // sprocket.engaged_every
    mate = table.mate_teeth
    if mate is None:
        mate = teeth
        case.take("drive.mate_teeth", mate, "as many as this sprocket: wrap angle 180 degrees")
    teeth_1, teeth_2 = (teeth, mate) if sprocket.role != "driven" else (mate, teeth)
    links = table.links
    try:
        if table.centre_distance_mm is not None:
            layout = layout_with_centre(chain.pitch, teeth_1, teeth_2, table.centre_distance_mm)
            case.assumptions.append(
                f"{layout.links} links, rounded up to an even number, at a centre distance of "
                f"{layout.centre_distance:.6g} mm"
            )
        else:
            if links is None:
                links = even_links(belt_links(teeth_1, teeth_2, CENTRE_IN_PITCHES))
                case.take("drive.links", links, "about 40 pitches between the sprockets")
            layout = layout_with_links(chain.pitch, teeth_1, teeth_2, links)
    except GeometryError as error:
        key = "centre_distance_mm" if table.centre_distance_mm is not None else "links"
        case.faults.add(f"drive.{key}", str(error))
        return None
    if layout.needs_offset_link:
        case.warnings.append(odd_links_warning(layout.links))
    return layout


def _tensions(
    case: ChainRecord, chain: Chain, layout: DriveLayout, duty: GivenDuty, law: JointLaw
) -> tuple[tuple[WrapLoad, ...], tuple[WrapLoad, ...]] | None:
    """Return the blocks of the duty and the rated loads with their tensions."""
    for load in duty.blocks:
        if load.power_share:
            case.faults.add(load.key, "a case of one sprocket has no others to share its power with")
    slack = _slack(case, chain, layout, max(chain_pull(case, chain, load) for load in duty.rated))
    if slack is None:
        return None
    rated, found = (
        [_block(case, chain, load, slack, turning_factor(case, chain, layout, load, law)) for load in loads]
        for loads in (duty.rated, duty.blocks)
    )
    for load, block in zip((*duty.rated, *duty.blocks), (*rated, *found), strict=True):
        if block.tension <= slack and not load.measured:
            key = load.key if load.kind == "tension_N" else "drive.slack_tension_N"
            _fault_slack(case, key, block.tension, slack)
            return None
    heaviest = heaviest_block(tuple(rated))
    if heaviest.tension <= slack:
        _fault_slack(case, duty.rated[0].key, heaviest.tension, slack)
        return None
    idle = math.fsum(block.share for block in found if block.tension == slack)
    if idle:
        case.assumptions.append(
            f"for {100 * idle:.3g} % of the cycles the tight strand pulls no more than the slack one: the "
            "slack tension is used there"
        )
    case.assumptions.append(
        f"tight strand {_range([block.tension for block in found], 6)} N, slack strand {grouped(slack)} N, "
        f"and {_range([block.centrifugal for block in found], 3)} N centrifugal tension in both, which "
        "loads joints but not teeth"
    )
    strained = max(rated, key=lambda block: block.tension + block.centrifugal)
    key = duty.rated[rated.index(strained)].key
    holds = within_strength(case, strained.tension + strained.centrifugal, chain, key)
    return (tuple(found), tuple(rated)) if holds else None


def _range(values: list[float], digits: int) -> str:
    low, high = f"{min(values):.{digits}g}", f"{max(values):.{digits}g}"
    return high if low == high else f"{low} to {high}"


def _block(case: ChainRecord, chain: Chain, load: GivenLoad, slack: float, turning: float) -> WrapLoad:
    """Return a load with its tensions; that of a log is at least the slack one."""
    pull = chain_pull(case, chain, load)
    whole = pull if load.kind == "tension_N" else pull + slack
    tight = whole - (1.0 - load.part) * (whole - slack)
    if load.measured:
        tight = max(tight, slack)
    centrifugal = centrifugal_tension(chain.mass_per_length, chain_speed(case, chain, load))
    return WrapLoad(
        share=load.share,
        speed_rpm=load.speed_rpm,
        tension=tight,
        centrifugal=centrifugal,
        wear_factor=load.wear_factor,
        joint_factor=load.joint_factor,
        slack=slack,
        pull=tight - slack,
        base=slack,
        turns=((tight, slack),) * 2,
        turning_factors=(turning,) * 2,
        spans=(tight, slack) if load.reverse else (slack, tight),
    )


def _fault_slack(case: ChainRecord, key: str, tight: float, slack: float) -> None:
    case.faults.add(
        key,
        f"the tight strand must pull more than the slack one, {grouped(slack)} N (got {grouped(tight)} N)",
    )


def _slack(case: ChainRecord, chain: Chain, layout: DriveLayout, pull: float) -> float | None:
    """Return the tension of the slack strand as given, or of its catenary."""
    table = case.tables.drive or DriveTable()
    if table.slack_tension_N is not None:
        return table.slack_tension_N
    sag = table.sag_percent
    if sag is None:
        sag = SAG_PERCENT
        case.take("drive.sag_percent", sag, "default")
    if table.inclination_deg is None:
        case.take("drive.inclination_deg", 0.0, "default")
    slope = math.radians(table.inclination_deg or 0.0)
    slack = catenary_tension(chain.mass_per_length, layout.span, sag / 100.0, slope)
    if slack > 1e-9 * pull:
        return slack
    case.faults.add(
        "drive.inclination_deg",
        "a vertical span has no sag and no tension of its own: give drive.slack_tension_N",
    )
    return None


def _link_stiffness(case: ChainRecord, chain: Chain) -> float:
    given = (case.tables.drive or DriveTable()).link_stiffness_N_per_mm
    return float(f"{LINK_STIFFNESS_PER_PITCH * chain.pitch:.3g}") if given is None else given


def _taken_stiffness(case: ChainRecord, chain: Chain) -> float:
    stiffness = _link_stiffness(case, chain)
    if (case.tables.drive or DriveTable()).link_stiffness_N_per_mm is None:
        why = "5e4 N/mm at a pitch of 12.7 mm, in proportion to the pitch"
        case.take("drive.link_stiffness_N_per_mm", stiffness, why)
    return stiffness


def _bush_diameter(case: ChainRecord, chain: Chain) -> float:
    given = case.tables.chain.bush_diameter_mm
    if given is not None:
        return given
    mean = float(f"{0.5 * (chain.pin_diameter + chain.roller_diameter):.4g}")
    case.take("chain.bush_diameter_mm", mean, "mean of pin and roller")
    return mean
