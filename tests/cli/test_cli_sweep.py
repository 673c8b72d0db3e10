"""``wearsim sweep``: lives over values of any keys."""

import csv
import json
import re
from pathlib import Path

import pytest

STUDIES = sorted((Path(__file__).parents[2] / "cases" / "studies").glob("*.toml"))

STUDY = """\
format_version = 1
title = "Test sweep"
case = "drive.toml"
"""
GRID = """\
[grid]
"sprocket.teeth" = [20, 25]
"load.power_kW" = {from = 2.0, to = 8.0, count = 3, spacing = "log"}
"""


@pytest.fixture
def sweep(drive, tmp_path):
    """Function that writes the file of a sweep of the test drive and returns its path."""
    drive()

    def write(text, head=STUDY):
        path = tmp_path / "study.toml"
        path.write_text(head + text)
        return path

    return write


def lives(cli, path, *options):
    done = cli("sweep", path, "--json", *options)
    rows = [json.loads(line) for line in done.out.splitlines()]
    return done, [(row["inputs"], row["life_hours"]) for row in rows]


def test_every_combination_of_a_grid(cli, sweep, drive):
    done, found = lives(cli, sweep(GRID))
    assert done.code == 0
    assert [inputs["sprocket.teeth"] for inputs, _ in found] == [20, 20, 20, 25, 25, 25]
    assert [inputs["load.power_kW"] for inputs, _ in found[:3]] == pytest.approx([2, 4, 8])
    single = cli("life", drive(), "--json", "--set", "sprocket.teeth=25", "--set", "load.power_kW=8")
    assert found[-1][1] == json.loads(single.out)["life_hours"]
    # Wear goes with the load.
    assert found[0][1] == pytest.approx(4.0 * found[2][1], rel=1e-4)


@pytest.mark.parametrize(
    ("given", "teeth"),
    [
        ("{from = 20, to = 28, count = 5}", [20, 22, 24, 26, 28]),
        ('{from = 20, to = 80, count = 3, spacing = "log"}', [20, 40, 80]),
    ],
)
def test_range_of_a_whole_number(cli, sweep, given, teeth):
    done, found = lives(cli, sweep(f"[grid]\nsprocket.teeth = {given}\n"))
    assert done.code == 0, done.err
    counts = [inputs["sprocket.teeth"] for inputs, _ in found]
    assert counts == teeth
    assert all(isinstance(count, int) for count in counts)


def test_range_between_whole_numbers_is_refused(cli, sweep):
    done = cli("sweep", sweep("[grid]\nsprocket.teeth = {from = 20, to = 25, count = 3}\n"), "--dry-run")
    assert (done.code, done.out) == (2, "")
    assert "grid.sprocket.teeth: must be a valid integer" in done.err
    assert "22.5" in done.err


def test_keys_that_go_together_and_designs(cli, sweep):
    text = "[[zip]]\nsprocket.teeth = [20, 25]\nload.power_kW = [3.0, 4.0]\n"
    text += "[[design]]\nsprocket.nodes = 51\n[[design]]\nsprocket.nodes = 101\n"
    _, found = lives(cli, sweep(text))
    rows = [tuple(inputs.values()) for inputs, _ in found]
    assert rows == [(20, 3.0, 51), (20, 3.0, 101), (25, 4.0, 51), (25, 4.0, 101)]


def test_setting_of_the_case(cli, sweep):
    _, found = lives(cli, sweep(GRID))
    _, deeper = lives(cli, sweep(GRID), "--set", "stop.critical_depth_mm=0.01")
    assert all(less < more for (_, less), (_, more) in zip(deeper, found, strict=True))


def test_table_on_stdout_and_failures(cli, sweep):
    done = cli("sweep", sweep('[grid]\n"load.power_kW" = [3, 3000]\n'))
    assert done.code == 5
    head, _, good, bad = done.out.splitlines()
    assert head == "| load.power_kW | life, h | ended by |"
    assert good.startswith("| 3 | ")
    assert good.endswith(" | critical_depth_mm |")
    assert bad.startswith("| 3000 | failed: load.")
    assert "1 of 2 cases failed, first case 1" in done.err
    done = cli("sweep", sweep('[grid]\n"load.power_kW" = [3000, 4000]\n'))
    assert done.code == 3
    assert "2 of 2 cases failed" in done.err


def test_case_with_several_faults_stays_one_row(cli, sweep):
    done = cli("sweep", sweep('[grid]\n"load.power_kW" = [3, 3000]\n"sprocket.teeth" = [20, 9]\n'))
    table = done.out.splitlines()
    assert len(table) == 2 + 4
    assert all(line.startswith("| ") and line.endswith(" |") for line in table[2:])
    assert "load.power_kW: " in table[-1]
    assert "; sprocket.evolute_offset_mm: " in table[-1]


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ('[grid]\n"load.power_kW" = ["a", 3, true, -5]\n', [":5: grid.load.power_kW: must be"] * 3),
        ('[[zip]]\n"title" = ["A", 2]\n"sprocket.teeth" = [20, 21]\n', ["zip.1.title: must be"]),
        ('[grid]\n"mechanism.kind" = [[1]]\n', ["grid.mechanism.kind: must be 'strand'"]),
    ],
)
def test_value_that_a_key_can_never_have(cli, sweep, text, told):
    done = cli("sweep", sweep(text), "--dry-run")
    assert (done.code, done.out) == (2, "")
    lines = done.err.splitlines()
    assert len(lines) == len(told)
    assert all(message in line for message, line in zip(told, lines, strict=True))


def test_case_that_is_wrong_whatever_the_values(cli, sweep):
    done = cli("sweep", sweep(GRID), "--dry-run", "--set", "mechanism=3")
    assert (done.code, done.err) == (2, "--set mechanism: must be a table (got 3)\n")
    done = cli("sweep", sweep(GRID, STUDY.replace("drive", "study")), "--dry-run")
    assert done.code == 2
    assert "study.toml: must be an input of this command, but is one of wearsim sweep" in done.err


def test_limit_that_is_not_reached(cli, sweep):
    done = cli("sweep", sweep(GRID), "--set", "run.horizon_hours=5")
    assert done.out.count("> 5 (limit not reached)") == 6


def test_plan_without_a_run(cli, sweep, tmp_path):
    done = cli("sweep", sweep(GRID), "--dry-run")
    assert done.code == 0
    assert "cases        6, of which 6 are to be run" in done.out
    assert " s in one thread, from 4 cases" in done.out
    assert "files" not in done.out


def test_many_cases_say_their_time_before_they_begin(cli, sweep, monkeypatch):
    assert "are to be run" not in cli("sweep", sweep(GRID)).err
    monkeypatch.setattr("wearsim.command.study_run._LARGE", 5)
    assert re.search(
        r"^6 cases are to be run, about \d+ s in one thread$", cli("sweep", sweep(GRID)).err, re.M
    )


@pytest.mark.wide
def test_folder_and_going_on(cli, sweep, tmp_path):
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    out = tmp_path / "out"
    first = cli("sweep", sweep(GRID), "--out", out)
    assert first.code == 0
    names = {f"{name}.{kind}" for name in ("curves", "heat_map", "parallel") for kind in ("png", "svg")}
    assert {path.name for path in out.iterdir()} == {
        ".wearsim",
        *names,
        "cases.csv",
        "summary.md",
        "study.json",
        "shards",
    }
    with (out / "cases.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["sprocket.teeth"] for row in rows] == ["20"] * 3 + ["25"] * 3
    before = (out / "cases.csv").read_bytes()
    assert cli("sweep", sweep(GRID), "--out", out).out == first.out
    assert (out / "cases.csv").read_bytes() == before
    planned = cli("sweep", sweep(GRID), "--out", out, "--dry-run")
    assert "cases        6, of which 0 are to be run" in planned.out
    other = sweep(GRID.replace("8.0", "9.0"))
    assert cli("sweep", other, "--out", out).code == 2
    assert cli("sweep", other, "--out", out, "--force").code == 0
    single = sweep('[grid]\n"sprocket.teeth" = [20, 25]\n')
    assert "heat_map.png" in (out / ".wearsim").read_text(encoding="utf-8").splitlines()
    (out / "mine.png").write_text("mine")
    assert cli("sweep", single, "--out", out, "--force").code == 0
    assert not (out / "heat_map.png").exists()
    assert "heat_map.png" not in (out / ".wearsim").read_text(encoding="utf-8")
    assert (out / "mine.png").exists()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "a sweep needs values for a key"),
        ('[grid]\n"sprocket.tooth" = [3]\n', "must be a key of a case; did you mean 'sprocket.teeth'"),
        ('[grid]\n"sprocket.teeth" = []\n', "must hold at least 1 value"),
        ('[grid]\n"a.b" = {from = 1.0, to = 2.0, count = 1}\n', "greater than or equal to 2"),
        ('[grid]\n"a.b" = {from = 0.0, to = 2.0, count = 3, spacing = "log"}\n', "both ends above 0"),
        ('[grid]\n"a.b" = {from = inf, to = 2.0, count = 3}\n', "finite number"),
        ('[grid]\n"a.b" = {from = 2.0, to = 2.0, count = 3}\n', "must differ from from = 2"),
        ('[grid]\n"a.b" = [20, 20]\n', "each value may appear once"),
        ('[grid]\n"a.b" = [[nan, 1.0]]\n', "must be"),
        ('[grid]\n"a.b" = [[1979-05-27]]\n', "must be"),
        (
            '[grid]\n"a.b" = [[1], {a = 2}]\n',
            ":5: grid.a.b.2: must be a finite number, a word, true or false",
        ),
        ("grid = 3\n", ":4: grid: must be a table (got 3)"),
        ('[[zip]]\n"a.b" = 3\n', "zip.1.a.b: must be a list of values (got 3)"),
        ('[grid]\n"a.b" = {from = "x", to = 2.0, count = 3}\n', "grid.a.b.from: must be a number (got 'x')"),
        ('[grid]\n"a.b" = [1]\na.b = [2]\n', "a.b is given twice"),
        ('[[zip]]\n"a.b" = [1, 2]\n"a.c" = [1]\n', "need as many values: a.b 2, a.c 1"),
        ('[grid]\n"a.b" = [1]\n[[zip]]\n"a.b" = [1]\n', "a.b stands in two places"),
        ('[[design]]\n"a.b" = 1\n[[design]]\n"a.c" = 1\n', "every [[design]] must give the same keys"),
    ],
)
def test_bad_studies(cli, sweep, text, message):
    done = cli("sweep", sweep(text))
    assert (done.code, done.out) == (2, "")
    assert message in done.err


def test_case_that_is_not_there(cli, sweep):
    done = cli("sweep", sweep(GRID, STUDY.replace("drive", "other")))
    assert done.code == 2
    assert "other.toml: must be a readable file" in done.err


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--threads", 2, "--jobs", 2), "--jobs and --threads do not go together"),
        (("--tls-key", "study.toml"), "the --tls options need --scheduler"),
        (("--scheduler", "tcp://x", "--scheduler-file", "study.toml"), "do not go together"),
    ],
)
def test_options_that_do_not_go_together(cli, sweep, monkeypatch, tmp_path, options, message):
    path = sweep(GRID)
    monkeypatch.chdir(tmp_path)
    done = cli("sweep", path, *options)
    assert done.code == 2
    assert message in done.err


def test_interrupt_says_how_to_go_on(cli, sweep, monkeypatch):
    from wearsim.runner import run_study as run

    def interrupted(shard):
        raise KeyboardInterrupt

    monkeypatch.setattr(run, "_run", lambda waiting, workers: interrupted(waiting))
    done = cli("sweep", sweep(GRID))
    assert done.code == 130
    assert "interrupted: nothing is kept without --out" in done.err


def test_ends_and_spacing_of_a_range(cli, sweep):
    text = '[grid]\n"load.power_kW" = {from = 2.0, to = 8.0, count = 3, spacing = "linear"}\n'
    _, found = lives(cli, sweep(text))
    assert [inputs["load.power_kW"] for inputs, _ in found] == [2.0, 5.0, 8.0]


@pytest.mark.parametrize("path", STUDIES, ids=lambda path: path.stem)
def test_shipped_studies(cli, path):
    done = cli("sweep", path, "--dry-run")
    assert done.code == 0
    assert done.out.startswith("cases        ")
    done, found = lives(cli, path)
    assert (done.code, done.err) == (0, "")
    assert len(found) == 20 and all(life > 0.0 for _, life in found)


def test_dollars_are_no_formulas(cli, sweep, tmp_path):
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    text = '[grid]\n"title" = ["$x_{$", "cost $"]\n"sprocket.teeth" = [20, 25]\n'
    out = tmp_path / "out"
    path = sweep(text, STUDY.replace("Test sweep", "cost $x_{$"))
    assert cli("sweep", path, "--out", out).code == 0
    assert "cost $x_{$" in (out / "parallel.svg").read_text(encoding="utf-8")


def test_swept_key_takes_the_place_of_what_gives_the_same(cli, sweep, drive):
    """The case gives a power. P = F v with v = n z p: 3 kN at 20 teeth are 20/25 of those at 25 teeth."""
    done, found = lives(cli, sweep('[grid]\n"load.tension_N" = [3000]\n"sprocket.teeth" = [20, 25]\n'))
    assert (done.code, len(found)) == (0, 2)
    single = cli("life", drive(), "--json", "--set", "load.tension_N=3000")
    assert json.loads(single.out)["title"].endswith("with load.tension_N = 3000, without load.power_kW")
    assert found[0][1] == json.loads(single.out)["life_hours"]
    both = cli("check", drive(), "--set", "load.tension_N=3000", "--set", "load.power_kW=3")
    assert both.code == 2
    assert "give exactly one of tension_N, power_kW, torque_N_m" in both.err


def test_warnings_of_cases_close_the_answer(cli, sweep):
    """A tolerance of 1e-5 is out of reach, one of 0.1 is not; rows of --json hold their own warnings."""
    path = sweep('[grid]\n"run.life_tolerance" = [0.1, 1e-5]\n')
    done = cli("sweep", path)
    missed, line = [line for line in done.err.splitlines() if line.startswith("warning: ")]
    assert line.startswith("warning: 1 of 2 cases has warnings")
    assert "the first: numerical error " in line
    as_json = cli("sweep", path, "--json")
    error = json.loads(as_json.out.splitlines()[1])["numerical_error"]
    assert missed.startswith("warning: 1 of 2 cases misses its run.life_tolerance, with a stated error of up")
    assert f"up to {100 * error:.2g} %" in missed
    assert as_json.err.count("warning") == 1
