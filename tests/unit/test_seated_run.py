"""Rollers on an elastic foundation that wears: kernels on closed forms, steps, order and errors."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.optimize import approx_fprime

import wearsim
from tests.drives import depth_limit
from wearsim.contact.hertz import half_width, peak_pressure
from wearsim.contact.resting_engagement import NEW_MATE
from wearsim.contact.stop_limits import StopLimit
from wearsim.errors import ContactError, ConvergenceError
from wearsim.kernels import wrap_stage as stage
from wearsim.kernels import wrap_yielding_seats as seats
from wearsim.mechanisms.wrap.seating import phases_of_pitch
from wearsim.wear import settled_run
from wearsim.wear.implicit_steps import run_resting, run_seated
from wearsim.wear.law import archard, drozdov, power
from wearsim.wear.problem import WearProblem
from wearsim.wear.resting_bodies import WornBodies
from wearsim.wear.seated_bodies import SeatedBodies
from wearsim.wear.settled_run import advance_resting, outlives, run_together, spared

TABLES = {
    "format_version": 1,
    "chain": {"designation": "ANSI 40"},
    "sprocket": {"teeth": 20, "profile": "ansi_b29", "nodes": 301},
    "mechanism": {"kind": "wrap", "phases": 4},
    "drive": {"mate_teeth": 20, "links": 114, "slack_tension_N": 50},
    "load": {"tension_N": 1000, "speed_rpm": 100},
    "wear": {"specific_wear_rate_mm2_per_N": 1e-9},
    "stop": {"critical_depth_mm": 0.05},
}
LIMIT = (depth_limit(0.05),)
LAW = archard(1e-9)


def contact(*settings):
    case = wearsim.load_case(TABLES, settings)
    return case.drive.contact(case)


def life(run):
    return float(run.cycles[-1])


# -- kernels -------------------------------------------------------------------------------------


def test_springs_press_as_hertz_does():
    """A roller of 4 mm at 100 N/mm on a flat with E* = 1e5 MPa, found with the width that it makes."""
    load, radius, modulus, cells = 100.0, 4.0, 1e5, 801
    half = half_width(load, 1.0 / radius, modulus)
    x = np.linspace(-2.0 * half, 2.0 * half, cells)
    width = np.full(cells, x[1] - x[0])
    compliance, out = np.zeros(cells), np.zeros(8)
    low, high, pressed = 0.0, half, 0.1 * half
    for _ in range(60):
        stage.springs(pressed, width[0], 0.5 * (cells - 1), modulus, 0, cells, compliance)
        low, high = 0.0, half
        for _ in range(60):
            sink = 0.5 * (low + high)
            seats.foundation_force(
                x,
                np.zeros(cells),
                width,
                compliance,
                np.zeros(cells),
                np.zeros(cells),
                0,
                cells,
                radius,
                0.0,
                radius - sink,
                np.zeros((3, cells + 2)),
                np.zeros(cells),
                np.zeros(cells),
                out,
            )
            low, high = (low, sink) if out[1] > load else (sink, high)
        pressed = 0.5 * out[6]
    assert pressed == pytest.approx(half, rel=0.02)
    over = radius - np.hypot(x, radius - sink)
    assert over.max() / compliance[cells // 2] == pytest.approx(
        peak_pressure(load, 1.0 / radius, modulus), rel=0.02
    )


def test_spread_keeps_the_area_and_moves_its_middle():
    """0.8 mm2 in two cells of 1 mm, spread from 2 cells before to 4 after: the middle moves by 1."""
    cells = 40
    unworn, density, sums = np.ones((6, cells)), np.zeros(cells), np.zeros((4, cells + 1))
    sums[stage._MASSES, [20, 21]] = 0.6, 0.2
    stage.spread(20, 22, 2.0, 4.0, unworn, density, sums)
    place = np.arange(cells)
    assert density.sum() == pytest.approx(0.8, rel=1e-12)
    assert (density * place).sum() / 0.8 == pytest.approx(20.25 + 1.0, rel=1e-12)
    # Variances add up: 6^2/12 of the sweep, that of the cells before, and 1/12 twice of their widths.
    expected = 3.0 + 0.1875 + 1.0 / 6.0
    assert (density * (place - 21.25) ** 2).sum() / 0.8 == pytest.approx(expected, rel=1e-12)
    assert density.min() >= -1e-15


def test_pull_of_the_rollers_is_the_slope_of_the_energy():
    """Central differences of the energy of three rollers on a seat."""
    of = contact("mechanism.friction_roller_tooth=0.2", "mechanism.friction_roller_bush=0.4")
    bodies = WornBodies(WearProblem(of, LAW, LIMIT, 1e12))
    places = of.seating(np.array([1e-9, 1.0, 0.0, np.inf, 1.0]), bodies.unworn)
    places.seat(bodies.area, bodies.x, bodies.y, NEW_MATE)
    mechanism, points = of.mechanism, bodies.unworn.shape[1]
    rollers, work = 3, np.zeros((seats.SEAT_WORK_ROWS, of.most_rollers))
    cells = np.zeros((seats.CELL_ROWS + 2 * rollers, points))
    work[seats._HIGH, :rollers] = points
    compliance, raised = np.full((rollers, points), 1e-6), np.zeros((rollers, points))
    start = places.places[:, :rollers].copy()
    seats.point_pulls(mechanism.constants(0.01), 0.1, 0.2, cells[seats._PULLS])

    def energy(place):
        work[seats._TRIAL_X : seats._TRIAL_Y + 1, :rollers] = place.reshape(2, rollers)
        return seats.wrap_balance(
            0,
            rollers,
            0,
            mechanism.constants(0.01),
            bodies.x,
            bodies.y,
            np.tile(bodies.unworn[5], (of.bodies, 1)),
            compliance,
            np.zeros((of.bodies, points)),
            raised,
            of.mate_radius,
            of.face_width,
            places.seats,
            work,
            cells,
        )

    slope = approx_fprime(start.ravel(), energy, 1e-7)
    energy(start.ravel())
    pull = work[[seats._RIGHT_X, seats._RIGHT_Y], :rollers].ravel()
    assert np.abs(pull).max() > 10.0
    np.testing.assert_allclose(-slope, pull, atol=1e-3 * np.abs(pull).max())


@pytest.mark.parametrize(("wrap", "count"), [(2.5, 4), (3.01, 8), (7.0, 6), (2.3, 1)])
def test_phases_hold_the_whole_pitch(wrap, count):
    place, weight = phases_of_pitch(wrap, 1.0, count)
    assert place.size == weight.size == count
    assert weight.sum() == pytest.approx(1.0, rel=1e-12)
    assert (np.diff(place) > 0.0).all() and place[0] > 0.0 and place[-1] < 1.0


def straight_wrap(degrees, tension, nodes, teeth):
    """An idler that two spans of nearly the same small tension wrap over a few degrees."""
    found = contact(
        f"sprocket.nodes={nodes}", f"sprocket.teeth={teeth}", "drive.joint_friction=0", "mechanism.phases=6"
    )
    block, mechanism = found.blocks[0], found.mechanism
    pull = replace(mechanism.pull, tight=1.0001 * tension, slack=tension)
    mechanism = replace(mechanism, wrap_angle=math.radians(degrees), pull=pull)
    return replace(found, blocks=(replace(block, mechanism=mechanism),))


@pytest.mark.parametrize("nodes", [41, 101, 201])
@pytest.mark.parametrize(
    ("degrees", "tension", "teeth"),
    [
        (23.06, 60.2, 20),
        (4.77, 60.2, 14),
        (17.56, 9.9, 14),
        (36.45, 15.0, 34),
        (43.15, 6.9, 20),
        (9.5, 2.0, 40),
    ],
)
def test_lightly_pulled_wraps_are_found_and_bear_the_strands(nodes, degrees, tension, teeth):
    """The rounding of their energy is above 1e-11 of it. Teeth and strands balance in each phase."""
    bodies = SeatedBodies(WearProblem(straight_wrap(degrees, tension, nodes, teeth), LAW, LIMIT, 1e12))
    bodies._seat()
    seating, mechanism = bodies.seating, bodies.contact.mechanism
    angle, event = mechanism.pitch_angle, 0
    for _ in range(seating.kinds):
        for phase in seating.phases[0]:
            rollers = mechanism.rollers(float(phase))
            x, y = seating.seats[[seats.LOAD_X, seats.LOAD_Y], event : event + rollers]
            turn = angle * np.arange(rollers)
            on_teeth = bodies.contact.face_width * np.array(
                [(np.cos(turn) * x + np.sin(turn) * y).sum(), (np.cos(turn) * y - np.sin(turn) * x).sum()]
            )
            tight = angle * (phase - 0.5)
            slack = math.radians(degrees) - tight
            strands = mechanism.pull.tight * np.array([-math.cos(tight), -math.sin(tight)])
            strands += mechanism.pull.slack * np.array([math.cos(slack), -math.sin(slack)])
            assert on_teeth == pytest.approx(-strands, abs=1e-5 * tension)
            event += seating.most


# -- runs ----------------------------------------------------------------------------------------


def test_rollers_rest_as_on_rigid_teeth_but_for_what_these_yield():
    of = contact("mechanism.friction_roller_tooth=0.1", "mechanism.friction_roller_bush=0.2")
    bodies = WornBodies(WearProblem(of, LAW, LIMIT, 1e12))
    places = of.seating(np.array([1e-9, 1.0, 0.0, np.inf, 1.0]), bodies.unworn)
    places.seat(bodies.area, bodies.x, bodies.y, NEW_MATE)
    phase = float(places.phases[0, 1])
    loads = of.mechanism.loads(phase)
    rollers = loads.force.size
    column = slice(of.most_rollers, of.most_rollers + rollers)
    found = of.face_width * np.hypot(*places.seats[seats.LOAD_X : seats.LOAD_Y + 1, column])
    np.testing.assert_allclose(found, loads.force, atol=0.02 * loads.force.max())


@pytest.mark.wide
def test_life_by_the_loop_over_events_with_small_steps():
    """Half-space and rigid places, first order: within 2 % of each other."""
    of = contact()
    loop = run_resting(WearProblem(of, LAW, LIMIT, 1e12), 2)
    assert life(run_seated(WearProblem(of, LAW, LIMIT, 1e12), 1)) == pytest.approx(life(loop), rel=0.02)


@pytest.mark.wide
@pytest.mark.wide
@pytest.mark.parametrize(
    "law",
    [
        power(3e-12, 1.5),
        drozdov(1e-4, 1.2, 2000.0, 100.0, 0.5),
        archard(1e-9).__class__(1e-9, 1.0, 0.0, case_depth=0.02, core_factor=4.0),
    ],
    ids=["power", "speed", "hard layer"],
)
def test_laws_by_the_loop_over_events(law):
    of = contact()
    loop = run_resting(WearProblem(of, law, LIMIT, 1e15), 1)
    assert life(run_seated(WearProblem(of, law, LIMIT, 1e15), 1)) == pytest.approx(life(loop), rel=0.04)


@pytest.mark.wide
def test_shorter_steps_and_more_phases_hardly_move_a_life():
    """Usual steps, four phases: within 0.1 % of steps an eighth as long, 0.3 % of three times the phases."""
    usual = life(run_seated(WearProblem(contact(), LAW, LIMIT, 1e12), 0))
    assert usual == pytest.approx(life(run_seated(WearProblem(contact(), LAW, LIMIT, 1e12), 3)), rel=1e-3)
    assert usual == pytest.approx(
        life(run_seated(WearProblem(contact("mechanism.phases=12"), LAW, LIMIT, 1e12), 0)), rel=3e-3
    )


def test_area_closes():
    """The work of all pressures is what is missing of the outline, and k times load times way."""
    run = run_seated(WearProblem(contact(), LAW, LIMIT, 1e12), 0)
    of = contact()
    missing = sum(
        wearsim.geometry.profile_points.area_between(of.profile.x, of.profile.y, x, y)
        for x, y in zip(*of.profile.receded(run.all_depth[-1]), strict=True)
    )
    assert run.area == pytest.approx(missing, rel=1e-3)


def test_twice_the_rate_is_half_the_life():
    of = contact("joint.specific_wear_rate_mm2_per_N=1e-16")
    one, two = (life(run_seated(WearProblem(of, archard(k), LIMIT, 1e12), 0)) for k in (1e-9, 2e-9))
    assert one == pytest.approx(2.0 * two, rel=1e-6)


def test_horizon_limit_and_watch():
    of = contact()
    run = run_seated(WearProblem(of, LAW, LIMIT, 1e6), 0)
    assert run.met is None and run.cycles[-1] == 1e6
    whole = run_seated(WearProblem(of, LAW, LIMIT, 1e12), 0)
    assert whole.met is LIMIT[0] and whole.depth[-1].max() == pytest.approx(0.05, rel=1e-12)
    assert run_seated(WearProblem(of, LAW, LIMIT, 1e12), 0, watch=lambda part: False).updates == 0


def test_nothing_to_wear_is_an_error():
    with pytest.raises(ContactError, match="contact at cycle 0: a loaded roller must slide"):
        run_seated(WearProblem(contact(), archard(0.0), LIMIT, 1e12), 0)


def test_one_failing_run_fails_all_and_progress_rises():
    of, told = contact(), []
    problem = WearProblem(of, LAW, LIMIT, 1e12)
    run_together([(problem, -1), (problem.on(of.coarsened()), -1)], told.append)
    assert told == sorted(told) and told[0] == 0.0 and 0.9 < told[-1] <= 1.0
    with pytest.raises(ContactError):
        run_together([(WearProblem(of, archard(0.0), LIMIT, 1e12), -1)])


@pytest.mark.wide
def test_steps_are_halved_where_the_error_asks_for_it():
    of, told = contact(), []
    loose, error = advance_resting(WearProblem(of, LAW, LIMIT, 1e12), 0.1)
    tight, less = advance_resting(WearProblem(of, LAW, LIMIT, 1e12), 0.8 * error, progress=told.append)
    assert told == sorted(told) and (told[0], told[-1]) == (0.0, 1.0)
    assert error <= 0.1 and tight.updates > 1.5 * loose.updates
    assert life(tight) == pytest.approx(life(loose), rel=error + less)


@pytest.mark.parametrize(
    ("halved", "finer_first"),
    [((0.05, 0.055), [(1, 0), (1, 1)]), ((0.08, 0.01), [(1, 0)])],
    ids=["they stop helping", "as much again would not do"],
)
def test_phases_are_doubled_where_halved_steps_do_not_help(monkeypatch, halved, finer_first):
    """Errors by phases and halvings stand for runs; coarse ones go ahead, until 0.02 or nothing is left."""
    stated = {(1, 0): 0.09, (1, 1): halved[0], (1, 2): halved[1], (2, 1): 0.03, (2, 2): 0.01}
    of, finer = contact("mechanism.phases=2"), []

    def alone(problem, level, watch):
        watch(1.0)
        phases, fine = problem.contact.phases, problem.contact.profile.x.size == of.profile.x.size
        if fine:
            finer.append((phases // 2, level))
        return SimpleNamespace(met="a limit", stated=(phases // 2, level) if fine else (phases, level + 1))

    def together(problems, report):
        return [alone(problem, level, report) for problem, level in problems]

    monkeypatch.setattr(settled_run, "run_together", together)
    monkeypatch.setattr(settled_run, "run_seated", alone)
    monkeypatch.setattr(settled_run, "_SAFETY", 1.0)
    monkeypatch.setattr(settled_run, "_AT_LEAST", 0.0)
    monkeypatch.setattr(settled_run, "difference", lambda run, coarse: stated[coarse.stated])
    monkeypatch.setattr(settled_run, "spared", lambda run, limit, error: error)
    for tolerance, finer_then, error in ((0.02, [(2, 1), (2, 2)], 0.01), (0.035, [(2, 1)], 0.03)):
        told = []
        run, left = advance_resting(WearProblem(of, LAW, LIMIT, 1e12), tolerance, told.append)
        assert finer == [*finer_first, *finer_then]
        assert (run.stated, left) == (finer[-1], error)
        assert told == sorted(told) and told[-1] == 1.0
        finer.clear()
    assert advance_resting(WearProblem(of, LAW, LIMIT, 1e12), 0.09)[1] == 0.09
    assert finer == [(1, 0)]


def test_a_bound_that_holds_is_not_run_again():
    """Half of a life: twice the depth would end it. At 0.995 of it a depth that is wrong by 1 % may."""
    of = contact()
    whole, error = advance_resting(WearProblem(of, LAW, LIMIT, 1e12), 0.1)
    for part, again in ((0.5, False), (0.995, True)):
        problem = WearProblem(of, LAW, LIMIT, part * life(whole))
        run, left = advance_resting(problem, 0.8 * error)
        assert outlives(problem, run, left) is not again
        assert (run.updates > 1.5 * run_seated(problem, 0).updates) is again


def test_a_bound_holds_where_every_limit_is_kept():
    """A limit that is 0.5 % deeper than the run at its horizon, beside that on the depth, twice as deep."""
    of = contact()
    half = 0.5 * life(run_seated(WearProblem(of, LAW, LIMIT, 1e12), 0))
    run = run_seated(WearProblem(of, LAW, LIMIT, half), 0)
    worn = float(run.depth[-1].max())
    assert 1.5 * worn < LIMIT[0].limit
    near = StopLimit("another", 1.005 * worn, lambda x, y, depth: 1.005 * worn - depth.max())
    problem = WearProblem(of, LAW, (*LIMIT, near), half)
    assert run_seated(problem, 0).met is None
    assert outlives(problem, run, 0.004)
    assert not outlives(problem, run, 0.006)
    assert outlives(WearProblem(of, LAW, LIMIT, half), run, 0.006)


def test_a_life_that_a_new_chain_has_spared_is_uncertain():
    """0.96 of the limit at 6 of 10 cycles, where the first chain ends: by 5 % it may have ended there."""
    trajectory = run_seated(WearProblem(contact(), LAW, LIMIT, 1e12), -1)
    worn = np.zeros((4, 1, 3))
    worn[:, 0, 1] = 0.0, 0.048, 0.048, 0.05
    run = replace(
        trajectory,
        cycles=np.array([0.0, 6.0, 7.0, 10.0]),
        mates=np.array([1.0, 1.0, 2.0, 2.0]),
        all_depth=worn,
    )
    assert spared(run, 0.05, 0.05) == pytest.approx(1.05 / 0.6 - 1.0, rel=1e-12)
    assert spared(run, 0.05, 0.03) == 0.03


def test_a_run_that_loses_its_rollers_keeps_what_is_worn(monkeypatch):
    """It ends where they were found last, with a bound for the life and the reason among the warnings."""
    whole = run_seated(WearProblem(contact(), LAW, LIMIT, 1e12), 0)
    step = SeatedBodies.step

    def losing(self, cycles):
        if self.updates >= 20:
            raise ConvergenceError("wear at cycle 1: the rollers must be found, but are not: use other nodes")
        return step(self, cycles)

    monkeypatch.setattr(SeatedBodies, "step", losing)
    lost = run_seated(WearProblem(contact(), LAW, LIMIT, 1e12), 0)
    assert lost.met is None
    assert lost.lost.startswith("wear at cycle 1")
    assert 0.0 < life(lost) < life(whole)
    place = int(np.searchsorted(whole.cycles, life(lost)))
    assert lost.depth[-1].max() == pytest.approx(whole.depth[place].max(), rel=1e-12)
    found = wearsim.simulate(wearsim.load_case(TABLES))
    assert isinstance(found.parts["sprocket"], wearsim.LowerBound)
    assert any("so its life is longer than stated: wear at cycle 1" in text for text in found.warnings)


def test_a_run_that_never_finds_its_rollers_fails(monkeypatch):
    def losing(self, cycles):
        raise ConvergenceError("the rollers must be found, but are not")

    monkeypatch.setattr(SeatedBodies, "step", losing)
    with pytest.raises(ConvergenceError, match="must be found"):
        run_seated(WearProblem(contact(), LAW, LIMIT, 1e12), 0)
