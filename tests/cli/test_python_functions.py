"""Each public function answers as its command does with ``--json``, in tables and pictures too."""

import io
import json
import math

import pandas as pd
import pytest

import wearsim

pytestmark = pytest.mark.wide

RATE = "wear.specific_wear_rate_mm2_per_N"
WRAP = """\
format_version = 1
title = "Wrapped test drive"
[chain]
designation = "ANSI 40"
[sprocket]
teeth = 19
profile = "ansi_b29"
nodes = 51
[drive]
mate_teeth = 57
links = 120
[mechanism]
phases = 2
[joint]
specific_wear_rate_mm2_per_N = 1.5e-8
[load]
power_kW = 4.6
speed_rpm = 1000
[wear]
specific_wear_rate_mm2_per_N = 1e-9
[stop]
critical_depth_mm = 0.02
[run]
life_tolerance = 0.1
[maintenance]
replace_at_percent = [3]
chain_price = 40
sprocket_price = 60
"""


@pytest.fixture
def answer(cli):
    """Function that returns the JSON of a command, its lines as a list where there are several."""

    def run(*arguments):
        done = cli(*arguments, "--json")
        assert done.code == 0, done.err
        lines = [json.loads(line) for line in done.out.splitlines()]
        return lines if len(lines) > 1 else lines[0]

    return run


@pytest.fixture
def wrap(tmp_path):
    path = tmp_path / "wrap.toml"
    path.write_text(WRAP)
    return path


@pytest.fixture
def two(tmp_path, two_sprockets):
    path = tmp_path / "two.toml"
    path.write_text(two_sprockets)
    return path


def is_shown(result, *tables):
    """Whether a result shows itself shortly, and its tables in a notebook."""
    assert len(repr(result)) < 300
    assert "\n" not in repr(result)
    assert str(result) == result.text
    html = result._repr_html_()
    for name in tables:
        table = result.tables()[name]
        assert len(table) > 0
        assert str(table.columns[0]) in html
    return True


def is_drawn(figure):
    """Whether a figure can be written and shows itself in a notebook."""
    figure.savefig(io.BytesIO(), format="png", dpi=30)
    return figure._repr_svg_().startswith("<?xml")


def test_check(answer, wrap, two, drive):
    for path in (wrap, drive()):
        found = wearsim.check(wearsim.load_case(path))
        assert found.summary() == answer("check", path)
    assert list(wearsim.check(wrap).ratings["value"]) == [
        one["value"] for one in answer("check", wrap)["rating"]
    ]
    assert is_shown(wearsim.check(wrap), "ratings")
    assert wearsim.check(two).summary() == answer("check", two)
    assert "ok, sprockets" not in str(wearsim.check(two)) and "Spans" in str(wearsim.check(two))
    with pytest.raises(wearsim.CaseError, match=r"load\.speed_rpm"):
        wearsim.check(wearsim.load_case(wrap).with_({"load.speed_rpm": -1}))


def test_loads(answer, wrap, two):
    found = wearsim.loads(wrap, elongation_percent=1.5, worst=True)
    expected = answer("loads", wrap, "--elongation", 1.5, "--worst")
    assert found.summary() == expected
    assert list(found.teeth["force_N"]) == [row["force_N"] for row in expected["teeth"]]
    assert is_shown(found, "teeth")
    assert is_drawn(found.plot())
    both, expected = wearsim.loads(wearsim.load_case(two)), answer("loads", two)
    assert both.summary() == expected
    assert list(both.spans["tension_N"]) == [span["tension_N"] for span in expected["layout"]["spans"]]
    assert set(both.teeth["sprocket"]) == {"driver", "roll"}
    assert len(both.plot().axes) == 2
    with pytest.raises(wearsim.GeometryError, match="elongation_percent must be at least 0"):
        wearsim.loads(wrap, elongation_percent=-1.0)


def test_simulate(answer, two, drive):
    path = drive()
    life = wearsim.simulate(wearsim.load_case(path))
    assert life.summary() == answer("life", path)
    assert len(repr(life)) < 300 and "Life" in life._repr_html_()
    assert wearsim.simulate(path).summary() == life.summary()
    found = wearsim.simulate(wearsim.load_case(two))
    expected = answer("life", two)
    assert found.life.hours == expected["life_hours"]
    assert found.chain.hours == expected["chain_life_hours"]
    assert len(repr(found)) < 300 and "roll" in found._repr_html_()
    for drawn in (life, found):
        assert all(is_drawn(draw()) for draw in (drawn.plot, drawn.plot_history, drawn.plot_loads))


def test_one_line_is_short_however_long_the_title(drive, two):
    title = "A drive of " + "many words " * 17
    case = wearsim.load_case(drive()).with_({"title": title})
    whole = wearsim.load_case(two).with_({"title": title})
    found = (
        case,
        whole,
        wearsim.check(case),
        wearsim.simulate(case),
        wearsim.sweep(case, {"load.speed_rpm": [9]}),
    )
    assert all(len(repr(one)) < 300 and "\n" not in repr(one) for one in found)
    assert "Life" in repr(found[3]) and "longest life" in repr(found[4])


def test_a_flank_is_drawn_where_one_wants_it(drive):
    from matplotlib.figure import Figure

    figure = Figure()
    left, right = figure.subplots(1, 2)
    result = wearsim.simulate(wearsim.load_case(drive()))
    assert result.plot(right) is figure
    assert not left.lines
    assert right.get_xlabel() == "x, mm"


def test_sweep(answer, tmp_path, drive):
    path = drive(power_kW=2.5)
    study = tmp_path / "study.toml"
    study.write_text(
        'format_version = 1\ncase = "drive.toml"\n[grid]\n"load.speed_rpm" = [80, 120]\n'
        '"sprocket.teeth" = [21, 23]\n'
    )
    expected = answer("sweep", study)
    case = wearsim.load_case(path)
    done = []
    found = wearsim.sweep(
        case, {"load.speed_rpm": [80, 120], "sprocket.teeth": range(21, 24, 2)}, progress=done.append
    )
    assert [{**row, "case": "drive"} for row in found.summary()["cases"]] == expected
    assert wearsim.sweep(study).summary()["cases"] == expected
    assert list(found.cases["life_hours"]) == [row["life_hours"] for row in expected]
    assert done[-1] == 1.0
    assert is_shown(found, "cases")
    assert set(found.pictures()) == {"curves", "heat_map", "parallel"}
    assert is_drawn(found.plot("heat_map"))
    with pytest.raises(wearsim.WearsimError, match="one of the pictures: curves, heat_map, parallel"):
        found.plot("pie")
    with pytest.raises(TypeError, match="give grid, together or designs"):
        wearsim.sweep(case)


def test_a_swept_key_takes_the_place_of_what_says_the_same(answer, tmp_path, drive):
    case = wearsim.load_case(drive())
    found = wearsim.sweep(case, {"load.tension_N": ["2 kN", 3000]}).cases["life_hours"]
    # The life goes with 1/load, but for the pressure, which Archard's law does not know.
    assert found[0] / found[1] == pytest.approx(1.5, rel=1e-3)
    pairs = wearsim.sweep(case, together=[{"load.speed_rpm": (50, 100), "load.tension_N": (900, 900)}])
    assert pairs.cases["life_hours"][0] / pairs.cases["life_hours"][1] == pytest.approx(2.0, rel=1e-9)
    one = wearsim.sweep(case, designs=[{"load.speed_rpm": 50, "load.tension_N": 900}])
    assert one.cases["life_hours"][0] == pairs.cases["life_hours"][0]
    with pytest.raises(wearsim.CaseError, match=r"load\.tensoin_N"):
        wearsim.sweep(case, {"load.tensoin_N": [1.0]})


def test_a_whole_drive_is_swept(answer, tmp_path, two):
    (tmp_path / "study.toml").write_text(
        'format_version = 1\ncase = "two.toml"\n[grid]\n"sprocket.2.teeth" = [20, 25]\n'
    )
    expected = answer("sweep", tmp_path / "study.toml")
    found = wearsim.sweep(wearsim.load_case(two), {"sprocket.2.teeth": [20, 25]})
    assert list(found.cases["roll_life_hours"]) == [row["roll_life_hours"] for row in expected]
    alone = wearsim.simulate(wearsim.load_case(two).with_({"sprocket.2.teeth": 25}))
    assert found.cases["life_hours"][1] == alone.life.hours


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda case: wearsim.uncertainty(case, samples=1), "samples must be at least 2"),
        (lambda case: wearsim.uncertainty(case, method="sobl"), "method must be one of sobol, lhs, random"),
        (lambda case: wearsim.sweep(case, {"load.speed_rpm": [9]}, threads=0), "threads must be at least 1"),
        (lambda case: wearsim.optimise(case, {}, evaluations=2), "evaluations must be at least 10"),
        (lambda case: wearsim.export(case, state="wrn"), "state must be one of new, worn, both"),
        (lambda case: wearsim.loads(case, phase=2.0), "phase must be at least 0 and at most 1"),
    ],
)
def test_arguments_are_as_bounded_as_options(drive, call, words):
    with pytest.raises(wearsim.GeometryError, match=words):
        call(wearsim.load_case(drive()))


def test_uncertainty(answer, drive):
    path = drive()
    path.write_text(
        path.read_text() + f'[uncertainty]\n"{RATE}" = {{distribution = "lognormal", sigma_ln = 0.3}}\n'
    )
    expected = answer("uncertainty", path, "--samples", 32, "--seed", 5, "--method", "lhs")
    given = wearsim.load_case(path).with_({"uncertainty": None})
    law = {RATE: {"distribution": "lognormal", "sigma_ln": 0.3}}
    for found in (
        wearsim.uncertainty(path, samples=32, seed=5, method="lhs"),
        wearsim.uncertainty(given, law, samples=32, seed=5, method="lhs", threads=1),
    ):
        assert found.summary() == expected
    assert list(found.percentiles["life_hours"]) == [expected[f"p{p}_hours"] for p in (10, 50, 90)]
    assert len(found.samples) == 32
    assert is_shown(found, "percentiles", "fits", "convergence", "samples")
    assert is_drawn(found.plot())


def test_lubricate(answer):
    expected = answer("lubricate", "bicycle-17t-lubricants")
    done = []
    found = wearsim.lubricate("bicycle-17t-lubricants", progress=done.append)
    assert found.summary() == expected
    assert list(found.intervals["cost_per_1000_h"]) == [
        row["cost_per_1000_h"] for row in expected["policies"]
    ]
    assert list(found.lubricants["lubricant"]) == ["wet drip", "wax drip", "immersion wax"]
    assert found.headline.endswith("immersion wax")
    assert done[0] == 0.0 and max(done) <= 1.0
    assert is_shown(found, "intervals", "lubricants")
    assert is_drawn(found.plot())


def test_judge(answer, tmp_path):
    rows = [
        {"series": name, "cycles": n, "wear_um": rate * n}
        for name, rate in (("a", 2.0), ("b", 3.0), ("c", 1.5))
        for n in range(1, 7)
    ]
    path = tmp_path / "readings.csv"
    pd.DataFrame(rows).to_csv(path, index=False)
    expected, done = answer("judge", path, "--particles", 200), []
    for given in (path, str(path), rows, pd.DataFrame(rows)):
        found = wearsim.judge(given, particles=200, progress=done.append)
        assert found.summary() == expected
    assert found.headline == "Archard is good enough: its bands hold the expected share of readings"
    assert list(found.laws["score"]) == [law["score"] for law in expected["laws"]]
    assert (found.forecasts["held_out"].sum(), found.forecasts["wear"].max()) == (9, 18.0)
    assert set(found.constants["law"]) == set(found.laws["law"])
    assert done[0] > 0.0 and done[-1] == 1.0
    assert is_shown(found, "laws", "constants", "forecasts")
    assert is_drawn(found.plot())
    with pytest.raises(wearsim.CaseError, match=r"readings:3: wear_um: must be a number above 0"):
        wearsim.judge([rows[0], {**rows[1], "wear_um": -1.0}])
    with pytest.raises(wearsim.GeometryError, match="judge: particles must be"):
        wearsim.judge(rows, particles=10)


def test_maintain(answer, wrap, two):
    expected = answer("maintain", wrap)
    done = []
    found = wearsim.maintain(wrap, progress=done.append)
    assert found.summary() == expected
    assert list(found.policies["cost_per_1000_h"]) == [row["cost_per_1000_h"] for row in expected["policies"]]
    assert len(found.tooth_counts) == len(expected["tooth_counts"])
    assert found.parts.empty and found.schedule.empty
    assert done[0] == 0.0 and max(done) < 1.0
    assert is_shown(found, "policies", "tooth_counts")
    assert is_drawn(found.plot())
    dear = wearsim.maintain(wrap, {"replace_at_percent": [3], "chain_price": 80, "sprocket_price": 120})
    assert dear.policies["cost_per_1000_h"][0] == pytest.approx(2.0 * found.policies["cost_per_1000_h"][0])
    whole, expected = wearsim.maintain(two), answer("maintain", two)
    assert whole.summary() == expected
    stops = sum(len(row["schedule"]) for row in expected["policies"])
    assert len(whole.schedule) == stops
    assert is_shown(whole, "policies", "parts")
    assert is_drawn(whole.plot())


@pytest.mark.parametrize(
    ("arguments", "options"),
    [
        ({"depth": 0.01, "error": 0.001}, ("--depth-mm", 0.01, "--reading-error-mm", 0.001)),
        # One phase of so short a life hardly wears where pins would lie.
        ({"over_pins": 5e-7, "error": 1e-7}, ("--over-pins-mm", 5e-7, "--reading-error-mm", 1e-7)),
        ({"elongation_percent": 1.0, "error": 0.1}, ("--elongation", 1.0, "--reading-error-percent", 0.1)),
    ],
)
def test_remaining(answer, wrap, arguments, options):
    expected = answer("remaining", wrap, "--hours", 100, *options)
    found = wearsim.remaining(wearsim.load_case(wrap), 100, **arguments)
    assert found.summary() == expected
    assert found.remaining.hours == expected["remaining_hours"]
    assert found.remaining_low.hours == expected["remaining_hours_low"]
    assert found.remaining_high.hours == found.parts["remaining_hours_high"][0]
    assert found.life.hours == expected["life_hours"]
    assert found.coefficient == expected["coefficient"]
    assert is_shown(found, "parts")


ROWS = [
    {"time_hours": 100, "quantity": "chain_length_mm", "value": 1277, "links": 100, "error": 0.5},
    {"time_hours": 200, "quantity": "gauge_percent", "value": 0.75, "result": "no-go"},
]


def test_remaining_of_a_table(answer, wrap, tmp_path):
    import pandas as pd

    file = tmp_path / "rows.csv"
    file.write_text(
        "time_hours,quantity,value,links,result,error\n"
        "100,chain_length_mm,1277,100,,0.5\n200,gauge_percent,0.75,,no-go,\n"
    )
    expected = answer("remaining", wrap, file)
    for readings in (file, ROWS, pd.DataFrame(ROWS)):
        found = wearsim.remaining(wearsim.load_case(wrap), readings=readings)
        assert found.summary() == expected
    assert found.intervals["p50"][0] == expected["remaining_hours"]
    assert is_shown(found, "intervals", "readings")
    assert is_drawn(found.plot())
    wide = wearsim.remaining(wrap, readings=ROWS, error=0.2)
    assert list(wide.readings["error"])[1] == 0.2
    with pytest.raises(TypeError, match="without others"):
        wearsim.remaining(wrap, 100, readings=ROWS)
    with pytest.raises(wearsim.CaseError, match="readings:3: result: must be go"):
        wearsim.remaining(wrap, readings=[ROWS[0], {**ROWS[1], "result": "maybe"}])
    with pytest.raises(TypeError, match="hours and one reading"):
        wearsim.remaining(wrap, depth=0.1)


def test_error_of_a_reading_is_usually_that_of_the_command(answer, wrap, drive):
    depth = wearsim.remaining(drive(critical_depth_mm=0.2), 100, depth=0.1)
    assert depth.summary() == answer(
        "remaining", drive(critical_depth_mm=0.2), "--hours", 100, "--depth-mm", 0.1
    )
    grown = wearsim.remaining(wrap, 100, elongation_percent=1)
    assert grown.summary() == answer("remaining", wrap, "--hours", 100, "--elongation", 1)


def test_not_one_reading_is_refused(wrap, two):
    for given in ({}, {"depth": 0.01, "over_pins": 0.01}):
        with pytest.raises(TypeError, match="one of depth, over_pins, size_over_pins and elongation_percent"):
            wearsim.remaining(wrap, 100, **given)
    with pytest.raises(wearsim.GeometryError, match="hours must be above 0"):
        wearsim.remaining(wrap, 0, depth=0.01)
    with pytest.raises(wearsim.CaseError, match=r"larger than its error of 0\.02"):
        wearsim.remaining(wrap, 100, depth=0.01)
    with pytest.raises(wearsim.CaseError, match="on the teeth of one sprocket"):
        wearsim.remaining(two, 100, depth=0.1)


def test_calibrate(answer, cli, tmp_path, drive):
    pytest.importorskip("pandera", reason="pandera is not installed")
    import pandas as pd

    path = drive()
    life = wearsim.simulate(wearsim.load_case(path)).life.hours
    rows = [
        {"time_hours": part * life, "quantity": "max_depth_mm", "value": 0.03 * part, "error": 0.0005}
        for part in (0.3, 0.6)
    ]
    file = tmp_path / "readings.csv"
    pd.DataFrame(rows).to_csv(file, index=False)
    expected = answer("calibrate", path, file)
    for readings in (file, str(file), pd.DataFrame(rows), rows):
        found = wearsim.calibrate(path, readings)
        assert found.summary() == expected
    # Deeper by half than the case has it, so the coefficient is half again as large.
    assert found.values["value"][0] / found.values["given"][0] == pytest.approx(1.5, rel=0.05)
    assert found.case.wear.coefficient == found.values["value"][0]
    assert list(found.readings["value"]) == [0.009, 0.018]
    assert cli("calibrate", path, file, "--out", tmp_path / "command").code == 0
    wearsim.calibrate(path, file).save(tmp_path / "python")
    assert files_of(tmp_path / "python") == files_of(tmp_path / "command") != {}
    assert is_shown(found, "parts", "values", "readings")
    assert is_drawn(found.plot())
    with pytest.raises(wearsim.CaseError, match=r"^readings:2: quantity"):
        wearsim.calibrate(path, [{**rows[0], "quantity": "depth"}])


def test_optimise(answer, drive):
    path = drive()
    width = {"sprocket.face_width_mm": {"low": 8.0, "high": 16.0}}
    path.write_text(
        path.read_text() + "[run]\nlife_tolerance = 0.1\n[optimise]\nobjectives = ['life_hours']\n"
        "[optimise.parameters]\n'sprocket.face_width_mm' = {low = 8.0, high = 16.0}\n"
        "[optimise.limits]\nmass_kg = {high = 1.5}\n"
    )
    expected = answer("optimise", path, "--evaluations", 20)
    plain = wearsim.load_case(path).with_({"optimise": None})
    found = wearsim.optimise(plain, width, limits={"mass_kg": {"high": 1.5}}, evaluations=20)
    assert found.summary() == wearsim.optimise(path, evaluations=20).summary() == expected
    assert list(found.designs["sprocket.face_width_mm"]) == [
        one["inputs"]["sprocket.face_width_mm"] for one in expected["designs"]
    ]
    assert found.cases[0].title == "Test drive"
    assert found.cases[0].inputs["sprocket"]["face_width_mm"] == found.designs["sprocket.face_width_mm"][0]
    assert len(found.candidates) == expected["evaluations"] + 1
    assert is_shown(found, "designs", "candidates")
    assert is_drawn(found.plot())


def files_of(folder):
    """Content of every file that a folder shows, shards of a study apart."""
    shown = (path for path in folder.rglob("*") if path.is_file() and not path.name.startswith("."))
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in shown
        if path.relative_to(folder).parts[0] not in ("shards", "study.json")
    }


@pytest.mark.parametrize(
    "name", ["maintain", "plan", "lubricate", "judge", "remaining", "sweep", "uncertainty"]
)
def test_an_answer_is_saved_as_its_command_does(cli, tmp_path, monkeypatch, wrap, two, drive, name):
    if name in ("sweep", "uncertainty"):
        pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    monkeypatch.chdir(tmp_path)
    rows = [
        {"series": name, "cycles": n, "wear_um": rate * n}
        for name, rate in (("a", 2.0), ("b", 3.0), ("c", 1.5))
        for n in range(1, 7)
    ]
    pd.DataFrame(rows).to_csv("rows.csv", index=False)
    pd.DataFrame(ROWS).to_csv("chain.csv", index=False)
    path = drive()
    (tmp_path / "study.toml").write_text(
        f'format_version = 1\ncase = "{path.name}"\n[grid]\n"load.speed_rpm" = [80, 120]\n'
    )
    oiled = "bicycle-17t-lubricants"
    coarse = {"sprocket.nodes": 41, "mechanism.phases": 1, "run.life_tolerance": 0.1}
    settings = [word for key, value in coarse.items() for word in ("--set", f"{key}={value}")]
    words, function = {
        "maintain": (("maintain", wrap), lambda: wearsim.maintain(wrap)),
        "plan": (("maintain", two), lambda: wearsim.maintain(two)),
        "lubricate": (
            ("lubricate", oiled, *settings),
            lambda: wearsim.lubricate(wearsim.load_case(oiled).with_(coarse)),
        ),
        "judge": (
            ("judge", "rows.csv", "--particles", 200),
            lambda: wearsim.judge("rows.csv", particles=200),
        ),
        "remaining": (
            ("remaining", wrap, "chain.csv"),
            lambda: wearsim.remaining(wrap, readings="chain.csv"),
        ),
        "sweep": (("sweep", "study.toml"), lambda: wearsim.sweep("study.toml")),
        "uncertainty": (
            ("uncertainty", path, "--samples", 16),
            lambda: wearsim.uncertainty(path, samples=16),
        ),
    }[name]
    done = cli(*words, "--out", "command")
    assert done.code == 0, done.err
    answer = function()
    answer.save("python")
    expected = files_of(tmp_path / "command")
    assert len(expected) > 2
    assert files_of(tmp_path / "python") == expected
    with pytest.raises(wearsim.WearsimError, match="python"):
        answer.save("python")
    answer.save("python", force=True)


def test_designs_are_saved_as_the_command_does(cli, tmp_path, drive):
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    path = drive()
    path.write_text(
        path.read_text() + "[run]\nlife_tolerance = 0.1\n[optimise.parameters]\n"
        "'sprocket.face_width_mm' = {low = 8.0, high = 16.0}\n"
    )
    assert cli("optimise", path, "--evaluations", 20, "--out", tmp_path / "command").code == 0
    wearsim.optimise(path, evaluations=20).save(tmp_path / "python")
    assert files_of(tmp_path / "python") == files_of(tmp_path / "command") != {}


def test_select(answer):
    options = (
        "--power",
        "4 hp",
        "--rpm",
        200,
        "--ratio",
        2,
        "--hours",
        8000,
        "--series",
        "B",
        "--strands",
        "1-2",
    )
    expected = answer(
        "select", *options, "--centre", 600, "--lubrication", "greased", "--environment", "dust"
    )
    asked = {"power": "4 hp", "rpm": 200, "ratio": 2, "hours": 8000, "series": ["B"], "strands": (1, 2)}
    found = wearsim.select(**asked, centre=600, lubrication="greased", environment="dust")
    assert found.summary() == expected
    assert list(found.drives["designation"]) == [one["designation"] for one in expected["drives"]]
    assert is_shown(found, "drives")
    chosen = found.case(1)
    assert chosen.sprockets[0].case.inputs["sprocket"]["teeth"] == expected["drives"][1]["driver_teeth"]
    with pytest.raises(wearsim.CaseError, match=r"^teeth_min: must be at least 9"):
        wearsim.select(**asked, teeth_min=3)


def test_export(cli, tmp_path, wrap, two, drive):
    assert cli("export", wrap, "--out", tmp_path / "wheel.svg", "--state", "both").code == 0
    case = wearsim.load_case(wrap)
    found = wearsim.export(case, tmp_path / "python.svg", state="both")
    assert (tmp_path / "python.svg").read_bytes() == (tmp_path / "wheel.svg").read_bytes()
    assert found.files == (tmp_path / "python.svg",)
    assert found.content("csv").decode().count("\n") == len(found.outline) + 1
    assert is_shown(found, "outline")
    with pytest.raises(wearsim.WearsimError, match=r"python\.svg"):
        wearsim.export(case, tmp_path / "python.svg")
    with pytest.raises(wearsim.WearsimError, match=r"must end in one of \.dxf, \.svg"):
        wearsim.export(case, tmp_path / "wheel.png")
    assert cli("export", two, "--sprocket", "roll", "--out", tmp_path / "roll.svg").code == 0
    wearsim.export(wearsim.load_case(two), tmp_path / "own.svg", sprocket="roll")
    assert (tmp_path / "own.svg").read_bytes() == (tmp_path / "roll.svg").read_bytes()
    with pytest.raises(wearsim.CaseError, match=r"one wheel of the whole drive: one of 'driver', 'roll'$"):
        wearsim.export(two)
    with pytest.raises(wearsim.CaseError, match=r"one of 'driver', 'roll' \(got 'rol'\)"):
        wearsim.export(two, sprocket="rol")
    assert cli("export", drive(), "--template", tmp_path / "cli.svg").code == 0
    wearsim.export(wearsim.simulate(wearsim.load_case(drive())), template=tmp_path / "gauge.svg")
    assert (tmp_path / "gauge.svg").read_bytes() == (tmp_path / "cli.svg").read_bytes()


def test_what_is_asked_of_one_sprocket_of_a_drive_says_so(two):
    one = wearsim.load_case(two).sprockets[0].case
    assert wearsim.loads(one).teeth["force_N"].max() > 0.0
    with pytest.raises(wearsim.CaseError, match="this is one sprocket of a drive, give the drive"):
        wearsim.uncertainty(one)
    assert math.isfinite(wearsim.simulate(one).life.hours_run)
