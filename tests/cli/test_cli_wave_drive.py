"""``wearsim wave-drive``: text, JSON, files and exit codes."""

import csv
import json
from pathlib import Path

import pytest

CASE = Path(__file__).parents[2] / "cases" / "sizing" / "wave-drive-100.toml"


def test_text(cli):
    done = cli("handbook", "wave-drive", CASE)
    assert done.code == 0
    lines = done.out.splitlines()
    assert lines[0] == "Wave gear, ratio 100, 800 N m"
    assert max(map(len, lines)) <= 100
    assert [line.split()[0] for line in lines[3:10]] == [
        "pressure",
        "crushing",
        "torsion",
        "tooth_wear",
        "flank_pressure",
        "rim_bending",
        "rim_endurance",
    ]
    assert (
        "pressure: 246 mm NOT reproduced (113.9 mm); needs allowable_pressure_MPa = 6.449 instead of 60-65\n"
        in done.out
    )
    assert done.out.count("mm reproduced;") == 6
    assert "  Assumes    3 assumptions and 5 defaults: --explain shows them\n" in done.out
    explained = cli("handbook", "wave-drive", CASE, "--explain").out
    assert "defaults: pressure.load_nonuniformity = 1.5" in " ".join(explained.split())
    assert "the methods differ by a factor of 1.82" in done.err
    assert "rim_bending: 1 % of endurance_limit_MPa changes the diameter by 3.2 %" in done.err
    assert cli("handbook", "wave-drive", CASE, "-q").err == ""


def test_json_and_files_agree(cli, tmp_path):
    out = tmp_path / "wave"
    done = cli("handbook", "wave-drive", CASE, "--json", "--out", out)
    assert done.code == 0
    found = json.loads(done.out)
    assert list(found)[:4] == ["schema_version", "wearsim_version", "case", "title"]
    assert found == json.loads((out / "result.json").read_text())
    assert {path.name for path in out.iterdir()} == {
        ".wearsim",
        "result.json",
        "methods.csv",
        "elasticities.csv",
        "wave_drive.png",
        "wave_drive.svg",
    }
    with (out / "methods.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [list(row) for row in rows] == [list(method) for method in found["methods"]]
    assert [float(row["flexspline_diameter_mm"]) for row in rows] == [
        method["flexspline_diameter_mm"] for method in found["methods"]
    ]
    assert [method["reproduces"] for method in found["methods"]] == [False, *[True] * 6]
    assert all(warning in done.err for warning in found["warnings"])


def test_force_replaces_only_what_it_wrote(cli, tmp_path):
    out = tmp_path / "wave"
    assert cli("handbook", "wave-drive", CASE, "--out", out).code == 0
    assert cli("handbook", "wave-drive", CASE, "--out", out).code == 2
    assert cli("handbook", "wave-drive", CASE, "--out", out, "--force").code == 0
    (out / "notes.txt").write_text("mine")
    assert cli("handbook", "wave-drive", CASE, "--out", out, "--force").code == 2


def test_defaults_suffice(cli, tmp_path):
    path = tmp_path / "own.toml"
    path.write_text(
        "format_version = 1\n[wave_drive]\ngear_ratio = 120\n"
        'output_torque_N_m = "0.5 kN m"\ngenerator_speed_rpm = 1000\n'
    )
    done = cli("handbook", "wave-drive", path, "--json")
    assert done.code == 0
    found = json.loads(done.out)
    assert found["title"] == "own"
    assert [row["published_diameter_mm"] for row in found["methods"]] == [None] * 7
    text = cli("handbook", "wave-drive", path, "--explain")
    assert "reproduced" not in text.out
    assert "crushing.allowable_crushing_MPa = 20" in text.out.replace("\n             ", " ")


def test_what_has_no_diameter_with_its_defaults_is_left_out(cli, tmp_path):
    path = tmp_path / "low.toml"
    path.write_text(
        "format_version = 1\n[wave_drive]\ngear_ratio = 60\n"
        "output_torque_N_m = 500\ngenerator_speed_rpm = 1000\n"
    )
    done = cli("handbook", "wave-drive", path, "--json")
    assert done.code == 0
    assert len(json.loads(done.out)["methods"]) == 6
    assert "warning: left out: rim_bending: the endurance of the rim" in done.err
    assert "torsion: gear_ratio = 60 is outside 100-400" in done.err


def test_printed_formula_is_flagged(cli):
    done = cli("handbook", "wave-drive", CASE, "--set", "torsion.formula=printed")
    assert done.code == 0
    assert "torsion: 142 mm NOT reproduced (451.3 mm)" in done.out
    assert "torsion: the formula as printed is wrong" in done.err


@pytest.mark.parametrize(
    ("setting", "named"),
    [
        ("wave_drive.gear_ratio=0", "must be greater than 0"),
        ("wave_drive.tooth_length_ratio=2", "must be less than or equal to 1"),
        ("wave_drive.output_torque_N_m='5 kg'", "the unit must be convertible to N*m"),
        ("torsion.formula=corect", "did you mean 'corrected'"),
        ("pressure.allowable_pressure=60", "did you mean 'allowable_pressure_MPa'"),
        ("rim_bending.safety_factor=0.9", "must be greater than or equal to 1"),
        ("generator_bearing.constant=1", "unknown key"),
    ],
)
def test_bad_input_is_2_and_named(cli, setting, named):
    done = cli("handbook", "wave-drive", CASE, "--set", setting)
    assert (done.code, done.out) == (2, "")
    assert f"--set {setting.partition('=')[0]}: " in done.err
    assert named in done.err


@pytest.mark.parametrize(
    ("setting", "named"),
    [
        ("rim_bending.thickness_ratio=0.05", "rim_bending: the endurance of the rim, 142.6 MPa"),
        ("wave_drive.generator_speed_rpm=6000", "generator_speed_rpm must be below 4919"),
    ],
)
def test_no_diameter_is_3(cli, setting, named):
    done = cli("handbook", "wave-drive", CASE, "--set", setting)
    assert (done.code, done.out) == (3, "")
    assert named in done.err
    assert "Traceback" not in done.err
    done = cli("handbook", "wave-drive", CASE, "--set", setting, "--json")
    assert done.code == 3
    assert json.loads(done.out)["error"]["kind"] == "GeometryError"


def test_page_shows_what_is_printed(cli):
    docs = Path(__file__).parents[2] / "docs"
    page = (docs / "wave-drive.md").read_text(encoding="utf-8")
    assert f"```text\n{cli('handbook', 'wave-drive', CASE).out}```" in page
    picture = (docs / "wave-drive.svg").read_text(encoding="utf-8")
    assert "Wave gear, ratio 100, 800 N m" in picture
