"""``wearsim calibrate``: options, files, and what is refused."""

import json
import tomllib
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import wearsim
from wearsim.study.calibrate.predicted_history import PredictedHistory

K = "wear.specific_wear_rate_mm2_per_N"
HEAD = "time_hours,quantity,value,error,arc_length_mm"
SHIPPED = Path(__file__).parents[2] / "cases"


@pytest.fixture(autouse=True)
def pandera():
    pytest.importorskip("pandera", reason="pandera is not installed")


@pytest.fixture
def table(tmp_path):
    """Function that writes a table of readings."""

    def write(*rows, head=HEAD):
        path = tmp_path / "readings.csv"
        path.write_text("\n".join([head, *rows]) + "\n", encoding="utf-8")
        return path

    return write


@pytest.fixture
def case(drive):
    """The test drive, which has a coefficient of 5e-11 mm2/N, and its run."""
    path = drive()
    return path, PredictedHistory(wearsim.simulate(wearsim.load_case(path)))


def depth(model, part, place, factor=1.0):
    return f"{part * model.hours},depth_mm,{factor * model.depth_at(part, place, 1)},0.0005,{place}"


def answer(cli, *arguments):
    done = cli("calibrate", *arguments, "--json")
    assert done.code == 0, done.err
    return json.loads(done.out)


def test_text_tells_hours_coefficient_and_fit(cli, case, table):
    path, model = case
    readings = table(*(depth(model, part, 9.0) for part in (0.4, 0.8)))
    done = cli("calibrate", path, readings)
    assert done.code == 0
    assert "Remaining" in done.out and "of the sprocket" in done.out and "90 %" in done.out
    assert f"{K} = 5e-11" in done.out
    assert "2 readings, chi-square" in done.out
    assert done.err == ""


def test_json_has_numbers_that_go_together(cli, case, table):
    path, model = case
    found = answer(cli, path, table(*(depth(model, part, 9.0) for part in (0.4, 0.8))))
    (value,), (part,) = found["values"], found["parts"]
    assert value["key"] == K
    assert value["value"] == pytest.approx(5e-11, rel=1e-4)
    assert value["low"] < value["value"] < value["high"]
    assert part["reading_hours"] == pytest.approx(0.8 * model.hours)
    assert part["remaining_hours"] == pytest.approx(0.2 * model.hours, rel=1e-3)
    assert part["remaining_hours_low"] == pytest.approx(part["life_hours_low"] - part["reading_hours"])
    assert part["life_hours"] * value["value"] == pytest.approx(model.hours * 5e-11, rel=1e-6)


def test_overrides_reach_the_case(cli, case, table):
    path, model = case
    readings = table(depth(model, 0.4, 9.0), depth(model, 0.8, 9.0))
    found = answer(cli, path, readings, "--set", "stop.critical_depth_mm=0.03")
    assert found["parts"][0]["life_hours"] > 1.2 * model.hours
    assert found["values"][0]["value"] == pytest.approx(5e-11, rel=2e-3)


def test_confidence_is_the_width_of_the_intervals(cli, case, table):
    path, model = case
    readings = table(depth(model, 0.4, 9.0), depth(model, 0.8, 9.0))
    widths = [
        np.log(one["high"] / one["low"])
        for share in ("0.6827", "0.9545")
        for one in answer(cli, path, readings, "--confidence", share)["values"]
    ]
    # One and two standard deviations.
    assert widths[1] / widths[0] == pytest.approx(2.0, rel=5e-3)


@pytest.mark.slow
def test_slip_is_fitted_where_it_is_asked_for(cli, case, table):
    path, model = case
    readings = table(*(depth(model, part, 9.0) for part in (0.3, 0.6, 0.9)))
    found = answer(cli, path, readings, "--fit", "mechanism.roller_slip_fraction")
    assert [one["key"] for one in found["values"]] == [K, "mechanism.roller_slip_fraction"]
    assert found["values"][1]["low"] is None and found["values"][1]["high"] is None
    assert any("apart" in text for text in found["warnings"])
    assert found["parts"][0]["life_hours"] == pytest.approx(model.hours, rel=1e-3)


def scanned(folder, model, part, turn, shift):
    new, recess = model.nominal, model.recess(part, 1)
    x, y = new.x - recess * new.normal_x, new.y - recess * new.normal_y
    c, s = np.cos(turn), np.sin(turn)
    points = np.column_stack([c * x - s * y + shift, s * x + c * y])[2:-2]
    np.savetxt(folder / "scan.csv", points, delimiter=",", header="x_mm,y_mm", comments="")
    return f"{part * model.hours},profile,,0.0005,,scan.csv"


@pytest.mark.wide
@pytest.mark.wide
@pytest.mark.parametrize(
    ("register", "turn", "shift", "right"),
    [
        ("none", 0.0, 0.0, True),
        ("none", 1e-3, 0.0, False),
        ("turn", 1e-3, 0.0, True),
        ("turn", 1e-3, 0.05, False),
        ("free", 1e-3, 0.05, True),
    ],
)
def test_profiles_are_registered_as_asked(cli, case, table, tmp_path, register, turn, shift, right):
    path, model = case
    row = scanned(tmp_path, model, 0.8, turn, shift)
    readings = table(row, head=f"{HEAD},points_file")
    done = cli("calibrate", path, readings, "--register", register, "--json")
    value = json.loads(done.out)["values"][0]["value"] if done.code == 0 else np.nan
    assert (abs(value / 5e-11 - 1.0) < 0.02) == right


@pytest.mark.wide
def test_cut_off_is_the_spacing_of_the_smoothed_values(cli, case, table, tmp_path):
    path, model = case
    readings = table(scanned(tmp_path, model, 0.8, 0.0, 0.0), head=f"{HEAD},points_file")
    counts = [
        answer(cli, path, readings, "--cutoff-mm", cutoff)["degrees_of_freedom"] for cutoff in ("1", "2")
    ]
    # A turn and the coefficient are taken from the values.
    assert (counts[0] + 2) / (counts[1] + 2) == pytest.approx(2.0, abs=0.3)
    text = cli("calibrate", path, readings, "--cutoff-mm", "2", "--explain").out
    assert "ISO 16610-21, cut-off 2 mm" in " ".join(text.split())


@pytest.mark.wide
def test_folder_holds_tables_pictures_and_the_calibrated_case(cli, case, table, tmp_path):
    path, model = case
    readings = table(depth(model, 0.4, 9.0, 1.1), depth(model, 0.8, 9.0, 1.1))
    out = tmp_path / "out"
    done = cli("calibrate", path, readings, "--out", out)
    assert done.code == 0
    assert f"written to {out}" in done.err
    assert {entry.name for entry in out.iterdir()} == {
        ".wearsim",
        "fit.csv",
        "fitted_values.csv",
        "summary.md",
        "calibrated.toml",
        "fit.png",
        "fit.svg",
        "residuals.png",
        "residuals.svg",
    }
    rows = pd.read_csv(out / "fit.csv")
    expected = (rows["predicted"] - rows["value"]) / rows["error"]
    assert rows["standard_residual"].to_numpy() == pytest.approx(expected.to_numpy(), abs=1e-9)
    assert rows["reading_row"].tolist() == [2, 3]
    value = pd.read_csv(out / "fitted_values.csv")["value"][0]
    fitted = pd.read_csv(out / "fitted_values.csv").iloc[0]
    wear = tomllib.loads((out / "calibrated.toml").read_text())["wear"]
    band = max(fitted["high"] / fitted["value"], fitted["value"] / fitted["low"])
    assert wear == {"specific_wear_rate_mm2_per_N": value, "band_factor": pytest.approx(band)}
    told = answer(cli, path, readings)["parts"][0]
    life = json.loads(cli("life", out / "calibrated.toml", "--json").out)
    assert life["life_hours"] == pytest.approx(told["life_hours"], rel=1e-6)
    assert life["life_hours_low"] == pytest.approx(told["life_hours_low"], rel=1e-2)
    assert cli("calibrate", path, readings, "--out", out).code == 2
    assert cli("calibrate", path, readings, "--out", out, "--force").code == 0


def test_shipped_readings_give_what_they_were_made_with(cli):
    """Synthetic: 1.3 times the coefficient, 2087 h."""
    found = answer(cli, SHIPPED / "16b-20t-oiled.toml", SHIPPED / "studies" / "16b-20t-readings.csv")
    (value,), (part,) = found["values"], found["parts"]
    assert value["low"] < 6.5e-11 < value["high"]
    assert part["life_hours_low"] < 2087.0 < part["life_hours_high"]
    assert found["readings"] == 12


BAD = [
    ("0,max_depth_mm,0.01,0.001,", ":2: time_hours: must be a number above 0, from 1e-06 to"),
    ("1,max_depth_mm,abc,0.001,", ":2: value: must be a number of at most 1e+06 (got 'abc')"),
    ("1,max_depth_mm,nan,0.001,", ":2: value: must be a number of at most 1e+06 (got 'nan')"),
    ("1,max_depth_mm,0.0_5,0.001,", ":2: value: must be a number of at most 1e+06 (got '0.0_5')"),
    ("1e300,max_depth_mm,0.01,0.001,", ":2: time_hours: must be a number above 0, from 1e-06 to"),
    ("400,max_depth_mm,0.01,1e-320,", ":2: error: must be a number above 0, the standard deviation"),
    ("400,max_depth_mm,-0.05,0.004,", ":2: value must not be more than 3 errors below 0, is -0.05"),
    ("400,max_depth_mm,0.4,0.004,", ":2: value must lie within the limit of the case, a depth of"),
    ("400,max_depth_mm,0.0,0.004,", "must show wear, but go with none: the life is at least"),
    ("1,max_depth_mm,0.01,-1,", ":2: error: must be a number above 0, the standard deviation"),
    ("1,depth,0.01,0.001,", ":2: quantity: must be one of max_depth_mm, depth_mm"),
    ("1,depth_mm,0.01,0.001,", ":2: arc_length_mm: must be a number of at least 0 (got '')"),
    ("1,max_depth_mm,0.01,0.001,3", ":2: arc_length_mm: must be empty for max_depth_mm"),
    ("1,depth_mm,0.01,0.001,500", ":2: arc_length_mm must be at most"),
    ("1,elongation_percent,0.5,0.1,", ":2: elongation_percent needs a chain that wraps"),
    ("1,over_pins_mm,0.5,0.1,", ":2: over_pins_mm needs a chain that wraps"),
    ("1,max_depth_mm,0.01", ":2: needs 5 values, has 3"),
    ("1000,max_depth_mm,0.0253,0.0001,", "must not lie more than a quarter of the life beyond"),
]


@pytest.mark.wide
@pytest.mark.parametrize(("row", "message"), BAD, ids=range(len(BAD)))
def test_bad_cells_are_told_with_row_and_column(cli, case, table, row, message):
    path, _ = case
    done = cli("calibrate", path, table(row))
    assert done.code == 2, done.err
    assert message in done.err
    assert done.out == ""


def test_all_bad_cells_are_told_in_one_pass(cli, case, table):
    done = cli("calibrate", case[0], table("# of a day", "-1,depth_mm,x,0,", "1,profile,2,1,"))
    assert done.err.count("readings.csv:3:") == 4
    assert done.err.count("readings.csv:4:") == 2


@pytest.mark.parametrize(
    ("head", "message"),
    [
        ("time_hours,quantity,value", "column 'error' is missing"),
        (f"{HEAD},depht", "unknown column 'depht'"),
        (f"{HEAD},error", "each column may appear only once"),
    ],
)
def test_bad_headers_are_told(cli, case, table, head, message):
    done = cli("calibrate", case[0], table(head=head))
    assert done.code == 2
    assert message in done.err


def test_scans_that_cannot_be_read_are_told(cli, case, table, tmp_path):
    row, head = "1,profile,,0.01,,scan.csv", f"{HEAD},points_file"
    for text, message in (
        (None, "readings.csv:2: points_file: the file must be readable CSV"),
        ("x_mm,y_mm\n1,2\n", ":2: points_file: scan.csv needs at least 11 points, has 1"),
        ("x_mm,y_mm\n" + "".join(f"500,{i}\n" for i in range(20)), ":2: registration: at least 11"),
        ("x_mm,y_mm\n1,b\n", ":2: points_file: scan.csv:2: y_mm must be a finite number"),
    ):
        if text is not None:
            (tmp_path / "scan.csv").write_text(text)
        done = cli("calibrate", case[0], table(row, head=head))
        assert done.code == 2
        assert message in done.err, done.err


def test_scans_outside_the_folder_of_the_readings(cli, case, table, tmp_path):
    """Refused where a file names them, not where a program does."""
    scan = tmp_path / "scans" / "scan.csv"
    scan.parent.mkdir()
    scan.write_text("x_mm,y_mm\n1,2\n")
    (tmp_path / "log").mkdir()
    readings = table("1,profile,,0.01,,../scans/scan.csv", head=f"{HEAD},points_file")
    readings = readings.rename(tmp_path / "log" / "readings.csv")
    few = "needs at least 11 points, has 1"
    done = cli("calibrate", case[0], readings)
    assert done.code == 2
    assert "readings.csv:2: points_file: must name a file in the folder of the input" in done.err
    assert few not in done.err
    assert few in cli("calibrate", case[0], readings, "--allow-outside").err
    row = {"time_hours": 1, "quantity": "profile", "error": 0.01, "points_file": scan}
    with pytest.raises(wearsim.CaseError, match=few):
        wearsim.calibrate(case[0], [{name: str(value) for name, value in row.items()}])


@pytest.mark.parametrize(
    ("key", "message"),
    [
        ("wear.pressure_exponent", "law = 'archard' has the exponent 1"),
        ("load.tension_N", "must be one of wear.pressure_exponent, mechanism.roller_slip_fraction"),
    ],
)
def test_what_cannot_be_fitted_is_told(cli, case, table, key, message):
    path, model = case
    done = cli("calibrate", path, table(depth(model, 0.5, 9.0)), "--fit", key)
    assert done.code == 2
    assert message in done.err


def test_gap_kind_and_running_in_are_checked(cli, case, table):
    path, model = case
    row = depth(model, 0.5, 9.0)
    done = cli("calibrate", path, table(f"{row},2", head=f"{HEAD},gap_kind"))
    assert done.code == 2
    assert "gap_kind must be at most 1, is 2" in done.err
    run_in = ("--set", "wear.running_in_factor=3", "--set", "wear.running_in_distance_mm=1e6")
    done = cli("calibrate", path, table(row), *run_in)
    assert done.code == 2
    assert "running_in_factor" in done.err


def test_readings_that_scatter_more_than_their_errors_widen_the_intervals(cli, case, table):
    path, model = case
    off = [
        depth(model, part, 9.0, factor) for part, factor in ((0.3, 0.7), (0.5, 1.2), (0.7, 0.85), (0.9, 1.1))
    ]
    found = answer(cli, path, table(*off))
    assert found["error_scale"] > 2.0
    assert any("times as far from the fit as their errors say" in text for text in found["warnings"])


def test_without_pandera_it_says_what_to_install(cli, case, table, monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    done = cli("calibrate", case[0], table("1,max_depth_mm,0.01,0.001,"))
    assert done.code == 2
    assert "pip install 'wearsim[study]'" in done.err


def test_the_folder_of_the_inputs_is_not_replaced(cli, case, table, tmp_path):
    path, model = case
    inner = tmp_path / "inner"
    inner.mkdir()
    readings = table(depth(model, 0.4, 9.0)).rename(inner / "fit.csv")
    done = cli("calibrate", path, readings, "--out", inner, "--force")
    assert done.code == 2
    assert "must not be the folder of" in done.err
    assert readings.read_text().startswith(HEAD)


def test_movement_of_profiles_is_told(cli, case, table, tmp_path):
    path, model = case
    readings = table(scanned(tmp_path, model, 0.8, 2e-3, 0.0), head=f"{HEAD},points_file")
    (moved,) = answer(cli, path, readings)["moves"]
    assert moved["turn_rad"] == pytest.approx(-2e-3, abs=1e-4)
    assert (moved["reading_row"], moved["shift_x_mm"], moved["shift_y_mm"]) == (2, 0.0, 0.0)
    assert "profile of line 2 by -0.002 rad" in " ".join(cli("calibrate", path, readings).out.split())


def test_profiles_need_a_flank(cli, tmp_path):
    (tmp_path / "readings.csv").write_text(
        "time_hours,quantity,error,points_file\n100,profile,0.01,scan.csv\n"
    )
    np.savetxt(tmp_path / "scan.csv", np.ones((12, 2)), delimiter=",", header="x_mm,y_mm", comments="")
    case = SHIPPED / "hertz-arc-prescribed.toml"
    done = cli("calibrate", case, tmp_path / "readings.csv")
    assert done.code == 2
    assert ":2: a table of loads has no flank to lay a profile on" in done.err


def test_life_that_is_used_up_leaves_nothing(cli, case, table):
    path, model = case
    (part,) = answer(cli, path, table(depth(model, 1.0, 9.0), depth(model, 0.5, 9.0)))["parts"]
    assert part["remaining_hours"] == pytest.approx(0.0, abs=1e-3 * model.hours)
    assert part["remaining_hours_low"] == 0.0
