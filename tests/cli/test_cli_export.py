"""``wearsim export``: wheels for CAD, read again, and the gauge of the wear limit."""

import csv
import io
import math
import re
import zlib
from pathlib import Path
from xml.etree import ElementTree as ET

import ezdxf
import numpy as np
import pytest
import shapely
from scipy.spatial import cKDTree

import wearsim
from wearsim.drive.load_case import load_case
from wearsim.geometry.measured.dxf_outline import outline_from_dxf
from wearsim.geometry.outline import Outline, along_ways
from wearsim.report.worn_flank import wheel_shapes
from wearsim.result import WearResult

WRAP = """\
format_version = 1
title = "Wrap"
chain.designation = "{chain}"
sprocket = {{ teeth = {teeth}, profile = "{profile}", nodes = 301{more} }}
mechanism = {{ kind = "wrap", phases = 1 }}
load = {{ power_kW = 1, speed_rpm = 100 }}
wear.specific_wear_rate_mm2_per_N = 1e-9
joint.law = "constant"
stop.critical_depth_mm = 0.02
drive = {{ links = {links} }}
run = {{ method = "per_cycle", cycles_per_update = 10000, horizon_hours = 100 }}
"""
FORMS = {
    "iso606": ("08B-1", 12, 60, ""),
    "ansi_b29": ("08A-1", 13, 60, ""),
    "gost591": ("ПР-12.7-18.2", 14, 60, ", displaced = true"),
}
TOLERANCE = 1e-3
"""Of a drawing [mm]."""

GEARS = """\
format_version = 1
title = "Gears"
[gear]
profile = "{profile}"
pinion_teeth = 17
wheel_teeth = 34
module_mm = 4.5
face_width_mm = 20
nodes = 201
{more}
[load]
torque_N_m = 100
speed_rpm = 100
[wear]
specific_wear_rate_mm2_per_N = 1e-10
wheel_wear_ratio = 2
[stop]
critical_depth_mm = 0.05
wheel_critical_depth_mm = 0.05
"""
PAIRS = {"involute": "", "convex_concave": "addendum_arc_radius_mm = 10"}


@pytest.fixture
def wrap(tmp_path):
    """Function that writes a case of a standard form."""

    def write(profile):
        chain, teeth, links, more = FORMS[profile]
        path = tmp_path / f"{profile}.toml"
        text = WRAP.format(chain=chain, teeth=teeth, profile=profile, links=links, more=more)
        path.write_text(text, encoding="utf-8")
        return path

    return write


@pytest.fixture
def gears(tmp_path):
    """Function that writes a case of a gear pair."""

    def write(profile):
        path = tmp_path / f"{profile}.toml"
        path.write_text(GEARS.format(profile=profile, more=PAIRS[profile]))
        return path

    return write


def read_outline(path, layer):
    """The closed outline of a layer of a DXF file."""
    drawing = ezdxf.readfile(path)
    assert drawing.header["$INSUNITS"] == 4
    assert drawing.audit().errors == []
    (line,) = drawing.modelspace().query(f'LWPOLYLINE[layer=="{layer}"]')
    assert line.closed
    rows = np.array(line.get_points("xyb"))
    return Outline(rows[:, :2], rows[:, 2])


def drawn_line(path, layer):
    """The closed outline of a layer by chords much finer than its tolerance."""
    return shapely.LinearRing(read_outline(path, layer).polygon(1e-6))


def computed(case, run, state, wheel=0):
    """The outline that is drawn, before its curves become arcs."""
    (chain,) = wheel_shapes(case, run)[wheel].chains(state)
    return chain.outline


def worn_area(case, run, wheel=0):
    return computed(case, run, "new", wheel).area - computed(case, run, "worn", wheel).area


def last_points(run, least=0.0):
    """Worn points of the last snapshot of a run, of the kind of gap that is worn most.

    With ``least`` only where the depth is at least that part of the greatest.
    """
    last = run.flank[run.flank["cycles"] == run.flank["cycles"].max()]
    if "gap_kind" in last:
        last = last[last["gap_kind"] == last["gap_kind"][last["depth_mm"].idxmax()]]
    deep = last["depth_mm"] >= least * last["depth_mm"].max()
    return last[deep][["x_mm", "y_mm"]].to_numpy()


def test_strand_is_drawn_by_few_arcs_close_to_its_points(cli, drive, tmp_path):
    """Within 0.001 mm, as the note says: the flank's points off the arcs, and arcs off the fine outline."""
    path, out = drive(nodes=201), tmp_path / "both.dxf"
    done = cli("export", path, "--state", "both", "--out", out)
    assert (done.code, done.out) == (0, "")
    case = load_case(path)
    flank, run = case.drive.tooth.flank, wearsim.simulate(case)
    drawn = drawn_line(out, "NEW")
    assert shapely.distance(shapely.points(flank.x, flank.y), drawn).max() < TOLERANCE
    for layer, state in (("NEW", "new"), ("WORN", "worn")):
        fine = shapely.LinearRing(computed(case, run, state).polygon(1e-6))
        line = drawn_line(out, layer)
        assert line.buffer(TOLERANCE).covers(fine)
        assert fine.buffer(TOLERANCE).covers(line)
        assert len(read_outline(out, layer).vertices) < 20 * 20
    assert "within 0.001 mm" in " ".join(texts(out))


@pytest.mark.parametrize("profile", FORMS)
def test_standard_form_comes_back(cli, wrap, tmp_path, profile):
    """Every point of the case's gap lies on the drawn arcs."""
    path, out = wrap(profile), tmp_path / "new.dxf"
    assert cli("export", path, "--out", out).code == 0
    drive = load_case(path).drive
    outline = read_outline(out, "NEW")
    drawn = shapely.LinearRing(outline.polygon(5e-7))
    points = shapely.points(drive.outline.x, drive.outline.y)
    assert shapely.distance(points, drawn).max() < 1e-6
    assert len(outline.vertices) < 13 * drive.gaps
    assert np.hypot(*outline.vertices.T).max() == pytest.approx(drive.gap.tip_radius, abs=1e-9)


def test_reader_of_drawings_takes_it(cli, wrap, tmp_path):
    path, out = wrap("iso606"), tmp_path / "new.dxf"
    assert cli("export", path, "--out", out).code == 0
    outline = load_case(path).drive.outline
    gap, notes, _ = outline_from_dxf(out, 12)
    assert not any("damaged" in note or "no unit" in note for note in notes)
    points = shapely.points(outline.x[3:-3], outline.y[3:-3])
    assert shapely.distance(points, shapely.LineString(gap)).max() < 2e-5


def test_points_of_the_worn_strand_and_their_area(cli, drive, tmp_path):
    """The run's points, and what it removed, less the sliver that lies above the tips."""
    path, out = drive(nodes=201), tmp_path / "both.dxf"
    assert cli("export", path, "--state", "both", "--out", out).code == 0
    run = wearsim.simulate(load_case(path))
    points = last_points(run)
    inside = np.hypot(*points.T) < np.hypot(*read_outline(out, "NEW").vertices.T).max()
    assert inside.sum() > 190
    assert shapely.distance(shapely.points(points[inside]), drawn_line(out, "WORN")).max() < TOLERANCE
    assert shapely.Polygon(read_outline(out, "WORN").polygon(1e-4)).is_valid
    first = run.flank[run.flank["cycles"] == 0.0][["x_mm", "y_mm"]].to_numpy()
    region = shapely.Polygon(np.concatenate([first, points[::-1]]))
    tip = shapely.Point(0.0, 0.0).buffer(math.hypot(*first[-1]), quad_segs=20000)
    above = region.difference(tip).area
    assert worn_area(load_case(path), run) / 20 + above == pytest.approx(run.removed_area, rel=1e-4)
    assert above < 0.01 * run.removed_area


@pytest.mark.wide
@pytest.mark.parametrize("profile", FORMS)
def test_worn_wrap(cli, wrap, tmp_path, profile):
    """A saved run: valid, and smaller by what the run removed of every gap."""
    path, folder, out = wrap(profile), tmp_path / "run", tmp_path / "both.dxf"
    assert cli("life", path, "--out", folder).code == 0
    assert cli("export", folder, "--out", out).code == 0
    run, teeth = WearResult.load(folder), FORMS[profile][1]
    assert shapely.Polygon(read_outline(out, "WORN").polygon(1e-4)).is_valid
    kinds = set(run.flank["gap_kind"])
    assert len(kinds) == (2 if teeth % 2 == 0 else 1)
    lost = worn_area(load_case(path), run)
    assert lost == pytest.approx(teeth / len(kinds) * run.removed_area, rel=2e-3)
    gauge = tmp_path / "gauge.dxf"
    assert cli("export", folder, "--template", gauge, "-q").code == 0
    check_gauge(gauge, last_points(run, 0.92))


def check_gauge(path, points):
    """The outline of the gauge holds points worn deep, moved as a whole."""
    outline = read_outline(path, "GAUGE")
    assert shapely.Polygon(outline.polygon(1e-4)).is_valid
    tree = cKDTree(outline.vertices)
    far = [tree.query(points + shift)[0].max() for shift in outline.vertices - points[0]]
    assert min(far) < 1e-6


def test_drawn_gap(cli, wrap, tmp_path):
    """A wheel exported, read as a drawing of another case, and exported again."""
    path, drawn = wrap("iso606"), tmp_path / "drawn.dxf"
    assert cli("export", path, "--out", drawn).code == 0
    again = tmp_path / "again.toml"
    text = path.read_text().replace('"iso606"', '"dxf"')
    again.write_text(text.replace("teeth = 12", 'teeth = 12, dxf_file = "drawn.dxf"'))
    out = tmp_path / "again.dxf"
    done = cli("export", again, "--out", out)
    assert done.code == 0, done.err
    before = read_outline(drawn, "NEW").area
    assert read_outline(out, "NEW").area == pytest.approx(before, rel=1e-4)
    assert "by points" in " ".join(texts(out))


def texts(path):
    return [text.dxf.text for text in ezdxf.readfile(path).modelspace().query("TEXT")]


def test_note_and_layers(cli, drive, tmp_path):
    out = tmp_path / "both.dxf"
    assert cli("export", drive(), "--state", "both", "--out", out).code == 0
    layers = {entity.dxf.layer for entity in ezdxf.readfile(out).modelspace()}
    assert layers == {"NEW", "WORN", "PITCH_CIRCLE", "CENTRE", "NOTES"}
    note = " ".join(texts(out))
    for part in ("Test drive (case drive)", " h: 0.02 mm worn", "All in mm", wearsim.__version__):
        assert part in note
    (circle,) = ezdxf.readfile(out).modelspace().query("CIRCLE")
    assert circle.dxf.radius == pytest.approx(20 * 25.4 / (2 * math.pi), rel=1e-12)


@pytest.mark.parametrize("profile", PAIRS)
def test_gear_pair(cli, gears, tmp_path, profile):
    """Both gears at their distance; their flanks touch at the pitch point and nowhere enter each other."""
    path, out = gears(profile), tmp_path / "pair.dxf"
    assert cli("export", path, "--state", "both", "--out", out).code == 0
    space = ezdxf.readfile(out).modelspace()
    found = {
        layer: [np.array(line.get_points("xyb")) for line in space.query(f'LWPOLYLINE[layer=="{layer}"]')]
        for layer in ("PINION_NEW", "WHEEL_NEW", "PINION_WORN", "WHEEL_WORN")
    }
    case = load_case(path)
    pitch_point = case.drive.pair.circles.pinion_radius
    for layer in ("PINION_NEW", "WHEEL_NEW"):
        lines = shapely.MultiLineString([along_arcs(rows) for rows in found[layer]])
        assert lines.distance(shapely.Point(0.0, pitch_point)) < 1e-3
    if profile == "involute":
        assert [len(rows) for rows in found.values()] == [17, 34, 17, 34]
        assert "the case gives no root" in " ".join(texts(out))
        thick = [angle_of_tooth(found[f"{gear}_NEW"][0], gear, case) for gear in ("PINION", "WHEEL")]
        radii = pitch_point, case.drive.pair.circles.wheel_radius
        widths = [angle * radius for angle, radius in zip(thick, radii, strict=True)]
        assert sum(widths) == pytest.approx(2 * math.pi * pitch_point / 17, abs=4 * TOLERANCE)
        return
    solid = {
        layer: shapely.Polygon(Outline(rows[0][:, :2], rows[0][:, 2]).polygon(1e-5))
        for layer, rows in found.items()
    }
    assert all(one.is_valid for one in solid.values())
    # Both may enter the other by the tolerance along the line on which they touch, about 10 mm.
    assert (solid["PINION_NEW"] & solid["WHEEL_NEW"]).area < 2.0 * TOLERANCE * 10.0
    run = wearsim.simulate(case)
    assert worn_area(case, run) == pytest.approx(17 * run.removed_area, rel=1e-4)
    last = run.flank[run.flank["cycles"] == run.flank["cycles"].max()]
    depth = last["wheel_depth_mm"].to_numpy()
    x, y = (last[f"wheel_{axis}_mm"].to_numpy() for axis in "xy")
    about = 0.5 * np.sum(0.5 * (depth[1:] + depth[:-1]) * np.hypot(np.diff(x), np.diff(y)))
    assert worn_area(case, run, wheel=1) == pytest.approx(34 * 2 * about, rel=0.02)


def along_arcs(rows):
    """An open polyline with bulges by fine chords."""
    points, _ = along_ways(rows[:-1, :2], rows[1:, :2], rows[:-1, 2], 1e-6)
    return np.concatenate([points, rows[-1:, :2]])


def angle_of_tooth(rows, gear, case):
    """Angle between both flanks of a tooth on the working pitch circle."""
    circles = case.drive.pair.circles
    x, y = along_arcs(rows).T
    y = y - (0.0 if gear == "PINION" else circles.centre_distance)
    radius = circles.pinion_radius if gear == "PINION" else circles.wheel_radius
    top = int(np.median(np.flatnonzero(np.hypot(x, y) > np.hypot(x, y).max() - TOLERANCE)))
    angles = np.unwrap(np.arctan2(y, x))
    sides = (slice(0, top), slice(len(x) - 1, top, -1))
    first, second = (np.interp(radius, np.hypot(x, y)[s], angles[s]) for s in sides)
    return abs(second - first)


def test_csv(cli, drive, tmp_path):
    path = drive()
    text = cli("export", path, "--state", "both", "--format", "csv", "--out", "-").out
    rows = list(csv.DictReader(io.StringIO(text)))
    assert list(rows[0]) == ["wheel", "state", "tooth", "stretch", "x_mm", "y_mm"]
    new = [row for row in rows if row["state"] == "new"]
    assert {row["stretch"] for row in new} == {"flank", "back_flank", "root", "tip"}
    assert {int(row["tooth"]) for row in new} == set(range(1, 21))
    polygon = shapely.Polygon([(float(row["x_mm"]), float(row["y_mm"])) for row in new])
    out = tmp_path / "new.dxf"
    cli("export", path, "--out", out)
    assert polygon.is_valid
    assert polygon.area == pytest.approx(read_outline(out, "NEW").area, rel=1e-5)


def svg_paths(root, colour):
    """Ends of the pieces of all paths of a colour, in mm of the page."""
    _, _, wide, tall = (float(part) for part in root.get("viewBox").split())
    scale = float(root.get("width").removesuffix("mm")) / wide
    assert float(root.get("height").removesuffix("mm")) / tall == pytest.approx(scale, rel=1e-6)
    styles = "".join(node.text or "" for node in root.iter() if node.tag.endswith("style"))
    classes = set(re.findall(rf"\.(C\w+) {{stroke: {colour}", styles))
    for node in root.iter():
        if node.tag.endswith("path") and node.get("class") in classes:
            yield scale * followed(node.get("d"))


def followed(path):
    """Ends of the pieces of a path: M and L absolute, l and c relative."""
    points = []
    for command, numbers in re.findall(r"([MLlcqz])([^MLlcqz]*)", path):
        rows = np.array(numbers.split(), dtype=float)
        size = {"c": 6, "q": 4}.get(command, 2)
        for row in rows.reshape(-1, size):
            points.append(row[-2:] + (points[-1] if command in "lcq" else 0.0))
    return np.array(points)


def test_svg_is_to_scale(cli, drive, tmp_path):
    """The worn outline's extent in mm of the page is that of the DXF file."""
    path = drive()
    for kind in ("svg", "dxf"):
        assert cli("export", path, "--state", "worn", "--out", tmp_path / f"w.{kind}").code == 0
    root = ET.parse(tmp_path / "w.svg").getroot()  # noqa: S314
    drawn = max(svg_paths(root, "#ff0000"), key=len)
    worn = read_outline(tmp_path / "w.dxf", "WORN").vertices
    extent = worn.max(axis=0) - worn.min(axis=0)
    assert drawn.max(axis=0) - drawn.min(axis=0) == pytest.approx(extent, abs=1e-2)


def pdf_lines(data):
    """Straight lines of a PDF page [mm] and its size."""
    (box,) = re.findall(rb"/MediaBox \[ 0 0 ([\d.]+) ([\d.]+) \]", data)
    streams = re.findall(rb"stream\r?\n(.*?)\r?\nendstream", data, re.DOTALL)
    found = []
    for stream in streams:
        try:
            text = zlib.decompress(stream).decode("latin-1")
        except zlib.error:
            continue
        pieces = re.findall(r"^([\d.-]+) ([\d.-]+) m\n([\d.-]+) ([\d.-]+) l$", text, re.MULTILINE)
        found += [[float(number) for number in piece] for piece in pieces]
    return np.array(found) * 25.4 / 72.0, [float(part) * 25.4 / 72.0 for part in box]


def test_gauge_is_printed_to_scale(cli, drive, tmp_path):
    """An A4 page whose bar is 50 mm long, and which says what to do."""
    path, out = drive(), tmp_path / "gauge.pdf"
    assert cli("export", path, "--template", out).code == 0
    lines, size = pdf_lines(out.read_bytes())
    assert size == pytest.approx([210.0, 297.0], abs=0.01)
    lengths = np.hypot(lines[:, 2] - lines[:, 0], lines[:, 3] - lines[:, 1])
    inside = lengths[lengths < 200.0]  # Beside the edge of the page.
    assert inside.max() == pytest.approx(50.0, abs=0.005)
    ticks = lines[np.abs(lines[:, 0] - lines[:, 2]) < 1e-3]
    assert len(ticks) >= 6


def test_gauge_in_all_formats_is_one(cli, drive, tmp_path):
    path = drive()
    for kind in ("svg", "dxf"):
        assert cli("export", path, "--template", tmp_path / f"g.{kind}").code == 0
    run = wearsim.simulate(load_case(path))
    check_gauge(tmp_path / "g.dxf", last_points(run, 0.92))
    root = ET.parse(tmp_path / "g.svg").getroot()  # noqa: S314
    assert (root.get("width"), root.get("height")) == ("210mm", "297mm")
    note = " ".join(texts(tmp_path / "g.dxf"))
    told = ("20 teeth, chain 16B-1", "critical depth = 0.02 mm", "Print at 100 %", "50 mm")
    way = ("from above along the arrow", "degrees towards W", "Good: it does not go in", "Worn out, replace")
    for part in told + way:
        assert part in note


def test_gauge_looks_for_a_limit_beyond_the_horizon(cli, drive, tmp_path):
    path, folder, out = drive(), tmp_path / "run", tmp_path / "g.dxf"
    assert cli("life", path, "--set", "run.horizon_hours=1", "--out", folder).code == 0
    assert isinstance(WearResult.load(folder).life, wearsim.result.LowerBound)
    assert cli("export", folder, "--template", out).code == 0
    check_gauge(out, last_points(wearsim.simulate(load_case(path)), 0.92))


def test_gears_have_two_gauges(cli, gears, tmp_path):
    out = tmp_path / "g.dxf"
    assert cli("export", gears("involute"), "--template", out).code == 0
    assert len(ezdxf.readfile(out).modelspace().query('LWPOLYLINE[layer=="GAUGE"]')) == 2
    assert {"pinion", "wheel"} <= set(texts(out))


def test_gap_that_never_carries_a_roller_stays_new():
    """28 gaps, every second one: half of them wear."""
    path = Path(__file__).parents[2] / "cases" / "d6-crawler-27t-soil.toml"
    case = load_case(path, ["sprocket.teeth=28", "stop.critical_depth_mm=0.5"])
    (shape,) = wheel_shapes(case, wearsim.simulate(case))
    same = [new is worn for new, worn in zip(shape.new, shape.worn, strict=True)]
    assert same == [False, True] * 14


def test_title_is_data(cli, drive, tmp_path):
    title = '"<b>&%%d ^J \\\\P Зубья"'
    path = drive(title=title)
    for kind in ("dxf", "svg"):
        assert cli("export", path, "--out", tmp_path / f"o.{kind}").code == 0
    assert ezdxf.readfile(tmp_path / "o.dxf").audit().errors == []
    assert "Зубья" in texts(tmp_path / "o.dxf")[0]
    ET.parse(tmp_path / "o.svg")  # noqa: S314


def test_refusals(cli, drive, gears, tmp_path, monkeypatch):
    path = drive()
    out = tmp_path / "o.dxf"
    assert cli("export", path).code == 2
    assert cli("export", path, "--out", tmp_path / "o.xyz").code == 2
    assert cli("export", path, "--template", tmp_path / "o.csv").code == 2
    assert cli("export", path, "--out", "-").code == 2
    assert cli("export", path, "--out", path, "--format", "dxf", "--force").code == 2
    assert cli("export", path, "--out", out, "--template", out).code == 2
    out.write_text("mine")
    assert cli("export", path, "--out", out).code == 2
    assert out.read_text() == "mine"
    assert cli("export", path, "--out", out, "--force").code == 0
    done = cli("export", gears("involute"), "--out", tmp_path / "o.step")
    assert done.code == 2
    assert "no tooth root" in done.err or "wearsim[step]" in done.err
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    done = cli("export", path, "--out", tmp_path / "o.stp")
    assert done.code == 2
    assert "pip install 'wearsim[step]'" in done.err


def test_run_takes_no_settings(cli, drive, tmp_path):
    folder = tmp_path / "run"
    assert cli("life", drive(), "--out", folder).code == 0
    done = cli("export", folder, "--out", tmp_path / "o.dxf", "--set", "load.speed_rpm=9")
    assert done.code == 2
    assert cli("export", folder, "--out", tmp_path / "o.dxf", "--state", "new").code == 0
    with pytest.raises(ValueError):
        read_outline(tmp_path / "o.dxf", "WORN")


def test_table_of_loads_has_no_wheel(cli, tmp_path):
    rows = "\n".join(f"{i},100,-0.01,0.5" for i in range(9))
    (tmp_path / "run.csv").write_text(
        f"arc_length_mm,load_per_width_N_per_mm,flank_curvature_per_mm,slip_ratio\n{rows}\n"
    )
    path = tmp_path / "loads.toml"
    path.write_text(
        'format_version = 1\nchain.designation = "12B-1"\nload.speed_rpm = 9\n'
        'mechanism = { kind = "prescribed", table_file = "run.csv" }\n'
        "wear.specific_wear_rate_mm2_per_N = 1e-10\nstop.critical_depth_mm = 0.1\n"
    )
    done = cli("export", path, "--out", tmp_path / "o.dxf")
    assert done.code == 2
    assert "must have a sprocket or gears" in done.err
