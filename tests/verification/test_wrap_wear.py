"""Wear of the gaps of a wrapped sprocket: what a gap meets in a revolution, and how it wears.

The drive is that of the printed tables: chain no. 40, 20 teeth by ANSI B29.1, 1000 N and 20 N, half
a turn of wrap, links of 5e4 N/mm, no friction; pitch radius 12.7/(2 sin 9 degrees) = 40.592 mm.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray

import wearsim
from tests.drives import depth_limit
from wearsim.contact.resting_engagement import NEW_MATE, MateWear
from wearsim.geometry.profile_points import area_between
from wearsim.kernels import event_rows as kernels
from wearsim.mechanisms.wrap.contact import WrapContact
from wearsim.mechanisms.wrap.wrap_mechanism import WrapLoads, WrapMechanism
from wearsim.wear.implicit_steps import RestingTrajectory, run_resting
from wearsim.wear.law import archard, power
from wearsim.wear.problem import StartState, WearProblem
from wearsim.wear.resting_bodies import highest_load

Array = NDArray[np.float64]

PITCH_RADIUS, ROLLER = 12.7 / (2.0 * math.sin(math.pi / 20)), 3.96
CASE = {
    "format_version": 1,
    "chain": {"designation": "ANSI 40"},
    "sprocket": {"teeth": 20, "profile": "ansi_b29", "nodes": 151},
    "mechanism": {"kind": "wrap", "phases": 4, "roller_slip_fraction": 0.1},
    "drive": {"mate_teeth": 20, "slack_tension_N": 20, "link_stiffness_N_per_mm": 5e4},
    "joint": {"pitch": "uniform", "specific_wear_rate_mm2_per_N": 1e-10},
    "load": {"tension_N": 1000, "speed_rpm": 100},
    "wear": {"specific_wear_rate_mm2_per_N": 5e-11},
}
COEFFICIENT = 1e-9
DEPTH = 0.1
ENDLESS = 1e12


@cache
def contact(*settings: str) -> WrapContact:
    case = wearsim.load_case(CASE, settings)
    return case.drive.contact(case)


def wear(
    of: WrapContact,
    level: int = 0,
    *,
    depth: float = DEPTH,
    horizon: float = ENDLESS,
    factor: float = 1.0,
    step: float = 0.0,
) -> RestingTrajectory:
    """Run until a depth or a horizon."""
    law = archard(COEFFICIENT * factor)
    return run_resting(WearProblem(of, law, (depth_limit(depth),), horizon), level, step)


def events(of: WrapContact, elongation: float = 0.0) -> Array:
    """Return rows of events as (row, kind of link, phase, roller) of unworn gaps."""
    outlines = (np.tile(values, (of.bodies, 1)) for values in (of.profile.x, of.profile.y))
    table = of.events(*outlines, MateWear(elongation), of.memory())
    return table.reshape(kernels.EVENT_ROWS, -1, of.phases, of.most_rollers)


def force(of: WrapContact, table: Array) -> Array:
    return table[kernels.EVENT_LOAD] * of.face_width


def pitch_angle(of: WrapContact) -> float:
    """Return 2 pi/z; teeth of two kinds are 20 here, all others 20 or 19."""
    hunting = of.mechanism.chain.alternating and of.bodies == 1
    return 2.0 * math.pi / (19 if hunting else 20)


def only(of: WrapContact, **sliding: float) -> WrapContact:
    """Return the contact with other fractions of sliding."""
    return replace(of, sliding=replace(of.sliding, **sliding))


# -- what a gap meets in a revolution ------------------------------------------------------------

KINDS = pytest.mark.parametrize(
    "settings",
    [(), ("joint.pitch='alternating'",), ("joint.pitch='alternating'", "sprocket.teeth=19")],
    ids=["uniform", "alternating", "hunting"],
)


def test_teeth_told_apart() -> None:
    """Even teeth on an even chain meet one kind of link; 19 teeth, 20 on 33 and 113 links, none."""
    even = ("joint.pitch='alternating'", "drive.links=114")
    assert contact(*even).bodies == 2
    assert contact(*even, "sprocket.teeth=19").bodies == 1
    assert contact("drive.links=113").bodies == 1
    assert contact("joint.pitch='alternating'", "drive.links=113").bodies == 1
    assert contact("drive.links=114").bodies == 1
    assert contact(*even, "drive.mate_teeth=33").bodies == 2


@KINDS
@pytest.mark.parametrize("elongation", [0.0, 0.02])
def test_every_gap_meets_every_position_once(settings: tuple[str, ...], elongation: float) -> None:
    of = contact(*settings)
    table = events(of, elongation)
    body, count = table[kernels.EVENT_BODY], table[kernels.EVENT_COUNT]
    for phase in range(of.phases):
        # The wrap holds ceil(wrap/pitch + 1 - phase) rollers.
        part = (phase + 0.5) / of.phases
        rollers = math.ceil(of.mechanism.wrap_angle / pitch_angle(of) + 1.0 - part)
        for gap in range(of.bodies):
            met = (np.where(body == gap, count, 0.0))[:, phase, :rollers].sum(axis=0)
            np.testing.assert_allclose(met, 1.0, rtol=1e-12)
        assert (table[kernels.EVENT_LOAD][:, phase, rollers:] == 0.0).all()


@KINDS
@pytest.mark.parametrize("phases", [1, 4, 7])
def test_articulation_in_and_out(settings: tuple[str, ...], phases: int) -> None:
    """Without way along the flank every gap is slid on 2 xi r 2 pi/z in a revolution."""
    of = only(contact(*settings, f"mechanism.phases={phases}"), fraction=0.1, path_fraction=0.0)
    table = events(of)
    slid = table[kernels.EVENT_SLIP] * table[kernels.EVENT_COUNT]
    for gap in range(of.bodies):
        total = slid[table[kernels.EVENT_BODY] == gap].sum()
        assert total == pytest.approx(2.0 * 0.1 * ROLLER * pitch_angle(of), rel=1e-12)


def test_speed_is_slip_over_the_time_of_a_phase() -> None:
    """100 rpm of 20 teeth: 0.03 s for a pitch."""
    table = events(contact())
    np.testing.assert_allclose(table[kernels.EVENT_SPEED], table[kernels.EVENT_SLIP] / (0.03 / 4), rtol=1e-12)


@KINDS
@pytest.mark.parametrize("elongation", [0.0, 0.01, 0.03])
def test_moments_balance_in_every_phase(settings: tuple[str, ...], elongation: float) -> None:
    """Moments of both strands and all teeth about the axis cancel, each in its own gap's frame.

    Where the first or the last roller hangs free between its strand and the next one its place is
    not that of an event: those phases, on alternating links at 3 %, are left out.
    """
    of = contact(*settings)
    table, wrap, angle = events(of, elongation), of.mechanism.wrap_angle, pitch_angle(of)
    x, y = table[kernels.EVENT_CENTRE_X], table[kernels.EVENT_CENTRE_Y]
    across = x * table[kernels.EVENT_NORMAL_Y] - y * table[kernels.EVENT_NORMAL_X]
    teeth = (across * force(of, table)).sum(axis=2)
    for phase in range(of.phases):
        part = (phase + 0.5) / of.phases
        last = math.ceil(wrap / angle + 1.0 - part) - 1
        tight = angle * (part - 0.5)
        slack = wrap - tight - last * angle
        first_x, first_y, last_x, last_y = (
            values[:, phase, roller] for roller in (0, last) for values in (x, y)
        )
        pull = 1000.0 * (-first_x * math.sin(tight) + first_y * math.cos(tight))
        hold = 20.0 * (-last_x * math.sin(slack) - last_y * math.cos(slack))
        resting = (table[kernels.EVENT_LOAD][:, phase][:, [0, last]] > 0.0).all(axis=1)
        left = (teeth[:, phase] + pull + hold)[resting]
        np.testing.assert_allclose(left, 0.0, atol=1e-6 * 1000 * 40.0)
        assert resting.all() or elongation == 0.03


def test_uniform_pitch_climbs_by_half_the_growth_of_the_diameter() -> None:
    """The first roller at the end of its articulation: eps d/2 outwards within 5 %."""
    of = contact("mechanism.phases=32", "sprocket.nodes=401")
    table = {eps: events(of, eps)[:, 0, -1, 0] for eps in (0.0, 0.01, 0.02, 0.03)}
    seat = {
        eps: math.hypot(row[kernels.EVENT_CENTRE_X], row[kernels.EVENT_CENTRE_Y])
        for eps, row in table.items()
    }
    for eps in (0.01, 0.02, 0.03):
        assert seat[eps] - seat[0.0] == pytest.approx(eps * PITCH_RADIUS, rel=0.05)
        # The contact moves up the flank, towards the tip on the tight side.
        assert table[eps][kernels.EVENT_TOUCHED] > table[0.0][kernels.EVENT_TOUCHED] + 1.0


def test_alternating_pitch_climbs_as_much_on_the_mean() -> None:
    of = contact("mechanism.phases=32", "sprocket.nodes=401", "joint.pitch='alternating'")
    for eps in (0.01, 0.02, 0.03):
        grown, new = (
            np.hypot(*events(of, e)[:2, :, -1, 0][[kernels.EVENT_CENTRE_X, kernels.EVENT_CENTRE_Y]])
            for e in (eps, 0.0)
        )
        assert (grown - new).mean() == pytest.approx(eps * PITCH_RADIUS, rel=0.08)
        assert abs(grown[0] - grown[1]) > 0.3 * eps * PITCH_RADIUS


def own_frames(loads: WrapLoads, mechanism: WrapMechanism) -> NDArray[np.complex128]:
    """Return roller centres, each in the frame of its own gap."""
    centre = loads.centre[:, 0] + 1j * loads.centre[:, 1]
    return centre * np.exp(1j * mechanism.pitch_angle * np.arange(centre.size))


@pytest.mark.parametrize(
    ("elongation", "path", "weighted"),
    [(0.0, 0.10, 0.022), (0.01, 0.66, 0.058), (0.02, 1.46, 0.080), (0.03, 2.42, 0.099)],
)
def test_way_along_the_flank(elongation: float, path: float, weighted: float) -> None:
    """Printed: total way and sum(P ds)/P1 of the rollers of one instant, from pitch to pitch.

    That instant is the end of an articulation, and the way between two positions has their mean
    load. The events also hold the way of the first pitch (climbing under a force that grows
    from 20 to 426 N) and of the last; all of it is summed here over 128 phases apart from them.
    """
    of = only(contact("mechanism.phases=16", "sprocket.nodes=601"), fraction=0.0, path_fraction=1.0)
    mechanism = of.mechanism
    snap = mechanism.loads(1.0, elongation)
    way = np.abs(np.diff(own_frames(snap, mechanism)))
    mean = 0.5 * (snap.force[1:] + snap.force[:-1])
    assert way.sum() == pytest.approx(path, rel=0.06)
    assert (mean * way).sum() / snap.force[0] == pytest.approx(weighted, rel=0.03)

    fine = [mechanism.loads(phase, elongation) for phase in np.linspace(0.0, 1.0, 129)]
    work = 0.0
    for before, after in pairwise(fine):
        rollers = min(before.force.size, after.force.size)
        start, end = (own_frames(loads, mechanism)[:rollers] for loads in (before, after))
        middle = 0.5 * (before.force[:rollers] + after.force[:rollers])
        work += float((middle * np.abs(end - start)).sum())
    table = events(of, elongation)
    found = float((force(of, table) * table[kernels.EVENT_SLIP]).sum())
    assert found == pytest.approx(work, rel=0.01)
    assert found > (mean * way).sum()


def test_slip_does_not_depend_on_the_number_of_phases() -> None:
    """Work of friction in a revolution by 8, 16 and 32 phases."""
    works = []
    for phases in (8, 16, 32):
        of = contact(f"mechanism.phases={phases}")
        table = events(of, 0.01)
        works.append(float((force(of, table) * table[kernels.EVENT_SLIP]).sum()))
    np.testing.assert_allclose(works, works[-1], rtol=0.01)


def test_pull_and_link_stiffness_of_an_unloaded_chain() -> None:
    """No tension, no event."""
    of = contact()
    (block,) = of.blocks
    loose = replace(block.mechanism, pull=replace(block.mechanism.pull, tight=0.0, slack=0.0))
    table = events(replace(of, blocks=(replace(block, mechanism=loose),)))
    assert (table == 0.0).all()


# -- how the gap wears ---------------------------------------------------------------------------


@KINDS
def test_area_of_a_life(settings: tuple[str, ...]) -> None:
    """Removed by the events = between the outlines = k sum(q s) as loads and paths go on."""
    of = contact(*settings, "sprocket.nodes=301", "mechanism.phases=2")
    run = wear(of)
    bodies = [of.profile.recede(depth) for depth in run.all_depth[-1]]
    areas = [area_between(of.profile.x, of.profile.y, worn.x, worn.y) for worn in bodies]
    assert run.area == pytest.approx(sum(areas), rel=1e-4)
    assert (np.diff(run.all_depth, axis=0) >= -1e-12).all()


def test_area_of_a_step_is_k_q_s() -> None:
    """k sum(q s count) cycles, divided by the mean cosine of the pressed arc, below 1 %."""
    of = contact("sprocket.nodes=601")
    table = events(of)
    worn = (table[kernels.EVENT_LOAD] * table[kernels.EVENT_SLIP] * table[kernels.EVENT_COUNT]).sum()
    run = wear(of, horizon=1000.0, step=1000.0)
    assert run.updates == 1
    assert run.area == pytest.approx(COEFFICIENT * worn * 1000.0, rel=0.01)
    assert run.area >= COEFFICIENT * worn * 1000.0


@pytest.mark.wide
def test_steps_converge() -> None:
    """Lives of the levels 0 to 3 within 0.7 %, from the level 1 on within 0.4 %.

    Below that the conforming scar, in which the place of the roller hangs on little, scatters.
    """
    of = contact("mechanism.phases=2", "sprocket.nodes=201", "drive.slack_tension_N=100")
    lives = np.array([wear(of, level, depth=0.05).cycles[-1] for level in range(4)])
    assert np.ptp(lives) < 7e-3 * lives[-1]
    assert np.ptp(lives[1:]) < 4e-3 * lives[-1]


def test_one_step_for_the_whole_life_is_stable() -> None:
    """No point stands out of its neighbours; the depth is right within 25 %, with ten steps 5 %."""
    of = replace(contact("mechanism.phases=2"), elongation_per_cycle=1e-12)
    fine = wear(of, 1, depth=0.05)
    cycles = float(fine.cycles[-1])
    one = wear(of, depth=1.0, horizon=cycles, step=cycles)
    ten = wear(of, depth=1.0, horizon=cycles, step=0.1000001 * cycles)
    assert (one.updates, ten.updates) == (1, 10)
    assert one.depth[-1].max() == pytest.approx(0.05, rel=0.25)
    assert ten.depth[-1].max() == pytest.approx(0.05, rel=0.05)
    for run in (fine, ten, one):
        depth = run.depth[-1]
        inside = depth[1:-1] > 0.2 * depth.max()
        saw = np.abs(depth[:-2] - 2.0 * depth[1:-1] + depth[2:])[inside]
        assert saw.max() < 0.15 * depth.max()


def test_phases_do_not_matter() -> None:
    """8, 16 and 32 phases of a pitch."""
    lives = [
        wear(contact(f"mechanism.phases={phases}", "sprocket.nodes=201")).cycles[-1] for phases in (8, 16, 32)
    ]
    np.testing.assert_allclose(lives, lives[-1], rtol=0.01)


@pytest.mark.wide
def test_nodes_do_not_matter() -> None:
    """301, 601 and 1201 points; the finest two within 0.5 %."""
    coarse, middle, fine = (wear(contact(f"sprocket.nodes={nodes}")).cycles[-1] for nodes in (301, 601, 1201))
    assert coarse == pytest.approx(fine, rel=0.012)
    assert middle == pytest.approx(fine, rel=0.005)


@pytest.mark.wide
def test_cycle_by_cycle() -> None:
    """Every revolution of a life of about 1200 against steps by depth."""
    of, factor = replace(contact("mechanism.phases=2"), elongation_per_cycle=2e-6), 1e4
    advance = wear(of, 3, depth=0.05, factor=factor)
    cycles = wear(of, depth=0.05, factor=factor, step=1.0)
    assert cycles.updates == math.ceil(cycles.cycles[-1]) > 1000
    assert cycles.cycles[-1] == pytest.approx(advance.cycles[-1], rel=5e-3)
    np.testing.assert_allclose(cycles.depth[-1], advance.depth[-1], rtol=0.0, atol=5e-3 * 0.05)


@pytest.mark.parametrize("settings", [(), ("joint.pitch='alternating'",)])
def test_life_times_coefficients_is_constant(settings: tuple[str, ...]) -> None:
    """Teeth and joints wear three times as fast: a third of the life, the same wear."""
    of = contact(*settings, "mechanism.phases=2")
    faster = replace(of, elongation_per_cycle=3.0 * of.elongation_per_cycle)
    slow, fast = wear(of), wear(faster, factor=3.0)
    assert fast.cycles[-1] == pytest.approx(slow.cycles[-1] / 3.0, rel=1e-6)
    np.testing.assert_allclose(fast.all_depth[-1], slow.all_depth[-1], rtol=0.0, atol=1e-6 * DEPTH)
    assert fast.elongation[-1] == pytest.approx(slow.elongation[-1], rel=1e-6)


def test_power_law_wears_less_where_pressure_is_low() -> None:
    """m = 2 with the coefficient of m = 1 at 250 MPa: fast while the scar is narrow, then slow."""
    of = contact("mechanism.phases=2")
    law = power(COEFFICIENT / 250.0, 2.0)
    square = run_resting(WearProblem(of, law, (depth_limit(0.02),), ENDLESS), 0)
    line = wear(of, depth=0.02)
    first, last = (
        highest_load(of, law, StartState(depth, NEW_MATE, 1))[0] for depth in line.all_depth[[0, -1]]
    )
    assert last < 250.0 < first
    early = 1e-4 * line.cycles[-1]
    depths = [np.interp(early, run.cycles, run.depth.max(axis=1)) for run in (square, line)]
    assert depths[0] > 1.05 * depths[1]
    assert square.cycles[-1] > 1.5 * line.cycles[-1]


# -- gaps of two kinds ---------------------------------------------------------------------------


def grown(of: WrapContact, cycles: float) -> WrapContact:
    """Return the contact with a chain that grows to its limit of 3 % in so many cycles."""
    return replace(of, elongation_per_cycle=0.03 / cycles)


def test_two_kinds_of_gap_wear_differently() -> None:
    """Even teeth, even links: the gap whose roller climbs higher wears deeper by some percent."""
    run = wear(grown(contact("joint.pitch='alternating'"), 5e7))
    deepest = np.sort(run.all_depth[-1].max(axis=1))
    assert run.all_depth.shape[1] == 2
    assert deepest[1] == pytest.approx(DEPTH, rel=1e-9)
    assert deepest[0] < 0.97 * deepest[1]
    np.testing.assert_array_equal(run.depth[-1], run.all_depth[-1][run.all_depth[-1].max(axis=1).argmax()])


def test_without_growth_both_kinds_are_alike() -> None:
    """An even chain without elongation: the two gaps wear like the one of a uniform chain."""
    two = wear(replace(contact("joint.pitch='alternating'"), elongation_per_cycle=0.0))
    one = wear(replace(contact(), elongation_per_cycle=0.0))
    assert two.cycles[-1] == pytest.approx(one.cycles[-1], rel=1e-2)
    np.testing.assert_allclose(two.all_depth[-1, 0], two.all_depth[-1, 1], rtol=0, atol=3e-2 * DEPTH)


def test_hunting_teeth_take_the_mean_of_both_kinds() -> None:
    """Odd teeth meet both links in turn: new, the work of friction is the mean of both kinds."""
    of = grown(contact("joint.pitch='alternating'"), 5e7)
    hunting = replace(of, same_link_kind=False)
    for elongation in (0.0, 0.02):
        kinds, alike = events(of, elongation), events(hunting, elongation)
        for row in (kernels.EVENT_LOAD, kernels.EVENT_SLIP, kernels.EVENT_TOUCHED):
            np.testing.assert_allclose(alike[row], kinds[row], rtol=1e-6, atol=1e-6)
        np.testing.assert_array_equal(alike[kernels.EVENT_COUNT], 0.5 * kinds[kernels.EVENT_COUNT])
    two = wear(of, horizon=2e7, depth=1.0)
    one = wear(hunting, horizon=2e7, depth=1.0)
    assert (two.all_depth.shape[1], one.all_depth.shape[1]) == (2, 1)
    low, high = np.sort(two.all_depth[-1].max(axis=1))
    assert 0.9 * low < one.depth[-1].max() < high
    # A scar shared by both kinds of link fits neither, so the rollers' ways on it differ a little.
    assert one.area == pytest.approx(0.5 * two.area, rel=0.12)


# -- the chain -----------------------------------------------------------------------------------


@cache
def replaced() -> tuple[WrapContact, RestingTrajectory]:
    of = grown(contact(), 6e6)
    return of, wear(of)


def test_chains_are_replaced_at_their_limit() -> None:
    """The elongation runs up to 3 % and starts anew, the depth goes on."""
    _, run = replaced()
    assert run.met is not None
    assert run.mates[-1] == math.floor(run.cycles[-1] / 6e6) + 1.0 >= 4.0
    phase = run.cycles - 6e6 * (run.mates - 1.0)
    np.testing.assert_allclose(run.elongation, 0.03 * phase / 6e6, rtol=0.0, atol=1e-9)
    assert (phase > -1e-3).all() and (phase < 6e6 * (1.0 + 1e-9)).all()
    assert (np.diff(run.mates) >= 0.0).all() and (np.diff(run.depth.max(axis=1)) >= 0.0).all()


def test_a_new_chain_on_a_worn_sprocket_is_the_same_run_gone_on() -> None:
    """A run that begins with the worn gap and a new chain lives as long as the one replaced."""
    of, run = replaced()
    first = wear(of, depth=DEPTH, horizon=6e6)
    assert first.met is None and first.elongation[-1] == pytest.approx(0.03, rel=1e-9)
    start = StartState(depth=first.all_depth[-1], wear=NEW_MATE, mate=2)
    law, limit = archard(COEFFICIENT), (depth_limit(DEPTH),)
    rest = run_resting(WearProblem(of, law, limit, ENDLESS, start), 0)
    assert 6e6 + rest.cycles[-1] == pytest.approx(run.cycles[-1], rel=2e-3)
    assert rest.mates[-1] == run.mates[-1]


def test_hours_of_replacement_alone_decide() -> None:
    """Half of growth and half of the limit: the same times of replacement, half the climb.

    Less way along the flank, but less spread: the life stays within 5 %.
    """
    of, run = replaced()
    half = replace(of, elongation_per_cycle=0.5 * of.elongation_per_cycle, elongation_limit=0.015)
    other = wear(half)
    assert other.elongation.max() == pytest.approx(0.015, rel=1e-6)
    assert other.cycles[-1] == pytest.approx(run.cycles[-1], rel=0.05)
    assert other.mates[-1] == run.mates[-1]


def zone(of: WrapContact, run: RestingTrajectory, area: float) -> dict[str, float]:
    """Return the shape of the worn flank when so much area is gone."""
    areas = [area_between(run.x[0], run.y[0], x, y) for x, y in zip(run.x, run.y, strict=True)]
    k = int(np.searchsorted(areas, area))
    part = (area - areas[k - 1]) / (areas[k] - areas[k - 1])
    depth = run.depth[k - 1] + part * (run.depth[k] - run.depth[k - 1])
    deepest = int(depth.argmax())
    arc = of.profile.arc_length
    return {
        "depth": float(depth[deepest]),
        "radius": float(np.hypot(of.profile.x[deepest], of.profile.y[deepest])),
        "width": float(np.gradient(arc)[depth > 0.5 * depth[deepest]].sum()),
        "mean_place": float(np.sum(np.gradient(arc) * depth * arc) / np.sum(np.gradient(arc) * depth)),
    }


@pytest.mark.slow
def test_a_chain_that_does_not_stretch_digs_a_hook_at_the_root_one_that_does_spreads_the_wear() -> None:
    """Of the same area worn off: shallower, wider and higher up the flank with chains that grow.

    Three chains to the end of the run, each to 3 %, a twentieth of that time, and one that has
    grown by 1.7 % when the area is gone: that one only moves the scar up the flank.
    """
    of, area = contact(), 0.3
    hook = zone(of, wear(replace(of, elongation_per_cycle=0.0), horizon=6e7, depth=1.0), area)
    # The hook lies below the circle on which the rollers of a new chain are centred, at its root.
    assert hook["radius"] < PITCH_RADIUS - 0.4 * ROLLER
    for cycles, depth, width in ((2e7, 0.95, 1.05), (3e6, 0.9, 1.1), (6e7, 1.1, 0.9)):
        spread = zone(of, wear(grown(of, cycles), horizon=6e7, depth=1.0), area)
        assert spread["depth"] < depth * hook["depth"]
        assert spread["width"] > width * hook["width"]
        assert spread["radius"] > hook["radius"] + 0.6
        assert spread["mean_place"] > hook["mean_place"] + 0.6


def test_result_does_not_depend_on_the_order_of_two_runs() -> None:
    """The engine keeps nothing from run to run."""
    of = contact("mechanism.phases=2")
    runs: list[Callable[[], RestingTrajectory]] = [lambda: wear(of), lambda: wear(of)]
    first, second = (run() for run in runs)
    np.testing.assert_array_equal(first.cycles, second.cycles)
    np.testing.assert_array_equal(first.all_depth, second.all_depth)


def test_margin_against_jumping_is_that_of_the_worn_gaps():
    """Worn pockets hold the chain otherwise than new teeth; a jump ends the life where it is used up."""
    case = wearsim.load_case({**CASE, "run": {"horizon_hours": 2000}})
    found = {state.name: state for state in wearsim.simulate(case).limits}["min_slack_tension_N"]
    new = case.drive.contact(case).mechanism.smallest_slack_tension(0.0)
    assert found.limit == case.drive.slack
    assert 0.0 < found.value < found.limit
    assert found.value != pytest.approx(new, rel=0.02)
