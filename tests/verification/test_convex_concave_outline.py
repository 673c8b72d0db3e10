"""Outlines of convex-concave gears: closed, on the flanks, free to mesh; as DXF and as STL."""

import math
from collections import Counter

import ezdxf
import numpy as np
import pytest
import shapely
from scipy.spatial import cKDTree

from wearsim.cad.dxf_writer import write_dxf
from wearsim.cad.stl import prism, write_stl
from wearsim.errors import GeometryError
from wearsim.geometry.gear.convex_concave import ConvexConcave
from wearsim.geometry.gear.convex_concave_gear import ConvexConcaveGear
from wearsim.geometry.gear.convex_concave_outline import gear_outline, root_radius, tip_overlap
from wearsim.geometry.outline import Outline, rotated

POLE = math.radians(20.0)
PAIR = ConvexConcave(4.5, 17, 34, POLE, 10.0, 10.0, 4.5)
LOOSE = ConvexConcave(4.5, 11, 14, POLE, 10.0, 9.0, 4.0, backlash=0.2)
ROOTS = [("radial", None), ("radial", 0.5), ("fillet", None), ("fillet", 0.2)]
FINE = 1e-4

roots = pytest.mark.parametrize(("root", "clearance"), ROOTS)
pairs = pytest.mark.parametrize("pair", [PAIR, LOOSE])


def polygons(pair, root, clearance):
    gears = pair.pinion, pair.wheel
    return [gear_outline(gear, clearance, root).polygon(FINE) for gear in gears]


@roots
@pairs
def test_outline_is_a_gear(pair, root, clearance):
    for gear in (pair.pinion, pair.wheel):
        outline = gear_outline(gear, clearance, root)
        solid = shapely.Polygon(outline.polygon(1e-3))
        assert solid.is_valid
        assert solid.exterior.is_ccw
        radii = np.hypot(*outline.vertices.T)
        assert radii.max() == pytest.approx(gear.tip_radius, abs=1e-10)
        assert radii.min() == pytest.approx(root_radius(gear, clearance, root), abs=1e-10)
        pitch, middle = 2.0 * math.pi / gear.teeth, 0.5 * math.pi / gear.teeth
        mirrored = rotated(rotated(outline.vertices, middle) * (-1.0, 1.0), -middle)
        for alike in (rotated(outline.vertices, pitch), mirrored):
            assert cKDTree(outline.vertices).query(alike)[0].max() < 1e-10


@pytest.mark.parametrize(("root", "clearance"), ROOTS[:1])
@pairs
def test_flanks_lie_on_the_outline(pair, root, clearance):
    for gear, points in zip((pair.pinion, pair.wheel), polygons(pair, root, clearance), strict=True):
        edge = shapely.LinearRing(points)
        for flank, end in gear.flanks():
            on = rotated(flank.points(np.linspace(POLE, end, 61)), -gear.turn)
            assert shapely.distance(shapely.points(on), edge).max() < 2.0 * FINE


@roots
@pairs
def test_fillet_goes_on_smoothly(pair, root, clearance):
    """Directions at the vertices from the bulges: corners only at the tips and at radial lines."""
    outline = gear_outline(pair.pinion, clearance, root)
    chord = np.roll(outline.vertices, -1, axis=0) - outline.vertices
    angle, half = np.arctan2(chord[:, 1], chord[:, 0]), 2.0 * np.arctan(outline.bulges)
    corner = np.roll(angle - half, -1) - (angle + half)
    corner = np.abs((corner + math.pi) % (2.0 * math.pi) - math.pi)
    sharp = corner > 1e-3
    per_tooth = 4 if root == "radial" else 2
    assert sharp.sum() == per_tooth * pair.pinion_teeth
    assert corner[~sharp].max() < 1e-4


@pytest.mark.parametrize(("root", "clearance"), [("radial", None), ("fillet", None), ("fillet", 0.2)])
@pytest.mark.parametrize("pair", [PAIR, LOOSE])
def test_gears_run_free(pair, root, clearance):
    """Whole polygons, turned through a pitch with the flanks in contact, overlap nowhere."""
    pinion, wheel = polygons(pair, root, clearance)
    assert max(tip_overlap(pair, pinion, wheel)) < 2e-4
    r1, r2 = pair.pinion.pitch_radius, pair.wheel.pitch_radius
    window = shapely.box(-12.0, r1 - 8.0, 12.0, r1 + 8.0)
    for phi in np.linspace(0.0, 2.0 * math.pi / pair.pinion_teeth, 7):
        one = shapely.Polygon(rotated(pinion, pair.pinion.turn + phi)) & window
        other = -rotated(wheel, pair.wheel.turn - phi * r1 / r2) + (0.0, r1 + r2)
        common = one & (shapely.Polygon(other) & window)
        # Chords overlap by their tolerance along the contact.
        assert common.area < 2e-3
        assert common.buffer(-2e-4).is_empty


def test_backlash_is_what_the_wheel_can_turn():
    """Turned the other way by j / r2 the wheel touches with its other flank."""
    pinion, wheel = polygons(LOOSE, "radial", None)
    r1, r2 = LOOSE.pinion.pitch_radius, LOOSE.wheel.pitch_radius
    turn = LOOSE.wheel.turn
    window = shapely.box(-12.0, r1 - 8.0, 12.0, r1 + 8.0)
    for phi in np.linspace(0.0, 2.0 * math.pi / LOOSE.pinion_teeth, 5):
        one = shapely.Polygon(rotated(pinion, LOOSE.pinion.turn + phi)) & window

        def overlap(part, one=one, phi=phi):
            angle = turn - phi * r1 / r2 - part * 0.2 / r2
            other = -rotated(wheel, angle) + (0.0, r1 + r2)
            return (one & (shapely.Polygon(other) & window)).area

        assert overlap(0.99) == 0.0
        assert overlap(1.0) < 1e-3
        assert overlap(1.05) > 1e-3


def test_depth_of_the_tips_in_thicker_teeth():
    """At the end of contact the tip touches the flank: as deep as the flank is moved out."""
    for thicker in (0.05, 0.3):
        grown = [
            shapely.get_coordinates(shapely.Polygon(points).buffer(thicker, join_style="mitre"))
            for points in polygons(PAIR, "radial", None)
        ]
        assert tip_overlap(PAIR, *grown) == pytest.approx((thicker, thicker), abs=5e-3)


def test_tips_that_touch_the_root():
    """Without clearance the tip circles touch the roots, a little less deep than the fillet begins."""
    assert max(tip_overlap(PAIR, *polygons(PAIR, "fillet", 0.0))) > 10.0 * FINE


@roots
def test_roots_that_cannot_be(root, clearance):
    few = ConvexConcaveGear(5, 4.5, POLE, 10.0, 10.0, 1.0)
    with pytest.raises(GeometryError, match=r"root_clearance_ratio: must be at most 0\.061"):
        gear_outline(PAIR.pinion, 1.0, "fillet")
    with pytest.raises(GeometryError, match="root of z = 5: its radius must be above 0 mm, is -"):
        gear_outline(few, 11.0, root)


def test_widest_fillet_is_where_its_error_says():
    gear_outline(PAIR.pinion, 0.061 * 4.5, "fillet")
    with pytest.raises(GeometryError, match=r"at most 0\.061 for"):
        gear_outline(PAIR.pinion, 0.0611 * 4.5, "fillet")


def test_outline_that_crosses_itself():
    bow = Outline(np.array([[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]), np.zeros(4))
    with pytest.raises(GeometryError, match="must not cross itself"):
        bow.polygon(1e-3)


@pytest.mark.parametrize("angle", [0.3, 2.0, math.pi, 5.0, -0.3])
def test_chords_keep_the_tolerance(angle):
    """An arc of radius 2 and its chord: every point is on it, every chord as near as asked."""
    start = np.array([2.0, 0.0])
    last = 2.0 * np.array([math.cos(angle), math.sin(angle)])
    outline = Outline(np.array([start, last, 0.5 * last]), np.array([math.tan(angle / 4), 0, 0]))
    if angle < 0:
        outline = Outline(np.array([start, last, 2 * last]), np.array([math.tan(angle / 4), 0, 0]))
    arc = outline.polygon(1e-4)[:-2]
    assert np.hypot(*arc.T) == pytest.approx(2.0, abs=1e-12)
    middles = 0.5 * (arc + np.vstack([arc[1:], last]))
    assert 0.5e-4 < (2.0 - np.hypot(*middles.T)).max() < 1e-4


@pytest.mark.parametrize(("root", "clearance"), ROOTS[1:3])
def test_dxf_holds_the_outline(tmp_path, root, clearance):
    outline = gear_outline(LOOSE.pinion, clearance, root)
    path = tmp_path / "pinion.dxf"
    write_dxf(outline, path)
    drawing = ezdxf.readfile(path)
    assert drawing.header["$INSUNITS"] == 4
    (line,) = drawing.modelspace()
    assert (line.dxf.layer, line.closed) == ("OUTLINE", True)
    rows = np.array(line.get_points("xyb"))
    assert rows[:, :2] == pytest.approx(outline.vertices, abs=1e-12)
    assert rows[:, 2] == pytest.approx(outline.bulges, abs=1e-12)
    # The area by the arcs that ezdxf makes of it: chords and the segments beside them.
    x, y = rows[:, :2].T
    area = 0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1))
    arcs = [part for part in line.virtual_entities() if part.dxftype() == "ARC"]
    for arc, bulge in zip(arcs, rows[rows[:, 2] != 0.0, 2], strict=True):
        sweep = math.radians((arc.dxf.end_angle - arc.dxf.start_angle) % 360.0)
        area += math.copysign(0.5, bulge) * arc.dxf.radius**2 * (sweep - math.sin(sweep))
    assert area == pytest.approx(shapely.Polygon(outline.polygon(1e-6)).area, abs=1e-4)


@pytest.mark.parametrize(("root", "clearance"), ROOTS[1:3])
def test_solid_is_closed_and_holds_area_times_width(tmp_path, root, clearance):
    points = gear_outline(LOOSE.pinion, clearance, root).polygon(0.1)
    triangles = prism(points, 20.0)
    volume = np.einsum("ij,ij->i", triangles[:, 0], np.cross(triangles[:, 1], triangles[:, 2]))
    assert volume.sum() / 6.0 == pytest.approx(20.0 * shapely.Polygon(points).area, rel=1e-9)
    edges = Counter((tuple(one[i]), tuple(one[i - 2])) for one in triangles.tolist() for i in range(3))
    assert set(edges.values()) == {1}
    assert {(b, a) for a, b in edges} == set(edges)
    path = tmp_path / "pinion.stl"
    write_stl(triangles, path)
    data = path.read_bytes()
    assert len(data) == 84 + 50 * len(triangles)
    assert int.from_bytes(data[80:84], "little") == len(triangles)
    kept = np.frombuffer(data[84:], np.dtype([("n", "<f4", 3), ("c", "<f4", (3, 3)), ("a", "<u2")]))
    assert np.abs(kept["c"] - triangles).max() < 1e-5
    centre = kept["c"].mean(axis=1)
    wall = np.abs(kept["n"][:, 2]) < 0.5
    assert (kept["n"][~wall, 2] == np.where(centre[~wall, 2] > 10.0, 1.0, -1.0)).all()
    assert np.abs(np.linalg.norm(kept["n"], axis=1) - 1.0).max() < 1e-6
