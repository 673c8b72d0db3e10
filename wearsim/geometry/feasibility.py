"""Can this flank exist and run: the limits of physics and the values that satisfy them."""

import math
from functools import lru_cache

import numpy as np

from wearsim.errors import GeometryError
from wearsim.geometry.forms.evolute import Strand, contact_ratio, evolute_flank
from wearsim.geometry.tooth import CUT_TOLERANCE, RELIEF_PER_PITCH, Tooth, cut_depth, sweep_path

THINNEST_PER_PITCH = 0.05
"""Least neck and tip land, as a fraction of the pitch; this project's choice."""

OFFSET_RESERVE = 1.05
"""Factor on the smallest evolute offset that the roller clears, for the default."""

MAX_TEETH = 150


def exit_cut(strand: Strand, contact_end: float, contact_start: float) -> float:
    """Return how deep the leaving roller cuts the flank that drove it."""
    points = strand.conjugate_points(np.linspace(contact_end, contact_start, 200))
    path = sweep_path(strand, math.hypot(*points[-1]), -1.0)
    return cut_depth(points, path, strand.roller_radius)


@lru_cache(maxsize=32)
def smallest_offset(
    centrode_radius: float, roller_radius: float, contact_end: float, contact_start: float
) -> float:
    """Return the smallest evolute offset whose flank the leaving roller clears."""

    def _is_cut(offset: float) -> bool:
        strand = Strand(centrode_radius, roller_radius, offset)
        return exit_cut(strand, contact_end, contact_start) > CUT_TOLERANCE

    low, high = 1e-3 * centrode_radius, 0.5 * centrode_radius
    if _is_cut(high):
        raise GeometryError(
            f"exit clearance: no evolute offset up to {high:.4g} mm lets the roller leave a flank "
            f"that reaches {contact_start:.4g} mm before the line of the pitch point"
        )
    while high - low > 1e-5 * high:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _is_cut(middle) else (low, middle)
    digits = 3 - math.floor(math.log10(high))
    scale = 10.0**digits
    return math.ceil(high * scale) / scale


def evolute_limits(
    strand: Strand, contact_end: float, contact_start: float, pitch: float
) -> list[tuple[str, str]]:
    """Return what keeps an evolute flank from running on a strand."""
    if contact_end <= 0.0:
        message = (
            f"contact_end must be above 0 (the flank ends before the line of the pitch point), is "
            f"{contact_end:g} mm: {0.16 * pitch:.4g} mm will do"
        )
        return [("contact_end", message)]
    ratio = contact_ratio(contact_end, contact_start, pitch)
    if not 1.0 < ratio < 2.0:
        message = (
            "contact ratio (contact_start - contact_end) / pitch must lie between 1 and 2, is "
            f"{ratio:.4g}: contact_start_mm = {contact_end + 1.05 * pitch:.6g} gives 1.05"
        )
        return [("contact_start", message)]
    if not strand.offset < strand.centrode_radius:
        message = (
            f"evolute_offset must be below the centrode radius {strand.centrode_radius:.4g} mm, is "
            f"{strand.offset:g} mm"
        )
        return [("evolute_offset", message)]
    cut = exit_cut(strand, contact_end, contact_start)
    if cut <= CUT_TOLERANCE:
        return []
    message = (
        f"exit clearance: the leaving roller must clear the flank, but cuts {cut:.3g} mm off it at "
        f"evolute_offset_mm = {strand.offset:g}"
    )
    try:
        needed = smallest_offset(strand.centrode_radius, strand.roller_radius, contact_end, contact_start)
    except GeometryError as error:
        return [("evolute_offset", f"{message}; {error}")]
    return [("evolute_offset", f"{message}: at least evolute_offset_mm = {needed:.4g}")]


def tooth_limits(tooth: Tooth, pitch: float) -> list[str]:
    """Return what keeps a tooth from standing or its gap from clearing the roller."""
    least = THINNEST_PER_PITCH * pitch
    for name, value in (("neck thickness", tooth.neck), ("tip land", tooth.tip_land)):
        if value < least:
            return [f"{name} of the tooth must be at least {least:.3g} mm (0.05 pitch), is {value:.3g} mm"]
    cut = tooth.cut_depth()
    if cut > CUT_TOLERANCE:
        return [
            f"sweep: the roller must clear the gap on its way in and out, but cuts {cut:.3g} mm off "
            "the outline: use a larger evolute_offset_mm or a relieved back flank"
        ]
    return []


def feasible_offset(
    pitch: float,
    roller_radius: float,
    teeth: int,
    engaged_every: int,
    contact_end: float,
    contact_start: float,
) -> float | None:
    """Return an evolute offset with which a tooth stands and runs, with a reserve of 5 %."""
    centrode = pitch * teeth / (2.0 * math.pi * engaged_every)
    try:
        smallest = smallest_offset(centrode, roller_radius, contact_end, contact_start)
        offset = float(f"{OFFSET_RESERVE * smallest:.4g}")
        strand = Strand(centrode, roller_radius, offset)
        flank = evolute_flank(strand, contact_end, contact_start, 101).profile
        limits = tooth_limits(Tooth(strand, flank, teeth, RELIEF_PER_PITCH * pitch), pitch)
    except GeometryError:
        return None
    return None if limits else offset


def remedy(
    pitch: float,
    roller_radius: float,
    teeth: int,
    engaged_every: int,
    contact_end: float,
    contact_start: float,
) -> str:
    """Return what makes an infeasible tooth feasible: an offset, else a number of teeth."""

    def _offset(gaps: int) -> float | None:
        return feasible_offset(pitch, roller_radius, gaps, engaged_every, contact_end, contact_start)

    offset = _offset(teeth)
    if offset is not None:
        return f"; evolute_offset_mm = {offset:.4g} will do"
    for more in range(teeth + 1, MAX_TEETH + 1):
        if _offset(more) is not None:
            return f"; teeth = {more} will do with the default offset, or try a shorter contact range"
    return "; try a shorter contact range or a smaller roller"
