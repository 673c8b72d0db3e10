"""Depths in photographs that `tests/photographs.py` renders of wheels whose wear is known."""

import math

import numpy as np
import pytest

import wearsim
from tests.photographs import Camera, new_gap, picture, wheel, with_pocket

PITCH, ROLLER = 12.7, 8.51


def worn_wheel(teeth=19, depth=0.3, form="iso606"):
    """Return a wheel whose gaps are worn on their left side, where teeth face clockwise."""
    return wheel([with_pocket(new_gap(PITCH, ROLLER, teeth, form), depth)] * teeth)


@pytest.fixture
def scanned(tmp_path):
    """Function that photographs a wheel and scans the file."""

    def scan(outline, camera, name="wheel.png", **options):
        picture(outline, camera).save(tmp_path / name)
        return wearsim.scan(tmp_path / name, **{"chain": "08B", **options})

    return scan


CAMERAS = {
    "straight": Camera(),
    "turned": Camera(turn=2.0, wheel=0.7, centre=(0.46, 0.53)),
    "tilted": Camera(tilt=math.radians(8.0), tilt_direction=1.0, distance=4.0),
    "blurred": Camera(blur=1.5),
    "noisy": Camera(noise=0.03),
    "JPEG": Camera(jpeg=80),
    "uneven light": Camera(uneven=0.6),
    "bright on dark": Camera(wheel_light=0.7, ground_light=0.05),
    "dirty": Camera(dirt=4),
    "lens": Camera(distortion=0.003),
    "other tone curve": Camera(gamma=1.9),
}


@pytest.mark.parametrize("name", CAMERAS)
def test_depth_of_a_pocket(scanned, name):
    found = scanned(worn_wheel(), CAMERAS[name])
    content = found.summary()
    assert (content["teeth"], content["worn_flank"], content["warnings"]) == (19, "clockwise", [])
    off = found.depth - 0.3
    assert abs(off) * content["scale_px_per_mm"] < 0.3
    assert abs(off) < 3.0 * found.depth_error
    assert np.median(content["teeth_depth_mm"]) == pytest.approx(found.depth, abs=2.0 * found.depth_error)


def test_a_mirrored_wheel_is_worn_on_the_other_flank(scanned):
    assert scanned(worn_wheel(), Camera(mirror=True)).summary()["worn_flank"] == "counterclockwise"


def test_a_new_wheel_has_no_wear(scanned):
    content = scanned(worn_wheel(depth=0.0), Camera()).summary()
    assert not content["is_worn"]
    assert content["worn_flank"] is None
    assert abs(content["depth_mm"]) < 2.0 * content["depth_se_mm"]


def test_one_tooth_of_twice_the_wear(scanned):
    new = new_gap(PITCH, ROLLER, 15)
    outline = wheel([with_pocket(new, 0.6), *[with_pocket(new, 0.3)] * 14])
    depths = scanned(outline, Camera()).summary()["teeth_depth_mm"]
    assert sorted(depths)[-2:] == pytest.approx([0.3, 0.6], abs=0.06)


@pytest.mark.parametrize(("teeth", "form"), [(9, "gost591"), (40, "ansi_b29")])
def test_other_wheels(scanned, teeth, form):
    camera = Camera(size=(900, 900), turn=0.1)
    found = scanned(worn_wheel(teeth, 0.2, form), camera, profile=form)
    assert found.summary()["teeth"] == teeth
    assert abs(found.depth - 0.2) < 3.0 * found.depth_error


def test_a_wheel_that_wearsim_wore(scanned):
    """The mean depth along the gap is that of the life, on both of its sides."""
    case = wearsim.load_case("08b-19t-wrap").with_(
        {"sprocket.nodes": 201, "mechanism.phases": 1, "run.life_tolerance": 0.1}
    )
    last = wearsim.simulate(case).flank_columns
    rows = last["cycles"] == last["cycles"].max()
    gap = np.column_stack([last["x_mm"][rows], last["y_mm"][rows]])
    found = scanned(wheel([gap] * 19), Camera(size=(900, 900)), chain=None, case=case)
    assert abs(found.depth - last["depth_mm"][rows].max()) < 3.0 * found.depth_error
    assert found.gap["depth_mm"][found.gap["new_x_mm"] > 1.0].max() == pytest.approx(
        last["depth_mm"][rows][last["x_mm"][rows] > 1.0].max(), abs=0.02
    )


def test_scales_from_elsewhere(scanned):
    """The bore has a fifth of the tip diameter; the wheel fills 0.8 of 600 pixels."""
    tip = 2.0 * float(np.hypot(*new_gap(PITCH, ROLLER, 19)[0]))
    pixels = 480.0 / tip
    for options in (
        {"bore": 0.2 * tip},
        {"dpi": 25.4 * pixels},
        {"scale": (60.0, 300.0, 540.0, 300.0, 480.0 / pixels)},
    ):
        found = scanned(worn_wheel(), Camera(), **options)
        assert found.summary()["scale_px_per_mm"] == pytest.approx(pixels, rel=2e-3)
        assert abs(found.depth - 0.3) < 3.0 * found.depth_error


def test_a_wrong_bore_is_told(scanned):
    with pytest.raises(wearsim.CaseError, match=r"differ by|must be seen as a hole"):
        scanned(worn_wheel(), Camera(), bore=30.0)
