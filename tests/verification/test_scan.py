"""Depths in photographs that `tests/photographs.py` renders of wheels whose wear is known."""

import math

import numpy as np
import pytest

import wearsim
from tests.photographs import Camera, new_gap, picture, wheel, with_pocket, with_worn_tips
from wearsim.geometry.worn_tooth import measurement_over_pins
from wearsim.scanning.over_pins import seated_radius

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


@pytest.mark.parametrize(
    "name", [name if name == "tilted" else pytest.param(name, marks=pytest.mark.slow) for name in CAMERAS]
)
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


@pytest.mark.slow
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
    result = wearsim.simulate(case)
    last = result.flank_columns
    rows = last["cycles"] == last["cycles"].max()
    gap = np.column_stack([last["x_mm"][rows], last["y_mm"][rows]])
    found = scanned(wheel([gap] * 19), Camera(size=(900, 900)), chain=None, case=case)
    assert abs(found.depth - last["depth_mm"][rows].max()) < 3.0 * found.depth_error
    pins, size = found.summary(), result.history_columns["over_pins_mm"][-1]
    assert measurement_over_pins(seated_radius(gap, 0.5 * ROLLER, 19), ROLLER, 19) == pytest.approx(
        size, abs=5e-4
    )
    assert abs(pins["size_over_pins_mm"] - size) < 3.0 * pins["over_pins_se_mm"]
    assert found.gap["depth_mm"][found.gap["new_x_mm"] > 1.0].max() == pytest.approx(
        last["depth_mm"][rows][last["x_mm"][rows] > 1.0].max(), abs=0.02
    )


@pytest.mark.slow
@pytest.mark.parametrize("teeth", [19, 20])
def test_over_pins_of_a_new_wheel(scanned, teeth):
    """The centre of the seat's arc of 0.505 roller diameters is on the pitch circle: pins lie at its bottom.

    Of an odd number of teeth no two gaps are opposite: the distance is shorter by cos(90/z).
    """
    radius = 0.5 * PITCH / math.sin(math.pi / teeth) - 0.005 * ROLLER
    size = 2.0 * radius * (math.cos(0.5 * math.pi / teeth) if teeth % 2 else 1.0) + ROLLER
    gap = new_gap(PITCH, ROLLER, teeth)
    assert measurement_over_pins(seated_radius(gap, 0.5 * ROLLER, teeth), ROLLER, teeth) == pytest.approx(
        size, abs=1e-5
    )
    content = scanned(worn_wheel(teeth), Camera()).summary()
    assert content["pin_diameter_mm"] == ROLLER
    assert abs(content["size_over_pins_mm"] - size) < 3.0 * content["over_pins_se_mm"]
    assert content["over_pins_mm"] == pytest.approx(size - content["size_over_pins_mm"], abs=1e-5)


@pytest.mark.slow
@pytest.mark.parametrize(("depth", "at", "width"), [(0.2, 0.5, 0.2), (0.2, 0.55, 0.15), (0.1, 0.55, 0.2)])
def test_over_pins_of_a_worn_seat(scanned, depth, at, width):
    """Pins sink into pockets at the bottom, as far as their sides let them."""
    new = new_gap(PITCH, ROLLER, 20)
    gap = with_pocket(new, depth, at, width)
    decrease = 2.0 * (seated_radius(new, 0.5 * ROLLER, 20) - seated_radius(gap, 0.5 * ROLLER, 20))
    content = scanned(wheel([gap] * 20), Camera(size=(900, 900))).summary()
    assert abs(content["over_pins_mm"] - decrease) < 2.0 * content["over_pins_se_mm"] < 0.05


@pytest.mark.slow
@pytest.mark.parametrize("mirror", [False, True])
def test_an_asymmetric_form(scanned, mirror):
    case = wearsim.load_case("08b-19t-wrap").with_({"sprocket.profile": "evolute"})
    new = np.column_stack([case.drive.outline.x, case.drive.outline.y])
    camera = Camera(size=(900, 900), mirror=mirror)
    found = scanned(wheel([with_pocket(new, 0.3)] * 19), camera, chain=None, case=case)
    assert found.summary()["worn_flank"] == ("counterclockwise" if mirror else "clockwise")
    assert abs(found.depth - 0.3) < 3.0 * found.depth_error


@pytest.mark.slow
def test_worn_tips(scanned):
    gap = with_worn_tips(with_pocket(new_gap(PITCH, ROLLER, 19), 0.3), 0.3)
    found = scanned(wheel([gap] * 19), Camera())
    assert abs(found.depth - 0.3) < 3.0 * found.depth_error


@pytest.mark.slow
def test_both_flanks_worn(scanned):
    gap = with_pocket(with_pocket(new_gap(PITCH, ROLLER, 19), 0.3)[::-1] * [-1.0, 1.0], 0.25)
    found = scanned(wheel([gap] * 19), Camera(size=(900, 900)))
    assert "both flanks are worn" in found.summary()["warnings"][0]
    assert abs(found.depth - 0.3) < 3.0 * found.depth_error


@pytest.mark.slow
def test_a_bright_rim_is_told(scanned):
    found = scanned(worn_wheel(), Camera(shine=0.15))
    assert "are not clean" in found.summary()["warnings"][0]
    assert abs(found.depth - 0.3) < 3.0 * found.depth_error


@pytest.mark.slow
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
    with pytest.raises(wearsim.CaseError, match=r"differ by|must show as a hole"):
        scanned(worn_wheel(), Camera(), bore=30.0)
