"""A flank that wears, as a moving picture: frames at equal steps of running time."""

import textwrap
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from wearsim.quantities import grouped
from wearsim.report.animation_file import encoded
from wearsim.report.animation_panels import MovingPanel, depth_panel, elongation_panel, flank_panel
from wearsim.report.answer import ending
from wearsim.report.worn_flank import worn_flanks
from wearsim.result import WearResult
from wearsim.result.lives import hours

if TYPE_CHECKING:
    from matplotlib.typing import HashableList

_HEIGHT, _WIDTH, _WIDTH_OF_GEARS = 5.4, 9.6, 11.2
"""Size of the picture [inches], which the size of its letters goes with."""

_LONGEST_TITLE = 150


def animation(result: WearResult, form: str, frames: int, seconds: float, width: int) -> bytes:
    """Return the wear of a run as a moving picture."""
    title = textwrap.shorten(result.title, _LONGEST_TITLE, placeholder=" ...")
    life = f"life {hours(result.life)}, {ending(result)}"
    factors = " and ".join(str(flank.factor) for flank in worn_flanks(result))
    text = (
        f"{title}: wear of the flank over {grouped(result.hours_run)} h, wear depth enlarged {factors} "
        f"times; {life}"
    )
    heading = f"{textwrap.fill(title, 80)}\n{life}"
    return encoded(images(result, heading, frames, width), form, seconds, text)


def images(result: WearResult, heading: str, frames: int, width: int) -> Iterator[Image.Image]:
    """Give the frames: one picture, of which only what moves is drawn again."""
    inches = _WIDTH if len(worn_flanks(result)) == 1 else _WIDTH_OF_GEARS
    figure = Figure(figsize=(inches, _HEIGHT), dpi=width / inches, layout="constrained")
    canvas: Any = FigureCanvasAgg(figure)  # its methods have no types
    figure.suptitle(heading, fontsize=11, parse_math=False)
    moving = _panels(figure, result, frames)
    for part in moving:
        part.show(0)
    canvas.draw()
    figure.set_layout_engine("none")
    for part in moving:
        for artist in part.artists:
            artist.set_animated(True)
    canvas.draw()
    still = canvas.copy_from_bbox(figure.bbox)
    for number in range(frames):
        canvas.restore_region(still)
        for part in moving:
            part.show(number)
            for artist in part.artists:
                figure.draw_artist(artist)
        yield Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB")


def _panels(figure: Figure, result: WearResult, frames: int) -> list[MovingPanel]:
    """Flanks on the left, depth and elongation against hours on the right."""
    flanks = worn_flanks(result)
    cycles = np.linspace(0.0, flanks[0].cycles[-1], frames)
    time = cycles * (result.hours_run / flanks[0].cycles[-1])
    grows = "elongation_percent" in result.history_columns
    names = [flank.name for flank in flanks]
    rows: list[HashableList[str]] = [[*names, "depth"]]
    if grows:
        rows.append([*names, "elongation"])
    panels = figure.subplot_mosaic(rows)
    points = [flank.at(cycles) for flank in flanks]
    moving = [
        flank_panel(panels[flank.name], result, flank, at, time)
        for flank, at in zip(flanks, points, strict=True)
    ]
    depths = {flank.name: at[2].max(axis=1) for flank, at in zip(flanks, points, strict=True)}
    moving.append(depth_panel(panels["depth"], result, depths, time))
    if grows:
        moving.append(elongation_panel(panels["elongation"], result, time))
    return moving
