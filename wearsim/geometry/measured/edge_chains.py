"""Edges joined end to end into chains, and what joins those that stay open."""

import math
from dataclasses import dataclass

import numpy as np

from wearsim.geometry.measured.dxf_edges import without_repeats
from wearsim.geometry.profile_points import Vector

NEAR = 1e-3
"""Distance [mm] up to which ends of edges are joined where nothing else is asked for."""

_NEIGHBOURS = 9
"""Ends that are looked at for a partner, the end itself among them."""

_LINE_STEP = 0.1
_SHARP = 0.5
_FLAT = 1e-5
_MAX_PARTS = 2000.0
"""Into which an edge is cut."""


@dataclass(frozen=True)
class Joint:
    """Two ends of edges that lie apart and were joined."""

    end: tuple[float, ...]  # [mm]
    start: tuple[float, ...]  # of what follows [mm]

    @property
    def width(self) -> float:
        """Distance of the two ends [mm]."""
        return math.dist(self.end, self.start)


@dataclass(frozen=True, eq=False)
class Chain:
    """Edges of a drawing joined end to end; the first point of a closed one is not repeated."""

    points: Vector
    closed: bool
    joints: tuple[Joint, ...] = ()  # that were bridged


def joined(
    edges: list[Vector], tolerance: float, notes: list[str]
) -> tuple[list[Chain], list[tuple[float, float]]]:
    """Chains of edges, and the places where more than two edges meet."""
    from ezdxf import edgeminer

    chains, links, seen = [], [], set()
    for points in edges:
        box = (*points.min(axis=0), *points.max(axis=0))
        if max(box[2] - box[0], box[3] - box[1]) < tolerance:
            continue
        ends = sorted(map(tuple, np.round(points[[0, -1]] / tolerance)))
        key = (*ends, *np.round(np.array(box) / tolerance))
        if key in seen:
            continue
        seen.add(key)
        if math.dist(points[0], points[-1]) <= tolerance:
            chains.append(Chain(points[:-1], closed=True))
        else:
            links.append(edgeminer.make_edge(points[0], points[-1], payload=points))
    if len(edges) > len(seen):
        notes.append(f"{len(edges) - len(seen)} edges drawn twice or too short: passed over")
    if not links:
        return chains, []
    deposit = edgeminer.Deposit(links, gap_tol=tolerance)
    widest, junctions = 0.0, set()
    for chain in edgeminer.find_all_simple_chains(deposit):
        rows = [e.payload[::-1] if e.is_reverse else e.payload for e in chain]
        first, last = rows[0][0], rows[-1][-1]
        closed = math.dist(first, last) <= tolerance
        following = rows[1:] + rows[:1] if closed else rows[1:]
        gaps = [math.dist(a[-1], b[0]) for a, b in zip(rows, following, strict=False)]
        widest = max([widest, *gaps])
        chains.append(Chain(_end_to_end(rows, closed), closed))
        junctions |= {
            (round(float(x), 3), round(float(y), 3)) for x, y in (first, last) if deposit.degree((x, y)) > 2
        }
    if widest > 1e-6:
        notes.append(f"ends of edges up to {widest:.2g} mm apart were joined")
    return _drawn(chains), sorted(junctions)


def bridged(chains: list[Chain], reach: float) -> list[Chain]:
    """Return chains of which open ends were joined, nearest ones first, up to a distance [mm].

    Examples
    --------
    Three sides of a square of 10 mm, drawn one by one with gaps of 0.1 mm, and the fourth missing:

    >>> sides = [[[0, 0], [9.9, 0]], [[10, 0], [10, 9.9]], [[10, 10], [0, 10]]]
    >>> three = [Chain(np.array(side, dtype=float), closed=False) for side in sides]
    >>> [[round(joint.width, 6) for joint in chain.joints] for chain in bridged(three, 1.0)]
    [[0.1, 0.1]]
    >>> bridged(three, 10.0)[0].closed
    True
    """
    open_ones = [chain for chain in chains if not chain.closed]
    if not open_ones:
        return chains
    ends = np.concatenate([chain.points[[0, -1]] for chain in open_ones])
    partners = _partners(ends, reach)
    found, left = [chain for chain in chains if chain.closed], set(range(len(open_ones)))
    # From ends that stay open first: what is left then runs around.
    starts = sorted(range(ends.shape[0]), key=lambda end: end in partners)
    return _drawn(
        found + [_walked(open_ones, left, partners, start) for start in starts if start // 2 in left]
    )


def _drawn(chains: list[Chain]) -> list[Chain]:
    """Chains without those that shrank to a point when their ends were joined."""
    return [chain for chain in chains if chain.points.shape[0] > (2 if chain.closed else 1)]


def _walked(chains: list[Chain], left: set[int], partners: dict[int, int], start: int) -> Chain:
    """The chain that is run through from an end, joint by joint; 2 i and 2 i + 1 are the ends of chain i."""
    rows: list[Vector] = []
    joints: list[Joint] = []
    end, closed = start, False
    while True:
        left.remove(end // 2)
        chain = chains[end // 2]
        rows.append(chain.points[::-1] if end % 2 else chain.points)
        joints += chain.joints
        if end ^ 1 not in partners:
            break
        end = partners[end ^ 1]
        following = chains[end // 2].points[-(end % 2)]
        joints.append(Joint(tuple(rows[-1][-1].tolist()), tuple(following.tolist())))
        if end // 2 not in left:
            closed = True
            break
    return Chain(_end_to_end(rows, closed), closed, tuple(joints))


def _partners(ends: Vector, reach: float) -> dict[int, int]:
    """Pairs of ends, both ways; places where more than two edges meet have none."""
    from scipy.spatial import KDTree

    found = KDTree(ends).query(ends, k=min(_NEIGHBOURS, ends.shape[0]))
    distances, others = np.asarray(found[0]), np.asarray(found[1])
    meeting = np.any(distances[:, 2:3] <= NEAR, axis=1)
    pairs = sorted(
        (float(distance), i, int(j))
        for i, (row, those) in enumerate(zip(distances, others, strict=True))
        for distance, j in zip(row[1:], those[1:], strict=True)
        if distance <= reach and not meeting[i] and not meeting[j]
    )
    partners: dict[int, int] = {}
    for _, i, j in pairs:
        if i != j and i not in partners and j not in partners:
            partners[i], partners[j] = j, i
    return partners


def _end_to_end(rows: list[Vector], closed: bool) -> Vector:
    """Rows of points one after the other, with the middle of the two ends at every joint."""
    rows = [row.copy() for row in rows]
    for before, after in zip(rows, rows[1:] + rows[:1] if closed else rows[1:], strict=False):
        before[-1] = after[0] = 0.5 * (before[-1] + after[0])
    points = without_repeats(np.concatenate(rows))
    return points[:-1] if closed else points


def filled(chain: Chain) -> Vector:
    """Points of a chain with more of them on its long edges.

    Between two corners that are not sharp an edge is the chord of a curve if it turns at both
    ends and is not much longer than both edges beside it; beyond a sharp corner nothing is
    known. A chord is cut as finely as the edges mostly are, with the new points on an arc of
    the lesser of the curvatures at its ends. All other edges are straight.
    """
    points = np.concatenate([chain.points, chain.points[:1]]) if chain.closed else chain.points
    way = np.diff(points, axis=0)
    # The edges beside the first and the last one; an open chain has only one of each.
    around = way[[-1, 0]] if chain.closed else way[[1, -2]] if len(way) > 1 else way[[0, 0]]
    padded = np.concatenate([around[:1], way, around[1:]])
    heading, lengths = np.arctan2(padded[:, 1], padded[:, 0]), np.hypot(*padded.T)
    turn = np.remainder(np.diff(heading) + math.pi, 2.0 * math.pi) - math.pi
    if not chain.closed:
        turn[[0, -1]] *= -1.0
    sharp = np.abs(turn) > _SHARP
    curvature = np.where(sharp, math.inf, 2.0 * turn / (lengths[:-1] + lengths[1:]))
    before, after = curvature[:-1], curvature[1:]
    bent = np.where(np.abs(before) < np.abs(after), before, after)
    length = lengths[1:-1]
    beside = np.maximum(lengths[:-2] * ~sharp[:-1], lengths[2:] * ~sharp[1:])
    is_straight = (np.abs(bent) * length**2 < 8.0 * _FLAT) | (length > 3.0 * beside)
    bent[is_straight] = 0.0
    fine = np.ceil(np.minimum(length / _LINE_STEP, _MAX_PARTS))
    alike = (length // max(_LINE_STEP, float(np.median(length)))).clip(1.0, _MAX_PARTS)
    steps = np.where(is_straight, fine, alike).astype(int)
    edge = np.repeat(np.arange(steps.size), steps)
    share = (np.arange(edge.size) - np.repeat(np.cumsum(steps) - steps, steps)) / steps[edge]
    aside = 0.5 * (bent * length)[edge] * share * (1.0 - share)
    outwards = way[edge] @ np.array([[0.0, -1.0], [1.0, 0.0]])
    filled = points[edge] + share[:, None] * way[edge] + aside[:, None] * outwards
    return filled if chain.closed else np.concatenate([filled, points[-1:]])
