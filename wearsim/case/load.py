"""Reading a case: from a file or a mapping, with overrides, to a complete Case."""

import copy
import re
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from wearsim.case.messages import Faults
from wearsim.case.model import Case
from wearsim.case.resolve import resolve
from wearsim.case.schema import CaseTables
from wearsim.errors import CaseError, Fault

_STAND_INS: dict[str, Any] = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "load": {"tension_N": 1.0, "speed_rpm": 1.0},
    "wear": {"specific_wear_rate_mm2_per_N": 1e-10},
}
"""What takes the place of a faulty part while the others are looked at."""


def load_case(source: "str | Path | Mapping[str, Any]", overrides: Sequence[str] = ()) -> Case:
    """Return the case of an input file or of a mapping with the same tables.

    Parameters
    ----------
    source : path or mapping
        A TOML file, or its tables as dictionaries (paths in it are then relative to the
        working directory).
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
    if isinstance(source, Mapping):
        name, text, folder = "case", "", Path()
        data = copy.deepcopy(dict(source))
    else:
        path = Path(source)
        name, folder = path.stem, path.parent
        text, data = _read(path)
    file = "case" if isinstance(source, Mapping) else str(source)
    faults = Faults(file, text, [item.partition("=")[0].strip() for item in overrides])
    for item in overrides:
        _override(data, item)
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
    if "duty" in wrong:
        sound.pop("duty", None)
    for entry in error.errors():
        if entry["loc"][0] == "duty":
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


def _read(path: Path) -> tuple[str, dict[str, Any]]:
    try:
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise CaseError(
            [Fault(f"must be a readable file: {error.strerror}", "", str(path))]
        ) from None
    except UnicodeDecodeError:
        raise CaseError([Fault("must be UTF-8 text: save it as UTF-8", "", str(path))]) from None
    try:
        return text, tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        place = re.search(r"\(at line (\d+), column \d+\)", str(error))
        line = int(place.group(1)) if place else text.count("\n") + 1
        raise CaseError([Fault(f"not valid TOML: {error}", "", str(path), line)]) from None
    except (ValueError, RecursionError) as error:
        raise CaseError([Fault(f"not readable TOML: {error}", "", str(path))]) from None


def _bare(raw: str) -> float | str:
    """Return what is not TOML: a number such as .5, else the text itself."""
    try:
        return float(raw)
    except ValueError:
        return raw


def _override(data: dict[str, Any], item: str) -> None:
    key, equals, raw = item.partition("=")
    key, raw = key.strip(), raw.strip()
    if not equals or not all(key.split(".")):
        raise CaseError([Fault("must have the form table.key=VALUE", "", f"--set {item}")])
    try:
        value = tomllib.loads(f"value = {raw}")["value"]
    except (ValueError, RecursionError):
        value = _bare(raw)
    *tables, last = key.split(".")
    place: Any = data
    for table in tables:
        place = place.setdefault(table, {})
        if not isinstance(place, dict):
            raise CaseError([Fault(f"{table!r} is a key, not a table", "", f"--set {key}")])
    place[last] = value
