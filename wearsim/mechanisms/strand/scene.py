"""A sprocket on a straight strand as it is drawn: its wheel new and worn, and the drive to scale."""

import math
from collections.abc import Mapping

import numpy as np

from wearsim.geometry.blank import tooth_space
from wearsim.geometry.hub import Hub
from wearsim.geometry.profile_points import Vector
from wearsim.geometry.scene import (
    Circle,
    Label,
    Scene,
    around,
    letter_height,
    line,
    straight_arrow,
    turn_arrow,
)
from wearsim.geometry.tooth import Tooth
from wearsim.geometry.wheel_outline import ToothSpace, WheelShape, worn_alike, worn_space
from wearsim.quantities import grouped


def strand_wheel(
    tooth: Tooth, face_width: float, hub: Hub, engaged_every: int, last: Mapping[str, Vector] | None
) -> WheelShape:
    """Return the sprocket, worn to the last snapshot of a run where there is one."""
    new = tooth_space(tooth)
    every = math.gcd(tooth.teeth, engaged_every)
    worn: tuple[ToothSpace, ...] = ()
    if last is not None:
        gone = worn_space(new, np.column_stack([last["x_mm"], last["y_mm"]]))
        worn = tuple(new if number % every else gone for number in range(tooth.teeth))
    notes = (
        "seat and tip are arcs, the tip about the axis; back flank and seat do not wear",
        worn_alike(every),
        *hub.notes,
    )
    radius = tooth.strand.centrode_radius
    return WheelShape("sprocket", (new,) * tooth.teeth, worn, radius, face_width, notes, hub=hub)


def strand_scene(wheel: WheelShape, tooth: Tooth, pitch: float, pull: float, engaged_every: int) -> Scene:
    """Return the sprocket with its straight strand."""
    strand, tip = tooth.strand, tooth.tip_radius
    radius = strand.roller_radius
    reach = math.ceil(1.35 * tip / pitch) * pitch
    rollers = np.arange(-reach, 1.5 * reach, pitch)
    y, above = strand.height, strand.height + 2.2 * radius
    box = around([((0.0, 0.0), tip), ((-reach, y), radius), ((reach, y), radius), ((0.0, y), 2.6 * radius)])
    return Scene(
        box,
        (
            wheel.sketched("worn"),
            Circle("pitch", (0.0, 0.0), strand.centrode_radius),
            line("chain", [(-reach, y), (reach, y)]),
            *(Circle("roller", (x, y), radius) for x in rollers.tolist() if x <= reach + 0.1 * pitch),
            *turn_arrow((0.0, 0.0), 0.3 * tip, -1),
            *straight_arrow((0.45 * reach, above), (0.95 * reach, above), radius),
            Label("text", "strand", (0.7 * reach, y + 2.8 * radius), letter_height(box)),
        ),
        f"A sprocket of {tooth.teeth} teeth to scale under the straight strand that it moves, pitch "
        f"{pitch:g} mm, {strand.offset:.4g} mm inside its centrode.",
        (
            f"{tooth.teeth} teeth, pitch {pitch:g} mm, centrode radius {strand.centrode_radius:.2f} mm, line "
            f"of roller centres {strand.offset:.4g} mm inside it",
            f"a roller in every {'gap' if engaged_every == 1 else f'{engaged_every}. gap'}; the strand is "
            "straight and guided: no wrap, and the second sprocket has no part in it",
            f"pull {grouped(pull)} N at most",
        ),
    ).with_scale()
