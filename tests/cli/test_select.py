"""``wearsim select``: what each option does, what is refused, and the case that it writes."""

import csv
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from wearsim.drive.load_case import load_drive
from wearsim.drive.wrap_life import chain_band, chain_clock, chain_practice

pytestmark = pytest.mark.wide

NEED = ("--power", "3 kW", "--rpm", 120, "--ratio", 2.7, "--hours", 15000)


@pytest.fixture
def prices(tmp_path):
    path = tmp_path / "prices.csv"
    path.write_text("designation,price_per_m,sprocket_price_per_kg\n16B,90,8\n# no\nANSI 50-3,30,8\n")
    return path


def selected(cli, *options):
    done = cli("select", *NEED, *options, "--json")
    assert done.code == 0, done.err
    return json.loads(done.out)


def test_installed_command():
    wearsim_command = Path(sys.executable).with_name("wearsim")
    words = [str(word) for word in NEED]
    done = subprocess.run([wearsim_command, "select", *words], capture_output=True, text=True, timeout=120)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith(
        "3 kW at 120 rpm, ratio 2.7, 15 000 h (drip, clean, smooth load, 8 h a day)\n"
    )
    for label in ("Ranked by  mass: ", "Passed ", "Refused ", "Left out ", "Assumes "):
        assert f"\n  {label}" in done.stdout


def test_rows_of_text_json_and_csv_agree(cli, tmp_path):
    found = selected(cli, "--csv", tmp_path / "table.csv")
    with (tmp_path / "table.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["designation"] for row in rows] == [drive["designation"] for drive in found["drives"]]
    assert list(rows[0]) == list(found["drives"][0])
    for row, drive in zip(rows, found["drives"], strict=True):
        assert float(row["chain_life_hours"]) == drive["chain_life_hours"]
    lines = cli("select", *NEED).out.splitlines()[2:12]
    assert [line.split()[0] for line in lines] == [drive["designation"] for drive in found["drives"]]
    for drive in found["drives"]:
        assert drive["chain_life_hours_low"] < drive["chain_life_hours"] < drive["chain_life_hours_high"]
        assert drive["chain_life_hours"] >= 15000
        assert drive["rating_margin_percent"] >= 0.0
    assert found["schema_version"] == 1
    assert (found["criterion"], found["nearest_miss"]) == ("mass", None)


@pytest.mark.slow
@pytest.mark.parametrize(
    "option",
    [
        ("--power", "9 hp"),
        ("--rpm", "200"),
        ("--ratio", "2.2"),
        ("--hours", "100000"),
        ("--centre", "700"),
        ("--centre-min", "1200"),
        ("--centre-max", "600"),
        ("--max-diameter", "250"),
        ("--lubrication", "manual"),
        ("--environment", "dust"),
        ("--shock", "heavy"),
        ("--hours-per-day", "24"),
        ("--series", "B"),
        ("--strands", "2-3"),
        ("--strands", "1"),
        ("--ratio-tolerance", "0.5 %"),
        ("--teeth-min", "19"),
        ("--teeth-max", "20"),
        ("--every-pair",),
        ("--count", "3"),
    ],
    ids=" ".join,
)
def test_every_option_changes_the_answer(cli, option):
    plain, changed = selected(cli), selected(cli, *option)
    assert [plain["drives"], plain["assumptions"]] != [changed["drives"], changed["assumptions"]]


def test_options_hold(cli):
    assert all(len(selected(cli, "--count", n)["drives"]) == n for n in (1, 4))
    for drive in selected(cli, "--strands", "2")["drives"]:
        assert drive["strands"] == 2
    for drive in selected(cli, "--max-diameter", "10 inch")["drives"]:
        assert drive["largest_tip_diameter_mm"] <= 254.0
    for drive in selected(cli, "--centre-min", "600", "--centre-max", "0.65 m")["drives"]:
        assert 600.0 <= drive["centre_distance_mm"] <= 650.0
    for drive in selected(cli, "--ratio-tolerance", "0.5")["drives"]:
        assert drive["gear_ratio"] == pytest.approx(2.7, rel=0.005)
    for drive in selected(cli, "--teeth-min", "20", "--teeth-max", "21", "--every-pair")["drives"]:
        assert 20 <= drive["driver_teeth"] <= 21
    every = selected(cli, "--every-pair", "--count", "20")["drives"]
    assert len({drive["designation"] for drive in every}) < len(every)


def test_prices_rank_and_name_the_criterion(cli, prices):
    found = selected(cli, "--price", prices)
    assert found["criterion"] == "cost"
    assert [drive["designation"] for drive in found["drives"]] == ["10A-3", "16B-1"]
    costs = [drive["drive_cost"] for drive in found["drives"]]
    assert costs == sorted(costs)
    text = cli("select", *NEED, "--price", prices).out
    assert "Ranked by  cost: " in text
    assert " cost " in text.splitlines()[1]


def test_every_fault_is_named_in_one_pass(cli, tmp_path):
    bad = tmp_path / "prices.csv"
    bad.write_text("designation,price_per_m,sprocket_price_per_kg\n8B,1,1\n16B,-2,x\n16B,1,1\n16B-1,1,1\n")
    done = cli(
        *("select", "--power", "3 apples", "--rpm", "-1", "--hours", "0", "--lubrication", "drop"),
        *("--shock", "calm", "--series", "A,C", "--strands", "2-9", "--teeth-min", "17.5"),
        *("--hours-per-day", "25", "--ratio-tolerance", "x", "--price", bad),
    )
    assert done.code == 2
    lines = done.err.splitlines()
    for start, message in (
        ("--power: ", "unknown unit 'apples'"),
        ("--rpm: ", "must be at least 0.001"),
        ("--ratio: ", "must be given"),
        ("--hours: ", "must be above 0"),
        ("--lubrication: ", "did you mean 'drip'"),
        ("--shock: ", "must be one of smooth, moderate, heavy"),
        ("--hours-per-day: ", "at most 24 (got 25)"),
        ("--series: ", "(got 'C')"),
        ("--strands: ", "at most 6 (got 9)"),
        ("--teeth-min: ", "must be a whole number (got 17.5)"),
        ("--ratio-tolerance: ", "must be a number"),
        (f"--price {bad}:2: ", "did you mean '08B'"),
        (f"--price {bad}:3: ", "price_per_m must be a number from 0"),
        (f"--price {bad}:3: ", "sprocket_price_per_kg must be a number"),
        (f"--price {bad}:5: ", "16B-1 again"),
    ):
        assert any(line.startswith(start) and message in line for line in lines), (start, done.err)
    assert "Traceback" not in done.err


def test_fault_as_json(cli):
    done = cli("select", *NEED, "--shock", "calm", "--json")
    assert done.code == 2
    found = json.loads(done.out)
    assert (found["case"], found["error"]["kind"]) == ("select", "CaseError")
    assert found["error"]["message"].startswith("--shock: must be one of")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--ratio", "9"), "--ratio: must be that of 17 to 25 teeth"),
        (("--power", "3 kW*9**9**9**9"), "--power: unknown unit 'kW*9**9**9**9'"),
        (("--teeth-min", "30"), "--teeth-max: must be at least teeth_min"),
        (("--centre", "500", "--centre-max", "600"), "--centre-max: must be left out"),
        (("--strands", "a"), "--strands: must be a whole number or two"),
        (("--price", "nowhere.csv"), "must be a readable CSV file (No such file"),
        (("--count", "0"), "--count"),
        (("--out", "-", "--json"), "both write to stdout"),
        (("--out", "x", "--csv", "x"), "must not be the file of --csv"),
    ],
)
def test_what_is_refused(cli, options, message):
    done = cli("select", *NEED, *options)
    assert done.code == 2
    assert message in done.err


@pytest.mark.parametrize("text", ["", "designation\n", "designation,price_per_m,sprocket_price_per_kg\n"])
def test_price_files_without_prices(cli, tmp_path, text):
    path = tmp_path / "p.csv"
    path.write_text(text)
    done = cli("select", *NEED, "--price", path)
    assert done.code == 2
    assert done.err.startswith(f"--price {path}")


def test_what_exists_is_refused_unless_forced(cli, tmp_path):
    out = tmp_path / "best.toml"
    out.write_text("mine")
    assert cli("select", *NEED, "--out", out).code == 2
    assert out.read_text() == "mine"
    assert cli("select", *NEED, "--out", out, "--force").code == 0
    assert out.read_text().startswith("# Chosen by wearsim select --power '3 kW'")


@pytest.mark.parametrize(
    "options",
    [
        (),
        ("--series", "B", "--strands", "2", "--shock", "moderate"),
        ("--series", "GOST", "--strands", "3", "--hours-per-day", "16"),
        ("--lubrication", "greased", "--series", "A"),
        ("--lubrication", "manual", "--environment", "dust", "--hours", "4000"),
        ("--environment", "wet", "--tooth-hardness", "normalised", "--hours", "900"),
        ("--ratio", "0.4"),
        ("--ratio", "4.6", "--teeth-min", "17"),
    ],
    ids=" ".join,
)
def test_case_is_complete_and_has_the_same_life(cli, tmp_path, options):
    """The chain of the case grows as fast as the table says, by the same band, without a run."""
    out = tmp_path / "best.toml"
    found = selected(cli, *options, "--out", out)
    assert cli("check", out).code == 0
    drive = load_drive(out)
    best = found["drives"][0]
    driver = drive.driver.case
    cycles = driver.drive.contact(driver).cycles_per_mate
    [run] = chain_clock(driver).running_cycles(np.array([cycles]))
    assert run / driver.cycles_per_hour == pytest.approx(best["chain_life_hours"], rel=5e-5)
    band = chain_band(driver)
    for end, rate in (("low", band.high), ("high", band.low)):
        assert best["chain_life_hours"] / rate == pytest.approx(best[f"chain_life_hours_{end}"], rel=1e-9)
    layout = driver.drive.layout
    assert (layout.teeth_1, layout.teeth_2, layout.links) == (
        best["driver_teeth"],
        best["driven_teeth"],
        best["links"],
    )
    tips = [one.case.inputs["sprocket"]["tip_diameter_mm"] for one in drive.sprockets]
    assert max(tips) == pytest.approx(best["largest_tip_diameter_mm"], rel=1e-9)
    ratings = {one.name: one for one in driver.drive.ratings(driver)}
    most = ratings[best["most_used_rating"]]
    assert 100 * (1 - most.used) == pytest.approx(best["rating_margin_percent"], abs=1e-6)


FAST = ("select", "--power", 18.5, "--rpm", 1450, "--ratio", 3, "--hours", 15000)


def test_lubrication_is_held_against_pitch_and_speed(cli, tmp_path):
    """7.8 m/s of 3/4 inch: a bath is recommended, drip is given, 0.4 times the life."""
    out = tmp_path / "best.toml"
    found = json.loads(cli(*FAST, "--json", "--out", out).out)
    assert "lubrication" in found["refused"]
    for drive in found["drives"]:
        assert drive["recommended_lubrication"] == "oil bath"
        assert drive["lubricated_life_hours"] == pytest.approx(0.4 * drive["chain_life_hours"])
        assert drive["lubricated_life_hours"] >= 15000
    driver = load_drive(out).driver.case
    assert "'drip', where 'oil bath' is recommended" in chain_practice(driver).warnings[0]
    text = cli(*FAST, "--explain").out
    assert "below oil bath: " in text
    assert " lubrication 'drip': " in " ".join(text.split())
    assert "below" not in cli(*FAST, "--lubrication", "oil-bath").out


def test_files_on_stdout(cli):
    case = cli("select", *NEED, "--out", "-")
    assert case.out.startswith("# Chosen by wearsim select")
    assert "Ranked by" in case.err
    table = cli("select", *NEED, "--csv", "-")
    assert table.out.startswith("designation,strands,")
    assert len(table.out.splitlines()) == 11


def test_nothing_passes(cli, tmp_path):
    """400 kW at 3000 rpm: no chain; said by what, and which comes nearest."""
    out = tmp_path / "none.toml"
    hard = ("select", "--power", 400, "--rpm", 3000, "--ratio", 2, "--hours", 10000)
    done = cli(*hard, "--out", out)
    assert done.code == 3
    assert "Passed     none of " in done.out
    assert "Nearest " in done.out
    assert " is beyond " in done.out
    assert " by roller impact" in done.out
    assert "no drive meets all limits" in done.err
    assert not out.exists()
    done = cli(*hard, "--json")
    found = json.loads(done.out)
    assert (done.code, found["drives"], found["passed"]) == (3, [], 0)
    assert found["refused"]["roller impact"] > 0
    assert all(used > 1.0 for used in found["nearest_miss"]["used"].values())


def test_no_chain_is_left(cli, tmp_path):
    """The only chain with a price has a doubtful pin."""
    prices = tmp_path / "prices.csv"
    prices.write_text("designation,price_per_m,sprocket_price_per_kg\n48B-1,300,9\n", "utf-8")
    done = cli("select", *NEED, "--price", prices)
    assert done.code == 3
    assert "no chain of these series" in done.out


def test_heavy_chains_are_considered(cli):
    found = json.loads(cli("select", *NEED, "--series", "H", "--json").out)
    assert {one["designation"][-3:-1] for one in found["drives"]} == {"H-"}


def test_verified_lives_are_those_of_the_whole_drive(cli, tmp_path):
    """So dry a drive that its chain ends within twice the hours."""
    need = ("select", "--power", 0.3, "--rpm", 100, "--ratio", 1, "--hours", 1200, "--lubrication", "dry")
    options = ("--series", "B", "--strands", 1, "--teeth-max", 17, "--verify", 1, "--count", 2)
    done = cli(*need, *options, "--json")
    assert done.code == 0, done.err
    found = json.loads(done.out)
    (verified,) = found["verified"]
    parts = {part["name"]: part for part in verified["parts"]}
    assert list(parts) == ["chain", "driver", "driven"]
    assert parts["chain"]["life_hours"] == pytest.approx(found["drives"][0]["chain_life_hours"], rel=1e-9)
    assert verified["long_enough"] is True
    text = cli(*need, *options).out
    assert "\n  Verified " in text


def test_verified_drive_that_does_not_last(cli):
    """Its chain lasts the hours, its normalised teeth do not: no answer to build by."""
    need = ("select", "--power", 0.2, "--rpm", 100, "--ratio", 1, "--hours", 3000, "--lubrication", "dry")
    teeth = ("--tooth-hardness", "normalised", "--teeth-min", 17, "--teeth-max", 17)
    options = ("--series", "B", "--strands", 1, "--count", 1, "--centre", 1300)
    assert cli(*need, *teeth, *options).code == 0
    done = cli(*need, *teeth, *options, "--verify", 1)
    assert done.code == 3
    assert "NOT LONG ENOUGH" in done.out
    assert "select: not long enough, or not worn: 084, 17 to 17 teeth" in done.err


def test_completion_offers_words():
    from click.shell_completion import ShellComplete

    from wearsim.cli.main import wearsim_command

    complete = ShellComplete(wearsim_command, {}, "wearsim", "_WEARSIM_COMPLETE")
    for option, typed, words in (
        ("--lubrication", "d", ["drip", "dry"]),
        ("--shock", "h", ["heavy"]),
        ("--series", "G", ["GOST"]),
    ):
        offered = complete.get_completions(["select", option], typed)
        assert [item.value for item in offered] == words
