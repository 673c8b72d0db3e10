"""Draw the roller, the pitch point and the offset of a strand: ``python docs/strand_drawings.py docs``.

The sprocket is that of a shipped case, its points and lengths those that wearsim computes.
tests/docs/test_strand_drawings.py compares.
"""

import math
import re
import sys
from pathlib import Path

import numpy as np

from wearsim.drive.load_case import load_single
from wearsim.geometry.forms.evolute import Strand
from wearsim.geometry.outline import rotated
from wearsim.geometry.scene import Box, Circle, Label, Scene, Stroke, line, straight_arrow, turn_arrow
from wearsim.mechanisms.strand.drive import StrandDrive
from wearsim.report.html.sketch import sketch

CASE = "16b-20t-oiled"
NEAR, FAR = 18.0, 26.0
"""Distance x of the roller that is in contact, in the overview and near by [mm]."""

STYLE = """
svg { background: #ffffff; }
path { fill: none; stroke: #1a1d21; stroke-width: 1.5; vector-effect: non-scaling-stroke; }
.body { fill: #e3e6ea; stroke: #6b7280; }
.pitch { stroke: #6b7280; stroke-dasharray: 8 3 2 3; }
.strand, .help { stroke: #6b7280; stroke-width: 1; }
.help { stroke-dasharray: 4 3; }
.roller { stroke-width: 1; }
.touching { fill: #dbe7f5; stroke: #0b57a4; }
.normal { stroke: #b3261e; stroke-width: 2; }
.dot { fill: #b3261e; stroke: none; }
.length { stroke: #0b57a4; }
.way { stroke: #0b57a4; stroke-dasharray: 2 3; }
text { fill: #1a1d21; text-anchor: middle; font-family: Georgia, "DejaVu Serif", serif; font-style: italic; }
"""

Place = tuple[float, float]


def reference() -> StrandDrive:
    """Return the drive of the case."""
    drive = load_single(CASE).drive
    assert isinstance(drive, StrandDrive)
    return drive


def contact(strand: Strand, x: float) -> tuple[Place, Place]:
    """Return the centre of a roller in contact and the point where it touches, in the fixed frame."""
    turn = x / strand.centrode_radius
    centre, touched = (
        rotated(points([x]), turn)[0] for points in (strand.roller_path, strand.conjugate_points)
    )
    return (float(centre[0]), float(centre[1])), (float(touched[0]), float(touched[1]))


def curvature_centre(strand: Strand, x: float) -> Place:
    """Return the centre of curvature of the flank where a roller touches it, in the fixed frame."""
    found = rotated(strand.evolute_points([x]), x / strand.centrode_radius)[0]
    return float(found[0]), float(found[1])


def wheel(drive: StrandDrive, turn: float) -> Stroke:
    """Return the sprocket, turned counterclockwise from where a roller lies under the pitch point."""
    outline = drive.wheels(1)[0].sketched("body", 5e-4)
    return Stroke("body", rotated(outline.vertices, turn), closed=True)


def length(start: Place, end: Place, name: str, beside: Place, height: float) -> tuple[Stroke | Label, ...]:
    """Return a length with arrows at both ends and its name beside the middle."""
    ends = [straight_arrow(start, end, 0.5 * height), straight_arrow(end, start, 0.5 * height)]
    shapes = [Stroke("length", part.vertices) for pair in ends for part in pair]
    middle = (0.5 * (start[0] + end[0]) + beside[0], 0.5 * (start[1] + end[1]) + beside[1])
    return *shapes, Label("text", name, middle, height)


def dot(place: Place, name: str, beside: Place, height: float) -> tuple[Circle | Label, ...]:
    """Return a point and its name."""
    return (
        Circle("dot", place, 0.14 * height),
        Label("text", name, (place[0] + beside[0], place[1] + beside[1]), height),
    )


def angle(
    corner: Place, radius: float, start: float, end: float, height: float
) -> tuple[Stroke | Label, ...]:
    """Return the arc of the pressure angle and its name."""
    ways = np.linspace(start, end, 30)
    arc = np.asarray(corner) + radius * np.column_stack([np.cos(ways), np.sin(ways)])
    middle = 0.5 * (start + end)
    away = radius + 0.7 * height
    name = (corner[0] + away * math.cos(middle), corner[1] + away * math.sin(middle) - 0.35 * height)
    return line("length", arc), Label("text", "α", name, height)


def overview() -> Scene:
    """Return the sprocket under the strand: pitch point, offset, and a roller at a distance."""
    drive = reference()
    strand, pitch = drive.tooth.strand, drive.chain.pitch
    centre, touched = contact(strand, NEAR)
    radius, top, high = strand.roller_radius, strand.centrode_radius, 3.6
    left, right = -62.0, 46.0
    box = (left, strand.height - 34.0, right - left, 34.0 + strand.offset + 24.0)
    others = [NEAR + number * pitch for number in (-3, -2, -1, 1, 2)]
    level = strand.height - radius - 6.0
    return Scene(
        box,
        (
            wheel(drive, NEAR / strand.centrode_radius),
            Circle("pitch", (0.0, 0.0), top),
            line("strand", [(left, strand.height), (right, strand.height)]),
            *(Circle("roller", (-x, strand.height), radius) for x in others),
            Circle("touching", centre, radius),
            line("help", [(0.0, box[1]), (0.0, top + 9.0)]),
            line("help", [(0.0, top), (right, top)]),
            line("help", [centre, (centre[0], level - 2.0)]),
            *length((centre[0], level), (0.0, level), "x", (0.0, 0.9), high),
            *length((32.0, strand.height), (32.0, top), "h", (3.0, -1.2), high),
            line("normal", [touched, (0.0, top)]),
            *dot((0.0, top), "P", (3.2, 2.4), high),
            *dot(centre, "C", (-2.6, 2.2), high),
            *dot(touched, "K", (-3.4, -1.6), high),
            *straight_arrow((-56.0, top + 12.0), (-36.0, top + 12.0), 2.5),
            Label("text", "strand", (-46.0, top + 14.0), high),
            line("help", [(-30.0, top + 3.5), (-34.0, math.sqrt(top**2 - 34.0**2))]),
            Label("text", "centrode", (-28.0, top + 4.5), high),
            *turn_arrow((9.0, box[1] + 9.0), 6.0, -1),
            Label("text", "ω", (9.0, box[1] + 7.7), high),
        ),
        "A sprocket under a straight strand: the pitch point P on the centrode, the line of roller centres "
        f"at the offset h = {strand.offset:g} mm inside it, and a roller with the centre C at the distance "
        f"x = {NEAR:g} mm, which touches the flank in K on the line through P and C.",
    )


def near_by() -> Scene:
    """Return one roller on the flank: its radius, the normal to the pitch point, the pressure angle."""
    drive = reference()
    strand = drive.tooth.strand
    centre, touched = contact(strand, FAR)
    evolute, radius, top = curvature_centre(strand, FAR), strand.roller_radius, strand.centrode_radius
    pressure, high = float(strand.pressure_angle(FAR)), 1.75
    box: Box = (-42.0, strand.height - 14.0, 49.0, 14.0 + strand.offset + 10.0)
    normal = np.array([math.cos(pressure), math.sin(pressure)])
    directions = pressure + math.pi + np.linspace(-0.6, 0.6, 60)
    bend = float(strand.flank_radius(FAR))
    arc = np.asarray(evolute) + bend * np.column_stack([np.cos(directions), np.sin(directions)])
    side = np.array([-normal[1], normal[0]])

    def beside(point: Place, way: float) -> Place:
        x, y = np.asarray(point) + way * side
        return float(x), float(y)

    return Scene(
        box,
        (
            wheel(drive, FAR / strand.centrode_radius),
            Circle("pitch", (0.0, 0.0), top),
            line("strand", [(box[0], strand.height), (box[0] + box[2], strand.height)]),
            Circle("touching", centre, radius),
            line("way", arc),
            line("normal", [touched, (0.0, top)]),
            line("help", [(0.0, box[1]), (0.0, top + 5.0)]),
            *length(beside(touched, 9.4), beside(evolute, 9.4), "ρₜ", (0.0, 0.8), high),
            *(line("help", [point, beside(point, 10.2)]) for point in (touched, evolute)),
            *length(beside(touched, -9.0), beside(centre, -9.0), "r", (0.3, 0.7), high),
            *length(beside(centre, -9.0), beside((0.0, top), -9.0), "l", (0.4, 0.7), high),
            *(line("help", [point, beside(point, -9.8)]) for point in (touched, centre, (0.0, top))),
            *angle(centre, 9.0, 0.0, pressure, high),
            *dot((0.0, top), "P", (1.4, 1.0), high),
            *dot(centre, "C", (-1.0, 1.0), high),
            *dot(touched, "K", (-1.9, -0.3), high),
            *dot(evolute, "E", (0.6, 0.9), high),
        ),
        f"One roller of the radius r = {radius:g} mm on the flank: the common normal runs from the contact K "
        "through the roller's centre C and the flank's centre of curvature E to the pitch point P, at the "
        f"pressure angle of {math.degrees(pressure):.1f} degrees to the strand; the flank's radius of "
        f"curvature is {bend:.2f} mm.",
    )


def sweep() -> Scene:
    """Return the roller in the frame of the sprocket, from the tip of the flank to its root."""
    drive = reference()
    strand, radius = drive.tooth.strand, drive.tooth.strand.roller_radius
    places = np.linspace(drive.contact_start, drive.contact_end, 5)
    path = strand.roller_path(np.linspace(drive.contact_start + 8.0, -2.0, 120))
    centres, touched = strand.roller_path(places), strand.conjugate_points(places)
    box: Box = (-31.0, strand.height - 12.0, 50.0, 30.0)
    high = 1.9
    shapes: list[Stroke | Circle | Label] = [wheel(drive, 0.0), line("way", path)]
    shapes += [Circle("roller", (float(x), float(y)), radius) for x, y in centres]
    shapes += [line("normal", pair) for pair in zip(touched, centres, strict=True)]
    shapes += [Circle("dot", (float(x), float(y)), 0.3) for x, y in touched]
    ends = ((drive.contact_start, "xₘₐₓ", (-2.6, 1.4)), (drive.contact_end, "xₘᵢₙ", (3.6, -0.4)))
    for x, name, (right, up) in ends:
        ((at_x, at_y),) = strand.roller_path([x])
        shapes.append(Label("text", name, (float(at_x) + right, float(at_y) + up), high))
    return Scene(
        box,
        tuple(shapes),
        f"The roller in the frame of the sprocket, from {drive.contact_start:g} mm at the tip of the flank "
        f"to {drive.contact_end:g} mm at its root; each normal from the contact to the roller's centre is "
        "the direction in which the point there wears.",
    )


DRAWINGS = {"strand_pitch_point": overview, "strand_roller": near_by, "strand_sweep": sweep}


def svg(scene: Scene) -> str:
    """Return a drawing as a file of its own."""
    drawn = re.search(r"<svg .*?</svg>\n", str(sketch(scene)), re.S)
    assert drawn is not None
    height = 700.0 * scene.box[3] / scene.box[2]
    head = f'<svg xmlns="http://www.w3.org/2000/svg" width="700" height="{height:.0f}"'
    return drawn[0].replace("<svg", head, 1).replace(">\n", f">\n<style>{STYLE}</style>\n", 1)


if __name__ == "__main__":
    for stem, draw in DRAWINGS.items():
        Path(sys.argv[1], f"{stem}.svg").write_text(svg(draw()), "utf-8")
