"""Rollers of a wrap against printed tables, Binder's progression, statics, and exact arcs.

Printed numbers come from a table calculated apart from the code: uniform pitch, seat centred on
the pitch circle, 1000 N and 20 N, links of 5e4 N/mm, no friction, the end of an articulation.
Its fifth tension of 08B, minimum form, 22 N, is replaced by that of the minimum on the exact arcs,
24.0 N, found below by another minimiser.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import minimize

from wearsim.errors import ContactError
from wearsim.geometry.forms.ansi_b29 import ansi_b29_gap
from wearsim.geometry.forms.gost591 import gost591_gap
from wearsim.geometry.forms.iso606 import iso606_gap
from wearsim.geometry.gap import Gap
from wearsim.geometry.roller_path import roller_path
from wearsim.geometry.segments import ArcSegment
from wearsim.mechanisms.wrap.wrap_mechanism import StrandTensions, WrapChain, WrapLoads, WrapMechanism

Array = NDArray[np.float64]

PITCH, STIFFNESS = 12.7, 5e4
FORMS: dict[str, Callable[[int], Gap]] = {
    "ANSI": lambda z: ansi_b29_gap(PITCH, 7.92, z),
    "ISO min": lambda z: iso606_gap(PITCH, 8.51, z, form="min"),
    "ISO max": lambda z: iso606_gap(PITCH, 8.51, z, form="max"),
    "GOST": lambda z: gost591_gap(PITCH, 8.51, z),
    "GOST displaced": lambda z: gost591_gap(PITCH, 8.51, z, displaced=True),
}


def wrap(
    gap: Gap,
    *,
    tight: float = 1000.0,
    slack: float = 20.0,
    stiffness: float = STIFFNESS,
    alternating: bool = False,
    driver: bool = True,
    friction: tuple[float, float] = (0.0, 0.0),
    wrap_angle: float = math.pi,
    nodes: int = 601,
) -> WrapMechanism:
    """Return a mechanism on a standard gap; the bush is 0.7 of the roller."""
    outline, radius = gap.outline(nodes), gap.roller_radius
    return WrapMechanism(
        outline=outline,
        path=roller_path(outline, radius, (nodes + 1) // 2),
        pitch_angle=2.0 * math.pi / gap.teeth,
        wrap_angle=wrap_angle,
        chain=WrapChain(PITCH, radius, 0.7 * radius, stiffness, alternating),
        pull=StrandTensions(tight, slack, driver, *friction),
    )


def progression(angle: float, pitch_angle: float) -> float:
    """Binder: T_{i+1}/T_i = sin(phi)/sin(phi + alpha)."""
    return math.sin(angle) / math.sin(angle + pitch_angle)


def seated_angle(gap: Gap) -> float:
    """Pressure angle where the seat ends: 35 - 120/z, 20 - 135/z or 30 - 135/z degrees."""
    seat = next(part for part in gap.segments if isinstance(part, ArcSegment))
    return float(gap.pressure_angle(seat.end_tangent))


TABLE = {
    0.00: ("1000 657 431 283 186 123 81 53 35 24", "426 281 184 121 79 52 34 23 14 8", 28.3, 0.024),
    0.01: ("1000 613 370 224 136 84 52 32 21 14", "455 285 172 104 63 38 23 14 9 8", 24.0, 0.422),
    0.02: ("1000 562 306 168 93 52 30 18 12 12", "492 287 156 85 46 26 14 8 3 9", 19.8, 0.823),
    0.03: ("1000 503 239 116 57 30 17 10 7 11", "540 285 135 64 31 15 8 4 5 10", 15.8, 1.225),
}


def numbers(text: str) -> list[float]:
    return [float(word) for word in text.split()]


@pytest.mark.parametrize("elongation", TABLE)
def test_table_of_ansi_40(validated: Callable[..., None], elongation: float) -> None:
    """All ten rollers to the printed digits; one tooth more than half of z = 20 is on the strand."""
    tension, force, angle, shift = TABLE[elongation]
    loads = wrap(FORMS["ANSI"](20)).loads(1.0, elongation)
    how = {"absolute": True, "page": elongation in (0.0, 0.03)}
    name, source = f"ANSI 40, 20 teeth, {100 * elongation:g} %", "table of an independent program"
    validated(f"tensions, {name}", loads.tension, numbers(tension), 0.6, source, "N", **how)
    validated(f"tooth forces, {name}", loads.force, numbers(force), 0.6, source, "N", **how)
    found = math.degrees(loads.pressure_angle[0])
    validated(f"first pressure angle, {name}", found, angle, 0.06, source, "deg", **how)
    assert loads.radius_shift[0] == pytest.approx(shift, abs=6e-4)


def test_last_two_rollers_of_the_table_touch_the_opposite_flank() -> None:
    """Those of 3 %; a contact beyond the seat has an angle above 90 degrees."""
    loads = wrap(FORMS["ANSI"](20)).loads(1.0, 0.03)
    assert (np.degrees(loads.pressure_angle[-2:]) > 90.0).all()
    assert (np.degrees(loads.pressure_angle[:-2]) < 35.0 - 120.0 / 20.0 + 0.1).all()


@pytest.mark.parametrize(
    ("form", "elongation", "tension", "force", "angle"),
    [
        ("ISO min", 0.00, "1000 383 146 56 24.0", 657, 12.1),
        ("ISO min", 0.03, "1000", 604, 14.9),
        ("ISO max", 0.00, "1000 554 303 165 90", 521, 22.3),
        ("ISO max", 0.03, "1000", 488, 24.2),
    ],
)
def test_table_of_08b(
    validated: Callable[..., None], form: str, elongation: float, tension: str, force: float, angle: float
) -> None:
    loads = wrap(FORMS[form](17)).loads(1.0, elongation)
    expected = numbers(tension)
    assert loads.tension[: len(expected)] == pytest.approx(expected, abs=1.0)
    name, source = f"08B, {form}, {100 * elongation:g} %", "table of an independent program"
    first = loads.force[0]
    how = {"absolute": True, "page": elongation == 0.0}
    validated(f"first tooth force, {name}", first, force, 1.0, source, "N", **how)
    assert math.degrees(loads.pressure_angle[0]) == pytest.approx(angle, abs=0.06)
    assert loads.force.size == 9
    if (form, elongation) == ("ISO min", 0.03):
        assert loads.radius_shift[0] == pytest.approx(1.048, abs=1e-3)


@pytest.mark.parametrize("teeth", [9, 13, 20, 25, 45])
@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("stiffness", [STIFFNESS, 1e7])
def test_binder_without_elongation(form: str, teeth: int, stiffness: float) -> None:
    """Within 2 % of the tight tension with the form's own angle, 0.5 % with those found."""
    gap = FORMS[form](teeth)
    loads = wrap(gap, stiffness=stiffness).loads(1.0)
    step, angle = 2.0 * math.pi / teeth, seated_angle(gap)
    falling = 1000.0 * progression(angle, step) ** np.arange(loads.force.size)
    held = falling > 20.0
    assert loads.tension == pytest.approx(np.maximum(falling, 20.0), abs=20.0)
    share = math.sin(step) / math.sin(angle + step)
    assert loads.force[held] == pytest.approx(share * falling[held], abs=20.0)
    ratios = [progression(found, step) for found in loads.pressure_angle[:-1]]
    found = 1000.0 * np.concatenate([[1.0], np.cumprod(ratios)])
    assert loads.tension == pytest.approx(found, abs=5.0)


@dataclass(frozen=True)
class Statics:
    """What is left of all forces, by places, tensions and friction of a solution."""

    moment: float
    rollers: float
    links: float


def statics(mechanism: WrapMechanism, loads: WrapLoads, elongation: float, first: int) -> Statics:
    """Return the unbalanced moment [T r], force on a roller [T] and link law [T].

    Friction acts on each roller along the path from the right to the left flank, with
    min(mu_tooth, mu_bush r_bush/r_roller) of the normal force; against it on a driven sprocket.
    """
    pull, chain = mechanism.pull, mechanism.chain
    share = min(pull.friction_roller_tooth, 0.7 * pull.friction_roller_bush)
    along = np.column_stack([-loads.normal[:, 1], loads.normal[:, 0]])
    sign = 1.0 if pull.driver else -1.0
    teeth = (loads.normal + sign * share * along) * loads.force[:, None]
    ends = np.zeros_like(teeth)
    ends[0] += pull.tight * loads.tight_direction
    ends[-1] += pull.slack * loads.slack_direction
    way = np.diff(loads.centre, axis=0)
    length = np.hypot(*way.T)
    links = (way.T / length * loads.tension[1:]).T
    rollers = teeth + ends
    rollers[:-1] += links
    rollers[1:] -= links
    outer = (np.arange(length.size) + first) % 2
    longer = 2.0 * elongation * outer if chain.alternating else elongation
    pitch = PITCH * (1.0 + longer)
    stretch = np.maximum(chain.link_stiffness * (length - pitch), 0.0)
    outside = teeth + ends
    moment = np.sum(loads.centre[:, 0] * outside[:, 1] - loads.centre[:, 1] * outside[:, 0])
    return Statics(
        abs(float(moment)) / (pull.tight * mechanism.pitch_radius),
        float(np.hypot(*rollers.T).max()) / pull.tight,
        float(np.abs(stretch - loads.tension[1:]).max()) / pull.tight if length.size else 0.0,
    )


def test_random_cases_are_in_equilibrium() -> None:
    """Moment on the sprocket, three forces on each roller, and each link's law."""
    random = np.random.default_rng(7)
    solved, aloft, rubbed = 0, 0, 0
    for _ in range(150):
        gap = FORMS[str(random.choice(list(FORMS)))](int(random.integers(9, 61)))
        elongation, phase = random.uniform(0.0, 0.03), random.uniform()
        first = int(random.integers(2))
        mechanism = wrap(
            gap,
            slack=random.uniform(20.0, 100.0),
            alternating=bool(random.integers(2)),
            driver=bool(random.integers(2)),
            friction=[(0.0, 0.3), (0.1, 0.3), (0.3, 0.1)][random.integers(3)],
            wrap_angle=random.uniform(2.2, 4.0),
            nodes=301,
        )
        try:
            loads = mechanism.loads(phase, elongation, first)
        except ContactError:
            continue
        left = statics(mechanism, loads, elongation, first)
        assert left.moment < 1e-6
        assert left.rollers < 1e-6
        assert left.links < 1e-6
        assert loads.force.min() > -1e-6
        solved, aloft = solved + 1, aloft + int(loads.force.min() == 0.0)
        rubbed += mechanism.friction_angle_tangent > 0.0
    assert solved > 140
    assert aloft > 10
    assert rubbed > 50


@dataclass(frozen=True)
class ExactArcs:
    """The roller path of a gap as arcs and lines, by the way from its bottom."""

    gap: Gap

    def place(self, way: float) -> tuple[Array, Array]:
        """Return place and direction of travel; a way below zero lies on the right flank."""
        left = abs(way)
        parts = self.gap.roller_path()
        for number, part in enumerate(parts):
            if left <= part.length or number == len(parts) - 1:
                point = part.point_at(left)
                turn = part.sense * left / part.radius if isinstance(part, ArcSegment) else 0.0
                direction = (part.start_tangent if isinstance(part, ArcSegment) else part.direction) + turn
                break
            left -= part.length
        side = 1.0 if way >= 0.0 else -1.0
        return (
            np.array([-side * point[0], point[1]]),
            np.array([-math.cos(direction), side * math.sin(direction)]),
        )


@dataclass(frozen=True)
class Potential:
    """Potential energy of an elastic chain with uniform links on exact arcs, and its gradient."""

    gap: Gap
    rollers: int
    phase: float
    link: float
    slack: float = 20.0
    wrap_angle: float = math.pi

    def place(self, ways: Array) -> tuple[Array, Array]:
        path, step = ExactArcs(self.gap), 2.0 * math.pi / self.gap.teeth
        places, directions = [], []
        for i, way in enumerate(ways):
            cosine, sine = math.cos(i * step), math.sin(i * step)
            turn = np.array([[cosine, sine], [-sine, cosine]])
            place, direction = path.place(float(way))
            places.append(turn @ place)
            directions.append(turn @ direction)
        return np.array(places), np.array(directions)

    def forces(self, places: Array) -> tuple[float, Array, Array]:
        """Return energy, force of the chain on each roller, and tension of each link."""
        step = 2.0 * math.pi / self.gap.teeth
        tight = step * (self.phase - 0.5)
        last = self.wrap_angle - tight  # the slack strand leaves where the wrap ends
        pulls = (
            1000.0 * np.array([-math.cos(tight), -math.sin(tight)]),
            self.slack * np.array([math.cos(last), -math.sin(last)]),
        )
        way = np.diff(places, axis=0)
        length = np.hypot(*way.T)
        stretch = np.maximum(length - self.link, 0.0)
        energy = (
            0.5 * STIFFNESS * float(stretch @ stretch)
            - float(pulls[0] @ places[0])
            - float(pulls[1] @ places[-1])
        )
        links = (way.T / length * STIFFNESS * stretch).T
        force = np.zeros_like(places)
        force[0] += pulls[0]
        force[-1] += pulls[1]
        force[:-1] += links
        force[1:] -= links
        return energy, force, STIFFNESS * stretch

    def __call__(self, ways: Array) -> tuple[float, Array]:
        places, directions = self.place(ways)
        energy, force, _ = self.forces(places)
        return energy, -np.einsum("ij,ij->i", force, directions)


@pytest.mark.parametrize(
    ("form", "teeth", "elongation", "phase"),
    [("ANSI", 20, 0.02, 1.0), ("ANSI", 20, 0.03, 0.5), ("ISO min", 17, 0.0, 1.0), ("ISO max", 17, 0.01, 0.7)],
)
def test_independent_minimum_on_exact_arcs(
    validated: Callable[..., None], form: str, teeth: int, elongation: float, phase: float
) -> None:
    """Another minimiser from another start on arcs and lines: the same forces to 0.1 % of T_t."""
    gap = FORMS[form](teeth)
    loads = wrap(gap).loads(phase, elongation)
    potential = Potential(gap, loads.force.size, phase, PITCH * (1.0 + elongation))
    start = np.full(loads.force.size, 0.3)
    found = minimize(potential, start, jac=True, method="BFGS", options={"gtol": 1e-6})
    places, _ = potential.place(found.x)
    _, force, tension = potential.forces(places)
    assert loads.tension[1:] == pytest.approx(tension, abs=1.0)
    name, source = f"{form}, {teeth} teeth, {100 * elongation:g} %", "minimum on exact arcs"
    expected = np.hypot(*force.T)
    how = {"absolute": True, "page": phase == 1.0}
    validated(f"tooth forces, {name}", loads.force, expected, 1.0, source, "N", **how)
    assert loads.centre == pytest.approx(places, abs=2e-4)
    assert potential.forces(loads.centre)[0] == pytest.approx(found.fun, abs=5e-3)
    random = np.random.default_rng(3)
    aside = random.normal(0.0, 0.02, (50, start.size))
    assert min(potential(found.x + step)[0] for step in aside) > found.fun


@pytest.mark.parametrize("elongation", [0.0, 0.02])
def test_load_distribution_hardly_depends_on_the_elastic_properties(elongation: float) -> None:
    """Naji & Marshek, fact 1: links 100 times as stiff shift no tension by more than 2 % of T_t."""
    gap = FORMS["ANSI"](20)
    soft, stiff = (wrap(gap, stiffness=k).loads(1.0, elongation) for k in (1e4, 1e6))
    change = np.abs(stiff.tension - soft.tension).max()
    assert 1.0 < change < 20.0


RATIOS = {
    (20, 0.05): (0.6905, 0.6326),
    (20, 0.10): (0.7157, 0.5992),
    (20, 0.15): (0.7389, 0.5621),
    (20, 0.20): (0.7603, 0.5209),
    (17, 0.05): (0.6500, 0.5867),
    (17, 0.10): (0.6779, 0.5505),
}


@pytest.mark.parametrize(("teeth", "friction"), RATIOS)
def test_driver_differs_from_driven_by_friction(
    validated: Callable[..., None], teeth: int, friction: float
) -> None:
    """Fact 2: sin(phi +- delta)/sin(phi +- delta + alpha), printed for phi = 35 - 120/z degrees."""
    for driver, printed in zip((True, False), RATIOS[teeth, friction], strict=True):
        mechanism = wrap(FORMS["ANSI"](teeth), slack=100.0, driver=driver, friction=(friction, 10.0))
        tension = mechanism.loads(1.0).tension
        which = "driver" if driver else "driven"
        validated(
            f"tension ratio of the first links, {which}, friction {friction:g}",
            *(tension[1] / tension[0], printed, 0.015, "Naji & Marshek, fact 2"),
            page=(teeth, friction) == (20, 0.1),
        )
        delta = math.atan(friction) * (1.0 if driver else -1.0)
        angle = math.radians(35.0 - 120.0 / teeth) + delta
        assert progression(angle, 2.0 * math.pi / teeth) == pytest.approx(printed, abs=1e-4)


def test_oil_on_the_teeth_changes_nothing_where_rollers_roll() -> None:
    """Fact 3: the roller slips on its bush first, so that friction on the tooth does not count.

    mu_tooth r_roller > mu_bush r_bush with the bush at 0.7 of the roller; oil in the joint, from
    0.1 to 0.05, shifts tensions by less than 3 % of T_t.
    """
    gap = FORMS["ANSI"](20)
    dry, oiled, all_oiled = (
        wrap(gap, slack=50.0, friction=pair).loads(1.0, 0.01).tension
        for pair in ((0.3, 0.1), (0.1, 0.1), (0.1, 0.05))
    )
    assert oiled == pytest.approx(dry, rel=1e-12)
    assert np.abs(all_oiled - dry).max() < 30.0


def test_larger_sprocket_pitch_amplifies_the_tension() -> None:
    """Fact 4: gaps cut for a pitch 0.5 % above the chain's; links inside pull more than T_t."""
    first, largest = [], []
    for factor in (0.998, 1.0, 1.002, 1.003, 1.005):
        gap = ansi_b29_gap(factor * PITCH, 7.92, 20)
        tension = wrap(gap).loads(1.0).tension
        first.append(float(tension[1]))
        largest.append(float(tension[1:].max()))
    assert all(before < after for before, after in pairwise(first))
    assert largest[-1] > 1000.0 > largest[1]


@pytest.mark.parametrize("elongation", [0.02, 0.03])
@pytest.mark.parametrize("teeth", [13, 20])
@pytest.mark.parametrize("form", FORMS)
def test_rollers_climb_freely(form: str, teeth: int, elongation: float) -> None:
    """dr = eps d/2, for the mean of both link kinds where they alternate."""
    gap = FORMS[form](teeth)
    climb = elongation * gap.pitch_radius
    assert wrap(gap).loads(1.0, elongation).radius_shift[0] == pytest.approx(climb, rel=0.05)
    both = wrap(gap, alternating=True)
    shifts = [both.loads(1.0, elongation, first).radius_shift[0] for first in (0, 1)]
    assert np.mean(shifts) == pytest.approx(climb, rel=0.08)
    assert shifts[1] > climb > shifts[0] or shifts[0] > climb > shifts[1]


def test_alternating_pitches_load_teeth_in_turn(validated: Callable[..., None]) -> None:
    """At 3 %: 413 or 622 N on the first tooth, 540 N where all links are alike."""
    gap = FORMS["ANSI"](20)
    both = wrap(gap, alternating=True)
    forces = [both.loads(1.0, 0.03, first).force[0] for first in (0, 1)]
    name, source = "first tooth force, links in turn, 3 %", "table of an independent program"
    validated(name, forces, [413.0, 622.0], 0.6, source, "N", absolute=True)
    assert wrap(gap).loads(1.0, 0.03).force[0] == pytest.approx(540.0, abs=0.6)


def test_first_force_grows_from_nothing_within_a_pitch() -> None:
    """To the printed 426 N, as sin of the angle by which the strand has turned.

    The first roller has its own tooth to pull against, T sin(turn)/sin(phi + turn), until the
    strand has turned by a pitch angle.
    """
    mechanism = wrap(FORMS["ANSI"](20))
    phases = np.linspace(0.0, 1.0, 9)
    loads = [mechanism.loads(float(phase)) for phase in phases]
    force = np.array([found.force[0] for found in loads])
    assert (np.diff(force) > 0.0).all()
    assert force[0] < 20.0
    assert force[-1] == pytest.approx(426.0, abs=0.6)
    step = math.radians(18.0)
    turn = phases * step
    angle = np.array([found.pressure_angle[0] for found in loads])
    assert force == pytest.approx(1000.0 * np.sin(turn) / np.sin(angle + step), abs=5.0)


@pytest.mark.parametrize("alternating", [False, True])
@pytest.mark.parametrize("elongation", [0.0, 0.02, 0.03])
def test_phase_0_is_phase_1_counted_one_on(elongation: float, alternating: bool) -> None:
    mechanism = wrap(FORMS["ANSI"](20), alternating=alternating)
    begin, end = mechanism.loads(0.0, elongation, 0), mechanism.loads(1.0, elongation, 1)
    assert begin.force.size == end.force.size + 1
    assert begin.force[0] == pytest.approx(0.0, abs=1e-5)
    assert begin.force[1:] == pytest.approx(end.force, abs=1e-5)
    assert begin.tension[1:] == pytest.approx(end.tension, abs=1e-5)
    assert begin.seat_radius[1:] == pytest.approx(end.seat_radius, abs=1e-6)


@pytest.mark.parametrize("degrees", [120.0, 171.0, 180.0, 201.0, 230.0])
@pytest.mark.parametrize("phase", [0.0, 0.3, 1.0])
def test_number_of_rollers(degrees: float, phase: float) -> None:
    """Rollers 18 degrees apart, the first (1/2 - phase) 18 degrees before the tangent point.

    The last one may stay behind the other tangent point by half a pitch as well.
    """
    loads = wrap(FORMS["ANSI"](20), wrap_angle=math.radians(degrees)).loads(phase)
    last = (phase - 0.5) * 18.0 + 18.0 * (loads.force.size - 1)
    assert degrees - 9.0 - 1e-6 <= last < degrees + 9.0 + 1e-6
    wrapped = math.degrees(
        math.atan2(-loads.slack_direction[1], loads.slack_direction[0])
        - math.atan2(loads.tight_direction[1], -loads.tight_direction[0])
    )
    assert wrapped % 360.0 == pytest.approx(degrees)


@pytest.mark.parametrize("elongation", [0.0, 0.02])
@pytest.mark.parametrize("teeth", [13, 20, 32])
def test_smallest_slack_tension_of_the_concave_form(teeth: int, elongation: float) -> None:
    """Between Binder's bounds with the least and the greatest angle of the working arc.

    T_t [sin(phi)/sin(phi + alpha)]^n with phi = 17 - 64/z and 35 - 120/z degrees.
    """
    mechanism = wrap(FORMS["ANSI"](teeth))
    step, rollers = 2.0 * math.pi / teeth, mechanism.rollers(1.0)
    low, high = (
        980.0 * progression(math.radians(angle), step) ** rollers
        for angle in (17.0 - 64.0 / teeth, 35.0 - 120.0 / teeth)
    )
    assert low < mechanism.smallest_slack_tension(elongation) < high


@pytest.mark.parametrize("elongation", [0.0, 0.02])
@pytest.mark.parametrize("form", ["ISO min", "ISO max"])
def test_smallest_slack_tension_of_the_convex_forms(form: str, elongation: float) -> None:
    """Binder's bound with the angle found on the first three teeth, within a factor of 2."""
    mechanism = wrap(FORMS[form](20))
    angle = mechanism.loads(1.0, elongation).pressure_angle[:3].mean()
    bound = 980.0 * progression(angle, mechanism.pitch_angle) ** mechanism.rollers(1.0)
    assert 0.5 < mechanism.smallest_slack_tension(elongation) / bound < 2.0


@pytest.mark.parametrize(("form", "elongation"), [("ANSI", 0.0), ("ISO max", 0.02)])
def test_chain_jumps_below_the_slack_tension_that_the_error_names(form: str, elongation: float) -> None:
    mechanism = wrap(FORMS[form](20), slack=0.5)
    with pytest.raises(ContactError, match="the chain jumps") as caught:
        mechanism.loads(1.0, elongation)
    named = float(str(caught.value).split("at least ")[1].split()[0])
    held = replace(mechanism, pull=replace(mechanism.pull, slack=named))
    for phase in np.linspace(0.0, 1.0, 8):
        assert held.loads(float(phase), elongation).force.max() > 0.0
    assert named == pytest.approx(mechanism.smallest_slack_tension(elongation), rel=0.011)
    lower = replace(mechanism, pull=replace(mechanism.pull, slack=0.9 * named))
    assert not lower.holds(elongation)


def test_no_slack_tension_holds_a_chain_too_long() -> None:
    """Rollers that climb by eps d/2 = 6.1 mm stand above the teeth of z = 20, 3.3 mm."""
    mechanism = wrap(FORMS["ANSI"](20))
    assert mechanism.smallest_slack_tension(0.15) == math.inf
    with pytest.raises(ContactError, match="give a shorter elongation"):
        mechanism.loads(1.0, 0.15)


@pytest.mark.parametrize("first", [0, 1])
@pytest.mark.parametrize("phase", [0.0, 0.25, 0.5, 0.75])
def test_roller_aloft_carries_nothing(first: int, phase: float) -> None:
    """Links alternate by 6 %; a tooth without force hands the tension of its link on.

    Its roller hangs outside the path of rollers in contact, on the line of its neighbours.
    """
    mechanism = wrap(FORMS["ANSI"](20), alternating=True)
    loads = mechanism.loads(phase, 0.03, first)
    tension = np.append(loads.tension, 20.0)
    aloft = np.flatnonzero(loads.force == 0.0)
    if (phase, first) == (0.25, 0):
        assert aloft[0] == 0
        assert loads.tension[:2] == pytest.approx([1000.0, 1000.0], rel=1e-12)
    assert tension[aloft + 1] == pytest.approx(tension[aloft], rel=1e-12)
    places = np.vstack([loads.centre[0] + loads.tight_direction, loads.centre])
    for roller in aloft:
        before, after = places[roller + 1] - places[roller], places[roller + 2] - places[roller + 1]
        assert abs(before[0] * after[1] - before[1] * after[0]) < 1e-9


def test_worn_outline_is_the_unworn_one_built_so() -> None:
    """0.1 mm off the whole gap moves the roller's centres like a roller thinner by 0.1 mm."""
    gap, elongation = FORMS["ANSI"](20), 0.02
    mechanism = wrap(gap)
    worn = mechanism.outline.recede(0.1)
    path = mechanism.path.worn(np.array(worn.x), np.array(worn.y))
    found = mechanism.loads(1.0, elongation, worn=(path,))
    thin = replace(
        mechanism,
        path=roller_path(mechanism.outline, gap.roller_radius - 0.1, 301),
        chain=replace(mechanism.chain, roller_radius=gap.roller_radius - 0.1),
    ).loads(1.0, elongation)
    built = replace(mechanism, outline=worn, path=roller_path(worn, gap.roller_radius, 301)).loads(
        1.0, elongation
    )
    for other in (thin, built):
        assert found.tension == pytest.approx(other.tension, abs=0.1)
        assert found.force == pytest.approx(other.force, abs=0.1)
        assert found.centre == pytest.approx(other.centre, abs=1e-4)
    assert np.abs(found.force - mechanism.loads(1.0, elongation).force).max() > 1.0


def test_two_kinds_of_worn_gaps_alternate() -> None:
    mechanism = wrap(FORMS["ANSI"](20))
    worn = mechanism.outline.recede(0.05)
    other = mechanism.path.worn(np.array(worn.x), np.array(worn.y))
    here, swapped = (mechanism.unworn, other), (other, mechanism.unworn)
    one, two = mechanism.loads(1.0, 0.01, 0, here), mechanism.loads(1.0, 0.01, 1, swapped)
    assert one.force == pytest.approx(two.force, abs=1e-4)
    same = mechanism.loads(1.0, 0.01, 1, (mechanism.unworn, mechanism.unworn))
    assert same.force == pytest.approx(mechanism.loads(1.0, 0.01).force, abs=1e-4)
    assert np.abs(one.force - same.force).max() > 1.0
