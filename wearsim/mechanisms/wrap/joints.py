"""The table [joint]: by which law pin and bush wear, how surely, and when the chain has grown enough."""

import math
from collections.abc import Sequence
from dataclasses import astuple, replace

from wearsim.case.chain_record import ChainRecord
from wearsim.case.keys import JointTable
from wearsim.case.keys.drive_tables import JOINT_LAW_KEYS
from wearsim.case.model import WearBand, WearInput
from wearsim.case.table_inputs import DEFAULT_BAND
from wearsim.catalogue.catalogues import USUAL_CONDITION, Chain, WearCondition, wear_conditions
from wearsim.chain.drive_layout import DriveLayout
from wearsim.chain.elongation_limit import elongation_rule
from wearsim.chain.joint_wear import JointBand, JointLaw, JointState, extrapolated, joint_band, joint_law
from wearsim.chain.loop_layout import LoopLayout
from wearsim.mechanisms.wrap.drive import (
    CONSTANT,
    JOINT_COEFFICIENT,
    PRESSURE_SPEED,
    JointInput,
    WrapLoad,
    law_keys,
)


def alternates(case: ChainRecord) -> bool:
    """Return whether joint wear lengthens every other link only."""
    return _table(case).pitch != "uniform"


def joint_law_of(case: ChainRecord) -> JointLaw:
    """Return the law of the joints: of the wear condition, of the user, or of both."""
    table, of_condition = _table(case), joint_law(_condition(case))
    coefficient = table.specific_wear_rate_mm2_per_N
    if table.law == CONSTANT or (table.law is None and coefficient is not None):
        return JointLaw(coefficient or of_condition.coefficient)
    own = [getattr(table, key) for key in JOINT_LAW_KEYS]
    known = astuple(of_condition)[1:]
    numbers = [known[i] if value is None else value for i, value in enumerate(own)]
    return JointLaw(coefficient or of_condition.coefficient, *numbers)


def joint_input(
    case: ChainRecord,
    chain: Chain,
    layout: DriveLayout | LoopLayout,
    law: JointLaw,
    blocks: Sequence[WrapLoad],
    wear: WearInput,
) -> JointInput:
    """Return how the joints of a chain under a duty wear; what is taken goes to the record."""
    if _table(case).pitch is None:
        case.take("joint.pitch", "alternating", "joint wear lengthens the outer links only")
    limit = case.tables.stop.elongation_percent
    if limit is None:
        limit = _usual_elongation(case, layout)
    state = joint_state(chain, blocks, own_teeth=_rollers(case), small=min(layout.rated_teeth))
    return JointInput(
        law=law,
        band=_band(case, law, state),
        tooth_band=_tooth_band(case, law, state, wear),
        tooth_law=_tooth_law(case, law),
        state=state,
        bearing_area=chain.bearing_area,
        alternating=alternates(case),
        elongation_limit=0.01 * limit,
    )


def with_teeth_alike(
    case: ChainRecord, chain: Chain, law: JointLaw, blocks: Sequence[WrapLoad]
) -> tuple[WrapLoad, ...]:
    """Return loads whose teeth wear by the law of the joints, where both have one wear condition.

    What speed and pressure do to the lubricant between pin and bush they do to it between roller and tooth.
    With it sprockets last two or three chains at every speed, as in practice; without it 20 at 120 rpm.
    """
    of_teeth = _tooth_law(case, law)
    if of_teeth is None:
        return tuple(blocks)
    referred = of_teeth.rate(*law.reference) / of_teeth.coefficient
    factors = [
        law.pressure_factor((block.tension + block.centrifugal) / chain.bearing_area)
        * block.turning_factors[0]
        * referred
        for block in blocks
    ]
    shown = " to ".join(dict.fromkeys(f"{end:.3g}" for end in (min(factors), max(factors))))
    case.assumptions.append(
        f"teeth wear {shown} times as fast as by their coefficient, in proportion to the joints: not "
        "measured on teeth, but sprockets then last two or three chains at every speed, as in practice"
    )
    return tuple(
        replace(block, wear_factor=block.wear_factor * factor)
        for block, factor in zip(blocks, factors, strict=True)
    )


def _tooth_law(case: ChainRecord, law: JointLaw) -> JointLaw | None:
    """Return the law of the teeth, that of the joints from where the rates of their one condition hold.

    None where they have two conditions or none, or a law that is constant.
    """
    of_teeth = case.tables.wear.condition
    if of_teeth is None or _table(case).condition not in (None, of_teeth) or law.is_constant:
        return None
    return law.referred_to(joint_law(wear_conditions()[of_teeth]).reference)


def joint_state(chain: Chain, blocks: Sequence[WrapLoad], own_teeth: float, small: int) -> JointState:
    """Return where the joints run: in the tightest span, means over the duty weighted by what wears them."""
    pressures = [(max(block.spans) + block.centrifugal) / chain.bearing_area for block in blocks]
    weights = [block.share * pressure for block, pressure in zip(blocks, pressures, strict=True)]
    speeds = [block.speed_rpm * own_teeth / small for block in blocks]
    whole = math.fsum(weights)
    pressure, speed = (
        math.fsum(weight * value for weight, value in zip(weights, values, strict=True)) / whole
        for values in (pressures, speeds)
    )
    return JointState(pressure, speed, chain.pitch)


def _table(case: ChainRecord) -> JointTable:
    return case.tables.joint or JointTable()


def _named(case: ChainRecord) -> str | None:
    """Return the wear condition of the joints where one is named, which is that of the teeth by default."""
    return _table(case).condition or case.tables.wear.condition


def _condition(case: ChainRecord) -> WearCondition:
    return wear_conditions()[_named(case) or USUAL_CONDITION]


def _rollers(case: ChainRecord) -> float:
    sprocket = case.tables.sprocket
    assert sprocket is not None
    return sprocket.teeth / sprocket.engaged_every


def _usual_elongation(case: ChainRecord, layout: DriveLayout | LoopLayout) -> float:
    limit, most = elongation_rule(layout)
    case.take("stop.elongation_percent", limit, f"{most}, or 200 % over the larger number of teeth")
    return limit


def _band(case: ChainRecord, law: JointLaw, state: JointState) -> WearBand:
    """Return the band of the rate: of a user's what the user says of it, else of its condition there."""
    table, condition = _table(case), _condition(case)
    # The numbers of the condition itself, as a lock file writes them, are not the user's.
    is_own = table.specific_wear_rate_mm2_per_N is not None and law != joint_law(condition)
    if is_own:
        _say_own_law(case, law, condition, state)
    else:
        _say_law(case, law, condition, state)
    if table.band_factor is not None or is_own:
        factor = table.band_factor or DEFAULT_BAND
        if table.band_factor is None:
            case.take("joint.band_factor", factor, "the joint wear rate is given by the user")
        band = JointBand(1.0 / factor, factor, f"joints: factor {factor:g} to either side")
        # A factor beside a rate is one of where it was found, beside a condition one of here.
        found_elsewhere = is_own and not law.is_constant
        at_ends = extrapolated(band, law, state.held) if found_elsewhere else band
        return WearBand(*at_ends, is_given=table.band_factor is not None)
    known = _named(case) is not None
    lubrication = case.tables.lubrication
    surroundings_known = lubrication is not None and lubrication.environment is not None
    return WearBand(*joint_band(law, condition, state, known, surroundings_known))


def _tooth_band(case: ChainRecord, law: JointLaw, state: JointState, wear: WearInput) -> WearBand:
    """Return the band of the teeth, wider where they wear by the joints' law beyond its window.

    A rate of their own was read where that of the joints was.
    """
    band = WearBand(wear.low, wear.high, wear.band, wear.band_is_given)
    table, of_teeth = case.tables.wear, _tooth_law(case, law)
    if of_teeth is None:
        return band
    if table.specific_wear_rate_mm2_per_N is not None:
        return WearBand(*extrapolated(JointBand(*band[:3]), law, state.held), is_given=band.is_given)
    if table.band_factor:
        return band
    return WearBand(*extrapolated(JointBand(*band[:3]), of_teeth, state))


def _say_law(case: ChainRecord, law: JointLaw, condition: WearCondition, state: JointState) -> None:
    """Record the rate of a condition, and what its law makes of it on this drive."""
    name = repr(condition.condition)
    of = f"wear condition {name}" if _named(case) else f"as for {name}, no condition is given"
    ends = f"{condition.joint_low:g} to {condition.joint_high:g}"
    case.take(JOINT_COEFFICIENT, law.coefficient, f"{of}: {ends}; {condition.joint_source}")
    _record_law(case, law)
    _say_rate(case, law, condition, state)


def _say_own_law(case: ChainRecord, law: JointLaw, condition: WearCondition, state: JointState) -> None:
    source = _table(case).source
    if source is not None:
        case.assumptions.append(f"{JOINT_COEFFICIENT} = {law.coefficient:.4g} comes from: {source}")
    elif _named(case):
        _warn_of_rate(case, condition, law.coefficient, state)
    if law.is_constant and _table(case).law != PRESSURE_SPEED:
        case.take("joint.law", CONSTANT, "a given rate holds at every pressure and speed")
    else:
        _record_law(case, law)
    _say_rate(case, law, condition, state)


def _say_rate(case: ChainRecord, law: JointLaw, condition: WearCondition, state: JointState) -> None:
    """Record what a law makes of the rate here, or that one which could change it does not."""
    if not law.is_constant:
        case.assumptions.append(f"{_law_in_words(law)}; here {law.rate(*state):.3g} mm2/N {_at(state)}")
    elif _table(case).law == PRESSURE_SPEED:
        case.assumptions.append(
            f"joint.law = {PRESSURE_SPEED!r} has no effect here: the exponents of wear condition "
            f"{condition.condition!r} are those of a constant rate; give joint.pressure_exponent, "
            "speed_exponent or pitch_exponent"
        )


def _record_law(case: ChainRecord, law: JointLaw) -> None:
    case.inputs["joint"] |= {key.partition(".")[2]: value for key, value in law_keys(law).items()}


def _law_in_words(law: JointLaw) -> str:
    return (
        f"joint wear by {PRESSURE_SPEED!r}: {law.coefficient:g} mm2/N at {law.reference_pressure:.4g} MPa, "
        f"{law.reference_speed:.4g} rpm and {law.reference_pitch:.4g} mm pitch, with "
        f"pressure^{law.pressure_exponent - 1.0:.3g}, speed^-{law.speed_exponent:.3g} and "
        f"pitch^{law.pitch_exponent:.3g}"
    )


def _at(state: JointState) -> str:
    """Say where joints run, and where a law holds its rate at the end of a range."""
    units = ("MPa", "rpm", "mm pitch")
    held = [
        f"{end:g} {unit}" for value, end, unit in zip(state, state.held, units, strict=True) if value != end
    ]
    taken = f" (rate held at {', '.join(held)})" if held else ""
    return f"at {state.pressure:.3g} MPa and {state.speed:.4g} rpm{taken}"


def _warn_of_rate(case: ChainRecord, state: WearCondition, given: float, at: JointState) -> None:
    """Warn where the joints' rate is one of dry joints and the teeth are lubricated, or reversed.

    A rate that lubricated joints have where these run, by their law, is no contradiction.
    """
    of = {state.machine, "any"} if state.machine != "any" else {"any"}
    alike = [
        row for row in wear_conditions().values() if row.lubricated == state.lubricated and row.machine in of
    ]
    low = min(row.joint_low for row in alike)
    high = max(row.joint_high * max(1.0, joint_law(row).rate(*at) / row.joint_typical) for row in alike)
    if given <= high if state.lubricated else given >= low:
        return
    kinds = ("dry or contaminated", "lubricated")
    table, of_what = ("joint", "joints") if _table(case).condition else ("wear", "teeth")
    case.warnings.append(
        f"{table}.condition = {state.condition!r} contradicts {JOINT_COEFFICIENT} = {given:g}: the {of_what} "
        f"are {kinds[state.lubricated]}, and joints in that state have {low:g} to {high:g} mm2/N; this is a "
        f"rate of {kinds[not state.lubricated]} joints: delete this key to use {state.joint_typical:g}, "
        "choose another condition, or say in joint.source where it was measured"
    )
