"""``life --xlsx`` and ``compare --xlsx``: the workbook, read back cell by cell."""

import io
import json
import math
import re
import sys
import zipfile

import openpyxl
import pandas as pd
import pytest

from wearsim.input.mechanism_registry import MECHANISMS
from wearsim.quantities import quantities
from wearsim.result import WearResult

pytestmark = pytest.mark.wide

WRAP = """
format_version = 1
title = "Wrapped drive"
[chain]
designation = "ANSI 40"
[sprocket]
teeth = 20
profile = "ansi_b29"
nodes = 101
[mechanism]
phases = 2
[drive]
mate_teeth = 20
links = 114
[joint]
pitch = "uniform"
specific_wear_rate_mm2_per_N = 1e-9
[load]
tension_N = 1000
speed_rpm = 100
[wear]
specific_wear_rate_mm2_per_N = 1e-9
[stop]
elongation_percent = 1
[run]
horizon_hours = 100
life_tolerance = 0.05
"""
GEARS = """
format_version = 1
title = "Pair of gears"
[gear]
pinion_teeth = 19
wheel_teeth = 61
module_mm = 3
face_width_mm = 30
nodes = 61
[load]
torque_N_m = 100
speed_rpm = 1450
[wear]
specific_wear_rate_mm2_per_N = 1e-11
[stop]
critical_depth_mm = 0.02
"""
HISTORY_ROW, FLANK_TITLE = 4, "flank: at the end of the run"


@pytest.fixture
def case(tmp_path):
    """Function that writes a case of its text and returns its path."""

    def write(name, text):
        path = tmp_path / f"{name}.toml"
        path.write_text(text, encoding="utf-8")
        return path

    return write


def read(path):
    return openpyxl.load_workbook(path, rich_text=False)


def table(sheet, title):
    """A table of a sheet: its columns, its units, and the header's row."""
    (left,) = [cell.column for cell in sheet[2] if cell.value == title]
    columns, units = {}, {}
    for column in range(left, sheet.max_column + 1):
        name = sheet.cell(3, column).value
        if name is None:
            break
        units[name] = sheet.cell(4, column).value or ""
        columns[name] = [sheet.cell(row, column).value for row in range(5, sheet.max_row + 1)]
    frame = pd.DataFrame(columns).dropna(how="all")
    return frame.astype(float), units


def rows(sheet):
    """First sheet: label to unit and values up to the meaning."""
    return {row[0]: row[1:-1] for row in sheet.iter_rows(min_row=2, values_only=True) if row[0]}


def saved(folder):
    result = WearResult.load(folder)
    cycles = result.flank["cycles"]
    return result, result.history, result.flank[cycles == cycles.iloc[-1]].reset_index(drop=True)


def same(found, expected):
    """Excel's files hold sixteen digits."""
    pd.testing.assert_frame_equal(found, expected.astype(float), rtol=1e-15, atol=0.0)


def test_numbers_are_those_of_the_folder(cli, drive, tmp_path):
    book, run = tmp_path / "new" / "life.xlsx", tmp_path / "run"
    done = cli("life", drive(), "--xlsx", book, "--out", run)
    assert done.code == 0
    assert f"written to {book}" in done.err
    sheets = read(book)
    assert sheets.sheetnames == ["Answer", "drive", "Inputs"]
    result, history, flank = saved(run)
    found, units = table(sheets["drive"], "history: the run over time")
    same(found, history)
    assert units == {name: quantities()[name].unit for name in history}
    found, units = table(sheets["drive"], FLANK_TITLE)
    same(found, flank)
    assert units == {name: quantities()[name].unit for name in flank}
    answer = rows(sheets["Answer"])
    assert sheets["Answer"]["C1"].value == "Test drive"
    summary = result.summary()
    for name in ("life_hours", "cycles", "life_hours_low", "life_hours_high", "max_depth_mm"):
        assert answer[name][1] == pytest.approx(summary[name], rel=1e-15)
        assert answer[name][0] == (quantities()[name].unit or None)
    assert answer["life_reached"][1] is True
    assert answer["critical_depth_mm"][:2] == ("mm", 0.02)
    assert answer["critical_depth_mm, value"][1] == pytest.approx(0.02)
    assert answer["critical_depth_mm, margin"][1] == 0
    texts = [cell.value for cell in sheets["Answer"]["B"]]
    assert set(result.assumptions) | set(result.warnings) <= set(texts)


def test_print_panes_and_properties(cli, drive, tmp_path):
    book = tmp_path / "life.xlsx"
    cli("life", drive(), "--xlsx", book)
    sheets = read(book)
    panes = {"Answer": "C2", "drive": "A5", "Inputs": "A2"}
    for sheet in sheets:
        assert sheet.freeze_panes == panes[sheet.title]
        assert sheet.page_setup.orientation == "landscape"
        assert sheet.sheet_properties.pageSetUpPr.fitToPage
        assert (sheet.page_setup.fitToWidth or 1, sheet.page_setup.fitToHeight) == (1, 0)
        assert sheet.print_title_rows == f"$1:${int(panes[sheet.title][1:]) - 1}"
        assert all(width.width >= 3 for width in sheet.column_dimensions.values())
    assert sheets["drive"].print_area
    assert sheets["drive"]["B6"].number_format != "General"
    assert sheets.properties.title == "Test drive"
    assert sheets.properties.creator.startswith("wearsim ")


def test_charts_are_native_and_show_the_cells(cli, case, drive, tmp_path):
    book = tmp_path / "all.xlsx"
    done = cli("life", drive(), case("wrap", WRAP), case("gears", GEARS), "--xlsx", book)
    assert done.code == 0, done.err
    sheets = read(book)
    assert sheets.sheetnames == ["Comparison", "drive", "wrap", "gears", "Inputs"]
    count = {sheet.title: len(sheet._charts) for sheet in sheets}
    assert count == {"Comparison": 3, "drive": 2, "wrap": 3, "gears": 2, "Inputs": 0}
    depth, flank, elongation = sheets["Comparison"]._charts
    assert len(depth.series) == 3
    assert len(flank.series) == 4  # the wheel's flank as well
    assert len(elongation.series) == 1
    for chart, x, y in (
        (depth, "time_hours", "max_depth_mm"),
        (flank, "arc_length_mm", "depth_mm"),
        (elongation, "time_hours", "elongation_percent"),
    ):
        for series in chart.series:
            names = []
            for reference in (series.xVal.numRef.f, series.yVal.numRef.f):
                sheet, cells = reference.replace("'", "").rsplit("!", 1)
                first, last = cells.replace("$", "").split(":")
                column = openpyxl.utils.cell.coordinate_from_string(first)[0]
                assert first[len(column) :] == "5"
                assert sheets[sheet][last].value is not None
                below = sheets[sheet][f"{column}{int(last[len(column) :]) + 1}"]
                assert below.value is None
                names.append(sheets[sheet][f"{column}3"].value)
            assert names[0] == x and names[1] in (y, f"wheel_{y}")
    with zipfile.ZipFile(book) as parts:
        text = parts.read("xl/charts/chart1.xml").decode()
    assert "Pair of gears" in text or "Test drive" in text


def test_comparison_of_runs_and_cases(cli, case, drive, tmp_path):
    run, folder, book = tmp_path / "run", tmp_path / "both", tmp_path / "both.xlsx"
    cli("life", drive("light", power_kW=2), "--out", run)
    heavy = drive("heavy", power_kW=4)
    done = cli("compare", run, heavy, case("wrap", WRAP), "--out", folder, "--xlsx", book)
    assert done.code == 0, done.err
    summary = pd.read_csv(folder / "summary.csv")
    sheets = read(book)
    assert sheets.sheetnames == ["Comparison", "light", "heavy", "wrap", "Inputs"]
    found = rows(sheets["Comparison"])
    for name in ("case", "stop"):
        assert found[name][1:4] == tuple(summary[name])
    governing = [name for name in summary.columns if name.startswith("governing")]  # [fatigue] only
    for name in summary.columns.drop(["case", "stop", "title", "life_reached", *governing]):
        if name.endswith("_at_least") and summary[name].isna().all():
            assert name not in found
            continue
        values = [math.nan if value is None else value for value in found[name][1:4]]
        assert values == pytest.approx(summary[name].tolist(), rel=1e-12, nan_ok=True)
    assert found["life_reached"][1:4] == (True, True, False)
    assert found["life"][3] == "> 100 h (limit not reached)"
    assert found["life_hours"][3] is None
    titles = [sheets["Comparison"].cell(1, column).value for column in (3, 4, 5)]
    assert titles == [f"Test drive [{run}]", f"Test drive [{heavy}]", "Wrapped drive"]
    texts = [cell.value or "" for cell in sheets["Comparison"]["B"]]
    assert any("limits differ" in str(text) for text in texts)
    wrap, _ = table(sheets["wrap"], FLANK_TITLE)
    assert list(wrap) == list(MECHANISMS["wrap"].flank)


def test_inputs_tell_where_they_come_from(cli, drive, tmp_path):
    book = tmp_path / "life.xlsx"
    cli("life", drive(), "--xlsx", book, "--set", "load.power_kW=2.5")
    sheet = read(book)["Inputs"]
    found = {row[1]: row[2:6] for row in sheet.iter_rows(min_row=2, values_only=True)}
    assert found["load.power_kW"] == (2.5, "kW", "given", None)
    assert found["run.horizon_hours"][1:3] == ("h", "taken")
    assert found["run.horizon_hours"][3] == "default: until a limit is met"
    assert found["sprocket.engaged_every"][2] == "default"
    assert found["sprocket.contact_end_mm"][2:] == ("taken", "0.16 pitch")
    assert "ISO 606" in found["chain.designation"][3]
    assert "order of magnitude" in found["wear.condition"][3]
    assert sheet.auto_filter.ref == f"A1:G{sheet.max_row}"


@pytest.mark.parametrize(
    "title", ["=1+1", "=Inputs!$A$1", "Wow!A1", "+1", "-1", "@SUM(A1)", "http://x", "{=1}", "'=1"]
)
def test_text_stays_text(cli, drive, tmp_path, title):
    book = tmp_path / "life.xlsx"
    cases = [drive("=2+2", title=f'"{title}"'), drive("b", title=f'"{title}"')]
    for given in (cases[:1], cases):
        assert cli("life", *given, "--xlsx", book, "--force").code == 0
        sheets = read(book)
        cells = [cell for sheet in sheets for row in sheet.iter_rows() for cell in row]
        assert not [cell for cell in cells if cell.data_type == "f" or cell.hyperlink]
        shown = [cell.value for cell in cells if isinstance(cell.value, str)]
        assert any(text.startswith(title) for text in shown)
        with zipfile.ZipFile(book) as parts:
            names = [name for name in parts.namelist() if name.endswith(".xml")]
            content = "".join(parts.read(name).decode() for name in names)
        assert "<c:tx><c:strRef>" not in content
        assert "<f>" not in content


def test_odd_characters_and_long_names(cli, drive, tmp_path):
    book = tmp_path / "life.xlsx"
    long = "a" * 40
    cases = [drive(f"{long}1", title='"T & <b> \U0001f600"'), drive(f"{long}2")]
    cases += [drive("history"), drive("Inputs"), drive("a[b]"), drive("'q'")]
    assert cli("life", *cases, "--xlsx", book).code == 0
    sheets = read(book)
    names = sheets.sheetnames[1:-1]
    assert names == ["a" * 31, f"{'a' * 27} (2)", "history (2)", "Inputs (2)", "a-b-", "q"]
    assert sheets["Comparison"]["C1"].value == "T & <b> \U0001f600"


def test_equal_titles_of_equal_stems(cli, drive, tmp_path):
    one = drive("same")
    folder = tmp_path / "other"
    folder.mkdir()
    two = folder / "same.toml"
    two.write_text(one.read_text())
    book = tmp_path / "life.xlsx"
    assert cli("life", one, two, "--xlsx", book).code == 0
    sheets = read(book)
    assert sheets.sheetnames == ["Comparison", "same", "same (2)", "Inputs"]
    titles = [sheets["Comparison"].cell(1, column).value for column in (3, 4)]
    assert titles == [f"Test drive [{one}]", f"Test drive [{two}]"]
    labels = {cell.value for cell in sheets["Inputs"]["A"]}
    assert labels == {"case", "same", "same (2)"}


def test_in_the_way(cli, drive, tmp_path):
    book = tmp_path / "life.xlsx"
    book.write_bytes(b"mine")
    for command in ("life", "compare"):
        done = cli(command, drive(), "--xlsx", book)
        assert (done.code, done.out) == (2, "")
        assert "--force" in done.err
        assert book.read_bytes() == b"mine"
        done = cli(command, drive(), "--xlsx", tmp_path / "life.xls")
        assert (done.code, done.out) == (2, "")
        assert "must end in .xlsx" in done.err
        done = cli(command, drive(), "--out", tmp_path / "o.xlsx", "--xlsx", tmp_path / "o.xlsx")
        assert (done.code, done.out) == (2, "")
    assert cli("life", drive(), "--xlsx", book, "--force").code == 0
    assert read(book).sheetnames[0] == "Answer"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["drive.toml", "life.xlsx"]


def test_failed_case_is_left_out(cli, drive, tmp_path):
    bad = drive("bad")
    bad.write_text(bad.read_text() + '[run]\nmethod = "per_cycle"\ncycles_per_update = 1000000\n')
    for command in ("life", "compare"):
        book = tmp_path / f"{command}.xlsx"
        assert cli(command, drive(), bad, "--xlsx", book).code == 5
        assert read(book).sheetnames == ["Answer", "drive", "Inputs"]
        none = tmp_path / f"{command}-none.xlsx"
        assert cli(command, bad, "--xlsx", none).code == 3
        assert not none.exists()


@pytest.mark.parametrize("command", ["life", "compare"])
def test_without_the_library(cli, drive, tmp_path, monkeypatch, command):
    monkeypatch.setitem(sys.modules, "xlsxwriter", None)
    done = cli(command, drive(), "--xlsx", tmp_path / "a.xlsx")
    assert (done.code, done.out) == (2, "")
    text = "--xlsx: needs xlsxwriter, which is not installed: pip install 'wearsim[report]'"
    assert text in done.err
    assert not (tmp_path / "a.xlsx").exists()


def test_not_with_solve_for(cli, drive, tmp_path):
    options = ("--solve-for", "load.power_kW", "--require-hours", 100)
    done = cli("life", drive(), *options, "--xlsx", tmp_path / "a.xlsx")
    assert done.code == 2
    assert "--xlsx" in done.err


def test_workbook_is_a_valid_zip_of_xml(cli, drive, tmp_path):
    book = tmp_path / "life.xlsx"
    cli("life", drive(title='"A & B < C"'), "--xlsx", book)
    data = io.BytesIO(book.read_bytes())
    assert zipfile.ZipFile(data).testzip() is None


def numbers(text):
    """Numbers as the screen shows them, thousands set apart, with the sign of a bound."""
    return re.findall(r"(> )?(\d[\d .]*\d|\d) h", text)


@pytest.mark.parametrize(
    ("name", "settings"),
    [
        ("strand", ()),
        ("strand", ("run.horizon_hours=50",)),
        ("wrap", ()),
        ("gears", ()),
        ("gears", ("run.horizon_hours=1",)),
    ],
)
def test_screen_json_and_workbook_agree(cli, case, drive, tmp_path, name, settings):
    """Every life with its bound: on screen with >, beside an empty cell and null as _at_least."""
    path = drive() if name == "strand" else case(name, {"wrap": WRAP, "gears": GEARS}[name])
    run, book = tmp_path / "run", tmp_path / "book.xlsx"
    sets = [part for setting in settings for part in ("--set", setting)]
    screen = " ".join(cli("life", path, *sets, "--out", run, "--xlsx", book).out.split())
    (line,) = cli("compare", run, "--xlsx", tmp_path / "other.xlsx", "--json").out.splitlines()
    found, answer = json.loads(line), rows(read(book)["Answer"])
    shown = [name for name in found if isinstance(found[name], int | float | str)]
    assert {name: answer[name][1] for name in shown if name not in ("schema_version", "title")} == {
        name: pytest.approx(found[name], rel=1e-15) if isinstance(found[name], float) else found[name]
        for name in shown
        if name not in ("schema_version", "title")
    }
    empty = [name for name in found if found[name] is None]
    assert all(name not in answer or answer[name][1] is None for name in empty)
    lives = ["life_hours", "life_hours_low", "life_hours_high"]
    lives += ["chain_life_hours", "sprocket_life_hours"] if name == "wrap" else []
    own = re.sub(r"Practice .*? Of which", "Of which", screen)  # without the hours of published rules
    told = numbers(re.sub(r"\([^()]*\)", "", own))[: len(lives)]
    assert len(told) == len(lives)
    for key, (sign, number) in zip(lives, told, strict=True):
        is_bound = found[key] is None
        assert bool(sign) == is_bound
        hours = found[f"{key}_at_least"] if is_bound else found[key]
        assert float(number.replace(" ", "")) == pytest.approx(hours, rel=1e-3)
        assert (found[f"{key}_at_least"] is None) != is_bound
    if settings:
        horizon = float(settings[0].partition("=")[2])
        assert found["life_hours_at_least"] == found["hours_run"] == horizon
        assert found["life_hours_high_at_least"] == horizon
    if name == "wrap":
        assert found["chains_run"] == 1  # no chain has come to its limit within the run
    (total,) = re.findall(r"Worn most .*?(?:at [\d.]+ mm of|\(flank) ([\d.]+) mm", screen)
    assert float(total) == pytest.approx(found["flank_length_mm"], abs=0.05)


def test_meanings_stand_by_themselves(cli, case, drive, tmp_path):
    """No meaning of a row points at another row; every row has one, and every limit its own name."""
    book = tmp_path / "all.xlsx"
    cli("life", drive(), case("wrap", WRAP), case("gears", GEARS), "--xlsx", book)
    sheet = read(book)["Comparison"]
    found = [(row[0], row[-1]) for row in sheet.iter_rows(min_row=2, values_only=True) if row[0]]
    meanings = dict(found[: [label for label, _ in found].index("warnings")])
    sections = ("limits, ", "ratings of the drive")
    meanings = {label: text for label, text in meanings.items() if not label.startswith(sections)}
    assert all(meanings.values()), [label for label, text in meanings.items() if not text]
    for label, text in meanings.items():
        assert not re.match(r"(that|the same|its|it|those|this)\b", text), label
        assert not label.startswith(" ")
    assert len(set(meanings.values())) == len(meanings)
