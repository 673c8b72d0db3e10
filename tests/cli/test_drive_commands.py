"""Commands about one case or several, given a whole drive."""

import json
import math
import re
import sys

import pandas as pd
import pytest

import wearsim


@pytest.fixture
def drive(tmp_path, two_sprockets):
    path = tmp_path / "drive.toml"
    path.write_text(two_sprockets)
    return path


SHORT = ("--set", "run.horizon_hours=20")

EXTRAS = ("build123d", "jinja2", "markupsafe", "nicegui", "plotly", "xlsxwriter")
"""Libraries that not every user has; pandas takes pyarrow where it is, and the quick suite has none."""


@pytest.mark.wide
@pytest.mark.parametrize(
    "arguments",
    [
        ("life", "--out", "run", *SHORT),
        ("compare", "--out", "compared", *SHORT),
        ("export", "--out", "wheels"),
        ("export", "--out", "wheels", "--format", "stl"),
        ("check",),
        ("loads",),
        ("maintain", *SHORT),
    ],
    ids=" ".join,
)
def test_only_what_needs_an_extra_asks_for_it(cli, drive, tmp_path, monkeypatch, arguments):
    monkeypatch.chdir(tmp_path)
    for name in ("wearsim.report.html.page_writer", "wearsim.report.drive.report_page"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    for name in EXTRAS:
        monkeypatch.setitem(sys.modules, name, None)
    command, *options = arguments
    done = cli(command, drive, *options)
    assert done.code == 0, done.err


def test_a_shaft_that_is_pulled_along_an_axis_has_a_round_direction(cli, drive):
    """Of two equal sprockets that lie level the shafts pull at each other, at 0 and at 180 degrees."""
    settings = ("--set", "sprocket.2.teeth=17")
    found = json.loads(cli("check", drive, "--json", *settings).out)["layout"]["sprockets"]
    assert [one["shaft_direction_deg"] for one in found] == [0.0, 180.0]


def test_loads_of_spans_and_of_every_tooth(cli, drive):
    found = json.loads(cli("loads", drive, "--json").out)
    spans = {one["from"]: one["tension_N"] for one in found["layout"]["spans"]}
    assert spans["roll"] > spans["driver"]
    for one, mesh in zip(found["sprockets"], found["layout"]["sprockets"], strict=True):
        assert one["name"] == mesh["name"]
        assert one["teeth"][0]["tension_N"] == pytest.approx(spans["roll"], rel=1e-9)
        assert abs(len(one["teeth"]) - mesh["teeth_in_mesh"]) <= 1.0
    text = cli("loads", drive).out
    assert "Spans      driver to roll" in text
    assert "\ndriver: 9 rollers" in text and "\nroll: 11 rollers" in text
    one = json.loads(cli("loads", drive, "--json", "--sprocket", "roll").out)
    assert one["teeth"] == found["sprockets"][1]["teeth"]


def test_a_chain_that_holds_needs_less_slack_tension_than_there_is(cli):
    """On 65 teeth and grown by 3 % this one jumps where both strands are hard pulled, not as it runs."""
    done = cli("loads", "cases/drives/escalator-duplex.toml", "--elongation", "3", "--json")
    assert done.code == 0, done.err
    for one in json.loads(done.out)["sprockets"]:
        assert 0.0 < one["min_slack_tension_N"] < one["slack_tension_N"]


@pytest.mark.wide
def test_a_rating_that_is_not_kept_is_told_once(cli, drive, tmp_path):
    """Loads of a duty are named with the speed of the driver, though the other one turns at another."""
    duty = "".join(
        f"[[duty]]\nshare_of_time = 0.5\npower_kW = {power}\nspeed_rpm = 300\n" for power in (2, 3)
    )
    path = tmp_path / "duty.toml"
    path.write_text(drive.read_text().replace("[load]\npower_kW = 1.3\nspeed_rpm = 300\n", "") + duty)
    found = json.loads(cli("life", path, "--json", *SHORT).out)
    rated = [text for text in found["warnings"] if "plate fatigue" in text]
    assert len(rated) == 1 and rated[0].startswith("outside a rating: plate fatigue ")
    assert " at 300 rpm, allowed " in rated[0]


@pytest.mark.parametrize(
    "arguments", [("export", "--out", "roll.svg"), ("profile",), ("animate", "--out", "roll.gif")]
)
def test_one_sprocket_of_a_drive_is_named(cli, drive, tmp_path, monkeypatch, arguments):
    monkeypatch.chdir(tmp_path)
    command, *options = arguments
    done = cli(command, drive, *options)
    assert done.code == 2
    assert "is a whole drive: give --sprocket, one of 'driver', 'roll'" in done.err
    done = cli(command, drive, *options, "--sprocket", "rol")
    assert done.code == 2 and "(got 'rol')" in done.err


def test_wheel_and_flank_are_those_of_the_sprocket(cli, drive, tmp_path):
    out = tmp_path / "roll.csv"
    assert cli("export", drive, "--sprocket", "roll", "--out", out).code == 0
    # 20 teeth of 08B: tips at 86.45 mm at most, gaps down to 81.18 - 8.6 mm.
    points = pd.read_csv(out)
    radii = (points["x_mm"] ** 2 + points["y_mm"] ** 2) ** 0.5
    assert 2 * radii.max() == pytest.approx(86.4537, abs=1e-3)
    assert 2 * radii.min() == pytest.approx(81.1836 - 2 * 0.505 * 8.51, abs=1e-2)
    profile = cli("profile", drive, "--sprocket", "roll").out
    assert profile.count("\n") == 62
    assert profile != cli("profile", drive, "--sprocket", "driver").out


def test_all_wheels_go_into_a_folder(cli, drive, tmp_path):
    """One file a wheel, which is that of --sprocket; cogs of a cassette are wheels."""
    out, one = tmp_path / "wheels", tmp_path / "roll.csv"
    assert cli("export", drive, "--out", out, "--format", "csv").code == 0
    assert sorted(file.name for file in out.iterdir() if file.suffix) == ["driver.csv", "roll.csv"]
    assert cli("export", drive, "--sprocket", "roll", "--out", one).code == 0
    assert (out / "roll.csv").read_bytes() == one.read_bytes()
    assert cli("export", drive, "--out", out).code == 2
    assert cli("export", drive, "--out", out, "--state", "worn", "--force", *SHORT).code == 0
    assert "08B-1, 17 to 20 teeth: roll" in (out / "roll.dxf").read_text()
    assert "Worn after 20 h: " in (out / "roll.dxf").read_text()


def test_cogs_are_wheels_with_files_of_their_own(cli, tmp_path, cassette):
    path, out = tmp_path / "drive.toml", tmp_path / "wheels"
    path.write_text(cassette)
    assert cli("export", path, "--out", out, "--format", "svg").code == 0
    found = {file.name for file in out.iterdir() if file.suffix}
    assert found == {"ring.svg", "cassette_13T.svg", "cassette_17T.svg"}
    done = cli("export", path, "--out", out, "--force", "--template", tmp_path / "gauge.pdf")
    assert done.code == 2 and "gauge of one sprocket" in done.err
    assert "or --out FOLDER alone for all wheels" in cli("export", path, "--out", tmp_path / "a.dxf").err


def test_a_worn_wheel_is_worn_in_its_drive(cli, drive, tmp_path):
    dxf, gif = tmp_path / "roll.dxf", tmp_path / "roll.gif"
    done = cli("export", drive, "--sprocket", "roll", "--out", dxf, "--state", "worn", *SHORT)
    assert done.code == 0
    text = dxf.read_text()
    assert "08B-1, 17 to 20 teeth: roll" in text and "Worn after 20 h: " in text
    options = ("--frames", "2", "--width", "320", *SHORT)
    assert cli("animate", drive, "--sprocket", "roll", "--out", gif, *options).code == 0
    assert gif.read_bytes().startswith(b"GIF8")


def test_sprocket_belongs_to_a_drive(cli, tmp_path):
    done = cli("profile", "cases/16b-20t-oiled.toml", "--sprocket", "roll")
    assert done.code == 2 and "--sprocket belongs to a whole drive" in done.err


def test_several_drives_at_once(cli, drive, tmp_path):
    other = tmp_path / "other.toml"
    other.write_text(drive.read_text().replace("teeth = 20", "teeth = 25"))
    out, book = tmp_path / "out", tmp_path / "book.xlsx"
    done = cli("life", drive, other, "--json", "--out", out, "--xlsx", book, *SHORT)
    assert done.code == 0, done.err
    found = [json.loads(line) for line in done.out.splitlines()]
    assert [one["case"] for one in found] == ["drive", "other"]
    at_least = [one["sprockets"][1]["sprocket_life_hours_at_least"] for one in found]
    assert at_least == pytest.approx([20.0, 20.0], rel=1e-12)
    for name in ("drive", "other"):
        assert json.loads((out / name / "drive.json").read_text())["case"] == name
    sheet = pd.read_excel(book, sheet_name=0, header=None).astype(str).to_numpy().ravel()
    for text in ("08B-1, 17 to 20 teeth: roll", "08B-1, 17 to 25 teeth: roll"):
        assert any(text in cell for cell in sheet)
    done = cli("export", out / "drive", "--out", tmp_path / "roll.dxf")
    assert done.code == 2 and "is a whole drive: give --sprocket, one of 'driver', 'roll'" in done.err
    assert cli("compare", out / "drive", out / "other").code == 0


def test_all_drives_are_checked_before_one_runs(cli, drive, tmp_path):
    wrong = tmp_path / "wrong.toml"
    wrong.write_text(drive.read_text().replace("teeth = 20", "teeth = 3"))
    done = cli("life", drive, wrong, "--out", tmp_path / "out")
    assert done.code == 2 and "wrong.toml:10: sprocket.2.teeth" in done.err
    assert not (tmp_path / "out").exists()


def test_a_drive_and_one_sprocket_live_side_by_side(cli, drive, tmp_path):
    done = cli("life", drive, "cases/16b-20t-oiled.toml", "--json", "--out", tmp_path / "out", *SHORT)
    assert done.code == 0, done.err
    both = [json.loads(line) for line in done.out.splitlines()]
    assert "sprockets" in both[0] and both[1]["case"] == "16b-20t-oiled"
    assert (tmp_path / "out" / drive.stem / "drive.json").is_file()
    assert (tmp_path / "out" / "16b-20t-oiled" / "result.json").is_file()
    done = cli("compare", drive, "cases/16b-20t-oiled.toml", *SHORT)
    assert done.code == 2 and "compare them separately" in done.err


def test_drives_are_compared_part_by_part(cli, drive, tmp_path):
    other = tmp_path / "other.toml"
    other.write_text(drive.read_text().replace("power_kW = 1.3", "power_kW = 2.6"))
    out = tmp_path / "compared"
    done = cli("compare", drive, other, "--out", out, *SHORT)
    assert done.code == 0, done.err
    table = pd.read_csv(out / "summary.csv")
    assert list(table["part"]) == ["chain", "driver", "roll"] * 2
    assert set(table["life_hours_at_least"]) == {20.0}
    first, second = done.out.splitlines()[2:]
    assert "| > 20 h | driver > 20 h, roll > 20 h |" in first
    assert "within all of them" in first and "OVERLOADED" in second
    assert done.out.strip() in (out / "summary.md").read_text()


def test_check_rates_a_drive(cli, drive):
    assert "rating   joint pressure" in cli("check", drive).out
    found = json.loads(cli("check", drive, "--json", "--set", "load.power_kW=15").out)
    outside = [one["name"] for one in found["rating"] if not one["ok"]]
    assert "plate fatigue" in outside
    assert any("outside a rating: plate fatigue" in text for text in found["warnings"])


@pytest.mark.slow
def test_what_matters_on_a_drive(cli, drive):
    """The chain ends first, in inverse proportion to the rate of its joints; that of the teeth is not felt.

    10 % and 90 % points of a log-normal rate lie at exp(-+1.28155 sigma_ln).
    """
    pytest.importorskip("SALib", reason="SALib is not installed")
    key = "joint.specific_wear_rate_mm2_per_N"
    drive.write_text(
        drive.read_text().replace("5e-9", "5e-10")
        + f'[uncertainty]\n"{key}" = {{distribution = "lognormal", sigma_ln = 0.5}}\n'
    )
    done = cli("sensitivity", drive, "--samples", "8", "--trajectories", "4", "--json")
    assert done.code == 0, done.err
    joints, *others = json.loads(done.out)["keys"]
    assert joints["key"] == key
    ratio = joints["low_life_hours"] / joints["high_life_hours"]
    assert ratio == pytest.approx(math.exp(2 * 1.28155 * 0.5), rel=0.01)
    assert joints["value_for_double_life"] == pytest.approx(0.5e-8, rel=0.01)
    assert others
    assert all(other["total_index"] < 1e-4 and other["value_for_double_life"] is None for other in others)


@pytest.mark.slow
def test_the_best_drive_is_a_drive(cli, drive, tmp_path):
    """The chain ends first: of two pulls the smaller one lives longer, by the law of its joints."""
    drive.write_text(
        drive.read_text()
        + '[optimise]\nobjectives = ["life_hours"]\n[optimise.parameters]\n'
        + '"sprocket.2.teeth" = [20, 25]\n"load.power_kW" = {low = 1.0, high = 1.3}\n'
        + "[optimise.limits]\nmass_kg = {high = 2.0}\n"
    )
    done = cli(
        "optimise", drive, "--evaluations", "10", "--json", "--threads", "2", "--out", tmp_path / "best"
    )
    assert done.code == 0, done.err
    best = json.loads(done.out)["designs"][0]
    assert best["inputs"]["load.power_kW"] == pytest.approx(1.0, rel=0.02)
    assert cli("check", tmp_path / "best" / "designs" / "01.toml").code == 0


OILED = "[lubrication]\nlasts_hours = 100\ndry_factor = 4\n"


@pytest.fixture
def read(cli, drive, tmp_path):
    """Function that tells what a command says of a drive and a table of readings."""

    def answer(command, *rows, tables=""):
        case, log = tmp_path / "read.toml", tmp_path / "log.csv"
        case.write_text(drive.read_text() + tables)
        log.write_text("\n".join(["time_hours,quantity,value,error", *rows]) + "\n")
        done = cli(command, case, log, "--json")
        assert done.code == 0, done.err
        return json.loads(done.out)

    return answer


def test_what_is_left_to_the_chain_of_a_drive(cli, drive, read):
    """Its own life is L, to 3 %. 1 % after a quarter of that is 3 % after three quarters: L/2 is left."""
    told = json.loads(cli("life", drive, "--json").out)
    life, title = told["chain_life_hours"], told["title"]
    row = f"{0.25 * life},elongation_percent,1,1e-6"
    found = read("remaining", row)
    assert found["title"] == title
    assert found["remaining_hours"] == pytest.approx(0.5 * life, rel=1e-3)
    assert {one["quantity"] for one in found["intervals"]} >= {"end_date", "remaining_hours"}
    one = ("--hours", str(0.25 * life), "--elongation", "1", "--json")
    single = json.loads(cli("remaining", drive, *one).out)
    assert single["remaining_hours"] == pytest.approx(0.5 * life, rel=1e-9)
    assert single["title"] == title
    pytest.importorskip("pandera", reason="pandera is not installed")
    fitted = read("calibrate", row)
    assert fitted["values"][0]["value"] == pytest.approx(4 / 3 * 1e-8, rel=1e-3)
    assert fitted["parts"][0]["remaining_hours"] == pytest.approx(0.5 * life, rel=1e-3)


def test_a_log_of_the_chain_of_a_drive(read):
    """100 h at 1 and 50 h at 4 each: 300 lubricated hours. 0.6 % after two of these, 3 % after ten."""
    rows = ["150,relubrication,,", "300,relubrication,,", "300,elongation_percent,0.6,1e-6"]
    assert read("remaining", *rows, tables=OILED)["life_hours"] == pytest.approx(1500.0, rel=1e-4)
    pytest.importorskip("pandera", reason="pandera is not installed")
    assert read("calibrate", *rows, tables=OILED)["parts"][0]["life_hours"] == pytest.approx(1500.0, rel=1e-4)


def test_the_calibrated_drive_is_a_drive(cli, drive, tmp_path):
    pytest.importorskip("pandera", reason="pandera is not installed")
    log, out = tmp_path / "log.csv", tmp_path / "out"
    log.write_text("time_hours,quantity,value,error\n100,elongation_percent,0.3,0.01\n")
    assert cli("calibrate", drive, log, "--out", out).code == 0
    done = cli("check", out / "calibrated.toml", "--json")
    assert done.code == 0, done.err
    assert [one["name"] for one in json.loads(done.out)["layout"]["sprockets"]] == ["driver", "roll"]
    rows = [{"time_hours": 100, "quantity": "elongation_percent", "value": 0.3, "error": 0.01}]
    assert isinstance(wearsim.calibrate(drive, rows).case, wearsim.DriveCase)


def test_readings_of_teeth_ask_for_the_case_of_one_sprocket(cli, drive, tmp_path):
    log = tmp_path / "log.csv"
    log.write_text("time_hours,quantity,value,error\n100,max_depth_mm,0.1,0.01\n")
    depth = cli("remaining", drive, "--hours", "100", "--depth-mm", "0.1")
    assert depth.code == 2
    assert "is read on the teeth of one sprocket: name it, one of " in depth.err
    pytest.importorskip("pandera", reason="pandera is not installed")
    done = cli("calibrate", drive, log)
    assert done.code == 2
    assert "log.csv:2: quantity: max_depth_mm is read on the teeth of one sprocket" in done.err


@pytest.mark.wide
def test_bounds_on_screen_stand_in_json_and_workbook(cli, drive, tmp_path):
    """Joints that are hardened and oiled: 9e-11 to 1.5e-10 mm2/N about 1.2e-10, 1.25 and 0.75 of it.

    With the spread of published rules, 2.5 and 0.5, and 1.8 as the drive is slow; logarithms add as squares.
    """
    path, book = tmp_path / "oiled.toml", tmp_path / "oiled.xlsx"
    text = drive.read_text().replace("[joint]\nspecific_wear_rate_mm2_per_N = 1e-8\n", "")
    path.write_text(text.replace("specific_wear_rate_mm2_per_N = 5e-9", 'condition = "hardened, oiled"'))
    few = ("--set", "stop.elongation_percent=0.05", "--set", "run.horizon_hours=1500")
    found = json.loads(cli("life", path, *few, "--json", "--xlsx", book).out)
    assert found["first"] == "chain"
    chain, low, high = (found[name] for name in ("chain_life_hours", "life_hours_low", "life_hours_high"))
    most, least = (
        math.exp(math.hypot(*map(math.log, factors))) for factors in ((1.25, 2.5, 1.8), (1 / 0.75, 2.0, 1.8))
    )
    assert (low, high) == (pytest.approx(chain / most), pytest.approx(chain * least))
    motor, roll = found["sprockets"]
    assert (roll["life_hours_low"], motor["life_hours_high"]) == (pytest.approx(low), pytest.approx(high))
    sheet = pd.read_excel(book, sheet_name=0, header=None).astype(str)
    rows = dict(zip(sheet[0][:30], sheet[1][:30], strict=True))
    assert list(rows).index("load as given") < list(rows).index("Ratings") < list(rows).index("Chain")
    screen = " ".join(cli("life", path, *few, "--explain").out.split())
    for label in ("Chain", "roll", "First", "Band", "Ratings"):
        assert f"{label} {' '.join(rows[label].split())}" in screen
    assert rows["roll"].startswith("> 1 500 h ")
    assert float(sheet.set_index(0)[3]["life_hours_low"]) == pytest.approx(low)


def test_speed_of_the_chain_is_printed_as_one_number(cli, drive):
    """19 teeth of 12.7 mm at 300 rpm are 1.2065 m/s, which lies between two numbers of four digits."""
    settings = ("sprocket.1.teeth=19", "load.speed_rpm=300", "chain.designation=08B-1")
    options = [part for setting in settings for part in ("--set", setting)]
    printed = cli("loads", drive, *options).out + cli("check", drive, "--explain", *options).out
    found = re.findall(r"([\d.]+) m/s: pull|links at ([\d.]+) m/s", printed)
    assert len(found) >= 2
    assert len({one or other for one, other in found}) == 1
