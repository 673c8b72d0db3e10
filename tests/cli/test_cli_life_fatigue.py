"""``wearsim life`` with ``[fatigue]``: contact fatigue beside the wear, and which governs."""

import csv
import json
from pathlib import Path

import jsonschema
import pytest

from wearsim.quantities import grouped

HARD = "fatigue.sprocket={treatment='surface_hardened', hardness_HRC=45}"
MILD = ("--set", "stop.critical_depth_mm=0.7")


def power(value):
    return ("--set", f"load.power_kW={value}")


@pytest.fixture
def life(cli, drive):
    """Function that runs the test drive with a hardened sprocket."""

    def run(*arguments):
        return cli("life", drive(), "--set", HARD, *arguments)

    return run


@pytest.fixture
def printed(life, cli):
    """Function that gives the object of such a run, held against the schema."""

    def run(*arguments):
        found = json.loads(life("--json", *arguments).out)
        schema = json.loads(cli("schema", "--result").out)
        jsonschema.Draft202012Validator(schema).validate(found)
        return found

    return run


def one_line(done):
    assert done.code == 0
    return " ".join(done.out.split())


def governing(found):
    return found["governing_life"], found["governing_life_hours"]


def test_wear_governs(life, printed):
    found = printed()
    wear, fatigue = found["life_hours"], found["sprocket_fatigue_life_hours"]
    assert wear < fatigue
    assert governing(found) == ("wear", wear)
    expected = f"Governs wear, {grouped(wear)} h (contact fatigue of the sprocket {grouped(fatigue)} h)"
    assert expected in one_line(life())


def test_contact_fatigue_governs(life, printed):
    found = printed(*MILD)
    wear, fatigue = found["life_hours"], found["sprocket_fatigue_life_hours"]
    assert fatigue < wear
    assert governing(found) == ("sprocket_fatigue", fatigue)
    text = one_line(life(*MILD))
    assert (f"Governs contact fatigue of the sprocket, {grouped(fatigue)} h (wear {grouped(wear)} h)") in text
    assert "contact fatigue of the sprocket ends the life before wear" in text


def test_fatigue_that_never_comes(life, printed):
    found = printed(*power(1))
    assert found["sprocket_fatigue_life_hours"] is None
    assert governing(found) == ("wear", found["life_hours"])
    assert "(contact fatigue of the sprocket never)" in one_line(life(*power(1)))


def test_stress_that_is_allowed_at_no_time(life, printed):
    found = printed(*power(14))
    assert found["sprocket_fatigue_life_hours"] == 0.0
    assert governing(found) == ("sprocket_fatigue", 0.0)
    text = one_line(life(*power(14)))
    assert "Governs contact fatigue of the sprocket, from the start (wear" in text
    assert "too high for the sprocket from the start" in text


def test_nothing_within_the_run(life, printed):
    short = ("--set", "run.horizon_hours=50")
    assert governing(printed(*short)) == (None, None)
    expected = "Governs nothing within 50 h: wear > 50 h, contact fatigue of the sprocket 7 958 h"
    assert expected in one_line(life(*short))


def test_required_hours_are_those_of_wear_and_fatigue(life):
    assert life(*MILD, "--require-hours", "7900").code == 0
    done = life(*MILD, "--require-hours", "8000")
    assert done.code == 4
    assert "drive: sprocket fatigue life 7958.17 h is below 8000 h" in done.err
    assert "drive: life" not in done.err


def test_nothing_is_said_without_the_table(cli, drive):
    assert "Governs" not in cli("life", drive()).out
    found = json.loads(cli("life", "--json", drive()).out)
    assert not [key for key in found if "fatigue" in key or "governing" in key]


def test_gears_say_which_governs(cli):
    path = Path(__file__).parents[2] / "cases" / "fzg-c14-16t-mild.toml"
    found = json.loads(cli("life", "--json", path).out)
    assert governing(found) == ("wear", found["life_hours"])
    text = one_line(cli("life", path))
    assert f"Governs wear, {grouped(found['life_hours'])} h (contact fatigue of the pinion" in text


@pytest.mark.wide
def test_with_and_without_side_by_side(life, cli, drive, tmp_path):
    assert life("--out", tmp_path / "run").code == 0
    done = cli("compare", tmp_path / "run", drive("plain"), "--out", tmp_path / "both")
    assert done.code == 0
    found = json.loads(life("--json").out)
    with (tmp_path / "both" / "summary.csv").open() as file:
        run, plain = csv.DictReader(file)
    assert run["governing_life"] == "wear"
    assert float(run["governing_life_hours"]) == found["life_hours"]
    assert (plain["governing_life"], plain["governing_life_hours"]) == ("", "")
    head, _, *rows = [line for line in done.out.splitlines() if line.startswith("|")]
    assert head.endswith("| governs |")
    wear, fatigue = (grouped(found[f"{name}life_hours"]) for name in ("", "sprocket_fatigue_"))
    assert f"| wear, {wear} h (contact fatigue of the sprocket {fatigue} h) |" in rows[0]
    assert rows[1].endswith("| - |")


@pytest.mark.wide
def test_fatigue_that_governs_is_compared(cli, drive, tmp_path):
    options = ("--set", HARD, *MILD)
    done = cli("compare", drive(), "--out", tmp_path / "out", *options)
    found = json.loads(cli("life", drive(), "--json", *options).out)
    with (tmp_path / "out" / "summary.csv").open() as file:
        (row,) = csv.DictReader(file)
    assert row["governing_life"] == "sprocket_fatigue"
    assert float(row["governing_life_hours"]) == found["sprocket_fatigue_life_hours"]
    assert "| contact fatigue of the sprocket, 7 958 h (wear " in done.out


def test_assumptions_tell_what_it_rests_on(cli, drive):
    text = one_line(cli("check", drive(), "--explain", "--set", HARD))
    assert "formulas (21) to (26) of source 001, which are for gears" in text
    assert "fatigue.load_factor = 1 (default)" in text
