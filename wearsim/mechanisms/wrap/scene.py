"""A chain around a sprocket as it is drawn: the wheel new and worn, and the drive to scale."""

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from wearsim.chain.drive_layout import DriveLayout
from wearsim.chain.loop_layout import LoopLayout
from wearsim.geometry.blank import gap_space
from wearsim.geometry.profile_points import Vector
from wearsim.geometry.scene import Circle, Label, Scene, Stroke, around, letter_height, line, turn_arrow
from wearsim.geometry.wheel_outline import ToothSpace, WheelShape, worn_alike, worn_gap
from wearsim.mechanisms.wrap.loop_scene import loop_scene
from wearsim.quantities import grouped

if TYPE_CHECKING:
    from wearsim.mechanisms.wrap.drive import WrapDrive


def wrap_wheel(
    drive: "WrapDrive", engaged_every: int, last: Mapping[str, Vector] | None = None
) -> WheelShape:
    """Return the sprocket that wears, worn to the last snapshot of a run where there is one."""
    new = gap_space(drive.outline, drive.gap)
    if drive.gap is not None:
        notes = [f"{drive.gap.form}: arcs and lines of the standard, exactly"]
    else:
        notes = ["the gap as given by points; tips are arcs about the axis"]
    worn: tuple[ToothSpace, ...] = ()
    worn_most = 0
    if last is not None:
        kinds = _worn_kinds(new, last)
        places = _kind_of_gaps(drive.gaps, engaged_every, len(kinds))
        worn = tuple(new if kind is None else kinds[kind] for kind in places)
        worn_most = places.index(int(last["gap_kind"][int(last["depth_mm"].argmax())]) - 1)
        if len(kinds) > 1:
            notes.append("gaps that meet inner links and gaps that meet outer links alternate")
        else:
            notes.append(worn_alike(math.gcd(drive.gaps, engaged_every)))
    return WheelShape(
        name="sprocket",
        new=(new,) * drive.gaps,
        worn=worn,
        pitch_radius=0.5 * drive.layout.pitch / math.sin(0.5 * drive.pitch_angle),
        width=drive.face_width,
        notes=(*notes, *drive.hub.notes),
        worn_most=worn_most,
        hub=drive.hub,
    )


def _worn_kinds(new: ToothSpace, last: Mapping[str, Vector]) -> list[ToothSpace]:
    points = np.column_stack([last["x_mm"], last["y_mm"]])
    kinds = last["gap_kind"]
    return [worn_gap(new, points[kinds == kind]) for kind in np.unique(kinds)]


def _kind_of_gaps(gaps: int, every: int, kinds: int) -> list[int | None]:
    """Kind of every gap, None where no roller ever comes."""
    found: list[int | None] = [None] * gaps
    for turn in range(gaps // math.gcd(gaps, every)):
        found[every * turn % gaps] = turn % kinds
    return found


def beside_gap(drive: "WrapDrive") -> Stroke:
    """Return half of the teeth on both sides of a gap, down to the sprocket's axis."""
    outline, half = drive.outline, math.pi / drive.gaps
    tip = math.hypot(outline.x[0], outline.y[0])
    across, up = tip * math.sin(half), tip * math.cos(half)
    gap = np.column_stack([outline.x, outline.y])
    return line("body", [*gap, (-across, up), (0.0, 0.0), (across, up)], closed=True)


def wrap_scene(drive: "WrapDrive") -> Scene:
    """Return both sprockets with the chain around them, the worn one with its teeth."""
    layout = drive.layout
    if isinstance(layout, LoopLayout):
        forces, own = drive.forces(drive.heaviest), layout.wheel
        wheel = replace(wrap_wheel(drive, 1), centre=layout.loop.wheels[own].centre)
        return loop_scene(forces, 0.5 * drive.chain.roller_diameter, (wheel.sketched("worn"),), own)
    rollers = roller_places(layout)
    radius = 0.5 * drive.chain.roller_diameter
    worn = 0 if drive.driver else 1
    centres = ((0.0, 0.0), (layout.centre_distance, 0.0))
    pitch_radii = (0.5 * layout.pitch_diameter_1, 0.5 * layout.pitch_diameter_2)
    turn = _first_roller(rollers, layout, worn) - 0.5 * math.pi
    wheel = replace(wrap_wheel(drive, 1), turn=turn, centre=centres[worn])
    teeth = (layout.teeth_1, layout.teeth_2)[1 - worn]
    mate = Circle("tip", centres[1 - worn], 0.5 * layout.pitch * (0.6 + 1.0 / math.tan(math.pi / teeth)))
    reach = [(wheel.centre, wheel.tip_radius), (mate.centre, mate.radius)]
    box = around([*reach, *((c, p + radius) for c, p in zip(centres, pitch_radii, strict=True))])
    arrow, text = 0.35 * min(pitch_radii), letter_height(box)
    middle, rise = 0.5 * layout.centre_distance, 0.5 * (pitch_radii[0] + pitch_radii[1])
    gap = radius + 0.5 * text + 3.5 * text * abs(math.tan(layout.inclination))
    return Scene(
        box,
        (
            wheel.sketched("worn"),
            mate,
            *(Circle("pitch", centre, r) for centre, r in zip(centres, pitch_radii, strict=True)),
            line("chain", rollers, closed=True),
            *(Circle("roller", (x, y), radius) for x, y in rollers.tolist()),
            *(stroke for centre in centres for stroke in turn_arrow(centre, arrow, 1)),
            Label("text", "tight strand", (middle, rise + gap), text),
            Label("text", "slack strand", (middle, -rise - gap - 0.75 * text), text),
        ),
        _alt(drive, layout),
        _notes(drive, layout),
    ).with_scale()


def _alt(drive: "WrapDrive", layout: DriveLayout) -> str:
    return (
        f"Two sprockets to scale, a driver of {layout.teeth_1} teeth and a driven one of "
        f"{layout.teeth_2}, {layout.centre_distance:.1f} mm apart, and the chain of {layout.links} "
        f"links around them; the sprocket that wears, the {'driver' if drive.driver else 'driven one'}, "
        f"is drawn with its teeth; its wrap angle is {math.degrees(drive.wrap_angle):.1f} degrees."
    )


def _notes(drive: "WrapDrive", layout: DriveLayout) -> tuple[str, ...]:
    worn = "the driver, left" if drive.driver else "the driven one, right"
    return (
        f"driver {layout.teeth_1} teeth, driven {layout.teeth_2} teeth, ratio {layout.ratio:.4g}; "
        f"{layout.links} links, pitch {layout.pitch:g} mm",
        f"centre distance {layout.centre_distance:.1f} mm, taut; drawn level and without sag",
        f"the sprocket that wears, {worn}, has a wrap angle of {math.degrees(drive.wrap_angle):.1f} degrees",
        f"slack strand {grouped(drive.slack)} N, tight strand {grouped(drive.heaviest.tension)} N",
    )


def roller_places(layout: DriveLayout) -> Vector:
    """Return the rollers of a taut chain, one for each link.

    Examples
    --------
    Two equal sprockets 300 mm apart: half of the 80 rollers lie on each side of the middle.

    >>> from wearsim.chain.drive_layout import layout_with_links
    >>> places = roller_places(layout_with_links(10.0, 20, 20, 80))
    >>> len(places), int((places[:, 0] < 149.0).sum()), round(float(places[0, 1]), 2)
    (80, 39, 31.96)
    """
    lengths = np.array([layout.engaged_1, 0.0, layout.engaged_2, 0.0])
    lengths[1::2] = layout.span / layout.pitch
    ends = np.cumsum(lengths)
    places = np.linspace(0.0, ends[-1], layout.links, endpoint=False)
    part = np.searchsorted(ends, places, side="right")
    way = (places - (ends - lengths)[part]) / lengths[part]
    upper = 0.5 * math.pi + layout.inclination
    driver, driven = (
        (0.0, 0.5 * layout.pitch_diameter_1),
        (layout.centre_distance, 0.5 * layout.pitch_diameter_2),
    )
    return np.concatenate(
        [
            _on_circle(*driver, upper + way[part == 0] * layout.wrap_angle_1),
            _between(driver, driven, -upper, way[part == 1]),
            _on_circle(*driven, -upper + way[part == 2] * layout.wrap_angle_2),
            _between(driven, driver, upper, way[part == 3]),
        ]
    )


def _on_circle(centre: float, radius: float, angle: Vector) -> Vector:
    return np.column_stack([centre + radius * np.cos(angle), radius * np.sin(angle)])


def _between(start: tuple[float, float], end: tuple[float, float], angle: float, way: Vector) -> Vector:
    """Points of a straight strand from one circle to the other, which it leaves at the same angle."""
    from_, to = (_on_circle(*circle, np.array([angle])) for circle in (start, end))
    return np.asarray(from_ + way[:, None] * (to - from_))


def _first_roller(rollers: Vector, layout: DriveLayout, worn: int) -> float:
    """Direction from the worn sprocket's axis to a roller that it carries."""
    if worn == 0:
        return math.atan2(rollers[0, 1], rollers[0, 0])
    x, y = rollers[int(rollers[:, 0].argmax())]
    return math.atan2(y, x - layout.centre_distance)
