"""The integrated evolute flank against the closed form of its conjugate points.

Expected points: the roller touches the strand-conjugate flank on the line from its centre C
to the pitch point; turning that contact point by psi = x/R into the sprocket's frame gives the
flank. Expected numbers of the example (p 25.4, d1 15.88, z 20, x 4.0..30.67): worked out by
hand and with an independent sweep for offsets 2.0, 4.0 and 5.5.
"""

from collections.abc import Callable

import numpy as np
import pytest

from wearsim.geometry.feasibility import exit_cut, smallest_offset
from wearsim.geometry.forms.evolute import Strand, evolute_flank
from wearsim.geometry.tooth import Tooth, cut_depth, sweep_path

CENTRODE = 25.4 * 20 / (2.0 * np.pi)
ROLLER = 15.88 / 2.0
END, START = 4.0, 30.67

DRIVES = [
    pytest.param(CENTRODE, ROLLER, 5.5, END, START, id="16B-20"),
    pytest.param(12.7 * 17 / (2.0 * np.pi), 8.51 / 2.0, 3.4, 2.0, 15.4, id="08B-17"),
    pytest.param(100.0 * 27 / (4.0 * np.pi), 24.0, 30.0, 10.0, 115.0, id="track-27/2"),
]


def rotated(points: np.ndarray, psi: np.ndarray) -> np.ndarray:
    """Points of the fixed frame in a sprocket that has turned psi clockwise back to 0."""
    x, y = points.T
    return np.column_stack([x * np.cos(psi) + y * np.sin(psi), y * np.cos(psi) - x * np.sin(psi)])


def conjugate_flank(R: float, r: float, h: float, x: np.ndarray) -> np.ndarray:
    centre = np.column_stack([-x, np.full_like(x, R - h)])
    to_pitch_point = np.column_stack([x, np.full_like(x, h)])
    normal = to_pitch_point / np.linalg.norm(to_pitch_point, axis=1)[:, None]
    return rotated(centre - r * normal, x / R)


def flank_radius(R: float, r: float, h: float, x: np.ndarray) -> np.ndarray:
    l = np.sqrt(x**2 + h**2)
    return r + l**3 / (R * h + l**2)


@pytest.mark.parametrize("nodes", [11, 401])
@pytest.mark.parametrize(("R", "r", "h", "end", "start"), DRIVES)
def test_points(
    validated: Callable[..., None], R: float, r: float, h: float, end: float, start: float, nodes: int
) -> None:
    flank = evolute_flank(Strand(R, r, h), end, start, nodes)
    expected = conjugate_flank(R, r, h, np.linspace(end, start, nodes))
    points = np.column_stack([flank.profile.x, flank.profile.y])
    validated(
        "coordinates of the evolute flank",
        *(points, expected, 1e-9, "closed form of the conjugate points", "mm"),
        absolute=True,
        page=(R, nodes) == (CENTRODE, 401),
    )


@pytest.mark.parametrize(("R", "r", "h", "end", "start"), DRIVES[:2])
def test_curvature_of_the_points(R: float, r: float, h: float, end: float, start: float) -> None:
    flank = evolute_flank(Strand(R, r, h), end, start, 401)
    expected = -1.0 / flank_radius(R, r, h, np.linspace(end, start, 401))
    np.testing.assert_allclose(flank.profile.curvature[1:-1], expected[1:-1], rtol=1e-5)


@pytest.mark.parametrize(("R", "r", "h", "end", "start"), DRIVES)
def test_arc_length_is_the_integral_of_radius_over_angle(
    validated: Callable[..., None], R: float, r: float, h: float, end: float, start: float
) -> None:
    """ds = rho_t d(theta) with theta = alpha - psi; quadrature on a 100 times finer grid."""
    x = np.linspace(end, start, 20001)
    theta = np.arctan2(h, x) - x / R
    rho = flank_radius(R, r, h, x)
    length = np.sum(0.5 * (rho[1:] + rho[:-1]) * -np.diff(theta))
    profile = evolute_flank(Strand(R, r, h), end, start, 401).profile
    source = "quadrature of the radius over the angle"
    found, shown = profile.arc_length[-1], R == CENTRODE
    validated("length of the evolute flank", found, length, 1e-8, source, "mm", page=shown)


@pytest.mark.parametrize(("R", "r", "h", "end", "start"), DRIVES)
def test_sliding_speed_identity(R: float, r: float, h: float, end: float, start: float) -> None:
    """With omega = 1: v_t = rho_t (1 + R h/l^2), v_s = l + r, and v_s = v_t - r R h/l^2."""
    strand = Strand(R, r, h)
    x = np.linspace(end, start, 101)
    l = strand.pitch_point_distance(x)
    np.testing.assert_allclose(l, np.sqrt(x**2 + h**2), rtol=1e-15)
    v_t = strand.flank_radius(x) * (1.0 + R * h / l**2)
    np.testing.assert_allclose(v_t - r * R * h / l**2, l + r, rtol=1e-12)


@pytest.mark.parametrize(("R", "r", "h", "end", "start"), DRIVES)
def test_speed_of_the_contact_point(R: float, r: float, h: float, end: float, start: float) -> None:
    """v_t = ds/d(psi) of the closed-form points, by central differences."""
    x, step = np.linspace(end, start, 21), 1e-4
    way = conjugate_flank(R, r, h, x + step) - conjugate_flank(R, r, h, x - step)
    speed = np.linalg.norm(way, axis=1) / (2.0 * step / R)
    strand = Strand(R, r, h)
    l = strand.pitch_point_distance(x)
    np.testing.assert_allclose(strand.flank_radius(x) * (1.0 + R * h / l**2), speed, rtol=1e-7)


@pytest.mark.parametrize(("R", "r", "h", "end", "start"), DRIVES)
def test_evolute_lies_on_the_line_from_roller_to_pitch_point(
    R: float, r: float, h: float, end: float, start: float
) -> None:
    """On the line C-P at the distance l/(1 + l^2/(R h)) from P, on the roller's side."""
    x = np.linspace(end, start, 51)
    l = np.sqrt(x**2 + h**2)
    pitch_point = np.array([0.0, R])
    roller = np.column_stack([-x, np.full_like(x, R - h)])
    along = (roller - pitch_point) / l[:, None]
    fixed = pitch_point + along * (l / (1.0 + l**2 / (R * h)))[:, None]
    np.testing.assert_allclose(
        Strand(R, r, h).evolute_points(x), rotated(fixed, x / R), rtol=0.0, atol=1e-12 * R
    )


@pytest.mark.parametrize(("R", "r", "h", "end", "start"), DRIVES)
def test_evolute_is_the_envelope_of_the_normals(
    R: float, r: float, h: float, end: float, start: float
) -> None:
    strand, x, step = Strand(R, r, h), np.linspace(end, start, 21), 1e-4
    tangent = strand.evolute_points(x + step) - strand.evolute_points(x - step)
    normal = strand.evolute_points(x) - strand.conjugate_points(x)
    cross = tangent[:, 0] * normal[:, 1] - tangent[:, 1] * normal[:, 0]
    lengths = np.linalg.norm(tangent, axis=1) * np.linalg.norm(normal, axis=1)
    np.testing.assert_allclose(cross / lengths, 0.0, atol=1e-7)
    np.testing.assert_allclose(np.linalg.norm(normal, axis=1), strand.flank_radius(x), rtol=1e-12)


def test_pressure_angles_of_the_example() -> None:
    angles = np.degrees(Strand(CENTRODE, ROLLER, 5.5).pressure_angle([END, START]))
    np.testing.assert_allclose(angles, [54.0, 10.2], atol=0.05)


def test_tip_radius_and_neck_of_the_example(validated: Callable[..., None]) -> None:
    strand = Strand(CENTRODE, ROLLER, 5.5)
    mirrored = Tooth(strand, evolute_flank(strand, END, START, 201).profile, 20, relief=0.0)
    validated(
        "tip radius, 16B with 20 teeth", *(mirrored.tip_radius, 83.36, 5e-3, "by hand", "mm"), absolute=True
    )
    assert mirrored.neck == pytest.approx(6.5, abs=0.05)


def test_exit_clearance_of_the_example() -> None:
    """The leaving roller passes the tip half of the flank at 0.18 mm."""
    strand = Strand(CENTRODE, ROLLER, 5.5)
    points = strand.conjugate_points(np.linspace(0.5 * (END + START), START, 200))
    path = sweep_path(strand, float(np.hypot(*points[-1])), -1.0)
    assert -cut_depth(points, path, ROLLER) == pytest.approx(0.18, abs=5e-3)
    assert exit_cut(strand, END, START) <= 0.0


@pytest.mark.parametrize(
    ("offset", "start", "cut", "within"), [(4.0, START, 1.27, 5e-3), (2.0, 29.67, 2.9, 0.05)]
)
def test_exit_cut_of_the_example(
    validated: Callable[..., None], offset: float, start: float, cut: float, within: float
) -> None:
    strand = Strand(CENTRODE, ROLLER, offset)
    validated(
        f"cut of the leaving roller at an offset of {offset:g} mm",
        *(exit_cut(strand, END, start), cut, within, "independent sweep", "mm"),
        absolute=True,
        page=offset == 4.0,
    )


def test_smallest_offset_of_the_example(validated: Callable[..., None]) -> None:
    validated(
        "smallest offset without a cut, 16B with 20 teeth",
        smallest_offset(CENTRODE, ROLLER, END, START),
        *(5.311, 1.5e-3, "independent sweep", "mm"),
        absolute=True,
    )


@pytest.mark.parametrize("teeth", [13, 20, 30, 60])
def test_smallest_offset_follows_the_rule(teeth: int) -> None:
    """h z / (p (eps + x_min/p)^2) lies between 2.8 and 3.1 for 13 to 60 teeth."""
    pitch, ratio = 25.4, 1.05
    centrode = pitch * teeth / (2.0 * np.pi)
    offset = smallest_offset(centrode, ROLLER, END, END + ratio * pitch)
    assert 2.8 <= offset * teeth / (pitch * (ratio + END / pitch) ** 2) <= 3.15
