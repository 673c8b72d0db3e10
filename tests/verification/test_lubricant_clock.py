"""The lubricant as the clock of the wear: integrals by hand, quadrature, lives of steady contacts."""

import math
import random
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from scipy.integrate import quad

import wearsim
from wearsim.lubrication.clock import FRESH, LubricantClock
from wearsim.lubrication.law import LubricantLaw
from wearsim.lubrication.schedule import LubricantEvent, LubricantSchedule
from wearsim.result import WearResult
from wearsim.wear.mate_clock import LubricatedClock
from wearsim.wear.running_in import RunningIn

CASES = Path(__file__).parents[2] / "cases"
LAW = LubricantLaw(dry_factor=5.0, lasts=100.0, fades=40.0)


def every(interval: float, *first: LubricantEvent) -> LubricantSchedule:
    return LubricantSchedule((*first, LubricantEvent(interval, relubricated=True)), interval)


@pytest.mark.parametrize(
    ("cycles", "worn"),
    [
        (100.0, 100.0),
        # On the ramp: 20 cycles, the mean of 1 and 3.
        (120.0, 100.0 + 20.0 * 2.0),
        # All of the ramp, 40 cycles at 3 in the mean, and 10 dry ones at 5.
        (150.0, 100.0 + 40.0 * 3.0 + 10.0 * 5.0),
    ],
)
def test_one_application_by_hand(cycles: float, worn: float) -> None:
    clock = LubricantClock(LAW, LubricantSchedule())
    assert clock.steady_cycles(cycles) == pytest.approx(worn, rel=1e-15)
    assert clock.running_cycles(np.array([worn]))[0] == pytest.approx(cycles, rel=1e-15)


def test_partial_relubrication_comes_to_its_fixed_point() -> None:
    """Half of the age stays: a = (a + I)/2, thus each round begins at the age I and ends at 2 I."""
    law = LubricantLaw(dry_factor=5.0, lasts=100.0, fades=100.0, completeness=0.5)
    clock = LubricantClock(law, every(100.0))
    # From age 100 to 200 on a ramp of 100 cycles: the mean of 1 and 5.
    assert clock.lasting_factor == pytest.approx(3.0, rel=1e-12)


def test_dirt_stays_in_part() -> None:
    """Dirtied once to three times the wear: after each relubrication half of the excess is left."""
    law = LubricantLaw(dirt_removed=0.5)
    events = (
        LubricantEvent(0.0, dirtied=2.0),
        *(LubricantEvent(10.0 * n, relubricated=True) for n in range(1, 4)),
    )
    clock = LubricantClock(law, LubricantSchedule(events))
    assert [clock.factor(10.0 * n + 5.0) for n in range(4)] == [3.0, 2.0, 1.5, 1.25]
    assert clock.steady_cycles(40.0) == pytest.approx(10.0 * (3.0 + 2.0 + 1.5 + 1.25), rel=1e-15)


def test_dirt_that_comes_all_the_time_is_not_washed_away() -> None:
    clock = LubricantClock(LubricantLaw(dirt_removed=1.0), every(10.0, LubricantEvent(0.0, held=2.0)))
    assert clock.steady_cycles(95.0) == pytest.approx(3.0 * 95.0, rel=1e-14)


def test_lubricant_ages_faster_where_it_is_dirty() -> None:
    """At twice the age for each cycle the dry part begins after half of the cycles."""
    law = LubricantLaw(dry_factor=5.0, lasts=100.0)
    clock = LubricantClock(law, LubricantSchedule((LubricantEvent(0.0, ageing=2.0),)))
    assert clock.steady_cycles(60.0) == pytest.approx(50.0 + 10.0 * 5.0, rel=1e-15)


def test_relubricated_when_it_wears_so_many_times_as_fast() -> None:
    """At twice the wear a quarter of the ramp of 40 has gone: every 110 cycles, 100 + 10 x 1.5 of wear."""
    clock = LubricantClock(LAW, LubricantSchedule(threshold=2.0))
    assert clock.steady_cycles(1100.0) == pytest.approx(10.0 * 115.0, rel=1e-13)
    assert clock.lasting_factor == pytest.approx(115.0 / 110.0, rel=1e-13)
    assert clock.factor(109.999) > 1.99
    assert clock.factor(110.001) < 1.01


def _random_schedule(rng: random.Random, length: float) -> LubricantSchedule:
    events = sorted(
        (
            LubricantEvent(
                rng.uniform(0.0, length),
                rng.random() < 0.5,
                rng.choice([None, 0.0, rng.uniform(0.0, 3.0)]),
                rng.choice([None, 1.0, rng.uniform(1.0, 10.0)]),
                rng.choice([0.0, rng.uniform(0.0, 6.0)]),
            )
            for _ in range(rng.randint(1, 6))
        ),
        key=lambda event: event.after,
    )
    return LubricantSchedule(tuple(events), rng.choice([length, math.inf]))


@pytest.mark.parametrize("seed", range(30))
def test_clock_is_the_integral_of_its_factor(seed: int) -> None:
    """By quadrature between all kinks; forth and back; the factor is that of the state by small steps."""
    rng = random.Random(seed)  # noqa: S311
    law = LubricantLaw(
        rng.uniform(1.0, 60.0),
        rng.uniform(0.0, 300.0),
        rng.choice([0.0, rng.uniform(1.0, 200.0)]),
        rng.uniform(0.2, 1.0),
        rng.uniform(0.05, 1.0),
    )
    length = rng.uniform(50.0, 1000.0)
    schedule = _random_schedule(rng, length)
    clock = LubricantClock(law, schedule)
    runs = np.sort([rng.uniform(0.0, 30.0 * length) for _ in range(40)])
    worn = np.array([clock.steady_cycles(run) for run in runs])
    np.testing.assert_allclose(clock.running_cycles(worn), runs, rtol=1e-10, atol=1e-9)
    end = 3.0 * length
    expected = _by_small_steps(law, schedule, end, length)
    assert clock.steady_cycles(end) == pytest.approx(expected, rel=2e-3)


@pytest.mark.parametrize("seed", range(30))
def test_a_new_part_is_lubricated_and_clean(seed: int) -> None:
    """Then it meets what the drive does; by the state of its lubricant, step by step."""
    rng = random.Random(seed)  # noqa: S311
    fades, lasts = rng.choice([0.0, rng.uniform(1.0, 200.0)]), rng.uniform(0.0, 300.0)
    law = LubricantLaw(rng.uniform(1.0, 60.0), lasts, fades, rng.uniform(0.2, 1.0), rng.uniform(0.05, 1.0))
    length = rng.uniform(50.0, 1000.0)
    schedule = _random_schedule(rng, length)
    new_at, end = rng.uniform(0.0, 2.0) * length, 3.0 * length
    part = LubricantClock(law, schedule).renewed(new_at)
    expected = _by_small_steps(law, schedule, end, length, new_at)
    assert part.steady_cycles(end - new_at) == pytest.approx(expected, rel=2e-3)


def test_relubrications_at_a_rate_are_those_of_the_drive() -> None:
    """Where the drive wears twice as fast, half faded from 100 to 200 cycles: every 133.3 cycles."""
    law, schedule = LubricantLaw(4.0, 100.0, 100.0), LubricantSchedule(threshold=2.0)
    part = LubricantClock(law, schedule).renewed(1000.0)  # the seventh comes at 1066.7
    assert part.steady_cycles(200.0 / 3.0 + 100.0) == pytest.approx(200.0 / 3.0 + 100.0, rel=1e-12)
    # 100 cycles lubricated and a third of the fading, at 1.5 in the mean, from the seventh to the eighth.
    assert part.steady_cycles(200.0) == pytest.approx(200.0 / 3.0 + 100.0 + 1.5 * 100.0 / 3.0, rel=1e-12)


def _by_small_steps(
    law: LubricantLaw, schedule: LubricantSchedule, end: float, length: float, new_at: float = 0.0
) -> float:
    """Integral of g by the state of the lubricant itself, step by step; that of a part new at a time."""
    rounds = 1 if math.isinf(schedule.repeats) else 3
    events = [(n * length + event.after, event) for n in range(rounds) for event in schedule.events]
    stops = np.unique([0.0, end, new_at, *(time for time, _ in events), *np.linspace(0.0, end, 20_001)])
    age, dirt, held, ageing, worn, next_event = 0.0, 0.0, 0.0, 1.0, 0.0, 0
    for start, stop in pairwise(stops):
        while next_event < len(events) and events[next_event][0] <= start:
            event = events[next_event][1]
            if event.relubricated:
                age, dirt = age * (1.0 - law.completeness), dirt * (1.0 - law.dirt_removed)
            held = held if event.held is None else event.held
            ageing = ageing if event.ageing is None else event.ageing
            dirt = max(dirt, held, event.dirtied)
            next_event += 1
        if start == new_at:
            age, dirt, worn = 0.0, held, 0.0
        step = float(stop - start)
        beyond = age + 0.5 * ageing * step - law.lasts
        dry = 1.0 if law.fades == 0.0 and beyond > 0.0 else min(max(beyond / (law.fades or 1.0), 0.0), 1.0)
        worn += step * (1.0 + (law.dry_factor - 1.0) * dry) * (1.0 + dirt)
        age = min(age + ageing * step, law.lasts + law.fades)
    return worn


@pytest.mark.parametrize("interval", [30.0, 120.0, 200.0, 1000.0])
def test_amplification_is_the_greatest_change_of_the_cycles_run(interval: float) -> None:
    clock = LubricantClock(LAW, every(interval))
    steady = np.geomspace(1.0, 1e4, 20_001)
    run = clock.running_cycles(steady)
    moved = np.diff(np.log(run)) / np.diff(np.log(steady))
    assert moved.max() <= clock.amplification * (1.0 + 1e-9)
    assert clock.amplification == pytest.approx(max(moved.max(), 1.0), rel=0.05)


def test_running_in_counts_lubricated_cycles() -> None:
    """tau = R(M(N)), by quadrature of g and by hand of R."""
    running_in, lubricant = RunningIn(4.0, 50.0), LubricantClock(LAW, every(130.0))
    worn, _ = quad(lubricant.factor, 0.0, 500.0, points=[100, 130, 230, 260, 360, 390, 490], limit=400)
    expected = worn + 3.0 * 50.0 * (1.0 - math.exp(-worn / 50.0))
    clock = LubricatedClock(running_in, lubricant)
    assert clock.steady_cycles(500.0) == pytest.approx(expected, rel=1e-9)
    assert clock.running_cycles(np.array([expected]))[0] == pytest.approx(500.0, rel=1e-9)
    assert FRESH.steady_cycles(0.1) == 0.1


STRAND = [CASES / "16b-20t-oiled.toml", "sprocket.nodes=61", "stop.critical_depth_mm=0.05"]
TABLE = [CASES / "hertz-arc-prescribed.toml"]
GEARS = [CASES / "fzg-c14-16t-mild.toml", "gear.nodes=61"]
WRAP = [CASES / "08b-19t-wrap.toml", "sprocket.nodes=101", "mechanism.phases=2", "run.life_tolerance=0.1"]

COARSE = [CASES / "08b-19t-wrap.toml", "sprocket.nodes=51", "mechanism.phases=1", "run.life_tolerance=0.1"]


def life(case: list[Any], *settings: str) -> WearResult:
    return wearsim.simulate(wearsim.load_case(case[0], [*case[1:], *settings]))


def lasting(part: float, hours: float) -> list[str]:
    return [f"lubrication.lasts_hours={part * hours!r}", "lubrication.dry_factor=5"]


def by_hand(steady: float, lasts: float, interval: float) -> float:
    """Hours in which as much wears as in ``steady`` ones: ``lasts`` at 1, the rest of an interval at 5."""
    per_round = lasts + 5.0 * (interval - lasts)
    rounds = steady // per_round
    rest = steady - rounds * per_round
    return rounds * interval + (rest if rest <= lasts else lasts + (rest - lasts) / 5.0)


@pytest.mark.wide
@pytest.mark.parametrize("case", [STRAND, TABLE, GEARS, WRAP], ids=["strand", "table", "gears", "wrap"])
def test_lives_go_with_the_clock(case: list[Any]) -> None:
    """The same law for teeth, joints and gears: each life is that of steady contacts by hand."""
    steady = life(case, "run.life_tolerance=0.1")
    hours = steady.life.hours_run
    settings = [
        *lasting(0.05, hours),
        f"lubrication.interval_hours={0.08 * hours!r}",
        "run.life_tolerance=0.1",
    ]
    found = life(case, *settings)
    # Steps are those of another tolerance where the clock amplifies an error.
    assert found.life.hours_run == pytest.approx(by_hand(hours, 0.05 * hours, 0.08 * hours), rel=2e-2)
    # Pitting counts cycles, whatever they wear.
    for part, of in ((name, steady.parts[name]) for name in ("chain", "sprocket") if name in steady.parts):
        expected = by_hand(of.hours_run, 0.05 * hours, 0.08 * hours)
        assert found.parts[part].hours_run == pytest.approx(expected, rel=2e-2)


@pytest.mark.wide
def test_elongation_is_straight_between_the_rows_of_a_history(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every chain grows by its own lubricated hours, by hand; an interval ends just after a chain."""
    settings = ["joint.specific_wear_rate_mm2_per_N=2e-8", "stop.critical_depth_mm=0.008"]
    steady = life(COARSE, *settings).parts["chain"].hours_run
    lasts, interval = 0.05 * steady, 0.08002 * steady
    lubricated = [f"lubrication.lasts_hours={lasts!r}", "lubrication.dry_factor=5"]
    result = life(COARSE, *settings, *lubricated, f"lubrication.interval_hours={interval!r}")
    rows, limit = result.history, result.history["elongation_percent"].max()

    def grown(hours: float) -> float:
        rounds, rest = divmod(hours, interval)
        worn = rounds * (lasts + 5.0 * (interval - lasts)) + min(rest, lasts) + 5.0 * max(rest - lasts, 0.0)
        return float(worn / steady)

    def of_new_chain(at: float, hours: float) -> float:
        """Lubricated when it is put on, then at the times of the drive."""
        again = (at // interval + 1.0) * interval
        if hours < again:
            return float((min(hours - at, lasts) + 5.0 * max(hours - at - lasts, 0.0)) / steady)
        return of_new_chain(at, again * (1.0 - 1e-15)) + grown(hours) - grown(again)

    assert rows["chain"].max() >= 2
    assert rows["time_hours"].is_monotonic_increasing and rows["time_hours"].is_unique
    first = rows[rows["chain"] == 1]
    at = np.linspace(0.0, first["time_hours"].max(), 500)
    found = np.interp(at, first["time_hours"], first["elongation_percent"])
    np.testing.assert_allclose(found, [limit * grown(hours) for hours in at], rtol=1e-6, atol=1e-6 * limit)
    put_on = [0.0, *rows.groupby("chain")["time_hours"].max()]
    all_chains = [
        limit
        * (grown if row.chain == 1 else partial(of_new_chain, put_on[int(row.chain) - 1]))(row.time_hours)
        for row in rows.itertuples()
    ]
    np.testing.assert_allclose(rows["elongation_percent"], all_chains, rtol=1e-6, atol=1e-6 * limit)
    monkeypatch.setattr(LubricantClock, "knees", lambda self, end, most=200: np.empty(0))
    before = life(COARSE, *settings, *lubricated, f"lubrication.interval_hours={interval!r}").history
    kept = rows[rows["cycles"].isin(before["cycles"])].reset_index(drop=True)
    pd.testing.assert_frame_equal(kept, before, check_exact=True)
    assert 0 < len(rows) - len(before) <= 400


@pytest.mark.parametrize(
    ("lasts", "fades", "expected"),
    [
        (100.0, 0.0, [100.0, 150.0, 250.0, 300.0]),
        (100.0, 40.0, [100.0, 110.0, 120.0, 130.0, 140.0, 150.0, 250.0, 260.0, 270.0, 280.0, 290.0, 300.0]),
        (150.0, 40.0, []),
    ],
)
def test_knees_by_hand(lasts: float, fades: float, expected: list[float]) -> None:
    clock = LubricantClock(LubricantLaw(5.0, lasts, fades), every(150.0))
    assert clock.knees(310.0).tolist() == expected
    assert len(clock.knees(1e9)) <= 200


@pytest.mark.parametrize("case", [STRAND, TABLE, GEARS, WRAP], ids=["strand", "table", "gears", "wrap"])
def test_short_intervals_give_the_life_of_lubricated_contacts(case: list[Any]) -> None:
    steady = life(case)
    hours = steady.life.hours_run
    found = life(case, *lasting(1e-3, hours), f"lubrication.interval_hours={5e-4 * hours!r}")
    assert found.life.hours_run == pytest.approx(hours, rel=1e-9)
    assert found.stop == steady.stop


def test_dirt_all_the_time_multiplies_the_wear() -> None:
    steady = life(WRAP)
    found = life(WRAP, "lubrication.contamination_factor=2.5")
    assert found.life.hours_run == pytest.approx(steady.life.hours_run / 2.5, rel=1e-12)
    # Where its rollers rest is sought anew in every step, to some digits of their places.
    assert found.parts["sprocket"].hours_run == pytest.approx(
        steady.parts["sprocket"].hours_run / 2.5, rel=1e-8
    )


def test_way_of_the_joints_by_hand() -> None:
    """16 joints a turn slide pi d2 (1/19 + 1/mate) twice in a loop of so many links."""
    rough = ["sprocket.nodes=61", "mechanism.phases=2", "run.life_tolerance=0.1"]
    case = wearsim.load_case(CASES / "08b-19t-wrap.toml", rough)
    chain, drive = case.inputs["chain"], case.inputs["drive"]
    assert chain["designation"].startswith("08B")
    pin, mate, links = 4.45, drive["mate_teeth"], case.drive.layout.links
    loops_an_hour = case.speed_rpm * 60.0 * 19 / links
    way = 2.0 * math.pi * pin * (1.0 / 19 + 1.0 / mate) * loops_an_hour / 1000.0
    steady = wearsim.simulate(case)
    lasts = 0.3 * steady.life.hours_run
    by_way = [f"lubrication.lasts_sliding_m={lasts * way!r}", "lubrication.dry_factor=5"]
    by_time = [f"lubrication.lasts_hours={lasts!r}", "lubrication.dry_factor=5"]
    found = [
        wearsim.simulate(wearsim.load_case(CASES / "08b-19t-wrap.toml", rough + settings)).life.hours_run
        for settings in (by_way, by_time)
    ]
    assert found[0] == pytest.approx(found[1], rel=1e-9)
    assert found[1] == pytest.approx(lasts + (steady.life.hours_run - lasts) / 5.0, rel=1e-2)
