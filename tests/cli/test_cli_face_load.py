"""``wearsim face-load``: text, JSON, files and exit codes."""

import csv
import json
import math
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
CASE = ROOT / "cases" / "sizing" / "face-load-mill-drive.toml"


def test_text(cli):
    done = cli("handbook", "face-load", CASE)
    assert done.code == 0
    lines = done.out.splitlines()
    assert lines[0] == "Girth gear of a mill, 7.09 MW on one pinion"
    assert max(map(len, lines)) <= 100
    rows = [line.split() for line in lines if line.startswith(("  fixed", "  self-aligning"))]
    assert [" ".join(row[:2]) for row in rows] == [
        "fixed new",
        "fixed after",
        "fixed run",
        "self-aligning new",
        "self-aligning after",
        "self-aligning run",
    ]
    assert "load.application_factor = 1\n" in cli("handbook", "face-load", CASE, "--explain").out
    assert "fixed pinion: only 83% of the new face carries" in done.err
    assert "misalignment that varies from mesh to mesh does not run in" in done.err


def test_json_and_files_agree(cli, tmp_path):
    out = tmp_path / "face"
    done = cli("handbook", "face-load", CASE, "--json", "--out", out)
    assert done.code == 0
    found = json.loads(done.out)
    assert found == json.loads((out / "result.json").read_text())
    assert {path.name for path in out.iterdir()} == {
        ".wearsim",
        "result.json",
        "states.csv",
        "distribution.csv",
        "history.csv",
        "face_load.png",
        "face_load.svg",
    }
    with (out / "states.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [float(row["face_load_factor"]) for row in rows] == [
        state["face_load_factor"] for state in found["states"]
    ]
    with (out / "distribution.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 2 * 3 * 201
    first = [float(row["greatest_load_per_width_N_per_mm"]) for row in rows[:201]]
    mean = found["mean_load_per_width_N_per_mm"]
    assert max(first) / mean == pytest.approx(found["states"][0]["face_load_factor"])
    assert found["varying_running_in_hours"] is None
    assert cli("handbook", "face-load", CASE, "--out", out).code == 2


def test_states_of_the_shipped_case_by_hand(cli):
    """q_m = 7.09e6/(pi 0.65 170/60)/1000 N/mm: K = (2 c 0.18/q_m)^(1/2), 1 + c 0.06/(2 q_m)."""
    states = json.loads(cli("handbook", "face-load", CASE, "--json").out)["states"]
    mean = 7.09e6 / (math.pi * 0.65 * 170 / 60) / 1000
    factors = [state["face_load_factor"] for state in states]
    assert factors[0] == pytest.approx(math.sqrt(2 * 2e4 * 0.18 / mean), rel=1e-4)
    assert factors[2] == pytest.approx(1 + 2e4 * 0.06 / (2 * mean), rel=1e-3)
    assert factors[3] == pytest.approx(1 + 6 * 20 / 1000, rel=1e-4)
    as_gap = [state["equivalent_misalignment_um"] for state in states]
    assert as_gap[0] == pytest.approx(180, rel=1e-3)
    assert as_gap[2] == pytest.approx(60, rel=1e-3)


def test_what_turns_with_the_wheel(cli):
    done = cli("handbook", "face-load", CASE, "--set", "misalignment.varies_with=wheel")
    assert done.code == 0
    assert "misalignment that rotates with one gear in 10 210 h" in done.out.replace("\n             ", " ")
    assert "fixed pinion: not yet run in after 8 000 h" in done.err


def test_too_few_slices_are_told(cli):
    settings = ("--set", "pair.slices=20", "--set", "misalignment.fixed_misalignment_um=2000")
    done = cli("handbook", "face-load", CASE, *settings)
    assert done.code == 0
    assert "slices carry the load, so K_Hbeta is inaccurate: raise pair.slices" in done.err


@pytest.mark.parametrize(
    ("setting", "named"),
    [
        ("pair.slices=5", "must be greater than or equal to 10"),
        ("pair.gear_ratio=0.5", "must be greater than or equal to 1"),
        ("misalignment.crown_um=-1", "must be greater than or equal to 0"),
        ("misalignment.varies_with=wheels", "did you mean 'wheel'"),
        ("misalignment.fixed_misalignment=1", "did you mean 'fixed_misalignment_um'"),
        ("running_in.time_hours=0", "must be greater than 0"),
        ("load.power_kW='7 MN'", "the unit must be convertible to kW"),
        ("self_aligning.pivot_friction_lever_mm=-1", "must be greater than or equal to 0"),
    ],
)
def test_bad_input_is_2_and_named(cli, setting, named):
    done = cli("handbook", "face-load", CASE, "--set", setting)
    assert (done.code, done.out) == (2, "")
    assert f"--set {setting.partition('=')[0]}: " in done.err
    assert named in done.err


def test_units_are_converted(cli):
    title = ("--set", "title=One")
    plain = cli("handbook", "face-load", CASE, "--json", "-q", *title).out
    given = [
        part
        for text in (
            "pair.mesh_stiffness_N_per_mm_um='20 kN/mm^2'",
            "pair.face_width_mm='1 m'",
            "misalignment.fixed_misalignment_um='0.12 mm'",
        )
        for part in ("--set", text)
    ]
    assert cli("handbook", "face-load", CASE, "--json", "-q", *title, *given).out == plain


def test_page_shows_what_is_printed(cli):
    page = (ROOT / "docs" / "face-load.md").read_text(encoding="utf-8")
    assert f"```text\n{cli('handbook', 'face-load', CASE).out}```" in page
    picture = (ROOT / "docs" / "face-load.svg").read_text(encoding="utf-8")
    assert "Girth gear of a mill" in picture
