"""``wearsim export --format step``: solids, read again. Takes build123d."""

import math
from pathlib import Path

import pytest

import wearsim
from wearsim.cad.step import step_bytes
from wearsim.drive.load_case import load_case
from wearsim.report.worn_flank import wheel_shapes

pytestmark = pytest.mark.slow

CASES = Path(__file__).parents[2] / "cases"


@pytest.mark.parametrize(
    ("name", "states"),
    [("16b-20t-oiled", ("new", "worn")), ("convex-concave-17t-mild", ("new",)), ("a40-19t-rating", ("new",))],
)
def test_volume_is_area_times_width(tmp_path, name, states):
    build123d = pytest.importorskip("build123d", reason="build123d is not installed")
    case = load_case(CASES / f"{name}.toml")
    shapes = wheel_shapes(case, wearsim.simulate(case) if "worn" in states else None)
    path = tmp_path / "wheel.step"
    path.write_bytes(step_bytes(shapes, states))
    solids = build123d.import_step(path).solids()
    expected = [shape.chains(state)[0].outline.area * shape.width for shape in shapes for state in states]
    assert all(one.is_valid for one in solids)
    assert [one.volume for one in solids] == pytest.approx(expected, rel=1e-6)


KEYWAY = ("sprocket.bore_mm=30", "sprocket.keyway_width_mm=8", "sprocket.keyway_depth_mm=3.3")
HUB = ("sprocket.hub_diameter_mm=50", "sprocket.hub_length_mm=25")
SHARED = 4 * math.sqrt(15**2 - 4**2) + 15**2 * math.asin(4 / 15)
DISC, HOLE = math.pi * 15**2, math.pi * 15**2 + 8 * (15 + 3.3) - SHARED


@pytest.mark.parametrize("name", ["16b-20t-oiled", "a40-19t-rating"])
@pytest.mark.parametrize(
    ("settings", "hole", "length", "more_faces"),
    [
        (KEYWAY[:1], DISC, 0.0, 1),  # the bore
        (KEYWAY, HOLE, 0.0, 4),  # and the three of the keyway
        (HUB, 0.0, 25.0, 2),  # the hub and its end
        ((*KEYWAY, *HUB), HOLE, 25.0, 6),
    ],
    ids=["bore", "keyway", "hub", "all"],
)
def test_bore_and_hub(tmp_path, name, settings, hole, length, more_faces):
    """The hole goes through face and hub; the faces of the teeth stay as they are."""
    build123d = pytest.importorskip("build123d", reason="build123d is not installed")
    path, found = tmp_path / "wheel.step", []
    for given in ((), settings):
        (shape,) = wheel_shapes(load_case(CASES / f"{name}.toml", list(given)), None)
        path.write_bytes(step_bytes([shape], ("new",)))
        (one,) = build123d.import_step(path).solids()
        found.append(one)
    bare, one = found
    assert one.is_valid
    assert one.volume - bare.volume == pytest.approx(
        math.pi * 25**2 * length - hole * (shape.width + length), rel=1e-9
    )
    assert len(one.faces()) - len(bare.faces()) == more_faces
    heights = sorted({round(corner.Z, 6) for corner in one.vertices()})
    assert heights == pytest.approx([0.0, shape.width, shape.width + length][: 2 + bool(length)], abs=1e-6)
