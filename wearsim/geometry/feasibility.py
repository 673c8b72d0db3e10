"""Can this flank exist and run: the limits of physics and the values that satisfy them."""

import math

import numpy as np

from wearsim.errors import GeometryError
from wearsim.geometry.evolute import Strand, contact_ratio, evolute_flank
from wearsim.geometry.tooth import CUT_TOLERANCE, RELIEF_PER_PITCH, Tooth, cut_depth, sweep_path

THINNEST_PER_PITCH = 0.05
"""Least neck and tip land, as a fraction of the pitch; this project's choice."""

MOST_TEETH = 150


def exit_cut(strand: Strand, contact_end: float, contact_start: float) -> float:
    """Return how deep the leaving roller cuts the flank that drove it.

    Parameters
    ----------
    strand : Strand
        Sprocket and line of roller centres.
    contact_end, contact_start : float
        Range of contact x_min, x_max [mm].

    Returns
    -------
    float
        Depth [mm]; negative where the roller clears the flank.
    """
    points = strand.conjugate_points(np.linspace(contact_end, contact_start, 200))
    path = sweep_path(strand, math.hypot(*points[-1]), -1.0)
    return cut_depth(points, path, strand.roller_radius)


def smallest_offset(
    centrode_radius: float, roller_radius: float, contact_end: float, contact_start: float
) -> float:
    """Return the smallest evolute offset whose flank the leaving roller clears.

    Parameters
    ----------
    centrode_radius, roller_radius : float
        R and r [mm].
    contact_end, contact_start : float
        Range of contact x_min, x_max [mm].

    Returns
    -------
    float
        Offset h [mm], rounded up to four digits; about 3 p (eps + x_min/p)^2 / z.

    Raises
    ------
    GeometryError
        No offset below half the centrode radius is enough.
    """

    def _is_cut(offset: float) -> bool:
        strand = Strand(centrode_radius, roller_radius, offset)
        return exit_cut(strand, contact_end, contact_start) > CUT_TOLERANCE

    low, high = 1e-3 * centrode_radius, 0.5 * centrode_radius
    if _is_cut(high):
        raise GeometryError(
            f"exit clearance: no evolute offset up to {high:.4g} mm lets the roller leave a flank "
            f"that reaches {contact_start:.4g} mm before the pole line: use more teeth or a smaller "
            "contact_start_mm"
        )
    while high - low > 1e-5 * high:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _is_cut(middle) else (low, middle)
    digits = 3 - math.floor(math.log10(high))
    scale = 10.0**digits
    return math.ceil(high * scale) / scale


def evolute_limits(
    strand: Strand, contact_end: float, contact_start: float, pitch: float
) -> list[str]:
    """Return what keeps an evolute flank from running on a strand, each with a remedy.

    Parameters
    ----------
    strand : Strand
        Sprocket and line of roller centres.
    contact_end, contact_start : float
        Range of contact x_min, x_max [mm].
    pitch : float
        Chain pitch [mm].

    Returns
    -------
    list of str
        One message for every limit that fails; empty for a feasible flank.
    """
    if contact_end <= 0.0:
        return [
            f"contact_end must be above 0 (the flank ends before the pole line), is {contact_end:g} "
            f"mm: {0.16 * pitch:.4g} mm will do"
        ]
    ratio = contact_ratio(contact_end, contact_start, pitch)
    if not 1.0 < ratio < 2.0:
        return [
            "contact ratio (contact_start - contact_end) / pitch must lie between 1 and 2, is "
            f"{ratio:.4g}: contact_start_mm = {contact_end + 1.05 * pitch:.6g} gives 1.05"
        ]
    if not strand.offset < strand.centrode_radius:
        return [
            f"evolute_offset must be below the centrode radius {strand.centrode_radius:.4g} mm, is "
            f"{strand.offset:g} mm"
        ]
    cut = exit_cut(strand, contact_end, contact_start)
    if cut > CUT_TOLERANCE:
        try:
            needed = smallest_offset(
                strand.centrode_radius, strand.roller_radius, contact_end, contact_start
            )
        except GeometryError as error:
            return [str(error)]
        return [
            f"exit clearance: the leaving roller must clear the flank, but cuts {cut:.3g} mm off it "
            f"at evolute_offset_mm = {strand.offset:g}: at least evolute_offset_mm = {needed:.4g}"
        ]
    return []


def tooth_limits(tooth: Tooth, pitch: float) -> list[str]:
    """Return what keeps a tooth from standing or its gap from clearing the roller.

    Parameters
    ----------
    tooth : Tooth
        Tooth around a working flank.
    pitch : float
        Chain pitch [mm].

    Returns
    -------
    list of str
        One message for every limit that fails.
    """
    least = THINNEST_PER_PITCH * pitch
    for name, value in (("neck thickness", tooth.neck), ("tip land", tooth.tip_land)):
        if value < least:
            return [
                f"{name} of the tooth must be at least {least:.3g} mm (0.05 pitch), is {value:.3g} mm"
            ]
    cut = tooth.cut_depth()
    if cut > CUT_TOLERANCE:
        return [
            f"sweep: the roller must clear the gap on its way in and out, but cuts {cut:.3g} mm off "
            "the outline: use a larger evolute_offset_mm or a relieved back flank"
        ]
    return []


def enough_teeth(
    pitch: float, roller_radius: float, engaged_every: int, contact_end: float, contact_start: float
) -> int | None:
    """Return the smallest number of teeth whose evolute tooth is thick enough.

    Parameters
    ----------
    pitch, roller_radius : float
        Of the chain [mm].
    engaged_every : int
        Every which gap carries a roller.
    contact_end, contact_start : float
        Range of contact x_min, x_max [mm].

    Returns
    -------
    int or None
        Teeth with the smallest offset times 1.05; None where none up to 150 is enough.
    """
    for teeth in range(6, MOST_TEETH + 1):
        centrode = pitch * teeth / (2.0 * math.pi * engaged_every)
        try:
            offset = 1.05 * smallest_offset(centrode, roller_radius, contact_end, contact_start)
            strand = Strand(centrode, roller_radius, offset)
            flank = evolute_flank(strand, contact_end, contact_start, 101).profile
            tooth = Tooth(strand, flank, teeth, RELIEF_PER_PITCH * pitch)
            if not tooth_limits(tooth, pitch):
                return teeth
        except GeometryError:
            continue
    return None
