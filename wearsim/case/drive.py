"""What touches the flank, completed: a sprocket on a strand, or a table of loads."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from wearsim.case.model import PrescribedDrive, StrandDrive, WearInput
from wearsim.case.schema import SprocketTable
from wearsim.case.tables import read_points, read_prescribed
from wearsim.catalogue.tables import Chain
from wearsim.errors import GeometryError
from wearsim.geometry.evolute import Strand, contact_ratio, evolute_flank
from wearsim.geometry.feasibility import (
    enough_teeth,
    evolute_limits,
    smallest_offset,
    tooth_limits,
)
from wearsim.geometry.points import contact_range, flank_from_points, working_side
from wearsim.geometry.profile import Profile
from wearsim.geometry.tooth import CUT_TOLERANCE, RELIEF_PER_PITCH, Tooth

if TYPE_CHECKING:
    from wearsim.case.resolve import Resolution

CONTACT_END_PER_PITCH = 0.16
CONTACT_RATIO = 1.05
OFFSET_RESERVE = 1.05
POINTS_NOISE = 1e-4
"""Error of a flank's points assumed where none is given [mm]."""

_SAFETY = 7.0
"""Breaking load over tension below which a chain is loaded beyond its endurance."""

RECONSTRUCTION = (
    "the evolute flank and its kinematics are a reconstruction from Euler-Savary/Bobillier: the "
    "source's equations (1) to (9) are lost"
)


def resolve_strand(case: Resolution, chain: Chain) -> StrandDrive | None:
    """Complete a sprocket on a straight strand.

    Parameters
    ----------
    case : Resolution
        The case so far.
    chain : Chain
        Its chain.

    Returns
    -------
    StrandDrive or None
        None where there was a fault.
    """
    tables, faults = case.tables, case.faults
    if tables.mechanism.table_file is not None:
        faults.add("mechanism.table_file", "belongs to kind = 'prescribed': remove it")
    if tables.sprocket is None:
        faults.add("sprocket", "this table is required and missing")
        return None
    table = tables.sprocket
    centrode = chain.pitch * table.teeth / (2.0 * math.pi * table.engaged_every)
    pull = _pull(case, centrode, chain)
    face_width = _face_width(case, table, chain)
    tooth_and_range = (
        _evolute_tooth(case, table, chain, centrode)
        if table.profile == "evolute"
        else _points_tooth(case, table, chain, centrode)
    )
    if tooth_and_range is None or pull is None:
        return None
    tooth, contact_end, contact_start = tooth_and_range
    fraction = tables.mechanism.roller_slip_fraction
    return StrandDrive(tooth, contact_end, contact_start, face_width, pull, fraction)


def resolve_prescribed(case: Resolution, wear: WearInput) -> PrescribedDrive | None:
    """Complete a flank whose load and sliding come from a table.

    Parameters
    ----------
    case : Resolution
        The case so far.
    wear : WearInput
        Its wear law.

    Returns
    -------
    PrescribedDrive or None
        None where there was a fault.
    """
    tables, key = case.tables, "mechanism.table_file"
    unused = [f"load.{name}" for name in sorted(tables.load.model_fields_set - {"speed_rpm"})]
    if tables.sprocket is not None:
        used = {"engaged_every"}
        unused += [f"sprocket.{name}" for name in sorted(tables.sprocket.model_fields_set - used)]
    if unused:
        case.warnings.append(f"not used with a table of loads: {', '.join(unused)}")
    if tables.mechanism.table_file is None:
        case.faults.add(key, "kind = 'prescribed' needs the file of load and sliding")
        return None
    table = read_prescribed(case.path(key, tables.mechanism.table_file), key, case.faults)
    if table is None:
        return None
    if wear.speed_exponent != 0.0 and table.sliding_speed is None:
        case.faults.add(
            key,
            "the drozdov law needs the column sliding_speed_mm_per_s: add it or set speed_exponent 0",
        )
        return None
    if wear.pressure_exponent < 1.0 and table.slip_ratio is not None:
        case.faults.add(
            "wear.pressure_exponent",
            "must be at least 1 with a given slip ratio: below 1 a pit deepens itself and the problem "
            f"is ill-posed (got {wear.pressure_exponent:g})",
        )
        return None
    return PrescribedDrive(table, tables.mechanism.roller_slip_fraction)


def _pull(case: Resolution, centrode: float, chain: Chain) -> float | None:
    load, faults = case.tables.load, case.faults
    given = {
        "tension_N": load.tension_N,
        "power_kW": load.power_kW,
        "torque_N_m": load.torque_N_m,
    }
    keys = [key for key, value in given.items() if value is not None]
    if not keys:
        faults.add("load.tension_N", f"give exactly one of {', '.join(given)} (got none)")
        return None
    if load.tension_N is not None:
        pull = load.tension_N
    elif load.power_kW is not None:
        pull = 1e6 * load.power_kW / (2.0 * math.pi * load.speed_rpm / 60.0 * centrode)
    else:
        assert load.torque_N_m is not None
        pull = 1e3 * load.torque_N_m / centrode
    case.assumptions.append(f"pull on the flank {pull:.6g} N (slack strand without tension)")
    if chain.tensile and pull >= chain.tensile:
        faults.add(
            f"load.{keys[0]}",
            f"the pull must stay below the chain's tensile strength {chain.tensile:g} N, is {pull:.4g} N",
        )
        return None
    if chain.tensile and pull * _SAFETY > chain.tensile:
        case.warnings.append(
            f"the pull of {pull:.4g} N is more than 1/{_SAFETY:g} of the chain's tensile strength "
            f"{chain.tensile:g} N: the plates will not last"
        )
    return pull


def _face_width(case: Resolution, table: SprocketTable, chain: Chain) -> float:
    if table.face_width_mm is None:
        width = float(f"{chain.face_width:.4g}")
        case.take("sprocket.face_width_mm", width, "standard tooth width for the chain")
        return width
    if table.face_width_mm > chain.strands * chain.inner_width:
        case.faults.add(
            "sprocket.face_width_mm",
            "the tooth must fit between the inner plates, "
            f"{chain.strands * chain.inner_width:g} mm (got {table.face_width_mm:g})",
        )
    return table.face_width_mm


def _evolute_tooth(
    case: Resolution, table: SprocketTable, chain: Chain, centrode: float
) -> tuple[Tooth, float, float] | None:
    for key in ("points_file", "points_noise_mm"):
        if getattr(table, key) is not None:
            case.faults.add(f"sprocket.{key}", "belongs to profile = 'points': remove it")
    end, start, offset = table.contact_end_mm, table.contact_start_mm, table.evolute_offset_mm
    if end is None:
        end = float(f"{CONTACT_END_PER_PITCH * chain.pitch:.6g}")
        case.take("sprocket.contact_end_mm", end, "0.16 pitch")
    if start is None:
        start = float(f"{end + CONTACT_RATIO * chain.pitch:.6g}")
        case.take("sprocket.contact_start_mm", start, "contact ratio 1.05")
    radius = 0.5 * chain.roller_diameter
    if offset is None:
        if not 1.0 < contact_ratio(end, start, chain.pitch) < 2.0:
            offset = 0.1 * centrode
        else:
            try:
                needed = smallest_offset(centrode, radius, end, start)
            except GeometryError as error:
                case.faults.add("sprocket.evolute_offset_mm", str(error))
                return None
            offset = float(f"{OFFSET_RESERVE * needed:.4g}")
            case.take(
                "sprocket.evolute_offset_mm", offset, "1.05 of the smallest that the roller clears"
            )
    strand = Strand(centrode, radius, offset)
    limits = evolute_limits(strand, end, start, chain.pitch)
    if limits:
        for message in limits:
            case.faults.add(f"sprocket.{_key_of(message)}", message)
        return None
    flank = evolute_flank(strand, end, start, table.nodes).profile
    case.assumptions.append(RECONSTRUCTION)
    tooth = _checked_tooth(case, table, chain, strand, flank, (end, start))
    return (tooth, end, start) if tooth else None


def _key_of(message: str) -> str:
    """Key of the input that a geometric limit is about."""
    first = message.split(" ", 1)[0]
    return {"contact_end": "contact_end_mm", "contact": "contact_start_mm"}.get(
        first, "evolute_offset_mm"
    )


def _checked_tooth(
    case: Resolution,
    table: SprocketTable,
    chain: Chain,
    strand: Strand,
    flank: Profile,
    contact: tuple[float, float],
) -> Tooth | None:
    relief = 0.0 if table.back_flank == "mirrored" else RELIEF_PER_PITCH * chain.pitch
    tooth = Tooth(strand, flank, table.teeth, relief)
    try:
        limits = tooth_limits(tooth, chain.pitch)
    except GeometryError as error:
        limits = [str(error)]
    if not limits:
        return tooth
    teeth = enough_teeth(chain.pitch, strand.roller_radius, table.engaged_every, *contact)
    remedy = (
        f"; teeth = {teeth} will do with the default offset"
        if teeth is not None and teeth > table.teeth
        else ""
    )
    for message in limits:
        case.faults.add("sprocket.teeth", f"{message}{remedy}")
    return None


def _points_tooth(
    case: Resolution, table: SprocketTable, chain: Chain, centrode: float
) -> tuple[Tooth, float, float] | None:
    faults = case.faults
    for key in ("points_file", "evolute_offset_mm"):
        if getattr(table, key) is None:
            faults.add(f"sprocket.{key}", "profile = 'points' needs this key")
    if table.points_file is None or table.evolute_offset_mm is None:
        return None
    points = read_points(
        case.path("sprocket.points_file", table.points_file), "sprocket.points_file", faults
    )
    noise = table.points_noise_mm
    if noise is None:
        noise = POINTS_NOISE
        case.take("sprocket.points_noise_mm", noise, "error of the points, sets the smoothing")
    if points is None:
        return None
    strand = Strand(centrode, 0.5 * chain.roller_diameter, table.evolute_offset_mm)
    try:
        flank = working_side(flank_from_points(*points, noise, table.nodes))
        reached = contact_range(flank, strand.height, strand.roller_radius)
    except GeometryError as error:
        faults.add("sprocket.points_file", str(error))
        return None
    end, start = table.contact_end_mm, table.contact_start_mm
    if end is None:
        end = float(f"{reached[0]:.6g}")
        case.take("sprocket.contact_end_mm", end, "where the flank's root end is touched")
    if start is None:
        start = float(f"{reached[1]:.6g}")
        case.take("sprocket.contact_start_mm", start, "where the flank's tip end is touched")
    ratio = contact_ratio(end, start, chain.pitch)
    if not 1.0 < ratio < 2.0:
        faults.add(
            "sprocket.contact_start_mm" if table.contact_start_mm else "sprocket.points_file",
            "contact ratio (contact_start - contact_end) / pitch must lie between 1 and 2, is "
            f"{ratio:.4g}: a longer flank, or contact_start_mm = {end + 1.05 * chain.pitch:.6g}",
        )
        return None
    case.assumptions.append(
        "the flank is a quintic smoothing spline through the points, their error taken as "
        f"{noise:g} mm; no check that the flank is conjugate to the roller"
    )
    relief = 0.0 if table.back_flank == "mirrored" else RELIEF_PER_PITCH * chain.pitch
    tooth = Tooth(strand, flank, table.teeth, relief)
    _doubt_points(case, tooth, noise)
    return tooth, end, start


def _doubt_points(case: Resolution, tooth: Tooth, noise: float) -> None:
    """Warn where a drawn or measured tooth is thin or cut; it may be what the user has."""
    try:
        cut = tooth.cut_depth()
    except GeometryError as error:
        case.warnings.append(str(error))
        return
    if cut > CUT_TOLERANCE + 3.0 * noise:
        case.warnings.append(
            f"the roller cuts {cut:.3g} mm off the tooth of the points on its way in or out"
        )
