"""Words of input files that have better ones now: they are read as these, and the answer says so."""

import re
from collections.abc import Callable, Mapping
from typing import Any

_KEYS = {
    "cyclogram": "load_spectrum",
    "exploitation_factor": "joint_application_factor",
    "pole_angle_deg": "pitch_point_angle_deg",
    "head_arc_radius_mm": "addendum_arc_radius_mm",
    "foot_arc_radius_mm": "dedendum_arc_radius_mm",
    "pole_distance_mm": "pitch_point_distance_mm",
    "first_pole_distance_mm": "first_pitch_point_distance_mm",
    "last_pole_distance_mm": "last_pitch_point_distance_mm",
    "stress_pole_distance_mm": "stress_pitch_point_distance_mm",
}
_VALUES = {"treatment": {"improved": "quenched_and_tempered"}}
"""Keys, and values of a key, by what they were called. None is the name of anything else in an input."""

Note = Callable[[str, str], None]
"""Takes the dotted name of a key, and what is to be known about it."""


def present_key(key: str) -> str:
    """Return a key or the dotted name of one in the words of today.

    Examples
    --------
    >>> present_key("gear.pole_angle_deg")
    'gear.pitch_point_angle_deg'
    """
    return ".".join(_KEYS.get(part, part) for part in key.split("."))


def written_key(key: str, text: str) -> str:
    """Return the dotted name of a key as it stands in the text of an input.

    Examples
    --------
    >>> written_key("gear.pitch_point_angle_deg", "gear.pole_angle_deg = 20")
    'gear.pole_angle_deg'
    """
    former = {new: old for old, new in _KEYS.items() if old in text and not re.search(rf"\b{new}\b", text)}
    return ".".join(former.get(part, part) for part in key.split("."))


def present_tables(tables: Mapping[str, Any], note: Note, fault: Note, prefix: str = "") -> dict[str, Any]:
    """Return tables in the words of today; with both words of a key there is a fault."""
    found: dict[str, Any] = {}
    for key, value in tables.items():
        name = present_key(key) if isinstance(key, str) else key
        if name != key:
            if name in tables:
                fault(f"{prefix}{name}", f"{key} is what it was called before: remove one of both")
                continue
            note(f"{prefix}{key}", f"is read as {name}: write that")
        found[name] = _present_value(value, f"{prefix}{name}", note, fault)
    return found


def _present_value(value: Any, key: str, note: Note, fault: Note) -> Any:
    if isinstance(value, Mapping):
        return present_tables(value, note, fault, f"{key}.")
    if isinstance(value, list):
        return [_present_value(entry, key, note, fault) for entry in value]
    new = _VALUES.get(key.rpartition(".")[2], {}).get(value) if isinstance(value, str) else None
    if new is None:
        return value
    note(key, f"{value!r} is read as {new!r}: write that")
    return new
