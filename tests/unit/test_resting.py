"""Kernels of resting contacts on arcs, steps and stop limits of the engine, errors, and engagements."""

from dataclasses import replace

import numpy as np
import pytest

from tests.drives import depth_limit
from wearsim.contact.engagement import ContactKind
from wearsim.contact.resting_engagement import NEW_MATE, MateWear, RestingContact
from wearsim.contact.stop_limits import StopLimit
from wearsim.errors import ContactError, ConvergenceError, JumpError
from wearsim.geometry.profile_points import Profile
from wearsim.kernels import event_rows as kernels
from wearsim.kernels import wrap_wear as engine
from wearsim.wear.implicit_steps import run_resting, run_seated
from wearsim.wear.law import archard, drozdov
from wearsim.wear.loop import run_per_cycle
from wearsim.wear.problem import StartState, WearProblem

MODULUS = 2.1e5 / (2.0 * 0.91)
RATE = 1e-11
LAW = archard(RATE)
LIMIT = (depth_limit(2e-3),)
PLACE = {"load": 100.0, "slip": 1.0, "speed": 50.0, "count": 1.0}


class Seat(RestingContact):
    """A roller of 5 mm in the middle of a round seat of 8 mm, on every body."""

    elongation_per_cycle = 0.0
    elongation_limit = 0.02
    slack_tension = 0.0
    modulus = MODULUS
    mate_radius = 5.0

    def __init__(self, bodies=1, points=151, growth=0.0, **event):
        angle = np.linspace(0.2, -0.2, points)
        self.profile_ = Profile(8.0 * np.sin(angle), 8.0 * (1.0 - np.cos(angle)))
        self.bodies_, self.points, self.event = bodies, points, {**PLACE, **event}
        self.elongation_per_cycle = growth
        self.seen = []

    @property
    def profile(self):
        return self.profile_

    @property
    def bodies(self):
        return self.bodies_

    def coarsened(self):
        return Seat(self.bodies, (self.points + 1) // 2, self.elongation_per_cycle, **self.event)

    def memory(self):
        return np.zeros((1, 1))

    def events(self, x, y, wear, memory, at=0.5):
        self.seen.append(wear.elongation)
        memory += 1.0
        table = np.zeros((kernels.EVENT_ROWS, self.bodies))
        table[kernels.EVENT_CENTRE_Y] = 5.0
        table[kernels.EVENT_NORMAL_Y] = 1.0
        table[kernels.EVENT_TOUCHED] = 0.5 * (self.points - 1)
        table[kernels.EVENT_LOAD] = self.event["load"]
        table[kernels.EVENT_SLIP] = self.event["slip"]
        table[kernels.EVENT_SPEED] = self.event["speed"]
        table[kernels.EVENT_COUNT] = self.event["count"]
        table[kernels.EVENT_BODY] = np.arange(self.bodies)
        return table


# -- kernels -------------------------------------------------------------------------------------


def arc(radius, points=101, convex=False):
    """A seat of that radius or, convex, a nose."""
    angle = np.linspace(0.3, -0.3, points)
    sign = -1.0 if convex else 1.0
    return Profile(radius * np.sin(angle), sign * radius * (1.0 - np.cos(angle)))


def unworn(profile):
    points = profile.x.size
    spacing = np.zeros(points)
    half = 0.5 * np.diff(profile.arc_length)
    spacing[1:] += half
    spacing[:-1] += half
    return np.array([profile.x, profile.y, profile.normal_x, profile.normal_y, profile.curvature, spacing])


@pytest.mark.parametrize("convex", [False, True])
def test_recede_from_the_area(convex):
    """Between arcs of 8 and 8 +- d mm the area per unworn length is d +- d^2/16."""
    profile, depth = arc(8.0, convex=convex), 0.3
    sign = -1.0 if convex else 1.0
    area = np.full(101, depth + sign * depth**2 / 16.0)
    found, x, y = np.zeros(101), np.zeros(101), np.zeros(101)
    engine.recede(area, found, x, y, unworn(profile), 0, 101)
    np.testing.assert_allclose(found, depth, rtol=1e-4)
    radius = np.hypot(x, y - sign * 8.0)
    np.testing.assert_allclose(radius, 8.0 + sign * depth, rtol=1e-4)


def test_recede_only_the_cells_asked():
    profile = arc(8.0)
    found, x, y = np.zeros(101), np.zeros(101), np.zeros(101)
    engine.recede(np.full(101, 0.1), found, x, y, unworn(profile), 40, 60)
    assert (found[40:60] > 0.09).all()
    assert not found[:40].any() and not found[60:].any()


def test_worn_width():
    """Cells of a seat worn all over grow with the radius; on a slope they grow by the hypotenuse."""
    profile = arc(8.0)
    table, width = unworn(profile), np.zeros(101)
    engine.worn_width(np.full(101, 0.4), table, 0, 101, width)
    np.testing.assert_allclose(width[1:-1], table[engine.SPACING, 1:-1] * 8.4 / 8.0, rtol=1e-4)
    flat = Profile(np.linspace(1.0, -1.0, 101), np.zeros(101))
    engine.worn_width(0.75 * (1.0 - flat.x), unworn(flat), 0, 101, width)
    np.testing.assert_allclose(width[2:-2], 0.02 * 1.25, rtol=1e-9)


# -- steps ---------------------------------------------------------------------------------------


def test_limit_is_met_exactly_and_the_last_step_is_cut():
    run = run_resting(WearProblem(Seat(), LAW, LIMIT, 1e9), 0)
    assert run.met is LIMIT[0]
    assert run.depth[-1].max() == pytest.approx(2e-3, rel=1e-12)
    assert (np.diff(run.cycles) > 0.0).all()
    assert run.area == pytest.approx(RATE * 100.0 * run.cycles[-1], rel=2e-3)


def test_horizon_is_met_exactly():
    run = run_resting(WearProblem(Seat(), LAW, LIMIT, 17.25), 0)
    assert run.met is None
    assert run.cycles[-1] == 17.25


def test_first_step_is_small_whatever_the_law():
    """A part of 3e-5 of the limit by the Hertz pressure on a flat, far less in a narrow seat."""
    for law in (LAW, drozdov(1e-9, 1.0, 2000.0, 100.0, 0.8), drozdov(1e-6, 2.0, 2000.0, 1.0, -1.0)):
        once = iter([True])
        run = run_resting(
            WearProblem(Seat(count=1e-3), law, (depth_limit(1e-4),), 1e15),
            0,
            watch=lambda part, once=once: next(once, False),
        )
        assert run.updates == 1
        first = run.depth[-1].max()
        assert 0.0 < first < 4e-5 * 1e-4


@pytest.mark.parametrize("count", [0.5, 2.0])
def test_how_often_an_event_comes(count):
    once, other = (run_resting(WearProblem(Seat(count=n), LAW, LIMIT, 1e9), 2) for n in (1.0, count))
    assert other.cycles[-1] == pytest.approx(once.cycles[-1] / count, rel=1e-9)


@pytest.mark.parametrize("exponent", [0.5, -0.3])
def test_speed_enters_by_its_power(exponent):
    """Drozdov's form at v = v0 is the power law; at 9 v0 it is 9^n times that."""
    law = drozdov(1000.0 * RATE, 1.0, 1000.0, 50.0, exponent)
    base, fast = (run_resting(WearProblem(Seat(speed=v), law, LIMIT, 1e9), 2) for v in (50.0, 450.0))
    line = run_resting(WearProblem(Seat(), LAW, LIMIT, 1e9), 2)
    assert base.cycles[-1] == pytest.approx(line.cycles[-1], rel=1e-8)
    assert fast.cycles[-1] == pytest.approx(base.cycles[-1] / 9.0**exponent, rel=1e-6)


def test_two_bodies_under_one_load_wear_alike():
    run = run_resting(WearProblem(Seat(bodies=2), LAW, LIMIT, 1e9), 0)
    np.testing.assert_array_equal(run.all_depth[:, 0], run.all_depth[:, 1])
    one = run_resting(WearProblem(Seat(), LAW, LIMIT, 1e9), 0)
    assert run.area == pytest.approx(2.0 * one.area, rel=1e-12)


def test_the_limit_that_is_met_first_is_named():
    tip = StopLimit("min_tip_land_mm", 1.0, lambda x, y, depth: 1e-3 - float(depth.max()))
    run = run_resting(WearProblem(Seat(), LAW, (*LIMIT, tip), 1e9), 0)
    assert run.met is tip
    assert run.depth[-1].max() == pytest.approx(1e-3, rel=1e-12)


def test_chain_grows_and_is_replaced():
    """2 % in 8 cycles: steps end on every replacement, and events meet the growth so far."""
    contact = Seat(growth=0.0025)
    run = run_resting(WearProblem(contact, LAW, (depth_limit(1.0),), 20.0), 0)
    assert run.mates[-1] == 3.0
    np.testing.assert_allclose(
        run.elongation, 0.0025 * (run.cycles - 8.0 * (run.mates - 1.0)), rtol=0.0, atol=1e-12
    )
    for end in (8.0, 16.0):
        assert np.isclose(run.cycles, end).any()
    assert max(contact.seen) < 0.02
    # At least 40 steps in the life of a chain.
    assert run.updates >= 2.5 * 40


def test_snapshots_are_thinned_and_keep_both_ends():
    run = run_resting(WearProblem(Seat(), archard(1e3 * RATE), (depth_limit(1.0),), 2000.0), 0, 1.0)
    assert run.updates == 2000
    assert 180 <= run.cycles.size <= 362
    assert (run.cycles[0], run.cycles[-1]) == (0.0, 2000.0)
    assert run.elongation.size == run.mate_depth.size == run.mates.size == run.cycles.size
    assert (run.sliding_speed[1:] == 50.0).all()


def test_the_end_of_the_first_chain_is_kept():
    """At cycle 301 of 3000, an odd snapshot that thinning would drop."""
    contact = Seat(growth=0.02 / 301)
    run = run_resting(WearProblem(contact, archard(1e3 * RATE), (depth_limit(1.0),), 3000.0), 0, 1.0)
    end = int(np.abs(run.cycles - 301.0).argmin())
    assert run.cycles[end] == pytest.approx(301.0, rel=1e-9)
    assert (run.mates[end], run.mates[-1]) == (1.0, 10.0)
    assert run.elongation[end] == pytest.approx(0.02, rel=1e-9)


def test_a_run_begun_worn_goes_on():
    """Two halves are the whole where the steps are the same."""
    law, limit = archard(1e4 * RATE), (depth_limit(1.0),)
    whole = run_resting(WearProblem(Seat(growth=1e-4), law, limit, 100.0), 0, 1.0)
    first = run_resting(WearProblem(Seat(growth=1e-4), law, limit, 50.0), 0, 1.0)
    start = StartState(first.all_depth[-1], MateWear(float(first.elongation[-1])), 1)
    second = run_resting(WearProblem(Seat(growth=1e-4), law, limit, 50.0, start), 0, 1.0)
    np.testing.assert_allclose(second.depth[-1], whole.depth[-1], rtol=0.0, atol=1e-4 * whole.depth.max())
    assert second.elongation[-1] == pytest.approx(whole.elongation[-1], rel=1e-12)


def test_a_run_can_be_stopped():
    run = run_resting(WearProblem(Seat(), LAW, LIMIT, 1e9), 0, watch=lambda part: False)
    assert (run.updates, run.met) == (0, None)


def test_per_cycle_goes_event_by_event():
    law = archard(1e4 * RATE)
    per_cycle = run_per_cycle(WearProblem(Seat(), law, LIMIT, 1e9), 10)
    assert per_cycle.updates == np.ceil(0.1 * per_cycle.cycles[-1]) > 5
    fine = run_resting(WearProblem(Seat(), LAW, LIMIT, 1e9), 3)
    assert 1e4 * per_cycle.cycles[-1] == pytest.approx(fine.cycles[-1], rel=0.02)


def test_contacts_of_events_alone_have_no_stages():
    with pytest.raises(NotImplementedError, match="Seat can only be worn event by event"):
        run_seated(WearProblem(Seat(), LAW, LIMIT, 1e9), 0)


# -- errors --------------------------------------------------------------------------------------


@pytest.mark.parametrize("quantity", ["load", "slip", "count"])
def test_nothing_to_wear_is_an_error(quantity):
    with pytest.raises(ContactError, match="contact at cycle 0: a loaded mate must slide"):
        run_resting(WearProblem(Seat(**{quantity: 0.0}), LAW, LIMIT, 1e9), 0)


@pytest.mark.parametrize("quantity", ["load", "slip"])
def test_not_a_number_is_an_error(quantity):
    with pytest.raises((ContactError, ConvergenceError)):
        run_resting(WearProblem(Seat(**{quantity: np.nan}), LAW, LIMIT, 1e9), 0, 1.0)


def test_a_roller_out_of_reach_is_an_error():
    """Pressed sideways, the roller meets no point."""
    contact = Seat()
    table = contact.events(None, None, NEW_MATE, contact.memory())
    table[kernels.EVENT_NORMAL_X], table[kernels.EVENT_NORMAL_Y] = 1.0, 0.0
    table[kernels.EVENT_CENTRE_X] = -50.0
    contact.events = lambda *arguments: table
    with pytest.raises(ConvergenceError, match="the pressure of every mate must be found"):
        run_resting(WearProblem(contact, LAW, LIMIT, 1e9), 0)


class Jumping(Seat):
    """The chain jumps from a growth of 1 % on."""

    slack_tension = 30.0

    def events(self, x, y, wear, memory, at=0.5):
        if wear.elongation >= 0.01:
            raise JumpError("the chain jumps")
        return super().events(x, y, wear, memory, at)


def test_a_jump_ends_the_life():
    """With 1e-4 per cycle the last step begins before 100 cycles and ends after."""
    run = run_resting(WearProblem(Jumping(growth=1e-4), LAW, (depth_limit(1.0),), 1e9), 0)
    assert run.met is not None
    assert (run.met.name, run.met.limit) == ("min_slack_tension_N", 30.0)
    assert (np.diff(run.cycles) > 0.0).all()
    assert run.cycles[-1] == pytest.approx(100.0, rel=0.03)
    assert run.elongation[-1] == pytest.approx(0.01, rel=0.03)


def test_a_jump_at_once_is_an_error():
    start = StartState(np.zeros((1, 151)), MateWear(0.015), 1)
    with pytest.raises(JumpError):
        run_resting(WearProblem(Jumping(growth=1e-4), LAW, LIMIT, 1e9, start), 0)


# -- engagement ----------------------------------------------------------------------------------


def test_engagement_of_a_worn_outline():
    """Roller of 5 mm in a seat of 8 mm: 1/5 - 1/8; touched in the middle once per cycle."""
    contact = Seat(bodies=2)
    profile = contact.profile
    met = contact.engage(np.array(profile.x), np.array(profile.y), np.zeros(151))
    assert met.kind is ContactKind.RESTING
    np.testing.assert_allclose(met.relative_curvature[1:-1], 0.075, rtol=1e-3)
    assert np.flatnonzero(met.load_per_width).tolist() == [75]
    values = met.load_per_width[75], met.slip[75], met.per_cycle[75], met.sliding_speed[75]
    assert values == (100.0, 1.0, 1.0, 50.0)
    assert np.isnan(met.sliding_speed[74])
    np.testing.assert_array_equal(met.arc_length, contact.arc_length)


def test_engagement_without_load():
    met = Seat(load=0.0).engage(*(np.array(v) for v in (Seat().profile.x, Seat().profile.y)), np.zeros(151))
    assert not met.load_per_width.any() and not met.slip.any() and not met.per_cycle.any()


class Pocket(Seat):
    """A roller between two flanks 40 degrees from its load: it touches at both, far from the middle."""

    def __init__(self, **event):
        super().__init__(**event)
        x = np.linspace(7.0, -7.0, 561)
        slope = np.tan(np.radians(40.0))
        self.points = 561
        self.profile_ = Profile(x, slope * np.hypot(x, 0.5))

    def events(self, x, y, wear, memory, at=0.5):
        table = super().events(x, y, wear, memory, at)
        table[kernels.EVENT_CENTRE_Y] = 5.0 / np.cos(np.radians(40.0))
        return table


def test_a_roller_in_a_pocket_wears_both_sides():
    """Each flank carries load/(2 cos 40 degrees), 3.2 mm from the middle, and wears as much."""
    law, cycles = archard(1e-9), 1.0
    run = run_resting(WearProblem(Pocket(), law, (depth_limit(1.0),), cycles), 0, cycles)
    depth, profile = run.depth[-1], Pocket().profile
    touched = np.abs(profile.x[depth > 0.0])
    assert (np.abs(touched - 5.0 * np.sin(np.radians(40.0))) < 0.2).all()
    area = 1e-9 * cycles * 100.0 / np.cos(np.radians(40.0))
    assert run.area == pytest.approx(area, rel=3e-3)
    left = depth[profile.x < 0.0].sum()
    assert left == pytest.approx(depth[profile.x > 0.0].sum(), rel=1e-6)


# -- rollers -------------------------------------------------------------------------------------


def test_area_worn_off_a_roller():
    """A roller of 5 mm that loses pi (25 - 16) mm2 of its section has 4 mm left."""
    seat = Seat(growth=1e-4)
    seat.mate_area_ratio = 2.0
    after = seat.mate_after(MateWear(0.01, 0.0), 50.0, 0.5 * np.pi * 9.0)
    assert after.elongation == pytest.approx(0.015, rel=1e-12)
    assert after.depth == pytest.approx(1.0, rel=1e-12)
    seat.thinnest_mate = 4.01
    with pytest.raises(ContactError, match="worn through at an elongation of 1 %"):
        seat.mate_after(MateWear(0.01, 0.0), 50.0, 0.5 * np.pi * 9.0)


class Rubbed(Seat):
    """Remembers the chain of every step."""

    mate_area_ratio = 3.0

    def events(self, x, y, wear, memory, at=0.5):
        self.worn = wear
        return super().events(x, y, wear, memory, at)


@pytest.mark.parametrize("bodies", [1, 2])
def test_rollers_lose_their_share_of_what_a_gap_loses(bodies):
    contact = Rubbed(bodies)
    run = run_resting(WearProblem(contact, LAW, LIMIT, 1e9), 1)
    lost = np.pi * (5.0**2 - (5.0 - run.mate_depth[-1]) ** 2)
    # The last step was cut back to the limit; what it left is linear in its part.
    assert lost == pytest.approx(3.0 * run.area / bodies, rel=1e-4)
    assert (np.diff(run.mate_depth) > 0.0).all()


def test_a_soft_core_of_the_tooth_does_not_soften_the_roller():
    """Below a layer of no depth the tooth wears five times as fast, its roller as before."""
    law = replace(LAW, case_depth=1e-12, core_factor=5.0)
    run = run_resting(WearProblem(Rubbed(), law, LIMIT, 1e9), 2)
    lost = np.pi * (5.0**2 - (5.0 - run.mate_depth[-1]) ** 2)
    assert lost == pytest.approx(3.0 * run.area / 5.0, rel=1e-3)


def test_a_new_chain_brings_new_rollers():
    run = run_resting(WearProblem(Rubbed(growth=1e-7), LAW, LIMIT, 1e9), 0)
    assert run.mates[-1] > 2.0
    starts = np.flatnonzero(np.diff(run.mates) > 0.0) + 1
    assert (run.mate_depth[starts] < run.mate_depth[starts - 1]).all()
