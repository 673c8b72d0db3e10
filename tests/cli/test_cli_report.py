"""``wearsim report``: pages of cases and of runs."""

import json
import math
import re
from pathlib import Path

import pytest

import wearsim

HOSTILE = '<script>alert(1)</script> & \\"x\\"'

WRAP = """\
format_version = 1
title = "Wrapped"
[chain]
designation = "ANSI 40"
[sprocket]
teeth = 20
profile = "ansi_b29"
role = "driven"
nodes = 101
[mechanism]
kind = "wrap"
phases = 2
[drive]
mate_teeth = 17
links = 80
slack_tension_N = 50
[joint]
specific_wear_rate_mm2_per_N = 1e-9
[load]
tension_N = 1000
speed_rpm = 100
[wear]
specific_wear_rate_mm2_per_N = 1e-9
[run]
horizon_hours = 50
life_tolerance = 0.1
"""

GEARS = """\
format_version = 1
title = "Gears"
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

SECTIONS = (
    "answer",
    "drive",
    "flank",
    "margins",
    "run",
    "inputs",
    "assumptions",
    "warnings",
    "versions",
    "cite",
)


def text_of(page):
    return re.sub(r"\s+", " ", page.read_text(encoding="utf-8"))


def charts_of(page):
    found = re.search(r'id="charts">(.*?)</script>', page.read_text(encoding="utf-8"), re.DOTALL)
    return json.loads(found[1])


def test_page_of_a_case(cli, drive, tmp_path):
    out = tmp_path / "reports" / "page"
    done = cli("report", drive(), "--out", out)
    assert (done.code, done.out) == (0, f"{out / 'index.html'}\n")
    assert {path.name for path in out.iterdir()} == {".wearsim", "index.html", "plotly.min.js"}
    page = text_of(out / "index.html")
    shown = re.search(r"Life +([\d .]+ h)", cli("life", drive()).out)[1]
    assert f'<p class="life">{shown}</p>' in page
    assert '<p class="ending">until 0.02 mm is worn off</p>' in page
    assert [name for name in SECTIONS if f'<section id="{name}"' in page] == list(SECTIONS)
    assert set(charts_of(out / "index.html")) == {"tooth", "along", "history"}
    assert f"<dt>wearsim</dt><dd>{wearsim.__version__}</dd>" in page
    assert "The wearsim authors (" in page
    assert len(page) < 300_000


def test_inputs_tell_given_from_default(cli, drive, tmp_path):
    cli("report", drive(), "--out", tmp_path / "out")
    page = text_of(tmp_path / "out" / "index.html")

    def row(key):
        cells = re.search(rf"<code>{re.escape(key)}</code></th>(.*?)</tr>", page)[1]
        return re.findall(r"<td[^>]*>(.*?)</td>", cells)

    assert row("load.power_kW")[:2] == ["3 kW", "given"]
    assert row("stop.critical_depth_mm")[:2] == ["0.02 mm", "given"]
    assert row("sprocket.contact_end_mm")[1] == "default: 0.16 pitch"
    assert row("run.life_tolerance")[1] == "default"
    assert row("material.roller.poissons_ratio")[1] == "default: steel"
    assert row("sprocket.teeth")[2] == "number of teeth"
    for source in ("chain 16B-1", "wear condition &#39;hardened, oiled&#39;", "material steel"):
        assert f"<dt>{source}</dt><dd>" in page


@pytest.mark.wide
def test_runs_and_cases_side_by_side(cli, drive, tmp_path):
    run, out = tmp_path / "drive", tmp_path / "out"
    cli("life", drive(), "--out", run)
    other = drive("other", power_kW=6)
    done = cli("report", run, other, drive(), "--out", out)
    pages = ["index.html", "drive.html", "other.html", "drive-2.html"]
    assert (done.code, done.out.split()) == (0, [str(out / page) for page in pages])
    assert {path.name for path in out.iterdir()} == {".wearsim", *pages, "plotly.min.js"}
    page = text_of(out / "index.html")
    assert all(f'<a href="{name}">' in page for name in pages[1:])
    assert '<td role="cell" data-label="ratio to first">0.5</td>' in page
    assert set(charts_of(out / "index.html")) == {"lives", "along", "history"}
    assert '<a href="index.html">All drives</a>' in text_of(out / "other.html")


def test_brief_pages_are_short(cli, drive, tmp_path):
    out = tmp_path / "out"
    assert cli("report", drive(), "--out", out, "--detail", "brief").code == 0
    page = text_of(out / "index.html")
    brief = [name for name in SECTIONS if f'<section id="{name}"' in page]
    assert brief == ["answer", "flank", "margins", "assumptions", "warnings"]
    assert set(charts_of(out / "index.html")) == {"tooth"}
    assert cli("report", drive(), "--out", tmp_path / "x", "--detail", "long").code == 2


def test_a_single_file_holds_the_script(cli, drive, tmp_path):
    out = tmp_path / "out"
    assert cli("report", drive(), "--out", out, "--single-file").code == 0
    (page,) = out.glob("[!.]*")
    text = page.read_text(encoding="utf-8")
    assert 1_000_000 < len(text) < 6_000_000
    assert 'src="plotly' not in text
    markup = re.sub(r"<script.*?</script>", "", text, flags=re.DOTALL)
    assert not re.search(r'(?:src|href)="(?:https?:)?//', markup)


def test_a_file_of_one_case_is_the_page_itself(cli, drive, tmp_path):
    out = tmp_path / "sheet.html"
    assert cli("report", drive(), "--out", out).out == f"{out}\n"
    assert out.is_file()
    assert 'src="plotly' not in text_of(out)
    taken = cli("report", drive(), "--out", out)
    assert (taken.code, taken.out) == (2, "")
    assert cli("report", drive(), "--out", out, "--force").code == 0


@pytest.mark.parametrize("name", ["sheet.html", "sheet.pdf"])
def test_a_file_holds_one_drive(cli, drive, tmp_path, name):
    out = tmp_path / name
    done = cli("report", drive(), drive("other"), "--out", out)
    assert (done.code, out.exists()) == (2, False)
    assert f"{name} is a file, which holds one drive" in " ".join(done.err.split())


@pytest.mark.wide
def test_a_title_is_text(cli, drive, tmp_path):
    out = tmp_path / "out"
    cli("report", drive(title=f'"{HOSTILE}"'), drive("b", title=f'"{HOSTILE}"'), "--out", out)
    for page in out.glob("*.html"):
        text = page.read_text(encoding="utf-8")
        assert "<script>alert" not in text
        assert "&lt;script&gt;alert(1)&lt;/script&gt; &amp; &#34;x&#34;" in text
        nonces = re.findall(r"<script[^>]*>", text)
        assert len(nonces) == 3 and all('nonce="' in tag for tag in nonces)


@pytest.fixture
def wrapped(tmp_path):
    path = tmp_path / "wrapped.toml"
    path.write_text(WRAP)
    return path


def test_page_of_a_wrap_from_its_folder(cli, wrapped, tmp_path):
    """The bars are the forces that ``wearsim loads`` prints."""
    run, out = tmp_path / "run", tmp_path / "out"
    cli("life", wrapped, "--out", run)
    wrapped.unlink()
    assert cli("report", run, "--out", out).code == 0
    loads = charts_of(out / "index.html")["loads"]["data"][0]
    wrapped.write_text(WRAP)
    teeth = json.loads(cli("loads", wrapped, "--json").out)["teeth"]
    assert loads["x"] == [tooth["tooth"] for tooth in teeth]
    assert loads["y"] == pytest.approx([tooth["force_N"] for tooth in teeth], rel=1e-4)
    page = text_of(out / "index.html")
    assert "driver 17 teeth, driven 20 teeth" in page
    assert "the sprocket that wears, the driven one, right" in page
    assert "(limit not reached)" in page
    assert "elongation</th>" in page and "of the limits" in page


def test_page_of_gears(cli, tmp_path):
    path, out = tmp_path / "gears.toml", tmp_path / "out"
    path.write_text(GEARS)
    assert cli("report", path, "--out", out).code == 0
    assert set(charts_of(out / "index.html")) == {"pinion", "wheel", "along", "history"}
    page = text_of(out / "index.html")
    assert "centre distance 120.00 mm" in page  # 3 (19 + 61)/2
    assert "pitch circles 57.00 and 183.00 mm" in page
    assert "depth of the wheel, mm" in page


@pytest.mark.wide
def test_what_is_there_stays(cli, drive, tmp_path):
    out = tmp_path / "out"
    assert cli("report", drive(), drive("b"), "--out", out).code == 0
    done = cli("report", drive(), "--out", out)
    assert (done.code, done.out) == (2, "")
    assert "--force" in done.err
    assert cli("report", drive(), "--out", out, "--force").code == 0
    assert {path.name for path in out.iterdir()} == {".wearsim", "index.html", "plotly.min.js"}
    (out / "notes.html").write_text("<p>mine</p>")
    done = cli("report", drive(), "--out", out, "--force")
    assert done.code == 2
    assert "holds notes.html" in done.err
    assert (out / "notes.html").read_text() == "<p>mine</p>"


def test_settings_change_cases_only(cli, drive, tmp_path):
    out = tmp_path / "out"
    assert cli("report", drive(), "--out", out, "--set", "run.horizon_hours=50").code == 0
    assert "&gt;\u00a050\u00a0h" in (out / "index.html").read_text(encoding="utf-8")
    cli("life", drive(), "--out", tmp_path / "run")
    done = cli("report", tmp_path / "run", "--out", tmp_path / "x", "--set", "title=x")
    assert done.code == 2
    assert not (tmp_path / "x").exists()


def test_bad_input_writes_nothing(cli, drive, tmp_path):
    out = tmp_path / "out"
    (tmp_path / "empty").mkdir()
    for source in (drive("bad", teeth=3), tmp_path / "empty", tmp_path / "x.csv"):
        done = cli("report", drive(), source, "--out", out)
        assert (done.code, done.out) == (2, "")
        assert "Traceback" not in done.err
        assert not out.exists()
    assert cli("report", drive()).code == 2


def test_missing_libraries_are_named_before_a_run(cli, drive, tmp_path, monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    done = cli("report", drive(), "--out", tmp_path / "out")
    assert done.code == 2
    assert "pip install 'wearsim[report]'" in done.err
    assert not (tmp_path / "out").exists()


def test_a_case_that_fails_is_left_out(cli, drive, tmp_path, monkeypatch):
    from wearsim.drive.part_life import simulate
    from wearsim.errors import ConvergenceError

    def failing(case, told):
        if case.name == "worse":
            raise ConvergenceError("the life would be wrong")
        return simulate(case, told)

    monkeypatch.setattr("wearsim.drive.simulate.simulate_single", failing)
    out = tmp_path / "out"
    done = cli("report", drive(), drive("worse"), "--out", out)
    assert done.code == 5
    assert "the life would be wrong" in done.err
    assert {path.name for path in out.iterdir()} == {".wearsim", "index.html", "plotly.min.js"}


def test_page_of_a_table_of_loads(cli, tmp_path):
    """Where loads come from a table no life is known of a drive, and nothing is drawn of it."""
    case = Path(__file__).parents[2] / "cases" / "hertz-arc-prescribed.toml"
    out = tmp_path / "out"
    assert cli("report", case, "--out", out).code == 0
    assert set(charts_of(out / "index.html")) == {"tooth", "along", "history"}
    page = text_of(out / "index.html")
    assert '<section id="drive"' not in page
    assert "<dt>file hertz-arc-prescribed.csv</dt>" in page


@pytest.mark.wide
def test_percentiles_that_follow_from_a_run(cli, drive, tmp_path):
    path = drive()
    key = '"wear.specific_wear_rate_mm2_per_N"'
    table = f'[uncertainty]\n{key} = {{distribution = "lognormal", sigma_ln = 0.5}}\n'
    path.write_text(path.read_text() + table)
    hours = json.loads(cli("life", path, "--json").out)["life_hours"]
    cli("report", path, "--out", tmp_path / "out")
    page = text_of(tmp_path / "out" / "index.html")
    for name, factor in (("P10", math.exp(-0.64077578)), ("P50", 1.0), ("P90", math.exp(0.64077578))):
        (shown,) = re.findall(rf"<dt>{name}: .*?</dt><dd>(.*?)</dd>", page)
        assert float(re.sub(r"[^\d.]", "", shown)) == pytest.approx(hours * factor, rel=1e-3)
    path.write_text(path.read_text() + '"load.power_kW" = {distribution = "lognormal", sigma_ln = 0.1}\n')
    cli("report", path, "--out", tmp_path / "two")
    assert "P10" not in text_of(tmp_path / "two" / "index.html")


def test_page_of_a_wrap_begins_with_its_inputs(cli, wrapped, tmp_path):
    """1000 N of tension less 50 N of slack is the pull; the head says who checked it."""
    out = tmp_path / "out"
    done = cli("report", wrapped, "--out", out, "--revision", "B", "--checked-by", "C. Hecker")
    assert done.code == 0
    page = text_of(out / "index.html")
    for label, text in (
        ("revision", "B"),
        ("checked by", "C. Hecker"),
        ("load as given", "1000 N of tension at 100 rpm"),
        ("chain pull", "950 N"),
        ("sprockets", "17 and 20 teeth, ratio 1.176"),
    ):
        assert f"<dt>{label}</dt><dd>{text}</dd>" in page.replace("\u00a0", " ")
    assert page.index('id="given"') < page.index('id="verification"') < page.index('<p class="life">')
    assert "| revision B | " in page and "counter(pages)" in page
