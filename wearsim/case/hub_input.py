"""Bore, keyway and hub of a sprocket, and whether they fit into one another and below the gaps."""

from collections.abc import Callable

from wearsim.case.chain_record import ChainRecord
from wearsim.case.keys import SprocketTable
from wearsim.geometry.hub import NO_HUB, Hub
from wearsim.geometry.wheel_outline import ToothSpace

_NEEDS = {
    "keyway_width_mm": ("bore_mm", "keyway_depth_mm"),
    "keyway_depth_mm": ("bore_mm", "keyway_width_mm"),
    "hub_diameter_mm": ("hub_length_mm",),
    "hub_length_mm": ("hub_diameter_mm",),
}
"""Keys that mean nothing without others."""


def hub_input(case: ChainRecord, table: SprocketTable, space: Callable[[], ToothSpace] | None) -> Hub:
    """Return bore, keyway and hub of a sprocket; what does not fit goes to the faults.

    Without a space between the teeth, where other faults leave none, nothing is compared with the root.
    """
    hub, before = table.plain(Hub), case.faults.count
    if hub == NO_HUB:
        return hub
    for key, others in _NEEDS.items():
        missing = [other for other in others if getattr(table, other) is None]
        if getattr(table, key) is not None and missing:
            case.faults.add(
                f"sprocket.{key}",
                f"needs {' and '.join(missing)}, which {'is' if len(missing) == 1 else 'are'} missing: give "
                f"{'it' if len(missing) == 1 else 'both'} or remove this key",
            )
    _check_bore(case, hub)
    if space is not None:
        _check_root(case, hub, 2.0 * space().root_radius)
    if case.faults.count == before:
        case.assumptions.append(f"{', '.join(hub.notes)}: of the exported wheel; the wear does not change")
    return hub


def _check_bore(case: ChainRecord, hub: Hub) -> None:
    """Compare the keyway with the bore, and the hub with both."""
    if not hub.bore:
        return
    if hub.keyway_width >= hub.bore:
        case.faults.add(
            "sprocket.keyway_width_mm",
            f"must be below the bore of {hub.bore:g} mm (got {hub.keyway_width:g}): DIN 6885 gives the "
            "width for every diameter of the shaft",
        )
    if 0.0 < hub.hub_diameter <= hub.bore:
        case.faults.add(
            "sprocket.hub_diameter_mm",
            f"must be above the bore of {hub.bore:g} mm (got {hub.hub_diameter:g}): give a larger hub or "
            "a smaller bore",
        )
    elif _has_keyway(hub) and 0.0 < hub.hub_diameter <= 2.0 * hub.bore_reach:
        case.faults.add("sprocket.keyway_depth_mm", _too_deep(hub, f"hub of {hub.hub_diameter:g} mm"))


def _check_root(case: ChainRecord, hub: Hub, root: float) -> None:
    """Compare bore, keyway and hub with the root diameter."""
    for key, diameter in (("bore_mm", hub.bore), ("hub_diameter_mm", hub.hub_diameter)):
        if diameter >= root:
            case.faults.add(
                f"sprocket.{key}",
                f"must be below the root diameter of the gaps, {root:.5g} mm (got {diameter:g}): give a "
                "smaller one or more teeth",
            )
    if _has_keyway(hub) and not hub.hub_diameter and hub.bore < root <= 2.0 * hub.bore_reach:
        case.faults.add("sprocket.keyway_depth_mm", _too_deep(hub, f"root diameter of {root:.5g} mm"))


def _has_keyway(hub: Hub) -> bool:
    """Whether a keyway is given that the bore is wide enough for."""
    return 0.0 < hub.keyway_width < hub.bore and hub.keyway_depth > 0.0


def _too_deep(hub: Hub, around: str) -> str:
    return (
        f"the corners of the keyway must lie inside the {around}, but lie on {2.0 * hub.bore_reach:.5g} mm "
        f"(got {hub.keyway_depth:g}): give a smaller bore or keyway"
    )
