"""Drawn gaps against the exact arcs of ISO 606 that the test itself lays out.

Expected distances: a seat arc of radius ri about a = (0, d/2) up to alpha/2 on either side, and
from there a convex flank of radius re about Ce = a + (ri + re) n(alpha/2), n(t) = (sin t, -cos t).
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from ezdxf.document import Drawing

from wearsim.geometry.gap_points import gap_from_points
from wearsim.geometry.measured.dxf_outline import outline_from_dxf

ROLLER, PITCH, TEETH = 8.51, 12.7, 17


@dataclass(frozen=True)
class Arcs:
    """An ISO 606 gap as three arcs (centre, radius, two angles), right flank first."""

    seat_radius: float
    flank_radius: float
    half_angle: float

    @property
    def a(self) -> np.ndarray:
        return np.array([0.0, 0.5 * PITCH / math.sin(math.pi / TEETH)])

    @property
    def flank_centre(self) -> np.ndarray:
        n = np.array([math.sin(self.half_angle), -math.cos(self.half_angle)])
        return self.a + (self.seat_radius + self.flank_radius) * n

    @property
    def tip_radius(self) -> float:
        return float(self.a[1] + 0.5 * (PITCH * (1.0 - 1.6 / TEETH) - ROLLER))

    @property
    def flank_angles(self) -> tuple[float, float]:
        """Of the right flank, from its tip to the seat: where |Ce + re u| is the tip radius."""
        (x, y), re = self.flank_centre, self.flank_radius
        D = math.hypot(x, y)
        tip = math.atan2(y, x) + math.acos((self.tip_radius**2 - D**2 - re**2) / (2.0 * D * re))
        return tip, 0.5 * math.pi + self.half_angle

    @property
    def tip(self) -> np.ndarray:
        angle = self.flank_angles[0]
        return self.flank_centre + self.flank_radius * np.array([math.cos(angle), math.sin(angle)])

    def arcs(self) -> list[tuple[np.ndarray, float, float, float]]:
        """Counterclockwise arcs: centre, radius, start, end."""
        tip, seat = self.flank_angles
        Ce, t = self.flank_centre, self.half_angle
        return [
            (Ce, self.flank_radius, tip, seat),
            (self.a, self.seat_radius, -0.5 * math.pi - t, -0.5 * math.pi + t),
            (Ce * [-1.0, 1.0], self.flank_radius, math.pi - seat, math.pi - tip),
        ]

    def error(self, points: np.ndarray) -> float:
        return float(np.abs(self.distances(points)).max())

    def distances(self, points: np.ndarray) -> np.ndarray:
        right = np.column_stack([np.abs(points[:, 0]), points[:, 1]])
        from_a = right - self.a
        on_seat = np.arctan2(from_a[:, 0], -from_a[:, 1]) <= self.half_angle
        seat = np.hypot(*from_a.T) - self.seat_radius
        flank = np.hypot(*(right - self.flank_centre).T) - self.flank_radius
        return np.where(on_seat, seat, flank)

    def points(self, step: float) -> np.ndarray:
        """Exact points right to left, at equal steps on every arc."""
        rows = []
        for (centre, radius, start, end), turn in zip(self.arcs(), (1, -1, 1), strict=True):
            count = round(radius * (end - start) / step) + 1
            at = np.linspace(start, end, count)[::turn]
            rows.append(centre + radius * np.column_stack([np.cos(at), np.sin(at)]))
        return np.concatenate([rows[0], rows[1][1:-1], rows[2]])


MINIMUM = Arcs(0.505 * ROLLER, 0.12 * ROLLER * (TEETH + 2), 0.5 * math.radians(140 - 90 / TEETH))
MAXIMUM = Arcs(
    0.505 * ROLLER + 0.069 * ROLLER ** (1 / 3),
    0.008 * ROLLER * (TEETH**2 + 180),
    0.5 * math.radians(120 - 90 / TEETH),
)
FORMS = [pytest.param(MINIMUM, id="min"), pytest.param(MAXIMUM, id="max")]


def rotated(point: np.ndarray, angle: float) -> tuple[float, float]:
    cosine, sine = math.cos(angle), math.sin(angle)
    return (float(cosine * point[0] - sine * point[1]), float(sine * point[0] + cosine * point[1]))


def wheel_arcs(form: Arcs) -> list[tuple[tuple[float, float], float, float, float]]:
    half = math.atan2(form.tip[0], form.tip[1])
    land = (np.zeros(2), form.tip_radius, 0.5 * math.pi + half, 0.5 * math.pi - half)
    land = (*land[:3], land[3] + 2.0 * math.pi / TEETH)
    arcs = []
    for i in range(TEETH):
        angle = 2.0 * math.pi * i / TEETH
        for centre, radius, start, end in [*form.arcs(), land]:
            arcs.append((rotated(centre, angle), radius, start + angle, end + angle))
    return arcs


def add_arcs(drawing: Drawing, arcs: list, shift: tuple[float, float] = (0.0, 0.0)) -> None:
    for (x, y), radius, start, end in arcs:
        drawing.modelspace().add_arc(
            (x + shift[0], y + shift[1]), radius, math.degrees(start), math.degrees(end)
        )


def with_bulges(drawing: Drawing, form: Arcs, scale: float = 1.0) -> None:
    """The gap as one polyline, right to left; bulge = tan(sweep / 4), clockwise negative."""
    vertices = []
    for (centre, radius, start, end), turn in zip(form.arcs(), (1, -1, 1), strict=True):
        first = start if turn == 1 else end
        x, y = centre + radius * np.array([math.cos(first), math.sin(first)])
        vertices.append((x * scale, y * scale, turn * math.tan(0.25 * (end - start))))
    x, y = form.tip * [-1.0, 1.0]
    drawing.modelspace().add_lwpolyline([*vertices, (x * scale, y * scale, 0.0)], format="xyb")


@pytest.fixture
def save(tmp_path: Path) -> Callable[[Drawing], Path]:
    def saved(drawing: Drawing) -> Path:
        path = tmp_path / "wheel.dxf"
        drawing.saveas(path)
        return path

    return saved


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("shift", [(0.0, 0.0), (150.0, -40.0)], ids=["origin", "elsewhere"])
def test_whole_wheel_of_shuffled_arcs_with_a_bore(
    form: Arcs, shift: tuple[float, float], save: Callable[[Drawing], Path]
) -> None:
    drawing = ezdxf.new(units=4)
    arcs = wheel_arcs(form)
    np.random.default_rng(1).shuffle(arcs)
    add_arcs(drawing, arcs, shift)
    for radius in (8.0, 2.0 * form.tip_radius):
        drawing.modelspace().add_circle(shift, radius)
    points, notes, _ = outline_from_dxf(save(drawing), TEETH)
    assert form.error(points) < 1e-5
    assert points[0, 0] > 0.0 > points[-1, 0]
    np.testing.assert_allclose(np.hypot(*points[[0, -1]].T), form.tip_radius - 1e-3, atol=1e-5)
    assert any("2 other closed outlines passed over, 1 of them larger" in note for note in notes)
    assert any("moved to the origin" in note for note in notes) == (shift != (0.0, 0.0))


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("turn", [0.0, 2.5])
def test_one_gap_of_loose_pieces_half_of_them_reversed(
    form: Arcs, turn: float, save: Callable[[Drawing], Path]
) -> None:
    """Splines through exact points in place of two arcs, one of them run the other way."""
    drawing = ezdxf.new(units=4)
    right, seat, left = ((rotated(c, turn), r, s + turn, e + turn) for c, r, s, e in form.arcs())
    add_arcs(drawing, [seat])
    for ((x, y), radius, start, end), way in ((left, 1), (right, -1)):
        at = np.linspace(start, end, 60)[::way]
        points = np.column_stack([x + radius * np.cos(at), y + radius * np.sin(at)])
        spline = ezdxf.math.fit_points_to_cad_cv([(u, v, 0.0) for u, v in points])
        drawing.modelspace().add_spline().apply_construction_tool(spline)
    points, notes, _ = outline_from_dxf(save(drawing), TEETH)
    assert form.error(points) < 2e-5
    assert any("is turned by" in note for note in notes) == (turn != 0.0)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(("unit", "factor"), [(4, 1.0), (1, 25.4), (0, 1.0)])
def test_polyline_with_bulges_in_several_units(
    form: Arcs, unit: int, factor: float, save: Callable[[Drawing], Path]
) -> None:
    drawing = ezdxf.new(units=unit)
    with_bulges(drawing, form, 1.0 / factor)
    points, notes, _ = outline_from_dxf(save(drawing), TEETH, sagitta=1e-4)
    assert form.error(points) < 1e-4
    assert bool(notes) == (unit != 4)


def with_chords(drawing: Drawing, form: Arcs, tolerance: float, turn: float) -> None:
    """The gap as one polyline of chords that stay within a tolerance of its arcs."""
    rows = []
    for (centre, radius, start, end), way in zip(form.arcs(), (1, -1, 1), strict=True):
        count = math.ceil(radius * (end - start) / math.sqrt(8.0 * radius * tolerance))
        at = np.linspace(start, end, count + 1)[::way]
        rows.append(centre + radius * np.column_stack([np.cos(at), np.sin(at)]))
    vertices = np.concatenate([rows[0], rows[1][1:], rows[2][1:]])
    drawing.modelspace().add_lwpolyline([rotated(vertex, turn) for vertex in vertices])


@pytest.mark.wide
@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(("tolerance", "error"), [(1e-4, 1e-4), (1e-3, 2e-3)])
def test_polyline_of_chords_is_read_as_the_curve(
    form: Arcs, tolerance: float, error: float, save: Callable[[Drawing], Path]
) -> None:
    """Its vertices are exact and few on the flat flanks; what lies between them is a guess."""
    drawing = ezdxf.new(units=4)
    with_chords(drawing, form, tolerance, 0.7)
    points, *_ = outline_from_dxf(save(drawing), TEETH)
    gap = gap_from_points(*points.T, 0.0, 401, 0.5 * ROLLER)
    distances = np.abs(form.distances(np.column_stack([gap.x, gap.y])))
    assert distances.max() < error
    assert math.sqrt(np.mean(np.square(distances))) < 0.3 * tolerance


@pytest.mark.wide
@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("loose", [False, True], ids=["polyline", "lines"])
def test_even_chords_of_a_whole_wheel(form: Arcs, loose: bool, save: Callable[[Drawing], Path]) -> None:
    """Chords of 0.3 mm, up to 3e-3 mm inside the arcs."""
    vertices = [rotated(point, 2.0 * math.pi * i / TEETH) for i in range(TEETH) for point in form.points(0.3)]
    drawing = ezdxf.new(units=4)
    if loose:
        for a, b in zip(vertices, vertices[1:] + vertices[:1], strict=True):
            drawing.modelspace().add_line(a, b)
    else:
        drawing.modelspace().add_lwpolyline(vertices, close=True)
    points, *_ = outline_from_dxf(save(drawing), TEETH)
    gap = gap_from_points(*points.T, 0.0, 401, 0.5 * ROLLER)
    assert form.error(np.column_stack([gap.x, gap.y])) < 1e-4


@pytest.mark.parametrize("form", FORMS)
def test_joints_are_found_in_few_exact_points(form: Arcs) -> None:
    """Two joints that mirror each other pay only together."""
    points = form.points(0.4)
    assert len(points) < 50
    gap = gap_from_points(*points.T, 0.0, 401, 0.5 * ROLLER)
    assert form.error(np.column_stack([gap.x, gap.y])) < 1e-4


@pytest.mark.wide
@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(("noise", "step"), [(0.0, 0.02), (1e-4, 0.02), (0.0, 0.1), (1e-4, 0.1)])
def test_smooth_outline_keeps_the_joints_of_exact_points(form: Arcs, noise: float, step: float) -> None:
    """The curvature jumps from -1/ri to 1/re; a smoothing spline without joints is 6e-4 off."""
    gap = gap_from_points(*form.points(step).T, noise, 401, 0.5 * ROLLER)
    assert form.error(np.column_stack([gap.x, gap.y])) < 2e-4
    ds = gap.arc_length[1]
    joint = round(form.flank_radius * (form.flank_angles[1] - form.flank_angles[0]) / ds)
    np.testing.assert_allclose(gap.curvature[2 : joint - 2], 1.0 / form.flank_radius, rtol=0.05)
    inside = gap.curvature[joint + 3 : -joint - 3]
    np.testing.assert_allclose(inside, -1.0 / form.seat_radius, rtol=0.01)


@pytest.mark.wide
@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("noise", [1e-4, 1e-3, 1e-2])
def test_noise_is_smoothed_away(form: Arcs, noise: float) -> None:
    points = form.points(0.02)
    points += noise * np.random.default_rng(3).standard_normal(points.shape)
    gap = gap_from_points(*points.T, noise, 401, 0.5 * ROLLER)
    distances = np.abs(form.distances(np.column_stack([gap.x, gap.y])))
    assert math.sqrt(np.mean(np.square(distances))) < 0.5 * noise
    assert distances.max() < 2.0 * noise


@pytest.mark.parametrize("form", FORMS)
def test_points_closer_than_their_noise_are_thinned(form: Arcs) -> None:
    """Steps of 0.01 mm with noise 0.01 mm: the chords are twice as long as the outline."""
    points = form.points(0.01)
    points += 0.01 * np.random.default_rng(5).standard_normal(points.shape)
    gap = gap_from_points(*points.T, 0.01, 401, 0.5 * ROLLER)
    distances = np.abs(form.distances(np.column_stack([gap.x, gap.y])))
    assert math.sqrt(np.mean(np.square(distances))) < 0.3 * 0.01
    middle = gap.curvature[150:-150]
    np.testing.assert_allclose(middle, -1.0 / form.seat_radius, rtol=0.1)
