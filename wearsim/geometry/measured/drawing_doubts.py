"""What is doubtful about a drawn outline: rounded coordinates, gaps that differ, teeth off their axis.

A roller of diameter d1 lies in its seat with a clearance of about 0.005 d1, 0.04 mm on a half-inch chain.
Where in the seat it rests, and so the pressure angle and the share of every tooth, follows from differences
that are small against that: on 20 teeth, 0.002 mm changed the force of the first one by up to 2 %, 0.01 mm by
10 %, 0.07 mm by 30 %.
"""

import math

import numpy as np
import shapely

from wearsim.errors import GeometryError
from wearsim.geometry.measured.wheel_gaps import Gap, agreement
from wearsim.geometry.profile_points import Vector

EFFECT = (
    "0.01 mm can change the force of the first tooth by 10 %, 0.07 mm by 30 %; give it more exactly, with "
    "coordinates of 0.001 mm or finer"
)
"""What such doubts mean for the answer, and what to do."""

ALIKE = 2e-3
"""Difference in shape [mm] up to which nothing is said: 2 % of the force of the first tooth."""

EVEN = 1e-2
"""Error of spacing [mm] up to which nothing is said: it acts as an elongation, on half an inch of 0.08 %."""

ROUND = 0.075
"""Difference [mm] above which there is no round wheel of equal gaps.

Half of the least run-out that ISO 606 allows the root circle of a made wheel, 0.15 mm.
"""

OFF_CENTRE = 1e-3
"""Distance of a wheel's centre from the origin [mm] that is taken as none."""

_ROUNDED = 1e-6
"""Part of a step by which a rounded coordinate may lie off it in the file."""

_CIRCLE = 1e-3
"""Part of a radius by which a bore may differ from a circle."""


def rounding_step(points: Vector, unit: float) -> float:
    """Return the step [mm] of which all coordinates are multiples, 0 where that is below 0.002 mm.

    Examples
    --------
    >>> rounding_step(np.array([[1.25, 0.5], [-0.75, 3.0]]), 1.0)
    0.25
    >>> rounding_step(np.array([[1.234567, 0.5], [-0.75, 3.0]]), 1.0)
    0.0
    """
    step = 1.0
    while step * unit > ALIKE:
        steps = points / (unit * step)
        if (np.abs(steps - steps.round()) < _ROUNDED).all():
            return float(np.gcd.reduce(steps.round().astype(int), axis=None)) * step * unit
        step /= 10.0
    return 0.0


def rounding_text(step: float) -> str:
    """Return what is doubtful about coordinates that are multiples of a step [mm]."""
    return (
        f"all coordinates of the outline are multiples of {step:.4g} mm: if they were rounded to that, "
        f"points lie up to {step / math.sqrt(2.0):.2g} mm off"
    )


def gaps_text(gaps: list[Gap], taken: Gap, doubts: list[str]) -> str:
    """Return how far gaps differ from their mean; it is a doubt too where it matters.

    Raises
    ------
    GeometryError
        They differ by more than made wheels do.
    """
    found = agreement(gaps, taken)
    shape, spacing = (round(float(np.abs(values).max()), 6) for values in (found.shape, found.spacing))
    worst = gaps[int(found.shape.argmax() if shape >= spacing else np.abs(found.spacing).argmax())]
    differ = (
        f"the {len(gaps)} gaps differ from their mean by up to {shape:.2g} mm in shape and {spacing:.2g} mm "
        "in spacing at the tips"
    )
    where = f"most the one {degrees(worst.angle):g} degrees from +y"
    if max(shape, spacing) > ROUND:
        raise GeometryError(
            f"the gaps of the wheel must be alike within {ROUND:g} mm, but {differ}, {where}: only round "
            "wheels of equal gaps are computed; correct the drawing, or draw one gap alone"
        )
    if shape > ALIKE or spacing > EVEN:
        doubts.append(f"{differ}, {where}, but it is computed as a round wheel of the gap nearest +y")
    return f"{differ}; the one drawn {degrees(taken.angle):g} degrees from +y is taken"


def eccentric(centre: Vector, root: float, others: list[Vector]) -> str:
    """Return a warning that teeth are drawn off their axis, nothing where they are not.

    The axis is the middle of the smallest circle drawn around the centre, else the origin where that lies
    within the root circle.

    Raises
    ------
    GeometryError
        The bore is farther off than made wheels run out.
    """
    bore = _bore(centre, root, others)
    axis = np.zeros(2) if bore is None else bore
    off = math.dist(axis, centre)
    if off <= OFF_CENTRE or (bore is None and off >= root):
        return ""
    name = "the bore" if bore is not None else "the origin"
    where = f"the teeth are drawn about ({centre[0]:.6g}, {centre[1]:.6g}) mm, {off:.3g} mm from {name}"
    if bore is not None and off > ROUND:
        raise GeometryError(
            f"the teeth must run round about their bore within {ROUND:g} mm, but {where}: only round wheels "
            "are computed; correct the drawing, or draw one gap alone"
        )
    return f"{where}: computed as if they ran round about their own centre"


def _bore(centre: Vector, root: float, others: list[Vector]) -> Vector | None:
    """Middle of the smallest circle inside the root circle that is drawn around a wheel's centre."""
    middle = shapely.Point(*centre)
    for ring in sorted(others, key=lambda ring: float(shapely.Polygon(ring).area)):
        at = np.array(shapely.Polygon(ring).centroid.coords[0])
        radius = np.hypot(*(ring - at).T)
        is_circle = np.ptp(radius) <= _CIRCLE * radius.max() < _CIRCLE * root
        if is_circle and shapely.Polygon(ring).contains(middle):
            return at
    return None


def degrees(angle: float) -> float:
    """Return an angle [rad] in degrees as it is told."""
    return round(math.degrees(angle), 4) + 0.0
