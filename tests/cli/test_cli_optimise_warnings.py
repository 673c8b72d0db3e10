"""``wearsim optimise``: what is told where the best design is doubtful."""

import csv
import json

import pytest


@pytest.fixture
def case(drive):
    """Function that writes the test drive with a table [optimise] and more."""

    def write(
        parameters,
        objectives='"life_hours"',
        limits="",
        more="[run]\nhorizon_hours = 1e6\nlife_tolerance = 0.1\n",
    ):
        path = drive()
        with path.open("a") as file:
            file.write(f"{more}[optimise]\nobjectives = [{objectives}]\n")
            file.write(f"[optimise.parameters]\n{parameters}[optimise.limits]\n{limits}")
        return path

    return write


def answer(cli, path, *options, evaluations=12):
    done = cli("optimise", path, "--evaluations", evaluations, "--json", *options)
    assert done.code == 0, done.err
    return json.loads(done.out)


WIDTH = '"sprocket.face_width_mm" = {low = 8.0, high = 16.0}\n'


def test_a_life_beyond_the_horizon_does_not_keep_a_high_limit(cli, case):
    """The lives are 150 to 310 h; runs end at 100 h."""
    short = "[run]\nhorizon_hours = 100.0\n"
    limits = "life_hours = {high = 200.0}\n"
    path = case(WIDTH, '"peak_pressure_MPa"', limits, short)
    found = answer(cli, path)
    assert found["designs"][0]["life_reached"]
    assert found["designs"][0]["life_hours"] <= 200.0
    assert not found["given"]["feasible"]
    assert not any("--require-hours" in text for text in found["assumptions"])


def test_warnings_of_the_best_design_are_told(cli, case, tmp_path):
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    path = case('"stop.critical_depth_mm" = {low = 0.02, high = 0.5}\n')
    done = cli("optimise", path, "--evaluations", 12, "--out", tmp_path / "out")
    assert done.code == 0
    own = json.loads(cli("life", tmp_path / "out" / "designs" / "01.toml", "--json").out)
    with (tmp_path / "out" / "front.csv").open(encoding="utf-8", newline="") as file:
        (row,) = csv.DictReader(file)
    told = row["warnings"].split("\n")
    # Studies look at the end of a run only: `life` warns of more, and of when it begins.
    assert told[0] and own["warnings"]
    for text in told:
        assert f"warning: design 01: {text}" in done.out


def test_assumptions_are_those_of_the_best_design(cli, case):
    parameters = '"material.sprocket.name" = ["steel", "polyamide 6"]\n'
    found = answer(cli, case(parameters, '"mass_kg"'))
    assert found["designs"][0]["inputs"] == {"material.sprocket.name": "polyamide 6"}
    texts = " ".join(found["assumptions"])
    assert "polyamide 6 with" in texts
    assert "7850" not in texts


def test_a_better_case_as_given_and_too_few_trials_are_told(cli, case):
    narrow = '"sprocket.face_width_mm" = {low = 5.0, high = 12.0}\n'
    found = answer(cli, case(narrow))
    assert any("the case as given has a better life_hours" in text for text in found["warnings"])
    two = WIDTH + '"sprocket.evolute_offset_mm" = {low = 5.5, high = 6.0}\n'
    ended = "the search ended at --evaluations"
    assert any(ended in text for text in answer(cli, case(two))["warnings"])
    enough = answer(cli, case(WIDTH), evaluations=400)
    assert enough["evaluations"] < 400
    assert not any(ended in text for text in enough["warnings"])


def test_where_nothing_is_feasible_the_nearest_is_told(cli, case, tmp_path):
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    path = case(WIDTH, limits="mass_kg = {high = 0.5}\n")
    done = cli("optimise", path, "--evaluations", 10, "--out", tmp_path / "out")
    assert done.code == 3
    assert "comes nearest, " in done.err
    with (tmp_path / "out" / "candidates.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) > 5
    assert {row["feasible"] for row in rows} == {"False"}
    # 8 mm of about 16.17 mm that weigh 2.1 kg are the least.
    least = min(float(row["mass_kg"]) for row in rows)
    assert f"{100 * (least / 0.5 - 1):.3g} % beyond" in done.err
