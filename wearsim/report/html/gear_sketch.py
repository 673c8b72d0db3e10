"""A gear pair to scale."""

import math

import numpy as np

from wearsim.mechanisms.gear_pair.drive import GearDrive
from wearsim.report.html.sketch import Label, Sketch, Stroke, around, circle, line, scaled, turn_arrow


def gear_sketch(drive: GearDrive) -> Sketch:
    """Return pitch and tip circles of both gears, and the path of contact."""
    circles, mesh = drive.pair.circles, drive.pair.mesh(drive.points)
    centre, (pinion, wheel) = circles.centre_distance, drive.pair.teeth
    tips = [float(np.hypot(side.x[-1], side.y[-1])) for side in (mesh.flank, mesh.mate)]
    angle = np.arccos(mesh.lever / circles.pinion_radius)
    along, across = mesh.pole_distance * np.cos(angle), mesh.pole_distance * np.sin(angle)
    strokes = (
        Stroke("worn", circle(0.0, 0.0, tips[0])),
        Stroke("tip", circle(centre, 0.0, tips[1])),
        Stroke("pitch", circle(0.0, 0.0, circles.pinion_radius)),
        Stroke("pitch", circle(centre, 0.0, circles.wheel_radius)),
        Stroke("contact", line(np.column_stack([circles.pinion_radius + across, -along])[::4])),
        Stroke("arrow", turn_arrow(0.0, 0.0, 0.3 * circles.pinion_radius, 1)),
        Stroke("arrow", turn_arrow(centre, 0.0, 0.3 * circles.pinion_radius, -1)),
    )
    box = around([(0.0, 0.0, tips[0]), (centre, 0.0, tips[1])])
    below = 0.55 * circles.pinion_radius
    labels = (Label(0.0, below, f"pinion {pinion}"), Label(centre, below, f"wheel {wheel}"))
    alt = (
        f"Tip and pitch circles of a pinion of {pinion} teeth and a wheel of {wheel} teeth to scale, "
        f"{centre:.1f} mm apart, with the path of contact through the pole."
    )
    ratio = f"{mesh.contact_ratio:.3g}"
    notes = (
        f"pinion {pinion} teeth, wheel {wheel} teeth, centre distance {centre:.2f} mm",
        f"pitch circles {2 * circles.pinion_radius:.2f} and {2 * circles.wheel_radius:.2f} mm "
        f"(dash-dotted), tip circles {2 * tips[0]:.2f} and {2 * tips[1]:.2f} mm",
        f"thick: path of contact, contact ratio {ratio}, pressure angle in the pole "
        f"{math.degrees(drive.pair.pole_angle):.2f} degrees",
        "a pair of gears has no wrap",
    )
    return scaled(Sketch(box, 0.0, strokes, labels, alt, notes))
