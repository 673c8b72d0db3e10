"""``wearsim animate``: the flank that wears, read back frame by frame."""

import io
import shutil
import sys
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image

import wearsim
from wearsim.report.worn_flank import worn_flanks
from wearsim.result import LowerBound, WearResult

WRAP = """\
format_version = 1
title = "Wrap"
chain.designation = "08B-1"
sprocket = { teeth = 12, profile = "iso606", nodes = 301 }
mechanism = { kind = "wrap", phases = 2 }
load = { power_kW = 1, speed_rpm = 100 }
wear.specific_wear_rate_mm2_per_N = 1e-9
stop.critical_depth_mm = 0.02
drive = { links = 60 }
run = { method = "per_cycle", cycles_per_update = 10000, horizon_hours = 100 }
"""
GEARS = """\
format_version = 1
title = "Gears"
gear = { pinion_teeth = 17, wheel_teeth = 34, module_mm = 4.5, face_width_mm = 20, nodes = 61 }
load = { torque_N_m = 100, speed_rpm = 100 }
wear.specific_wear_rate_mm2_per_N = 1e-10
stop.critical_depth_mm = 0.05
"""
STRAND = """\
format_version = 1
title = "Test drive"
chain.designation = "16B-1"
sprocket = { teeth = 20, profile = "evolute", evolute_offset_mm = 5.6, nodes = 51 }
load = { power_kW = 3, speed_rpm = 100 }
wear.condition = "hardened, oiled"
stop.critical_depth_mm = 0.02
"""
CASES = {"strand": STRAND, "wrap": WRAP, "gears": GEARS}


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """Function that gives the folder of the run of a strand, of a wrap or of gears."""
    place, made = tmp_path_factory.mktemp("runs"), {}

    def folder(kind="strand"):
        if kind not in made:
            path = place / f"{kind}.toml"
            path.write_text(CASES[kind])
            made[kind] = place / kind
            wearsim.simulate(wearsim.load_case(path)).save(made[kind])
        return made[kind]

    return folder


def frames_of(path):
    """Pixels and milliseconds of every frame, and what the file says about itself."""
    with Image.open(path) as file:
        found = []
        for number in range(file.n_frames):
            file.seek(number)
            pixels = np.asarray(file.convert("RGB")).astype(int)
            found.append((pixels, file.info["duration"]))
        return found, dict(file.info)


@pytest.mark.wide
@pytest.mark.parametrize("form", ["gif", "webp", "png"])
def test_frames_are_read_back(cli, run, tmp_path, form):
    folder, out = run(), tmp_path / f"wear.{form}"
    options = ("--frames", 5, "--seconds", 1.3, "--width", 400)
    done = cli("animate", folder, "--out", out, *options)
    assert (done.code, done.out) == (0, "")
    frames, info = frames_of(out)
    assert [time for _, time in frames] == [260, 260, 260, 260, 2260]
    assert {pixels.shape for pixels, _ in frames} == {(225, 400, 3)}
    assert info["loop"] == 0
    first, last = frames[0][0], frames[-1][0]
    assert (np.abs(last - first).max(axis=2) > 60).sum() > 200
    assert (last[0, 0] == 255).all()
    kept = out.read_bytes().decode("utf-8", "ignore")
    assert "Test drive: wear of the flank" in kept
    assert "wearsim" in kept
    again = tmp_path / f"again.{form}"
    assert cli("animate", folder, "--out", again, *options).code == 0
    assert again.read_bytes() == out.read_bytes()


@pytest.mark.wide
@pytest.mark.parametrize("kind", ["strand", "wrap", "gears"])
def test_points_are_those_of_the_run(run, kind):
    """Of a snapshot its own numbers, and halfway between two of them their mean."""
    result = WearResult.load(run(kind))
    flanks = worn_flanks(result)
    assert [flank.name for flank in flanks] == (["pinion", "wheel"] if kind == "gears" else ["tooth"])
    table, cycles = result.flank, flanks[0].cycles
    if kind == "wrap":
        table = table[table["gap_kind"] == table["gap_kind"][table["depth_mm"].idxmax()]]
    times = np.append(cycles, 0.5 * (cycles[3] + cycles[4]))
    for flank, start in zip(flanks, ("", "wheel_"), strict=False):
        for values, part in zip(flank.at(times), ("x_mm", "y_mm", "depth_mm"), strict=True):
            rows = np.array([rows[start + part] for _, rows in table.groupby("cycles")])
            assert (values[:-1] == rows).all()
            assert values[-1] == pytest.approx(0.5 * (rows[3] + rows[4]), rel=1e-12)


def drawn_lines(result, monkeypatch):
    """What the line of the worn flank holds in each of three frames."""
    from wearsim.report import animation

    seen = []
    monkeypatch.setattr(animation, "_panels", watched(animation._panels, seen))
    assert len(list(animation.images(result, "", 3, 320))) == 3
    return seen[1:]  # the first is drawn for the layout


def watched(panels, seen):
    def watch(*arguments):
        moving = panels(*arguments)
        flank = moving[0]

        def show(frame):
            flank.show(frame)
            worn, curve = flank.artists[1], moving[-1].artists[0]
            seen.append((worn.get_xydata().copy(), curve, flank.artists[-1].get_text()))

        return [SimpleNamespace(artists=flank.artists, show=show), *moving[1:]]

    return watch


def test_drawn_is_the_worn_flank_enlarged(run, monkeypatch):
    result = WearResult.load(run())
    table, (flank,) = result.flank, worn_flanks(result)
    first, last = (table[table["cycles"] == end] for end in (0.0, table["cycles"].max()))
    seen = drawn_lines(result, monkeypatch)
    new = first[["x_mm", "y_mm"]].to_numpy()
    moved = last[["x_mm", "y_mm"]].to_numpy() - new
    assert flank.factor == 50  # 50 * 0.02 mm is within 0.12 of the 14.8 mm of the flank
    assert (seen[0][0] == new).all()
    assert seen[-1][0] - new == pytest.approx(50.0 * moved, abs=1e-12)
    assert seen[-1][2].endswith(f"h: {result.max_depth:.3g} mm deep")
    time, depth = seen[-1][1].get_data()
    assert time == pytest.approx([0.0, 0.5 * result.hours_run, result.hours_run])
    assert depth[[0, -1]] == pytest.approx([0.0, result.max_depth])


@pytest.mark.parametrize("kind", ["wrap", "gears"])
def test_wraps_and_gears_move(cli, run, tmp_path, kind):
    out = tmp_path / "wear.webp"
    assert cli("animate", run(kind), "--out", out, "--frames", 3, "--width", 640).code == 0
    pixels = [frame for frame, _ in frames_of(out)[0]]
    panels = 3 if kind == "gears" else 2
    changed = np.abs(pixels[-1] - pixels[0]).max(axis=(0, 2)) > 60
    assert all(part.sum() > 10 for part in np.array_split(changed, panels))


def test_run_may_have_moved_and_not_have_ended(cli, drive, tmp_path):
    folder = tmp_path / "run"
    assert cli("life", drive(), "--set", "run.horizon_hours=1", "--out", folder).code == 0
    assert isinstance(WearResult.load(folder).life, LowerBound)
    moved, out = tmp_path / "elsewhere", tmp_path / "new" / "wear.gif"
    shutil.move(folder, moved)
    assert cli("animate", moved, "--out", out, "--frames", 2, "--width", 320).code == 0
    _, info = frames_of(out)
    assert b"life > 1 h, " in info["comment"]


def test_case_is_worn_first_and_stdout_takes_the_file(cli, drive, monkeypatch):
    """The title is a text, not mathematics or markup."""
    stream = SimpleNamespace(buffer=io.BytesIO(), write=lambda text: None, flush=lambda: None)
    path = drive(title='"$x_{ <b> Зуб"')
    monkeypatch.setattr(sys, "stdout", stream)
    options = ("--format", "webp", "--frames", 2, "--width", 320, "--set", "load.speed_rpm=50")
    cli("animate", path, "--out", "-", *options)
    with Image.open(stream.buffer) as file:
        assert file.n_frames == 2
        assert "$x_{ &lt;b&gt; Зуб, with load.speed_rpm = 50: wear of the flank" in file.info["xmp"].decode()


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--out", "wear.mp4"), "must end in one of .gif, .webp, .png"),
        (("--out", "-"), "must end in one of"),
        (("--out", "there.gif"), "must not exist yet"),
        (("--out", "drive.toml", "--format", "gif", "--force"), "must not be the case itself"),
        (("--out", "wear.gif", "--frames", "1"), "2<=x<=300"),
        (("--out", "wear.gif", "--width", "99999"), "320<=x<=1920"),
        (("--out", "wear.gif", "--seconds", "0"), "0.1<=x<=120"),
        (("--out", "wear.gif", "--seconds", "nan"), "not a finite number"),
        (("--out", "wear.gif", "--seconds", "1"), "60 frames 1.2 s (got 1)"),
        (("--out", "there.gif/wear.gif", "--frames", "2"), "must lie in a folder, but there.gif is a file"),
        ((), "Missing option '--out'"),
    ],
)
def test_refusals(cli, drive, tmp_path, monkeypatch, options, said):
    monkeypatch.chdir(tmp_path)
    drive()
    (tmp_path / "there.gif").write_text("mine")
    done = cli("animate", "drive.toml", *options)
    assert done.code == 2
    assert said in done.err
    assert sorted(path.name for path in tmp_path.iterdir()) == ["drive.toml", "there.gif"]
    assert (tmp_path / "there.gif").read_text() == "mine"


def test_force_replaces_and_a_full_disk_leaves_what_was(cli, drive, tmp_path, monkeypatch):
    out = tmp_path / "wear.gif"
    out.write_text("mine")
    arguments = ("animate", drive(), "--out", out, "--frames", 2, "--width", 320, "--force")

    def full(*names):
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as disk:
        disk.setattr("os.replace", full)
        done = cli(*arguments)
    assert (done.code, out.read_text()) == (2, "mine")
    assert "No space left on device" in done.err
    assert len(list(tmp_path.iterdir())) == 2
    assert cli(*arguments).code == 0
    assert len(frames_of(out)[0]) == 2


def test_run_takes_no_settings(cli, run, tmp_path):
    done = cli("animate", run(), "--out", tmp_path / "o.gif", "--set", "load.speed_rpm=9")
    assert done.code == 2
    assert "--set" in done.err
