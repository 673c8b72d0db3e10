"""``wearsim optimise``: the best designs of a case."""

import csv
import json
import tomllib
from itertools import pairwise
from pathlib import Path

import pytest

from wearsim.runner import run_study as run_module

CASES = Path(__file__).parents[2] / "cases"
WIDTH = '"sprocket.face_width_mm" = {low = 8.0, high = 16.0}\n'
OFFSET = '"sprocket.evolute_offset_mm" = {low = 5.5, high = 6.0}\n'
START, END = (f"sprocket.contact_{name}_mm" for name in ("start", "end"))


def table(parameters=WIDTH + OFFSET, objectives='"life_hours"', limits="mass_kg = {high = 1.5}\n"):
    return (
        f"[optimise]\nobjectives = [{objectives}]\n[optimise.parameters]\n{parameters}"
        f"[optimise.limits]\n{limits}"
    )


@pytest.fixture
def case(drive):
    """Function that writes the test drive with a table [optimise]."""

    def write(optimise=None):
        path = drive()
        with path.open("a") as file:
            file.write(
                "[run]\nhorizon_hours = 1e6\nlife_tolerance = 0.1\n"
                + (table() if optimise is None else optimise)
            )
        return path

    return write


@pytest.fixture
def without_pictures(monkeypatch):
    """Function that leaves out the pictures from then on, which take longer than the search."""
    return lambda: monkeypatch.setattr("wearsim.study.optimise.sheet.save_figures", lambda *_: None)


def answer(cli, *arguments, evaluations=20):
    done = cli("optimise", *arguments, "--evaluations", evaluations, "--json")
    assert done.code == 0, done.err
    return json.loads(done.out)


def test_best_design_as_text(cli, case):
    done = cli("optimise", case(), "--evaluations", 40, "--explain")
    assert done.code == 0
    lines = done.out.splitlines()
    assert lines[:3] == ["Test drive", "", "best design: longest life_hours"]
    head = "| design | sprocket.face_width_mm | sprocket.evolute_offset_mm | life_hours | mass_kg | to mass_kg.high |"  # noqa: E501
    assert lines[4] == head
    assert lines[6].startswith("| as given | 16.17 | 5.6 | ")
    assert lines[7].startswith("| 01 | ")
    assert "% against the case as given)" in done.out
    assert "tried        40 designs" in done.out
    assert " of them by limits.mass_kg, above high = 1.5 (" in done.out
    assert "1. the mass is that of the new outline over the face width" in done.out
    assert "sprocket.evolute_offset_mm of the best design lies on its high end" in done.out
    assert "the case as given breaks limits" in done.out


def test_best_design_as_json_is_that_of_life(cli, case):
    content = answer(cli, case(), evaluations=40)
    (best,) = content["designs"]
    assert (content["evaluations"], content["seed"], content["case"]) == (40, 1, "drive")
    assert 0 < content["infeasible"] < 40
    assert best["mass_kg"] == pytest.approx(1.5, rel=1e-3)
    assert 0.0 <= best["margins"]["mass_kg.high"] < 1e-3
    assert best["inputs"]["sprocket.evolute_offset_mm"] == pytest.approx(6.0, rel=1e-3)
    settings = [f"{key}={value}" for key, value in best["inputs"].items()]
    single = cli("life", case(""), "--json", *(part for one in settings for part in ("--set", one)))
    assert json.loads(single.out)["life_hours"] == best["life_hours"]
    assert not content["given"]["feasible"]


def test_seed_evaluations_and_setting(cli, case):
    base = answer(cli, case())
    assert answer(cli, case()) == base
    assert answer(cli, case(), "--seed", 2)["designs"] != base["designs"]
    assert answer(cli, case(), evaluations=30)["evaluations"] == 30
    harder = answer(cli, case(), "--set", "optimise.limits.mass_kg.high=1.2")
    assert harder["designs"][0]["mass_kg"] <= 1.2
    assert cli("optimise", case(), "--evaluations", 9).code == 2


def test_workers_make_no_difference(cli, case):
    base = answer(cli, case(), evaluations=12)
    assert answer(cli, case(), "--threads", 2, evaluations=12) == base
    assert answer(cli, case(), "--jobs", 1, evaluations=12) == base


@pytest.mark.parametrize(
    ("objective", "limits", "kept"),
    [
        ("life_hours", "mass_kg = {high = 1.4}", lambda m: m["mass_kg"] <= 1.4),
        ("mass_kg", "life_hours = {low = 200.0}", lambda m: 200.0 <= m["life_hours"] < 202.0),
        ("mass_kg", "mass_kg = {low = 1.4}", lambda m: 1.4 <= m["mass_kg"] < 1.41),
        ("life_hours", "life_hours = {high = 200.0}", lambda m: 199.0 < m["life_hours"] <= 200.0),
        ("mass_kg", "peak_pressure_MPa = {high = 900.0}", lambda m: 895.0 < m["peak_pressure_MPa"] <= 900.0),
        (
            "life_hours",
            "peak_pressure_MPa = {low = 900.0}",
            lambda m: 900.0 <= m["peak_pressure_MPa"] < 905.0,
        ),
        ("peak_pressure_MPa", "mass_kg = {high = 1.4}", lambda m: m["mass_kg"] > 1.395),
    ],
)
def test_objectives_and_limits(cli, case, objective, limits, kept):
    path = case(table(WIDTH, f'"{objective}"', limits))
    (best,) = answer(cli, path, evaluations=30)["designs"]
    assert best["feasible"]
    assert kept(best), best


def test_limit_beyond_the_horizon_raises_it(cli, case):
    path = case(table(WIDTH, '"mass_kg"', "life_hours = {low = 200.0}"))
    (best,) = answer(cli, path, "--set", "run.horizon_hours=50", evaluations=30)["designs"]
    assert best["life_hours"] == pytest.approx(200.0, rel=0.01)


def test_lives_beyond_the_horizon(cli, case):
    done = cli("optimise", case(), "--set", "run.horizon_hours=5", "--evaluations", 10)
    assert "| > 5 |" in done.out
    assert "which of them is longest is not known: raise it" in done.out


def test_lists_of_values(cli, case):
    parameters = '"sprocket.back_flank" = ["mirrored", "relieved"]\n'
    parameters += '"sprocket.teeth" = {low = 20, high = 22}\n"load.power_kW" = [3, 2.5, 2]\n'
    content = answer(
        cli,
        case(table(parameters)),
        "--set",
        "sprocket.evolute_offset_mm=6.2",
        "--set",
        "optimise.limits.mass_kg.high=5",
        evaluations=30,
    )
    (best,) = content["designs"]
    assert best["inputs"]["sprocket.teeth"] == 22
    assert best["inputs"]["load.power_kW"] == 2
    assert content["evaluations"] <= 18
    assert "sprocket.teeth of the best design lies on its high end" in " ".join(content["warnings"])


@pytest.mark.wide
def test_front(cli, case, tmp_path, without_pictures):
    pytest.importorskip("optuna", reason="optuna is not installed")
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    path, out = case(table(objectives='"life_hours", "mass_kg"', limits="")), tmp_path / "out"
    done = cli("optimise", path, "--evaluations", 60, "--out", out)
    assert done.code == 0, done.err
    assert "longest life_hours, least mass_kg" in done.out
    without_pictures()
    assert cli("optimise", path, "--evaluations", 60, "--out", out).out == done.out
    with (out / "front.csv").open(encoding="utf-8") as file:
        rows = [(float(row["life_hours"]), float(row["mass_kg"])) for row in csv.DictReader(file)]
    assert len(rows) > 5
    assert rows == sorted(rows, reverse=True)
    assert all(a[1] > b[1] for a, b in pairwise(rows))
    names = {f"{name}.{kind}" for name in ("convergence", "front", "parallel") for kind in ("png", "svg")}
    assert {entry.name for entry in out.iterdir()} == {
        ".wearsim",
        *names,
        "candidates.csv",
        "front.csv",
        "summary.md",
        "study.json",
        "shards",
        "designs",
    }
    designs = sorted((out / "designs").iterdir())
    assert [entry.name for entry in designs] == [f"{at:02d}.toml" for at in range(1, len(rows) + 1)]
    life = cli("life", designs[0], "--json")
    assert json.loads(life.out)["life_hours"] == rows[0][0]
    drawn = cli("export", designs[-1], "--out", tmp_path / "wheel.dxf")
    assert drawn.code == 0, drawn.err
    assert (tmp_path / "wheel.dxf").stat().st_size > 10_000


def test_several_objectives_without_optuna(cli, case, monkeypatch):
    from wearsim import extras

    monkeypatch.setattr(extras.util, "find_spec", lambda name: None)
    done = cli("optimise", case(table(objectives='"life_hours", "mass_kg"')))
    assert (done.code, done.out) == (2, "")
    assert "pip install 'wearsim[optimise]'" in done.err


def test_interrupted_search_goes_on_and_runs_nothing_twice(
    cli, case, tmp_path, monkeypatch, without_pictures
):
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    without_pictures()
    whole = cli("optimise", case(), "--evaluations", 25)
    out, ran, real = tmp_path / "out", [], run_module.run_shard

    def counted(shard):
        ran.extend(shard.design.rows)
        if len(ran) == 13:
            raise KeyboardInterrupt
        return real(shard)

    monkeypatch.setattr(run_module, "run_shard", counted)
    broken = cli("optimise", case(), "--evaluations", 25, "--out", out, "--threads", 1)
    assert broken.code == 130
    assert "run the same command again to go on" in broken.err
    assert len(ran) == 13
    done = cli("optimise", case(), "--evaluations", 25, "--out", out)
    assert done.out == whole.out
    # The given case and 25 designs; those of the batch that was broken off once more.
    again = len(ran) - 26
    assert again == 6
    assert cli("optimise", case(), "--evaluations", 25, "--out", out).out == whole.out
    assert len(ran) == 26 + again
    content = cli("optimise", case(), "--evaluations", 40, "--out", out, "--json")
    assert json.loads(content.out)["evaluations"] == 40
    other = ("--set", "optimise.limits.mass_kg.high=1.4")
    refused = cli("optimise", case(), "--evaluations", 25, "--out", out, *other)
    assert refused.code == 2
    assert "holds another one" in refused.err
    plan = cli("optimise", case(), "--out", out, "--dry-run")
    assert plan.code == 0
    assert "designs      400 at most" in plan.out
    assert " s in one thread, from 4 designs" in plan.out
    (out / "designs" / "99.toml").write_text("# design 7 of wearsim optimise drive: mass_kg 1\n")
    assert cli("optimise", case(), "--evaluations", 10, "--out", out, "--force", *other).code == 0
    assert [entry.name for entry in (out / "designs").iterdir()] == ["01.toml"]


def test_nothing_feasible_says_why(cli, case):
    path = case(table('"sprocket.evolute_offset_mm" = {low = 1.0, high = 2.0}\n'))
    done = cli("optimise", path, "--evaluations", 10)
    assert (done.code, done.out) == (3, "")
    assert "none of 10 designs is feasible: 10 of them by sprocket.evolute_offset_mm: exit" in done.err
    done = cli("optimise", case(table(limits="mass_kg = {high = 0.1}")), "--evaluations", 10)
    assert done.code == 3
    assert "10 of them by limits.mass_kg, above high = 0.1 (" in done.err


def test_gears_have_no_mass(cli, tmp_path):
    gears = (CASES / "involute-36t-mild.toml").read_text(encoding="utf-8")
    path = tmp_path / "gears.toml"
    parameters = '"gear.face_width_mm" = {low = 60.8, high = 91.2}\n'
    path.write_text(gears + table(parameters, limits="peak_pressure_MPa = {high = 460}"))
    (best,) = answer(cli, path, evaluations=10)["designs"]
    assert best["peak_pressure_MPa"] <= 460.0
    path.write_text(gears + table(parameters))
    done = cli("optimise", path)
    assert done.code == 2
    assert "the mass needs a sprocket whose whole outline is known" in done.err


def test_wrap_between_the_forms_of_iso_606(cli, tmp_path):
    text = (
        (CASES / "08b-19t-wrap.toml").read_text(encoding="utf-8").replace('form = "min"\n', "nodes = 101\n")
    )
    text = text.replace('kind = "wrap"', 'kind = "wrap"\nphases = 2')
    text += "horizon_hours = 10\n"
    path = tmp_path / "wrap.toml"
    parameters = '"sprocket.seat_radius_mm" = {low = 4.31, high = 4.43}\n'
    path.write_text(text + table(parameters, '"mass_kg"', "peak_pressure_MPa = {high = 2000}"))
    (best,) = answer(cli, path, evaluations=10)["designs"]
    # The wider the seat, the less is left; 4.31 to 4.43 mm lie between both forms.
    assert best["inputs"]["sprocket.seat_radius_mm"] > 4.39


def test_files_of_a_case_go_with_its_designs(cli, tmp_path, without_pictures):
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    without_pictures()
    for name in ("hertz-arc-prescribed.toml", "hertz-arc-prescribed.csv"):
        (tmp_path / name).write_bytes((CASES / name).read_bytes())
    path, out = tmp_path / "hertz-arc-prescribed.toml", tmp_path / "out"
    with path.open("a") as file:
        file.write(table('"mechanism.roller_slip_fraction" = {low = 0.5, high = 0.9}\n', limits=""))
    done = cli("optimise", path, "--evaluations", 10, "--out", out)
    assert done.code == 0, done.err
    assert cli("life", out / "designs" / "01.toml").code == 0
    given = tomllib.loads((out / "designs" / "01.toml").read_text(encoding="utf-8"))
    assert "optimise" not in given


@pytest.fixture
def two_flanks(tmp_path):
    """Case that names a file in another folder, with both of two files as a parameter."""
    (tmp_path / "data").mkdir()
    text = (CASES / "hertz-arc-prescribed.csv").read_text(encoding="utf-8")
    (tmp_path / "data" / "a.csv").write_text(text)
    head, *rows = text.splitlines()
    at = head.split(",").index("load_per_width_N_per_mm")
    cells = [row.split(",") for row in rows]
    less = [",".join([*row[:at], str(0.5 * float(row[at])), *row[at + 1 :]]) for row in cells]
    (tmp_path / "b.csv").write_text("\n".join([head, *less]) + "\n")
    path = tmp_path / "case.toml"
    case = (CASES / "hertz-arc-prescribed.toml").read_text(encoding="utf-8")
    case = case.replace('"hertz-arc-prescribed.csv"', '"data/a.csv"')
    path.write_text(case + table('"mechanism.table_file" = ["data/a.csv", "b.csv"]\n', limits=""))
    return path


def test_files_as_a_parameter_go_with_the_designs(cli, two_flanks, tmp_path, without_pictures):
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    without_pictures()
    out = tmp_path / "out"
    done = cli("optimise", two_flanks, "--evaluations", 10, "--out", out, "--json")
    assert done.code == 0, done.err
    content = json.loads(done.out)
    assert (content["evaluations"], content["infeasible"]) == (2, 0)
    assert content["given"]["inputs"] == {"mechanism.table_file": "a.csv"}
    (best,) = content["designs"]
    assert best["inputs"] == {"mechanism.table_file": "b.csv"}
    assert best["life_hours"] > content["given"]["life_hours"]
    # Only the file that the design names lies beside it.
    assert {path.name for path in (out / "designs").iterdir()} == {"01.toml", "b.csv"}
    single = json.loads(cli("life", out / "designs" / "01.toml", "--json").out)
    assert single["life_hours"] == best["life_hours"]


def test_files_as_a_parameter_are_there_and_differ(cli, two_flanks, tmp_path):
    (tmp_path / "b.csv").unlink()
    done = cli("optimise", two_flanks)
    assert (done.code, done.out) == (2, "")
    assert 'parameters."mechanism.table_file": must name files that can be read' in done.err
    assert "but 'b.csv' cannot" in done.err
    text = two_flanks.read_text().replace('"b.csv"', '"data/./a.csv"')
    two_flanks.write_text(text)
    assert "each file may appear once" in cli("optimise", two_flanks).err
    two_flanks.write_text(text.replace('"data/./a.csv"', "3"))
    assert "takes names of files: give a list" in cli("optimise", two_flanks).err


def test_files_of_the_user_stay_as_they_are(cli, two_flanks, tmp_path, without_pictures):
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    without_pictures()
    out = tmp_path / "out"
    designs = out / "designs"
    command = ("optimise", two_flanks, "--evaluations", 10, "--out", out)
    assert cli(*command).code == 0
    own = {"99.toml": "# mine\n", "2026-plan.toml": "", "b.csv": "other\n", "notes.txt": ""}
    for name, text in own.items():
        (designs / name).write_text(text)
    (designs / "98.toml").write_text("# design 3 of wearsim optimise case: life_hours 1\n")
    assert cli(*command).code == 0
    assert cli(*command, "--force", "--seed", 2).code == 0
    assert {name: (designs / name).read_text() for name in own} == own
    assert not (designs / "98.toml").exists()
    # The file of the case lies there under another name, and the design names that.
    named = tomllib.loads((designs / "01.toml").read_text())["mechanism"]["table_file"]
    assert named.startswith("b-")
    assert (designs / named).read_text() == (tmp_path / "b.csv").read_text()
    (designs / "01.toml").write_text("# mine\n")
    done = cli(*command, "--force", "--seed", 2)
    assert (done.code, (designs / "01.toml").read_text()) == (2, "# mine\n")
    assert "01.toml: must be free for a design" in done.err


def test_limits_of_wear_move_with_a_warning(cli, case):
    path = case(table('"stop.critical_depth_mm" = [0.1, 0.2]\n', limits=""))
    (text,) = [one for one in answer(cli, path)["warnings"] if "limit of wear" in one]
    assert text.startswith("stop.critical_depth_mm is a limit of wear")
    assert "the limit moves and not the drive" in text


def test_numbers_of_entries_have_one_spelling(cli, case):
    load = "[load]\npower_kW = 3\nspeed_rpm = 100\n"
    blocks = "[[duty]]\nshare_of_time = 1.0\npower_kW = 3\nspeed_rpm = 100\n"

    def written(parameters):
        path = case(table(parameters, limits=""))
        path.write_text(path.read_text().replace(load, blocks))
        return path

    speeds = "{low = 100.0, high = 110.0}\n"
    (best,) = answer(cli, written(f'"duty.01.speed_rpm" = {speeds}'), evaluations=10)["designs"]
    assert list(best["inputs"]) == ["duty.1.speed_rpm"]
    done = cli("optimise", written(f'"duty.1.speed_rpm" = {speeds}"duty.01.speed_rpm" = {speeds}'))
    assert done.code == 2
    assert "duty.1.speed_rpm is given twice" in done.err
    done = cli("optimise", written(f'"duty.².speed_rpm" = {speeds}'))
    assert done.code == 2
    assert "must be a key of a case" in done.err


def test_misspelt_keys_of_a_range_get_no_hint_at_other_tables(cli, case):
    done = cli("optimise", case(table('"load.power_kW" = {low = 1.0, hihg = 2.0}\n')))
    assert "optimise.parameters.load.power_kW.hihg: unknown key\n" in done.err
    assert "did you mean" not in done.err


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "optimise: this table is required"),
        ("[optimise]\n", "optimise.parameters: "),
        (table(""), "must hold at least 1 "),
        (table(objectives=""), "must hold at least 1 "),
        (table(objectives='"cost"'), "optimise.objectives"),
        (table(objectives='"mass_kg", "mass_kg"'), "each objective may appear once"),
        (table('"sprocket.tooth" = [3, 4]\n'), "did you mean 'sprocket.teeth'"),
        (table('"sprocket.teeth" = [20, 20]\n'), "each value may appear once"),
        (table('"sprocket.teeth" = [20]\n'), "must hold at least 2 values (holds 1)"),
        (table('"sprocket.teeth" = [20, 20.0]\n'), "each value may appear once"),
        (table('"sprocket.teeth" = 12\n'), "must be a range {low, high} or a list of values (got 12)"),
        (table('"sprocket.teeth" = {low = 20, high = 2000000000}\n'), "at most 100000 whole numbers"),
        (table('"load.power_kW" = {low = -1e308, high = 1e308}\n'), "must differ by less than 1.8e308"),
        (table('"sprocket.displaced" = {low = 0, high = 1}\n'), "give the list [true, false]"),
        (table('"format_version" = [1, 2]\n'), "tells how the file is read"),
        (table('"sprocket.nodes" = [101, 201]\n'), "tells how finely a design is calculated"),
        (table('"mechanism.phases" = [8, 16]\n'), "tells how finely a design is calculated"),
        (table('"sprocket.teeth" = {low = 20.0, high = 22.0}\n'), "takes whole numbers"),
        (table('"sprocket.profile" = {low = 1, high = 2}\n'), "takes words, not a range"),
        (table('"load.power_kW" = {low = 2.0, high = 2.0}\n'), "must be above low = 2"),
        (table('"run.life_tolerance" = {low = 1e-4, high = 1e-3}\n'), "must be a key of the design"),
        (table(limits="mass_kg = {}\n"), "a limit needs low, high or both"),
        (table(limits="mass_kg = {low = 2, high = 1}\n"), "must be above low = 2"),
        (table(limits="mass_kg = {low = 0}\n"), "greater than 0"),
        (table(limits="mass = {low = 1}\n"), "did you mean"),
    ],
)
def test_bad_tables(cli, case, text, message):
    done = cli("optimise", case(text), "--evaluations", 10)
    assert (done.code, done.out) == (2, "")
    assert message in done.err


def test_other_commands_check_the_table(cli, case):
    assert cli("check", case()).code == 0
    done = cli("check", case(table(limits="mass_kg = {}\n")))
    assert done.code == 2
    assert "optimise.limits.mass_kg.high: a limit needs low, high or both" in done.err
