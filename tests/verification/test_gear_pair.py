"""Gear pair: FZG C14, initial wear per mesh, and closed forms of rigid and elastic sharing.

Expected: GEARpie's gear C14 and the single-point observation of Flodin and Andersson with
k = 1e-10 mm2/N, computed apart (p0, half-width, sliding and wear at A to E); springs solved by
bracketing; the corner of a tip met by turning the gears.
"""

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq

import wearsim
from tests.drives import depth_limit
from wearsim.contact.hertz import contact_modulus, half_width, peak_pressure
from wearsim.errors import GeometryError
from wearsim.geometry.gear.involute import InvolutePair
from wearsim.mechanisms.gear_pair.contact import GearPairMechanism
from wearsim.wear.advance import run_advance
from wearsim.wear.law import archard, power
from wearsim.wear.problem import WearProblem

C14 = InvolutePair((16, 24), 4.5, math.radians(20.0), (0.1817, 0.1715), (41.318, 59.272))
MODULUS = contact_modulus((2.06e5, 2.06e5), (0.3, 0.3))
TORQUE = 200e3 / 14.0
LINE_LOAD = TORQUE / C14.base_radius[0]
RATE = 1e-10
SHIPPED = Path(__file__).parents[2] / "cases" / "fzg-c14-16t-mild.toml"

PLACES = {
    "A": C14.path_start,
    "B": C14.path_end - C14.base_pitch,
    "C": C14.pitch_point,
    "D": C14.path_start + C14.base_pitch,
    "E": C14.path_end,
}
# share, p0 [MPa], half-width [um], sliding of pinion and wheel [mm], their wear per mesh [nm]
TABLE = {
    "A": (0.5, 1421.24, 94.58, 0.71040, 0.14938, 0.07930, 0.01667),
    "B": (1.0, 1441.84, 186.46, 0.21029, 0.13446, 0.02381, 0.01523),
    "C": (1.0, 1347.27, 199.54, 0.0, 0.0, 0.0, 0.0),
    "D": (1.0, 1320.08, 203.66, 0.13935, 0.21183, 0.01445, 0.02196),
    "E": (0.5, 999.87, 134.44, 0.18423, 0.58520, 0.01447, 0.04596),
}


def mechanism(stiffness: float = 0.0, points: int = 201) -> GearPairMechanism:
    return GearPairMechanism(C14, TORQUE, 10.0, MODULUS, 1.0, stiffness, points)


def engaged(of: GearPairMechanism, depth: np.ndarray | None = None) -> np.ndarray:
    """Load along the path."""
    contact = of.contact
    worn = np.zeros(of.points) if depth is None else depth
    return contact.engage(contact.profile.x.copy(), contact.profile.y.copy(), worn).load_per_width


def test_geometry_of_c14(validated: Callable[..., None]) -> None:
    source, how = "GEARpie, gear C14", {"absolute": True}
    validated("centre distance of C14", C14.centre_distance, 91.5, 5e-4, source, "mm", **how)
    found = math.degrees(C14.working_angle)
    validated("working pressure angle of C14", found, 22.4389, 5e-5, source, "deg", **how)
    assert C14.base_pitch == pytest.approx(13.2846, abs=5e-5)
    assert C14.line_length == pytest.approx(34.9254, abs=5e-5)
    validated("contact ratio of C14", C14.contact_ratio, 1.4625, 5e-5, source, **how)
    assert C14.pitch_point - C14.path_start == pytest.approx(9.676, abs=5e-4)
    assert pytest.approx(422.29, abs=5e-3) == LINE_LOAD


@pytest.mark.parametrize("name", TABLE)
def test_initial_wear_per_mesh(validated: Callable[..., None], name: str) -> None:
    share, p0, width, pinion, wheel, pinion_wear, wheel_wear = TABLE[name]
    of, place = mechanism(points=20001), PLACES[name]
    curvature, slip, mate = (
        float(np.interp(place, of.place, row)) for row in (of.curvature, of.slip_ratio, of.mate_depth)
    )
    load = share * LINE_LOAD
    found, source = float(peak_pressure(load, curvature, MODULUS)), "GEARpie's geometry by hand"
    shown = name in "ABC"
    validated(f"peak pressure of C14 at {name}", found, p0, 1e-4, source, "MPa", page=shown)
    a = float(half_width(load, curvature, MODULUS))
    assert 1000.0 * a == pytest.approx(width, rel=1e-4)
    assert 2.0 * a * slip == pytest.approx(pinion, rel=1e-4, abs=5e-5)
    # The wheel's tooth meets once in u cycles of the pinion.
    assert 2.0 * a * slip * mate * C14.ratio == pytest.approx(wheel, rel=1e-4, abs=5e-5)
    source, how = "single-point observation", {"absolute": True, "page": name in "AE"}
    for gear, found, expected in (
        ("pinion", 1e6 * RATE * load * slip, pinion_wear),
        ("wheel", 1e6 * RATE * load * slip * mate * C14.ratio, wheel_wear),
    ):
        within = max(3e-4 * expected, 1e-5)
        validated(f"wear per mesh, {gear} at {name}", found, expected, within, source, "nm", **how)


def test_rigid_flanks_wear_at_a_constant_rate() -> None:
    """Archard: h = k q |1 - v2/v1| N at every point, whatever the flanks look like."""
    of = mechanism()
    run, _ = run_advance(WearProblem(of.contact, archard(RATE), (depth_limit(0.02),), 1e12), 1e-4)
    ratio = (C14.line_length - of.place) / (C14.ratio * of.place)
    expected = RATE * LINE_LOAD * of.share * np.abs(1.0 - ratio) * run.cycles[-1]
    np.testing.assert_allclose(run.depth[-1], expected, rtol=1e-6)
    assert run.cycles[-1] == pytest.approx(0.02 / 0.07930e-6, rel=2e-4)


def test_shares_of_rigid_teeth() -> None:
    of = mechanism(points=2001)
    load = engaged(of) / LINE_LOAD
    two = (of.place < PLACES["B"] - 0.3) | (of.place > PLACES["D"] + 0.3)
    one = (of.place > PLACES["B"] + 0.3) & (of.place < PLACES["D"] - 0.3)
    assert (load[two] == 0.5).all()
    assert (load[one] == 1.0).all()
    assert np.interp(PLACES["B"], of.place, load) == pytest.approx(0.75, abs=1e-3)


def worn(of: GearPairMechanism) -> np.ndarray:
    """Some depth of the pinion, more than load can close in places."""
    return 0.03 * (1.0 + np.cos(0.7 * of.place)) ** 2


@pytest.mark.parametrize("depth", [False, True])
def test_elastic_sharing_is_that_of_springs(depth: bool) -> None:
    """Each pair closes its worn gap and that of a tip's corner, then presses."""
    of = mechanism(14000.0, 401)
    h = worn(of) if depth else np.zeros(of.points)
    gap = h * (1.0 + of.mate_depth)
    load = engaged(of, h)
    for j in range(0, of.points, 7):
        places = of.place[j] + C14.base_pitch * np.array([0.0, 1.0, -1.0])
        gaps = np.interp(places, of.place, gap) + C14.separation(places)
        gaps = gaps[np.isfinite(gaps)]
        closing = brentq(
            lambda d, g=gaps: 14000.0 * np.maximum(0.0, d - g).sum() - LINE_LOAD, 0.0, 10.0, xtol=1e-15
        )
        assert load[j] == pytest.approx(14000.0 * max(0.0, closing - gaps[0]), abs=1e-8)


@pytest.mark.parametrize("depth", [False, True])
def test_pairs_in_contact_carry_the_whole_load(depth: bool) -> None:
    of = mechanism(14000.0, 20001)
    load = engaged(of, worn(of) if depth else None)
    inside = of.place + C14.base_pitch <= PLACES["E"]
    both = load[inside] + np.interp(of.place[inside] + C14.base_pitch, of.place, load)
    np.testing.assert_allclose(both, LINE_LOAD, rtol=5e-4)


@pytest.mark.parametrize("way", [0.05, 0.3, 1.0, 2.0])
@pytest.mark.parametrize("end", ["A", "E"])
def test_corner_of_a_tip_meets_after_so_much_turning(way: float, end: str) -> None:
    """The first gear is turned until its involute passes through the corner of the other's tip."""
    own, other = C14.base_radius if end == "A" else C14.base_radius[::-1]
    nominal = PLACES["A"] if end == "A" else C14.line_length - PLACES["E"]
    line = C14.line_length
    # The corner stands at (nominal, 0) where contact starts; before, its gear is turned back.
    back = way / other
    dx, dy = nominal - line, -other
    x = line + math.cos(back) * dx + math.sin(back) * dy
    y = other - math.sin(back) * dx + math.cos(back) * dy

    def off(turn: float) -> float:
        """Distance of the involute from the corner along its tangent, at the corner's radius."""
        radius = math.hypot(x, y + own)
        roll = math.sqrt((radius / own) ** 2 - 1.0)
        start = 0.5 * math.pi - (nominal - way) / own - turn
        angle = start + roll - math.atan(roll)
        return math.atan2(y + own, x) - angle

    turn = brentq(off, -0.5, 0.5, xtol=1e-15)
    place = PLACES["A"] - way if end == "A" else PLACES["E"] + way
    assert C14.separation(np.array([place]))[0] == pytest.approx(own * turn, rel=1e-9)
    assert turn > 0.0


def test_flanks_touch_on_the_line_of_action() -> None:
    """Turned to a common place, point and normal of both flanks are the same."""
    place = np.array([5.0, 9.0, 14.0, 20.0, 23.0])
    pinion, wheel = C14.flank(place), C14.mating_flank(place)
    for j, xi in enumerate(place):
        for flank, radius, tangent, k in (
            (pinion, C14.base_radius[0], xi, j),
            (wheel, C14.base_radius[1], C14.line_length - xi, place.size - 1 - j),
        ):
            # The involute starts at (0, rb); its point for a tangent lies rb and that tangent off.
            assert math.hypot(flank.x[k], flank.y[k]) == pytest.approx(math.hypot(radius, tangent))
            roll = tangent / radius
            end = -radius * math.sin(roll), radius * math.cos(roll)
            assert math.hypot(flank.x[k] - end[0], flank.y[k] - end[1]) == pytest.approx(tangent)


def test_curvature_of_the_flank_is_that_of_its_points() -> None:
    place = np.linspace(C14.path_start, C14.path_end, 4001)
    flank = C14.flank(place)
    np.testing.assert_allclose(flank.curvature[1:-1], 1.0 / place[1:-1], rtol=1e-5)


def test_driving_and_driven_gear_change_places() -> None:
    """The same pair with the wheel as pinion: its depths are those of the wheel, 1/u times as fast."""
    one = mechanism(14000.0, 401)
    swapped = InvolutePair((24, 16), 4.5, C14.pressure_angle, (0.1715, 0.1817), (59.272, 41.318))
    other = GearPairMechanism(swapped, 1.5 * TORQUE, 10.0 / 1.5, MODULUS, 1.0, 14000.0, 401)
    law = archard(RATE)
    first, _ = run_advance(WearProblem(one.contact, law, (depth_limit(1.0),), 1e6), 1e-5)
    second, _ = run_advance(WearProblem(other.contact, law, (depth_limit(1.0),), 1e6 / 1.5), 1e-5)
    wheel = one.mate_columns(first.depth)["wheel_depth_mm"][-401:]
    np.testing.assert_allclose(second.depth[-1][::-1], wheel, rtol=1e-4, atol=1e-7)
    pinion = other.mate_columns(second.depth)["wheel_depth_mm"][-401:]
    np.testing.assert_allclose(pinion[::-1], first.depth[-1], rtol=1e-4, atol=1e-7)


def test_harder_wheel_wears_less_by_its_coefficient() -> None:
    of = GearPairMechanism(C14, TORQUE, 10.0, MODULUS, 0.25, 0.0, 101)
    np.testing.assert_allclose(of.mate_depth, 0.25 * mechanism(points=101).mate_depth, rtol=1e-14)


def test_power_law_follows_the_curvature_of_both_flanks() -> None:
    """m = 3, worn for a short time: dh/dN = K c_m p^2 (4/pi) q slip with the new curvature."""
    of = mechanism(points=101)
    law = power(1e-16, 3.0)
    run, _ = run_advance(WearProblem(of.contact, law, (depth_limit(1.0),), 1.0), 1e-4)
    load = LINE_LOAD * of.share
    p0 = np.sqrt(load * of.curvature * MODULUS / math.pi)
    # Mean of (1 - (x/a)^2)^(3/2) over the width is 3 pi/16.
    expected = (
        1e-16 * (3.0 * math.pi / 16.0) * p0**3 * 2.0 * half_width(load, of.curvature, MODULUS) * of.slip_ratio
    )
    np.testing.assert_allclose(run.depth[-1], expected, rtol=2e-5)


@pytest.mark.parametrize("stiffness", [0.0, 14000.0])
def test_lives_converge_with_the_points(stiffness: float) -> None:
    """Kinks at the pitch point and where a pair takes over: to 2e-3 from 101 points on."""
    law, limit = power(RATE / 1000.0, 2.0), (depth_limit(0.02),)
    lives = []
    for points in (101, 201, 401):
        run, _ = run_advance(WearProblem(mechanism(stiffness, points).contact, law, limit, 1e12), 1e-4)
        lives.append(run.cycles[-1])
    assert lives[0] == pytest.approx(lives[2], rel=5e-3)
    assert lives[1] == pytest.approx(lives[2], rel=2e-3)


@pytest.mark.parametrize(
    ("tips", "shifts", "message"),
    [
        ((41.318, 70.0), (0.1817, 0.1715), "lower the tip radius of gear 2"),
        ((52.0, 59.272), (0.1817, 0.1715), "lower the tip radius of gear 1"),
        ((38.0, 56.0), (0.1817, 0.1715), "contact ratio must be at least 1"),
        ((33.0, 59.272), (0.1817, 0.1715), "must be above its base radius"),
        ((41.318, 59.272), (-1.0, -1.0), "raise the sum of the profile shifts"),
    ],
)
def test_pairs_that_cannot_run(tips: tuple[float, float], shifts: tuple[float, float], message: str) -> None:
    pair = InvolutePair((16, 24), 4.5, math.radians(20.0), shifts, tips)
    with pytest.raises(GeometryError, match=message):
        pair.check()


def test_shipped_case_is_c14(validated: Callable[..., None]) -> None:
    case = wearsim.load_case(SHIPPED, ["mechanism.load_sharing=rigid"])
    result = wearsim.simulate(case)
    expected, source = 0.05 / 0.07930e-6, "0.05 mm over the wear per mesh at A"
    validated("life of the shipped C14", result.life.cycles, expected, 2e-4, source, "cycles")  # type: ignore[union-attr]
    assert result.initial_peak_pressure == pytest.approx(1441.84, rel=1e-2)
    last = result.flank.iloc[-201:]
    assert last["wheel_depth_mm"].max() == pytest.approx(0.05 * 0.04596 / 1.5 / 0.07930, rel=1e-3)


def test_contact_fatigue_beside_the_wear() -> None:
    """23 HRC / 1.2 of carburised teeth: N_HG K^-6 over 60 n, source 001.

    K is that of the highest pressure of the new flanks: more than at C, less than at B where
    elastic teeth begin to share.
    """
    result = wearsim.simulate(wearsim.load_case(SHIPPED))
    highest = result.initial_peak_pressure
    assert 1347.27 < highest < 1441.84
    hours = 1.2e8 * (highest / (23.0 * 60.0 / 1.2)) ** -6 / (60.0 * 100.0)
    assert result.parts["pinion_fatigue"].hours_run == pytest.approx(hours, rel=1e-9)
    assert result.parts["wheel_fatigue"].hours_run == pytest.approx(1.5 * hours, rel=1e-9)
    assert result.summary()["pinion_fatigue_life_hours"] == pytest.approx(hours, rel=1e-9)
    assert not [text for text in result.warnings if "fatigue" in text]
    assert result.governing == "wear"
    loaded = ["load.torque_N_m=350", "wear.specific_wear_rate_mm2_per_N=1e-12"]
    first = " ".join(wearsim.simulate(wearsim.load_case(SHIPPED, loaded)).warnings)
    assert "contact fatigue of the pinion ends the life before wear" in first
    greatest = wearsim.simulate(wearsim.load_case(SHIPPED, ["load.torque_N_m=5000"]))
    assert "too high for the pinion from the start" in " ".join(greatest.warnings)
    assert set(greatest.parts.values()) == {wearsim.Life(0.0, 0.0)}
    assert greatest.governing == "pinion_fatigue"


def test_fatigue_that_never_comes_is_a_bound() -> None:
    result = wearsim.simulate(wearsim.load_case(SHIPPED, ["load.torque_N_m=100"]))
    assert isinstance(result.parts["pinion_fatigue"], wearsim.LowerBound)
    assert result.governing == "wear"


def test_ridges_and_hollows_are_told() -> None:
    """Rigid teeth leave a step where a second pair takes over, and a ridge at the pitch point."""
    deep = ["mechanism.load_sharing=rigid", "stop.critical_depth_mm=0.1"]
    warnings = " ".join(wearsim.simulate(wearsim.load_case(SHIPPED, deep)).warnings)
    assert "the mate bridges hollows" in warnings
    assert "ridges remain where sliding is small" in warnings
    new = ["stop.critical_depth_mm=0.0005", "gear.nodes=101"]
    assert wearsim.simulate(wearsim.load_case(SHIPPED, new)).warnings == ()
