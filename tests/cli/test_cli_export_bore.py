"""``wearsim export`` of a wheel with a bore, a keyway and a hub: DXF, SVG and STL, read again."""

import json
import math
import re
from collections import Counter
from pathlib import Path
from xml.etree import ElementTree as ET

import ezdxf
import numpy as np
import pytest

import wearsim
from wearsim.drive.load_case import load_case
from wearsim.geometry.outline import Outline
from wearsim.report.worn_flank import wheel_shapes

pytestmark = pytest.mark.wide

WRAP = """\
format_version = 1
title = "Wrap"
chain.designation = "08B-1"
mechanism = { kind = "wrap", phases = 2 }
load = { power_kW = 1, speed_rpm = 100 }
wear.specific_wear_rate_mm2_per_N = 1e-9
stop.critical_depth_mm = 0.02
drive = { links = 60 }
run = { method = "per_cycle", cycles_per_update = 10000, horizon_hours = 100 }
[sprocket]
teeth = 13
profile = "iso606"
nodes = 101
"""
STRAND = """\
format_version = 1
title = "Strand"
chain.designation = "16B-1"
load = { power_kW = 3, speed_rpm = 100 }
wear.condition = "hardened, oiled"
stop.critical_depth_mm = 0.02
[sprocket]
teeth = 20
profile = "evolute"
evolute_offset_mm = 5.6
nodes = 51
"""
CASES = {"wrap": WRAP, "strand": STRAND}
BORE, WIDTH, DEPTH, DIAMETER, LENGTH = 22.0, 6.0, 2.8, 34.0, 12.5
KEYWAY = f"keyway_width_mm = {WIDTH}\nkeyway_depth_mm = {DEPTH}\n"
HUB = f"hub_diameter_mm = {DIAMETER}\nhub_length_mm = {LENGTH}\n"
ALL = f"bore_mm = {BORE}\n{KEYWAY}{HUB}"


def hole_area(bore=BORE, width=WIDTH, depth=DEPTH):
    """Disc and rectangle of the keyway, less what they share: half a segment on both sides."""
    radius, half = 0.5 * bore, 0.5 * width
    shared = half * math.sqrt(radius**2 - half**2) + radius**2 * math.asin(half / radius)
    return math.pi * radius**2 + width * (radius + depth) - shared


@pytest.fixture
def write(tmp_path):
    """Function that writes a case with more keys of the sprocket."""

    def write(kind="wrap", more="", name="drive"):
        path = tmp_path / name / "case.toml"
        path.parent.mkdir()
        path.write_text(CASES[kind] + more)
        return path

    return write


def layers(path):
    """Entities of a DXF file by their layers."""
    drawing = ezdxf.readfile(path)
    assert drawing.audit().errors == []
    found = {}
    for entity in drawing.modelspace():
        found.setdefault(entity.dxf.layer, []).append(entity)
    return found


@pytest.mark.parametrize("kind", CASES)
@pytest.mark.parametrize("state", ["new", "both"])
def test_drawing(cli, write, tmp_path, kind, state):
    """One closed contour of an arc and three lines, and a circle; the teeth stay as they are."""
    out, bare = tmp_path / "hub.dxf", tmp_path / "bare.dxf"
    assert cli("export", write(kind, ALL), "--state", state, "--out", out).code == 0
    assert cli("export", write(kind, name="bare"), "--state", state, "--out", bare).code == 0
    found, before = layers(out), layers(bare)
    assert found.keys() - before.keys() == {"BORE", "HUB"}
    (contour,), (circle,) = found["BORE"], found["HUB"]
    assert contour.dxftype() == "LWPOLYLINE"
    assert contour.closed
    rows = np.array(contour.get_points("xyb"))
    assert np.count_nonzero(rows[:, 2]) == 1
    assert len(rows) == 4
    assert Outline(rows[:, :2], rows[:, 2]).area == pytest.approx(hole_area(), abs=1e-9)
    assert rows[:, 1].max() == 0.5 * BORE + DEPTH
    assert rows[:, 0].tolist() == [0.5 * WIDTH, 0.5 * WIDTH, -0.5 * WIDTH, -0.5 * WIDTH]
    assert (circle.dxf.radius, *circle.dxf.center) == (0.5 * DIAMETER, 0.0, 0.0, 0.0)
    for layer in {"NEW", "WORN"} & before.keys():
        (teeth,), (same,) = found[layer], before[layer]
        assert teeth.get_points() == same.get_points()
    note = " ".join(text.dxf.text for text in found["NOTES"])
    assert "bore 22 mm, keyway 6 mm wide and 2.8 mm deep on the centre line of a gap" in note.lower()
    assert "hub 34 mm, 12.5 mm beyond one side of the face" in note.lower()


@pytest.mark.parametrize(("more", "there"), [("bore_mm = 22\n", {"BORE"}), (HUB, {"HUB"})])
def test_only_one_of_them(cli, write, tmp_path, more, there):
    out = tmp_path / "o.dxf"
    assert cli("export", write(more=more), "--out", out).code == 0
    found = layers(out)
    assert found.keys() & {"BORE", "HUB"} == there
    (circle,) = found[there.pop()]
    assert circle.dxftype() == "CIRCLE"


def test_svg_is_to_scale(cli, write, tmp_path):
    """Some path of the page has the size of the bore with its keyway, and one that of the hub."""
    out = tmp_path / "o.svg"
    assert cli("export", write(more=ALL), "--out", out).code == 0
    root = ET.parse(out).getroot()  # noqa: S314
    scale = float(root.get("width").removesuffix("mm")) / float(root.get("viewBox").split()[2])
    sizes = [np.ptp(followed(node.get("d")), axis=0) for node in root.iter() if node.get("d")]
    sizes = scale * np.array(sizes)
    for size in ([BORE, BORE + DEPTH], [DIAMETER, DIAMETER]):
        assert np.abs(sizes - size).max(axis=1).min() < 0.01


def followed(path):
    """Points of a path: M absolute, m, l, c and q relative; Bezier curves by points on them."""
    points = [np.zeros((1, 2))]
    t = np.linspace(0.0, 1.0, 101)[1:, None]
    for command, numbers in re.findall(r"([Mmlcq])([^MmlcqZ]*)", path):
        size = {"c": 6, "q": 4}.get(command, 2)
        for row in np.array(numbers.split(), dtype=float).reshape(-1, size):
            start = 0.0 if command == "M" else points[-1][-1]
            ends = row.reshape(-1, 2)
            if command == "c":
                ends = 3 * t * (1 - t) ** 2 * ends[0] + 3 * t**2 * (1 - t) * ends[1] + t**3 * ends[2]
            points.append(start + ends[-1:] if command == "q" else start + ends)
    return np.concatenate(points[1:])


def triangles(path):
    data = path.read_bytes()
    records = np.frombuffer(data[84:], np.dtype([("v", "<f4", (4, 3)), ("a", "<u2")]))
    assert int.from_bytes(data[80:84], "little") == len(records)
    return records["v"][:, 1:].astype(float)


def volume(corners):
    """By the divergence theorem: a sixth of the triple products of all triangles."""
    a, b, c = corners.transpose(1, 0, 2)
    return float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6.0


@pytest.mark.parametrize("kind", CASES)
@pytest.mark.parametrize("state", ["new", "worn"])
@pytest.mark.parametrize(
    ("more", "hole", "length"),
    [
        ("", 0.0, 0.0),
        ("bore_mm = 22\n", math.pi * 0.25 * BORE**2, 0.0),
        (f"bore_mm = 22\n{KEYWAY}", hole_area(), 0.0),
        (HUB, 0.0, LENGTH),
        (ALL, hole_area(), LENGTH),
    ],
    ids=["bare", "bore", "keyway", "hub", "all"],
)
def test_surface(cli, write, tmp_path, kind, state, more, hole, length):
    """Volume of the plate and of the hub less the hole through both; every edge is in two triangles."""
    path, out = write(kind, more), tmp_path / "o.stl"
    assert cli("export", path, "--state", state, "--out", out).code == 0
    case = load_case(path)
    (shape,) = wheel_shapes(case, wearsim.simulate(case) if state == "worn" else None)
    (chain,) = shape.chains(state)
    plate, hub = chain.outline.area * shape.width, math.pi * 0.25 * DIAMETER**2 * length
    corners = triangles(out)
    expected = plate + hub - hole * (shape.width + length)
    # A surface 1e-3 mm off at most, and coordinates of single precision.
    ways = chain.outline.polygon(1e-3)
    around = np.hypot(*(ways - np.roll(ways, 1, axis=0)).T).sum() + math.pi * (BORE + DIAMETER)
    assert volume(corners) == pytest.approx(expected, abs=1e-3 * around * (shape.width + length))
    assert corners[:, :, 2].max() == pytest.approx(shape.width + length, rel=1e-6)
    edges = Counter()
    for a, b, c in corners.tolist():
        edges.update(zip(map(tuple, (a, b, c)), map(tuple, (b, c, a)), strict=True))
    assert all(count == edges[end, start] for (start, end), count in edges.items())


def test_drawn_wheel_comes_back(cli, write, tmp_path):
    """The reader of drawings passes over bore and hub."""
    assert cli("export", write(more=ALL), "--out", tmp_path / "drawn.dxf").code == 0
    again = tmp_path / "again.toml"
    again.write_text(WRAP.replace('"iso606"', '"dxf"\ndxf_file = "drawn.dxf"'))
    drawn, given = load_case(again).drive, load_case(write(name="bare")).drive
    assert drawn.blank_area() == pytest.approx(given.blank_area(), rel=1e-4)


@pytest.mark.parametrize("kind", CASES)
def test_wear_and_gauge_do_not_change(cli, write, tmp_path, kind):
    """Every number of the run, and the gauge to the byte; the answer names bore and hub."""
    answers = {}
    for name, more in {"bare": "", "hub": ALL}.items():
        out, gauge = tmp_path / name / "run", tmp_path / f"{name}.svg"
        done = cli("life", write(kind, more, name), "--out", out, "--json")
        assert cli("export", out, "--template", gauge).code == 0
        answers[name] = json.loads(done.out)
        answers[name]["gauge"] = gauge.read_bytes()
        answers[name]["tables"] = [(out / f"{table}.csv").read_bytes() for table in ("flank", "history")]
    bare, hub = answers["bare"], answers["hub"]
    assert bare["tables"] == hub["tables"]
    assert bare["gauge"] == hub["gauge"]
    for answer in (bare, hub):
        del answer["gauge"], answer["tables"]
    assert {**hub, "assumptions": bare["assumptions"]} == bare
    said = "bore 22 mm, keyway 6 mm wide and 2.8 mm deep on the centre line of a gap, hub 34 mm, 12.5 mm"
    assert [text for text in hub["assumptions"] if text not in bare["assumptions"]] == [
        f"{said} beyond one side of the face: of the exported wheel; the wear does not change"
    ]


ROOT = 12.7 / math.sin(math.pi / 13) - 2 * 0.505 * 8.51
FAULTS = {
    "bore_mm = 44.5\n": {"bore_mm": f"below the root diameter of the gaps, {ROOT:.5g} mm (got 44.5)"},
    KEYWAY: {
        "keyway_width_mm": "needs bore_mm, which is missing",
        "keyway_depth_mm": "needs bore_mm, which is missing",
    },
    "keyway_width_mm = 6\n": {"keyway_width_mm": "needs bore_mm and keyway_depth_mm, which are missing"},
    "hub_diameter_mm = 30\n": {"hub_diameter_mm": "needs hub_length_mm, which is missing"},
    "hub_length_mm = 30\n": {"hub_length_mm": "needs hub_diameter_mm, which is missing"},
    f"bore_mm = 6\n{KEYWAY}": {"keyway_width_mm": "below the bore of 6 mm (got 6)"},
    f"bore_mm = 39\n{KEYWAY}": {"keyway_depth_mm": f"inside the root diameter of {ROOT:.5g} mm"},
    f"bore_mm = 28.4\n{KEYWAY}{HUB}": {"keyway_depth_mm": "inside the hub of 34 mm, but lie on 34.525 mm"},
    f"bore_mm = 34\n{HUB}": {"hub_diameter_mm": "above the bore of 34 mm (got 34)"},
    "hub_diameter_mm = 45\nhub_length_mm = 1\n": {"hub_diameter_mm": "below the root diameter"},
    "bore_mm = 50\nkeyway_width_mm = 60\nkeyway_depth_mm = 1\nhub_diameter_mm = 48\n": {
        "bore_mm": "below the root diameter",
        "keyway_width_mm": "below the bore of 50 mm (got 60)",
        "hub_diameter_mm": "needs hub_length_mm|above the bore of 50 mm|below the root diameter",
    },
    "bore_mm = 0\n": {"bore_mm": "greater than 0"},
}


@pytest.mark.parametrize("more", FAULTS)
def test_faults(cli, write, more):
    """Each at its line, all in one pass."""
    path = write(more=more)
    done = cli("check", path)
    assert done.code == 2
    lines = path.read_text().splitlines()
    for key, words in FAULTS[more].items():
        number = 1 + next(n for n, line in enumerate(lines) if line.startswith(f"{key} ="))
        found = [line for line in done.err.splitlines() if f":{number}: sprocket.{key}: " in line]
        assert all(any(word in line for line in found) for word in words.split("|")), done.err
    assert len(done.err.splitlines()) == sum(words.count("|") + 1 for words in FAULTS[more].values())


def test_faults_beside_others(cli, write):
    path = write(more="bore_mm = 44.5\n")
    done = cli("check", path, "--set", "drive.links=12", "--set", "stop.min_tip_land_mm=-1")
    assert done.code == 2
    assert "sprocket.bore_mm" in done.err
    assert "drive.links" in done.err


def test_sprockets_of_a_drive(cli, tmp_path):
    path = tmp_path / "drive.toml"
    head, _, sprocket = WRAP.partition("[sprocket]\n")
    head = head.replace('kind = "wrap", ', "")
    path.write_text(f"{head}[[sprocket]]\n{sprocket}{ALL}[[sprocket]]\n{sprocket}")
    assert cli("check", path).code == 0
    done = cli("check", path, "--set", "sprocket.2.bore_mm=50")
    assert done.code == 2
    assert "sprocket.2.bore_mm: must be below the root diameter" in done.err


def test_worn_down_to_the_hub(cli, write, tmp_path):
    """A hub just below the new root is above the worn one."""
    path = Path(__file__).parents[2] / "cases" / "520-15t-wrap.toml"
    keys = ("sprocket.hub_length_mm=5", "sprocket.hub_diameter_mm=66.067", "sprocket.nodes=101")
    settings = [word for key in (*keys, "run.life_tolerance=0.1") for word in ("--set", key)]
    run = tmp_path / "run"
    assert cli("life", path, "--out", run, *settings).code == 0
    for kind in ("dxf", "stl"):
        out = tmp_path / f"o.{kind}"
        assert cli("export", run, "--out", out, "--state", "new").code == 0
        done = cli("export", run, "--out", out, "--state", "worn", "--force")
        assert done.code == 2
        assert "sprocket.hub_diameter_mm: must stay below the root diameter of the worn gaps" in done.err


def test_surface_of_one_state_and_of_closed_wheels(cli, write, tmp_path):
    done = cli("export", write(), "--state", "both", "--out", tmp_path / "o.stl")
    assert done.code == 2
    assert "give --state new or --state worn" in done.err
    gears = tmp_path / "gears.toml"
    gears.write_text(
        "format_version = 1\ngear = {profile = 'involute', pinion_teeth = 17, wheel_teeth = 34, "
        "module_mm = 4.5, face_width_mm = 20, nodes = 101}\nload = {torque_N_m = 100, speed_rpm = 100}\n"
        "wear.specific_wear_rate_mm2_per_N = 1e-10\nstop.critical_depth_mm = 0.05\n"
    )
    done = cli("export", gears, "--out", tmp_path / "o.stl")
    assert done.code == 2
    assert "no tooth root" in done.err
