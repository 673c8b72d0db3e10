"""Chains in rotation: hours of each by hand, one rate for all."""

import pytest

import wearsim
from tests.drives import FAST_WRAP, changed
from wearsim.readings.chain_state import chain_state
from wearsim.readings.rotation import MOUNTED

CASE = changed(FAST_WRAP, {"stop.elongation_percent": 3, "service": {"km_per_hour": 30, "hours_per_day": 8}})
HEAD = "time_hours,quantity,value,links,result,error,chain\n"
LOG = [
    "1000,new,,,,,A",
    "1300,new,,,,,B",
    "1400,mounted,,,,,A",
    "1600,elongation_percent,0.6,,,1e-6,A",
    "1600,mounted,,,,,B",
    "1650,gauge_percent,0.75,,go,,B",
]
"""A runs 300 and 200 h and is 0.6 % longer; B runs 100 and 50 h, 0.18 %."""


@pytest.fixture
def state(tmp_path):
    """Function that tells what a log says."""

    def read(*rows, case=CASE):
        path = tmp_path / "log.csv"
        path.write_text(HEAD + "\n".join(rows) + "\n", encoding="utf-8")
        return chain_state(wearsim.load_case(case), path)

    return read


def test_each_chain_has_its_own_hours_and_all_one_rate(state):
    """0.6 % in 500 h are 3 % in 2500 h: 2000 and 2350 h left, 4350 together."""
    found = state(*LOG)
    assert found.log.rotation.hours == {"A": 500.0, "B": 150.0}
    assert (found.log.rotation.mounted, found.log.today, found.log.machine) == ("B", 150.0, 650.0)
    assert found.chains["A"].elongation[2] == pytest.approx(0.6, rel=1e-4)
    assert found.chains["A"].left[2] == pytest.approx(2000.0, rel=1e-4)
    assert found.chains["B"].elongation[2] == pytest.approx(0.18, rel=1e-4)
    assert found.of("remaining_hours").middle == pytest.approx(2350.0, rel=1e-4)
    assert found.of("remaining_hours_of_all").middle == pytest.approx(4350.0, rel=1e-4)


def test_the_last_day_is_that_of_all_chains(state):
    """650 h have run and 4350 are left, at 8 h a day: 625 days."""
    dated = changed(CASE, {"service.start_date": "2026-01-01"})
    assert state(*LOG, case=dated).of("end_date").values[2] in ("2027-09-17", "2027-09-18")


def test_a_worn_chain_waits_for_the_others(state):
    found = state(*[row.replace("0.6", "3.6") for row in LOG])
    assert found.chains["A"].left[2] == 0.0
    assert found.chains["B"].left[2] > 0.0


OILED = changed(CASE, {"lubrication": {"lasts_hours": 100, "dry_factor": 2, "price_per_application": 4}})
EACH_OILED = [
    "1000,new,,,,,A",
    "1150,relubrication,,,,,",
    "1300,new,,,,,B",
    "1400,relubrication,,,,,A",
    "1450,relubrication,,,,,B",
    "1600,mounted,,,,,A",
    "1750,relubrication,,,,,",
    "1900,elongation_percent,0.8,,,1e-6,A",
]
"""A is oiled after 150, 300 (while B runs) and 450 of its 600 h, B after 150 of 300 h."""


def test_a_relubrication_is_of_its_chain_or_of_the_one_on_the_drive(state):
    """150 h with oil for 100 wear as 100 + 2*50 = 200: A has 0.8 % for 800, B 400, and 3 % come in 2250 h."""
    found = state(*EACH_OILED, case=OILED)
    logs = found.log.lubricated
    assert (logs["A"].hours, logs["B"].hours) == ((150.0, 300.0, 450.0), (150.0,))
    assert {log.logged_interval for log in logs.values()} == {150.0}
    assert found.chains["B"].elongation[2] == pytest.approx(0.4, rel=1e-4)
    assert found.chains["A"].left[2] == pytest.approx(2250.0 - 600.0, rel=1e-4)
    assert found.chains["B"].left[2] == pytest.approx(2250.0 - 300.0, rel=1e-4)


def test_a_chain_beyond_its_limit_is_told_as_that(state):
    """B has 3.6 % of 3 %, by a reading good to 1e-6 %."""
    found = state(*LOG[:3], LOG[4], "1650,elongation_percent,3.6,,,1e-6,B")
    assert any(
        text.startswith("chain B: the limit is reached, by all that was read") for text in found.warnings
    )


def test_calibrate_says_that_it_takes_one_part():
    pytest.importorskip("pandera", reason="pandera is not installed")
    rows = [dict(zip(HEAD.strip().split(","), row.split(","), strict=True)) for row in LOG]
    with pytest.raises(
        wearsim.CaseError, match=r":2: chain: must be empty, as .*wearsim maintain take several"
    ):
        wearsim.calibrate(CASE, rows)


def test_a_chain_that_shrinks_is_named_but_not_one_beside_another(state):
    """B with 0.1 % after A with 0.6 % is another chain; A with 0.1 % is not."""
    longer = ["1700,elongation_percent,0.24,,,0.05,B", "1800,mounted,,,,,A"]
    assert not [text for text in state(*LOG, *longer).warnings if "shorter" in text]
    shrunk = state(*LOG, *longer, "1900,elongation_percent,0.1,,,0.01,A")
    (text,) = (text for text in shrunk.warnings if "chains do not become shorter" in text)
    assert "0.1 % of chain A contradicts 0.6 % of chain A in line 5" in text


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        (["1650,elongation_percent,0.6,,,,"], ":8: chain: must name the chain of every row"),
        (["1650,mounted,,,,,C"], ":8: chain: 'C' must have a row 'new' first"),
        (["1650,new,,,,,A"], ":8: chain: 'A' was new before"),
        (["1650,relubrication,,,,,C"], ":8: chain: 'C' must have a row 'new' first"),
        (["1650,relubrication,5,,,,A"], "must be empty for relubrication (got '5')"),
        (["1650,mounted,5,,,,A"], f"must be empty for {MOUNTED} (got '5')"),
        (["1640,mounted,,,,,A"], "must not go backwards"),
    ],
)
def test_what_cannot_be_is_named(state, rows, message):
    with pytest.raises(wearsim.CaseError) as caught:
        state(*LOG, *rows)
    assert message in str(caught.value)


def test_one_chain_alone_is_not_mounted_again(tmp_path):
    path = tmp_path / "log.csv"
    path.write_text("time_hours,quantity,value\n0,new,\n500,mounted,\n600,elongation_percent,0.6\n")
    with pytest.raises(wearsim.CaseError, match=r":3: quantity: must be one of new, chain_length_mm"):
        chain_state(wearsim.load_case(CASE), path)


def test_the_answer_lists_the_chains():
    rows = [dict(zip(HEAD.strip().split(","), row.split(","), strict=True)) for row in LOG]
    found = wearsim.remaining(CASE, readings=rows)
    assert found.chains["used_hours"].tolist() == [500.0, 150.0]
    assert found.summary()["chains"][0]["chain"] == "A"
    text = " ".join(found.text.split())
    oiled = [dict(zip(HEAD.strip().split(","), row.split(","), strict=True)) for row in EACH_OILED]
    again = wearsim.remaining(OILED, readings=oiled)
    assert again.summary()["relubrications"] == 4
    assert "4 times, every 150 h on average" in " ".join(again.text.split())
    assert "of chain B, which is on the drive, after 150 h" in text
    assert "Chain A 0.6 % longer after 500 h, 2 000 h left" in text
