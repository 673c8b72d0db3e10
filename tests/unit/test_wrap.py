"""The wrap's kernels piece by piece against differences and NumPy, and the hard starts of a solve."""

import math
from dataclasses import replace

import numpy as np
import pytest

from wearsim.errors import ContactError
from wearsim.geometry.forms.ansi_b29 import ansi_b29_gap
from wearsim.geometry.forms.gost591 import gost591_gap
from wearsim.geometry.forms.iso606 import iso606_gap
from wearsim.geometry.profile_points import Profile
from wearsim.geometry.roller_path import roller_path
from wearsim.kernels import wrap_equilibrium as kernels
from wearsim.mechanisms.wrap.wrap_mechanism import StrandTensions, WrapChain, WrapMechanism

PITCH, ROLLER = 12.7, 8.51
FORMS = {
    "ANSI": lambda z: ansi_b29_gap(PITCH, ROLLER, z),
    "ISO min": lambda z: iso606_gap(PITCH, ROLLER, z, form="min"),
    "ISO max": lambda z: iso606_gap(PITCH, ROLLER, z, form="max"),
    "GOST": lambda z: gost591_gap(PITCH, ROLLER, z),
    "GOST displaced": lambda z: gost591_gap(PITCH, ROLLER, z, displaced=True),
}
ANGLE = 2.0 * math.pi / 20
_ALOFT = kernels.WORK_ROWS - 1


def wrap(form, teeth, *, slack=20.0, wrap_angle=math.pi, alternating=False, pull=None, nodes=301):
    gap = FORMS[form](teeth)
    outline = gap.outline(nodes)
    return WrapMechanism(
        outline=outline,
        path=roller_path(outline, gap.roller_radius, (nodes + 1) // 2),
        pitch_angle=2.0 * math.pi / teeth,
        wrap_angle=wrap_angle,
        chain=WrapChain(PITCH, 0.5 * ROLLER, 0.35 * ROLLER, 5e4, alternating),
        pull=pull or StrandTensions(1000.0, slack, True, 0.0, 0.0),
    )


class Energy:
    """Energy, gradient and Hessian of some rollers on the path of an ANSI gap, by the kernels."""

    def __init__(self, rollers=5, aloft=(), friction=0.0):
        self.mechanism = wrap("ANSI", 20, alternating=True)
        self.locus = self.mechanism.unworn.locus
        self.constants = self.mechanism.constants(0.02)
        self.rollers = rollers
        self.work = np.zeros((kernels.WORK_ROWS, rollers))
        self.work[_ALOFT, list(aloft)] = 1.0
        self.work[11:13] = friction * np.random.default_rng(1).normal(0.0, 9.0, (2, rollers))
        self.tension = np.zeros(rollers + 1)

    def __call__(self, position):
        kernels.place_rollers(self.locus, self.locus, 0, self.rollers, position, ANGLE, self.work)
        return kernels.balance(0, self.rollers, self.constants, 0.1, 0.2, self.work, self.tension)

    def gradient(self, position):
        self(position)
        return self.work[6].copy()


POSITION = np.array([231.2, 233.7, 226.4, 229.3, 221.8])


def test_rollers_stand_where_the_nodes_are():
    """At whole numbers: the nodes of one gap, turned clockwise by i pitch angles."""
    locus = wrap("ANSI", 20).unworn.locus
    position, work = np.array([10.0, 200.0, 290.0]), np.zeros((kernels.WORK_ROWS, 3))
    kernels.place_rollers(locus, locus, 0, 3, position, ANGLE, work)
    for i, node in enumerate((10, 200, 290)):
        cosine, sine = math.cos(i * ANGLE), math.sin(i * ANGLE)
        turn = np.array([[cosine, sine], [-sine, cosine]])
        assert work[:2, i] == pytest.approx(turn @ locus[:2, node], abs=1e-12)
        assert work[kernels.NORMAL_X : kernels.NORMAL_Y + 1, i] == pytest.approx(
            turn @ locus[2:, node], abs=1e-12
        )


@pytest.mark.parametrize("first", [0, 1])
def test_gaps_of_two_kinds_take_turns(first):
    one, other = wrap("ANSI", 20).unworn.locus, wrap("GOST", 20).unworn.locus
    assert np.abs(one[:2, 100] - other[:2, 100]).max() > 1e-3
    work = np.zeros((kernels.WORK_ROWS, 2))
    kernels.place_rollers(one, other, first, 2, np.array([100.0, 100.0]), 0.0, work)
    order = (one, other) if first == 0 else (other, one)
    for i in range(2):
        assert work[:2, i] == pytest.approx(order[i][:2, 100], abs=1e-12)


def test_derivatives_of_the_place():
    energy, step = Energy(), 1e-4
    energy(POSITION)
    first, second = energy.work[2:4].copy(), energy.work[4:6].copy()
    energy(POSITION + step)
    up, slope_up = energy.work[:2].copy(), energy.work[2:4].copy()
    energy(POSITION - step)
    down, slope_down = energy.work[:2].copy(), energy.work[2:4].copy()
    assert (up - down) / (2.0 * step) == pytest.approx(first, abs=1e-9)
    assert (slope_up - slope_down) / (2.0 * step) == pytest.approx(second, abs=1e-9)


@pytest.mark.parametrize("friction", [0.0, 1.0])
@pytest.mark.parametrize("aloft", [(), (2,), (0,), (4,), (1, 2), (0, 4)])
def test_gradient_and_hessian_of_the_energy(aloft, friction):
    energy, step = Energy(aloft=aloft, friction=friction), 1e-5
    on = [i for i in range(5) if i not in aloft]
    gradient = energy.gradient(POSITION)
    diagonal, off = energy.work[7].copy(), energy.work[8].copy()
    for place, i in enumerate(on):
        aside = np.zeros(5)
        aside[i] = step
        slope = (energy(POSITION + aside) - energy(POSITION - aside)) / (2.0 * step)
        assert gradient[i] == pytest.approx(slope, rel=1e-5, abs=1e-4)
        change = energy.gradient(POSITION + aside) - energy.gradient(POSITION - aside)
        column = change / (2.0 * step)
        assert diagonal[i] == pytest.approx(column[i], rel=1e-4, abs=1e-2)
        if place + 1 < len(on):
            assert off[i] == pytest.approx(column[on[place + 1]], rel=1e-4, abs=1e-2)


def test_tensions_go_on_over_rollers_aloft():
    energy = Energy(aloft=(0, 2, 4))
    energy(POSITION)
    tight, slack = energy.constants[kernels.TIGHT_TENSION], energy.constants[kernels.SLACK_TENSION]
    tension = energy.tension
    assert tension[:2].tolist() == [tight, tight]
    assert tension[2] == tension[3] > 0.0
    assert tension[4:].tolist() == [slack, slack]


@pytest.mark.parametrize("aloft", [(), (1,), (0, 4)])
def test_newton_step_solves_the_tridiagonal_system(aloft):
    random, n = np.random.default_rng(2), 5
    work = np.zeros((kernels.WORK_ROWS, n))
    work[2:4] = random.uniform(0.5, 1.0, (2, n))
    work[6], work[7], work[8] = random.normal(size=n), random.uniform(4.0, 5.0, n), -1.0
    work[_ALOFT, list(aloft)] = 1.0
    on = [i for i in range(n) if i not in aloft]
    assert kernels.newton_step(n, 0.3, 2.0, work) == 0
    matrix = np.diag(work[7, on] + 0.6 * np.sum(work[2:4, on] ** 2, axis=0))
    for place in range(len(on) - 1):
        matrix[place, place + 1] = matrix[place + 1, place] = -1.0
    expected = np.linalg.solve(matrix, -work[6, on])
    assert work[9, on] == pytest.approx(expected, rel=1e-12)
    assert (work[9, list(aloft)] == 0.0).all()
    work[7] = -9.0
    assert kernels.newton_step(n, 0.3, 2.0, work) == 1


def test_rollers_aloft_hang_in_line():
    """Three pitches of 10, 12 and 10 mm between two rollers 33 mm apart; strands at both ends."""
    constants = np.zeros(kernels.CONSTANTS)
    constants[kernels.PITCH_EVEN], constants[kernels.PITCH_ODD] = 10.0, 12.0
    constants[kernels.STIFFNESS] = 100.0
    constants[kernels.TIGHT_TENSION], constants[kernels.SLACK_TENSION] = 200.0, 50.0
    work = np.zeros((kernels.WORK_ROWS, 6))
    work[_ALOFT] = 1.0, 0.0, 1.0, 1.0, 0.0, 1.0
    work[0, [1, 4]] = 0.0, 33.0
    kernels.hang_rollers(1, 6, constants, 0.0, 0.0, work)  # links: 12, 10, 12, 10, 12
    assert work[0] == pytest.approx([-14.0, 0.0, 10.0 + 1 / 3, 22.0 + 2 / 3, 33.0, 45.5])
    assert work[1] == pytest.approx(0.0, abs=1e-12)


def test_friction_is_the_least_of_slipping_and_rolling():
    """Radii of roller and bush 1 : 0.7; the sign is that of the driver."""
    for tooth, bush, share in ((0.1, 0.2, 0.1), (0.1, 0.1, 0.07), (0.0, 0.1, 0.0)):
        for driver, sign in ((True, 1.0), (False, -1.0)):
            mechanism = wrap("ANSI", 20, pull=StrandTensions(1000.0, 20.0, driver, tooth, bush))
            assert mechanism.friction_angle_tangent == pytest.approx(share, abs=1e-15)
            signed = mechanism.constants(0.0)[kernels.FRICTION]
            assert signed == pytest.approx(sign * share, abs=1e-15)


def test_pitches_and_constants():
    mechanism = wrap("ANSI", 20, alternating=True)
    assert mechanism.chain.pitches(0.03) == pytest.approx((12.7, 13.462), rel=1e-12)
    alike = replace(mechanism.chain, alternating=False)
    assert alike.pitches(0.03) == pytest.approx((13.081, 13.081), rel=1e-12)
    assert mechanism.pitch_radius == pytest.approx(6.35 / math.sin(math.radians(9.0)), rel=1e-12)
    expected = [math.radians(18.0), 5e4, 12.7, 13.462, 1000.0, 20.0, 0.0]
    assert mechanism.constants(0.03) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(
    ("form", "teeth", "alternating", "phase", "elongation", "wrap_angle", "slack", "first"),
    [
        ("ISO min", 33, False, 0.3134, 0.02521, 3.0431, 33.0, 1),
        ("ANSI", 60, False, 0.4694, 0.0056, 3.3857, 89.6, 0),
        ("GOST", 27, False, 0.8763, 0.01824, 3.9701, 68.3, 0),
        ("ANSI", 59, True, 0.5542, 0.02579, 2.686, 2.6, 0),
        ("ISO min", 54, True, 0.2876, 0.02998, 2.4488, 21.9, 0),
    ],
)
def test_hard_starts(form, teeth, alternating, phase, elongation, wrap_angle, slack, first):
    """Many rollers that have to cross to the opposite flank, and a climb near the tips.

    The first three took more than 400 iterations, the others a step over the tips.
    """
    mechanism = wrap(form, teeth, slack=slack, wrap_angle=wrap_angle, alternating=alternating)
    loads = mechanism.loads(phase, elongation, first)
    ends = 1000.0 * loads.tight_direction + slack * loads.slack_direction
    total = ends + np.sum(loads.force[:, None] * loads.normal, axis=0)
    assert np.hypot(*total) < 1e-3
    assert loads.force.min() >= -1e-6


@pytest.mark.parametrize("elongation", [0.0, 0.01])
def test_straight_flanks_of_a_groove(elongation):
    """Sides 30 degrees from the gap's axis: theta = 60, so that phi = 90 - 60 - 9 = 21 degrees.

    Binder's progression with it; one roller is held by the corner between both sides.
    """
    angle, radius = math.radians(30.0), 4.0
    way = np.linspace(9.0, -9.0, 601)
    bottom = 6.35 / math.sin(math.radians(9.0)) - radius / math.sin(angle)
    outline = Profile(math.sin(angle) * way, bottom + math.cos(angle) * np.abs(way))
    mechanism = WrapMechanism(
        outline=outline,
        path=roller_path(outline, radius, 301),
        pitch_angle=ANGLE,
        wrap_angle=math.pi,
        chain=WrapChain(PITCH, radius, 3.0, 5e4, False),
        pull=StrandTensions(1000.0, 60.0, True, 0.0, 0.0),
    )
    loads = mechanism.loads(1.0, elongation)
    found = np.degrees(loads.pressure_angle)
    assert found[:7] == pytest.approx(21.0, abs=0.02)
    assert found[-2:] == pytest.approx(180.0 - 21.0 - 18.0, abs=0.02)
    assert 21.1 < found[7] < 140.9
    ratio = math.sin(math.radians(21.0)) / math.sin(math.radians(39.0))
    assert loads.tension[1:7] == pytest.approx(1000.0 * ratio ** np.arange(1, 7), abs=10.0)


def test_a_roller_over_its_tooth_is_told_from_no_equilibrium():
    mechanism = wrap("ANSI", 20)
    with pytest.raises(ContactError, match=r"a roller climbs over its tooth: the chain jumps"):
        mechanism.loads(1.0, 0.15)
    with pytest.raises(ContactError, match=r"slack tension of at least \d"):
        wrap("ANSI", 20, slack=0.5).loads(1.0)


def test_a_single_roller():
    """A wrap of less than half a pitch: T u + S v = - P n, by hand for a symmetric pull."""
    pull = StrandTensions(100.0, 100.0 - 1e-9, True, 0.0, 0.0)
    mechanism = wrap("ISO min", 20, wrap_angle=0.5 * ANGLE, pull=pull)
    assert mechanism.rollers(1.0) == 1
    tight, slack = mechanism.angles(1.0)
    assert (tight, slack) == pytest.approx((0.5 * ANGLE, 0.0))
    loads = mechanism.loads(0.75)
    tight, slack = mechanism.angles(0.75)
    assert (tight, slack) == pytest.approx((0.25 * ANGLE, 0.25 * ANGLE))
    assert loads.force == pytest.approx([200.0 * math.sin(0.25 * ANGLE)], rel=1e-6)
    assert loads.centre[0, 0] == pytest.approx(0.0, abs=1e-6)


def test_assumptions_name_the_friction():
    pull = StrandTensions(1000.0, 20.0, False, 0.1, 0.3)
    text = " ".join(wrap("ANSI", 20, pull=pull).assumptions())
    assert "friction acts down the working flank, 0.1 of the force" in text
    assert "no friction" in " ".join(wrap("ANSI", 20).assumptions())
