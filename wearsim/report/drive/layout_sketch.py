"""The layout of a drive to scale, whose sprockets lead to their flanks."""

from markupsafe import Markup

from wearsim.drive.drive_case import DriveCase
from wearsim.geometry.scene import Circle
from wearsim.mechanisms.wrap.loop_scene import loop_scene
from wearsim.report.drive.layout import drive_forces, loop_names
from wearsim.report.drive.page_tables import wheel_of
from wearsim.report.html.sketch import sketch


def flank_place(number: int) -> str:
    """Return the place on a page where the flank of a sprocket is shown, by its number from 1."""
    return f"flank-{number}"


def layout_sketch(drive: DriveCase) -> Markup:
    """Return the drawing of the loop; a click on a sprocket leads to its flank, of a cassette the first."""
    forces = drive_forces(drive)
    of = [wheel.name for wheel in wheel_of(drive).values()]
    links = [
        (
            flank_place(of.index(name) + 1),
            Circle("link", (float(x), float(y)), float(radius), f"flank of {name}"),
        )
        for name, (x, y), radius in zip(
            loop_names(drive), forces.loop.centres, forces.loop.pitch_radii, strict=True
        )
    ]
    return sketch(loop_scene(forces, 0.5 * drive.driver.drive.chain.roller_diameter), links)
