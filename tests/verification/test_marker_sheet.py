"""Scale and tilt by a marker sheet in pictures that `tests/photographs.py` renders of the sheet as printed.

The renderer takes the written PNG file for the print. Teeth are as thick as an ISO 606 tooth of 08B, 7.2 mm.
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from PIL import ExifTags, Image

import wearsim
from tests.photographs import Camera, Print, chain_beside, new_gap, photographed, picture, wheel, with_pocket
from wearsim.catalogue.catalogues import Chain
from wearsim.scanning.chain_beside import check_width
from wearsim.scanning.new_wheel import chain_named
from wearsim.scanning.photograph import Photograph

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


def focal_length(camera):
    """Return what a camera notes of its lens."""
    noted = SCALE * 2.0 * RADIUS * camera.distance * math.hypot(24.0, 36.0) / math.hypot(*SIZE)
    exif = Image.Exif()
    exif[ExifTags.IFD.Exif] = {ExifTags.Base.FocalLengthIn35mmFilm: round(noted)}
    return exif


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
        picture(OUTLINE, camera).save(tmp_path / "wheel.jpg", exif=focal_length(camera), quality=97)
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
    """50 mm are assumed without a note; the camera of 700 mm and 5 pixels per mm has 3500 pixels, 71 mm."""
    camera = replace(
        over_sheet(Print.of(sheet, at=ORIGIN), away=700.0),
        size=(1500, 1500),
        wheel=2.0 * RADIUS * 5.0 / 1500.0,
    )
    picture(OUTLINE, camera).save(tmp_path / "wheel.png")
    found = wearsim.scan(tmp_path / "wheel.png", chain="08B")
    (height,) = found.warnings
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


def test_a_wheel_too_large_for_the_sheet(sheet, tmp_path):
    """190 mm over the tips, over a free circle of 2 x (90 - 6) mm."""
    outline = wheel([new_gap(25.4, 15.88, 22)] * 22)
    radius = float(np.hypot(*outline.T).max())
    camera = Camera(
        size=(1000, 1300),
        wheel=2.0 * radius * 3.9 / 1000.0,
        distance=350.0 / radius,
        edges=(0.8, 14.0),
        printed=Print.of(sheet, at=ORIGIN),
    )
    picture(outline, camera).save(tmp_path / "wheel.png")
    with pytest.raises(wearsim.CaseError, match="168 mm wide by the dots that are seen, but has 190 mm"):
        wearsim.scan(tmp_path / "wheel.png", chain="16B")


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


PLATE, WIDTH = 11.8, 17.0
"""Height of the plates of a chain 08B, and its width over the ends of a pin [mm]."""


@pytest.fixture
def with_chain(sheet, tmp_path):
    """Function that photographs a chain of 13 links beside the wheel and measures some of them."""

    def scan(elongation, links=10, first=1, bow=0.0, asked=None, noted=True, width=WIDTH, off=0.0, **others):
        camera = over_sheet(Print.of(sheet, at=ORIGIN), turn=0.0, tilt=math.radians(3.0), **others)
        faces, pins = chain_beside(PITCH, PLATE, WIDTH, 13, (-99.0, -80.0), 0.5 * math.pi, elongation, bow)
        exif = focal_length(camera) if noted else Image.Exif()
        picture(OUTLINE, camera, beside=faces).save(tmp_path / "wheel.png", exif=exif)
        ends, _ = photographed(pins[[first, first + links]], RADIUS, camera, 0.95 * WIDTH)
        ends = ends + np.array([[1.5, -2.0], [-1.0, 2.5]]) + off
        return wearsim.scan(
            tmp_path / "wheel.png",
            chain="08B",
            chain_beside=(*ends.ravel(), asked or links),
            chain_width=width,
        )

    return scan


def test_a_chain_beside_the_wheel(with_chain):
    """Both are measured, each as without the other."""
    found = with_chain(1.5)
    content = found.summary()
    assert content["chain_links"] == 10
    assert content["chain_length_mm"] == pytest.approx(
        10.0 * PITCH * (1.0 + content["chain_elongation_percent"] / 100.0)
    )
    off = found.chain_elongation - 1.5
    assert abs(off) < 2.0 * content["chain_elongation_se_percent"]
    assert abs(found.depth - DEPTH) < 3.0 * found.depth_error
    assert "longer than new: 10 links measure" in found.text


@pytest.mark.slow
def test_elongation_moves_with_the_chain_alone(with_chain):
    """What sheet and height leave uncertain is the same in all pictures of a camera."""
    off = [with_chain(one).chain_elongation - one for one in (0.0, 1.0, 2.0, 3.0)]
    assert np.ptp(off) < 0.12
    for away in ([5.0, 6.0], [-6.0, 4.0], [[4.0, -6.0], [-4.0, 6.0]]):
        assert with_chain(1.0, off=np.array(away)).chain_elongation - 1.0 == pytest.approx(off[1], abs=0.02)
    assert with_chain(1.0, links=4, first=3).chain_elongation - 1.0 == pytest.approx(off[1], abs=0.15)


@pytest.mark.slow
def test_a_bent_chain_is_told(with_chain):
    (warning,) = [one for one in with_chain(1.0, bow=-12.0).warnings if "straight" in one]
    assert "lay it along a ruler" in warning


@pytest.mark.slow
@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"asked": 8}, r"there must be 8 links between .* but 10 of 12\.7 mm are seen"),
        ({"asked": 4}, "must be 4 links of 12.7 mm apart, but lie 1"),
        ({"asked": 9}, r"must be even, .* \(got 9\)"),
        ({"width": 12.0}, "must be 14 to 25.6 mm wide over the ends of a pin, but 12 mm is given"),
    ],
)
def test_links_that_are_miscounted(with_chain, options, message):
    with pytest.raises(wearsim.CaseError, match=message):
        with_chain(1.0, **options)


def test_widths_of_standard_chains_are_taken():
    """Over the pins by ISO 606 and DIN 8187; of two strands whose distance is not known any."""
    pixels = Photograph("wheel.png", np.zeros((2, 2), dtype=np.float32))
    for name, width in (
        ("05B", 8.6),
        ("08B", 17.0),
        ("12B", 22.7),
        ("16B", 36.1),
        ("081", 10.2),
        ("08B-2", 31.0),
    ):
        check_width(pixels, chain_named(name), width)
    own = Chain("", 12.7, 8.51, 7.75, strands=2)
    check_width(pixels, own, 31.0)


@pytest.mark.slow
def test_a_chain_that_points_at_the_wheel_is_named(sheet, tmp_path):
    camera = over_sheet(Print.of(sheet, at=ORIGIN), turn=0.0)
    faces, pins = chain_beside(PITCH, PLATE, WIDTH, 6, (0.0, -113.0), 0.5 * math.pi, 1.0)
    picture(OUTLINE, camera, beside=faces).save(tmp_path / "wheel.png", exif=focal_length(camera))
    ends, _ = photographed(pins[[1, 5]], RADIUS, camera, 0.95 * WIDTH)
    with pytest.raises(wearsim.CaseError, match="lay the chain so that its line passes beside the sprocket"):
        wearsim.scan(tmp_path / "wheel.png", chain="08B", chain_beside=(*ends.ravel(), 4), chain_width=WIDTH)


@pytest.mark.parametrize(
    ("beside", "width", "message"),
    [
        (
            (100.0, 300.0, 100.0, 700.0, 10),
            17.0,
            "every second pin of the chain must look alike|links between",
        ),
        ((2.0, 300.0, 2.0, 700.0, 10), 17.0, "well inside the picture of 720 x 960 pixels"),
        ((100.0, 300.0, 100.0, 700.0, 10), 900.0, "must be narrower than 120 mm"),
    ],
)
def test_no_chain_there(scanned, sheet, beside, width, message):
    with pytest.raises(wearsim.CaseError, match=message):
        scanned(over_sheet(Print.of(sheet, at=ORIGIN)), chain_beside=beside, chain_width=width)


def test_a_camera_at_an_unknown_height_is_refused(with_chain):
    with pytest.raises(wearsim.CaseError, match="the height of the camera must be known"):
        with_chain(1.0, noted=False)


def test_a_chain_without_a_sheet_is_refused(scanned):
    with pytest.raises(wearsim.CaseError, match="marker sheet must be visible if a chain"):
        scanned(Camera(size=SIZE, distance=8.0), chain_beside=(9, 9, 500, 9, 10), chain_width=17.0)
