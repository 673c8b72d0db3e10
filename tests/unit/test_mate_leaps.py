"""Leaps over mates that are alike: where they lead, where they stop, and the way back."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import wearsim
from wearsim.drive.wrap_life import wrap_of, wrap_task
from wearsim.wear import implicit_steps
from wearsim.wear.mate_leaps import MateLeaps
from wearsim.wear.settled_run import advance_resting

TABLES = {
    "format_version": 1,
    "chain": {"designation": "ANSI 40"},
    "sprocket": {"teeth": 15, "profile": "ansi_b29", "nodes": 61},
    "mechanism": {"kind": "wrap", "phases": 2},
    "drive": {"mate_teeth": 15, "links": 101, "slack_tension_N": 50},
    "load": {"tension_N": 1000, "speed_rpm": 100},
    "wear": {"specific_wear_rate_mm2_per_N": 1e-9},
    "stop": {"critical_depth_mm": 0.05},
    "run": {"horizon_hours": 1e6},
}
MANY = "joint.specific_wear_rate_mm2_per_N=7e-7"
"""Joints that wear so fast that the sprocket outlives 60 chains."""


class Alike:
    """Bodies of two points off which every mate takes the same; counts the mates that are run."""

    contact = SimpleNamespace(cycles_per_mate=100.0)
    unworn = np.ones((6, 2))
    mates_are_alike = True
    work = np.array([[0.5, 1.0]])

    def __init__(self):
        self.area, self.removed, self.cycles, self.mate, self.run = np.zeros((1, 2)), 0.0, 0.0, 1, 0

    def begin_mate(self, area, removed, cycles, mate):
        self.area, self.removed, self.cycles, self.mate = area, removed, cycles, mate

    def next_mate(self):
        self.run += 1
        self.begin_mate(
            self.area + self.work, self.removed + self.work.sum(), self.cycles + 100.0, self.mate + 1
        )


def worn_to(limit, deepest=1e3, refined=1.0):
    """Run mates until one has come to a limit on the area, and give the bodies and the leaps."""
    bodies = Alike()
    leaps = MateLeaps(bodies, deepest, refined, lambda: bodies.area.max() < limit)
    while bodies.area.max() < limit:
        bodies.next_mate()
        leaps.take()
    return bodies, leaps


@pytest.mark.parametrize("refined", [0.5, 1.0, 2.0])
def test_the_work_of_mates_that_are_alike_adds_up(refined):
    bodies, _ = worn_to(400.0, refined=refined)
    lived = bodies.mate - 1
    assert lived == 400
    assert np.array_equal(bodies.area, 400 * Alike.work)
    assert bodies.removed == pytest.approx(600.0)
    assert bodies.cycles == pytest.approx(40_000.0)


def test_finer_runs_leap_less():
    """Two mates run for each leap over a quarter of those so far: 30 * 1.25^n reaches 400 with n = 12."""
    coarse, usual, fine = (worn_to(400.0, refined=refined)[0].run for refined in (0.5, 1.0, 2.0))
    assert coarse < usual < fine < 400
    assert usual == pytest.approx(30 + 2 * math.log(400 / 30, 1.25), abs=8)


def test_no_leap_before_30_mates_nor_where_they_are_unlike(monkeypatch):
    assert worn_to(30.0)[0].run == 30
    monkeypatch.setattr(Alike, "mates_are_alike", False)
    assert worn_to(100.0)[0].run == 100


def test_a_leap_takes_off_so_much_at_most():
    """Leaps over 3 of 3 + 2 mates."""
    bodies, _ = worn_to(130.0, deepest=3.0)
    assert bodies.run == pytest.approx(30 + 100 * 2 / 5, abs=3)


def test_a_leap_is_taken_back_until_mates_have_settled():
    bodies = Alike()
    leaps = MateLeaps(bodies, 1e3, 1.0, lambda: True)
    assert not leaps.undo()
    for _ in range(30):
        bodies.next_mate()
        leaps.take()
    assert bodies.mate == 31 + 7  # a quarter of 30
    bodies.next_mate()
    leaps.take()
    assert leaps.undo() and not leaps.undo()
    assert bodies.mate == 31 and np.array_equal(bodies.area, 30 * Alike.work)
    assert (bodies.cycles, bodies.removed) == (3000.0, 45.0)
    for _ in range(2):
        bodies.next_mate()
        leaps.take()
    assert bodies.mate == 33 + 3  # the next one is half as long
    for _ in range(2):
        bodies.next_mate()
        leaps.settled += 1
    assert not leaps.undo()


def problem(*settings):
    case = wearsim.load_case(TABLES, settings)
    return wrap_task(case, wrap_of(case).contact(case))


@pytest.fixture
def in_full(monkeypatch):
    """Return what runs a sprocket without leaps."""

    def run(case):
        with monkeypatch.context() as patch:
            patch.setattr(implicit_steps, "BY_STAGES", replace(implicit_steps.BY_STAGES, leap=0.0))
            return implicit_steps.run_seated(case, 0)

    return run


def test_a_life_with_leaps_is_that_without_to_its_stated_error(in_full):
    case = problem(MANY)
    run, error = advance_resting(case, math.inf)
    full = in_full(case)
    assert full.mates[-1] > 60
    assert run.updates < 0.8 * full.updates
    assert run.met is not None and run.met == full.met
    assert run.cycles[-1] == pytest.approx(full.cycles[-1], rel=min(error, 0.02))
    assert run.area == pytest.approx(full.area, rel=0.02)


def test_every_chain_leapt_over_has_lived_its_life():
    case = problem(MANY)
    run, contact = implicit_steps.run_seated(case, 0), case.contact
    ends = np.flatnonzero(np.diff(run.mates) > 0.0)
    assert np.diff(run.cycles).min() > 0.0 and np.diff(run.mates).max() >= 1.0
    assert run.cycles[ends] == pytest.approx(run.mates[ends] * contact.cycles_per_mate, rel=1e-6)
    assert run.elongation[ends] == pytest.approx(contact.elongation_limit, rel=1e-6)
    # Depth follows from area, to rounding.
    assert np.diff(run.all_depth, axis=0).min() >= -1e-15


def test_a_horizon_is_met_after_leaps():
    case = problem(MANY, "stop.critical_depth_mm=0.5")
    horizon = 47.5 * case.contact.cycles_per_mate
    run = implicit_steps.run_seated(replace(case, horizon=horizon), 0)
    assert run.met is None
    assert run.cycles[-1] == pytest.approx(horizon, rel=1e-9)
    assert run.mates[-1] == 48


def test_few_chains_are_run_to_the_bit_as_without_leaps(in_full):
    case = problem("joint.specific_wear_rate_mm2_per_N=1.5e-7")
    run, full = implicit_steps.run_seated(case, 0), in_full(case)
    assert 10 < run.mates[-1] <= 30
    assert np.array_equal(run.cycles, full.cycles) and np.array_equal(run.all_depth, full.all_depth)
