"""``wearsim uncertainty``: P10, P50 and P90 of a life whose inputs scatter."""

import csv
import json
import math
import re

import numpy as np
import pytest

from wearsim.drive.load_case import load_case
from wearsim.input.document import read_document
from wearsim.quantities import Quantity, grouped, percentile_shares, quantities
from wearsim.runner.scatter import plain_document

SCATTER = """\
[uncertainty]
"wear.specific_wear_rate_mm2_per_N" = {distribution = "lognormal", sigma_ln = %s}
"""
Z10 = 1.2815516


@pytest.fixture
def case(drive):
    """Function that writes the test drive with a tension and more tables."""

    def write(more="", name="drive"):
        path = drive(name)
        text = path.read_text().replace("power_kW = 3\n", "tension_N = 3000.0\n")
        path.write_text(text + more)
        return path

    return write


def answer(cli, *arguments):
    done = cli("uncertainty", *arguments, "--json")
    return done, json.loads(done.out)


@pytest.mark.wide
@pytest.mark.parametrize("sigma", [0.3, 0.7])
@pytest.mark.parametrize("method", ["sobol", "lhs", "random"])
def test_closed_form_where_only_the_coefficient_scatters(cli, case, sigma, method):
    path = case(SCATTER % sigma)
    done, found = answer(cli, path, "--method", method, "--samples", 512, "--seed", 3)
    assert done.code == 0
    middle = json.loads(cli("life", path, "--json").out)["life_hours"]
    for name, exact in (("p10", -Z10), ("p50", 0.0), ("p90", Z10)):
        hours = middle * math.exp(exact * sigma)
        assert found[f"{name}_hours_low"] < hours < found[f"{name}_hours_high"]
        near = 0.2 if method == "random" else 0.01
        assert found[f"{name}_hours"] == pytest.approx(hours, rel=near)
    assert (found["samples"], found["method"], found["failed"]) == (512, method, 0)
    fit = found["fits"][0]
    assert fit["name"] == "lognormal"
    assert fit["shape"] == pytest.approx(sigma, rel=0.1 if method == "random" else 0.01)


def test_independent_scatters_add_in_squares(cli, case):
    """On a strand the wear goes with coefficient and tension: ln L is a sum."""
    more = (
        "[run]\nlife_tolerance = 0.05\n"
        + SCATTER % 0.4
        + '"load.tension_N" = {distribution = "lognormal", sigma_ln = 0.3}\n'
    )
    _, found = answer(cli, case(more), "--samples", 512)
    ratio = found["p10_hours"] / found["p50_hours"]
    assert ratio == pytest.approx(math.exp(-Z10 * 0.5), rel=0.01)


def test_the_band_is_the_default(cli, case):
    """Of "hardened, oiled", 1.7e-11, 5e-11 and 1.5e-10 mm2/N: 90 % of a log-normal one."""
    _, found = answer(cli, case(), "--samples", 256)
    (inputs,) = found["inputs"].values()
    sigma = math.log(1.5e-10 / 1.7e-11) / (2.0 * 1.6448536)
    median = math.sqrt(1.7e-11 * 1.5e-10)
    assert inputs.pop("distribution") == "lognormal"
    assert inputs == pytest.approx({"median": median, "sigma_ln": sigma}, rel=1e-6)
    assert found["p10_hours"] / found["p50_hours"] == pytest.approx(math.exp(-sigma * Z10), rel=0.03)
    assert any("90 % of it 0.34 to 3 times 5e-11, its band" in text for text in found["assumptions"])


def test_text_tells_the_same(cli, case):
    path = case(SCATTER % 0.5)
    _, found = answer(cli, path, "--samples", 64)
    text = cli("uncertainty", path, "--samples", 64).out
    for share in (10, 50, 90):
        (shown,) = re.findall(rf"^P{share} +([\d\s.]+?) h", text, flags=re.MULTILINE)
        hours = float(re.sub(r"\s", "", shown))
        assert hours == pytest.approx(found[f"p{share}_hours"], rel=1e-3)
    assert "64, scrambled Sobol' points, seed 1" in text


def test_seed(cli, case):
    path = case(SCATTER % 0.5)
    hours = [answer(cli, path, "--seed", seed, "--samples", 64)[1]["p10_hours"] for seed in (1, 1, 2)]
    assert hours[0] == hours[1] != hours[2]


@pytest.mark.wide
def test_beyond_the_horizon_only_a_bound_is_known(cli, case):
    path = case(SCATTER % 0.5)
    middle = json.loads(cli("life", path, "--json").out)["life_hours"]
    _, found = answer(cli, path, "--samples", 64, "--set", f"run.horizon_hours={middle * 1.2!r}")
    assert found["p50_hours"] is not None
    assert found["p90_hours"] is None
    assert found["p90_hours_at_least"] == pytest.approx(middle * 1.2)
    assert found["p50_hours_at_least"] is None
    assert found["convergence"][-1]["p90_hours"] is None  # as in the table on screen
    assert any("beyond run.horizon_hours are only bounds" in text for text in found["warnings"])
    text = cli("uncertainty", path, "--samples", 64, "--set", f"run.horizon_hours={middle * 1.2!r}").out
    assert re.search(r"^P90 +> ", text, flags=re.MULTILINE)


def test_required_hours_are_those_of_p10(cli, case):
    path = case(SCATTER % 0.5)
    _, found = answer(cli, path, "--samples", 64)
    p10 = found["p10_hours"]
    assert cli("uncertainty", path, "--samples", 64, "--require-hours", 0.99 * p10).code == 0
    done = cli("uncertainty", path, "--samples", 64, "--require-hours", 1.01 * p10)
    assert done.code == 4
    assert "is below" in done.err


def test_samples_that_cannot_run_are_counted(cli, case):
    more = "[uncertainty]\nsprocket.evolute_offset_mm = "
    more += '{distribution = "uniform", low = 4.0, high = 7.0}\n'
    done, found = answer(cli, case(more), "--samples", 32)
    assert done.code == 5
    assert found["failed"] > 0
    assert found["samples"] + found["failed"] == 32
    assert any("samples failed and are left out" in text for text in found["warnings"])


def test_gears_and_their_law(cli, tmp_path):
    path = tmp_path / "gears.toml"
    path.write_text(
        "format_version = 1\n[gear]\npinion_teeth = 19\nwheel_teeth = 61\nmodule_mm = 3.0\n"
        "face_width_mm = 30.0\nnodes = 61\n[load]\ntorque_N_m = 100.0\nspeed_rpm = 1450.0\n"
        "[wear]\nspecific_wear_rate_mm2_per_N = 1e-11\n[stop]\ncritical_depth_mm = 0.02\n"
        "[run]\nhorizon_hours = 1e6\n[uncertainty]\n"
        '"gear.face_width_mm" = {distribution = "normal", standard_deviation = 0.1}\n'
    )
    _, found = answer(cli, path, "--samples", 8)
    assert set(found["inputs"]) == {"gear.face_width_mm", "wear.specific_wear_rate_mm2_per_N"}
    assert found["p10_hours"] < found["p50_hours"] < found["p90_hours"]


def test_folder(cli, case, tmp_path):
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    path, out = case(SCATTER % 0.5), tmp_path / "out"
    first = cli("uncertainty", path, "--samples", 64, "--out", out)
    assert first.code == 0
    pictures = {f"{name}.{kind}" for name in ("lives", "convergence") for kind in ("png", "svg")}
    assert {entry.name for entry in out.iterdir()} == {
        ".wearsim",
        *pictures,
        "cases.csv",
        "convergence.csv",
        "summary.md",
        "study.json",
        "shards",
    }
    assert cli("uncertainty", path, "--samples", 64, "--out", out).out == first.out
    assert cli("uncertainty", path, "--samples", 65, "--out", out).code == 2


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ('"load.tension_N" = {distribution = "lognormal"}', "lognormal needs this key"),
        ('"load.tension_N" = {distribution = "uniform", low = 2.0, high = 1.0}', "must be above low"),
        ('"load.tension_N" = {distribution = "normal", sigma_ln = 1.0}', "does not belong to normal"),
        ('"load.tension_N" = {distribution = "cauchy"}', "must be 'lognormal'"),
        ('"load.tensions_N" = {distribution = "lognormal", sigma_ln = 1.0}', "is not in the case"),
        ('"sprocket.teeth" = {distribution = "lognormal", sigma_ln = 1.0}', "number with a fraction"),
        ('"sprocket.profile" = {distribution = "lognormal", sigma_ln = 1.0}', "it is 'evolute'"),
        (
            '"load.tension_N" = {distribution = "normal", standard_deviation = 1.0}\n'
            'load.tension_N = {distribution = "normal", standard_deviation = 2.0}',
            "load.tension_N is given twice",
        ),
        ('"load.tension_N" = {distribution = "lognormal", sigma_ln = 1, median = "5 N"}', "must be a"),
        ('"run.horizon_hours" = {distribution = "uniform", low = 1.0, high = 2.0}', "cannot scatter"),
        (
            '"load.tension_N" = {distribution = "triangular", low = 1.0, high = 2.0}',
            "mode must lie from 1 to 2",
        ),
    ],
)
def test_bad_tables(cli, case, table, message):
    done = cli("uncertainty", case(f"[uncertainty]\n{table}\n"))
    assert (done.code, done.out) == (2, "")
    assert message in done.err
    assert "uncertainty" in done.err


def test_other_commands_take_the_table(cli, case):
    plain, more = (cli("life", case(text), "--json") for text in ("", SCATTER % 0.5))
    assert json.loads(plain.out)["life_hours"] == json.loads(more.out)["life_hours"]
    assert cli("life", case('[uncertainty]\n"load.tension_N" = 3\n')).code == 2


def test_joints_of_a_wrap_scatter_too(cli, case):
    path = case()
    text = path.read_text().replace(
        'profile = "evolute"\nevolute_offset_mm = 5.6\nnodes = 51', 'profile = "iso606"\nnodes = 101'
    )
    path.write_text(text + "[mechanism]\nphases = 2\n[run]\nlife_tolerance = 0.1\n")
    _, found = answer(cli, path, "--samples", 4)
    assert set(found["inputs"]) == {"wear.specific_wear_rate_mm2_per_N", "joint.specific_wear_rate_mm2_per_N"}
    assert found["p10_hours"] < found["p50_hours"]


@pytest.mark.wide
@pytest.mark.parametrize("hours", [1300, 2500, 3000])
def test_required_hours_at_the_horizon(cli, case, hours):
    path = case()
    given = 'condition = "hardened, oiled"'
    weak = "specific_wear_rate_mm2_per_N = 1e-14"
    path.write_text(path.read_text().replace(given, weak))
    options = ("--set", "run.horizon_hours=10", "--require-hours", hours, "--samples", 16)
    assert cli("uncertainty", path, *options).code == 0


def test_bounds_do_not_converge(cli, case):
    text = cli("uncertainty", case(), "--samples", 16, "--set", "run.horizon_hours=1").out
    (row,) = [line for line in text.splitlines() if line.split()[:1] == ["16"]]
    assert row.count("not known") == 3


def test_errors_that_miss_their_tolerance_are_told_with_what_they_do_to_the_percentiles(cli, case, tmp_path):
    """Percentiles rise with every life: all lives lower, or higher, by their errors are the ends."""
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    more = SCATTER % 0.3 + "[run]\nlife_tolerance = 1e-5\n"
    done = cli("uncertainty", case(more), "--samples", 16, "--out", tmp_path / "out", "--json")
    with (tmp_path / "out" / "cases.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    found = [(float(row["life_hours"]), float(row["numerical_error"])) for row in rows]
    ends = [np.quantile([h * (1 + s * e) for h, e in found], 0.5, method="median_unbiased") for s in (-1, 1)]
    (text,) = (text for text in json.loads(done.out)["warnings"] if "miss their run.life_tolerance" in text)
    assert text.startswith("16 of 16 cases miss")
    assert f"P50 is {grouped(ends[0])} to {grouped(ends[1])} h" in text


def test_warnings_of_samples_are_grouped(cli, case):
    _, found = answer(cli, case(), "--samples", 16)
    missed, *texts = found["warnings"]
    assert "miss their run.life_tolerance" in missed
    assert texts
    assert all(text.startswith("16 of 16 samples, such as case_index 0: ") for text in texts)


def test_plan_finds_what_is_in_the_way(cli, case, tmp_path):
    (tmp_path / "file").write_text("mine")
    done = cli("uncertainty", case(), "--dry-run", "--out", tmp_path / "file")
    assert done.code == 2


def test_missed_hours_are_told_beside_failures(cli, case):
    more = "[uncertainty]\nsprocket.evolute_offset_mm = "
    more += '{distribution = "uniform", low = 4.0, high = 7.0}\n'
    done = cli("uncertainty", case(more), "--samples", 16, "--require-hours", 1e6)
    assert done.code == 5
    assert "is below 1e+06 h" in done.err


def test_cases_of_a_study_keep_the_joints_of_their_condition():
    """Without the condition's name they would be well lubricated; dry joints have 7e-9 mm2/N."""
    tables = {
        "format_version": 1,
        "chain": {"designation": "08B-1"},
        "sprocket": {"teeth": 19, "profile": "iso606"},
        "load": {"tension_N": 800.0, "speed_rpm": 100.0},
        "wear": {"condition": "hardened, dry"},
    }
    document = read_document(tables, ())
    plain = plain_document(document, load_case(tables)).data
    assert plain["wear"] == {"condition": "hardened, dry", "specific_wear_rate_mm2_per_N": 1e-8}
    assert load_case(plain).drive.joint.coefficient == 7e-9


def test_a_percentile_of_the_table_of_names_reaches_every_table(cli, case, tmp_path, monkeypatch):
    """Its row is all that a new percentile takes; hours that are required stay those of P10."""
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    table = {"p5_hours": Quantity("p5_hours", "L_5", "h", "life that 19 of 20 drives exceed")} | quantities()
    monkeypatch.setattr("wearsim.quantities.quantities", lambda: table)
    percentile_shares.cache_clear()
    try:
        path = case(SCATTER % 0.3)
        _, found = answer(cli, path, "--samples", 64)
        assert found["p5_hours_low"] <= found["p5_hours"] < found["p10_hours"]
        options = ("--samples", 64, "--require-hours", 0.99 * found["p10_hours"], "--out", tmp_path / "out")
        done = cli("uncertainty", path, *options)
        page = cli("report", path, "--out", tmp_path / "page")
    finally:
        percentile_shares.cache_clear()
    assert (done.code, page.code) == (0, 0)
    assert re.search(r"^P5 .* 19 of 20 last longer$", done.out, re.MULTILINE)
    columns = (tmp_path / "out" / "convergence.csv").read_text().splitlines()[0]
    assert columns == "samples,p5_hours,p10_hours,p50_hours,p90_hours"
    assert "P5, P10, P50, P90" in (tmp_path / "out" / "lives.svg").read_text()
    assert "P5: 19 of 20 last longer" in (tmp_path / "page" / "index.html").read_text()
