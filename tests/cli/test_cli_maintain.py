"""``wearsim maintain``: tables, files and exit codes."""

import csv
import json

import pytest

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
[stop]
critical_depth_mm = 0.02
[run]
life_tolerance = 0.1
[maintenance]
replace_at_percent = [3]
turn_sprocket = true
chain_price = 40
sprocket_price = 60
downtime_hours = 2
downtime_cost_per_hour = 30
"""


@pytest.fixture
def wrapped(tmp_path):
    path = tmp_path / "wrapped.toml"
    path.write_text(WRAP)
    return path


@pytest.mark.slow
def test_text_json_and_files_agree(cli, wrapped, tmp_path):
    out = tmp_path / "plan"
    done = cli("maintain", wrapped, "--out", out, "--json")
    assert done.code == 0
    found = json.loads(done.out)
    assert found["schema_version"] == 1
    with (out / "policies.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [row["turned"] for row in rows] == ["False", "True"]
    for row, policy in zip(rows, found["policies"], strict=True):
        assert {key: float(row[key]) for key in ("sprocket_life_hours", "cost_per_1000_h")} == {
            key: policy[key] for key in ("sprocket_life_hours", "cost_per_1000_h")
        }
        price = 40 * policy["chains_per_sprocket"] + 60 + 2 * 30 * policy["stops"]
        assert policy["cost_per_1000_h"] == pytest.approx(1000 * price / policy["sprocket_life_hours"])
    assert len(found["tooth_counts"]) == 9
    assert {path.name for path in out.iterdir()} == {
        ".wearsim",
        "policies.csv",
        "tooth_counts.csv",
        "maintenance.md",
        "maintenance.png",
        "maintenance.svg",
    }
    assert (out / "maintenance.md").read_text().startswith("# Wrapped test drive\n\n| replace at |")
    assert cli("maintain", wrapped, "--out", out).code == 2
    again = cli("maintain", wrapped, "--out", out, "--force", "--set", "maintenance.chain_price=41")
    assert again.code == 0
    assert again.out.startswith(
        "Wrapped test drive, with maintenance.chain_price = 41\n  replace at  turned  "
    )
    assert max(map(len, again.out.splitlines())) <= 100
    assert "cheapest: a new chain at 3 %" in again.out


def test_without_a_wrap_it_is_bad_input(cli, drive):
    done = cli("maintain", drive(), "--json")
    assert done.code == 2
    assert json.loads(done.out)["error"]["key"] == "mechanism.kind"


def test_other_commands_check_the_table(cli, drive):
    done = cli("check", drive(), "--set", "maintenance.chain_price=40")
    assert done.code == 2
    assert "sprocket_price" in done.err
    assert cli("check", drive(), "--set", "maintenance.turn_sprocket=true").code == 0
