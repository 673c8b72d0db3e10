"""Reading a case: from a file or a mapping, with overrides, to a complete Case."""

import copy
from collections.abc import Mapping, Sequence
from typing import Any

from pydantic import ValidationError

from wearsim.case.complete_case import resolve
from wearsim.case.model import Case
from wearsim.input.calculation_file import checked
from wearsim.input.document import Source, read_document
from wearsim.input.messages import Faults
from wearsim.input.schema import CaseTables

_STAND_INS: dict[str, Any] = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "load": {"tension_N": 1.0, "speed_rpm": 1.0},
    "wear": {"specific_wear_rate_mm2_per_N": 1e-10},
}
"""What takes the place of a faulty part while the others are looked at."""


def load_case(source: Source, overrides: Sequence[str] = ()) -> Case:
    """Return the case of an input file, of its text or of a mapping with the same tables.

    Parameters
    ----------
    source : path, CaseText or mapping
        A TOML file, its text, or its tables as dictionaries (paths in it are then relative to
        the working directory).
    overrides : sequence of str
        ``table.key=VALUE``, applied before validation; VALUE is TOML, else a string.

    Returns
    -------
    Case
        Complete: every default filled in and named under ``assumptions``.

    Raises
    ------
    CaseError
        Everything that is wrong with the input, with file and line.

    Examples
    --------
    >>> case = load_case({
    ...     "format_version": 1,
    ...     "chain": {"designation": "16B-1"},
    ...     "sprocket": {"teeth": 20, "profile": "evolute"},
    ...     "load": {"power_kW": 3, "speed_rpm": 100},
    ...     "wear": {"condition": "hardened, oiled"},
    ... })
    >>> case.cycles_per_hour
    6000.0
    """
    document = read_document(source, overrides)
    name, folder, data, faults = document.name, document.folder, document.data, document.faults
    if "gear" in data:
        # Models of tables take time to build, and most cases are not of gears.
        from wearsim.case.gear_case import resolve_gear
        from wearsim.input.schema.gear import GearTables

        return resolve_gear(checked(document, GearTables), name, folder, faults)
    _check_load(data, faults)
    try:
        tables = CaseTables.model_validate(data)
    except ValidationError as error:
        faults.add_validation(error, CaseTables)
        faults.distrust(_wrong_tables(data, error))
        rest = _sound_part(data, error)
        if rest is not None:
            resolve(rest, name, folder, faults)
        faults.check()
        raise
    return resolve(tables, name, folder, faults)


def _check_load(data: Mapping[str, Any], faults: Faults) -> None:
    """Name what is missing of the load unless tables of [[duty]] or a log give it."""
    if data.get("duty"):
        return
    if "load" not in data:
        faults.add("load", "this table is required and missing")
    elif isinstance(data["load"], dict) and not data["load"].keys() & {"speed_rpm", "duty_file"}:
        faults.add("load.speed_rpm", "this key is required and missing")


def _sound_part(data: dict[str, Any], error: ValidationError) -> CaseTables | None:
    """Return the case without its wrong keys, to look for more faults; None if that is none."""
    sound, wrong = copy.deepcopy(data), _wrong_tables(data, error)
    whole = {"duty", "fatigue", "uncertainty", "optimise"} & wrong
    for name in whole:
        sound.pop(name, None)
    for entry in error.errors():
        if entry["loc"][0] in whole:
            continue
        *tables, last = entry["loc"]
        conflicting = [name for name, _ in entry.get("ctx", {}).get("faults", ())]
        place: Any = sound
        for table in [*tables, last] if conflicting else tables:
            place = place.get(table, {})
        for name in conflicting or [last]:
            place.pop(name, None)
    sound |= {name: _STAND_INS[name] for name in wrong & set(_STAND_INS)}
    try:
        return CaseTables.model_validate(sound)
    except ValidationError:
        return None


def _wrong_tables(data: dict[str, Any], error: ValidationError) -> set[str]:
    """Return the tables with faults, and those whose checks rest on them."""
    wrong = {str(entry["loc"][0]) for entry in error.errors()}
    if "chain" in wrong:
        wrong |= {"load"} | ({"sprocket"} & data.keys())
    if wrong & {"load", "duty"}:
        wrong |= {"load"} | ({"duty"} & data.keys())
    return wrong | {"stop"} if "sprocket" in wrong else wrong
