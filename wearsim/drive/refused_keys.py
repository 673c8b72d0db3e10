"""Keys that the tables of a whole drive must not hold, or only together."""

from collections.abc import Mapping, Sequence
from typing import Any

from wearsim.drive.wheels import DriveWheel
from wearsim.input.document import Document

GIVEN_BY_WHEELS = "mate_teeth"
"""Key of [drive] that the other sprockets give."""

_OF_ONE_SPROCKET = {
    "turn_sprocket": "is for the case of one sprocket: a drive is planned without turning: remove it",
    "replace_at_percent": "is for the case of one sprocket: the chain of a drive goes at "
    "stop.elongation_percent: remove it",
}
"""Keys of [maintenance] that a drive has no use for."""

_FOR_ONE_SPROCKET = {"fatigue": "contact fatigue is for the case of one sprocket: remove this table"}
"""Tables that a drive has no use for."""


def check_tables(document: Document) -> None:
    """Name the keys that are for the case of one sprocket."""
    drive, duty = (document.data.get(name) for name in ("drive", "duty"))
    for key, message in _OF_ONE_SPROCKET.items():
        if table_of(document.data, "maintenance").get(key):
            document.faults.add(f"maintenance.{key}", message)
    for table, message in _FOR_ONE_SPROCKET.items():
        if table in document.data:
            document.faults.add(table, message)
    kind = table_of(document.data, "mechanism").get("kind", "wrap")
    if kind != "wrap":
        message = f"the chain of a drive wraps its sprockets: must be 'wrap', or left out (got {kind!r})"
        document.faults.add("mechanism.kind", message)
    if isinstance(drive, dict) and GIVEN_BY_WHEELS in drive:
        document.faults.add(f"drive.{GIVEN_BY_WHEELS}", "the other [[sprocket]] gives this: remove it")
    if isinstance(duty, list) and len(document.data["sprocket"]) == 2:
        for number, block in enumerate(duty, start=1):
            if isinstance(block, dict) and "power_share" in block:
                document.faults.add(
                    f"duty.{number}.power_share", "the only driven sprocket has all of the power: remove this"
                )


def check_prices(document: Document, wheels: Sequence[DriveWheel]) -> None:
    """Name the prices of sprockets that need that of the chain."""
    if "chain_price" in table_of(document.data, "maintenance"):
        return
    for number, wheel in enumerate(wheels, start=1):
        if wheel.place.price is not None:
            document.faults.add(
                f"sprocket.{number}.price", "the cost needs maintenance.chain_price too: give both or none"
            )


def table_of(data: Mapping[str, Any], name: str) -> dict[str, Any]:
    """Return a table of an input, empty where there is none."""
    table = data.get(name, {})
    return table if isinstance(table, dict) else {}
