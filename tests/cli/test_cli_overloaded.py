"""A drive outside its ratings: every answer with hours says so beside them.

Chain no. 40 on 19 teeth at 1000 rpm: rating of the plates 0.004 z^1.08 n^0.9 P^(3 - 0.07 P) hp with
P = 0.5 in, 4.60 kW, of the rollers 1000 * 17 (z/n)^1.5 P^0.8 hp; 1 hp = 0.745699872 kW.
"""

import json
import re
import tomllib

import jsonschema
import openpyxl
import pytest

import wearsim
from wearsim.cli.schema import result_schema
from wearsim.report.answer import answer
from wearsim.result import WearResult

HP = 0.745699872
PLATES = 0.004 * 19**1.08 * 1000**0.9 * 0.5 ** (3 - 0.07 * 0.5) * HP
ROLLERS = 17e3 * (19 / 1000) ** 1.5 * 0.5**0.8 * HP

CASE = """
format_version = 1
title = "No. 40"
[chain]
designation = "ANSI 40"
[sprocket]
teeth = 19
profile = "ansi_b29"
nodes = 101
[drive]
mate_teeth = 57
links = 120
[mechanism]
kind = "wrap"
phases = 2
[load]
power_kW = 7
speed_rpm = 1000
[wear]
condition = "hardened, oiled"
[run]
horizon_hours = 20
life_tolerance = 0.1
"""
SAYS = (
    "plate fatigue 152 %, corrected power 152 % of the rating; "
    "life counts wear only, fatigue may end it sooner"
)


@pytest.fixture(scope="module")
def drive(tmp_path_factory):
    """Function that writes the drive with a power [kW], and runs it once."""
    made = {}

    def write(power=7):
        if power not in made:
            path = tmp_path_factory.mktemp("drive") / f"at-{power}-kW.toml"
            path.write_text(CASE.replace("power_kW = 7", f"power_kW = {power}"))
            result = wearsim.simulate(wearsim.load_case(path))
            result.save(path.parent / "run")
            made[power] = result, path.parent / "run"
        return made[power]

    return write


def test_first_lines_say_it(drive):
    title, *lines = answer(drive()[0], "drive.toml").splitlines()
    assert title == "No. 40"
    text = " ".join(" ".join(lines).split())
    assert text.startswith(f"Overloaded: {SAYS} Life > 20 h (limit not reached)")
    assert max(map(len, lines)) <= 100


def test_a_drive_inside_its_ratings_says_nothing(drive):
    """At 4.6 kW, the rating itself; joint pressure is outside, but its table is for other chains."""
    result, _ = drive(4.6)
    assert "verloaded" not in answer(result, "drive.toml")
    assert result.summary()["overloaded"] == []
    (outside,) = [entry for entry in result.summary()["ratings"] if not entry["ok"]]
    assert (outside["name"], outside["note"][:15]) == ("joint pressure", "for information")
    assert any("outside a rating: joint pressure" in text for text in result.warnings)


def test_json_lists_ratings_with_margins(drive):
    line = json.loads(json.dumps(drive()[0].summary()))
    schema = result_schema()
    jsonschema.Draft202012Validator(schema).validate(line)
    names = ["plate fatigue", "corrected power"]
    assert [entry["name"] for entry in line["overloaded"]] == names
    rated = {entry["name"]: entry for entry in line["ratings"]}
    for name, limit in (("plate fatigue", PLATES), ("roller impact", ROLLERS)):
        assert rated[name]["value"] == pytest.approx(7.0, rel=1e-9)
        assert rated[name]["limit"] == pytest.approx(limit, rel=1e-3)
        assert rated[name]["margin"] == pytest.approx(limit - 7.0, rel=5e-3)
        assert rated[name]["used_percent"] == pytest.approx(700.0 / limit, rel=1e-3)
        assert rated[name]["ok"] == (limit > 7.0)
    safety = rated["safety against breaking"]
    assert safety["at_least"]
    assert safety["margin"] == pytest.approx(safety["value"] - 7.0, rel=1e-12)
    assert safety["used_percent"] == pytest.approx(700.0 / safety["value"], rel=1e-12)


def test_a_saved_run_keeps_its_ratings(drive):
    result, folder = drive()
    loaded = WearResult.load(folder)
    assert loaded.ratings == result.ratings
    assert loaded.summary() == result.summary()


@pytest.mark.parametrize("detail", ["full", "brief"])
def test_page_says_it_before_the_hours_and_has_a_table(cli, drive, tmp_path, detail):
    done = cli("report", drive()[1], "--out", tmp_path / "page", "--detail", detail)
    assert done.code == 0
    page = " ".join((tmp_path / "page" / "index.html").read_text(encoding="utf-8").split())
    assert "<title>No. 40: &gt; 20 h, overloaded</title>" in page
    told = f'<p class="warned"><strong>Overloaded:</strong> {SAYS} '
    assert page.index(told) < page.index('<p class="life">') < page.index('<dl class="band">')
    table = re.search(r'<section id="ratings">(.*?)</section>', page)[1]
    head = re.findall(r'<th scope="col"[^>]*>(.*?)</th>', table)
    assert head == ["rating", "verdict", "value", "allowed", "margin", "used", "source"]
    plates = re.search(r'<th scope="row"[^>]*>plate fatigue</th>(.*?)</tr>', table)[1]
    cells = ["outside", "7 kW", "≤ 4.604 kW", "-2.396 kW", "152 %", "ANSI B29.1, H1"]
    assert re.findall(r"<td[^>]*>(.*?)</td>", plates) == cells


def test_page_of_a_drive_inside_has_the_table_only(cli, drive, tmp_path):
    cli("report", drive(4.6)[1], "--out", tmp_path / "page")
    page = (tmp_path / "page" / "index.html").read_text(encoding="utf-8")
    assert "verloaded" not in page
    assert '<section id="ratings">' in page


@pytest.mark.wide
def test_workbook_and_comparison(cli, drive, tmp_path):
    folders = [drive()[1], drive(4.6)[1]]
    book = tmp_path / "both.xlsx"
    done = cli("compare", *folders, "--xlsx", book)
    assert done.code == 0, done.err
    sheet = openpyxl.load_workbook(book)["Comparison"]
    rows = [[cell.value for cell in row] for row in sheet.iter_rows(max_col=4)]
    assert rows[1][0] == "life"
    assert rows[2][0] == "overloaded"
    assert (rows[2][2], rows[2][3] or "") == (SAYS, "")
    (at,) = [number for number, row in enumerate(rows) if row[0] == "plate fatigue"]
    value, allowed, margin, judged = rows[at : at + 4]
    assert judged[2:] == ["outside", "ok"]
    assert ["outside (for information)"] * 2 in [
        row[2:] for row in rows if row[0] == "joint pressure, verdict"
    ]
    assert (value[1:], allowed[0]) == (
        ["kW", pytest.approx(7.0), pytest.approx(4.6)],
        "plate fatigue, allowed",
    )
    assert allowed[2:] == [pytest.approx(PLATES, rel=1e-3)] * 2
    assert margin[2:] == [pytest.approx(PLATES - p, rel=0.01, abs=2e-3) for p in (7.0, 4.6)]
    done = cli("compare", *folders, "--out", tmp_path / "out")
    summary = (tmp_path / "out" / "summary.md").read_text(encoding="utf-8")
    assert summary.count("(overloaded)") == 1


@pytest.mark.parametrize(("key", "what"), [("service", "power"), ("joint_application", "joint pressure")])
def test_factors_of_ratings_say_that_they_change_no_wear(key, what):
    effect = f"it changes the {what} in the ratings, not the wear"
    tables = tomllib.loads(CASE)
    (text,) = [text for text in wearsim.load_case(tables).assumptions if f"{key}_factor" in text]
    assert text.startswith(f"drive.{key}_factor = 1 (") and text.endswith(f"{effect})")
    tables["drive"][f"{key}_factor"] = 1.4
    words = key.replace("_", " ")
    assert f"{words} factor 1.4: {effect}" in wearsim.load_case(tables).assumptions
