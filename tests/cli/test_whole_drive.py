"""A drive with both sprockets: ``wearsim life`` and ``wearsim check`` of [[sprocket]]."""

import json
import math
import shutil

import numpy as np
import pandas as pd
import pytest

import wearsim
from wearsim.drive.life import drive_life
from wearsim.drive.load_case import load_drive

pytestmark = pytest.mark.wide

POINTS = 'name = "roll"\nteeth = 20\nprofile = "points"\npoints_file = "gap.csv"\n'


@pytest.fixture
def drive(tmp_path, two_sprockets):
    path = tmp_path / "drive.toml"
    path.write_text(two_sprockets)
    return path


def own_case(teeth, mate, role, rpm):
    """The case of one of both sprockets as one writes it today."""
    return {
        "format_version": 1,
        "chain": {"designation": "08B-1"},
        "sprocket": {"teeth": teeth, "profile": "iso606", "nodes": 61, "role": role},
        "drive": {"links": 110, "mate_teeth": mate},
        "load": {"power_kW": 1.3, "speed_rpm": rpm},
        "joint": {"specific_wear_rate_mm2_per_N": 1e-8},
        "wear": {"specific_wear_rate_mm2_per_N": 5e-9},
        "mechanism": {"phases": 2},
        "run": {"life_tolerance": 0.1},
    }


def lives(cli, path, *settings):
    """Hours of every part as the command prints them in JSON."""
    args = [word for setting in settings for word in ("--set", setting)]
    done = cli("life", path, "--json", *args)
    assert done.code == 0, done.err
    content = json.loads(done.out)
    found = {one["name"]: one["sprocket_life_hours"] for one in content["sprockets"]}
    return {"chain": content["chain_life_hours"], **found}


def test_each_part_lives_as_in_its_own_case(cli, drive):
    found = lives(cli, drive)
    for name, tables in (
        ("driver", own_case(17, 20, "driver", 300)),
        ("roll", own_case(20, 17, "driven", 300 * (17 / 20))),
    ):
        own = wearsim.simulate(wearsim.load_case(tables))
        assert found[name] == own.parts["sprocket"].hours
        # One chain, counted in turns of either sprocket.
        assert found["chain"] == pytest.approx(own.parts["chain"].hours, rel=1e-12)


def test_answer_says_what_is_replaced_first_and_on_which_day(cli, drive):
    done = cli("life", drive)
    lines = done.out.splitlines()
    first_warning = next(place for place, line in enumerate(lines) if line.startswith("  Warnings"))
    assert first_warning <= 10
    assert lines[0] == "08B-1, 17 to 20 teeth"
    assert [line.split()[0] for line in lines[1:4]] == ["Chain", "driver", "roll"]
    assert "until 20" in lines[1]
    assert "  First      replace the chain at " in done.out
    assert "  Ratings    within all of them" in done.out


def test_a_chain_that_is_not_worn_out_says_so_everywhere(cli, drive, tmp_path):
    """Joints wear at a constant rate: half way through its life a chain has grown by half of its limit."""
    until = ("--set", f"run.horizon_hours={lives(cli, drive)['chain'] / 2}")
    line = cli("life", drive, *until).out.splitlines()[1]
    assert line.startswith("  Chain      > ") and line.endswith("elongation below 3 %")
    content = json.loads(cli("life", drive, *until, "--json").out)
    assert content["chain_life_hours"] is None
    for one in content["sprockets"]:
        grown = next(state for state in one["limits"] if state["name"] == "elongation_percent")
        assert (grown["limit"], grown["value"]) == (3.0, pytest.approx(1.5, rel=1e-9))
    text = (tmp_path / "sheet.html", *until)
    assert cli("report", drive, "--out", *text).code == 0
    assert "elongation below 3 %" in text[0].read_text().replace("\N{NO-BREAK SPACE}", " ")


@pytest.mark.parametrize(
    ("joint", "limits", "words"),
    [
        ("1e-8", "{critical_depth_mm = 0.1}", "17 teeth, worn by 0.1 mm"),
        ("1e-14", "{critical_depth_mm = 0.1}", "17 teeth, worn by 0.1 mm"),
        ("1e-14", "{over_pins_change_mm = 2e-5}", "until the measurement over pins is 2e-05 mm less"),
    ],
)
def test_what_ends_a_sprocket_is_said_alike_before_and_after_a_chain(cli, drive, joint, limits, words):
    settings = (f"joint.specific_wear_rate_mm2_per_N={joint}", f"stop={limits}")
    text = cli("life", drive, *(word for one in settings for word in ("--set", one))).out
    assert words in " ".join(text.split())


def test_the_answer_takes_twelve_lines(cli, drive, monkeypatch):
    """Chain, both sprockets, what is first and when, band, ratings: in this order, then the rest."""
    monkeypatch.chdir(drive.parent)
    out = cli("life", drive.name, "--set", "mechanism.phases=3").out
    labels = [line.split()[0] for line in out.splitlines()[1:] if line[2] != " "]
    assert labels == [
        *("Chain", "driver", "roll", "First", "Then"),
        *("Band", "Ratings", "Worn", "Warnings", "Assumes", "Next"),
    ]
    assert len(out.splitlines()) <= 12
    day = json.loads(cli("life", drive, "--json").out)["service"]["date"]
    assert f" h ({day}), then every " in out
    assert "jumping: no risk\n" in out


def test_overload_stands_beside_the_hours(cli, drive):
    text = cli("life", drive, "--set", "load.power_kW=15").out
    assert "OVERLOADED: " in text
    assert "life counts wear only" in text or "beyond its rating for 15 000 h" in text


def test_keys_of_one_sprocket_change_its_life_alone(cli, drive):
    before = lives(cli, drive)
    harder = lives(cli, drive, "sprocket.2.wear={specific_wear_rate_mm2_per_N = 4e-9}")
    assert harder["roll"] > before["roll"]
    assert (harder["driver"], harder["chain"]) == (before["driver"], before["chain"])
    softer = lives(cli, drive, "sprocket.1.material={youngs_modulus_MPa = 1e5, poissons_ratio = 0.3}")
    assert softer["driver"] != before["driver"]
    assert (softer["roll"], softer["chain"]) == (before["roll"], before["chain"])


def test_the_wear_of_one_sprocket_leaves_the_joints_of_the_chain_alone(cli, tmp_path, two_sprockets):
    """Joints take the state of the drive, at every sprocket, as there is one chain."""
    path = tmp_path / "drive.toml"
    text = two_sprockets.replace("[joint]\nspecific_wear_rate_mm2_per_N = 1e-8\n", "")
    text = text.replace("specific_wear_rate_mm2_per_N = 5e-9", 'condition = "normalised, dry"')
    path.write_text(text.replace('name = "roll"', 'name = "roll"\nwear = {condition = "hardened, oiled"}'))
    found = drive_life(load_drive(path, ["run.horizon_hours=600"]))
    chains = [result.parts["chain"].hours_run for result in found.results.values()]
    assert chains[0] == pytest.approx(chains[1], rel=1e-12)
    # 7e-9 mm2/N, from 1.1e-9 to 4.4e-8, by the table of wear conditions, with the spread of published rules.
    assert found.drive.driver.drive.joint.coefficient == 7e-9
    low, high = found.band("chain")
    most, least = (math.exp(math.hypot(*map(math.log, of))) for of in ((44 / 7, 2.5), (7 / 1.1, 2.0)))
    assert low.hours_run == pytest.approx(chains[0] / most)
    assert high.hours_run == pytest.approx(chains[0] * least)


def test_folder_of_a_drive_runs_again(cli, tmp_path, two_sprockets):
    gap = tmp_path / "gap.csv"
    case = wearsim.load_case(own_case(20, 17, "driven", 255.0))
    outline = case.drive.outline
    rows = "".join(f"{x:.12g},{y:.12g}\n" for x, y in zip(outline.x, outline.y, strict=True))
    gap.write_text("x_mm,y_mm\n" + rows)
    path, out = tmp_path / "drive.toml", tmp_path / "out"
    text = two_sprockets.replace('name = "roll"\nteeth = 20\nprofile = "iso606"\n', POINTS)
    path.write_text(text)
    assert cli("life", path, "--out", out, "--set", "load.power_kW=1.4").code == 0
    assert cli("life", path, "--out", out).code == 2
    stored = json.loads((out / "drive.json").read_text())
    again = json.loads(cli("life", out / "drive.lock.toml", "--json").out)
    assert again["chain_life_hours"] == stored["chain_life_hours"]
    assert [one["sprocket_life_hours"] for one in again["sprockets"]] == [
        one["sprocket_life_hours"] for one in stored["sprockets"]
    ]
    history = pd.read_csv(out / "history.csv")
    assert list(dict.fromkeys(history["sprocket"])) == ["driver", "roll"]
    last = history[history["sprocket"] == "roll"].iloc[-1]
    assert last["time_hours"] == pytest.approx(stored["sprockets"][1]["sprocket_life_hours"], rel=1e-9)
    flank = pd.read_csv(out / "flank.csv")
    assert set(flank["sprocket"]) == {"driver", "roll"}


@pytest.fixture(scope="module")
def run_of_two(tmp_path_factory, two_sprockets):
    """Folder of the run of a drive, and the result that it holds."""
    folder = tmp_path_factory.mktemp("run_of_two")
    (folder / "drive.toml").write_text(two_sprockets)
    result = wearsim.simulate(folder / "drive.toml")
    result.save(folder / "run")
    return folder / "run", result


def test_run_of_a_drive_is_read_back_number_by_number(run_of_two):
    folder, result = run_of_two
    again = wearsim.DriveLife.load(folder)
    assert again.summary() == result.summary()
    assert again.history.equals(result.history) and again.flank.equals(result.flank)
    assert (again.first, again.ends, again.warnings) == (result.first, result.ends, result.warnings)


def test_commands_take_the_run_of_a_drive(cli, run_of_two, tmp_path):
    folder, _ = run_of_two
    case = folder.parent / "drive.toml"
    assert cli("report", folder, "--out", tmp_path / "run.html").code == 0
    assert cli("report", case, "--out", tmp_path / "case.html").code == 0
    assert (tmp_path / "run.html").read_bytes() == (tmp_path / "case.html").read_bytes()
    assert cli("compare", folder).out == cli("compare", case).out != ""
    table = ("--format", "csv", "--out")
    assert cli("export", folder, *table, tmp_path / "run").code == 0
    assert cli("export", case, "--state", "both", *table, tmp_path / "case").code == 0
    for name in ("driver.csv", "roll.csv"):
        assert (tmp_path / "run" / name).read_bytes() == (tmp_path / "case" / name).read_bytes()
    few = ("--frames", 2, "--width", 320, "--out")
    for source in (folder, case):
        assert cli("animate", source, "--sprocket", "roll", *few, tmp_path / f"{source.stem}.gif").code == 0
    assert (tmp_path / "run.gif").read_bytes() == (tmp_path / "drive.gif").read_bytes()
    roll = folder / "parts" / "roll"
    assert cli("animate", roll, *few, tmp_path / "roll.gif").code == 0
    assert cli("animate", folder, *few, tmp_path / "none.gif").err.count("give --sprocket, one of") == 1
    assert cli("animate", roll, "--sprocket", "roll", *few, tmp_path / "two.gif").code == 2
    done = cli("compare", folder, "--set", "load.power_kW=1")
    assert done.code == 2 and "cannot change the folder of a run" in done.err


@pytest.mark.parametrize(
    ("file", "old", "new", "words"),
    [
        ("drive.json", '"schema_version": 1', '"schema_version": 9', "must have schema_version 1, has 9"),
        ("drive.json", '"case"', '"cases"', "a value in drive.json is missing or of another kind"),
        ("drive.json", "{", "", "drive.json is not readable JSON"),
        (
            "drive.lock.toml",
            "power_kW = 1.3",
            "power_kW = 1.4",
            "load.power_kW of 'driver' was 1.3 and is 1.4",
        ),
        ("drive.lock.toml", "[load]", "[lod]", "lod: unknown table"),
        ("parts/roll/history.csv", "cycles", "cycle", "roll: must be the folder of a result"),
        ("drive.json", '"title": "', '"title": "My ', "drive.json must be as wearsim wrote it"),
        ("parts/roll/result.json", None, None, "result.json: No such file"),
    ],
)
def test_run_of_a_drive_that_was_changed_is_refused(cli, run_of_two, tmp_path, file, old, new, words):
    shutil.copytree(run_of_two[0], tmp_path / "run")
    path = tmp_path / "run" / file
    if old is None:
        path.unlink()
    else:
        assert old in path.read_text()
        path.write_text(path.read_text().replace(old, new, 1))
    done = cli("compare", tmp_path / "run")
    assert done.code == 2 and words in done.err, done.err
    assert "Traceback" not in done.err


def test_run_of_a_drive_with_a_part_elsewhere_is_refused(run_of_two, tmp_path):
    run = shutil.copytree(run_of_two[0], tmp_path / "run")
    (run / "parts" / "roll").rename(tmp_path / "roll")
    (run / "parts" / "roll").symlink_to(tmp_path / "roll")
    with pytest.raises(wearsim.WearsimError, match=r"parts/roll/result.json must lie in this folder"):
        wearsim.DriveLife.load(run)


def test_run_of_a_drive_replaces_itself_only(cli, run_of_two, tmp_path):
    shutil.copytree(run_of_two[0], tmp_path / "run")
    _, result = run_of_two
    result.save(tmp_path / "run", force=True)
    (tmp_path / "run" / "parts" / "roll" / "mine.txt").write_text("mine")
    with pytest.raises(wearsim.WearsimError, match="run"):
        result.save(tmp_path / "run", force=True)
    assert (tmp_path / "run" / "parts" / "roll" / "mine.txt").read_text() == "mine"


def test_teeth_of_one_sprocket_are_read(cli, run_of_two):
    """A reading that the drive's own coefficient gives leaves what is left of the life of that sprocket."""
    folder, result = run_of_two
    case, roll = folder.parent / "drive.toml", result.results["roll"]
    hours, depth = (roll.history_columns[name] for name in ("time_hours", "max_depth_mm"))
    row = int(np.searchsorted(depth, 0.6 * depth[-1]))
    reading = ("remaining", case, "--hours", hours[row], "--depth-mm", depth[row])
    done = cli(*reading, "--sprocket", "roll", "--reading-error-mm", 0.0005, "--json")
    assert done.code == 0, done.err
    found = json.loads(done.out)
    assert found["part"] == "sprocket"
    assert found["remaining_hours"] == pytest.approx(roll.parts["sprocket"].hours - hours[row], rel=1e-9)
    python = wearsim.remaining(case, hours[row], depth=depth[row], error=0.0005, sprocket="roll")
    assert python.summary() == found
    assert python.title.endswith(": roll") and ": roll" in str(python)
    for options, words in (
        ((), "on the teeth of one sprocket: name it, one of 'driver', 'roll'"),
        (("--sprocket", "rol"), "one of 'driver', 'roll' (got 'rol')"),
    ):
        refused = cli(*reading, *options)
        assert refused.code == 2 and words in refused.err
    chain = cli("remaining", case, "--hours", 10, "--elongation", 0.5, "--sprocket", "roll")
    assert chain.code == 2 and "which all sprockets share: leave the sprocket out" in chain.err
    alone = cli("remaining", "08b-19t-wrap", "--hours", 10, "--depth-mm", 0.5, "--sprocket", "roll")
    assert alone.code == 2 and "the only sprocket of this case: leave its name out" in alone.err
    (folder.parent / "log.csv").write_text(
        "time_hours,quantity,value,error\n10,elongation_percent,0.3,0.05\n"
    )
    table = cli("remaining", case, folder.parent / "log.csv", "--sprocket", "roll")
    assert table.code == 2 and "leave out --hours, --sprocket" in table.err


def test_torque_is_that_of_the_driver(cli, drive, tmp_path, two_sprockets):
    power = lives(cli, drive)
    text = two_sprockets.replace("power_kW = 1.3", 'torque_N_m = "41.380285203892786 Nm"')
    (tmp_path / "torque.toml").write_text(text)
    torque = lives(cli, tmp_path / "torque.toml")
    assert torque == pytest.approx(power, rel=1e-3)


@pytest.mark.slow
def test_a_sprocket_with_twice_the_gaps_turns_as_often(cli, tmp_path, two_sprockets):
    """Every second of 40 gaps carries a roller: the drive is that of 20 teeth."""
    chain = """\
pitch_mm = 25.4
roller_diameter_mm = 8.51
inner_width_mm = 7.75
pin_diameter_mm = 4.45
bearing_area_mm2 = 50
mass_kg_per_m = 0.45
"""
    text = two_sprockets.replace('designation = "08B-1"\n', chain)
    (tmp_path / "drive.toml").write_text(text)
    (tmp_path / "double.toml").write_text(text.replace("teeth = 20", "teeth = 40\nengaged_every = 2"))
    single, double = lives(cli, tmp_path / "drive.toml"), lives(cli, tmp_path / "double.toml")
    assert (double["chain"], double["driver"]) == (single["chain"], single["driver"])


def test_blocks_of_the_duty_are_those_of_the_driver(cli, tmp_path, two_sprockets):
    duty = """
[[duty]]
share_of_time = 1.0
power_kW = 1.3
speed_rpm = 300
"""
    (tmp_path / "drive.toml").write_text(two_sprockets)
    (tmp_path / "duty.toml").write_text(
        two_sprockets.replace("[load]\npower_kW = 1.3\nspeed_rpm = 300\n", "") + duty
    )
    assert lives(cli, tmp_path / "duty.toml") == pytest.approx(lives(cli, tmp_path / "drive.toml"), rel=1e-9)


@pytest.mark.parametrize(
    ("wrong", "line", "message"),
    [
        (("teeth = 20", "teeth = 3"), 10, "must be a whole number of at least 5"),
        (
            ('profile = "iso606"\nnodes = 61\n[drive]', 'profile = "evolvent"\n[drive]'),
            11,
            "(got 'evolvent')",
        ),
        (('name = "roll"', 'role = "driver"'), 9, "one sprocket must be 'driven' (got 'driver', 'driver')"),
        (('name = "roll"', 'name = "driver"'), 9, "different names"),
        (('name = "roll"', 'name = " roll"'), 9, "must be without leading or trailing blanks (got ' roll')"),
        (
            ('name = "roll"', 'name = "ro\\nll"'),
            9,
            "must be one line without control characters, holds U+000A",
        ),
        (
            ('name = "roll"', 'name = "=1+1"'),
            9,
            "must not begin with =, +, - or @, like a spreadsheet formula",
        ),
        (('name = "roll"', 'name = "Chain"'), 9, "the chain is a part too"),
        (("links = 110", "links = 110\nmate_teeth = 20"), 15, "the other [[sprocket]] gives this"),
        (("links = 110", "links = 12"), 14, "drive layout: "),
        (("teeth = 20", "teeth = 20\nposition = 3"), 11, "unknown key"),
        (("speed_rpm = 300", "speed_rpm = -300"), 17, "must be greater than or equal to"),
        (("teeth = 20", "teeth = 21\nengaged_every = 2"), 11, "must divide the number of teeth"),
        (("[drive]", '[[sprocket]]\nteeth = 9\nprofile = "iso606"\n[drive]'), 4, "more than two"),
        (("teeth = 20", "teeth = 20\npostion_mm = [1, 2]"), 11, "did you mean 'position_mm'?"),
        (("teeth = 20", "cog = {teeth = 9}"), 10, "must be tables under headers [[sprocket.cog]]"),
        (("teeth = 20\n", ""), 8, "sprocket.2.teeth: this key is required and missing"),
        (("[chain]", "title = 5\n[chain]"), 2, "title: must be a valid string (got 5)"),
        (("[drive]\nlinks = 110", "[[drive]]"), 13, "drive: must be a table"),
    ],
)
def test_what_is_wrong_is_named_with_its_line(cli, tmp_path, wrong, line, message, two_sprockets):
    path = tmp_path / "drive.toml"
    path.write_text(two_sprockets.replace(*wrong))
    done = cli("life", path)
    assert done.code == 2
    assert f"drive.toml:{line}: " in done.err
    assert message in done.err
    assert done.err.count(message) == 1


def test_all_that_is_wrong_comes_in_one_pass(cli, tmp_path, two_sprockets):
    """The place of a sprocket, its teeth and the tables of all of them, each once and under its own key."""
    wrong = two_sprockets.replace('name = "roll"', "power_share = 2").replace("nodes = 61", "nodes = 3", 1)
    path = tmp_path / "drive.toml"
    path.write_text(wrong.replace("speed_rpm = 300", "speed_rpm = -300"))
    keys = [line.split(": ")[1] for line in cli("life", path).err.splitlines()]
    assert keys == ["sprocket.1.nodes", "sprocket.2.power_share", "load.speed_rpm"]


def test_a_wrong_sprocket_hides_no_fault_of_another(cli, tmp_path, two_sprockets):
    path = tmp_path / "drive.toml"
    path.write_text(two_sprockets.replace("nodes = 61", "nodes = 3", 1))
    err = cli("life", path, "--set", "sprocket.2.bore_mm=900").err
    assert "drive.toml:7: sprocket.1.nodes: must be greater" in err
    assert "--set sprocket.2.bore_mm: must be below the root diameter" in err


def test_check_names_both_sprockets_and_every_assumption_once(cli, drive):
    done = cli("check", drive)
    assert done.out.startswith(f"{drive}: ok, sprockets driver, roll\n")
    lines = [line for line in done.out.splitlines() if not line.startswith(" " * 11)]
    assert len(lines) == len(set(lines))
    found = json.loads(cli("check", drive, "--json").out)
    assert found["sprockets"] == ["driver", "roll"]


def test_required_hours_are_those_of_every_part(cli, drive):
    shortest = min(lives(cli, drive).values())
    assert cli("life", drive, "--require-hours", str(0.9 * shortest)).code == 0
    done = cli("life", drive, "--require-hours", str(1.1 * shortest))
    assert done.code == 4
    assert "life of the chain" in done.err


def test_grids_of_all_sprockets_are_verified(cli, drive):
    """Each is that of the sprocket alone: the chain's wear is the same on every grid."""
    done = cli("life", drive, "--verify-grid", "--set", "run.horizon_hours=50")
    assert done.code == 0
    assert [line.split()[1] for line in done.out.splitlines() if "nodes:" in line] == ["driver,", "roll,"]
    found = json.loads(cli("life", drive, "--verify-grid", "--json", "--set", "run.horizon_hours=50").out)
    assert {name: len(grid["nodes"]) for name, grid in found["grid"].items()} == {"driver": 3, "roll": 3}


@pytest.mark.slow
def test_a_key_is_solved_for_on_a_drive(cli, drive):
    """The chain ends first, its joints wear by its pull: half the power, twice the life."""
    hours = min(lives(cli, drive).values())
    options = ("--require-hours", str(2.0 * hours), "--solve-for")
    found = json.loads(cli("life", drive, *options, "load.power_kW", "--json").out)
    assert found["solve_for"]["met"]
    assert found["life_hours"] == found["solve_for"]["life_hours"] == pytest.approx(2.0 * hours, rel=0.1)
    assert found["solve_for"]["value"] == pytest.approx(0.5 * 1.3, rel=0.1)
    done = cli("life", drive, *options, "sprocket.2.face_width_mm", "--out", drive.parent / "solved")
    assert done.code in (0, 4) and "sprocket.2.face_width_mm = " in done.out
    assert (drive.parent / "solved" / "drive.json").is_file()
    done = cli("life", drive, *options, "sprocket.3.teeth")
    assert done.code == 2 and "it is not in the case" in done.err
