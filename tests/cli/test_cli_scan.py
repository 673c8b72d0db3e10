"""``wearsim scan``: what it prints, its files, and which pictures it refuses."""

import csv
import io
import json
import os
import struct
import subprocess
import sys
import zlib

import numpy as np
import pytest
from PIL import Image

import wearsim
from tests.photographs import Camera, chain_on, new_gap, picture, wheel, with_pocket


@pytest.fixture(scope="module")
def photo(tmp_path_factory):
    """A photograph of 19 teeth, 0.3 mm deep."""
    path = tmp_path_factory.mktemp("photo") / "wheel.png"
    picture(wheel([with_pocket(new_gap(12.7, 8.51, 19), 0.3)] * 19), Camera()).save(path)
    return path


def test_answer_and_files(cli, photo, tmp_path):
    out = tmp_path / "out"
    done = cli("scan", photo, "--chain", "08B", "--hours", 4200, "--out", out)
    assert done.code == 0, done.err
    text = " ".join(done.out.split())
    assert text.startswith("wheel.png: iso606 for 08B-1, 19 teeth Teeth 19 counted")
    assert "Worn flank the one that faces clockwise" in text
    assert "a wrong chain gives wrong millimetres" in text
    assert "with pins of the roller's diameter, 8.51 mm: as the new form, within the error" in text
    names = ("teeth.csv", "gap.csv", "points.csv", "readings.csv", "scan.txt", "overlay.png", "overlay.svg")
    assert {path.name for path in out.iterdir()} >= set(names)
    with (out / "readings.csv").open() as file:
        (reading,) = csv.DictReader(file)
    assert (reading["time_hours"], reading["quantity"]) == ("4200.0", "max_depth_mm")
    assert float(reading["value"]) == pytest.approx(0.3, abs=0.05)
    with (out / "teeth.csv").open() as file:
        assert len(list(csv.DictReader(file))) == 19


def test_points_are_a_profile(cli, photo, tmp_path):
    assert cli("scan", photo, "--chain", "08B", "--out", tmp_path / "out").code == 0
    case = wearsim.load_case("08b-19t-wrap")
    tables = {**case.given.tables, "sprocket": {"teeth": 19, "profile": "points", "points_noise_mm": 0.01}}
    tables["sprocket"]["points_file"] = str(tmp_path / "out" / "points.csv")
    worn = wearsim.load_case(tables)
    assert worn.drive.pitch_line_thickness < case.drive.pitch_line_thickness


def test_json(cli, photo):
    done = cli("scan", photo, "--chain", "08B", "--json")
    found = json.loads(done.out)
    assert (found["schema_version"], found["teeth"], found["worn_flank"]) == (1, 19, "clockwise")
    assert abs(found["depth_mm"] - 0.3) < 3.0 * found["depth_se_mm"]
    assert len(found["teeth_depth_mm"]) == 19
    assert found["scale_by"] == "form of the teeth"
    assert "the chain is the right one" in found["assumptions"][2]
    answer = wearsim.scan(photo, chain="08B")
    assert answer.summary() == found
    assert answer.teeth.shape == (19, 5)


@pytest.mark.wide
def test_hours_left(cli, photo):
    settings = (
        "--set",
        "sprocket.nodes=101",
        "--set",
        "mechanism.phases=1",
        "--set",
        "run.life_tolerance=0.1",
    )
    done = cli("scan", photo, "--case", "08b-19t-wrap", *settings, "--hours", 4200, "--json")
    assert done.code == 0, done.err
    found = json.loads(done.out)
    low, mean, high = (found[f"remaining_hours{end}"] for end in ("_low", "", "_high"))
    assert low < mean < high
    read = cli(
        *("remaining", "08b-19t-wrap", *settings, "--hours", 4200, "--depth-mm", found["depth_mm"]),
        *("--reading-error-mm", 2.0 * found["depth_se_mm"], "--json"),
    )
    assert json.loads(read.out)["remaining_hours"] == mean


def test_another_number_of_teeth(cli, photo):
    done = cli("scan", photo, "--chain", "08B", "--teeth", 20)
    assert done.code == 2
    assert "wheel.png: the wheel must have 20 teeth as given, but 19 are counted" in done.err
    assert cli("scan", photo, "--case", "16b-20t-oiled").code == 2


@pytest.mark.parametrize(
    "words",
    [
        (),
        ("--chain", "08B", "--case", "16b-20t-oiled"),
        ("--case", "16b-20t-oiled", "--teeth", "20"),
        ("--chain", "08B", "--bore-mm", "20", "--dpi", "300"),
        ("--chain", "08B", "--scale", "1,2,3"),
        ("--chain", "08B", "--scale", "1,2,300,2,0"),
        ("--chain", "08B", "--scale", "1,2,300,2,-20"),
        ("--chain", "08B", "--scale", "1,2,300,2,nan"),
        ("--chain", "08B", "--thickness-mm", "7.2"),
        ("--chain", "08B", "--set", "load.speed_rpm=1"),
        ("--chain", "08B", "--chain-beside", "1,2,300,2,10"),
        ("--chain", "08B", "--chain-width-mm", "17"),
        ("--chain", "08B", "--chain-beside", "1,2,300,2,9", "--chain-width-mm", "17"),
        ("--chain", "08B", "--chain-beside", "1,2,300,2,10.5", "--chain-width-mm", "17"),
        ("--chain", "08B", "--chain-beside", "1,2,300,10", "--chain-width-mm", "17"),
        ("--chain", "08B", "--chain-beside", "1,2,300,2,10", "--chain-width-mm", "0"),
        ("--chain", "99X"),
    ],
)
def test_wrong_options(cli, photo, words):
    assert cli("scan", photo, *words).code == 2


def grey(values):
    """Return a picture of values from 0 to 1."""
    return Image.fromarray(np.round(255.0 * values).astype(np.uint8))


def disc(across, down, radius, size=600):
    """Return a dark disc on bright ground."""
    y, x = np.mgrid[:size, :size]
    return np.where((x - across) ** 2 + (y - down) ** 2 < radius**2, 0.1, 0.9)


OUTLINE = wheel([new_gap(12.7, 8.51, 19)] * 19)


def gear(teeth, module=4.0):
    """Return the outline of a spur gear, pressure angle 20 degrees [mm]."""
    pitch_radius = 0.5 * module * teeth
    base = pitch_radius * np.cos(np.radians(20.0))
    roll = np.linspace(0.0, np.sqrt(((pitch_radius + module) / base) ** 2 - 1.0), 60)
    radius = base * np.hypot(1.0, roll)
    half = 0.5 * np.pi / teeth + np.tan(np.radians(20.0)) - np.radians(20.0)
    angle = half - (roll - np.arctan(roll))
    radius = np.concatenate([[pitch_radius - 1.25 * module], radius])
    angle = np.concatenate([[half], angle])
    tooth = np.column_stack([np.r_[radius, radius[::-1]], np.r_[-angle, angle[::-1]]])
    turns = np.repeat(2.0 * np.pi * np.arange(teeth) / teeth, len(tooth))
    radius, angle = np.tile(tooth, (teeth, 1)).T
    return np.column_stack([radius * np.cos(angle + turns), radius * np.sin(angle + turns)])


def landscape():
    """Return dark hills below a bright sky."""
    y, x = np.mgrid[:600, :800]
    return np.where(y > 320 + 60 * np.sin(x / 90.0) + 25 * np.sin(x / 23.0), 0.2, 0.85)


REFUSED = {
    "a gear": (lambda: picture(gear(30), Camera(size=(800, 800))), "but neither does"),
    "another gear": (lambda: picture(gear(19), Camera(size=(800, 800))), "but neither does"),
    "a chain on it": (
        lambda: picture(OUTLINE, Camera(size=(800, 800)), chain_on(12.7, 8.51, 19, 6)),
        "chain",
    ),
    "noise": (lambda: grey(np.random.default_rng(1).random((500, 500))), "at least 2 % of the picture"),
    "a landscape": (lambda: grey(landscape()), "all teeth must be in the picture"),
    "floating point": (lambda: Image.fromarray(disc(300, 300, 200).astype(np.float32)), "8 or 16 bits"),
    "no two shades": (lambda: grey(np.full((400, 400), 0.5)), "no two shades"),
    "a disc": (lambda: grey(disc(300, 300, 200)), "no repeating teeth"),
    "two wheels": (
        lambda: Image.fromarray(
            np.hstack(
                [np.asarray(picture(OUTLINE, Camera(size=(400, 400), turn=turn))) for turn in (0.0, 0.1)]
            )
        ),
        "two objects of its size",
    ),
    "seen from the side": (lambda: picture(OUTLINE, Camera(tilt=1.0)), "photographed along its axis"),
    "cut off": (lambda: picture(OUTLINE, Camera(centre=(0.2, 0.5))), "all teeth must be in the picture"),
    "too small": (lambda: grey(disc(50, 50, 30, 100)), "at least 200 pixels"),
    "out of focus": (lambda: picture(OUTLINE, Camera(size=(400, 400), blur=3.0)), "a pitch must be at least"),
    "far away": (lambda: grey(disc(300, 300, 10)), "at least 2 % of the picture"),
}


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=pytest.mark.slow) if "gear" in name else name for name in REFUSED]
)
def test_refused_pictures(cli, tmp_path, name):
    drawn, message = REFUSED[name]
    path = tmp_path / ("bad.tif" if name == "floating point" else "bad.png")
    drawn().save(path)
    done = cli("scan", path, "--chain", "08B", "--json")
    assert done.code == 2
    assert message in " ".join(done.err.split()), done.err
    assert json.loads(done.out)["error"]["kind"] == "CaseError"


def test_a_truncated_file(cli, photo, tmp_path):
    path = tmp_path / "half.png"
    path.write_bytes(photo.read_bytes()[:20_000])
    done = cli("scan", path, "--chain", "08B")
    assert done.code == 2
    assert "must be a whole picture" in done.err


def test_no_picture(cli, tmp_path):
    (tmp_path / "text.jpg").write_text("no picture")
    assert "is none of them" in cli("scan", tmp_path / "text.jpg", "--chain", "08B").err
    assert "cannot be opened" in cli("scan", tmp_path / "none.jpg", "--chain", "08B").err


def test_a_bomb_is_refused_by_its_header(cli, tmp_path):
    """20 000 pixels squared, of which no line is there."""

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", 20_000, 20_000, 8, 0, 0, 0, 0)
    path = tmp_path / "bomb.png"
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", b"") + chunk(b"IEND", b""))
    done = cli("scan", path, "--chain", "08B")
    assert done.code == 2
    assert "at most 80 million pixels" in done.err


def huge(picture, kind):
    """Return a picture's file with 20 000 pixels in each direction in its header."""
    held = io.BytesIO()
    picture.save(held, kind)
    data = bytearray(held.getvalue())
    if kind == "JPEG":
        at = data.index(b"\xff\xc0") + 5
        data[at : at + 4] = struct.pack(">HH", 20_000, 20_000)
        return bytes(data)
    (first,) = struct.unpack_from("<I", data, 4)
    for entry in range(first + 2, first + 2 + 12 * struct.unpack_from("<H", data, first)[0], 12):
        if struct.unpack_from("<H", data, entry)[0] in (256, 257):
            struct.pack_into("<HII", data, entry + 2, 4, 1, 20_000)
    return bytes(data)


@pytest.mark.parametrize("kind", ["JPEG", "TIFF"])
def test_other_bombs(cli, tmp_path, kind):
    path = tmp_path / f"bomb.{kind}"
    path.write_bytes(huge(Image.new("L", (300, 300), 200), kind))
    assert "at most 80 million pixels" in cli("scan", path, "--chain", "08B").err


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="children tell no memory there")
def test_memory_of_the_largest_picture(photo, tmp_path):
    """The largest one that is decoded, with transparency, stays below 1.5 GB."""
    path = tmp_path / "large.png"
    large = Image.open(photo).resize((8940, 8940)).convert("RGBA")
    large.putalpha(250)
    large.save(path, compress_level=1)
    del large
    child = subprocess.Popen([sys.executable, "-m", "wearsim", "scan", str(path), "--chain", "08B"])
    _, status, used = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    assert child.returncode == 0
    assert used.ru_maxrss * (1 if sys.platform == "darwin" else 1024) < 1.5e9


@pytest.mark.parametrize(("kind", "name"), [("PNG", "wheel.png"), ("TIFF", "wheel.tif")])
def test_several_pages(cli, photo, tmp_path, kind, name):
    upright = Image.open(photo)
    upright.save(tmp_path / name, kind, save_all=True, append_images=[upright.rotate(20, fillcolor=220)])
    done = cli("scan", tmp_path / name, "--chain", "08B")
    assert done.code == 2
    assert "must be one picture, but holds 2" in done.err


def test_an_empty_file(cli, tmp_path):
    (tmp_path / "empty.jpg").touch()
    assert "is none of them" in cli("scan", tmp_path / "empty.jpg", "--chain", "08B").err


@pytest.mark.parametrize(
    "orientation", [6, *(pytest.param(one, marks=pytest.mark.slow) for one in (1, 2, 3, 4, 5, 7, 8))]
)
def test_every_orientation(cli, photo, tmp_path, orientation):
    """Mirrored ones show the other flank."""
    exif = Image.Exif()
    exif[0x0112] = orientation
    path = tmp_path / "turned.jpg"
    Image.open(photo).convert("RGB").save(path, exif=exif, quality=92)
    found = json.loads(cli("scan", path, "--chain", "08B", "--json").out)
    assert found["worn_flank"] == ("clockwise" if orientation in (1, 3, 6, 8) else "counterclockwise")
    assert found["depth_mm"] == pytest.approx(0.3, abs=0.05)


def test_a_picture_is_turned_as_its_camera_says(photo, tmp_path):
    """Orientation 6 is stored a quarter turn off; orientation 5 mirrored too."""
    upright = Image.open(photo)
    exif = Image.Exif()
    found = {}
    for orientation, way in ((6, Image.Transpose.ROTATE_90), (5, Image.Transpose.TRANSPOSE)):
        exif[0x0112] = orientation
        path = tmp_path / f"{orientation}.png"
        upright.transpose(way).save(path, exif=exif)
        found[orientation] = wearsim.scan(path, chain="08B").summary()["worn_flank"]
    assert found == {6: "clockwise", 5: "clockwise"}


@pytest.mark.parametrize(
    "mode",
    [
        "RGBA",
        *(pytest.param(one, marks=pytest.mark.slow) for one in ("RGB", "P", "I;16", "TIFF", "CMYK", "clear")),
    ],
)
def test_kinds_of_pictures(photo, tmp_path, mode):
    upright = Image.open(photo)
    path = tmp_path / "wheel.png"
    if mode == "I;16":
        Image.fromarray(257 * np.asarray(upright).astype(np.uint16)).save(path)
    elif mode in ("TIFF", "CMYK"):
        path = tmp_path / "wheel.tif"
        upright.convert(mode if mode == "CMYK" else "L").save(path)
    elif mode == "clear":
        # Black, but transparent: it is ground.
        clear = upright.convert("RGBA")
        clear.paste((0, 0, 0, 0), (0, 0, 60, 60))
        clear.save(path)
    else:
        upright.convert(mode).save(path)
    assert wearsim.scan(path, chain="08B").depth == pytest.approx(0.3, abs=0.05)


COARSE = {"sprocket.nodes": 101, "mechanism.phases": 1, "run.life_tolerance": 0.1}


@pytest.mark.slow
def test_a_shared_reading_gives_the_same_hours(cli, photo, tmp_path):
    """Written by a scan, read by `remaining`."""
    settings = [word for key, value in COARSE.items() for word in ("--set", f"{key}={value}")]
    out = tmp_path / "out"
    done = cli("scan", photo, "--case", "08b-19t-wrap", *settings, "--hours", 4200, "--json", "--out", out)
    assert done.code == 0, done.err
    scanned = json.loads(done.out)
    done = cli("remaining", "08b-19t-wrap", *settings, "--reading", out / "reading.toml", "--json")
    assert done.code == 0, done.err
    read = json.loads(done.out)
    for key in ("remaining_hours", "remaining_hours_low", "remaining_hours_high"):
        assert read[key] == pytest.approx(scanned[key], rel=1e-4)
    case = wearsim.load_case("08b-19t-wrap").with_(COARSE)
    assert wearsim.remaining(case, reading=out / "reading.toml").remaining.hours == read["remaining_hours"]
    other = cli("remaining", "16b-20t-oiled", "--reading", out / "reading.toml")
    assert other.code == 2
    assert "conditions.teeth: must be that of the case, 20, but is 19: give its case" in other.err
    twice = cli("remaining", "08b-19t-wrap", "--reading", out / "reading.toml", "--hours", 4200)
    assert twice.code == 2


def test_a_shared_reading_needs_a_case(photo):
    with pytest.raises(wearsim.CaseError, match=r"wheel\.png: must have a case, running hours and a depth"):
        wearsim.scan(photo, chain="08B", hours=4200).shared_reading()
