"""The sheet of a whole drive: ``wearsim report`` of [[sprocket]]."""

import math
import re
from dataclasses import replace
from datetime import date, timedelta
from html import unescape

import pytest

from wearsim.chain.rating_findings import deciding
from wearsim.drive.life import drive_life
from wearsim.drive.load_case import load_drive
from wearsim.drive.maintenance import drive_plan
from wearsim.quantities import grouped
from wearsim.report.drive.layout import layout_json
from wearsim.report.drive.plan_sheet import plan_json
from wearsim.report.drive.report_page import save_sheet, sheet_html
from wearsim.report.html.paper import SheetHead
from wearsim.report.verification import given_rows, verification_rows
from wearsim.result import Life
from wearsim.result.lives import hours, service_measures

LOOP = """\
format_version = 1
title = "Loop of three"
[chain]
designation = "08B-1"
[[sprocket]]
name = "motor"
teeth = 17
profile = "iso606"
nodes = 61
position_mm = [0, 0]
[[sprocket]]
name = "tensioner"
role = "idler"
teeth = 13
profile = "iso606"
nodes = 61
position_mm = [62, 155]
outside = true
take_up = {tensioner_force_N = 80, guide_deg = -37.5, travel_mm = [-25, 60]}
[[sprocket]]
name = "cassette"
profile = "iso606"
nodes = 61
position_mm = [200, 250]
cog = [{teeth = 20, share_of_time = 0.6}, {teeth = 22, share_of_time = 0.4}]
[load]
power_kW = 1.3
speed_rpm = 300
[wear]
condition = "hardened, oiled"
[run]
horizon_hours = 2
life_tolerance = 0.1
"""


DRIVER = """\
nodes = 61
bore_mm = 20
keyway_width_mm = 6
keyway_depth_mm = 2.8
hub_diameter_mm = 45
hub_length_mm = 28
"""


@pytest.fixture(scope="session")
def bored(two_sprockets):
    """Text of the drive of two sprockets with bores, one with a keyway and a hub, that wears fast."""
    text = two_sprockets.replace("nodes = 61\n", DRIVER, 1).replace('"roll"', '"roll <1>"')
    text = text.replace("nodes = 61\n[drive]", "nodes = 61\nbore_mm = 25\n[drive]")
    return text.replace("= 1e-8", "= 4e-8").replace("= 5e-9", "= 2e-8")


def written(path, text):
    path.write_text(text)
    return path


@pytest.fixture(scope="module")
def lived(tmp_path_factory, bored):
    """The drive of two sprockets, worn."""
    return drive_life(load_drive(written(tmp_path_factory.mktemp("drive") / "drive.toml", bored)))


HEAD = SheetHead(date(2026, 11, 24), "Line 4", "A. Author", "D-17", "B", "C. Hecker")


@pytest.fixture(scope="module")
def page(lived):
    return plain(sheet_html(lived, HEAD))


def plain(page):
    """A page with spaces that break."""
    return page.replace("\u00a0", " ")


def tables(page):
    """Rows of cells as text by the captions of the tables."""
    found = {}
    for table in re.findall(r"<table.*?</table>", page, re.DOTALL):
        caption = re.search(r"<caption[^>]*>(.*?)</caption>", table)[1]
        found[caption] = [
            [unescape(cell) for cell in re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", row)]
            for row in re.findall(r"<tr[^>]*>(.*?)</tr>", table)
        ]
    return found


def pairs(page):
    return {
        unescape(label): unescape(text) for label, text in re.findall(r"<dt>(.*?)</dt><dd>(.*?)</dd>", page)
    }


def test_the_head_says_what_it_is_of_and_when(page):
    found = pairs(page)
    assert [found[label] for label, _ in HEAD.rows] == [text for _, text in HEAD.rows]
    assert {"revision": "B", "checked by": "C. Hecker"}.items() <= found.items()
    assert "D-17 | revision B | 2026-11-24" in page and "counter(pages)" in page
    assert "<h1>08B-1, 17 to 20 teeth</h1>" in page
    assert "roll &lt;1&gt;" in page and "roll <1>" not in page


def test_the_page_fetches_nothing_and_has_no_script(page):
    assert "<script" not in page
    assert not re.search(r'(?:src|href)="(?!#|data:)', page)
    assert "default-src 'none'" in page


def test_inputs_come_first_then_the_verdict_then_the_hours(lived, page):
    driver = lived.drive.driver
    found = pairs(page)
    told = [
        *given_rows(lived.drive.inputs, driver.case),
        *verification_rows(driver.case, lived.reference.ratings),
    ]
    # The geometry tells more of the chain, under the same label.
    assert all(found[label] == text for label, text in told if label != "chain")
    assert found["load as given"].endswith("at 300 rpm")
    order = ('id="given"', 'id="verification"', "Ratings: within", '<p class="life">', 'id="ratings"')
    assert list(order) == sorted(order, key=page.index)


def test_no_number_breaks_off_its_thousands_or_its_unit(lived):
    """Of all that stands in cells, pairs and sentences; drawings set their letters themselves."""
    told = re.sub(r"<(head|svg|thead).*?</\1>", "", sheet_html(lived, HEAD), flags=re.DOTALL)
    told = re.sub(r"<[^>]*>", "\n", told)
    assert re.search(r"\d\u00a0\d{3}\u00a0h\b", told)
    assert re.findall(r"\d \d{3}\b|\d (?:h|mm|N|MPa|kW|rpm|%)(?![\w/])", told) == []


def test_the_command_needs_a_browser_for_a_pdf_before_it_runs(cli, tmp_path, bored, monkeypatch):
    monkeypatch.setattr("wearsim.report.html.pdf._NAMES", ())
    monkeypatch.setattr("wearsim.report.html.pdf._PLACES", {})
    done = cli("report", written(tmp_path / "two.toml", bored), "--out", tmp_path / "sheet.pdf")
    assert done.code == 2
    assert "sheet.pdf: a PDF must be printed by Chromium, Chrome or Edge, and none is installed" in done.err


def test_ratings_come_first_with_their_margins(lived, page):
    ratings = lived.results["driver"].ratings
    rows = tables(page)["Ratings"][1:]
    assert [row[0] for row in rows] == [one.name for one in ratings]
    for row, one in zip(rows, ratings, strict=True):
        unit = f" {one.unit}" if one.unit else ""
        sign = "≥" if one.at_least else "≤"
        judges = one in deciding(ratings)
        assert row[1] == ("ok" if one.ok else "outside") + ("" if judges else " (for information)")
        assert row[2:5] == [
            f"{grouped(one.value)}{unit}",
            f"{sign} {grouped(one.limit)}{unit}",
            f"{grouped(one.margin)}{unit}",
        ]
        assert row[5] == f"{grouped(100 * one.used, 3)} %"
        assert one.source in row[6]
    assert page.index('id="ratings"') < page.index('id="layout"') < page.index('id="lives"')
    assert page.index('id="flanks"') < page.index('id="warnings"') < page.index('id="assumptions"')


def test_shafts_and_spans_are_those_of_the_layout(lived, page):
    layout, found = layout_json(lived.drive), tables(page)
    for row, one in zip(found["Shafts"][1:], layout["sprockets"], strict=True):
        rpm = 300.0 * 17 / one["teeth"]
        assert row == [
            one["name"],
            grouped(rpm),
            grouped(one["torque_N_m"]),
            grouped(one["power_kW"]),
            grouped(one["shaft_load_N"]),
            f"{one['shaft_direction_deg']:.1f}",
        ]
    for row, one in zip(found["Spans"][1:], layout["spans"], strict=True):
        assert row == [f"{one['from']} to {one['to']}", f"{one['length_mm']:.1f}", grouped(one["tension_N"])]
    text = unescape(page)
    assert f"efficiency {100 * layout['efficiency']:.2f} %" in text
    assert f"loss: {layout['friction_heat_W']:.3g} W, efficiency" in text
    assert f"Centrifugal tension: {grouped(layout['centrifugal_tension_N'], 3)} N" in text
    for span in layout["spans"]:
        assert f">{grouped(span['tension_N'])} N</text>" in page


def test_geometry_by_hand(lived, page):
    rows = {row[0]: row for row in tables(page)["Sprockets, mm and degrees"][1:]}
    layout = {one["name"]: one for one in layout_json(lived.drive)["sprockets"]}
    for name, teeth in (("driver", 17), ("roll <1>", 20)):
        # ISO 606, 08B: pitch 12.7 mm, roller 8.51 mm, in seats of 0.505 d1 about the pitch circle.
        pitch = 12.7 / math.sin(math.pi / teeth)
        seated = pitch - 2 * (0.505 - 0.5) * 8.51
        across = seated if teeth % 2 == 0 else seated * math.cos(math.pi / (2 * teeth))
        row = rows[name]
        assert row[2:4] == [str(teeth), f"{pitch:.2f}"]
        assert float(row[4]) == pytest.approx(pitch - 2 * 0.505 * 8.51, abs=0.0051)  # root
        assert float(row[6]) == pytest.approx(across + 8.51, abs=0.0051)
        assert row[7:9] == [f"{layout[name]['wrap_deg']:.1f}", f"{layout[name]['teeth_in_mesh']:.1f}"]
    assert rows["driver"][9:] == ["20", "6", "2.8", "45", "28"]
    assert rows["roll <1>"][9:] == ["25", "-", "-", "-", "-"]
    assert float(rows["driver"][4]) < float(rows["driver"][3]) < float(rows["driver"][5])
    found = pairs(page)
    assert found["length"].startswith("110 links, 1397 mm, ")
    first, other = layout.values()
    assert found["centre distances"] == f"driver to roll <1> {other['x_mm'] - first['x_mm']:.2f} mm"
    assert found["speed of the chain"] == f"{300 / 60 * 17 * 12.7e-3:.4g} m/s"


def test_lives_are_on_one_clock_with_dates(lived, page):
    rows = {row[0]: row for row in tables(page)["Lives"][1:]}
    assert list(rows) == list(lived.parts)
    for name, life in lived.parts.items():
        assert rows[name][1] == hours(life)
        measures = service_measures(lived.drive.driver.case.inputs, life.hours_run)
        assert rows[name][3:5] == [grouped(measures["days"]), measures["date"]]
        assert measures["date"] == str(date(2027, 1, 4) + timedelta(days=int(life.hours_run / 16)))
    low, high = (grouped(end.hours_run) for end in lived.band(lived.first))
    assert rows[lived.first][2] == f"{low} to {high} h"
    assert f'<p class="life">{hours(lived.life)}</p>' in page


def test_the_plan_ends_with_the_third_chain(lived, page):
    """Each sprocket goes with the last chain change before its end, as `wearsim maintain` has it."""
    chain = lived.chain.hours
    expected = {number * chain: ["chain"] for number in (1, 2, 3)}
    for name, life in lived.sprockets.items():
        chains = int(life.hours_run / chain)
        for number in range(chains, 4, chains) if isinstance(life, Life) else ():
            expected[number * chain].append(name)
    assert [row[1:] for row in tables(page)["Replacements"][1:]] == [
        [grouped(days := at / 16.0), str(date(2027, 1, 4) + timedelta(int(days))), ", ".join(parts), str(i)]
        for i, (at, parts) in enumerate(expected.items(), start=1)
    ]
    (policy,) = (
        one for one in plan_json(drive_plan(lived))["policies"] if one["policy"].startswith("sprockets with")
    )
    assert [(one["hours"], one["parts"]) for one in policy["schedule"]][:3] == [
        (pytest.approx(at), parts) for at, parts in expected.items()
    ]
    assert 'By the rule "sprockets with a chain change"' in unescape(page)


def test_ten_years_end_a_plan_of_long_lives(lived):
    driver = lived.drive.driver
    inputs = {**driver.case.inputs, "service": {"hours_per_day": 1e-4 * lived.chain.hours}}
    others = [one for one in lived.drive.sprockets if one is not driver]
    slow = replace(driver, case=replace(driver.case, inputs=inputs))
    longer = replace(lived, drive=replace(lived.drive, sprockets=(slow, *others)))
    assert drive_plan(longer).until == pytest.approx(0.36525 * lived.chain.hours)
    assert drive_plan(longer).stops == ()
    assert "Nothing by then" in sheet_html(longer, HEAD)


def test_sprockets_of_the_drawing_lead_to_their_flanks(lived, page):
    links = re.findall(r'<a href="#(flank-\d)"><title>(.*?)</title>', page)
    assert [(place, unescape(title)) for place, title in links] == [
        ("flank-1", "flank of driver"),
        ("flank-2", "flank of roll <1>"),
    ]
    for number, (name, result) in enumerate(lived.results.items(), start=1):
        place = page.split(f'id="flank-{number}"')[1].split('<div class="flank"')[0]
        assert unescape(re.search(r"<h3>(.*?)</h3>", place)[1]) == name
        depth = result.flank_columns["depth_mm"].max()
        assert f"{depth:.3g} mm deep at most after {grouped(result.hours_run)} h" in place


def test_every_assumption_stands_once(lived, page):
    fine = unescape(page.split('<ol class="fine">')[1])
    for result in lived.results.values():
        for text in result.assumptions:
            assert fine.count(f"{text}</li>") == 1


@pytest.mark.wide
def test_the_command_writes_a_file_or_a_folder(cli, tmp_path):
    path = written(tmp_path / "loop.toml", LOOP)
    sheet = tmp_path / "sheets" / "loop.html"
    done = cli("report", path, "--out", sheet, "--project", "P & Q", "--author", "<me>")
    assert (done.code, done.out) == (0, f"{sheet}\n")
    page = sheet.read_text(encoding="utf-8")
    text = plain(page)
    found = pairs(text)
    assert (found["project"], found["author"]) == ("P & Q", "<me>")
    assert found["date"] in (str(date.today()), str(date.today() - timedelta(days=1)))
    assert "drawing" not in found
    assert "&gt; 2 h" in text and "no replacement is due within 2 h" in text
    rows = tables(text)["Lives"][1:]
    assert [row[0] for row in rows] == ["chain", "motor", "tensioner", "cassette 20T", "cassette 22T"]
    assert {row[1] for row in rows} == {"> 2 h"}
    assert found["take-up"].startswith("tensioner: ") and "travel -25 to 60 mm" in found["take-up"]
    assert 'href="#flank-3"><title>flank of cassette' in text

    done = cli("report", path, "--out", sheet)
    assert done.code == 2 and "--force" in done.err
    assert sheet.read_text(encoding="utf-8") == page
    done = cli("report", path, "--out", sheet, "--force", "--set", "title=Other")
    assert done.code == 0 and "<h1>Other</h1>" in sheet.read_text(encoding="utf-8")


def test_a_folder_holds_one_page(lived, tmp_path):
    out = tmp_path / "out"
    assert save_sheet(lived, HEAD, out, force=False) == out / "index.html"
    assert {path.name for path in out.iterdir()} == {".wearsim", "index.html"}
    assert (out / "index.html").read_text(encoding="utf-8") == sheet_html(lived, HEAD)


def test_what_does_not_fit_is_refused(cli, drive, tmp_path, bored):
    path, out = written(tmp_path / "two.toml", bored), tmp_path / "out"
    for option in (["--single-file"], ["--detail", "brief"]):
        done = cli("report", path, "--out", out, *option)
        assert done.code == 2 and "a drive with [[sprocket]] takes neither" in done.err
    done = cli("report", drive(), path, "--out", out)
    assert done.code == 2 and "a drive has a sheet of its own" in done.err
    done = cli("report", drive(), drive("b"), "--out", tmp_path / "two.pdf")
    assert done.code == 2 and "which holds one drive" in " ".join(done.err.split())
    done = cli("report", drive(), "--out", tmp_path / "one.pdf", "--single-file")
    assert done.code == 2 and "leave --single-file out" in done.err
    (tmp_path / "page.html").mkdir()
    done = cli("report", path, "--out", tmp_path / "page.html", "--force")
    assert done.code == 2 and "must be a file, but is a folder" in done.err
    done = cli("report", path, "--out", out, "--set", "sprocket.2.teeth=3")
    assert done.code == 2 and "sprocket.2.teeth" in done.err
    assert not out.exists()


@pytest.mark.parametrize(
    ("before", "after", "line", "message"),
    [
        ("bore_mm = 20", "bore_mm = 0", 8, "bore_mm"),
        ("bore_mm = 20\n", "", 8, "needs bore_mm"),
        ("keyway_width_mm = 6", "keyway_width_mm = 20", 9, "must be below the bore of 20 mm (got 20)"),
        ("hub_diameter_mm = 45", "hub_diameter_mm = 25", 10, "must stay inside the hub of 25 mm"),
        (
            "hub_diameter_mm = 45",
            "hub_diameter_mm = 61",
            11,
            "below the root diameter of the gaps, 60.521 mm",
        ),
        ("hub_diameter_mm = 45\n", "", 11, "needs hub_diameter_mm"),
        ("bore_mm = 25", "bore_mm = 73", 18, "below the root diameter of the gaps, 72.589 mm (got 73)"),
    ],
)
def test_bad_bores_are_named_with_their_line(cli, tmp_path, before, after, line, message, bored):
    path = written(tmp_path / "drive.toml", bored.replace(before, after, 1))
    done = cli("check", path)
    assert done.code == 2
    assert f"drive.toml:{line}: " in done.err
    assert message in done.err


def test_a_keyway_that_cuts_the_teeth_is_named(cli, tmp_path, bored):
    text = bored.replace("bore_mm = 25", "bore_mm = 70\nkeyway_width_mm = 10\nkeyway_depth_mm = 1.4")
    done = cli("check", written(tmp_path / "drive.toml", text))
    assert "sprocket.2.keyway_depth_mm: the corners of the keyway must stay" in done.err


def test_the_hub_of_a_cassette_fits_its_smallest_cog(cli, tmp_path):
    text = LOOP.replace('name = "cassette"', 'name = "cassette"\nhub_diameter_mm = 80.2\nhub_length_mm = 9')
    done = cli("check", written(tmp_path / "loop.toml", text))
    assert done.err.count("sprocket.3.hub_diameter_mm") == 1
    assert "below the root diameter of the gaps, 72.589 mm (got 80.2)" in done.err
