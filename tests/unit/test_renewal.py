"""The cheapest cycle of a drive, held against the optimum of all schedules."""

import heapq
import itertools
import math
import time

import numpy as np
import pytest

from wearsim.drive.renewal import Cycle, cheapest_cycle, fewest_stops, least_cost_rate
from wearsim.drive.replacement_rules import Prices, cheapest, replacement_rules


def least_of_all_schedules(lives, prices, stop, hours):
    """Lower bound of what any schedule costs in an hour, for lives of whole hours.

    The least cost V of the coming hours by what every part has left, by dynamic programming: in every hour
    any parts may be replaced. V(t) - V(s) of the worst off state over t - s is a lower bound for all times.
    """
    parts = range(len(lives))
    moves = [((slice(1, None),) * len(lives), tuple(slice(0, life - 1) for life in lives), 0.0)]
    for count in parts:
        for chosen in itertools.combinations(parts, count + 1):
            before = tuple(slice(None) if i in chosen else slice(1, None) for i in parts)
            after = tuple(slice(lives[i] - 1, None) if i in chosen else slice(0, lives[i] - 1) for i in parts)
            moves.append((before, after, stop + sum(prices[i] for i in chosen)))
    cost, bound = np.zeros(lives), 0.0
    for hour in range(1, hours + 1):
        left = np.full(lives, math.inf)
        for before, after, spent in moves:
            np.minimum(left[before], cost[after] + spent, out=left[before])
        cost = left
        if hour == hours // 2:
            middle = cost
        elif hour > hours // 2:
            bound = max(bound, float((cost - middle).min()) / (hour - hours // 2))
    return bound


def random_drive(seed):
    """Two to four parts whose lives, prices and stop differ by up to the same factors."""
    rng = np.random.default_rng(seed)
    count = 2 + seed % 3
    longest = {2: 60, 3: 28, 4: 13}[count]
    lives = [round(math.exp(rng.uniform(math.log(4), math.log(longest)))) for _ in range(count)]
    return lives, list(np.exp(rng.uniform(0.0, math.log(10), count))), float(np.exp(rng.uniform(-1.2, 2.3)))


def events(cycle, until):
    """Replacements of all parts up to some hours."""
    ends = heapq.merge(*(cycle.ends(name) for name in cycle.every))
    return list(itertools.takewhile(lambda end: end[0] <= until * (1.0 + 1e-9), ends))


def paid(cycle, prices, stop, until):
    """What the replacements up to some hours cost, in an hour."""
    found = events(cycle, until)
    stops = len({round(hours, 6) for hours, _ in found})
    return (sum(prices[name] for _, name in found) + stop * stops) / until


def test_the_oracle_by_hand():
    """2 h and 5 h, prices 1 and 1, a stop of 10: both every 2 h, the second with every other: 11/2 + 1/4."""
    assert least_of_all_schedules([2, 5], [1.0, 1.0], 10.0, 200) == pytest.approx(5.75, abs=0.02)


@pytest.mark.wide
def test_no_schedule_is_much_cheaper_on_fifty_drives():
    dearer = []
    for seed in range(50):
        lives, prices, stop = random_drive(seed)
        least = least_of_all_schedules(lives, prices, stop, 24 * max(lives))
        chain, *others = map(float, lives)
        named = {str(i): life for i, life in enumerate(others)}
        priced = Prices(prices[0], dict(zip(named, prices[1:], strict=True)), stop)
        rules = replacement_rules(chain, named, priced)
        number, certain = cheapest(rules)
        assert certain
        dearer.append(rules[number].cost / least - 1.0)
    assert max(dearer) < 0.02
    assert np.mean(dearer) < 0.003
    assert min(dearer) > -1e-9


@pytest.mark.parametrize("seed", range(12))
def test_every_part_lasts_until_it_is_replaced_and_costs_are_those_of_the_schedule(seed):
    lives, prices, stop = random_drive(seed)
    lives = {str(i): 1.01**i * life for i, life in enumerate(lives)}
    prices = dict(zip(lives, prices, strict=True))
    for cycle in (cheapest_cycle(lives, prices, stop), fewest_stops(lives)):
        until = cycle.hours * math.lcm(*cycle.every.values())
        for name, life in lives.items():
            ends = [0.0, *(hours for hours, part in events(cycle, until) if part == name)]
            assert max(np.diff(ends)) <= life * (1.0 + 1e-9)
            assert ends[-1] == pytest.approx(until)
            assert ends[1] == cycle.first(name)
            assert cycle.mean_hours(name) == pytest.approx(until / (len(ends) - 1))
            assert [cycle.replaced(name, hours) for hours in ends] == list(range(len(ends)))
        rate = sum(prices[name] / cycle.mean_hours(name) for name in lives) + stop * cycle.stop_rate
        assert rate == pytest.approx(paid(cycle, prices, stop, until))
        assert rate >= least_cost_rate(lives, prices, stop) * (1.0 - 1e-9)


def test_chain_and_short_sprocket_together_the_large_one_with_the_eleventh():
    """20 + 15 + 30 in 37.69 thousand hours, 15 in eleven times as many: 1.7608 in 1000 h."""
    lives = {"chain": 41.72, "small": 37.69, "large": 444.1}
    cycle = cheapest_cycle(lives, {"chain": 20.0, "small": 15.0, "large": 15.0}, 30.0)
    assert cycle == Cycle(37.69, (), {"chain": 1, "small": 1, "large": 11}) == fewest_stops(lives)


def test_the_other_sprockets_go_between_two_chains():
    """1000 h, 1400 h and 1500 h: both sprockets after 1400 h, then all parts after 2800 h.

    3*40 + 4*100 + 4*60 in 2800 h is 271.4 in 1000 h; with every chain 40 + 200 + 60 = 300.
    """
    lives = {"chain": 1000.0, "driver": 1400.0, "roll": 1500.0}
    cycle = cheapest_cycle(lives, {"chain": 40.0, "driver": 100.0, "roll": 100.0}, 60.0)
    between = ((1000.0, ("chain",)), (1400.0, ("driver", "roll")), (2000.0, ("chain",)))
    assert cycle == Cycle(2800.0, between, {"chain": 1, "driver": 1, "roll": 1})


@pytest.mark.parametrize("ratio", [0.55, 0.7, 0.9, 0.99, 1.01, 1.3, 1.9, 7.5])
def test_the_fewest_stops_are_never_closer_than_the_shortest_life(ratio):
    lives = {"driver": 1000.0 * ratio, "roll": 1000.0 * (ratio + 0.1)}
    rule = replacement_rules(1000.0, lives)[1]
    shortest = min(1000.0, *lives.values())
    hours = [0.0, *(stop.hours for stop in rule.schedule)]
    assert np.diff(hours) == pytest.approx(shortest)
    # No fewer parts in these stops: each lasts for as many as fit.
    for name, life in {"chain": 1000.0, **lives}.items():
        assert rule.every[name] <= life * (1.0 + 1e-9) < rule.every[name] + shortest


def test_a_part_of_no_price_goes_with_any_stop():
    lives = {"chain": 1000.0, "roll": 1900.0}
    cycle = cheapest_cycle(lives, {"chain": 40.0, "roll": 0.0}, 10.0)
    assert (cycle.hours, cycle.within, cycle.every) == (1000.0, (), {"chain": 1, "roll": 1})


def test_a_drive_of_six_parts_is_planned_in_a_moment():
    rng = np.random.default_rng(6)
    lives = {str(i): life for i, life in enumerate(np.exp(rng.uniform(0.0, 4.0, 6)))}
    prices = dict(zip(lives, rng.uniform(1.0, 10.0, 6), strict=True))
    spent = []
    for _ in range(3):
        start = time.process_time()
        cheapest_cycle(lives, prices, 3.0)
        spent.append(time.process_time() - start)
    assert min(spent) < 0.05
