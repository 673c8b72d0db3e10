"""``wearsim hertz-check``: text, JSON, files and exit codes."""

import csv
import json
import sys
from pathlib import Path

import numpy as np
import pytest

import wearsim.handbook.hertz_check.hertz_fem
from wearsim.cli.handbook import HANDBOOK
from wearsim.handbook.hertz_check.hertz_fem import FemContact

CASE = Path(__file__).parents[2] / "cases" / "sizing" / "hertz-check-36-54.toml"

TABLES = {"combinations.csv", "changes.csv", "comparison.csv", "axis_stresses.csv"}
PICTURES = {"hertz_check.png", "hertz_check.svg"}


@pytest.fixture
def solved(monkeypatch):
    """Finite elements that are quick and twice too high, and the meshes asked for."""
    requested = []

    def hertz_fem(contact, elements):
        requested.append(elements)
        place = np.linspace(0.0, 0.2, 8)
        pressure = np.maximum(900.0 - 9000.0 * place, 0.0)
        return FemContact(elements, 100 * elements, 0.5, place, pressure, place, 0.5 * pressure)

    monkeypatch.setattr(wearsim.handbook.hertz_check.hertz_fem, "hertz_fem", hertz_fem)
    return requested


def test_text(cli):
    done = cli("handbook", "hertz-check", CASE)
    assert done.code == 0
    lines = done.out.splitlines()
    assert lines[0] == "Gear pair 36/54 at the pitch point, 240 N m"
    assert max(map(len, lines)) <= 100
    assert "453.938 MPa with the coefficient 0.418, 454.161 MPa with the exact 0.418205" in done.out
    assert sum("  11824.197" in line for line in lines) == 4
    assert "nearest 453.938 MPa, -2.17 %" in done.out
    (torque,) = [line.split() for line in lines if line.startswith("    torque_N_m ")]
    assert torque == ["torque_N_m", "240", "250.758", "250.217", "to", "251.298"]
    (depth,) = [line.split() for line in lines if line.startswith("    depth ")]
    assert depth == ["depth", "259.84", "228", "12.3", "12.25", "12.25", "13.96", "254.205", "10.309"]
    assert "relative to the larger of the two" in done.out
    assert "Finite elements here" not in done.out
    assert "warning: 464 MPa does not follow from the formula, which gives 453.938 MPa" in done.err
    assert "418 MPa, by 7.9 %, not 9.9 %" in done.err
    assert cli("handbook", "hertz-check", CASE, "-q").err == ""


def test_json_and_files_agree(cli, tmp_path):
    out = tmp_path / "check"
    done = cli("handbook", "hertz-check", CASE, "--json", "--out", out)
    assert done.code == 0
    found = json.loads(done.out)
    assert list(found)[:4] == ["schema_version", "wearsim_version", "case", "title"]
    assert found == json.loads((out / "result.json").read_text())
    assert {path.name for path in out.iterdir()} == {".wearsim", "result.json", *TABLES, *PICTURES}
    assert found["difference_references"] == ["larger"]
    assert found["comparison"][2]["lost_stress_MPa"] == [228]
    assert len(found["combinations"]) == 8
    with (out / "changes.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [float(row["needed_value"]) for row in rows] == [
        change["needed_value"] for change in found["changes"]
    ]
    assert all(warning in done.err for warning in found["warnings"])


def test_finite_elements_are_shown(cli, tmp_path, solved):
    out = tmp_path / "check"
    done = cli("handbook", "hertz-check", CASE, "--fem", "--json", "--out", out)
    assert done.code == 0
    assert solved == [4, 8, 16]
    names = {path.name for path in out.iterdir()}
    assert names == {
        ".wearsim",
        "result.json",
        "meshes.csv",
        "fem_axis.csv",
        "fem_pressure.csv",
        *TABLES,
        *PICTURES,
    }
    meshes = json.loads(done.out)["meshes"]
    assert [mesh["unknowns"] for mesh in meshes] == [400, 800, 1600]
    assert meshes[0]["peak_pressure_error_percent"] == pytest.approx(98.17, abs=0.01)
    assert "finest mesh is off by +98.2 % in peak_pressure, more than 3 %" in done.err
    text = cli("handbook", "hertz-check", CASE, "--fem")
    assert "    16      1600    900.000 +98.17 %" in text.out
    assert max(map(len, text.out.splitlines())) <= 100
    again = cli(
        "handbook", "hertz-check", CASE, "--json", "--set", f"finite_elements.axis_file='{out}/fem_axis.csv'"
    )
    assert json.loads(again.out)["contact"]["axis_file"]["depth_von_mises_MPa"] == 450.0


def test_stresses_that_lie_outside_are_read_where_that_is_allowed(cli, tmp_path):
    """The one calculation whose input names a file: no other takes ``--allow-outside``."""
    name, folder = f"{CASE.stem}-axis.csv", CASE.parent
    path = tmp_path / "check.toml"
    path.write_text(CASE.read_text("utf-8").replace(f'"{name}"', f'"{folder}/{name}"'), "utf-8")
    refused = cli("handbook", "hertz-check", path)
    assert refused.code == 2
    assert "give --allow-outside" in refused.err
    assert "axis_file: maximum von Mises" in cli("handbook", "hertz-check", path, "--allow-outside").out
    takers = [
        command.name
        for command in HANDBOOK
        if any("--allow-outside" in option.opts for option in command.params)
    ]
    assert takers == ["hertz-check"]


def test_finite_elements_take_their_extra(cli, monkeypatch):
    monkeypatch.setitem(sys.modules, "skfem", None)
    done = cli("handbook", "hertz-check", CASE, "--fem")
    assert (done.code, done.out) == (2, "")
    assert "--fem: needs scikit-fem, which is not installed: pip install 'wearsim[fem]'" in done.err


def test_force_replaces_only_what_it_wrote(cli, tmp_path, solved):
    out = tmp_path / "check"
    assert cli("handbook", "hertz-check", CASE, "--fem", "--out", out).code == 0
    assert cli("handbook", "hertz-check", CASE, "--out", out).code == 2
    assert cli("handbook", "hertz-check", CASE, "--out", out, "--force").code == 0
    assert not (out / "meshes.csv").exists()
    (out / "notes.txt").write_text("mine")
    assert cli("handbook", "hertz-check", CASE, "--out", out, "--force").code == 2


def test_a_contact_of_ones_own(cli, tmp_path):
    path = tmp_path / "own.toml"
    path.write_text(
        'format_version = 1\n[contact]\ntorque_N_m = "0.1 kN m"\ngear_ratio = 3\n'
        "face_width_mm = 40\npinion_pitch_diameter_mm = 60\n"
    )
    done = cli("handbook", "hertz-check", path)
    assert done.code == 0
    assert done.out.startswith("own\n  Load ")
    assert "What one key alone" not in done.out
    assert done.err == ""
    found = json.loads(cli("handbook", "hertz-check", path, "--json").out)
    head = {"schema_version", "wearsim_version", "case", "title"}
    assert set(found) == {*head, "contact", "assumptions", "warnings"}
    assert found["contact"]["contact_ratio"] is None


@pytest.mark.parametrize(
    ("setting", "named"),
    [
        ("contact.gear_ratio=5", "contradicts the teeth, 54/36 = 1.5"),
        ("contact.pinion_pitch_diameter_mm=110", "is not module_mm times pinion_teeth, 108"),
        ("contact.poissons_ratio=0.2", "for 0.2 it is 0.4072"),
        ("contact.torque_N_m=1e6", "more than 0.05 of a radius"),
        (
            "published.difference.contact_difference_percent=11",
            "no single reference gives all printed differences",
        ),
    ],
)
def test_doubtful_input_is_told(cli, setting, named):
    done = cli("handbook", "hertz-check", CASE, "--set", setting)
    assert done.code == 0
    assert named in done.err


@pytest.mark.parametrize(
    ("setting", "named"),
    [
        ("contact.torque_N_m=0", "must be greater than 0"),
        ("contact.torque_N_m='240 N'", "the unit must be convertible to N*m"),
        ("contact.poissons_ratio=0.5", "must be less than 0.5"),
        ("contact.working_pressure_angle_deg=50", "must be less than or equal to 45"),
        ("contact.torque=3", "did you mean 'torque_N_m'"),
        ("combinations.gear_ratio=[]", "must be 1 to 20 values, but are 0"),
        ("finite_elements.elements_per_half_width=[8, 4]", "each mesh must be finer"),
        ("finite_elements.elements_per_half_width=[64]", "must be less than or equal to 32"),
        ("finite_elements.axis_file=no.csv", "the file must be readable CSV"),
    ],
)
def test_bad_input_is_2_and_named(cli, setting, named):
    done = cli("handbook", "hertz-check", CASE, "--set", setting)
    assert (done.code, done.out) == (2, "")
    assert f"--set {setting.partition('=')[0]}" in done.err
    assert named in done.err


@pytest.mark.parametrize(
    ("rows", "named"),
    [
        ("below_surface_mm\n1\n", "column 'von_mises_MPa' is missing"),
        ("below_surface_mm,von_mises_MPa\n", "needs at least one row"),
        ("below_surface_mm,von_mises_MPa\n-1,2\n", "axis.csv:2: below_surface_mm must be at least 0"),
    ],
)
def test_bad_axis_file_is_2_and_named(cli, tmp_path, rows, named):
    path = tmp_path / "axis.csv"
    path.write_text(rows)
    done = cli("handbook", "hertz-check", CASE, "--set", f"finite_elements.axis_file='{path}'")
    assert (done.code, done.out) == (2, "")
    assert named in done.err


def test_teeth_that_cannot_run_are_3(cli):
    done = cli("handbook", "hertz-check", CASE, "--json", "--set", "teeth.pinion_teeth=5")
    assert done.code == 3
    assert json.loads(done.out)["error"]["kind"] == "GeometryError"
    assert "Traceback" not in done.err


def test_schema(cli):
    done = cli("schema", "--of", "hertz-check")
    assert done.code == 0
    assert json.loads(done.out)["$defs"]["CombinationsTable"]["properties"]["torque_N_m"]["minItems"] == 1


def test_page_shows_what_is_printed(cli):
    docs = Path(__file__).parents[2] / "docs"
    page = (docs / "hertz-check.md").read_text(encoding="utf-8")
    assert f"```text\n{cli('handbook', 'hertz-check', CASE).out}```" in page
    picture = (docs / "hertz-check.svg").read_text(encoding="utf-8")
    assert "Gear pair 36/54 at the pitch point, 240 N m" in picture
