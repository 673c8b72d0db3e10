"""A drive with all of its sprockets, `[[sprocket]]`, taken apart into the cases of each of them."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from wearsim.case.model import Case
from wearsim.errors import CaseError
from wearsim.input.document import CaseSource, Document, read_document
from wearsim.input.faults import Faults
from wearsim.input.mechanism_registry import mechanism_of
from wearsim.input.units import convert

_OF_WHEEL = ("name", "wear", "material")
"""Keys of a `[[sprocket]]` that a case of one sprocket has in other places."""

_ROLES = ("driver", "driven")

_GIVEN_BY_WHEELS = "mate_teeth"


@dataclass(frozen=True)
class DriveSprocket:
    """A sprocket of a drive."""

    name: str  # as the user calls it
    case: Case  # of this sprocket alone


@dataclass(frozen=True)
class DriveCase:
    """A drive whose sprockets share one chain."""

    name: str  # stem of its file
    title: str  # of the file, or what is driven by what
    inputs: Mapping[str, Any]  # tables of the file
    sprockets: tuple[DriveSprocket, ...]  # in the order of the file

    @property
    def driver(self) -> DriveSprocket:
        """The sprocket that drives the chain."""
        return next(one for one in self.sprockets if one.case.inputs["sprocket"]["role"] == "driver")

    @property
    def assumptions(self) -> tuple[str, ...]:
        """What is taken for granted of any sprocket, each once."""
        return tuple(dict.fromkeys(text for one in self.sprockets for text in one.case.assumptions))


def holds_sprockets(tables: Mapping[str, Any]) -> bool:
    """Tell whether tables name the sprockets of a whole drive.

    Examples
    --------
    >>> holds_sprockets({"sprocket": [{"teeth": 21}]}), holds_sprockets({"sprocket": {"teeth": 21}})
    (True, False)
    """
    return isinstance(tables.get("sprocket"), list)


def load_drive(source: CaseSource, overrides: Sequence[str] = ()) -> DriveCase:
    """Return the drive of an input file, of its text or of a mapping with the same tables.

    Parameters
    ----------
    source : path, CaseText or mapping
        A TOML file with ``[[sprocket]]`` twice, its text, or its tables as dictionaries. ``[load]`` and
        ``[[duty]]`` are those of the driver.
    overrides : sequence of str
        ``table.key=VALUE``, applied before validation; ``sprocket.2.teeth=57`` sets the second one.

    Returns
    -------
    DriveCase
        A complete case of every sprocket.

    Raises
    ------
    CaseError
        Everything that is wrong with the input, with file and line.
    """
    document = read_document(source, overrides)
    wheels = _wheels(document)
    document.faults.check()
    seen: set[tuple[str, str]] = set()
    cases = [_case(document, wheels, number, seen) for number in range(len(wheels))]
    document.faults.check()
    sprockets = tuple(
        DriveSprocket(str(wheel["name"]), case)
        for wheel, case in zip(wheels, cases, strict=True)
        if case is not None
    )
    title = document.data.get("title") or _title(sprockets)
    return DriveCase(document.name, title, document.data, sprockets)


def _title(sprockets: Sequence[DriveSprocket]) -> str:
    first = sprockets[0].case
    teeth = " to ".join(str(one.case.inputs["sprocket"]["teeth"]) for one in sprockets)
    chain = first.inputs["chain"].get("designation", f"chain of {first.inputs['chain'].get('pitch_mm')} mm")
    return f"{chain}, {teeth} teeth"


def _wheels(document: Document) -> list[dict[str, Any]]:
    """Return the sprockets, the driver first, with a role and a name each; name what is wrong with them."""
    faults, wheels = document.faults, document.data["sprocket"]
    if not all(isinstance(wheel, dict) for wheel in wheels):
        faults.add("sprocket", "must be tables under headers [[sprocket]]")
        return []
    if len(wheels) != 2:
        faults.add(
            "sprocket", f"a drive must have two sprockets, a driver and a driven one (got {len(wheels)})"
        )
        return []
    found = []
    for number, wheel in enumerate(wheels, start=1):
        role = wheel.get("role", _ROLES[number - 1])
        name = wheel.get("name", role)
        if role not in _ROLES:
            faults.add(f"sprocket.{number}.role", f"must be 'driver' or 'driven' (got {role!r})")
        if not isinstance(name, str) or not name.strip():
            faults.add(f"sprocket.{number}.name", f"must be a text (got {name!r})")
        teeth = wheel.get("teeth")
        if not isinstance(teeth, int) or isinstance(teeth, bool) or teeth < 5:
            faults.add(f"sprocket.{number}.teeth", f"must be a whole number of at least 5 (got {teeth!r})")
        elif _every(wheel) > 1 and teeth % _every(wheel):
            faults.add(
                f"sprocket.{number}.engaged_every",
                f"must divide the number of teeth of a whole drive, {teeth} (got {_every(wheel)})",
            )
        found.append({**wheel, "role": role, "name": name})
    if len({wheel["role"] for wheel in found}) < len(found):
        faults.add("sprocket.2.role", f"one sprocket drives, the other is driven (both {found[1]['role']!r})")
    if len({wheel["name"] for wheel in found}) < len(found):
        faults.add("sprocket.2.name", f"sprockets need different names (got {found[1]['name']!r} twice)")
    drive = document.data.get("drive")
    if isinstance(drive, dict) and _GIVEN_BY_WHEELS in drive:
        faults.add(f"drive.{_GIVEN_BY_WHEELS}", "the other [[sprocket]] gives this: remove it")
    load = document.data.get("load")
    if isinstance(load, dict) and "duty_file" in load:
        faults.add("load.duty_file", "a drive with [[sprocket]] takes no log of loads: use [[duty]]")
    return found


def _every(wheel: Mapping[str, Any]) -> int:
    every = wheel.get("engaged_every", 1)
    return every if type(every) is int and every >= 1 else 1


def _rollers(wheel: Mapping[str, Any]) -> int:
    """Return how many rollers a sprocket takes along in a turn."""
    return int(wheel["teeth"]) // _every(wheel)


def _case(
    document: Document, wheels: Sequence[Mapping[str, Any]], number: int, seen: set[tuple[str, str]]
) -> Case | None:
    """Return the case of one sprocket; what is wrong with it is added to the faults of the drive."""
    own = Document(document.name, document.folder, _tables(document.data, wheels, number), Faults("", "", ()))
    read: Callable[[Document], Case] = mechanism_of(own.data).load("read")
    try:
        return read(own)
    except CaseError as error:
        for fault in error.faults:
            key = _key(fault.key, wheels, number)
            if (key, fault.message) not in seen:
                document.faults.add(key, fault.message)
            seen.add((key, fault.message))
        return None


def _key(key: str, wheels: Sequence[Mapping[str, Any]], number: int) -> str:
    """Return the key of the file that a key of the case of one sprocket comes from."""
    table, _, name = key.partition(".")
    if table == "sprocket":
        return f"sprocket.{number + 1}.{name}".rstrip(".")
    if table in _OF_WHEEL and name.split(".")[0] in wheels[number].get(table, {}):
        return f"sprocket.{number + 1}.{key}"
    return key


def _tables(data: Mapping[str, Any], wheels: Sequence[Mapping[str, Any]], number: int) -> dict[str, Any]:
    """Return the tables of the case of one sprocket: its teeth, its speed and its torque."""
    wheel = wheels[number]
    mate = wheels[1 - number]
    driver = wheel if wheel["role"] == "driver" else mate
    own = {key: value for key, value in wheel.items() if key not in _OF_WHEEL}
    tables: dict[str, Any] = {
        **{key: value for key, value in data.items() if key != "title"},
        "sprocket": own,
        "drive": {**_table(data, "drive"), _GIVEN_BY_WHEELS: _rollers(mate)},
        "mechanism": {"kind": "wrap", **_table(data, "mechanism")},
    }
    if "wear" in wheel:
        tables["wear"] = wheel["wear"]
    if "material" in wheel:
        tables["material"] = {**_table(data, "material"), "sprocket": wheel["material"]}
    ratio = _rollers(driver) / _rollers(wheel)
    if wheel is not driver:
        if isinstance(data.get("load"), dict):
            tables["load"] = _turned(data["load"], ratio)
        if isinstance(data.get("duty"), list):
            tables["duty"] = [
                _turned(block, ratio) if isinstance(block, dict) else block for block in data["duty"]
            ]
    return tables


def _table(data: Mapping[str, Any], name: str) -> dict[str, Any]:
    table = data.get(name, {})
    return table if isinstance(table, dict) else {}


def _turned(load: Mapping[str, Any], ratio: float) -> dict[str, Any]:
    """Return a load of the driver as that of a sprocket that turns by ``ratio`` times its speed."""
    turned = dict(load)
    for key, unit, factor in (("speed_rpm", "rpm", ratio), ("torque_N_m", "N*m", 1.0 / ratio)):
        value = load.get(key)
        if isinstance(value, str):
            try:
                value = convert(value, unit)
            except ValueError:
                continue
        if isinstance(value, int | float) and not isinstance(value, bool):
            turned[key] = value * factor
    return turned
