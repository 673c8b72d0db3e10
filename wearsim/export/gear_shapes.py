"""Pinion and wheel of a gear pair, new and worn, as outlines for CAD."""

import math

import numpy as np

from wearsim.export.wheel_states import WheelShape
from wearsim.geometry.gear.involute import InvolutePair
from wearsim.geometry.gear.involute_function import involute_function
from wearsim.geometry.outline import turned
from wearsim.geometry.profile import Vector
from wearsim.geometry.stretch import Stretch, along_points, up_to
from wearsim.geometry.wheel import Space, worn_space
from wearsim.mechanisms.gear_pair.drive import GearDrive
from wearsim.report.flank_view import flanks
from wearsim.result import WearResult

_FLANKS_ONLY = (
    "flanks from where contact starts to the tip: the case tells no root, so the outline is open",
    "all teeth worn alike, the driving side only",
)
_ROOTED = (
    "root: radial line and arc down to 0.25 module below the foot; the case tells none, and it does "
    "not touch",
    "all teeth worn alike, the driving side only",
)


def gear_shapes(drive: GearDrive, result: WearResult | None) -> tuple[WheelShape, WheelShape]:
    """Return pinion and wheel at their centre distance, in contact in the pole."""
    mesh, circles = drive.pair.mesh(drive.points), drive.pair.circles
    worn = flanks(result, -1) if result is not None else None
    shapes = []
    for gear, flank in enumerate((mesh.flank, mesh.mate)):
        points = np.column_stack([flank.x, flank.y])
        radius = (circles.pinion_radius, circles.wheel_radius)[gear]
        count = drive.pair.teeth[gear]
        turn = 0.5 * math.pi + math.pi / count - _tooth_centre(drive, gear)
        fresh = turned(points, turn)
        new = _space(drive, gear, fresh)
        gone: tuple[Space, ...] = ()
        if worn is not None:
            gone = (_worn(new, fresh, turned(_worn_points(worn, gear), turn)),) * count
        pole = _angle_at(fresh, radius)
        shapes.append(
            WheelShape(
                name=("pinion", "wheel")[gear],
                new=(new,) * count,
                worn=gone,
                pitch_radius=radius,
                width=drive.face_width,
                notes=_ROOTED if new.rooted else _FLANKS_ONLY,
                turn=(0.5 * math.pi, -0.5 * math.pi)[gear] - pole,
                centre=(0.0, gear * circles.centre_distance),
            )
        )
    return shapes[0], shapes[1]


def _worn_points(last: dict[str, Vector], gear: int) -> Vector:
    """Points of the worn flank from root to tip."""
    if gear == 0:
        return np.column_stack([last["x_mm"], last["y_mm"]])
    return np.column_stack([last["wheel_x_mm"], last["wheel_y_mm"]])[::-1]


def _tooth_centre(drive: GearDrive, gear: int) -> float:
    """Polar angle of the centre line of the tooth, in the frame of the flank's points."""
    pair, count = drive.pair, drive.pair.teeth[gear]
    if isinstance(pair, InvolutePair):
        shift, angle = pair.profile_shift[gear], pair.pressure_angle
        half = (0.5 * math.pi + 2.0 * shift * math.tan(angle)) / count
        return 0.5 * math.pi + float(involute_function(angle)) + half
    return (0.5 * math.pi, -0.5 * math.pi)[gear] + 0.5 * math.pi / count


def _angle_at(points: Vector, radius: float) -> float:
    """Polar angle at which a flank crosses a circle."""
    angle = np.unwrap(np.arctan2(points[:, 1], points[:, 0]))
    return float(np.interp(radius, np.hypot(*points.T), angle))


def _space(drive: GearDrive, gear: int, points: Vector) -> Space:
    """Space whose left side is a flank by its points, with a root where the tool makes one."""
    flank = along_points("flank", points)
    if isinstance(drive.pair, InvolutePair):
        return Space((flank.mirrored("back_flank"),), (flank,), rooted=False)
    # The other forms need scipy.
    from wearsim.geometry.gear.convex_concave import ConvexConcave
    from wearsim.geometry.gear.convex_concave_outline import half_tooth

    if not isinstance(drive.pair, ConvexConcave):
        return Space((flank.mirrored("back_flank"),), (flank,), rooted=False)
    body = (drive.pair.pinion, drive.pair.wheel)[gear]
    vertices, bulges, foot = half_tooth(body, None, "radial")
    vertices = turned(vertices, -math.pi / body.teeth)
    right = (
        Stretch("back_flank", vertices[: foot + 1], bulges[:foot], is_curve=True),
        Stretch("root", vertices[foot:], bulges[foot:]),
    )
    return Space(right, (right[1].mirrored("root"), right[0].mirrored("flank")))


def _worn(new: Space, fresh: Vector, points: Vector) -> Space:
    """Space with a worn flank; below where contact starts a whole outline is not worn."""
    if not new.rooted:
        return worn_space(new, points)
    root, flank = new.left
    below = up_to(flank, fresh[0])
    return worn_space(Space(new.right, (root, below, along_points("flank", fresh))), points)
