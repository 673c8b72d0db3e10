"""From the tables of a sprocket and its chain to a complete case: defaults, checks across tables, limits."""

import copy
import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from pathlib import PurePath
from typing import Any, TypeVar

from pydantic import ValidationError

from wearsim.case.chain_record import ChainRecord, mechanism_kind
from wearsim.case.duty_blocks import GivenDuty, complete_duty
from wearsim.case.keys import CaseTables, ChainTable, PlaceTable
from wearsim.case.model import Case, Drive, WearInput
from wearsim.case.table_inputs import (
    contact_modulus_of,
    fatigue_input,
    film_input,
    run_input,
    take_defaults,
    wear_input,
)
from wearsim.catalogue.catalogues import KG_PER_M, Chain, chains
from wearsim.catalogue.chain_names import chain_name, name_of_strands, strands_there_are
from wearsim.contact.stop_limits import CHAIN_LIMITS
from wearsim.geometry.forms import TOOTH_FORMS
from wearsim.input.document import Document
from wearsim.input.faults import Faults
from wearsim.input.mechanism_registry import is_whole_drive, mechanism_of
from wearsim.lubrication.read import lubrication_input, warn_of_dried_teeth

_DEEP = 0.3
"""Critical depth over tooth thickness above which the tooth itself is in doubt."""

STAND_INS: dict[str, Any] = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "load": {"tension_N": 1.0, "speed_rpm": 1.0},
    "wear": {"specific_wear_rate_mm2_per_N": 1e-10},
}
"""What takes the place of a faulty part while the others are looked at."""

_Tables = TypeVar("_Tables", bound=CaseTables)

Builder = Callable[[ChainRecord, WearInput, Chain, GivenDuty | None], Drive | None]
"""Completes a drive from its tables; None where they do not make one, which the faults tell."""


def read_sprocket(document: Document) -> Case:
    """Return the case of a sprocket and its chain, or raise all that is wrong with it."""
    build: Builder = mechanism_of(document.data).load("build")
    tables, wrong = sound_tables(document.data, document.faults, CaseTables)
    document.faults.distrust(wrong)
    case = complete_case(tables, document, build)
    document.faults.check()
    assert case is not None
    return case


def sound_tables(data: dict[str, Any], faults: Faults, model: type[_Tables]) -> tuple[_Tables, set[str]]:
    """Return what is right of the tables of an input, and the names of those that are not.

    Others stand in for these, so that the rest can be looked at too. Raises where nothing can.
    """
    _check_load(data, faults)
    try:
        return model.model_validate(data), set()
    except ValidationError as error:
        faults.add_validation(error, model)
        wrong = _wrong_tables(data, error)
        rest = _sound_part(data, error, wrong, model)
        if rest is None:
            faults.check()
            raise
        return rest, wrong


def complete_case(tables: CaseTables, document: Document, build: Builder) -> Case | None:
    """Return the case of some tables; None where they do not make one, which the faults tell."""
    faults, before = document.faults, document.faults.count
    case = ChainRecord(tables, document.folder, faults)
    take_defaults(case, tables)
    chain = _chain(case, tables.chain)
    materials = tables.material
    modulus = contact_modulus_of(case, {"sprocket": materials.sprocket, "roller": materials.roller})
    wear = wear_input(case, tables.wear)
    kind = mechanism_kind(case)
    if kind != "wrap" and tables.wear.condition and tables.wear.specific_wear_rate_mm2_per_N:
        text = "gives the specific wear rate: remove it or specific_wear_rate_mm2_per_N (a wrap allows both)"
        faults.add("wear.condition", text)
    duty = complete_duty(case, kind, chain)
    prices = tables.maintenance
    if prices is not None and prices.chain_price is not None and prices.sprocket_price is None:
        faults.add("maintenance.chain_price", "the cost needs sprocket_price too: give both or neither")
    drive = build(case, wear, chain, duty)
    critical_depth = _critical_depth(case, drive)
    more_limits = _more_limits(case, drive)
    run = run_input(case, tables.run, (drive or Drive).life_tolerance)
    fatigue = fatigue_input(case, tables.fatigue)
    per_hour = tables.service.km_per_hour if tables.service else None
    wear_table = tables.wear
    lubrication = lubrication_input(
        case, tables.lubrication, per_hour, wear_table.condition, wear_table.tooth_hardness
    )
    if wear_table.condition is not None and wear_table.specific_wear_rate_mm2_per_N is None:
        warn_of_dried_teeth(case, lubrication, wear_table.condition)
    if drive is None or duty is None or faults.count > before:
        return None
    return Case(
        name=document.name,
        title=tables.title or _title(case, kind),
        inputs=case.inputs,
        files=tuple(case.files),
        input_files=case.texts(),
        drive=drive,
        modulus=modulus,
        speed_rpm=duty.speed_rpm,
        engaged_every=tables.sprocket.engaged_every if tables.sprocket else 1,
        turns_per_cycle=_turns_per_cycle(case),
        wear=wear,
        critical_depth=critical_depth,
        more_limits=more_limits,
        run=run,
        fatigue=fatigue,
        assumptions=tuple(case.assumptions),
        warnings=tuple(case.warnings),
        given=document.given,
        lubrication=lubrication,
        film=film_input(tables.film),
    )


def _title(case: ChainRecord, kind: str) -> str:
    """What a case is about that has no title of its own."""
    given, sprocket = case.inputs["chain"], case.inputs.get("sprocket", {})
    name = given.get("designation")
    chain = f"{name} chain" if name else f"chain of {given['pitch_mm']:g} mm pitch"
    if kind == "prescribed":
        return f"Flank under the loads of {PurePath(case.inputs['mechanism']['table_file']).name}"
    if kind == "wrap":
        return f"{chain[0].upper()}{chain[1:]} around a sprocket of {sprocket['teeth']} teeth"
    return f"{TOOTH_FORMS[sprocket['profile']].on_strand}, {chain}, {sprocket['teeth']} teeth"


def _turns_per_cycle(case: ChainRecord) -> int:
    """Turns between two loadings of a gap; some gaps carry no roller where it is not engaged_every."""
    table = case.tables.sprocket
    if table is None:
        return 1
    common = math.gcd(table.teeth, table.engaged_every)
    if common > 1:
        case.warnings.append(
            f"with {table.teeth} gaps and engaged_every = {table.engaged_every} the rollers meet the "
            f"same {table.teeth // common} gaps: those wear {common} times as fast as if all gaps were used"
        )
    return table.engaged_every // common


def _chain(case: ChainRecord, table: ChainTable) -> Chain:
    strands = table.strands or 1
    if table.designation is None:
        assert table.pitch_mm and table.roller_diameter_mm and table.inner_width_mm
        return replace(
            Chain("", table.pitch_mm, table.roller_diameter_mm, table.inner_width_mm),
            pin_diameter=table.pin_diameter_mm or 0.0,
            bearing_area=strands * (table.bearing_area_mm2 or 0.0),
            mass_per_length=strands * KG_PER_M * (table.mass_kg_per_m or 0.0),
            strands=strands,
        )
    name = chain_name(table.designation)
    assert name is not None
    if chains()[name].strands != strands and strands > 1:
        several = name_of_strands(name, strands)
        if several is None:
            text = f"no such chain in the catalogue: {strands_there_are(name, strands)}"
            case.faults.add("chain.strands", text)
            return chains()[name]
        name = several
        case.inputs["chain"]["designation"] = name
        case.assumptions.append(f"{strands} strands: chain {name}; they share the pull evenly")
    elif name != table.designation:
        case.inputs["chain"]["designation"] = name
        case.assumptions.append(f"chain {table.designation!r} is read as {name} of the catalogue")
    chain = chains()[name]
    chain = replace(
        chain,
        pin_diameter=chain.pin_diameter or table.pin_diameter_mm or 0.0,
        bearing_area=chain.bearing_area or table.bearing_area_mm2 or 0.0,
        mass_per_length=KG_PER_M * (table.mass_kg_per_m or 0.0) or chain.mass_per_length,
    )
    if table.mass_kg_per_m and chains()[name].mass_per_length:
        known = chains()[name].mass_per_length / KG_PER_M
        case.assumptions.append(
            f"chain.mass_kg_per_m {table.mass_kg_per_m:g} instead of the catalogue's {known:.4g}"
        )
    if chain.note:
        case.assumptions.append(f"catalogue note on chain {chain.designation}: {chain.note}")
    return chain


def _critical_depth(case: ChainRecord, drive: Drive | None) -> float:
    given = case.tables.stop.critical_depth_mm
    if given is not None:
        _check_depth(case, drive, given)
        return given
    if drive is not None and drive.has_tooth:
        depth = float(f"{0.1 * drive.pitch_line_thickness:.4g}")
        if depth > 0.0:
            case.take("stop.critical_depth_mm", depth, "10 % of the tooth thickness at the pitch line")
            return depth
        case.faults.add(
            "stop.critical_depth_mm",
            "required: the tooth has no thickness at the pitch line to derive it from: give it, or "
            "check the points of the flank",
        )
    elif drive is not None:
        case.faults.add("stop.critical_depth_mm", "required: a table of loads has no tooth to derive it from")
    return math.nan


def _check_depth(case: ChainRecord, drive: Drive | None, depth: float) -> None:
    """Compare a given critical depth with the tooth that has to bear it."""
    if drive is None or not drive.has_tooth:
        return
    thinnest, thickness = drive.thinnest, drive.pitch_line_thickness
    if depth >= thinnest > 0.0:
        case.faults.add(
            "stop.critical_depth_mm",
            f"must be below the thickness of the tooth at its thinnest, {thinnest:.4g} mm (got {depth:g})",
        )
    elif depth > _DEEP * thickness > 0.0:
        case.warnings.append(
            f"critical depth {depth:g} mm is more than {_DEEP:g} of the tooth thickness "
            f"{thickness:.3g} mm at the pitch line: the tooth may break first"
        )


def _more_limits(case: ChainRecord, drive: Drive | None) -> dict[str, float]:
    """Limits beyond the critical depth by their keys; what a tooth falls to lies below what it has new."""
    found = {}
    for row in CHAIN_LIMITS[1:]:
        limit = getattr(case.tables.stop, row.key)
        if limit is None:
            continue
        found[row.key] = limit
        if drive is None or row.new is None:
            continue
        if not drive.has_tooth:
            case.faults.add(f"stop.{row.key}", f"a table of loads has {row.needs}: remove this key")
        elif row.new(drive) <= limit:
            text = f"must be below {row.new_words}, {row.new(drive):.4g} mm (got {limit:g})"
            case.faults.add(f"stop.{row.key}", text)
    return found


def _check_load(data: Mapping[str, Any], faults: Faults) -> None:
    """Name what is missing of the load unless tables of [[duty]] or a log give it."""
    if data.get("duty"):
        return
    if "load" not in data:
        faults.add("load", "this table is required and missing")
    elif isinstance(data["load"], dict) and not data["load"].keys() & {"speed_rpm", "duty_file"}:
        faults.add("load.speed_rpm", "this key is required and missing")


def _sound_part(
    data: dict[str, Any], error: ValidationError, wrong: set[str], model: type[_Tables]
) -> _Tables | None:
    """Return the case without its wrong keys, to look for more faults; None if that is none."""
    sound = copy.deepcopy(data)
    whole = {"duty", "fatigue", "lubrication", "uncertainty", "optimise"} & wrong
    for name in whole:
        sound.pop(name, None)
    for *tables, last in _wrong_keys(error):
        if tables and tables[0] in whole:
            continue
        if tables[:1] == ["sprocket"] and is_whole_drive(data) and {last, *tables[2:]} & _OF_THE_LOOP:
            return None
        place: Any = sound
        for table in tables:
            place = place.get(table, {}) if isinstance(place, dict) else place[int(table)]
        place.pop(last, None)
    sound |= {name: STAND_INS[name] for name in wrong & set(STAND_INS)}
    try:
        return model.model_validate(sound)
    except ValidationError:
        return None


_OF_THE_LOOP = {*PlaceTable.model_fields, "teeth"}
"""Keys of a sprocket of a drive without which the others cannot be looked at."""


def _wrong_keys(error: ValidationError) -> Iterator[tuple[int | str, ...]]:
    """Give the places of all keys with faults."""
    for entry in error.errors():
        conflicting = [(*entry["loc"], name) for name, _ in entry.get("ctx", {}).get("faults", ())]
        yield from conflicting or [entry["loc"]]


def _wrong_tables(data: dict[str, Any], error: ValidationError) -> set[str]:
    """Return the tables with faults, and those whose checks rest on them; sprockets of a drive by number."""
    several = is_whole_drive(data)
    wrong = {
        f"sprocket.{int(rest[0]) + 1}" if several and table == "sprocket" else str(table)
        for table, *rest in _wrong_keys(error)
    }
    if "chain" in wrong:
        wrong |= {"load"} | ({"sprocket", "drive"} & data.keys())
    if "lubrication" in wrong:
        wrong |= {"wear"} - data.keys()
    if wrong & {"load", "duty"}:
        wrong |= {"load"} | ({"duty"} & data.keys())
    return wrong | {"stop"} if "sprocket" in wrong else wrong
