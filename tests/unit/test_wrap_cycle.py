"""The table of events of a wrap: rows against single solves, memory, coarser grids, errors."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import wearsim
from tests.drives import depth_limit
from wearsim.contact.resting_engagement import MateWear
from wearsim.errors import JumpError
from wearsim.geometry.roller_path import roller_path
from wearsim.kernels import event_rows as kernels
from wearsim.kernels.wrap_equilibrium import engaged
from wearsim.wear.implicit_steps import run_resting
from wearsim.wear.law import archard
from wearsim.wear.problem import WearProblem

CASE = {
    "format_version": 1,
    "chain": {"designation": "ANSI 40"},
    "sprocket": {"teeth": 20, "profile": "ansi_b29", "nodes": 151},
    "mechanism": {"kind": "wrap", "phases": 4, "roller_slip_fraction": 0.1},
    "drive": {"mate_teeth": 20, "slack_tension_N": 20, "link_stiffness_N_per_mm": 5e4},
    "joint": {"pitch": "alternating"},
    "load": {"tension_N": 1000, "speed_rpm": 100},
    "wear": {"specific_wear_rate_mm2_per_N": 5e-11},
}


def contact(*settings):
    case = wearsim.load_case(CASE, settings)
    return case.drive.contact(case)


def unworn(of):
    return tuple(np.tile(values, (of.bodies, 1)) for values in (of.profile.x, of.profile.y))


@pytest.mark.parametrize(
    ("degrees", "phase", "rollers"),
    [(180.0, 0.0, 11), (180.0, 0.5, 11), (180.0, 1.0, 10), (175.0, 0.9, 10), (10.0, 0.9, 1)],
)
def test_rollers_between_the_strands(degrees, phase, rollers):
    """Of 18 degrees each."""
    assert engaged(math.radians(degrees), math.radians(18.0), phase) == rollers


@pytest.mark.parametrize("elongation", [0.0, 0.01])
def test_rows_are_those_of_single_solves(elongation):
    """Phases 1/8, 3/8 ... in both kinds of link: load, place of the centre, place touched."""
    of = contact()
    table = of.events(*unworn(of), MateWear(elongation), of.memory())
    table = table.reshape(kernels.EVENT_ROWS, 2, 4, of.most_rollers)
    arc = of.arc_length
    for first in (0, 1):
        for step in range(4):
            loads = of.mechanism.loads((step + 0.5) / 4, elongation, first)
            rows = table[:, first, step, : loads.force.size]
            np.testing.assert_allclose(
                rows[kernels.EVENT_LOAD] * of.face_width, loads.force, rtol=1e-6, atol=1e-4
            )
            radius = np.hypot(rows[kernels.EVENT_CENTRE_X], rows[kernels.EVENT_CENTRE_Y])
            np.testing.assert_allclose(radius, loads.seat_radius, rtol=0.0, atol=1e-6)
            touched = np.interp(rows[kernels.EVENT_TOUCHED], np.arange(arc.size), arc)
            np.testing.assert_allclose(touched, loads.contact_arc_length, rtol=0.0, atol=1e-4)
            body = (np.arange(loads.force.size) + first) % 2
            np.testing.assert_array_equal(rows[kernels.EVENT_BODY], body)


def test_mate_touches_the_outline():
    """The outline comes within a hundredth of a cell's sagitta of a roller around the centre."""
    of = contact("sprocket.nodes=601")
    table = of.events(*unworn(of), MateWear(0.01), of.memory())
    table = table[:, table[kernels.EVENT_LOAD] > 0.0]
    for column in table.T:
        distance = np.hypot(
            of.profile.x - column[kernels.EVENT_CENTRE_X], of.profile.y - column[kernels.EVENT_CENTRE_Y]
        )
        assert distance.min() == pytest.approx(of.mate_radius, abs=2e-4)
        assert abs(int(distance.argmin()) - column[kernels.EVENT_TOUCHED]) < 60
    normal = np.hypot(table[kernels.EVENT_NORMAL_X], table[kernels.EVENT_NORMAL_Y])
    np.testing.assert_allclose(normal, 1.0, rtol=1e-9)


def test_memory_changes_nothing_but_the_effort():
    of = contact()
    memory = of.memory()
    assert (memory < 0.0).all()
    first = of.events(*unworn(of), MateWear(0.01), memory)
    assert (memory[first[kernels.EVENT_LOAD].reshape(memory.shape) > 0.0] >= 0.0).all()
    again = of.events(*unworn(of), MateWear(0.01), memory)
    fresh = of.events(*unworn(of), MateWear(0.01), of.memory())
    np.testing.assert_array_equal(fresh, first)
    np.testing.assert_allclose(again, first, rtol=1e-5, atol=1e-5)


def test_way_between_phases_and_over_the_pitch():
    """Every loaded event holds half the way from the phase before and half to the next one."""
    of = contact("joint.pitch='uniform'")
    of = replace(of, sliding=replace(of.sliding, fraction=0.0, path_fraction=1.0))
    table = of.events(*unworn(of), MateWear(0.02), of.memory()).reshape(
        kernels.EVENT_ROWS, 4, of.most_rollers
    )
    centre = table[kernels.EVENT_CENTRE_X] + 1j * table[kernels.EVENT_CENTRE_Y]
    slip, load = table[kernels.EVENT_SLIP], table[kernels.EVENT_LOAD]
    # One roller on its whole way: positions 0, 1, 2 ... in the phases 1 to 4 of each.
    way = centre[:, : of.most_rollers - 1].T.ravel()
    loaded = load[:, : of.most_rollers - 1].T.ravel() > 0.0
    steps = np.abs(np.diff(way)) * loaded[1:] * loaded[:-1]
    expected = 0.5 * (np.append(steps, 0.0) + np.append(0.0, steps))
    inner = slice(0, 4 * (of.most_rollers - 2))
    np.testing.assert_allclose(slip[:, : of.most_rollers - 1].T.ravel()[inner], expected[inner], atol=1e-12)


@pytest.mark.parametrize(
    ("frictions", "path_fraction"),
    [((0.0, 0.0), 1.0), ((0.05, 0.1), 1.0), ((0.1, 0.05), 0.1)],
    ids=["none", "slides", "rolls"],
)
def test_rollers_roll_up_the_flank_or_slide(frictions, path_fraction):
    """They roll where mu_tooth r > mu_bush r_bush; then xi of the way is slid."""
    tooth, bush = frictions
    of = contact(f"mechanism.friction_roller_tooth={tooth}", f"mechanism.friction_roller_bush={bush}")
    assert (of.sliding.fraction, of.sliding.path_fraction) == (0.1, path_fraction)


@pytest.mark.parametrize("nodes", [101, 151, 152])
def test_coarsened_keeps_ends_and_loads(nodes):
    of = contact(f"sprocket.nodes={nodes}")
    coarse = of.coarsened()
    points = of.profile.x.size
    assert coarse.profile.x.size == (points + 1) // 2
    for values, fewer in ((of.profile.x, coarse.profile.x), (of.profile.y, coarse.profile.y)):
        assert (values[0], values[-1]) == (fewer[0], fewer[-1])
    assert coarse.phases == of.phases // 2
    same = replace(coarse, phases=of.phases)
    load, fewer = (c.events(*unworn(c), MateWear(0.01), c.memory())[kernels.EVENT_LOAD] for c in (of, same))
    np.testing.assert_allclose(fewer, load, rtol=0.0, atol=0.02 * load.max())


def test_every_other_gap_engaged():
    """A crawler's 27 gaps of which every other one carries a bush: 13.5 to the turn, all alike."""
    case = wearsim.load_case(Path(__file__).parents[2] / "cases" / "d6-crawler-27t-wrap.toml")
    of = case.drive.contact(case)
    assert of.mechanism.pitch_angle == pytest.approx(2.0 * math.pi / 13.5)
    assert of.bodies == 1


def test_a_chain_that_jumps_is_an_error():
    of = contact("joint.pitch='uniform'")
    (block,) = of.blocks
    pull = replace(block.mechanism.pull, slack=1e-6)
    loose = replace(of, blocks=(replace(block, mechanism=replace(block.mechanism, pull=pull)),))
    with pytest.raises(JumpError, match=r"wrap at an elongation of 6 %: .*jumps"):
        loose.events(*unworn(loose), MateWear(0.06), loose.memory())


def test_two_halves_of_the_duty_are_the_whole():
    of = contact()
    (block,) = of.blocks
    halves = replace(of, blocks=(replace(block, share=0.25), replace(block, share=0.75)))
    runs = [
        run_resting(WearProblem(c, archard(1e-9), (depth_limit(0.02),), 1e12), 0, 1e5) for c in (of, halves)
    ]
    assert runs[1].cycles[-1] == pytest.approx(runs[0].cycles[-1], rel=0.01)


def test_assumptions_name_the_sliding_and_the_teeth():
    text = " ".join(contact().assumptions())
    for part in ("10 % of the articulation angle of 18 degrees", "teeth of two kinds", "half-space"):
        assert part in text
    assert "every tooth alike" in " ".join(contact("joint.pitch='uniform'").assumptions())


def test_worn_rollers_meet_what_smaller_rollers_do():
    """Rollers worn by 0.05 mm press as those of a chain made 0.1 mm thinner on the same outline."""
    of = contact("mechanism.friction_roller_tooth=0.2", "chain.bush_diameter_mm=6")
    mechanism = of.mechanism
    radius = of.mate_radius - 0.05
    chain = replace(mechanism.chain, roller_radius=radius)
    path = roller_path(of.profile, radius, (of.profile.x.size + 1) // 2)
    block = replace(of.blocks[0], mechanism=replace(mechanism, chain=chain, path=path))
    smaller = replace(of, blocks=(block,))
    worn = of.events(*unworn(of), MateWear(0.01, 0.05), of.memory())
    made = smaller.events(*unworn(of), MateWear(0.01), of.memory())
    load = kernels.EVENT_LOAD
    np.testing.assert_allclose(worn[load], made[load], rtol=0.0, atol=2e-3 * made[load].max())
    loaded = made[load] > 0.01 * made[load].max()
    for row, near in ((kernels.EVENT_CENTRE_X, 2e-3), (kernels.EVENT_CENTRE_Y, 2e-3)):
        np.testing.assert_allclose(worn[row][loaded], made[row][loaded], rtol=0.0, atol=near)
    untouched = of.events(*unworn(of), MateWear(0.01), of.memory())
    assert (np.abs(worn - untouched)[kernels.EVENT_CENTRE_Y][loaded] > 0.03).any()


def test_rollers_lose_area_to_both_sprockets():
    """Each of 60 rollers meets 13 gaps in a turn, and the mate of 20 teeth rubs 13/20 as much."""
    tables = {
        **CASE,
        "chain": {"designation": "08B-1"},
        "sprocket": {"teeth": 13, "profile": "iso606", "nodes": 101},
        "drive": {"mate_teeth": 20, "links": 60, "slack_tension_N": 30},
        "wear": {"specific_wear_rate_mm2_per_N": 1e-9, "roller_wear_ratio": 0.5},
    }
    case = wearsim.load_case(tables)
    ratio = case.drive.contact(case).mate_area_ratio
    assert ratio == pytest.approx(0.5 * 13 / 60 * (1.0 + 13 / 20), rel=1e-12)
