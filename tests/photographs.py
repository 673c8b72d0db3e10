"""Pictures of sprockets with a known wear: a camera of its own, which knows nothing of `wearsim scan`.

The wheel is a polygon that Agg fills by the exact area of every pixel. Light, blur and noise act on linear
intensities; the file holds them by the curve of sRGB.
"""

import io
import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import RendererAgg
from matplotlib.path import Path as AggPath
from matplotlib.transforms import IdentityTransform
from numpy.typing import NDArray
from PIL import Image
from scipy.ndimage import gaussian_filter, map_coordinates

from wearsim.geometry.forms import TOOTH_FORMS

Points = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Print:
    """A page that lies under a wheel, as its file shows it."""

    page: NDArray[np.float32]  # reflectance over that of the paper
    per_mm: float  # pixels of the page to a millimetre of the print
    at: tuple[float, float]  # point of the page that lies under the wheel's axis, from the lower left [mm]
    turn: float = 0.0  # of the page [rad]
    bulge: float = 0.0  # how high its middle line lies above its edges [mm]
    table: float = 0.3  # reflectance of what it lies on

    @staticmethod
    def of(path: str | Path, scale: float = 1.0, **others: Any) -> "Print":
        """Return the print of a PNG file, larger by a factor than its own resolution says."""
        with Image.open(path) as file:
            grey = np.asarray(file.convert("L"), dtype=np.float32) / 255.0
            return Print(0.06 + 0.94 * grey, file.info["dpi"][0] / 25.4 / scale, **others)

    def seen_from(self, points: Points, below: Points, away: float, paper: float) -> NDArray[np.float32]:
        """Return the light of points of the table [mm], as a camera sees it so far above a point of it."""
        height = self.bulge * np.cos(0.03 * points[..., 0])
        there = points - (points - below) * (height / away)[..., None]
        cos, sin = math.cos(self.turn), math.sin(self.turn)
        across, up = np.moveaxis(there @ np.array([[cos, -sin], [sin, cos]]) + self.at, -1, 0)
        rows = self.page.shape[0] - 0.5 - up * self.per_mm
        columns = across * self.per_mm - 0.5
        page = map_coordinates(self.page, [rows, columns], order=1, cval=-1.0)
        return np.where(page < 0.0, self.table, paper * page).astype(np.float32)


@dataclass(frozen=True)
class Camera:
    """How a wheel is photographed; lengths in pixels where nothing else is said."""

    size: tuple[int, int] = (600, 600)  # width and height
    wheel: float = 0.8  # diameter of the wheel over the smaller side
    centre: tuple[float, float] = (0.5, 0.5)  # of the wheel, over width and height
    turn: float = 0.3  # of the wheel about its axis [rad]
    tilt: float = 0.0  # of its axis against the line of sight [rad]
    tilt_direction: float = 0.0  # [rad]
    distance: float = 8.0  # from the wheel over its diameter
    distortion: float = 0.0  # radial one at half of the smaller side
    mirror: bool = False
    wheel_light: float = 0.08  # reflectance of the wheel and of what lies behind it
    ground_light: float = 0.7
    uneven: float = 0.0  # how much less light there is at one edge of the picture
    blur: float = 0.8  # standard deviation
    noise: float = 0.01  # standard deviation over full scale
    jpeg: int | None = None  # quality
    dirt: int = 0  # blobs of the wheel's colour at its edge
    shine: float = 0.0  # how much brighter a narrow rim inside the edge is
    gamma: float | None = None  # of the file, instead of the curve of sRGB
    printed: Print | None = None  # page under the wheel
    edges: tuple[float, ...] = (0.0,)  # heights of the edges of the teeth above the plane aimed at [mm]
    holes: Sequence[tuple[float, float, float]] = field(default=((0.0, 0.0, 0.2),))
    # x, y and radius over that of the wheel
    seed: int = 0


def new_gap(pitch: float, roller: float, teeth: int, form: str = "iso606", nodes: int = 801) -> Points:
    """Return a gap from its right tip to its left one [mm]."""
    outline = TOOTH_FORMS[form].gap(pitch, roller, teeth).outline(nodes)
    return np.column_stack([outline.x, outline.y])


def with_pocket(gap: Points, depth: float, at: float = 0.72, width: float = 0.18) -> Points:
    """Return a gap with a smooth pocket: the middle and the half width are parts of the way along it.

    From `at` = 0.5, the bottom, to 1, the left tip.
    """
    way = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(gap, axis=0).T))])
    part = way / way[-1]
    along = np.gradient(gap, way, axis=0)
    along /= np.hypot(*along.T)[:, None]
    into = np.column_stack([-along[:, 1], along[:, 0]])
    if into[len(gap) // 2] @ gap[len(gap) // 2] > 0.0:
        into = -into
    near = np.clip((part - at) / width, -1.0, 1.0)
    return gap + (depth * np.cos(0.5 * np.pi * near) ** 2)[:, None] * into


def wheel(gaps: Sequence[Points]) -> Points:
    """Return the outline of a wheel of these gaps, its tips by arcs about the axis."""
    rows = []
    for number, gap in enumerate(gaps):
        angle = math.tau * number / len(gaps)
        cos, sin = math.cos(angle), math.sin(angle)
        rows.append(gap @ np.array([[cos, sin], [-sin, cos]]))
    outline = []
    for row, following in zip(rows, [*rows[1:], rows[0]], strict=True):
        start, end = (math.atan2(*point[::-1]) for point in (row[-1], following[0]))
        way = (end - start) % math.tau
        arc = start + way * np.linspace(0.0, 1.0, 40)[1:-1]
        radius = np.linspace(math.hypot(*row[-1]), math.hypot(*following[0]), 40)[1:-1]
        outline += [row, np.column_stack([radius * np.cos(arc), radius * np.sin(arc)])]
    return np.concatenate(outline)


def with_worn_tips(gap: Points, loss: float) -> Points:
    """Return a gap without the part that is nearer to its tips than a loss of their radius [mm]."""
    radius = np.hypot(*gap.T)
    return gap[radius < radius.max() - loss]


def chain_on(pitch: float, roller: float, teeth: int, links: int) -> list[Points]:
    """Return the outlines of rollers and plates of a chain in the first gaps of a wheel [mm]."""
    radius = 0.5 * pitch / math.sin(math.pi / teeth)
    angle = np.linspace(0.0, math.tau, 90, endpoint=False)
    circle = np.column_stack([np.cos(angle), np.sin(angle)])
    pins = math.tau * -np.arange(links + 1) / teeth
    pins = radius * np.column_stack([-np.sin(pins), np.cos(pins)])
    shapes = [pin + 0.5 * roller * circle for pin in pins]
    for start, end in pairwise(pins):
        along = (end - start) / pitch
        across = np.array([-along[1], along[0]])
        half = 0.45 * pitch
        waist = np.array([start - 0.8 * half * across, end - 0.8 * half * across])
        waist = np.concatenate([waist, [end + 0.8 * half * across, start + 0.8 * half * across]])
        shapes += [start + half * circle, end + half * circle, waist]
    return shapes


@dataclass(frozen=True, eq=False)
class Face:
    """A flat part of something that lies beside the wheel, or covers what was drawn before it."""

    outline: Points  # [mm]
    height: float  # above the plane aimed at [mm]
    light: float  # its reflectance


def chain_beside(
    pitch: float,
    plate: float,
    width: float,
    links: int,
    start: tuple[float, float],
    turn: float,
    elongation: float,
    bow: float = 0.0,
) -> tuple[list[Face], Points]:
    """Return a chain on its side, and the middles of its pins at the height of its upper plates [mm].

    Bushes have worn: it is the links between pins of two outer plates that are longer. A bow lifts its middle
    aside [mm].
    """
    ways = np.where(np.arange(links) % 2, pitch, pitch * (1.0 + 0.02 * elongation))
    along = np.concatenate([[0.0], np.cumsum(ways)])
    part = along / along[-1]
    pins = np.column_stack([along, 4.0 * bow * part * (1.0 - part)])
    cos, sin = math.cos(turn), math.sin(turn)
    pins = pins @ np.array([[cos, sin], [-sin, cos]]) + start
    angle = np.linspace(0.0, math.tau, 120, endpoint=False)
    circle = np.column_stack([np.cos(angle), np.sin(angle)])

    def plates(first: int, half: float, height: float, light: float) -> list[Face]:
        faces = []
        for one, other in list(pairwise(pins))[first::2]:
            way = (other - one) / math.dist(one, other)
            across = np.array([-way[1], way[0]])
            middle, waist = 0.5 * (one + other), 0.72 * half * across
            bar = np.array([one + waist, other + waist, other - waist, one - waist])
            faces += [Face(one + half * circle, height, light), Face(other + half * circle, height, light)]
            faces += [Face(bar, height, light), Face(middle + 0.5 * half * circle, height, 0.9 * light)]
        return faces

    outer, inner = 0.5 * plate - 0.3, 0.5 * plate
    low = [one for level in (0.2, 0.4, 0.6) for one in plates(0, outer, level * width, 0.03)]
    heads = [Face(pin + 0.17 * pitch * circle, width, 0.3) for pin in pins]
    faces = [*low, *plates(1, inner, 0.86 * width, 0.12), *plates(0, outer, 0.95 * width, 0.16), *heads]
    return faces, pins


def photographed(points: Points, radius: float, camera: Camera, height: float = 0.0) -> tuple[Points, float]:
    """Return points so high above the wheel's plane [mm] in the picture, and the pixels of a millimetre."""
    turned = points @ np.array(
        [[math.cos(camera.turn), math.sin(camera.turn)], [-math.sin(camera.turn), math.cos(camera.turn)]]
    )
    if camera.mirror:
        turned = turned * [-1.0, 1.0]
    cos, sin = math.cos(camera.tilt_direction), math.sin(camera.tilt_direction)
    along, across = turned @ [cos, sin], turned @ [-sin, cos]
    away = 2.0 * radius * camera.distance
    deep = away + along * math.sin(camera.tilt) - height * math.cos(camera.tilt)
    along = along * math.cos(camera.tilt) + height * math.sin(camera.tilt)
    seen = np.column_stack([cos * along - sin * across, sin * along + cos * across]) * (away / deep)[:, None]
    least = min(camera.size)
    scale = 0.5 * camera.wheel * least / radius
    middle = np.array(camera.size) * camera.centre
    seen = middle + scale * seen * [1.0, -1.0]
    optical = 0.5 * np.array(camera.size)
    off = (seen - optical) / (0.5 * least)
    return optical + 0.5 * least * off * (1.0 + camera.distortion * (off**2).sum(axis=1))[:, None], scale


def on_table(camera: Camera, radius: float) -> NDArray[np.float32]:
    """Return the light of the table with a page on it, where no wheel would lie."""
    width, height = camera.size
    least, away = min(camera.size), 2.0 * radius * camera.distance
    scale = 0.5 * camera.wheel * least / radius
    optical = 0.5 * np.array(camera.size)
    seen = np.stack(np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5), axis=-1)
    bent = (seen - optical) / (0.5 * least)
    off = bent
    for _ in range(8):
        off = bent / (1.0 + camera.distortion * (off**2).sum(axis=-1))[..., None]
    flat = (optical + 0.5 * least * off - np.array(camera.size) * camera.centre) / scale * [1.0, -1.0]
    cos, sin = math.cos(camera.tilt_direction), math.sin(camera.tilt_direction)
    turned = np.array([[cos, sin], [-sin, cos]])
    along, across = np.moveaxis(flat @ turned.T, -1, 0)
    # Along is cos t x away / (away + sin t x) for a point x of the table.
    true = along * away / (away * math.cos(camera.tilt) - along * math.sin(camera.tilt))
    across = across * (away + true * math.sin(camera.tilt)) / away
    points = np.stack([true, across], axis=-1) @ turned
    below = np.array([-away * math.sin(camera.tilt), 0.0]) @ turned
    if camera.mirror:
        points, below = points * [-1.0, 1.0], below * [-1.0, 1.0]
    assert camera.printed is not None
    return camera.printed.seen_from(points, below, away * math.cos(camera.tilt), camera.ground_light)


def picture(
    outline: Points, camera: Camera, chain: Sequence[Points] = (), beside: Sequence[Face] = ()
) -> Image.Image:
    """Return the picture of a wheel, with the parts of a chain on it, and with one beside it."""
    rng = np.random.default_rng(camera.seed)
    width, height = camera.size
    radius = float(np.hypot(*outline.T).max())
    shapes = [_dense(outline)]
    angle = np.linspace(math.tau, 0.0, 400, endpoint=False)
    for x, y, part in camera.holes:
        shapes.append(np.column_stack([x + part * np.cos(angle), y + part * np.sin(angle)]) * radius)
    covers = []
    for level in camera.edges:
        seen = [photographed(shape, radius, camera, level)[0] for shape in shapes]
        covers.append(_covered(seen, width, height))
    covers += [_covered([photographed(part, radius, camera)[0]], width, height) for part in chain]
    cover = np.max(covers, axis=0)
    across, down = np.meshgrid(
        np.arange(width, dtype=np.float32) / width, np.arange(height, dtype=np.float32) / height
    )
    direction = rng.uniform(0.0, math.tau)
    lit = 1.0 - camera.uneven * (
        0.5 + (across - 0.5) * math.cos(direction) + (down - 0.5) * math.sin(direction)
    )
    face = np.full_like(cover, camera.wheel_light)
    if camera.shine:
        inside = gaussian_filter(cover, 2.0) - 0.5
        face += camera.shine * np.exp(-(((inside - 0.3) / 0.12) ** 2))
    ground = camera.ground_light if camera.printed is None else on_table(camera, radius)
    image = lit * (ground * (1.0 - cover) + face * cover)
    for face in beside:
        covered = _covered([photographed(face.outline, radius, camera, face.height)[0]], width, height)
        image += covered * (face.light * lit - image)
    for _ in range(camera.dirt):
        x, y = seen[0][rng.integers(len(seen[0]))] + rng.normal(0.0, 2.0, 2)
        size = rng.uniform(0.002, 0.008) * min(camera.size)
        blob = np.exp(-0.5 * (((across * width - x) ** 2 + (down * height - y) ** 2) / size**2) ** 2)
        image += blob * (camera.wheel_light * lit - image)
    image = gaussian_filter(image.astype(np.float32), camera.blur)
    image = image + rng.standard_normal(image.shape, np.float32) * camera.noise * np.sqrt(
        0.2 + np.clip(image, 0.0, 1.0)
    )
    image = np.clip(image, 0.0, 1.0)
    if camera.gamma:
        coded = image ** (1.0 / camera.gamma)
    else:
        coded = np.where(image <= 0.0031308, 12.92 * image, 1.055 * image ** (1.0 / 2.4) - 0.055)
    found = Image.fromarray(np.round(255.0 * coded).astype(np.uint8))
    if camera.jpeg is None:
        return found
    held = io.BytesIO()
    found.convert("RGB").save(held, "JPEG", quality=camera.jpeg)
    return Image.open(io.BytesIO(held.getvalue()))


def _dense(outline: Points) -> Points:
    """Return an outline of steps that bend no more than the picture shows."""
    closed = np.concatenate([outline, outline[:1]])
    way = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(closed, axis=0).T))])
    keep = np.concatenate([[True], np.diff(way) > 0.0])
    at = np.union1d(way, np.linspace(0.0, way[-1], 4000))
    return np.column_stack([np.interp(at, way[keep], closed[keep, i]) for i in (0, 1)])[:-1]


def _covered(shapes: Sequence[Points], width: int, height: int) -> Points:
    """Return which part of every pixel is covered by the first shape and by no other one."""
    agg = RendererAgg(width, height, 72.0)
    found = []
    for shape in shapes:
        agg.clear()
        context = agg.new_gc()
        context.set_linewidth(0.0)
        context.set_antialiased(True)
        # Agg counts from the lower edge up.
        closed = np.concatenate([shape, shape[:1]]) * [1.0, -1.0] + [0.0, height]
        agg.draw_path(context, AggPath(closed), IdentityTransform(), (0.0, 0.0, 0.0, 1.0))
        found.append(np.asarray(agg.buffer_rgba())[:, :, 3].astype(np.float32) / 255.0)
    cover, *holes = found
    for hole in holes:
        cover = cover * (1.0 - hole)
    return cover


def random_camera(rng: np.random.Generator, size: tuple[int, int]) -> Camera:
    """Return one of many ways to photograph a wheel off its drive by hand."""
    dark = rng.uniform(0.02, 0.2)
    light = rng.uniform(0.35, 0.85)
    return replace(
        Camera(),
        size=size,
        wheel=rng.uniform(0.6, 0.9),
        centre=(rng.uniform(0.47, 0.53), rng.uniform(0.47, 0.53)),
        turn=rng.uniform(0.0, math.tau),
        tilt=math.radians(abs(rng.normal(0.0, 3.0))),
        tilt_direction=rng.uniform(0.0, math.tau),
        distance=rng.uniform(3.0, 12.0),
        mirror=bool(rng.integers(2)),
        wheel_light=dark,
        ground_light=light,
        uneven=rng.uniform(0.0, 0.4),
        blur=rng.uniform(0.6, 2.0),
        noise=rng.uniform(0.002, 0.02),
        jpeg=int(rng.integers(75, 97)) if rng.random() < 0.8 else None,
        dirt=int(rng.integers(0, 6)),
        shine=0.0 if rng.random() < 0.7 else rng.uniform(0.0, 0.1),
        distortion=rng.normal(0.0, 0.001),
        gamma=rng.uniform(1.8, 2.6) if rng.random() < 0.5 else None,
        seed=int(rng.integers(1 << 30)),
    )
