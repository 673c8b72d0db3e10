"""``wearsim judge``: what it prints, its files, and what is refused."""

import csv
import json
import math
from pathlib import Path

import pytest

from wearsim.study.judge.laws import laws_for
from wearsim.study.judge.series_file import COLUMNS
from wearsim.study.judge.wear_series import WearReading, wear_series

SHIPPED = Path(__file__).parents[2] / "cases" / "studies" / "metal-wear.csv"


@pytest.fixture
def table(tmp_path):
    """Writer of a table of readings."""

    def write(*rows, head="series,cycles,wear_um"):
        path = tmp_path / "readings.csv"
        path.write_text("\n".join(["# of a day", head, *rows]) + "\n", encoding="utf-8")
        return path

    return write


STRAIGHT = [
    f"{name},{n},{factor * n}" for name, factor in (("a", 1.0), ("b", 1.3), ("c", 0.9)) for n in range(1, 7)
]


@pytest.mark.wide
def test_answer_and_files(cli, table, tmp_path):
    out = tmp_path / "out"
    done = cli("judge", table(*STRAIGHT), "--particles", "200", "--out", out)
    assert done.code == 0, done.err
    text = " ".join(done.out.split())
    assert "18 in 3 series; 9 held out for scoring" in text
    assert "Verdict Archard is good enough" in text
    assert {path.name for path in out.iterdir()} >= {
        *("laws.csv", "constants.csv", "forecasts.csv", "summary.md", "judgement.png", "judgement.svg")
    }
    with (out / "forecasts.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [row["held_out"] for row in rows] == 3 * ["0", "0", "0", "1", "1", "1"]
    assert all(float(row["p05"]) < float(row["wear"]) < float(row["p95"]) for row in rows)
    assert cli("judge", table(*STRAIGHT), "--out", out).code == 2
    assert cli("judge", table(*STRAIGHT), "--out", tmp_path, "--force").code == 2


def test_json(cli, table):
    done = cli("judge", table(*STRAIGHT), "--particles", "200", "--json")
    found = json.loads(done.out)
    assert (found["take"], found["good_enough"], found["held_out_readings"]) == ("Archard", True, 9)
    assert {one["law"] for one in found["laws"]} == {"none", "Archard", "cycle power", "running-in", "offset"}
    best = found["laws"][0]
    assert best["behind"] == 0.0 and best["tied"] and math.isfinite(best["score"])


DIP = [f"a,{n},{7 if n == 5 else 2 * n}" for n in range(1, 10)]
"""10 were to be expected, and 8 were read before."""

FALLING = {
    "a gauge that knows": ([f"{row},0.1" for row in DIP], "7 of series 'a' is below 8 of line 6"),
    "a new part": ([*STRAIGHT[:4], "a,5,1", "a,6,2", *STRAIGHT[6:]], "1 of series 'a' is below 4 of line 6"),
    "a fall": (
        [f"{name},{n},{12 - 2 * n}" for name in "ab" for n in range(1, 6)],
        "2 of series 'a' is below 10",
    ),
}


@pytest.mark.wide
@pytest.mark.parametrize(("rows", "words"), FALLING.values(), ids=FALLING)
def test_wear_that_falls_is_warned_of(cli, table, rows, words):
    head = "series,cycles,wear_um" + ",reading_error" * (rows[0].count(",") - 2)
    done = cli("judge", table(*rows, head=head), "--particles", "100", "--json")
    (text, *_) = json.loads(done.out)["warnings"]
    assert words in text and text.startswith("readings.csv:") and "wear_um: " in text
    line = int(text.split(":")[1])
    assert ["# of a day", head, *rows][line - 1].split(",")[2].startswith(words.split()[0])
    assert text in done.err.replace("\n", " ")
    shown = cli("judge", table(*rows, head=head), "--particles", "100")
    assert words in " ".join(shown.out.split())


@pytest.mark.parametrize(
    "rows",
    [
        [f"{row},1" for row in DIP],
        [f"{name},{n},{(0.9, 1.2)[n % 2] * n**0.3},0" for name in "abc" for n in range(1, 9)],
    ],
    ids=["a coarse gauge", "scatter of 15 %"],
)
def test_scatter_is_not_warned_of(cli, table, rows):
    done = cli(
        "judge", table(*rows, head="series,cycles,wear_um,reading_error"), "--particles", "100", "--json"
    )
    assert json.loads(done.out)["warnings"] == []


def test_picture_says_how_many_series_it_draws(table):
    from wearsim.study.judge.figure import judgement_figure
    from wearsim.study.judge.model import judge_series
    from wearsim.study.judge.series_file import read_series

    for count, expected in ((10, ""), (12, "10 of 12 series drawn")):
        rows = [f"s{name},{n},{2 * n}" for name in range(count) for n in (1, 2, 3)]
        found = judge_series(read_series(table(*rows)), 100, lambda law, scatter: law == "Archard")
        legend = judgement_figure(found, "readings").axes[0].get_legend()
        assert legend.get_title().get_text() == expected
        assert len(legend.get_texts()) == 10


def test_one_reading_decides_nothing(cli, table):
    rows = ["a,1,1.0,0", "a,2,2.0,0", "a,3,3.1,0", "a,4,4.2,1"]
    done = cli("judge", table(*rows, head="series,cycles,wear_um,held_out"), "--particles", "100")
    assert "no law is good enough" in done.out


def test_shipped_readings_are_those_of_the_validation():
    with SHIPPED.open() as file:
        shipped = list(csv.DictReader(line for line in file if not line.startswith("#")))
    data = SHIPPED.parents[2] / "tests" / "validation" / "data" / "metal_wear.csv"
    with data.open() as file:
        read = list(csv.DictReader(line for line in file if not line.startswith("#")))
    for one, other in zip(shipped, read, strict=True):
        assert (one["series"], one["cycles"], one["wear_um"]) == (
            other["specimen"],
            other["cycles"],
            other["wear_um"],
        )
        assert float(one["load_N"]) == pytest.approx(float(other["load_g"]) * 9.80665e-3, rel=1e-3)


def test_page_has_all_columns_laws_and_constants():
    page = (SHIPPED.parents[2] / "docs" / "judge.md").read_text("utf-8")
    readings = [
        WearReading("a", n, n, load=n, environment=name, t_gamma=n, speed=n)
        for n, name in ((1, "dry"), (2, "wet"))
    ]
    laws = laws_for(wear_series(readings, "h", "um", relubrication_noted=True))
    names = {law.name for law in laws if "load power" not in law.name}
    assert len(names) == 10
    assert [name for name in names if f"| {name} |" not in page] == []
    constants = {one for law in laws for one in law.parameters if one.name != "wet over dry"}
    shown = {f"`{one.name}`": f"{one.low:g} to {one.high:g}" for one in constants}
    assert [
        name for name, ends in shown.items() if name not in page or ends not in page.split(name)[1][:60]
    ] == []
    assert [name for name in COLUMNS if f"`{name}`" not in page] == []


@pytest.mark.parametrize(
    ("row", "place", "must"),
    [
        ("a,x,1,", ":3: cycles: ", "must be a number above 0"),
        ("a,1,-2,", ":3: wear_um: ", "set censored = below"),
        (
            "a\x1b,1,2,",
            ":3: series: ",
            "must be one line of at most 200 characters without control characters",
        ),
        ("a,1,nan,", ":3: wear_um: ", "must be a number above 0"),
        (",1,2,", ":3: series: ", "must name what was read"),
        ("a,1,2,perhaps", ":3: censored: ", "must be above, below or empty"),
        ("a,1,2", ":3: ", "needs 4 values, has 3"),
    ],
)
def test_bad_cells_are_named(cli, table, row, place, must):
    path = table(row, "a,2,3,", head="series,cycles,wear_um,censored")
    done = cli("judge", path)
    assert done.code == 2
    assert f"{path}{place}" in done.err and must in done.err


@pytest.mark.parametrize(
    ("head", "must"),
    [
        ("series,cycle,wear_um", "unknown column 'cycle'; did you mean 'cycles'"),
        ("series,wear_um", "exactly one column of exposure"),
        ("series,cycles,time_hours,wear_um", "has cycles, time_hours"),
        ("series,cycles,wear_um,wear_mm", "exactly one column of wear"),
        ("cycles,wear_um", "column 'series' is missing"),
        ("series;cycles;wear_um", "separated by commas"),
    ],
)
def test_bad_heads_are_named(cli, table, head, must):
    done = cli("judge", table("a,1,2", head=head))
    assert done.code == 2
    assert "readings.csv:2: " in done.err and must in done.err


def test_too_few_readings_are_told(cli, table):
    done = cli("judge", table("a,1,2", "b,2,3"))
    assert done.code == 2
    assert (
        "for scoring, has none: add later readings" in done.err and "at least 3 readings to fit" in done.err
    )
    assert json.loads(cli("judge", table("a,1,2"), "--json").out)["error"]["kind"] == "CaseError"
