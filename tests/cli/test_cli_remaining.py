"""``wearsim remaining``: one reading, one answer."""

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
    assert "where the limit is reached" in done.err
