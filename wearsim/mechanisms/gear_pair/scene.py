"""A gear pair as it is drawn: pinion and wheel new and worn, and both to scale."""

import math
from collections.abc import Mapping

import numpy as np

from wearsim.geometry.gear.involute import InvolutePair
from wearsim.geometry.gear.involute_function import involute_function
from wearsim.geometry.gear.mesh import ToothPair
from wearsim.geometry.outline import rotated
from wearsim.geometry.outline_stretch import OutlineStretch, along_points, up_to
from wearsim.geometry.profile_points import Vector
from wearsim.geometry.scene import Circle, Label, Scene, around, letter_height, line, turn_arrow
from wearsim.geometry.wheel_outline import ToothSpace, WheelShape, worn_space

_FLANKS_ONLY = (
    "flanks from the start of contact to the tip: the case gives no root, so the outline is open",
    "all teeth worn alike, the driving side only",
)
_ROOTED = (
    "root: radial line and arc down to 0.25 module below the foot; assumed, as the case gives none; it has "
    "no contact",
    "all teeth worn alike, the driving side only",
)


def gear_wheels(
    pair: ToothPair, points: int, face_width: float, last: Mapping[str, Vector] | None
) -> tuple[WheelShape, WheelShape]:
    """Return pinion and wheel at their centre distance, in contact at the pitch point.

    They are worn to the last snapshot of a run where there is one.
    """
    mesh, circles = pair.mesh(points), pair.circles
    shapes = []
    for gear, flank in enumerate((mesh.flank, mesh.mate)):
        radius = (circles.pinion_radius, circles.wheel_radius)[gear]
        count = pair.teeth[gear]
        turn = 0.5 * math.pi + math.pi / count - _tooth_centre(pair, gear)
        fresh = rotated(np.column_stack([flank.x, flank.y]), turn)
        new = _space(pair, gear, fresh)
        gone: tuple[ToothSpace, ...] = ()
        if last is not None:
            gone = (_worn(new, fresh, rotated(_worn_points(last, gear), turn)),) * count
        pitch_point = _angle_at(fresh, radius)
        shapes.append(
            WheelShape(
                name=("pinion", "wheel")[gear],
                new=(new,) * count,
                worn=gone,
                pitch_radius=radius,
                width=face_width,
                notes=_ROOTED if new.rooted else _FLANKS_ONLY,
                turn=(0.5 * math.pi, -0.5 * math.pi)[gear] - pitch_point,
                centre=(0.0, gear * circles.centre_distance),
            )
        )
    return shapes[0], shapes[1]


def _worn_points(last: Mapping[str, Vector], gear: int) -> Vector:
    """Points of the worn flank from root to tip."""
    if gear == 0:
        return np.column_stack([last["x_mm"], last["y_mm"]])
    return np.column_stack([last["wheel_x_mm"], last["wheel_y_mm"]])[::-1]


def _tooth_centre(pair: ToothPair, gear: int) -> float:
    """Polar angle of the centre line of the tooth, in the frame of the flank's points."""
    count = pair.teeth[gear]
    if isinstance(pair, InvolutePair):
        shift, angle = pair.profile_shift[gear], pair.pressure_angle
        half = (0.5 * math.pi + 2.0 * shift * math.tan(angle)) / count
        return 0.5 * math.pi + float(involute_function(angle)) + half
    return (0.5 * math.pi, -0.5 * math.pi)[gear] + 0.5 * math.pi / count


def _angle_at(points: Vector, radius: float) -> float:
    """Polar angle at which a flank crosses a circle."""
    angle = np.unwrap(np.arctan2(points[:, 1], points[:, 0]))
    return float(np.interp(radius, np.hypot(*points.T), angle))


def _space(pair: ToothPair, gear: int, points: Vector) -> ToothSpace:
    """Space whose left side is a flank by its points, with a root where the tool makes one."""
    flank = along_points("flank", points)
    if isinstance(pair, InvolutePair):
        return ToothSpace((flank.mirrored("back_flank"),), (flank,), rooted=False)
    # The other forms need scipy.
    from wearsim.geometry.gear.convex_concave import ConvexConcave
    from wearsim.geometry.gear.convex_concave_outline import half_tooth

    if not isinstance(pair, ConvexConcave):
        return ToothSpace((flank.mirrored("back_flank"),), (flank,), rooted=False)
    body = (pair.pinion, pair.wheel)[gear]
    vertices, bulges, foot = half_tooth(body, None, "radial")
    vertices = rotated(vertices, -math.pi / body.teeth)
    right = (
        OutlineStretch("back_flank", vertices[: foot + 1], bulges[:foot], is_curve=True),
        OutlineStretch("root", vertices[foot:], bulges[foot:]),
    )
    return ToothSpace(right, (right[1].mirrored("root"), right[0].mirrored("flank")))


def _worn(new: ToothSpace, fresh: Vector, points: Vector) -> ToothSpace:
    """Space with a worn flank; below where contact starts a whole outline is not worn."""
    if not new.rooted:
        return worn_space(new, points)
    root, flank = new.left
    below = up_to(flank, fresh[0])
    return worn_space(ToothSpace(new.right, (root, below, along_points("flank", fresh))), points)


def gear_scene(pair: ToothPair, points: int) -> Scene:
    """Return pitch and tip circles of both gears, and the path of contact."""
    circles, mesh = pair.circles, pair.mesh(points)
    middle, (pinion, wheel) = circles.centre_distance, pair.teeth
    centres = ((0.0, 0.0), (middle, 0.0))
    radii = (circles.pinion_radius, circles.wheel_radius)
    tips = [math.hypot(side.x[-1], side.y[-1]) for side in (mesh.flank, mesh.mate)]
    angle = np.arccos(mesh.lever / radii[0])
    along, across = mesh.pitch_point_distance * np.cos(angle), mesh.pitch_point_distance * np.sin(angle)
    box = around(zip(centres, tips, strict=True))
    names = (f"pinion {pinion}", f"wheel {wheel}")
    return Scene(
        box,
        (
            Circle("worn", centres[0], tips[0]),
            Circle("tip", centres[1], tips[1]),
            *(Circle("pitch", centre, radius) for centre, radius in zip(centres, radii, strict=True)),
            line("contact", np.column_stack([radii[0] + across, -along])[::4]),
            *(
                stroke
                for centre, sense in zip(centres, (1, -1), strict=True)
                for stroke in turn_arrow(centre, 0.3 * radii[0], sense)
            ),
            *(
                Label("text", name, (x, y - 0.55 * radii[0]), letter_height(box))
                for name, (x, y) in zip(names, centres, strict=True)
            ),
        ),
        f"Tip and pitch circles of a pinion of {pinion} teeth and a wheel of {wheel} teeth to scale, "
        f"{middle:.1f} mm apart, with the path of contact through the pitch point.",
        (
            f"pinion {pinion} teeth, wheel {wheel} teeth, centre distance {middle:.2f} mm",
            f"pitch circles {2 * radii[0]:.2f} and {2 * radii[1]:.2f} mm "
            f"(dash-dotted), tip circles {2 * tips[0]:.2f} and {2 * tips[1]:.2f} mm",
            f"thick: path of contact, contact ratio {mesh.contact_ratio:.3g}, pressure angle at the "
            f"pitch point {math.degrees(pair.pitch_point_angle):.2f} degrees",
            "a pair of gears has no wrap",
        ),
    ).with_scale()
