"""Jobs of a year by hand: stops, what goes in them, and what they cost."""

import pytest

from wearsim.drive.replacement_rules import Prices
from wearsim.study.maintain.year_plan import PartNow, kept_parts, replacements, total

PRICES = Prices(40.0, {"roll": 100.0}, 10.0)


def stops(parts, until, prices=PRICES):
    return [(job.hours, job.parts, job.cost) for job in replacements(parts, until, prices)]


def test_a_chain_is_replaced_again_and_again():
    """1000 h of life, 900 used: after 100, 1100 and 2100 h."""
    chain = [PartNow("chain", 1000.0, 900.0)]
    expected = [(100.0, ("chain",), 50.0), (1100.0, ("chain",), 50.0), (2100.0, ("chain",), 50.0)]
    assert stops(chain, 2500.0) == expected


def test_a_sprocket_goes_with_the_chain_where_its_unused_life_is_worth_less_than_a_stop():
    """200 h of 2500 are worth 8 of 100, less than 10; 300 h are worth 12, more than that."""
    chain = PartNow("chain", 1000.0, 900.0)
    assert stops([chain, PartNow("roll", 2500.0, 2200.0)], 900.0) == [(100.0, ("chain", "roll"), 150.0)]
    alone = stops([chain, PartNow("roll", 2500.0, 2100.0)], 900.0)
    assert alone == [(100.0, ("chain",), 50.0), (400.0, ("roll",), 110.0)]


def test_without_prices_stops_are_as_few_as_can_be():
    parts = [PartNow("chain", 1000.0, 900.0), PartNow("roll", 2500.0, 1500.0)]
    assert stops(parts, 1050.0, None) == [(100.0, ("chain", "roll"), None)]
    assert total(replacements(parts, 1050.0, None)) is None


def test_a_part_that_lasts_is_kept_and_one_beyond_its_life_goes_now():
    parts = [PartNow("chain", 1000.0, 1200.0), PartNow("roll", 9000.0, 1000.0, worn_out=False)]
    jobs = replacements(parts, 500.0, PRICES)
    assert [(job.hours, job.parts) for job in jobs] == [(0.0, ("chain",))]
    (kept,) = kept_parts(parts, jobs)
    assert (kept.parts, kept.hours, kept.at_least) == (("roll",), 8000.0, True)


def test_the_interval_is_that_of_the_present_chain_alone():
    first, then = replacements([PartNow("chain", 1000.0, 900.0, low=50.0, high=200.0)], 1500.0, PRICES)
    assert (first.low, first.high) == (50.0, 200.0)
    assert then.low != then.low
    assert total([first, then]) == pytest.approx(100.0)


def test_a_job_has_the_band_of_the_part_that_asks_for_it():
    """The roll ends first and again 400 h later, the chain between; what is kept has its band too."""
    chain = PartNow("chain", 1000.0, 700.0, low=250.0, high=350.0)
    roll = PartNow("roll", 400.0, 300.0, low=50.0, high=200.0)
    wheel = PartNow("wheel", 9000.0, 0.0, low=5000.0, high=12000.0)
    parts = (chain, roll, wheel)
    jobs = replacements(parts, 500.0, None)
    assert [(job.hours, job.parts, job.low, job.high) for job in jobs[:1]] == [
        (100.0, ("chain", "roll"), 50.0, 200.0)
    ]
    (kept,) = kept_parts(parts, jobs)
    assert (kept.low, kept.high) == (5000.0, 12000.0)
