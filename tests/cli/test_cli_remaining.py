"""``wearsim remaining``: one reading, one answer."""

import csv
import json

import pytest

READING = ("--hours", "100", "--depth-mm", "0.01", "--reading-error-mm", "0.001")


def test_answer_and_json_agree(cli, drive):
    """Life is the hours at the reading times critical depth's own, from the two outputs of life."""
    path = drive()
    text = cli("remaining", path, *READING)
    found = json.loads(cli("remaining", path, *READING, "--json").out)
    assert text.code == 0
    assert text.out.startswith("Test drive\n  Remaining  ")
    assert max(map(len, text.out.splitlines())) <= 100
    life = json.loads(cli("life", path, "--json").out)["life_hours"]
    assert found["schema_version"] == 1
    assert found["remaining_hours"] == pytest.approx(found["life_hours"] - 100.0)
    assert found["life_hours"] * found["coefficient_factor"] == pytest.approx(life, rel=1e-9)
    assert found["coefficient"] == pytest.approx(5e-11 * found["coefficient_factor"])
    assert found["remaining_hours_low"] < found["remaining_hours"] < found["remaining_hours_high"]


def test_service_gives_the_day_on_which_the_life_ends(cli, drive):
    settings = ("--set", "service.hours_per_day=10", "--set", "service.start_date=2026-01-01")
    found = json.loads(cli("remaining", drive(), *READING, *settings, "--json").out)
    days = found["remaining_hours"] / 10.0
    assert found["service"]["days"] == pytest.approx(days)
    text = cli("remaining", drive(), *READING, *settings).out
    assert f"until {found['service']['date']}" in text.replace("\n", " ")


@pytest.mark.parametrize(
    "arguments",
    [
        ("--hours", "100"),
        ("--hours", "100", "--depth-mm", "0.01", "--elongation", "1"),
        ("--depth-mm", "0.01"),
        ("--hours", "nan", "--depth-mm", "0.01"),
        ("--hours", "100", "--depth-mm", "-1"),
    ],
)
def test_not_one_reading_is_bad_input(cli, drive, arguments):
    assert cli("remaining", drive(), *arguments).code == 2


def test_a_reading_beyond_the_limit_is_bad_input(cli, drive):
    done = cli("remaining", drive(), "--hours", "100", "--depth-mm", "0.03", "--json")
    assert done.code == 2
    assert json.loads(done.out)["error"]["kind"] == "CaseError"
    assert "its value when the limit is reached" in done.err


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
kind = "wrap"
phases = 2
[joint]
specific_wear_rate_mm2_per_N = 1.5e-8
[load]
power_kW = 4.6
speed_rpm = 1000
[wear]
specific_wear_rate_mm2_per_N = 1e-9
[service]
hours_per_day = 8
km_per_hour = 30
[lubrication]
lasts_hours = 100
dry_factor = 4
"""
ROWS = """\
date,quantity,value,links,result,error
2026-01-01,new,,,,
2026-02-02,gauge_percent,0.75,,go,
2026-03-01,relubrication,,,,
2026-04-01,chain_length_mm,1283,100,,0.5
"""


@pytest.fixture
def chain(tmp_path):
    """A case of a chain, and its readings."""
    case, rows = tmp_path / "chain.toml", tmp_path / "rows.csv"
    case.write_text(WRAP)
    rows.write_text(ROWS)
    return case, rows


def test_text_of_a_table_tells_what_the_json_holds(cli, chain):
    done = cli("remaining", *chain)
    found = json.loads(cli("remaining", *chain, "--json").out)
    assert done.code == 0, done.err
    assert max(map(len, done.out.splitlines())) <= 100
    text = " ".join(done.out.split())
    assert text.startswith("Wrapped test drive Remaining ")
    assert "1 measured, 1 by a gauge" in text
    assert "once, every 472 h" in text
    rows = {row["quantity"]: row for row in found["intervals"]}
    assert list(rows) == [
        *("remaining_hours", "remaining_km", "end_date"),
        *("elongation_percent", "life_hours", "coefficient_factor"),
    ]
    for name, row in rows.items():
        values = [row[f"p{share}"] for share in ("05", "25", "50", "75", "95")]
        assert values == sorted(values), name
    left = rows["remaining_hours"]
    ends = [found[f"remaining_hours{end}"] for end in ("_low", "", "_high")]
    assert ends == [left["p05"], left["p50"], left["p95"]]
    assert f"Until {rows['end_date']['p50']} " in text
    assert found["reading_hours"] == 90 * 8
    assert [row["reading_row"] for row in found["readings"]] == [3, 5]
    assert found["readings"][1]["elongation_percent"] == pytest.approx(100 * (1283 / 1270 - 1))


def test_folder_of_a_table(cli, chain, tmp_path):
    out = tmp_path / "out"
    assert cli("remaining", *chain, "--out", out).code == 0
    names = [".wearsim", "intervals.csv", "readings.csv", "readings.png", "readings.svg", "summary.md"]
    assert sorted(path.name for path in out.iterdir()) == names
    found = json.loads(cli("remaining", *chain, "--json").out)
    with (out / "intervals.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["quantity"] for row in rows] == [row["quantity"] for row in found["intervals"]]
    assert float(rows[0]["p50"]) == pytest.approx(found["remaining_hours"], rel=1e-12)
    assert cli("remaining", *chain, "--out", out).code == 2
    assert cli("remaining", *chain, "--out", out, "--force").code == 0


def test_error_of_rows_that_state_none_is_the_option(cli, chain):
    case, rows = chain
    rows.write_text("time_hours,quantity,value\n500,elongation_percent,0.6\n")
    found = json.loads(cli("remaining", case, rows, "--reading-error-percent", "0.02", "--json").out)
    assert found["readings"][0]["error"] == 0.02


@pytest.mark.parametrize(
    ("options", "message"),
    [(("--hours", "100"), "leave out --hours"), (("--elongation", "1"), "leave out --hours")],
)
def test_a_table_goes_without_single_readings(cli, chain, options, message):
    done = cli("remaining", *chain, *options)
    assert done.code == 2
    assert message in done.err


def test_a_bad_table_is_bad_input(cli, chain):
    case, rows = chain
    rows.write_text(ROWS + "2026-03-15,gauge_percent,0.75,,perhaps,\n")
    done = cli("remaining", case, rows, "--json")
    assert done.code == 2
    assert "rows.csv:6: result: must be go (the gauge does not fall in) or no-go" in done.err
    assert "rows.csv:6: date: must not go backwards: 2026-03-15 comes after 2026-04-01" in done.err
    error = json.loads(done.out)["error"]
    assert (error["line"], error["key"]) == (6, "result")


def test_pictures_are_of_tables(cli, drive, tmp_path):
    done = cli("remaining", drive(), *READING, "--out", tmp_path / "out")
    assert done.code == 2
    assert "--out needs READINGS" in done.err


@pytest.mark.parametrize("command", ["remaining", "calibrate"])
def test_readings_that_exclude_each_other_are_named_in_text_and_json(cli, tmp_path, command):
    """309.0 mm over 24 links are 1.378 %: 0.628/root(0.0328^2 + 0.02^2) = 16.3 errors above 0.75 %."""
    if command == "calibrate":
        pytest.importorskip("pandera", reason="pandera is not installed")
    case, log = tmp_path / "wrap.toml", tmp_path / "log.csv"
    case.write_text(WRAP, encoding="utf-8")
    rows = "time_hours,quantity,value,links,result,error\n2000,chain_length_mm,309.0,24,,0.1\n"
    log.write_text(rows + "2000,gauge_percent,0.75,,go,0.02\n", encoding="utf-8")
    words = (
        "line 3: go at 0.75 % contradicts 1.378 % in line 2: they exclude each other by 16.3 standard errors"
    )
    assert words in " ".join(cli(command, case, log).out.split())
    found = json.loads(cli(command, case, log, "--json").out)
    assert any(words in text for text in found["warnings"])
