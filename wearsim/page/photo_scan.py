"""A photograph on the page: what is seen of it, how it is scanned, and what is drawn on it."""

import base64
import io
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import to_hex
from PIL import Image

from wearsim.case.model import Case
from wearsim.drive.drive_case import DriveCase
from wearsim.errors import CaseError, Fault
from wearsim.geometry.profile_points import Vector
from wearsim.report.worn_flank import enlargement
from wearsim.scanning.answer import ScanResult, scan
from wearsim.scanning.model import ScannedWheel
from wearsim.scanning.new_wheel import around
from wearsim.scanning.photograph import Light, Photograph

_LARGEST = 1400
"""Pixels of the larger side of a picture on the page."""

_CLOSE = 200
"""Pixels of the photograph across a view in which a point is marked: each has one on a telephone, or more."""

_COLOURS = [to_hex(colormaps["plasma"](part)) for part in np.linspace(0.0, 0.9, 8)]
"""Of depths from none to the greatest."""

_NEW = "#1f77b4"

_MOST_STATIONS = 120
"""Of a gap that is drawn."""


@dataclass(frozen=True)
class PhotoView:
    """A part of a photograph as the page shows it."""

    left: int  # first pixel of the photograph
    top: int
    step: int  # pixels of the photograph to one that is shown, in each direction
    width: int  # pixels that are shown across
    source: str  # the picture, as an address that holds all of it

    def place(self, x: float, y: float) -> tuple[float, float]:
        """Return where in the photograph a place of the view is [px], whole numbers in the middle of pixels.

        Examples
        --------
        >>> PhotoView(100, 200, 1, 200, "").place(0.5, 20.0)
        (100.0, 219.5)
        """
        return max(self.left + self.step * x - 0.5, 0.0), max(self.top + self.step * y - 0.5, 0.0)

    def layer(self, drawing: str) -> str:
        """Return a drawing in pixels of the photograph as one of the view."""
        move = f"scale({1.0 / self.step:.6g}) translate({0.5 - self.left:g} {0.5 - self.top:g})"
        return f'<g transform="{move}">{drawing}</g>'


def whole_view(photograph: Photograph) -> PhotoView:
    """Return the whole of a photograph, smaller where it is large."""
    step = math.ceil(max(photograph.light.shape) / _LARGEST)
    return PhotoView(0, 0, step, math.ceil(photograph.width / step), _address(photograph.light, step))


def close_view(photograph: Photograph, x: float, y: float) -> PhotoView:
    """Return what lies around a place of a photograph, pixel by pixel."""
    left, top = (
        int(min(max(at - 0.5 * _CLOSE, 0.0), size - _CLOSE))
        for at, size in ((x, photograph.width), (y, photograph.height))
    )
    part = photograph.light[top : top + _CLOSE, left : left + _CLOSE]
    return PhotoView(left, top, 1, _CLOSE, _address(part, 1))


def _address(light: Light, step: int) -> str:
    """Return a picture as an address that holds it."""
    codes = np.round(255.0 * np.clip(light, 0.0, 1.0) ** (1.0 / 2.2)).astype(np.uint8)
    held = io.BytesIO()
    Image.fromarray(codes).reduce(step).save(held, "JPEG", quality=90)
    return f"data:image/jpeg;base64,{base64.b64encode(held.getvalue()).decode()}"


@dataclass(frozen=True)
class ScanWish:
    """What the user says of a photograph."""

    sprocket: str | None = None  # of a whole drive
    teeth: int | None = None  # in place of those of the case
    hours: float | None = None
    bore: float | None = None  # diameter [mm]
    scale: tuple[float, float, float, float, float] | None = None  # two points [px], their distance [mm]


def sprocket_names(case: Case | DriveCase) -> list[str]:
    """Return which sprockets may be in a photograph; none where there is no choice."""
    return [] if isinstance(case, Case) else list(case.titled_cases())


def scanned(
    photograph: Photograph, case: Case | DriveCase, wish: ScanWish, progress: Callable[[float], None]
) -> ScanResult:
    """Return the wear of the sprocket in a photograph."""
    return scan(
        photograph,
        _with_teeth(case, wish),
        sprocket=wish.sprocket,
        bore=wish.bore,
        scale=wish.scale,
        hours=wish.hours,
        progress=progress,
    )


def _with_teeth(case: Case | DriveCase, wish: ScanWish) -> Case | DriveCase:
    """Return the case with the number of teeth that the user says."""
    if wish.teeth is None:
        return case
    if isinstance(case, Case):
        return case.with_({"sprocket.teeth": wish.teeth})
    names = [wheel.name for wheel in case.wheels]
    if wish.sprocket not in names:
        text = "is a cog of a cassette, whose teeth cannot be corrected here: correct them in the input"
        raise CaseError([Fault(f"{wish.sprocket} {text}", "teeth", "scan")])
    return case.with_({f"sprocket.{names.index(wish.sprocket) + 1}.teeth": wish.teeth})


def overlay(found: ScannedWheel) -> str:
    """Return the new form and the worn edge, coloured by depth, as a drawing in pixels of the photograph."""
    place, teeth = found.depths.place, found.wheel.teeth
    every = math.ceil(place.stations.way.size / _MOST_STATIONS)
    depth = np.where(np.isfinite(found.depths.teeth), found.depths.teeth, 0.0)[:, ::every]
    points, normals = (
        around(rows[::every], teeth) for rows in (place.stations.points, place.stations.normals)
    )
    worn = place.projection.seen(points - drawn_larger(found) * depth[..., None] * normals)
    new = "".join(_line(row, _NEW, 1.0) for row in place.projection.seen(points))
    edges = "".join(
        _line(row[first : last + 2], _COLOURS[level], 3.0)
        for row, levels in zip(worn, _levels(found, depth[:, :-1]), strict=True)
        for first, last, level in _runs(levels)
    )
    return edges + new + _numbers(found)


def drawn_larger(found: ScannedWheel) -> int:
    """Return how many times deeper the wear is drawn than it is."""
    return enlargement(max(float(found.depths.mean.max()), 1e-3), 0.6 * found.wheel.pitch)


def depth_colours(found: ScannedWheel) -> list[tuple[str, str]]:
    """Return the colours of the overlay, each with its depth in words."""
    middles = (np.arange(len(_COLOURS)) + 0.5) / len(_COLOURS) * _greatest(found)
    return [(colour, f"{depth:.3f} mm") for colour, depth in zip(_COLOURS, middles, strict=True)]


def _greatest(found: ScannedWheel) -> float:
    """Return the greatest depth of any tooth [mm]."""
    return max(float(np.nanmax(found.depths.teeth)), 1e-6)


def _levels(found: ScannedWheel, depth: Vector) -> Vector:
    """Return the number of the colour of every depth."""
    part = np.clip(depth / _greatest(found), 0.0, 1.0 - 1e-9)
    return np.asarray((len(_COLOURS) * part).astype(int))


def _runs(levels: Vector) -> list[tuple[int, int, int]]:
    """Return first and last place of every run of equal numbers, and the number."""
    starts = np.concatenate([[0], np.flatnonzero(np.diff(levels)) + 1])
    ends = np.concatenate([starts[1:] - 1, [levels.size - 1]])
    return [(int(a), int(b), int(levels[a])) for a, b in zip(starts, ends, strict=True)]


def _line(points: Vector, colour: str, width: float) -> str:
    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    return (
        f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="{width:g}" '
        'vector-effect="non-scaling-stroke"/>'
    )


def _numbers(found: ScannedWheel) -> str:
    """Return the numbers of the teeth beside their tips."""
    place = found.depths.place
    tips = place.edges.tips.points.mean(axis=1)
    beside = tips + 0.08 * (tips - place.projection.seen(np.zeros(2)))
    size = 0.3 * found.wheel.pitch * place.scale
    return "".join(
        f'<text x="{x:.0f}" y="{y:.0f}" font-size="{size:.0f}" fill="{_NEW}" text-anchor="middle" '
        f'dominant-baseline="central">{number}</text>'
        for number, (x, y) in enumerate(beside, 1)
    )


def crosses(points: Sequence[tuple[float, float]], size: float) -> str:
    """Return points as crosses of some pixels of the photograph."""
    return "".join(
        _line(np.array([[x - size * a, y - size * b], [x + size * a, y + size * b]]), "#d62728", 2.0)
        for x, y in points
        for a, b in ((1, 1), (1, -1))
    )
