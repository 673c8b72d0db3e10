"""Runs that are kept by their content: the same answer without a run, and never that of another case."""

import json
import os
import subprocess
import sys
import threading
import time
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import wearsim
from wearsim.catalogue.shipped_cases import shipped_cases
from wearsim.drive import wrap_life
from wearsim.drive.life import drive_life
from wearsim.drive.load_case import load_case
from wearsim.drive.part_life import simulate
from wearsim.result import kept_runs

SHIPPED = {name: str(path) for name, path in shipped_cases().items()}


@pytest.fixture
def kept(tmp_path, monkeypatch, two_sprockets):
    """The folder of kept runs, and the file of a drive beside it."""
    folder = tmp_path / "runs"
    monkeypatch.setenv("WEARSIM_RUNS", str(folder))
    (tmp_path / "drive.toml").write_text(two_sprockets)
    monkeypatch.chdir(tmp_path)
    return folder


@pytest.fixture
def runs(monkeypatch):
    """Teeth of the sprockets that are run, in any order."""
    found = []
    run = wrap_life.simulate_wrap

    def counted(case, progress):
        found.append(case.inputs["sprocket"]["teeth"])
        return run(case, progress)

    monkeypatch.setattr(wrap_life, "simulate_wrap", counted)
    return found


def test_the_next_command_runs_nothing_and_says_the_same(cli, kept, runs):
    first = cli("life", "drive.toml", "--json")
    assert first.code == 0
    assert sorted(runs) == [17, 20]
    assert len(list(kept.glob("*.run"))) == 2
    runs.clear()
    assert cli("life", "drive.toml", "--json").out == first.out
    for command in (["maintain"], ["report", "--out", "page"], ["compare", "--out", "sheets"]):
        assert cli(command[0], "drive.toml", *command[1:]).code == 0
    assert runs == []
    assert cli("life", "drive.toml", "--json", "--fresh").out == first.out
    assert sorted(runs) == [17, 20]


def test_a_clock_that_goes_back(cli, kept, runs, monkeypatch):
    """Runs of later are believed, as their content is; but not if the program is of later too."""
    first = cli("life", "drive.toml", "--json")
    before = {path: path.read_bytes() for path in kept.glob("*.run")}
    now = time.time
    monkeypatch.setattr(kept_runs.time, "time", lambda: now() - 1e6)
    runs.clear()
    assert cli("life", "drive.toml", "--json").out == first.out
    assert sorted(runs) == [17, 20]
    runs.clear()
    old = kept.parent / "drive.toml"
    os.utime(old, (0.0, 0.0))
    monkeypatch.setattr(kept_runs, "_sources", lambda: [old])
    monkeypatch.setattr(kept_runs.time, "time", lambda: now() - 1.0)
    assert cli("life", "drive.toml", "--json").out == first.out
    assert runs == []
    assert {path: path.read_bytes() for path in kept.glob("*.run")} == before


def test_python_runs_what_it_is_asked_for(kept, runs):
    wearsim.simulate("drive.toml")
    wearsim.simulate("drive.toml")
    assert sorted(runs) == [17, 17, 20, 20]
    assert not kept.exists()


@pytest.fixture
def keeping(kept):
    """The folder of kept runs, which this process keeps and reads."""
    kept_runs.keep_runs(kept)
    yield kept
    kept_runs.keep_runs(None)


def test_what_is_kept_is_what_was_run_number_by_number(keeping):
    drive = wearsim.load_case("drive.toml")
    run, read = drive_life(drive), drive_life(drive)
    for name, one in run.results.items():
        other = read.results[name]
        assert one is not other
        assert one.summary() == other.summary()
        assert one.environment == other.environment
        assert one.inputs == other.inputs
        for table in ("history_columns", "flank_columns"):
            left, right = getattr(one, table), getattr(other, table)
            assert list(left) == list(right)
            for column, values in left.items():
                assert values.dtype == right[column].dtype
                np.testing.assert_array_equal(values, right[column])


def test_a_run_keeps_no_title(keeping, runs):
    case = wearsim.load_case("drive.toml").single_cases["roll"]
    simulate(case)
    found = simulate(replace(case, name="other", title="Another title"))
    assert (found.case, found.title) == ("other", "Another title")
    assert runs == [20]


CHANGES = (
    "run.life_tolerance=0.09",
    "sprocket.2.nodes=63",
    "load.power_kW=1.30000001",
    "wear.specific_wear_rate_mm2_per_N=5.0000001e-9",
    "joint.specific_wear_rate_mm2_per_N=1.0000001e-8",
    "service.hours_per_day=15",
    "mechanism.phases=3",
    "drive.links=112",
    "run.horizon_hours=5000",
)


def test_another_case_is_another_content(two_sprockets):
    """Of one sprocket, of which the other's teeth change the layout alone, and of all cogs of a cassette."""
    given = tomllib.loads(two_sprockets)
    cases = [wearsim.load_case(given).single_cases["roll"]]
    cases += [load_case(given, [change]).single_cases["roll"] for change in CHANGES]
    cases += wearsim.load_case(SHIPPED["bicycle-cassette"]).single_cases.values()
    hashes = [kept_runs.content_hash(case) for case in cases]
    assert len(set(hashes)) == len(cases)
    # What no key of its inputs tells.
    cog = cases[-1]
    shared = replace(cog, drive=replace(cog.drive, time_share=0.5 * cog.drive.time_share))
    assert kept_runs.content_hash(shared) not in hashes


def test_the_same_case_is_the_same_content_in_another_process():
    code = (
        "import sys, wearsim; "
        "from wearsim.result.kept_runs import content_hash; "
        "print(*map(content_hash, wearsim.load_case(sys.argv[1]).single_cases.values()))"
    )
    case = SHIPPED["packaging-conveyor"]
    here = [kept_runs.content_hash(one) for one in wearsim.load_case(case).single_cases.values()]
    variables = {**os.environ, "PYTHONHASHSEED": "7"}
    there = subprocess.run(
        [sys.executable, "-c", code, case], capture_output=True, text=True, check=True, env=variables
    )
    assert there.stdout.split() == here


def test_another_program_keeps_other_runs(monkeypatch, two_sprockets):
    case = wearsim.load_case(tomllib.loads(two_sprockets)).single_cases["roll"]
    before = kept_runs.content_hash(case)
    kept_runs._program.cache_clear()
    monkeypatch.setattr(kept_runs, "environment", lambda: {"numpy": "0"})
    try:
        assert kept_runs.content_hash(case) != before
    finally:
        kept_runs._program.cache_clear()


def test_a_program_that_was_edited_meanwhile_keeps_nothing(keeping, runs, monkeypatch):
    case = wearsim.load_case("drive.toml").single_cases["roll"]
    monkeypatch.setattr(kept_runs, "_since", 0.0)
    simulate(case)
    simulate(case)
    assert runs == [20, 20]
    assert not keeping.exists()


def test_mechanisms_of_others_and_what_has_no_hash_are_run(keeping, runs):
    case = wearsim.load_case("drive.toml").single_cases["roll"]
    other = type("OtherDrive", (type(case.drive),), {"__module__": "elsewhere"})
    drive = object.__new__(other)
    vars(drive).update(vars(case.drive))
    for _ in range(2):
        simulate(replace(case, drive=drive))
        simulate(replace(case, inputs={**case.inputs, "title": {1, 2}}))
    assert runs == [20] * 4
    assert not keeping.exists()


def test_inputs_name_their_files_as_a_run_does(keeping, tmp_path, two_sprockets):
    """A result names the files of a case without their folder."""
    (tmp_path / "data").mkdir()
    log = "time_s,speed_rpm,tension_N\n0,300,400\n60,300,500\n120,300,500\n"
    (tmp_path / "data" / "log.csv").write_text(log)
    tables = tomllib.loads(two_sprockets)
    tables["load"] = {"duty_file": str(tmp_path / "data" / "log.csv")}
    case = wearsim.load_case(tables).single_cases["roll"]
    run, read = simulate(case), simulate(case)
    assert run is not read
    assert run.inputs["load"]["duty_file"] == read.inputs["load"]["duty_file"] == "log.csv"
    assert run.inputs == read.inputs


def test_a_user_without_a_home_has_no_kept_runs(cli, kept, monkeypatch):
    def nowhere(name):
        raise RuntimeError("could not determine the home directory")

    monkeypatch.delenv("WEARSIM_RUNS")
    monkeypatch.setattr("platformdirs.user_cache_dir", nowhere)
    done = cli("life", "drive.toml")
    assert (done.code, done.err) == (0, "")


def test_what_killed_writers_left_goes(keeping):
    keeping.mkdir()
    old, new = (keeping / f".{name}.run.x7" for name in ("old", "new"))
    old.write_text("half")
    new.write_text("half")
    os.utime(old, (0.0, 0.0))
    simulate(wearsim.load_case("drive.toml").single_cases["roll"])
    assert not old.exists() and new.exists()


def test_a_damaged_file_is_run_anew(keeping, runs):
    """Cut at any place, one byte changed, that of another run, none of ours."""
    cases = wearsim.load_case("drive.toml").single_cases
    one = simulate(cases["roll"])
    simulate(cases["driver"])
    file = keeping / f"{kept_runs.content_hash(cases['roll'])}.run"
    other = keeping / f"{kept_runs.content_hash(cases['driver'])}.run"
    whole = file.read_bytes()
    places = range(0, len(whole), len(whole) // 3)
    damaged = [whole[:place] for place in places]
    damaged += [whole[:place] + bytes([whole[place] ^ 255]) + whole[place + 1 :] for place in places]
    damaged += [other.read_bytes(), b"", b"PK", b"[]"]
    for content in damaged:
        file.write_bytes(content)
        runs.clear()
        found = simulate(cases["roll"])
        assert found.summary() == one.summary()
        np.testing.assert_array_equal(found.flank["depth_mm"], one.flank["depth_mm"])
        assert runs == [20]
        assert file.read_bytes() == whole


def test_a_folder_that_cannot_be_written_costs_nothing(cli, kept, runs):
    kept.write_text("in the way")
    for _ in range(2):
        done = cli("life", "drive.toml")
        assert (done.code, done.err) == (0, "")
    assert sorted(runs) == [17, 17, 20, 20]
    assert kept.read_text() == "in the way"


def test_what_was_used_longest_ago_goes_first(keeping, monkeypatch):
    cases = [
        load_case(Path("drive.toml"), [f"sprocket.2.nodes={nodes}"]).single_cases["roll"]
        for nodes in (61, 63, 65)
    ]
    names = [f"{kept_runs.content_hash(case)}.run" for case in cases]
    for hour, (case, name) in enumerate(zip(cases[:2], names, strict=False)):
        simulate(case)
        os.utime(keeping / name, (3600.0 * hour, 3600.0 * hour))
    simulate(cases[0])  # now the second was used longest ago
    size = sum(path.stat().st_size for path in keeping.iterdir())
    monkeypatch.setattr(kept_runs, "_MOST_BYTES", 1.2 * size)
    simulate(cases[2])
    assert {path.name for path in keeping.iterdir()} == {names[0], names[2]}


def test_two_writers_of_one_run(keeping):
    """Side by side, over and over, while a third one reads: never half of a file."""
    case = wearsim.load_case("drive.toml").single_cases["roll"]
    run = simulate(case)
    key = kept_runs.content_hash(case)
    file, content = keeping / f"{key}.run", kept_runs._written(run, key)
    done = threading.Event()

    def write():
        while not done.is_set():
            kept_runs.write_file(file, content, force=True)

    writers = [threading.Thread(target=write) for _ in range(2)]
    for writer in writers:
        writer.start()
    try:
        found = [kept_runs._read(file, key, case) for _ in range(100)]
    finally:
        done.set()
        for writer in writers:
            writer.join()
    assert None not in found
    assert [path.name for path in keeping.iterdir()] == [file.name]


def test_doctor_counts_them(cli, kept):
    cli("life", "drive.toml")
    found = {one["name"]: one["found"] for one in json.loads(cli("doctor", "--json").out)["findings"]}
    assert found["kept runs"].startswith(f"{kept}: 2 files")
