"""Sprockets and their chain to scale."""

import math

import numpy as np
import shapely

from wearsim.chain.drive_layout import DriveLayout
from wearsim.errors import GeometryError
from wearsim.geometry.outline import turned
from wearsim.geometry.profile import Vector
from wearsim.mechanisms.strand.drive import StrandDrive
from wearsim.mechanisms.wrap.drive import WrapDrive
from wearsim.report.html.sketch import (
    Label,
    Sketch,
    Stroke,
    around,
    circle,
    line,
    scaled,
    straight_arrow,
    text_size,
    turn_arrow,
)
from wearsim.report.lines import grouped

_FINE = 5e-3
"""Deviation of a drawn outline, as a fraction of the pitch."""


def wrap_sketch(drive: WrapDrive) -> Sketch:
    """Return both sprockets with the chain around them, the worn one with its teeth."""
    layout = drive.layout
    rollers = roller_places(layout)
    radius = 0.5 * drive.chain.roller_diameter
    worn = 0 if drive.driver else 1
    centres = ((0.0, 0.0), (layout.centre_distance, 0.0))
    pitch_radii = (0.5 * layout.pitch_diameter_1, 0.5 * layout.pitch_diameter_2)
    tips = [
        0.5 * layout.pitch * (0.6 + 1.0 / math.tan(math.pi / teeth))
        for teeth in (layout.teeth_1, layout.teeth_2)
    ]
    tips[worn] = float(np.hypot(drive.outline.x[0], drive.outline.y[0]))
    strokes = [Stroke("worn", _wheel(drive, _first_roller(rollers, layout, worn), centres[worn]))]
    strokes.append(Stroke("tip", circle(*centres[1 - worn], tips[1 - worn])))
    strokes += [Stroke("pitch", circle(*centre, r)) for centre, r in zip(centres, pitch_radii, strict=True)]
    strokes.append(Stroke("chain", line(rollers, closed=True)))
    strokes.append(Stroke("roller", "".join(circle(x, y, radius) for x, y in rollers)))
    arrow = 0.35 * min(pitch_radii)
    strokes += [Stroke("arrow", turn_arrow(*centre, arrow, 1)) for centre in centres]
    middle, rise = 0.5 * layout.centre_distance, 0.5 * (pitch_radii[0] + pitch_radii[1])
    box = around([(*c, max(t, p + radius)) for c, t, p in zip(centres, tips, pitch_radii, strict=True)])
    text = text_size(box)
    gap = radius + 0.5 * text + 3.5 * text * abs(math.tan(layout.inclination))
    labels = (
        Label(middle, -rise - gap, "tight strand"),
        Label(middle, rise + gap + 0.75 * text, "slack strand"),
    )
    return scaled(Sketch(box, 0.0, tuple(strokes), labels, _wrap_alt(drive), _wrap_notes(drive)))


def _wrap_alt(drive: WrapDrive) -> str:
    layout = drive.layout
    return (
        f"Two sprockets to scale, a driver of {layout.teeth_1} teeth and a driven one of "
        f"{layout.teeth_2}, {layout.centre_distance:.1f} mm apart, and the chain of {layout.links} "
        f"links around them; the sprocket that wears, the {'driver' if drive.driver else 'driven one'}, "
        f"is drawn with its teeth and wrapped over {math.degrees(drive.wrap_angle):.1f} degrees."
    )


def _wrap_notes(drive: WrapDrive) -> tuple[str, ...]:
    layout = drive.layout
    worn = "the driver, left" if drive.driver else "the driven one, right"
    return (
        f"driver {layout.teeth_1} teeth, driven {layout.teeth_2} teeth, ratio {layout.ratio:.4g}; "
        f"{layout.links} links, pitch {layout.pitch:g} mm",
        f"centre distance {layout.centre_distance:.1f} mm, taut; drawn level and without sag",
        f"the sprocket that wears, {worn}, is wrapped over {math.degrees(drive.wrap_angle):.1f} degrees",
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
            _on_circle(*driver, upper + way[part == 0] * layout.wrap_1),
            _between(driver, driven, -upper, way[part == 1]),
            _on_circle(*driven, -upper + way[part == 2] * layout.wrap_2),
            _between(driven, driver, upper, way[part == 3]),
        ]
    )


def _on_circle(centre: float, radius: float, angle: Vector) -> Vector:
    return np.column_stack([centre + radius * np.cos(angle), radius * np.sin(angle)])


def _between(start: tuple[float, float], end: tuple[float, float], angle: float, way: Vector) -> Vector:
    """Points of a straight strand from one circle to the other, which it leaves at the same angle."""
    from_, to = (_on_circle(*circle, np.array([angle])) for circle in (start, end))
    return np.asarray(from_ + way[:, None] * (to - from_))


def _wheel(drive: WrapDrive, direction: float, centre: tuple[float, float]) -> str:
    """Outline of the worn sprocket with the middle of a gap in a direction."""
    gap = np.column_stack([drive.outline.x, drive.outline.y])
    gap = shapely.get_coordinates(shapely.LineString(gap).simplify(_FINE * drive.layout.pitch))
    start, step = direction - 0.5 * math.pi, math.tau / drive.gaps
    gaps = [turned(gap, start + k * step) for k in range(drive.gaps)]
    return line(np.concatenate(gaps) + centre, closed=True)


def _first_roller(rollers: Vector, layout: DriveLayout, worn: int) -> float:
    """Direction from the worn sprocket's axis to a roller that it carries."""
    if worn == 0:
        return math.atan2(rollers[0, 1], rollers[0, 0])
    x, y = rollers[int(rollers[:, 0].argmax())]
    return math.atan2(y, x - layout.centre_distance)


def strand_sketch(drive: StrandDrive, engaged_every: int) -> Sketch:
    """Return the sprocket with its straight strand."""
    tooth, strand, pitch = drive.tooth, drive.tooth.strand, drive.chain.pitch
    tip, radius = tooth.tip_radius, strand.roller_radius
    reach = math.ceil(1.35 * tip / pitch) * pitch
    rollers = np.arange(-reach, 1.5 * reach, pitch)
    y = strand.height
    strokes = (
        Stroke("worn", _outline(drive)),
        Stroke("pitch", circle(0.0, 0.0, strand.centrode_radius)),
        Stroke("chain", line([(-reach, y), (reach, y)])),
        Stroke("roller", "".join(circle(x, y, radius) for x in rollers if x <= reach + 0.1 * pitch)),
        Stroke("arrow", turn_arrow(0.0, 0.0, 0.3 * tip, -1)),
        Stroke(
            "arrow",
            straight_arrow((0.45 * reach, y + 2.2 * radius), (0.95 * reach, y + 2.2 * radius), radius),
        ),
    )
    box = around([(0.0, 0.0, tip), (-reach, y, radius), (reach, y, radius), (0.0, y, 2.6 * radius)])
    where = Label(0.7 * reach, -y - 2.8 * radius, "strand")
    alt = (
        f"A sprocket of {tooth.teeth} teeth to scale under the straight strand that it moves, pitch "
        f"{pitch:g} mm, {strand.offset:.4g} mm inside its centrode."
    )
    notes = (
        f"{tooth.teeth} teeth, pitch {pitch:g} mm, centrode radius {strand.centrode_radius:.2f} mm, line "
        f"of roller centres {strand.offset:.4g} mm inside it",
        f"a roller in every {'gap' if engaged_every == 1 else f'{engaged_every}. gap'}; the strand is "
        "straight and guided: no wrap, and the second sprocket has no part in it",
        f"pull {grouped(drive.pull)} N at most",
    )
    return scaled(Sketch(box, 0.0, strokes, (where,), alt, notes))


def _outline(drive: StrandDrive) -> str:
    """Outline of the wheel, its tip circle where the outline crosses itself."""
    try:
        wheel = drive.tooth.wheel()
    except GeometryError:
        return circle(0.0, 0.0, drive.tooth.tip_radius)
    outline = wheel.exterior.simplify(_FINE * drive.chain.pitch)
    return line(shapely.get_coordinates(outline)[:-1], closed=True)
