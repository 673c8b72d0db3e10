"""``wearsim maintain`` with readings: where the drive is, and what to do in the next twelve months."""

import csv
import json
import math

import pytest

DRIVE = """\
format_version = 1
title = "Test conveyor"
[chain]
designation = "08B-1"
[[sprocket]]
name = "small"
role = "driver"
teeth = 15
profile = "iso606"
nodes = 31
[[sprocket]]
name = "large"
teeth = 38
profile = "iso606"
nodes = 31
price = 25
[drive]
links = 100
[mechanism]
phases = 2
[run]
horizon_hours = 60000
life_tolerance = 0.1
[load]
power_kW = 1
speed_rpm = 300
[wear]
condition = "hardened, oiled"
[service]
hours_per_day = 16
[maintenance]
chain_price = 20
sprocket_price = 15
downtime_hours = 1
downtime_cost_per_hour = 30
"""
LOG = """\
date;quantity;value;links;error;sprocket
01.01.2025;new;;;;large
01.01.2026;new;;;;
28.11.2026;elongation_percent;1,5;;0,01;
"""


@pytest.fixture
def plan(cli, tmp_path):
    """Function that plans a year, as JSON or as text."""
    (tmp_path / "drive.toml").write_text(DRIVE, encoding="utf-8")

    def run(*options, log=LOG, as_json=True):
        (tmp_path / "log.csv").write_text(log, encoding="utf-8")
        shown = ["--json"] if as_json else []
        done = cli("maintain", tmp_path / "drive.toml", tmp_path / "log.csv", *options, *shown)
        if as_json and not done.code:
            return json.loads(done.out)
        return done

    return run


def test_days_parts_and_money(plan):
    """331 days for 1.5 % of 3 %: another 331 to the chain, then 20 + 30; large has run a year longer."""
    found = plan("--set", "maintenance.currency=EUR")
    replaced = [job for job in found["jobs"] if job["job"] == "replace"]
    assert [(job["date"], job["parts"], job["cost"]) for job in replaced] == [("2027-10-25", "chain", 50.0)]
    assert replaced[0]["date_low"] < "2027-10-25" < replaced[0]["date_high"]
    assert (found["cost"], found["currency"], found["from"]) == (50.0, "EUR", "2026-11-28")
    used = {part["part"]: part["used_hours"] for part in found["parts"]}
    assert used == {"chain": 331 * 16, "small": 331 * 16, "large": (331 + 365) * 16}
    kept = [job["parts"] for job in found["jobs"] if job["job"] == "keep"]
    assert sorted(kept) == ["large", "small"]


def test_text_and_folder_tell_the_same(plan, tmp_path):
    done = plan("--set", "maintenance.currency=EUR", "--out", tmp_path / "out", as_json=False)
    assert done.code == 0, done.err
    assert max(map(len, done.out.splitlines())) <= 100
    text = " ".join(done.out.split())
    assert "chain 1.5 % longer of 3 %, 50 % of its life used" in text
    assert "cost, EUR" in text
    assert "In total 50 EUR" in text
    with (tmp_path / "out" / "jobs.csv").open(newline="", encoding="utf-8") as file:
        assert [row["job"] for row in csv.DictReader(file)] == ["replace", "keep", "keep"]


def test_teeth_wear_as_the_chain_where_that_is_asked_for(plan):
    """The chain wears by the factor of its readings; teeth that follow it live by that factor less."""
    of_case, of_chain = plan(), plan("--teeth", "chain")
    lives = [{part["part"]: part["life_hours"] for part in one["parts"]} for one in (of_case, of_chain)]
    assert lives[0]["chain"] == pytest.approx(lives[1]["chain"], rel=1e-12)
    own = plan("--teeth", "chain", log=LOG.replace("1,5", "0,728422"))
    factor = 1.5 / 0.728422
    small = next(part["life_hours"] for part in own["parts"] if part["part"] == "small")
    assert lives[1]["small"] == pytest.approx(small / factor, rel=2e-3)
    assert "--teeth case" in of_case["assumptions"][0]


def test_teeth_left_to_a_case_that_the_chain_contradicts_are_warned_of(plan):
    """0.728422 % in 331 days are what the case says: 1.5 % in 39 days are 17.5 times as fast."""
    found = plan(log=LOG.replace("01.01.2026", "20.10.2026"))
    factor = 1.5 / (0.728422 * 39 / 331)
    (text,) = (text for text in found["warnings"] if "--teeth chain" in text)
    assert text.startswith(f"the chain wears {factor:.3g} times as fast as the case says")


def test_teeth_have_the_band_of_their_life(plan):
    """A third to 2.9 times the life, either way 1.8 times wider as the rate of joints is extrapolated."""
    small = next(part for part in plan()["parts"] if part["part"] == "small")
    for end, factor, sign in (("low", 1.5e-10 / 5e-11, -1.0), ("high", 5e-11 / 1.7e-11, 1.0)):
        life = small["life_hours"] * math.exp(sign * math.hypot(math.log(factor), math.log(1.8)))
        assert small[f"remaining_hours_{end}"] == pytest.approx(life - 331 * 16, rel=1e-3)


def test_relubrications_are_jobs(plan):
    log = LOG.replace("28.11.2026;", "01.07.2026;relubrication;;;;\n28.11.2026;")
    oiled = ("--set", "lubrication={lasts_hours = 5000, dry_factor = 2, price_per_application = 4}")
    found = plan(*oiled, log=log)
    first = next(job for job in found["jobs"] if job["job"] == "relubricate")
    # 181 days after the new chain, and so again.
    assert (first["date"], first["cost"]) == ("2026-12-29", 4.0)


def test_a_case_as_init_writes_it_knows_what_to_do_with_a_log(cli, plan, tmp_path):
    """Oil by hand, of which nobody said how long it lasts: 30 days after the last time, and so again."""
    rows = "date,quantity,value,error\n01.01.2026,new,,\n31.01.2026,relubrication,,\n"
    (tmp_path / "log.csv").write_text(rows + "10.02.2026,elongation_percent,0.1,0.01\n", encoding="utf-8")
    assert cli("init", "--lubrication", "manual", "--out", tmp_path / "new.toml").code == 0
    done = cli(
        "maintain", tmp_path / "new.toml", tmp_path / "log.csv", "--json", "--set", "sprocket.1.nodes=31"
    )
    assert done.code == 0, done.err
    found = json.loads(done.out)
    dates = [job["date"] for job in found["jobs"] if job["job"] == "relubricate"]
    assert dates[:2] == ["2026-03-02", "2026-04-01"]
    assert any("how long lubricant 'manual' lasts is not known" in text for text in found["warnings"])


def test_a_new_chain_is_not_relubricated_on_its_first_day(plan):
    """331 days to the limit, as many as from one relubrication to the next: one day for both."""
    log = LOG.replace("28.11.2026;elong", "28.11.2026;relubrication;;;;\n28.11.2026;elong")
    oiled = ("--set", "lubrication={lasts_hours = 9000, dry_factor = 2}")
    days = [(job["date"], job["job"]) for job in plan(*oiled, log=log)["jobs"] if job["job"] != "keep"]
    assert days == [("2027-10-25", "replace")]


HOURS = "time_hours,quantity,value\n500,elongation_percent,0.5\n"


@pytest.mark.parametrize(
    ("log", "message"),
    [
        (HOURS, "service.start_date: a plan by days needs it"),
        (HOURS.replace("0.5", "9"), "service.start_date: a plan by days needs it"),  # before it calculates
        (LOG.replace("large", "huge"), "must be one of small, large (got 'huge')"),
        (LOG.replace("0,01;", "0,01;large"), "must be new where a sprocket is named"),
    ],
)
def test_what_a_plan_needs_is_named(plan, log, message):
    done = plan(log=log, as_json=False)
    assert done.code == 2
    assert message in done.err


def test_relubrications_of_chains_in_rotation_are_jobs(plan):
    """Each after its first 100 days: the next one 100 days after 23 September, and again after 100 more."""
    log = (
        "date;quantity;value;error;chain\n01.01.2026;new;;;A\n11.04.2026;relubrication;;;\n"
        "15.06.2026;new;;;B\n23.09.2026;relubrication;;;B\n28.11.2026;elongation_percent;1;0,01;B\n"
    )
    oiled = ("--set", "lubrication={lasts_hours = 5000, dry_factor = 2, price_per_application = 4}")
    jobs = [job for job in plan(*oiled, log=log)["jobs"] if job["job"] == "relubricate"]
    assert [job["date"] for job in jobs[:2]] == ["2027-01-01", "2027-04-11"]
    unpriced = ("--set", oiled[1].replace(", price_per_application = 4", ""))
    text = " ".join(plan(*unpriced, log=log, as_json=False).out.split())
    assert ", and relubrications: lubrication.price_per_application is not known" in text


def test_chains_in_rotation_are_replaced_together(plan):
    """Two chains by turns for 165 and 166 days, 1.5 % each: both worn after as long again, for 2 times 20."""
    log = (
        "date;quantity;value;error;chain\n01.01.2026;new;;;A\n15.06.2026;elongation_percent;1,5;0,01;A\n"
        "15.06.2026;new;;;B\n28.11.2026;elongation_percent;1,5;0,01;B\n"
    )
    found = plan(log=log)
    (job,) = (job for job in found["jobs"] if job["job"] == "replace")
    assert (job["date"][:7], job["cost"]) == ("2027-10", 2 * 20 + 30)
    assert job["hours"] == pytest.approx(331 * 16, rel=0.02)
