"""Gears of any line of action as wearing pairs: meshes, sharing and first wear.

Expected: the closed forms of the involute, arcs of the flanks between two contacts, flanks turned to
a common contact, springs solved by bracketing, and the stress that was prescribed.
"""

import math
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq

import wearsim
from tests.drives import depth_limit
from wearsim.contact.hertz import contact_modulus, peak_pressure
from wearsim.contact.prescribed_stress import LineLoad, LoadedPair, StressProfile
from wearsim.contact.synthesised_pair import SynthesisedPair
from wearsim.errors import GeometryError
from wearsim.geometry.gear.convex_concave import ConvexConcave
from wearsim.geometry.gear.involute import InvolutePair
from wearsim.geometry.gear.mesh import Mesh, ToothPair, mesh_on
from wearsim.geometry.gear.path_of_contact import involute
from wearsim.geometry.gear.plane_gearing import PitchCircles
from wearsim.geometry.profile_points import Profile
from wearsim.kernels.gear_pair import turned_by_depth
from wearsim.mechanisms.gear_pair.contact import GearPairMechanism
from wearsim.wear.advance import run_advance
from wearsim.wear.law import archard
from wearsim.wear.problem import WearProblem

CASES = Path(__file__).parents[2] / "cases"
STEEL = contact_modulus((2.1e5, 2.1e5), (0.3, 0.3))
TORQUE = 240e3 / 76.0
C14 = InvolutePair((16, 24), 4.5, math.radians(20.0), (0.1817, 0.1715), (41.318, 59.272))
BOSANSKY = ConvexConcave(4.5, 17, 34, math.radians(20.0), 10.0, 10.0, 4.5)
UNEQUAL = ConvexConcave(4.5, 23, 31, math.radians(22.0), 9.0, 12.0, 4.5)


def prescribed(stress: float = 454.1608627, reach: float = 7.0) -> SynthesisedPair:
    law = StressProfile(np.array([0.0]), np.array([stress]))
    loaded = LoadedPair(PitchCircles(135.0, 1.5), STEEL, LineLoad(TORQUE / 54.0, 1), law, 0.0)
    return SynthesisedPair(loaded, (36, 54), (-reach, reach))


PAIRS: dict[str, ToothPair] = {
    "involute": C14,
    "bosansky": BOSANSKY,
    "unequal arcs": UNEQUAL,
    "constant stress": prescribed(),
}
EVERY_PAIR = pytest.mark.parametrize("name", PAIRS)


@cache
def mesh_of(name: str, points: int = 401) -> Mesh:
    return PAIRS[name].mesh(points)


def test_a_straight_line_of_action_is_the_involute() -> None:
    """All that a mesh holds, the gaps of the corners of the tips included."""
    exact = C14.mesh(401)
    found = mesh_on(involute(C14.circles, C14.working_angle, exact.pitch_point_distance), C14.teeth)
    for what in ("pitch_point_distance", "lever", "rolling", "curvature", "arc", "levers"):
        np.testing.assert_allclose(getattr(found, what), getattr(exact, what), rtol=0, atol=1e-10)
    both = np.isfinite(exact.gaps) & np.isfinite(found.gaps)
    np.testing.assert_allclose(found.gaps[both], exact.gaps[both], rtol=0, atol=1e-8)
    assert (exact.gaps[both] < 0.05).sum() > 200
    assert (exact.gaps[~both] > 0.5).all()
    assert found.contact_ratio == pytest.approx(C14.contact_ratio, rel=1e-12)
    np.testing.assert_allclose(found.flank.y - found.flank.y[0] > 0.0, [False] + [True] * 400)


@pytest.mark.parametrize("name", ["bosansky", "unequal arcs", "constant stress"])
def test_flanks_touch_on_the_line_of_action(name: str) -> None:
    """Both turned to a contact: the same point, as far from the pitch point as it says."""
    mesh, circles = mesh_of(name), PAIRS[name].circles
    for k in (3, 100, 200, 300, 397):
        turn = mesh.place[k] / circles.pinion_radius
        pinion = rotated(mesh.flank, k, -turn)
        pinion[1] -= circles.pinion_radius
        wheel = rotated(mesh.mate, -1 - k, turn / circles.gear_ratio)
        wheel[1] += circles.wheel_radius
        np.testing.assert_allclose(pinion, wheel, rtol=0, atol=1e-8)
        assert math.hypot(*pinion) == pytest.approx(abs(mesh.pitch_point_distance[k]), abs=1e-8)


def rotated(flank: Profile, index: int, angle: float) -> np.ndarray:
    x, y = flank.x[index], flank.y[index]
    return np.array([x * math.cos(angle) - y * math.sin(angle), x * math.sin(angle) + y * math.cos(angle)])


@EVERY_PAIR
def test_rolling_and_curvature_are_those_of_the_points(name: str) -> None:
    """Arcs between neighbouring contacts over the turn; circles through three points."""
    mesh = mesh_of(name, 4001)
    per_turn = mesh.pitch * PAIRS[name].teeth[0] / math.tau
    near_pitch_point = np.abs(mesh.pitch_point_distance) < 0.02
    turn = np.diff(mesh.place) / per_turn
    for k, flank in enumerate((mesh.flank, mesh.mate)):
        chord = np.hypot(np.diff(flank.x), np.diff(flank.y))[:: 1 - 2 * k]
        middle = 0.5 * (mesh.rolling[k, 1:] + mesh.rolling[k, :-1])
        off_pitch_point = np.sign(mesh.place[1:]) == np.sign(mesh.place[:-1])  # curvatures jump there
        np.testing.assert_allclose((chord / turn)[off_pitch_point], middle[off_pitch_point], rtol=2e-5)
        np.testing.assert_allclose(mesh.arc[k, -1], chord.sum(), rtol=1e-6)
        curvature = flank.curvature[:: 1 - 2 * k]
        off = np.abs(curvature - mesh.curvature[k])[~near_pitch_point][1:-1]
        assert off.max() < 2e-4 * np.abs(mesh.curvature[k]).max()


@EVERY_PAIR
def test_sliding_is_the_difference_of_both_ways(name: str) -> None:
    """h = k q |1 - ds2/ds1| for the pinion, and for the wheel what its own arc gives."""
    pair = PAIRS[name]
    of = GearPairMechanism(pair, 400.0 * pair.circles.pinion_radius, 10.0, STEEL, 1.0, 0.0, 2001)
    mesh = of.mesh
    run, _ = run_advance(WearProblem(of.contact, archard(1e-10), (depth_limit(0.02),), 1e12), 1e-4)
    way = np.diff(mesh.arc, axis=1)
    depth, cycles = run.depth[-1], run.cycles[-1]
    load = 400.0 * pair.circles.pinion_radius * of.share / mesh.lever
    middle = np.abs(mesh.pitch_point_distance[1:]) > 0.02  # the slip has a kink at the pitch point
    slip = np.abs(1.0 - way[1] / way[0])
    expected = 1e-10 * 0.5 * (load[1:] + load[:-1]) * slip * cycles
    np.testing.assert_allclose(
        0.5 * (depth[1:] + depth[:-1])[middle], expected[middle], rtol=0, atol=1e-4 * depth.max()
    )
    wheel = 1e-10 * 0.5 * (load[1:] + load[:-1]) * np.abs(1.0 - way[0] / way[1]) * cycles
    wheel *= pair.teeth[0] / pair.teeth[1]
    ratio = 0.5 * (of.mate_depth * depth)[1:] + 0.5 * (of.mate_depth * depth)[:-1]
    np.testing.assert_allclose(ratio[middle], wheel[middle], rtol=0, atol=1e-4 * depth.max())


def test_turn_of_springs_is_that_of_the_balance() -> None:
    rng = np.random.default_rng(8)
    for _ in range(300):
        gaps, levers = rng.uniform(0.0, 0.05, 3), rng.uniform(20.0, 60.0, 3)
        gaps[1 + rng.integers(2)] = rng.choice([0.01, np.inf])
        torque = 10.0 ** rng.uniform(-2.0, 2.0)

        def over(turn: float, g: np.ndarray = gaps, w: np.ndarray = levers, t: float = torque) -> float:
            return float((w * np.maximum(0.0, turn * w - g)).sum() - t)

        found = turned_by_depth(torque, *np.column_stack([gaps, levers]).ravel())
        assert found == pytest.approx(brentq(over, 0.0, 10.0, xtol=1e-16), rel=1e-9)


@EVERY_PAIR
def test_torque_is_that_of_all_pairs_in_contact(name: str) -> None:
    """Loads times levers of the pairs that touch at once, new and worn."""
    pair = PAIRS[name]
    torque = 400.0 * pair.circles.pinion_radius
    of = GearPairMechanism(pair, torque, 10.0, STEEL, 1.0, 14000.0, 8001)
    contact, mesh = of.contact, of.mesh
    for worn in (0.0, 0.02):
        depth = worn * (1.0 + np.cos(0.7 * mesh.place)) ** 2
        touch = contact.engage(contact.profile.x.copy(), contact.profile.y.copy(), depth)
        moment = touch.load_per_width * mesh.lever
        inside = mesh.place + mesh.pitch <= mesh.place[-1]
        both = moment[inside] + np.interp(mesh.place[inside] + mesh.pitch, mesh.place, moment)
        np.testing.assert_allclose(both, torque, rtol=1e-3)


def test_stress_of_a_single_pair_is_the_prescribed_one(validated: Callable[..., None]) -> None:
    pair = prescribed()
    of = GearPairMechanism(pair, TORQUE, 10.0, STEEL, 1.0, 0.0, 401)
    touch = of.contact.engage(of.flank.x.copy(), of.flank.y.copy(), np.zeros(401))
    stress = peak_pressure(touch.load_per_width, touch.relative_curvature, STEEL)
    single = of.share == 1.0
    assert single.sum() > 80
    quantity, source = "stress of a single pair in contact", "prescribed"
    validated(quantity, stress[single], 454.1608627, 1e-9, source, "MPa")
    double = of.share == 0.5
    np.testing.assert_allclose(stress[double], 454.1608627 * math.sqrt(0.5), rtol=1e-9)


def test_contact_ratio_is_that_of_the_closed_form(validated: Callable[..., None]) -> None:
    for pair in (BOSANSKY, UNEQUAL):
        quantity, found = "contact ratio of the mesh, 17 and 34 teeth", pair.mesh(101).contact_ratio
        source, shown = "arcs of the line of action", pair is BOSANSKY
        validated(quantity, found, pair.contact_ratio, 1e-12, source, page=shown)


@pytest.mark.parametrize(
    ("pair", "message"),
    [
        (prescribed(reach=25.0), "width of the tip of the pinion must be above 0"),
        (prescribed(stress=300.0), "must be above .* at the pitch point"),
        (prescribed(reach=100.0), "family [+]1 from .* must end before"),
    ],
)
def test_pairs_that_cannot_run(pair: ToothPair, message: str) -> None:
    with pytest.raises(GeometryError, match=message):
        pair.mesh(101)


def test_constant_stress_lives_longer(validated: Callable[..., None]) -> None:
    """Than the involute of the same pressure angle and stress at the pitch point, over the same path.

    Rigid teeth: h = k q |1 - v2/v1|, the greatest of which the first contact has in both.
    """
    names = "constant-stress-36t-mild", "involute-36t-mild"
    cases = {name: wearsim.load_case(CASES / f"{name}.toml") for name in names}
    one, other = (cases[name].drive.pair for name in names)
    assert one.pitch_point_angle == pytest.approx(other.pitch_point_angle, abs=1e-8)
    assert one.mesh(11).pitch_point_distance[[0, -1]] == pytest.approx([-7.0, 7.0])
    assert other.mesh(11).pitch_point_distance[[0, -1]] == pytest.approx([-7.0, 7.0], abs=1e-6)
    lives = {
        sharing: [
            wearsim.simulate(
                wearsim.load_case(CASES / f"{name}.toml", [f"mechanism.load_sharing={sharing}"])
            ).life.hours_run
            for name in names
        ]
        for sharing in ("rigid", "elastic")
    }
    first = 54.0 * math.sin(math.radians(20.0)) - 7.0
    slip = abs(1.0 - (135.0 * math.sin(math.radians(20.0)) - first) / (1.5 * first))
    lever, stress = 54.0 * math.cos(math.radians(20.0)), prescribed().mesh(11)
    slips = abs(1.0 - stress.rolling[1, 0] / stress.rolling[0, 0]), slip
    source = "0.05 mm over the first wear per mesh"
    for name, found, way, arm in zip(names, lives["rigid"], slips, (stress.lever[0], lever), strict=True):
        hours = 0.05 / (1e-12 * 0.5 * TORQUE / arm * way) / 60e3
        validated(f"life of {name}, rigid teeth", found, hours, 1e-4, source, "h")
    assert lives["rigid"][0] / lives["rigid"][1] == pytest.approx(1.225, abs=2e-3)
    assert lives["elastic"][0] / lives["elastic"][1] == pytest.approx(1.045, abs=2e-3)


def test_contact_fatigue_of_constant_stress(validated: Callable[..., None]) -> None:
    """454.16 MPa at 240 N m is 1180.8 MPa at 6.76 times that: on 23 HRC / 1.2 N_HG K^-6 over 60 n."""
    side = '{treatment="carburised",hardness_HRC=60}'
    settings = ["load.torque_N_m=1622.4", "gear.design_torque_N_m=240"]
    settings += [f"fatigue.{gear}={side}" for gear in ("pinion", "wheel")]
    path = CASES / "constant-stress-36t-mild.toml"
    result = wearsim.simulate(wearsim.load_case(path, settings))
    hours = 1.2e8 * (2.6 * 454.1608627 / (23.0 * 60.0 / 1.2)) ** -6 / (60.0 * 1000.0)
    source = "source 001 by hand"
    for name, times in (("pinion", 1.0), ("wheel", 1.5)):
        found = result.parts[f"{name}_fatigue"].hours_run
        validated(f"hours of the {name} to contact fatigue", found, times * hours, 1e-4, source, "h")
