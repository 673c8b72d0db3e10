"""``wearsim handbook strength``: text, JSON, files and bad input."""

import csv
import json
import re
from pathlib import Path

import pytest

CASES = Path(__file__).parents[2] / "cases" / "sizing"
A, B = CASES / "strength-a-tempered.toml", CASES / "strength-b-carburised.toml"


@pytest.mark.parametrize(("case", "allowed"), [(A, "609.1"), (B, "1140.4")])
def test_answer(cli, case, allowed):
    done = cli("handbook", "strength", case)
    assert done.code == 0
    assert f"[sigma]_H = {allowed} MPa (limited by the pinion)" in done.out
    assert max(map(len, done.out.splitlines())) <= 100
    assert "Traceback" not in done.err


def test_json_agrees_with_the_text(cli):
    found = json.loads(cli("handbook", "strength", A, "--json").out)
    assert found["schema_version"] == 1
    assert found["case"] == "strength-a-tempered"
    assert found["contact_life_of"] == found["contact_governs"] == "pinion"
    hours = re.search(r"contact fatigue: ([\d ]+) h, pinion first", cli("handbook", "strength", A).out)[1]
    assert float(hours.replace(" ", "")) == pytest.approx(found["contact_life_hours"], rel=1e-3)
    assert [gear["gear"] for gear in found["gears"]] == ["pinion", "wheel"]
    for gear in found["gears"]:
        for name in ("contact", "bending"):
            assert gear[f"{name}_margin"] == pytest.approx(
                gear[f"allowable_{name}_MPa"] / gear[f"{name}_stress_MPa"]
            )


def test_a_life_without_end_says_so(cli):
    found = json.loads(cli("handbook", "strength", B, "--json").out)
    assert (found["contact_life_is_bound"], found["contact_life_of"]) == (True, None)
    assert "contact fatigue: > 3 000 h, neither gear" in cli("handbook", "strength", B).out
    never = cli("handbook", "strength", B, "--set", "load.pinion_torque_N_m=2500")
    assert "contact fatigue: 0 h, pinion first" in never.out
    assert "warning: pinion: the contact stress of" in never.err


def test_unknown_yield_strength(cli):
    """What is not known is null, and said."""
    case = B, "--set", "pinion.treatment=quenched_and_tempered"
    done = cli("handbook", "strength", *case, "--json")
    assert json.loads(done.out)["gears"][0]["greatest_contact_MPa"] is None
    assert "pinion.yield_strength_MPa" in done.err
    assert "not known" in cli("handbook", "strength", *case).out


def test_files(cli, tmp_path):
    place = tmp_path / "out"
    assert cli("handbook", "strength", A, "--out", place).code == 0
    assert {path.name for path in place.iterdir()} == {
        ".wearsim",
        "result.json",
        "gears.csv",
        "allowable_over_hours.csv",
        "strength.png",
        "strength.svg",
    }
    found = json.loads((place / "result.json").read_text("utf-8"))
    with (place / "allowable_over_hours.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    for gear in found["gears"]:
        curve = [row for row in rows if row["gear"] == gear["gear"]]
        hours = [float(row["time_hours"]) for row in curve]
        stress = [float(row["allowable_contact_MPa"]) for row in curve]
        assert hours == sorted(hours)
        assert stress == sorted(stress, reverse=True)
        later = next(i for i, each in enumerate(hours) if each > found["life_hours"])
        assert stress[later] < gear["allowable_contact_MPa"] < stress[later - 1]
    assert cli("handbook", "strength", A, "--out", place).code == 2


@pytest.mark.parametrize(
    ("settings", "code", "words"),
    [
        (["drive.gear_ratio=0.5"], 2, "--set drive.gear_ratio: must be greater than or equal to 1"),
        (["drive.life_years=2"], 2, "--set drive.life_years: life_hours gives the life already"),
        (["drive.regime=VI"], 2, "--set drive.regime: must be"),
        (["pinion.treatment=nitrided"], 2, "pinion.contact_limit_MPa: treatment = 'nitrided' needs"),
        (["load.module=3"], 2, "did you mean 'module_mm'"),
    ],
)
def test_bad_input(cli, settings, code, words):
    done = cli("handbook", "strength", A, *(part for each in settings for part in ("--set", each)))
    assert done.code == code
    assert words in done.err
    assert "Traceback" not in done.err


def test_the_line_of_keys_that_do_not_fit(cli, tmp_path):
    path = tmp_path / "case.toml"
    text = B.read_text("utf-8").replace("share_of_time = 0.40", "share_of_time = 0.45")
    path.write_text(text.replace("life_hours = 3000", 'life_hours = 3000\nregime = "I"'), "utf-8")
    done = cli("handbook", "strength", path)
    assert done.code == 2
    assert f"{path}:11: drive.regime: [[load_spectrum]] gives the loads already" in done.err
    assert "load_spectrum: the shares of time must come to 1, come to 1.05" in done.err


def test_a_load_spectrum_of_overloads_only(cli):
    done = cli("handbook", "strength", B, "--set", "drive.life_hours=0.1", "--json")
    assert done.code == 3
    assert json.loads(done.out)["error"]["kind"] == "GeometryError"
    assert "must act for at least 50000 cycles" in done.err


def test_schema(cli):
    found = json.loads(cli("schema", "--of", "strength").out)
    assert found["title"] == "wearsim handbook strength"
    tables = found["$defs"].values()
    for table in (found, *tables):
        for name, entry in table["properties"].items():
            assert entry.get("description") or "$ref" in str(entry), name


def test_the_page_shows_what_the_case_prints(cli):
    page = (CASES.parents[1] / "docs" / "strength.md").read_text("utf-8")
    assert f"```text\n{cli('handbook', 'strength', A).out}```" in page
