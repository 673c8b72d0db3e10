"""What [sprocket] gives, completed: the working flank, evolute or through points, bore and hub."""

import math
from collections.abc import Callable
from functools import lru_cache

from wearsim.case.chain_record import ChainRecord
from wearsim.case.keys import SprocketTable
from wearsim.catalogue.catalogues import Chain
from wearsim.errors import GeometryError
from wearsim.geometry.feasibility import OFFSET_RESERVE, evolute_limits, remedy, smallest_offset, tooth_limits
from wearsim.geometry.forms.evolute import Strand, contact_ratio, evolute_flank
from wearsim.geometry.hub import NO_HUB, Hub
from wearsim.geometry.measured.points import contact_range, flank_from_points, gap_rotation, working_side
from wearsim.geometry.tooth import CUT_TOLERANCE, RELIEF_PER_PITCH, Tooth
from wearsim.geometry.wheel_outline import ToothSpace
from wearsim.input.csv_tables import read_flank_points

CONTACT_END_PER_PITCH = 0.16
CONTACT_RATIO = 1.05
_PHASE_TOLERANCE = math.radians(0.1)
POINTS_NOISE = 1e-4
"""Error of a flank's points assumed where none is given [mm]."""


def evolute_tooth(
    case: ChainRecord, table: SprocketTable, chain: Chain, centrode: float, nodes: int
) -> tuple[Tooth, float, float] | None:
    """Complete a tooth around an evolute flank."""
    end, start, offset = table.contact_end_mm, table.contact_start_mm, table.evolute_offset_mm
    if end is None:
        end = float(f"{CONTACT_END_PER_PITCH * chain.pitch:.6g}")
        case.take("sprocket.contact_end_mm", end, "0.16 pitch")
    if start is None:
        start = float(f"{end + CONTACT_RATIO * chain.pitch:.6g}")
        case.take("sprocket.contact_start_mm", start, "contact ratio 1.05")
    if "back_flank" not in table.model_fields_set:
        case.take("sprocket.back_flank", table.back_flank, "default")
    radius = 0.5 * chain.roller_diameter
    if offset is None:
        offset = _default_offset(case, table, chain, centrode, (end, start))
        if offset is None:
            return None
    strand = Strand(centrode, radius, offset)
    limits, tooth, thin = _feasible(
        strand, (end, start), nodes, table.teeth, _relief(table, chain), chain.pitch
    )
    for name, message in limits:
        help_out = offset >= centrode and name == "evolute_offset"
        advice = _remedy(table, chain, (end, start)) if help_out else ""
        case.faults.add(f"sprocket.{name}_mm", f"{message}{advice}")
    for message in thin:
        case.faults.add("sprocket.teeth", f"{message}{_remedy(table, chain, (end, start))}")
    return None if tooth is None or thin else (tooth, end, start)


@lru_cache(maxsize=32)
def _feasible(
    strand: Strand, contact: tuple[float, float], nodes: int, teeth: int, relief: float, pitch: float
) -> tuple[list[tuple[str, str]], Tooth | None, list[str]]:
    """Limits of the flank that fail, the tooth around it, and limits of the tooth that fail.

    Cases of a study share their tooth, which takes longer to check than all the rest of a case.
    """
    limits = evolute_limits(strand, *contact, pitch)
    if limits:
        return limits, None, []
    flank = evolute_flank(strand, *contact, nodes).profile
    tooth = Tooth(strand, flank, teeth, relief)
    try:
        return [], tooth, tooth_limits(tooth, pitch)
    except GeometryError as error:
        return [], tooth, [str(error)]


def _default_offset(
    case: ChainRecord, table: SprocketTable, chain: Chain, centrode: float, contact: tuple[float, float]
) -> float | None:
    if not 1.0 < contact_ratio(*contact, chain.pitch) < 2.0:
        # The range is at fault and will be named; any offset serves until then.
        return 0.1 * centrode
    try:
        smallest = smallest_offset(centrode, 0.5 * chain.roller_diameter, *contact)
    except GeometryError as error:
        case.faults.add("sprocket.teeth", f"{error}{_remedy(table, chain, contact)}")
        return None
    offset = float(f"{OFFSET_RESERVE * smallest:.4g}")
    case.take("sprocket.evolute_offset_mm", offset, "1.05 of the smallest that the roller clears")
    return offset


def _remedy(table: SprocketTable, chain: Chain, contact: tuple[float, float]) -> str:
    radius = 0.5 * chain.roller_diameter
    return remedy(chain.pitch, radius, table.teeth, table.engaged_every, *contact)


def _relief(table: SprocketTable, chain: Chain) -> float:
    return 0.0 if table.back_flank == "mirrored" else RELIEF_PER_PITCH * chain.pitch


def points_tooth(
    case: ChainRecord, table: SprocketTable, chain: Chain, centrode: float, nodes: int
) -> tuple[Tooth, float, float] | None:
    """Complete a tooth around a flank given by points."""
    faults = case.faults
    if table.points_file is None or table.evolute_offset_mm is None:
        faults.add("sprocket.evolute_offset_mm", "profile = 'points' on a strand needs this key")
        return None
    points = read_flank_points(case.path(table.points_file), "sprocket.points_file", faults)
    noise = table.points_noise_mm
    if noise is None:
        noise = POINTS_NOISE
        case.take("sprocket.points_noise_mm", noise, "error of the points, sets the smoothing")
    if points is None:
        return None
    strand = Strand(centrode, 0.5 * chain.roller_diameter, table.evolute_offset_mm)
    try:
        flank = working_side(flank_from_points(*points, noise, nodes))
        reached = contact_range(flank, strand.height, strand.roller_radius)
        rotation = gap_rotation(flank, strand)
    except GeometryError as error:
        faults.add("sprocket.points_file", str(error))
        return None
    end, start = table.contact_end_mm, table.contact_start_mm
    if end is None:
        end = float(f"{reached[0]:.6g}")
        case.take("sprocket.contact_end_mm", end, "where the roller touches the root end of the flank")
    if start is None:
        start = float(f"{reached[1]:.6g}")
        case.take("sprocket.contact_start_mm", start, "where the roller touches the tip end of the flank")
    ratio = contact_ratio(end, start, chain.pitch)
    if not 1.0 < ratio < 2.0:
        faults.add(
            "sprocket.contact_start_mm" if table.contact_start_mm else "sprocket.points_file",
            "contact ratio (contact_start - contact_end) / pitch must lie between 1 and 2, is "
            f"{ratio:.4g}: give a longer flank, or contact_start_mm = {end + 1.05 * chain.pitch:.6g}",
        )
        return None
    if abs(rotation) > _PHASE_TOLERANCE:
        case.warnings.append(
            f"the points are rotated by {math.degrees(rotation):.3g} degrees from a gap centred on +y; they "
            "are rotated back to build the tooth"
        )
        flank = flank.rotated(-rotation)
    _check_reach(case, (end, start), reached, 0.01 * chain.pitch)
    case.assumptions.append(
        f"the flank is a quintic smoothing spline through the points, whose error is assumed as {noise:g} "
        "mm; whether the flank is conjugate to the roller is not checked"
    )
    if "back_flank" not in table.model_fields_set:
        case.take("sprocket.back_flank", table.back_flank, "default")
    tooth = Tooth(strand, flank, table.teeth, _relief(table, chain))
    _warn_of_points(case, tooth, noise)
    return tooth, end, start


def _check_reach(
    case: ChainRecord, contact: tuple[float, float], reached: tuple[float, float], tolerance: float
) -> None:
    """Add a fault where the range of contact goes on past an end of the flank."""
    (end, start), (root, tip) = contact, reached
    if end < root - tolerance:
        case.faults.add(
            "sprocket.contact_end_mm",
            f"the roller touches the root end of the flank at {root:.6g} mm: give at least that (got "
            f"{end:g})",
        )
    if start > tip + tolerance:
        case.faults.add(
            "sprocket.contact_start_mm",
            f"the roller touches the tip end of the flank at {tip:.6g} mm: give at most that (got {start:g})",
        )


def _warn_of_points(case: ChainRecord, tooth: Tooth, noise: float) -> None:
    """Warn where a drawn or measured tooth is thin or cut; it may be what the user has."""
    try:
        cut = tooth.cut_depth()
    except GeometryError as error:
        case.warnings.append(str(error))
        return
    if cut > CUT_TOLERANCE + 3.0 * noise:
        case.warnings.append(f"the roller cuts {cut:.3g} mm off the tooth of the points on its way in or out")


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
        f"the corners of the keyway must stay inside the {around}, but lie on {2.0 * hub.bore_reach:.5g} mm "
        f"(got {hub.keyway_depth:g}): give a smaller bore or keyway"
    )
