"""The wheel that a sprocket is cut from one plate as: its spaces, and the area that they leave."""

import numpy as np

from wearsim.geometry.gap import Gap
from wearsim.geometry.outline_stretch import along_gap, along_points, arc_through
from wearsim.geometry.profile_points import Profile, Vector
from wearsim.geometry.tooth import Tooth
from wearsim.geometry.wheel_outline import ToothSpace, ring, to_circle


def tooth_space(tooth: Tooth) -> ToothSpace:
    """Return the space beside a tooth around a working flank."""
    seat = tooth.seat[::-1]
    back = to_circle(_points(tooth.back_flank)[::-1], tooth.tip_radius)[::-1]
    return ToothSpace(
        (along_points("back_flank", back), arc_through("root", seat[0], seat[len(seat) // 2], seat[-1])),
        (along_points("flank", _points(tooth.flank)),),
    )


def gap_space(outline: Profile, gap: Gap | None) -> ToothSpace:
    """Return the space of a whole gap."""
    stretch = along_points("gap", _points(outline)) if gap is None else along_gap(gap)
    return ToothSpace((stretch,), ())


def blank_area(space: ToothSpace, teeth: int) -> float:
    """Return the area of a wheel of equal spaces, without a bore.

    Examples
    --------
    Four notches from corner to corner of a square of 2 mm take trapezia of 0.75 mm2 from it:

    >>> from wearsim.geometry.outline_stretch import OutlineStretch
    >>> notch = np.array([[1.0, 1.0], [0.5, 0.5], [-0.5, 0.5], [-1.0, 1.0]])
    >>> round(blank_area(ToothSpace((OutlineStretch("gap", notch, np.zeros(3)),), ()), 4), 12)
    1.0
    """
    (chain,) = ring((space,) * teeth)
    return chain.outline.area


def _points(profile: Profile) -> Vector:
    return np.column_stack([profile.x, profile.y])
