"""The dots of a marker sheet in a photograph: found by their shade, identified by which of them are rings."""

import math
from collections import deque
from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from scipy.spatial import KDTree

from wearsim.geometry.profile_points import Vector
from wearsim.scanning.marker_grid import DOT, FARTHEST, HOLE, SPACING, Numbers, dot_points, is_ring
from wearsim.scanning.photograph import Light, Photograph
from wearsim.scanning.projection import homography
from wearsim.scanning.silhouette import reduced

_COARSE = 1600
"""Pixels of the larger side of the picture in which dots are looked for."""

_PAPER = 0.04
"""Width over that side within which there is paper beside a dot."""

_DARK = 0.55
"""Light over that of the paper below which there is ink."""

_LEAST_AREA, _MOST_AREA = 12, 0.0015
"""Area of a dot: pixels at least, and part of the picture at most."""

_ROUND = 0.5
"""Smaller diameter of a dot over its larger one at least."""

_FILLED = 0.1
"""How much the area of a dot may differ from that of an ellipse of its moments, relative."""

_FEWEST = 24
"""Dots of one piece of the grid from which its place on the sheet can be found."""

_AGREE = 0.9
"""Part of the dots of a piece that must be rings or not as the sheet says."""

_UNLIKE = 0.1
"""Part of the dots by which the next best place must agree less."""

_NEAR = 0.3
"""Way over the spacing within which a neighbour lies where it is expected."""

_TURNS = [
    np.array([[cos, -sin], [sin, cos]]) @ np.diag([1, mirror])
    for mirror in (-1, 1)
    for cos, sin in ((1, 0), (0, 1), (-1, 0), (0, -1))
]


Piece = dict[tuple[int, int], int]
"""Blobs by columns and rows."""


Window = tuple[slice, ...]
"""Rows and columns of a picture."""


class Blobs(NamedTuple):
    """Round dark spots."""

    points: Vector  # middles [px], shape (n, 2)
    diameters: Vector  # mean ones [px]
    paper: Vector  # light of the paper beside them
    hollow: NDArray[np.bool_]  # whether their middle is bright


@dataclass(frozen=True, eq=False)
class Markers:
    """Dots of the sheet that are in a photograph."""

    dots: Numbers  # columns and rows, shape (n, 2)
    points: Vector  # their middles in the picture [px], shape (n, 2)
    diameters: Vector  # [px]
    paper: Vector  # light of the paper beside them
    other: int = 0  # dots of a second sheet


def find_markers(photograph: Photograph) -> Markers | None:
    """Return the dots of a marker sheet in a photograph; None where there are too few to tell."""
    blobs = _find_blobs(photograph.light)
    pieces = [piece for piece in _pieces(blobs) if len(piece) >= _FEWEST]
    placed = [_placed(piece, blobs) for piece in sorted(pieces, key=len, reverse=True)]
    known = [piece for piece in placed if piece]
    if not known:
        return None
    sheet, other = dict(known[0]), 0
    for piece in known[1:]:
        if _fits(piece, sheet, blobs):
            sheet |= piece
        else:
            other += len(piece)
    return _markers(_completed(sheet, blobs), blobs, other)


def _markers(sheet: Piece, blobs: Blobs, other: int) -> Markers:
    which = list(sheet.values())
    return Markers(
        dots=np.array(list(sheet)),
        points=blobs.points[which],
        diameters=blobs.diameters[which],
        paper=blobs.paper[which],
        other=other,
    )


def _find_blobs(light: Light) -> Blobs:
    """Return round dark spots on paper, their middles from all pixels of the picture."""
    step = max(1, math.ceil(max(light.shape) / _COARSE))
    smooth = ndimage.gaussian_filter(reduced(light, step), 0.7)
    paper = ndimage.maximum_filter(smooth, int(_PAPER * max(smooth.shape)))
    labels, _ = ndimage.label(smooth < _DARK * paper)
    found = [
        _blob(light, labels[window] == number, window, step)
        for number, window in enumerate(ndimage.find_objects(labels), 1)
        if _may_be_dot(window, labels.shape)
    ]
    kept = [one for one in found if one is not None]
    columns = list(zip(*kept, strict=True)) or [(), (), (), ()]
    points, diameters, papers, hollow = (np.array(column) for column in columns)
    return Blobs(points.reshape(-1, 2), diameters, papers, hollow.astype(bool))


def _may_be_dot(window: Window, shape: tuple[int, ...]) -> bool:
    high, wide = (part.stop - part.start for part in window)
    inside = all(part.start > 0 and part.stop < side for part, side in zip(window, shape, strict=True))
    large = high * wide > 4.0 / math.pi * _MOST_AREA * shape[0] * shape[1]
    return inside and min(high, wide) >= _ROUND * max(high, wide) and high * wide >= _LEAST_AREA and not large


def _blob(
    light: Light, dark: NDArray[np.bool_], window: Window, step: int
) -> tuple[Vector, float, float, bool] | None:
    """Return middle, diameter, paper beside it, and whether its middle is bright; None of what is no dot."""
    filled = ndimage.binary_fill_holes(dark)
    down, across = np.nonzero(filled)
    if across.size < _LEAST_AREA:
        return None
    least, most = np.sqrt(np.linalg.eigvalsh(np.cov(across, down) + np.eye(2) / 12.0))
    ellipse = 4.0 * math.pi * least * most
    if least < _ROUND * most or abs(across.size / ellipse - 1.0) > _FILLED:
        return None
    middle = step * (np.array([across.mean() + window[1].start, down.mean() + window[0].start]) + 0.5) - 0.5
    diameter = 4.0 * step * math.sqrt(least * most)
    # Half way to the next dots, and no farther.
    reach = round(0.5 * diameter * (0.35 + most / least * 0.65) + 0.16 * diameter) + 1
    return _centred(light, middle, diameter, reach)


def _centred(
    light: Light, middle: Vector, diameter: float, reach: int
) -> tuple[Vector, float, float, bool] | None:
    """Return the centre of the ink within a square about a rough middle."""
    for _ in range(2):
        across, down = np.rint(middle).astype(int)
        if min(across, down) < reach or down + reach >= light.shape[0] or across + reach >= light.shape[1]:
            return None
        square = light[down - reach : down + reach + 1, across - reach : across + reach + 1]
        y, x = np.mgrid[-reach : reach + 1, -reach : reach + 1]
        away = np.hypot(x - (middle[0] - across), y - (middle[1] - down))
        rim = away > reach - 1.5
        paper = float(np.median(square[rim & (away <= reach)]))
        # A disc whose rim fades over a pixel takes no side.
        weight = (paper - square) * np.clip(reach + 0.5 - away, 0.0, 1.0)
        total = float(weight.sum())
        if total <= 0.0:
            return None
        middle = np.array([across + (x * weight).sum() / total, down + (y * weight).sum() / total])
    inner = away < 0.5 * diameter * 0.5 * HOLE / DOT
    ring = np.abs(away - 0.25 * diameter * (1.0 + HOLE / DOT)) < 0.5 + 0.05 * diameter
    ink = float(np.median(square[ring]))
    bright = float(square[inner].mean()) - ink > 0.35 * (paper - ink)
    return middle, diameter, paper, bright


def _pieces(blobs: Blobs) -> list[Piece]:
    """Return connected pieces of the grid: blobs by columns and rows, counted from anywhere."""
    if len(blobs.points) < _FEWEST:
        return []
    tree, free = KDTree(blobs.points), set(range(len(blobs.points)))
    found = []
    for start in range(len(blobs.points)):
        if start not in free:
            continue
        axes = _axes(start, tree, blobs)
        if axes is None:
            continue
        piece = _grown(start, axes, tree, blobs, free)
        if len(piece) >= _FEWEST:
            found.append(piece)
            free -= set(piece.values())
    return found


def _axes(start: int, tree: KDTree, blobs: Blobs) -> Vector | None:
    """Return the ways to two neighbours that lie about square to each other, as rows."""
    near = np.asarray(tree.query(blobs.points[start], 9)[1])
    ways = blobs.points[near[near != start]] - blobs.points[start]
    like = np.hypot(*ways.T) < 2.5 * SPACING / (2.0 * DOT) * blobs.diameters[start]
    for first in ways[like][:2]:
        for second in ways[like]:
            length, other = math.hypot(*first), math.hypot(*second)
            sine = float(first[0] * second[1] - first[1] * second[0]) / (length * other)
            if sine > 0.85 and 0.6 < other / length < 1.6:
                return np.array([first, second])
    return None


def _grown(start: int, axes: Vector, tree: KDTree, blobs: Blobs, free: set[int]) -> Piece:
    """Return what is reached from a blob by steps to neighbours; the steps change slowly on the way."""
    piece, taken = {(0, 0): start}, {start}
    todo = deque([((0, 0), axes)])
    while todo:
        place, axes = todo.popleft()
        here = blobs.points[piece[place]]
        for axis, sign in ((0, 1), (0, -1), (1, 1), (1, -1)):
            following = (place[0] + sign * (axis == 0), place[1] + sign * (axis == 1))
            if following in piece:
                continue
            off, which = tree.query(here + sign * axes[axis])
            if off > _NEAR * math.hypot(*axes[axis]) or which in taken or which not in free:
                continue
            piece[following] = int(which)
            taken.add(int(which))
            moved = axes.copy()
            moved[axis] = sign * (blobs.points[which] - here)
            todo.append((following, moved))
    return piece


@cache
def _all_rings() -> NDArray[np.int8]:
    """Rings as 1 and dots as -1, for all columns and rows of any paper."""
    line = np.arange(-FARTHEST, FARTHEST + 1)
    return np.where(is_ring(line[:, None], line[None, :]), 1, -1).astype(np.int8)


def _placed(piece: Piece, blobs: Blobs) -> Piece:
    """Return a piece by the columns and rows that its rings give; empty where it is no part of the sheet."""
    places, hollow = np.array(list(piece)), np.where(blobs.hollow[list(piece.values())], 1, -1)
    agreed = []
    for turn in _TURNS:
        turned = places @ turn.T
        low, high = turned.min(axis=0), turned.max(axis=0)
        if (high - low > 2 * FARTHEST).any():
            continue
        across, up = (np.arange(-FARTHEST - low[k], FARTHEST - high[k] + 1) for k in (0, 1))
        rows = turned + FARTHEST
        seen = sum(
            hollow[k] * _all_rings()[np.ix_(rows[k, 0] + across, rows[k, 1] + up)].astype(int)
            for k in range(len(rows))
        )
        which = np.unravel_index(int(np.argmax(seen)), np.shape(seen))
        best = float(np.max(seen))
        rest = np.array(seen, dtype=float)
        rest[which] = -len(rows)
        shift = np.array([across[which[0]], up[which[1]]])
        agreed += [(best, turned + shift), (float(rest.max()), turned)]
    if not agreed:  # larger than any sheet, such as a perforated plate
        return {}
    agreed.sort(key=lambda pair: pair[0], reverse=True)
    (best, at), (next_best, _) = agreed[:2]
    share, other = (0.5 * (1.0 + one / len(places)) for one in (best, next_best))
    if share < _AGREE or share - other < _UNLIKE:
        return {}
    return {(int(column), int(row)): blob for (column, row), blob in zip(at, piece.values(), strict=True)}


def _fits(piece: Piece, sheet: Piece, blobs: Blobs) -> bool:
    """Tell whether a piece lies where the sheet has it."""
    which = list(piece.values())
    off = np.hypot(*(_expected(np.array(list(piece)), sheet, blobs) - blobs.points[which]).T)
    return float(np.median(off)) < float(blobs.diameters[which].mean())


def _completed(sheet: Piece, blobs: Blobs) -> Piece:
    """Return the sheet with blobs that stand alone where it has a dot."""
    line = range(-FARTHEST, FARTHEST + 1)
    places = [(i, j) for i in line for j in line if (i, j) not in sheet]
    nearest = KDTree(_expected(np.array(places), sheet, blobs)).query(blobs.points)
    off, which = (np.asarray(one) for one in nearest)
    taken = set(sheet.values())
    found = dict(sheet)
    for blob, (way, number) in enumerate(zip(off, which, strict=True)):
        alike = bool(is_ring(*np.array(places[number]))) == bool(blobs.hollow[blob])
        if blob not in taken and alike and way < _NEAR * blobs.diameters[blob]:
            found[places[number]] = blob
    return found


def _expected(places: Numbers, sheet: Piece, blobs: Blobs) -> Vector:
    """Return where dots must lie in the picture, by those of the sheet that are known [px]."""
    matrix = homography(dot_points(np.array(list(sheet))), blobs.points[list(sheet.values())])
    seen = np.column_stack([dot_points(places), np.ones(len(places))]) @ matrix.T
    return np.asarray(seen[:, :2] / seen[:, 2:])
