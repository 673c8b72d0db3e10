"""``wearsim maintain`` of a whole drive: when to replace which part, and what that costs."""

import csv
import json
import math
from types import SimpleNamespace

import pytest

from wearsim.drive.load_case import load_drive
from wearsim.drive.maintenance import part_lives
from wearsim.drive.replacement_rules import Prices, cheapest, replacement_rules
from wearsim.quantities import grouped
from wearsim.report.drive.plan_words import ordinal, rule_text
from wearsim.result import Life, LowerBound

PRICES_OF_PARTS = """
[maintenance]
chain_price = 40
sprocket_price = 100
downtime_hours = 2
downtime_cost_per_hour = 30
"""


COGS = """
    {teeth = 13, share_of_time = 0.25},
    {teeth = 15, share_of_time = 0.25},
    {teeth = 17, share_of_time = 0.25},
    {teeth = 19, share_of_time = 0.25},
"""

WORN_FAST = "wear.specific_wear_rate_mm2_per_N=4e-9"

LIVES = {"driver": 2500.0, "roll": 10_000.0}
PRICES = Prices(chain=40.0, sprockets={"driver": 100.0, "roll": 200.0}, stop=60.0)
"""A chain lives 1000 h; a stop takes 2 h of 30."""


def per_1000_h(rule):
    """Parts, stops and cost of a rule in 1000 h."""
    parts = {name: 1000.0 / hours for name, hours in rule.every.items()}
    return parts, 1000.0 * rule.stop_rate, 1000.0 * rule.cost


def test_all_numbers_by_hand():
    """In 10 000 h: 10 chains; 4 drivers at their ends, 2500, 5000, 7500 and 10 000 h; 1 roll."""
    own, with_chain, every, every_2 = replacement_rules(1000.0, LIVES, PRICES)
    # 2500 h and 7500 h are stops of their own beside those of 10 chains; 400 + 400 + 200 + 12*60 = 1720.
    assert per_1000_h(own) == ({"chain": 1.0, "driver": 0.4, "roll": 0.1}, 1.2, pytest.approx(172.0))
    # The driver goes with every second chain, the roll with the tenth: 400 + 500 + 200 + 10*60 = 1700.
    assert per_1000_h(with_chain) == ({"chain": 1.0, "driver": 0.5, "roll": 0.1}, 1.0, pytest.approx(170.0))
    # 40 + 100 + 200 + 60; and 80 + 100 + 200 + 120 in 2000 h. A third chain would outlive the driver.
    assert per_1000_h(every) == ({"chain": 1.0, "driver": 1.0, "roll": 1.0}, 1.0, pytest.approx(400.0))
    assert per_1000_h(every_2) == ({"chain": 1.0, "driver": 0.5, "roll": 0.5}, 1.0, pytest.approx(250.0))
    assert cheapest([own, with_chain, every, every_2]) == (1, True)


def test_schedules_by_hand():
    own, with_chain, _, every_2 = (
        [(stop.hours, *stop.parts) for stop in rule.schedule] for rule in replacement_rules(1000.0, LIVES)
    )
    assert own[:6] == [
        (1000.0, "chain"),
        (2000.0, "chain"),
        (2500.0, "driver"),
        (3000.0, "chain"),
        (4000.0, "chain"),
        (5000.0, "chain", "driver"),
    ]
    assert own[11] == (10_000.0, "chain", "driver", "roll")
    assert with_chain[:2] == [(1000.0, "chain"), (2000.0, "chain", "driver")]
    assert with_chain[9] == (10_000.0, "chain", "driver", "roll")
    assert every_2[:2] == [(1000.0, "chain"), (2000.0, "chain", "driver", "roll")]


def test_cheap_stops_favour_each_part_at_its_end():
    """With stops of 10: 400 + 400 + 200 + 120 = 1120 against 400 + 500 + 200 + 100 = 1200."""
    rules = replacement_rules(1000.0, LIVES, Prices(40.0, PRICES.sprockets, 10.0))
    assert [1000.0 * rule.cost for rule in rules[:2]] == pytest.approx([112.0, 120.0])
    assert cheapest(rules) == (0, True)


def test_without_prices_there_are_counts_only():
    rules = replacement_rules(1000.0, LIVES)
    assert [rule.cost for rule in rules] == [None] * 4
    assert cheapest(rules) is None


def test_a_sprocket_that_does_not_outlive_a_chain():
    """400 h and 700 h: a stop every 400 h, the chain in every second one."""
    lives = {"driver": 400.0, "roll": 700.0}
    own, fewest, together, cheap = replacement_rules(1000.0, lives, PRICES)
    # In 14 000 h 14 + 35 + 20 ends, less those that two parts share, each 2800 h, 2000 h and 7000 h; at
    # 14 000 h three are taken off of the three that fall together, one of them is a stop.
    assert 14_000.0 * own.stop_rate == pytest.approx(14 + 35 + 20 - 5 - 7 - 2 + 1)
    assert per_1000_h(fewest) == ({"chain": 1.25, "driver": 2.5, "roll": 2.5}, 2.5, pytest.approx(950.0))
    assert [(stop.hours, *stop.parts) for stop in fewest.schedule[:3]] == [
        (400.0, "driver", "roll"),
        (800.0, "chain", "driver", "roll"),
        (1200.0, "driver", "roll"),
    ]
    # All with the first sprocket: 2.5 times in 1000 h.
    assert per_1000_h(together) == (
        {"chain": 2.5, "driver": 2.5, "roll": 2.5},
        2.5,
        pytest.approx(2.5 * (40.0 + 100.0 + 200.0 + 60.0)),
    )
    # In 2800 h 8 stops with 3 chains, 8 drivers and 4 rolls: 120 + 800 + 800 + 480 = 2200.
    assert 2.8 * 1000.0 * cheap.cost == pytest.approx(2200.0)
    assert cheapest([own, fewest, together, cheap]) == (3, True)
    assert rule_text(cheap) == (
        "8 stops every 2 800 h: chain at the 3rd, 5th and 8th, driver at each, "
        "roll at the 2nd, 4th, 6th and 8th"
    )


def test_the_chain_at_a_stop_is_counted():
    """3rd, 5th and 8th of 8 stops in 2800 h: 1200 h, 2000 h and 2800 h."""
    rule = replacement_rules(1000.0, {"driver": 400.0, "roll": 700.0}, PRICES)[-1]
    chains = {stop.hours: rule.chain_at(stop.hours) for stop in rule.schedule if "chain" in stop.parts}
    assert list(chains.values()) == [1, 2, 3, 4, 5, 6, 7, 8, 9]
    assert rule.chain_at(2800.0 * 100) == 300
    assert not any(rule.chain_at(stop.hours) for stop in rule.schedule if "chain" not in stop.parts)
    own = replacement_rules(1000.0, {"driver": 400.0})[0]
    assert [own.chain_at(hours) for hours in (400.0, 1000.0, 7000.0)] == [0, 1, 7]


def test_a_plan_in_words():
    own, few, *_ = replacement_rules(1000.0, {"driver": 900.0, "roll": 36_100.0}, None, frozenset({"roll"}))
    assert rule_text(own) == "chain every 1 000 h, driver every 900 h, roll not before 36 100 h"
    assert rule_text(few) == "chain and driver every 900 h, roll at the 40th chain change or later"
    few = replacement_rules(1000.0, {"driver": 900.0, "roll": 1900.0})[1]
    assert rule_text(few) == "chain and driver every 900 h, roll at every 2nd chain change"
    few = replacement_rules(1000.0, {"driver": 450.0, "roll": 1900.0})[1]
    assert (few.name, rule_text(few)) == (
        "fewest stops",
        "driver every 450 h, chain at every 2nd stop, roll at every 4th stop",
    )


def test_lives_that_never_meet_share_no_stop():
    life = 1000.0 * math.pi
    (own, *_) = replacement_rules(1000.0, {"driver": life, "roll": life})
    assert own.stop_rate == pytest.approx(1.0 / 1000.0 + 1.0 / life, rel=1e-12)


def test_a_part_that_outlived_its_run_is_a_bound():
    """The roll lives 10 000 h at least: all it costs is at most that, and nothing if it lives for ever."""
    own, with_chain, *together = replacement_rules(1000.0, LIVES, PRICES, frozenset({"roll"}))
    assert (own.at_most, own.stops_at_most) == ({"roll"}, True)
    assert (with_chain.at_most, with_chain.stops_at_most) == ({"roll"}, False)
    assert 1000.0 * own.cost == pytest.approx(172.0)
    # 10 chains, 4 drivers, and 12 stops, of which those at 5000 h and 10 000 h are chain changes too.
    assert 1000.0 * own.least_cost == pytest.approx(40.0 + 40.0 + 72.0)
    assert 1000.0 * with_chain.least_cost == pytest.approx(40.0 + 50.0 + 60.0)
    # After 10 000 h nobody knows when the roll is due.
    assert [rule.schedule[-1].hours for rule in (own, with_chain)] == [10_000.0, 10_000.0]
    assert all("roll" not in stop.parts for rule in (own, with_chain) for stop in rule.schedule)
    # With every second chain the roll goes early: that is a number, not a bound.
    assert [(rule.at_most, rule.cost == rule.least_cost) for rule in together] == [(frozenset(), True)] * 2
    assert cheapest([own, with_chain, *together]) == (1, False)


def test_what_a_bound_would_cost_chooses_no_rule():
    """800 h and 1300 h beside a chain of 1000 h at least.

    Without the chain 5 drivers, 3 rolls and 7 stops in 3900 h cost 500 + 600 + 420, 389.7 in 1000 h.
    """
    rules = replacement_rules(1000.0, {"driver": 800.0, "roll": 1300.0}, PRICES, frozenset({"chain"}))
    assert 1000.0 * rules[-1].least_cost == pytest.approx(1520.0 / 3.9)
    assert rules[-1].cost > rules[0].cost
    assert cheapest(rules) == (len(rules) - 1, False)


def test_of_one_sprocket_that_wears_out_alone_there_is_one_rule():
    rules = replacement_rules(1000.0, {"roll": 400.0}, Prices(40.0, {"roll": 100.0}), frozenset({"chain"}))
    assert [rule.name for rule in rules] == ["each part at its own end"]
    assert cheapest(rules) is None


@pytest.fixture
def drive(tmp_path, two_sprockets):
    path = tmp_path / "drive.toml"
    path.write_text(two_sprockets.replace("= 5e-9", "= 8e-9") + PRICES_OF_PARTS)
    return path


@pytest.fixture
def four_cogs(tmp_path, cassette):
    path = tmp_path / "cassette.toml"
    two = "{teeth = 13, share_of_time = 0.25}, {teeth = 17, share_of_time = 0.75}"
    assert two in cassette
    path.write_text(cassette.replace(two, COGS))
    return path


def test_text_json_and_files_agree(cli, drive, tmp_path):
    done = cli("maintain", drive, "--json", "--out", tmp_path / "plan")
    assert done.code == 0, done.err
    found = json.loads(done.out)
    lives = {one["part"]: one["life_hours"] for one in found["parts"]}
    assert list(lives) == ["chain", "driver", "roll"]
    own = found["policies"][0]
    assert own["policy"] == "each part at its own end"
    stops = sum(1000.0 / life for life in lives.values())
    assert own["stops_per_1000_h"] == pytest.approx(stops)
    price = 40.0 / lives["chain"] + 100.0 / lives["driver"] + 100.0 / lives["roll"]
    assert own["cost_per_1000_h"] == pytest.approx(1000.0 * price + 60.0 * stops)
    costs = [one["cost_per_1000_h"] for one in found["policies"]]
    assert costs[found["cheapest"]] == min(costs)
    assert found["cheapest_is_certain"] is True
    first = own["schedule"][0]
    assert first["hours"] == min(lives.values())
    # 16 h a day from 4 January 2027 on.
    assert first["days"] == pytest.approx(first["hours"] / 16.0)
    assert first["date"] > "2027-01-04"

    def read(name):
        with (tmp_path / "plan" / name).open() as file:
            return list(csv.DictReader(file))

    assert [float(row["cost_per_1000_h"]) for row in read("policies.csv")] == costs
    assert [row["part"] for row in read("parts.csv")][:3] == ["chain", "driver", "roll"]
    assert read("schedule.csv")[0]["parts"] == ", ".join(first["parts"])
    assert cli("maintain", drive, "--out", tmp_path / "plan").code == 2

    text = cli("maintain", drive).out
    lines = text.splitlines()
    assert lines[0] == "08B-1, 17 to 20 teeth"
    assert lines[1].startswith("  Lives      chain ")
    assert lines[2].split() == ["in", "1000", "h", "stops", "chain", "driver", "roll", "cost"]
    assert "  Cheapest   " in text
    assert first["date"] in text or found["cheapest"] != 0
    assert max(map(len, lines)) <= 100


@pytest.mark.wide
def test_the_answer_names_the_stops_of_the_cheapest_policy(cli, drive):
    dear = ("--set", "maintenance.downtime_cost_per_hour=300")
    found = json.loads(cli("maintain", drive, "--json", *dear).out)
    policy = found["policies"][found["cheapest"]]
    text = " ".join(cli("life", drive, *dear).out.split())
    first = text.split(" First ")[1].split(" Band ")[0]
    for part in ("chain", "driver", "roll"):
        stop = next(stop for stop in policy["schedule"] if part in stop["parts"])
        assert f"{grouped(stop['hours'])} h" in first
    assert policy["schedule"][0]["parts"] == ["chain", "driver", "roll"]
    assert first.startswith("replace chain, driver and roll at ")
    # Free stops and dear sprockets: each part at its own end.
    free = ("--set", "maintenance.downtime_hours=0.001", "--set", "maintenance.sprocket_price=5000")
    text = " ".join(cli("life", drive, *free).out.split())
    lives = {one["part"]: one["life_hours"] for one in found["parts"]}
    assert f" Then driver at {grouped(lives['driver'])} h" in text


SHORTER = """
format_version = 1
[chain]
designation = "08B-1"
[joint]
specific_wear_rate_mm2_per_N = 1.2e-10
[[sprocket]]
name = "small"
role = "driver"
teeth = 15
profile = "iso606"
nodes = 41
wear = {specific_wear_rate_mm2_per_N = 1.15e-10}
[[sprocket]]
name = "large"
teeth = 23
profile = "iso606"
nodes = 41
[drive]
links = 100
[mechanism]
phases = 2
[run]
life_tolerance = 0.1
[load]
power_kW = 1
speed_rpm = 300
[wear]
condition = "hardened, oiled"
"""


@pytest.mark.wide
def test_a_sprocket_a_little_shorter_lived_than_the_chain_takes_it_along(cli, tmp_path):
    path = tmp_path / "drive.toml"
    path.write_text(SHORTER)
    prices = "{chain_price = 20, sprocket_price = 15, downtime_hours = 1, downtime_cost_per_hour = 30}"
    found = json.loads(cli("maintain", path, "--json", "--set", f"maintenance={prices}").out)
    lives = {one["part"]: one["life_hours"] for one in found["parts"]}
    assert 0.8 < lives["small"] / lives["chain"] < 1.0
    small, seldom = lives["small"], int(lives["large"] / lives["small"])
    policy = found["policies"][found["cheapest"]]
    every = f"{grouped(small)} h"
    assert policy["description"] == (
        f"chain and small every {every}, large at every {ordinal(seldom)} chain change"
    )
    assert policy["cost_per_1000_h"] == pytest.approx(1000.0 * (65.0 + 15.0 / seldom) / small)
    least = 20.0 / lives["chain"] + 15.0 / lives["small"] + 15.0 / lives["large"] + 30.0 / lives["small"]
    assert found["least_possible_cost_per_1000_h"] == pytest.approx(1000.0 * least)
    # Without prices too.
    text = " ".join(cli("life", path).out.split())
    assert f"First replace the chain and the sprocket 'small' at {every}, then every {every} Then" in text
    assert f"large with the {ordinal(seldom)} chain at {grouped(seldom * small)} h" in text


def test_a_day_of_toml_is_a_start_date(cli, drive):
    short = ("--set", "run.horizon_hours=20")
    text = cli("life", drive, *short, "--set", "service.start_date=2027-01-04").out
    assert text == cli("life", drive, *short).out
    assert "beyond 2027-01-05" in text


def test_a_sprocket_has_its_own_price(cli, drive):
    before, after = (
        json.loads(cli("maintain", drive, "--json", *more).out)
        for more in ((), ("--set", "sprocket.2.price=300"))
    )
    life = next(one["life_hours"] for one in before["parts"] if one["part"] == "roll")
    costs = [found["policies"][0]["cost_per_1000_h"] for found in (before, after)]
    assert costs[1] - costs[0] == pytest.approx(1000.0 * 200.0 / life)


def test_own_prices_need_no_common_one(cli, tmp_path, two_sprockets):
    path = tmp_path / "drive.toml"
    text = (two_sprockets + PRICES_OF_PARTS).replace("sprocket_price = 100\n", "")
    path.write_text(text.replace("nodes = 61\n", "nodes = 61\nprice = 100\n"))
    assert cli("check", path).code == 0
    path.write_text(text.replace("nodes = 61\n[drive]", "nodes = 61\nprice = 100\n[drive]"))
    assert "the cost needs sprocket_price too" in cli("check", path).err
    path.write_text(two_sprockets.replace("nodes = 61\n[drive]", "nodes = 61\nprice = 100\n[drive]"))
    done = cli("check", path)
    assert done.code == 2
    assert "drive.toml:13: sprocket.2.price: the cost needs maintenance.chain_price too" in done.err


@pytest.mark.wide
def test_what_the_run_did_not_reach_is_a_bound(cli, drive):
    """With hardly any wear of the teeth in 400 h only the chain is worn out."""
    few = ("--set", "run.horizon_hours=400", "--set", "wear.specific_wear_rate_mm2_per_N=1e-11")
    text = cli("maintain", drive, *few).out
    assert "driver >= 400 h, roll >= 400 h" in text
    table = next(line for line in text.splitlines() if line.startswith("  each part at its own end"))
    assert table.count("<= ") == 4
    assert "Not known when to replace driver, roll: did not wear out in the simulated time" in " ".join(
        text.split()
    )
    assert "at most" in text
    assert "as far as is known" in text
    found = json.loads(cli("maintain", drive, *few, "--json").out)
    own = found["policies"][0]
    assert own["cost_per_1000_h"] is None
    assert own["cost_per_1000_h_at_most"] > 0.0
    assert found["cheapest_is_certain"] is False
    nothing = cli("maintain", drive, *few, "--set", "joint.specific_wear_rate_mm2_per_N=1e-11").out
    assert "chain >= 400 h" in nothing
    assert "sprockets with a chain change" not in nothing
    assert "each part at its own end: none; not known after 400 h" in nothing


def test_without_prices_no_cost_is_printed(cli, tmp_path, two_sprockets):
    path = tmp_path / "drive.toml"
    path.write_text(two_sprockets)
    done = cli("maintain", path, "--explain")
    assert done.code == 0
    assert "  Cost       not known without maintenance.chain_price and a price of every sprocket" in done.out
    assert "the one with the fewest stops, then the fewest parts" in " ".join(done.out.split())
    assert json.loads(cli("maintain", path, "--json").out)["least_possible_cost_per_1000_h"] is None
    assert "Cheapest" not in done.out


@pytest.mark.parametrize("setting", ["turn_sprocket=true", "replace_at_percent=[2]"])
def test_keys_of_one_sprocket_are_refused(cli, drive, setting):
    done = cli("maintain", drive, "--set", f"maintenance.{setting}")
    assert done.code == 2
    assert f"maintenance.{setting.split('=')[0]}: applies to cases of one sprocket only" in done.err


def test_no_sprocket_is_called_chain(cli, drive):
    done = cli("check", drive, "--set", "sprocket.2.name=chain")
    assert done.code == 2
    assert "the chain is a part too" in done.err


def test_a_cassette_is_one_part(four_cogs):
    lives = {
        "chain": Life(1.0, 7000.0),
        "ring": LowerBound(1.0, 9000.0),
        "cassette 13T": Life(1.0, 5000.0),
        "cassette 15T": Life(1.0, 4000.0),
        "cassette 17T": LowerBound(1.0, 9000.0),
        "cassette 19T": LowerBound(1.0, 9000.0),
    }
    found = SimpleNamespace(drive=load_drive(four_cogs), earliest_lives=lives, failed={})
    lives = part_lives(found)
    assert {name: (type(life), life.hours_run) for name, life in lives.items()} == {
        "chain": (Life, 7000.0),
        "ring": (LowerBound, 9000.0),
        "cassette": (Life, 4000.0),
    }


@pytest.mark.wide
def test_cogs_of_a_cassette_share_a_line(cli, four_cogs):
    done = cli("life", four_cogs, "--set", "run.horizon_hours=4000", "--set", WORN_FAST)
    lines = done.out.splitlines()
    assert len(lines) <= 12
    cassette = next(line for line in lines if line.startswith("  cassette "))
    assert cassette.startswith("  cassette   13T ")
    assert cassette.endswith("17T and 19T > 4 000 h: 13T fails first")
    assert " ".join(done.out.split()).endswith(f"Next wearsim report {four_cogs} --out sheet.html")


def test_explain_prints_what_is_counted(cli, drive):
    short = ("--set", "run.horizon_hours=20")
    brief = cli("life", drive, *short).out
    text = cli("life", drive, *short, "--explain").out
    assert " defaults: --explain shows them" in brief
    assert "--explain shows them" not in text
    assert "Assumes    1 roller positions minimise" in text
    assert "Band from  factor 3 to either side" in text
    assert text.splitlines()[:4] == brief.splitlines()[:4]
