"""Scale and tilt by a marker sheet in pictures that `tests/photographs.py` renders of the sheet as printed.

The renderer takes the written PNG file for the print. Teeth are as thick as an ISO 606 tooth of 08B, 7.2 mm.
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from PIL import ExifTags, Image

import wearsim
from tests.photographs import Camera, Print, new_gap, photographed, picture, wheel, with_pocket

PITCH, ROLLER, THICKNESS = 12.7, 8.51, 7.2
TEETH, DEPTH = 15, 0.3
ORIGIN = (105.0, 175.0)
"""Middle of the free circle on A4, from the lower left [mm]."""

OUTLINE = wheel([with_pocket(new_gap(PITCH, ROLLER, TEETH), DEPTH)] * TEETH)
RADIUS = float(np.hypot(*OUTLINE.T).max())
SIZE, SCALE = (720, 960), 3.1


def over_sheet(printed, away=600.0, chamfer=0.8, **others):
    """Return a camera so far above a sheet [mm], and 3.1 pixels to a millimetre there."""
    return Camera(
        size=SIZE,
        wheel=2.0 * RADIUS * SCALE / min(SIZE),
        distance=away / (2.0 * RADIUS),
        edges=(chamfer, THICKNESS - chamfer),
        printed=printed,
        **others,
    )


def true_scale(camera):
    """Return pixels of a millimetre at the axis, in the middle plane of the teeth."""
    ends = 0.1 * np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    seen, _ = photographed(ends, RADIUS, camera, 0.5 * THICKNESS)
    return 10.0 * math.sqrt(abs(np.linalg.det(seen[1:] - seen[0])))


@pytest.fixture(scope="module")
def sheet(tmp_path_factory):
    """The file of the sheet on A4."""
    from click.testing import CliRunner

    from wearsim.scanning.command import scan

    path = tmp_path_factory.mktemp("sheet") / "sheet.png"
    done = CliRunner().invoke(scan, ["--sheet", str(path)])
    assert done.exit_code == 0, done.output
    return path


@pytest.fixture
def scanned(tmp_path):
    """Function that photographs the wheel on a sheet and scans the file, which holds the focal length."""

    def scan(camera, **options):
        focal_length = SCALE * 2.0 * RADIUS * camera.distance
        exif = Image.Exif()
        noted = focal_length * math.hypot(24.0, 36.0) / math.hypot(*SIZE)
        exif[ExifTags.IFD.Exif] = {ExifTags.Base.FocalLengthIn35mmFilm: round(noted)}
        picture(OUTLINE, camera).save(tmp_path / "wheel.jpg", exif=exif, quality=97)
        return wearsim.scan(tmp_path / "wheel.jpg", **{"chain": "08B", **options})

    return scan


def test_ruler_and_dots_as_they_are_drawn(sheet):
    """On paper the outer ticks are 100 mm apart, and the middles of the outermost dots of a row 180 mm."""
    with Image.open(sheet) as file:
        assert file.info["dpi"][0] == pytest.approx(300.0, abs=0.01)
        dark = np.asarray(file.convert("L")) < 128
    rows = [row for row in dark if 1000 < np.count_nonzero(row) < 1300]
    ruler = np.flatnonzero(max(rows, key=np.count_nonzero))
    assert (ruler[-1] - ruler[0]) * 25.4 / 300.0 == pytest.approx(100.0, abs=0.3)
    middle = np.flatnonzero(dark[round(dark.shape[0] - ORIGIN[1] * 300.0 / 25.4)])
    assert (middle[-1] - middle[0]) * 25.4 / 300.0 == pytest.approx(186.0, abs=0.2)


def test_scale_tilt_lens_and_depth(scanned, sheet):
    camera = over_sheet(
        Print.of(sheet, at=ORIGIN, turn=0.4),
        tilt=math.radians(6.0),
        tilt_direction=2.0,
        distortion=-0.02,
        uneven=0.3,
    )
    found = scanned(camera)
    content, known = found.summary(), found.found.depths.place.known
    assert content["warnings"] == []
    assert known.scale == pytest.approx(true_scale(camera), rel=5e-4)
    assert content["camera_tilt_degrees"] == pytest.approx(6.0, abs=0.1)
    assert content["camera_height_mm"] == pytest.approx(600.0 * math.cos(camera.tilt), rel=0.03)
    assert content["lens_distortion"] == pytest.approx(-0.02, abs=5e-4)
    assert content["mirrored"] is False
    assert abs(found.depth - DEPTH) < 3.0 * found.depth_error
    assert "by the marker sheet" in found.text


@pytest.mark.slow
def test_standard_errors_of_30_prints(scanned, sheet):
    """Printers stretch by 0.2 % (standard deviation), as is assumed; chamfers take up to a quarter."""
    over = []
    for seed in range(30):
        rng = np.random.default_rng(seed)
        stretch = 1.0 + 0.002 * rng.standard_normal()
        at = np.array(ORIGIN) + rng.uniform(-8.0, 8.0, 2)
        camera = over_sheet(
            Print.of(sheet, stretch, at=tuple(at), turn=rng.uniform(-0.3, 0.3)),
            away=rng.uniform(400.0, 1000.0),
            chamfer=rng.uniform(0.0, 0.25) * THICKNESS,
            tilt=math.radians(rng.uniform(0.0, 8.0)),
            tilt_direction=rng.uniform(0.0, math.tau),
            turn=rng.uniform(0.0, math.tau),
            distortion=rng.normal(0.0, 0.01),
            blur=rng.uniform(0.6, 1.2),
            noise=rng.uniform(0.002, 0.015),
            uneven=rng.uniform(0.0, 0.3),
            seed=seed,
        )
        found = scanned(camera)
        known, seen = found.found.depths.place.known, found.found.sheet.camera
        over.append(
            (
                (known.scale / true_scale(camera) - 1.0) / known.error,
                (seen.tilt - camera.tilt) / seen.tilt_error,
                (found.depth - DEPTH) / found.depth_error,
            )
        )
    off = np.abs(over)
    assert (off < 1.0).mean(axis=0).min() >= 0.6
    assert (off < 2.0).mean(axis=0).min() >= 0.9
    assert off.max() < 3.5


@pytest.mark.slow
def test_a_chain_of_like_form_is_refused(scanned, sheet):
    """Teeth of 10B look like those of 08B, 1.25 times as large."""
    with pytest.raises(wearsim.CaseError, match=r"marker sheet .* differ by -2\d\.\d %"):
        scanned(over_sheet(Print.of(sheet, at=ORIGIN)), chain="06B")
    with pytest.raises(wearsim.CaseError, match=r"marker sheet .* differ by \+2\d\.\d %"):
        scanned(over_sheet(Print.of(sheet, at=ORIGIN)), chain="10B")


@pytest.mark.slow
def test_a_print_that_was_fitted_to_the_page(scanned, sheet):
    camera = over_sheet(Print.of(sheet, 0.97, at=ORIGIN))
    (warning,) = scanned(camera).warnings
    assert "ruler" in warning
    assert "differs by -2.9 %" in warning or "differs by -3.0 %" in warning
    found = scanned(camera, ruler=97.0)
    assert found.warnings == ()
    assert found.found.depths.place.known.scale == pytest.approx(true_scale(camera), rel=1e-3)


@pytest.mark.slow
def test_a_height_that_is_not_known_is_told(sheet, tmp_path):
    """35 mm are assumed without a note; the camera of 700 mm and 5 pixels per mm has 3500 pixels, 84 mm."""
    camera = replace(
        over_sheet(Print.of(sheet, at=ORIGIN), away=700.0),
        size=(1500, 1500),
        wheel=2.0 * RADIUS * 5.0 / 1500.0,
    )
    picture(OUTLINE, camera).save(tmp_path / "wheel.png")
    found = wearsim.scan(tmp_path / "wheel.png", chain="08B")
    scales, height = found.warnings
    assert "as the height of the camera is un" in scales
    assert "by more than its standard error" in height
    assert abs(found.depth - DEPTH) < 3.0 * found.depth_error


@pytest.mark.parametrize(("bulge", "message"), [(4.0, "is not flat"), (12.0, "must be flat")])
def test_a_sheet_that_is_not_flat(scanned, sheet, bulge, message):
    camera = over_sheet(Print.of(sheet, at=ORIGIN, bulge=bulge), away=400.0)
    if bulge < 10.0:
        assert any(message in one for one in scanned(camera).warnings)
        return
    with pytest.raises(wearsim.CaseError, match=message):
        scanned(camera)


@pytest.mark.slow
@pytest.mark.parametrize("part", ["hand", "cut"])
def test_half_of_the_dots_suffice(scanned, sheet, part):
    printed = Print.of(sheet, at=ORIGIN)
    page = printed.page.copy()
    if part == "hand":
        page[:, : round(35.0 * printed.per_mm)] = 0.2
    else:
        page[: round(70.0 * printed.per_mm)] = -1.0
    camera = over_sheet(replace(printed, page=page, table=0.1), tilt=math.radians(4.0))
    found = scanned(camera)
    assert 60 < found.summary()["sheet_dots"] < 160
    assert found.found.depths.place.known.scale == pytest.approx(true_scale(camera), rel=1e-3)
    assert abs(found.depth - DEPTH) < 3.0 * found.depth_error


def test_two_sheets_are_refused(scanned, sheet):
    printed = Print.of(sheet, at=(105.0, 130.0))
    part, between = printed.page[-2200:-750], np.ones((290, printed.page.shape[1]), dtype=np.float32)
    page = np.concatenate([part, between, part])
    with pytest.raises(wearsim.CaseError, match="one marker sheet must be in the picture"):
        scanned(over_sheet(replace(printed, page=page)))


def test_a_ruler_without_a_sheet_is_refused(scanned):
    with pytest.raises(wearsim.CaseError, match="too few dots were found"):
        scanned(Camera(size=SIZE, distance=8.0), ruler=100.0)


def test_a_thickness_without_a_sheet_is_refused(scanned):
    with pytest.raises(wearsim.CaseError, match="leave the thickness out"):
        scanned(Camera(size=SIZE, distance=8.0), thickness=THICKNESS)


@pytest.mark.parametrize("thickness", [120.0, 1e6])
def test_teeth_as_thick_as_the_camera_is_high_are_refused(scanned, sheet, thickness):
    with pytest.raises(wearsim.CaseError, match="the teeth must be thinner than 6"):
        scanned(over_sheet(Print.of(sheet, at=ORIGIN), tilt=math.radians(6.0)), thickness=thickness)


@pytest.mark.slow
def test_a_mirrored_picture_is_told(scanned, sheet):
    found = scanned(over_sheet(Print.of(sheet, at=ORIGIN), mirror=True))
    assert found.summary()["mirrored"] is True
    assert "mirror image" in found.warnings[0]
