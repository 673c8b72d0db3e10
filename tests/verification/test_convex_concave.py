"""Convex-concave teeth against the figures computed for source 002 with another program.

Those figures are section S2b of the project's reference; where they do not stand in it, the
test computes the number itself: by quadrature, by differences, by the envelope of a flank.
"""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq, minimize_scalar

from wearsim.errors import GeometryError
from wearsim.geometry.gear.circle_fit import fit_circle, rack_arc
from wearsim.geometry.gear.convex_concave import ConvexConcave
from wearsim.geometry.gear.convex_concave_flank import ConvexConcaveFlank
from wearsim.geometry.gear.convex_concave_gear import ConvexConcaveGear
from wearsim.geometry.gear.involute import InvolutePair
from wearsim.geometry.gear.involute_function import involute_over_pins

POLE = math.radians(20.0)
R1 = 38.25
HEAD, FOOT = ConvexConcaveFlank(R1, 10.0, POLE, "head"), ConvexConcaveFlank(R1, 10.0, POLE, "foot")
PAIR = ConvexConcave(4.5, 17, 34, POLE, 10.0, 10.0, 4.5)
OTHER = ConvexConcave(3.0, 23, 41, math.radians(17.0), 7.0, 9.0, 2.7)

HEAD_POINTS = """\
20.000000 0.00000000 38.25000000 38.2500000  4.6769797
21.756258 0.09071680 38.48130111 38.4814080  5.7181619
23.512516 0.21324657 38.75454982 38.7551365  6.7602432
25.268775 0.37203912 39.06750794 39.0692794  7.8024100
27.025033 0.57143509 39.41756367 39.4217055  8.8438732
28.781291 0.81564014 39.80173649 39.8100929  9.8838716
30.537549 1.10869983 40.21668381 40.2319633 10.9216750
32.293808 1.45447559 40.65870905 40.6847161 11.9565885
34.050066 1.85662177 41.12377119 41.1656605 12.9879565
35.806324 2.31856414 41.60749538 41.6720459 14.0151685
37.562582 2.84347998 42.10518460 42.2010894 15.0376646
39.318840 3.43427999 42.61183194 42.7500000 16.0549425"""
ROLLERS = {
    6.5: ("foot", 28.84056672, 38.33534888, 82.84363407),
    7.0: ("foot", 26.21166521, 38.85856980, 84.38561199),
    7.5: ("foot", 22.83362170, 39.40380060, 85.97142187),
    7.776: ("foot", 20.33197083, 39.71846759, 86.87407122),
    8.0: ("head", 20.82224653, 39.97523580, 87.60941699),
    8.5: ("head", 22.58149828, 40.50805291, 89.17050540),
}


def every_flank(pair):
    return [span for gear in (pair.pinion, pair.wheel) for span in gear.flanks()]


FLANKS = [*every_flank(PAIR), *every_flank(OTHER)]
flanks = pytest.mark.parametrize(("flank", "end"), FLANKS)


@pytest.mark.parametrize("line", HEAD_POINTS.splitlines())
def test_points_of_the_head(line):
    _, x, y, r, rho = map(float, line.split())
    # Uniform in alpha up to the tip; printed to six decimals of a degree only.
    place = HEAD_POINTS.splitlines().index(line)
    alpha = POLE + place / 11.0 * (math.radians(39.31884049730) - POLE)
    assert math.degrees(alpha) == pytest.approx(float(line.split()[0]), abs=5e-7)
    assert HEAD.points(alpha) == pytest.approx([x, y], abs=1e-8)
    assert HEAD.radius(alpha) == pytest.approx(r, abs=1e-7)
    assert HEAD.curvature_radius(alpha) == pytest.approx(rho, abs=1e-7)


@pytest.mark.parametrize(
    ("degrees", "x", "y"),
    [(21, 0.04801680, 38.37644115), (25, 0.34521302, 39.01713980), (30, 1.01357754, 40.08662486)],
)
def test_points_at_whole_degrees(validated, degrees, x, y):
    quantity, points = f"addendum point at {degrees} deg", HEAD.points(math.radians(degrees))
    source, shown = "independent program", degrees == 25
    validated(quantity, points, [x, y], 1e-8, source, "mm", absolute=True, page=shown)


def test_functions_take_arrays():
    alpha = np.radians([21.0, 25.0, 30.0])
    assert HEAD.points(alpha).shape == (3, 2)
    for one, row in zip(alpha, HEAD.points(alpha), strict=True):
        assert HEAD.points(one) == pytest.approx(row, abs=0)
    for function in (HEAD.roll_angle, HEAD.curvature, HEAD.path_coordinate, HEAD.rack_radius):
        assert function(alpha) == pytest.approx([float(function(a)) for a in alpha], abs=0)


@pytest.mark.parametrize(("degrees", "phi"), [(25, 0.0493468431), (35, 0.1531840741), (45, 0.2652438749)])
def test_roll_angle(degrees, phi):
    assert HEAD.roll_angle(math.radians(degrees)) == pytest.approx(phi, abs=5e-11)
    assert FOOT.roll_angle(math.radians(degrees)) == pytest.approx(-phi, abs=5e-11)


def test_tip(validated):
    alpha = HEAD.angle_at_radius(42.75)
    found, source = math.degrees(alpha), "independent program"
    validated("pressure angle of the tip", found, 39.3188404973, 1e-11, source, "deg", absolute=True)
    assert HEAD.path_coordinate(alpha) == pytest.approx(6.6164944738, abs=5e-11)
    assert HEAD.roll_angle(alpha) == pytest.approx(0.2004450626, abs=5e-11)
    # The chord of the tip is s = pi m / 2 at the pitch circle.
    assert PAIR.pinion.tip_thickness == pytest.approx(1.0241877, abs=5e-8)


def test_foot():
    assert FOOT.curvature_radius(POLE) == pytest.approx(-16.4110535, abs=5e-8)
    alpha = math.radians(29.245368)
    assert FOOT.points(alpha) == pytest.approx([-0.59802273, 36.78229540], abs=1e-7)
    assert FOOT.curvature_radius(alpha) == pytest.approx(-30.2690090, abs=1e-6)
    end = FOOT.angle_at_depth(4.5)
    assert math.degrees(end) == pytest.approx(40.33980978, abs=5e-9)
    assert FOOT.points(end) == pytest.approx([-1.91657181, 34.10961747], abs=5e-9)
    assert FOOT.radius(end) == pytest.approx(34.1634198, abs=5e-8)
    assert FOOT.curvature_radius(end) == pytest.approx(-51.5899326, abs=5e-8)
    assert FOOT.angle_at_radius(float(FOOT.radius(end))) == pytest.approx(end, abs=1e-12)


@pytest.mark.parametrize(
    ("flank", "degrees", "rho"),
    [
        (HEAD, 25, 7.6429448721),
        (HEAD, 30, 10.6043032842),
        (FOOT, 25, -23.5898403512),
        (FOOT, 30, -31.5227129024),
    ],
)
def test_curvature_radius(validated, flank, degrees, rho):
    part = {"head": "addendum", "foot": "dedendum"}[flank.part]
    quantity, found = f"radius of the {part}", flank.curvature_radius(math.radians(degrees))
    source, shown = "independent program", degrees == 25
    quantity = f"{quantity} at {degrees} deg"
    validated(quantity, found, rho, 5e-11, source, "mm", absolute=True, page=shown)


def printed_points(alpha):
    """Eq. (1) as printed: the same sign before the first term of x and y."""
    l, phi = HEAD.path_coordinate(alpha), HEAD.roll_angle(alpha)
    x = -l * np.cos(alpha + phi) + R1 * np.sin(phi)
    return np.array([x, -l * np.sin(alpha + phi) + R1 * np.cos(phi)])


def test_printed_equation_leaves_the_line_of_action():
    """A point keeps its distance from the axis as it turns; the printed sign gives another one."""
    alpha = math.radians(30.0)
    contact = math.hypot(*HEAD.path_points(alpha))
    # The reference prints 40.09943676, which its own point (1.01357754, 40.08662486) is not at.
    assert contact == pytest.approx(40.09943680, abs=5e-9)
    assert contact == pytest.approx(math.hypot(1.01357754, 40.08662486), abs=5e-9)
    assert math.hypot(*HEAD.points(alpha)) == pytest.approx(contact, abs=1e-13)
    assert math.hypot(*printed_points(alpha)) == pytest.approx(36.04273066, abs=5e-9)


@flanks
def test_points_are_as_far_from_the_axis_as_their_contact(flank, end):
    alpha = np.linspace(POLE, end, 31)
    distance = np.hypot(*flank.points(alpha).T)
    assert distance == pytest.approx(np.hypot(*flank.path_points(alpha).T), abs=1e-12)
    assert distance == pytest.approx(flank.radius(alpha), abs=1e-12)


@flanks
def test_roll_angle_is_the_integral_along_the_path(flank, end):
    """Dl = r cos(alpha) dphi: the contact moves along the normal by the roll of the base circle."""

    def rolled(a):
        e = a - flank.pitch_point_angle
        return flank.side * 2.0 * flank.arc_radius * math.cos(e) / math.cos(a) / flank.pitch_radius

    found = quad(rolled, flank.pitch_point_angle, end, epsabs=1e-14, epsrel=1e-13)[0]
    assert flank.roll_angle(end) == pytest.approx(found, abs=1e-12)


def chebyshev(points, start, end):
    """Polynomials for x and y over alpha, from values of the function only."""
    nodes = np.polynomial.chebyshev.chebpts1(40)
    alpha = start + 0.5 * (end - start) * (nodes + 1.0)
    values = points(alpha)
    return [
        np.polynomial.Chebyshev(np.polynomial.chebyshev.chebfit(nodes, values[:, i], 30), (start, end))
        for i in (0, 1)
    ]


@flanks
def test_curvature_by_differentiation(flank, end):
    x, y = chebyshev(flank.points, flank.pitch_point_angle, end)
    alpha = np.linspace(flank.pitch_point_angle, end, 21)[1:-1]
    speed = np.hypot(x.deriv()(alpha), y.deriv()(alpha))
    cross = x.deriv()(alpha) * y.deriv(2)(alpha) - y.deriv()(alpha) * x.deriv(2)(alpha)
    # Alpha runs from root to tip on the head, with the tooth on its right, else the other way.
    expected = -flank.side * cross / speed**3
    assert flank.curvature(alpha) == pytest.approx(expected, rel=1e-9)
    tangent = np.stack([x.deriv()(alpha), y.deriv()(alpha)], axis=-1) / speed[:, np.newaxis]
    across = np.einsum("ij,ij->i", tangent, flank.normals(alpha))
    assert across == pytest.approx(0.0, abs=1e-9)


@flanks
def test_rack_radius_by_differentiation(flank, end):
    x, y = chebyshev(flank.rack_points, flank.pitch_point_angle, end)
    alpha = np.linspace(flank.pitch_point_angle, end, 21)[1:-1]
    speed = np.hypot(x.deriv()(alpha), y.deriv()(alpha))
    cross = x.deriv()(alpha) * y.deriv(2)(alpha) - y.deriv()(alpha) * x.deriv(2)(alpha)
    assert flank.rack_radius(alpha) == pytest.approx(speed**3 / np.abs(cross), rel=1e-9)


def test_rack_does_not_depend_on_the_teeth():
    alpha = np.linspace(POLE, math.radians(40.0), 11)
    for part in ("head", "foot"):
        small, large = (ConvexConcaveFlank(r, 10.0, POLE, part) for r in (20.0, 2e6))
        assert small.rack_points(alpha) == pytest.approx(large.rack_points(alpha), abs=0)
        # A wheel of many teeth has the rack's curvature.
        assert abs(large.curvature_radius(alpha)) == pytest.approx(small.rack_radius(alpha), rel=1e-4)


@pytest.mark.parametrize(("mate", "rho"), [(17, 6.5411352411), (34, 8.7215136548), (51, 9.8117028617)])
def test_reduced_radius_in_the_pitch_point_is_the_same_on_both_sides(validated, mate, rho):
    pair = ConvexConcave(4.5, 17, mate, POLE, 10.0, 10.0, 4.5)
    # For 51 teeth the reference prints 9.8117026617: the closed form below has another digit.
    found = [float(zone.reduced_radius(POLE)) for zone in pair.zones]
    quantity, source = f"reduced radius at the pitch point, 17 and {mate} teeth", "independent program"
    validated(quantity, found, rho, 5e-11, source, "mm", absolute=True, page=mate == 34)
    r2 = 2.25 * mate
    assert rho == pytest.approx(math.sin(POLE) / (1.0 / R1 + 1.0 / r2), abs=5e-11)


def test_reduced_radius_at_30_degrees():
    a, b = (float(zone.reduced_radius(math.radians(30.0))) for zone in PAIR.zones)
    assert (a, b) == pytest.approx((23.0281132806, 20.0056919886), abs=5e-11)


def test_contact_ratio(validated):
    source, how = "independent program", {"absolute": True}
    quantity, found = "contact ratio, 17 and 34 teeth", PAIR.contact_ratio
    validated(quantity, found, 1.0987962846, 5e-11, source, **how)
    assert PAIR.recess_ratio == pytest.approx(0.5423309831, abs=5e-11)
    assert PAIR.approach_ratio == pytest.approx(0.5564653014, abs=5e-11)
    assert math.degrees(PAIR.wheel.tip_angle) == pytest.approx(39.78722157, abs=5e-9)
    involute = InvolutePair((17, 34), 4.5, POLE, (0.0, 0.0), (42.75, 81.0))
    quantity, found = "contact ratio of the involute pair", involute.contact_ratio
    validated(quantity, found, 1.5976848350, 5e-11, source, **how)
    assert involute.reduced_radius(involute.pitch_point) == pytest.approx(8.7215136548, abs=5e-11)


def test_involute_path_ends_at_the_base_circle():
    """Ten teeth of 20 deg are undercut: the path ends where it touches the pinion's base circle."""
    few = InvolutePair((10, 60), 1.0, POLE, (0.0, 0.0), (6.0, 31.0))
    assert few.approach == pytest.approx(5.0 * math.sin(POLE), abs=1e-13)
    assert few.reduced_radius(few.pitch_point - few.approach) == pytest.approx(0.0, abs=1e-13)


def test_arc_for_the_rack_as_in_the_reference(validated):
    """The reference takes 401 points even in alpha, without saying so: the figures are those.

    Its last digit is one off: the least squares have their least at 15.828845391 mm.
    """
    end = FOOT.angle_at_depth(4.5)
    points = HEAD.rack_points(np.linspace(POLE, end, 401))
    found = fit_circle(points)
    quantity, source = "radius of the arc for the rack", "independent program"
    validated(quantity, found.radius, 15.82884540, 2e-8, source, "mm", absolute=True)
    assert found.centre == pytest.approx((14.60119035, -6.07606704), abs=2e-8)
    assert np.abs(found.distances(points)).max() == pytest.approx(0.01436295, abs=5e-9)
    assert found.rms == pytest.approx(0.0056, abs=5e-7)


def test_arc_for_the_rack_over_its_length():
    """Twenty thousand chords of even length, and the foot's arc is the head's turned half round."""
    end = FOOT.angle_at_depth(4.5)
    fine = np.linspace(POLE, end, 200001)
    way = HEAD.rack_points(fine)
    length = np.append(0.0, np.cumsum(np.hypot(*np.diff(way, axis=0).T)))
    middles = (np.arange(20000) + 0.5) / 20000 * length[-1]
    points = HEAD.rack_points(np.interp(middles, length, fine))
    expected, found = fit_circle(points), rack_arc(HEAD, end)
    assert found.radius == pytest.approx(expected.radius, abs=1e-5)
    assert found.centre == pytest.approx(expected.centre, abs=1e-5)
    assert found.rms == pytest.approx(expected.rms, rel=1e-5)
    assert rack_arc(FOOT, end).centre == pytest.approx([-v for v in found.centre], abs=1e-9)


@pytest.mark.parametrize("diameter", ROLLERS)
def test_over_rollers(validated, diameter):
    part, alpha, centre, over = ROLLERS[diameter]
    found = PAIR.pinion.over_rollers(diameter)
    assert found.part == part
    assert math.degrees(found.alpha) == pytest.approx(alpha, abs=5e-9)
    assert found.centre_radius == pytest.approx(centre, abs=5e-9)
    quantity, source = f"dimension over rollers of {diameter} mm", "independent program"
    shown = diameter in (6.5, 8.5)
    validated(quantity, found.over, over, 5e-9, source, "mm", absolute=True, page=shown)


@pytest.mark.parametrize("gear", [PAIR.pinion, PAIR.wheel, OTHER.pinion, OTHER.wheel])
@pytest.mark.parametrize("ratio", [1.5, 1.7, 1.9])
def test_roller_touches_both_flanks(gear, ratio):
    """From the middle of the gap the nearest point of the flank is half a diameter away."""
    diameter = ratio * gear.module
    found = gear.over_rollers(diameter)
    theta = 0.5 * math.pi / gear.teeth
    centre = found.centre_radius * np.array([-math.sin(theta), math.cos(theta)])

    def away(flank, a):
        return math.hypot(*(flank.points(a) - centre))

    flank = getattr(gear, found.part)
    rest = flank.points(found.alpha) + 0.5 * diameter * flank.normals(found.alpha)
    assert rest == pytest.approx(centre, abs=1e-10)
    nearest = [
        minimize_scalar(
            lambda a, f=f: away(f, a),
            bounds=(f.pitch_point_angle, end),
            method="bounded",
            options={"xatol": 1e-9},
        ).fun
        for f, end in gear.flanks()
    ]
    assert min(*nearest, away(flank, found.alpha)) == pytest.approx(0.5 * diameter, abs=1e-8)
    across = 2.0 * found.centre_radius * (math.cos(theta) if gear.teeth % 2 else 1.0)
    assert found.over == pytest.approx(across + diameter, abs=1e-12)


@pytest.mark.parametrize(("diameter", "over"), [(7.776, 86.8737256), (8.0, 87.6143981)])
def test_involute_over_the_same_rollers(diameter, over):
    assert involute_over_pins(4.5, 17, POLE, diameter) == pytest.approx(over, abs=5e-8)


def test_involute_that_no_roller_touches():
    assert math.isnan(involute_over_pins(4.5, 17, POLE, 3.0))


def test_involute_over_rollers_with_thinner_teeth():
    """A thinning of j turns each flank by j / (2 r): the roller of the thick gear sinks in."""
    thick = involute_over_pins(4.5, 34, POLE, 8.0)
    thin = involute_over_pins(4.5, 34, POLE, 8.0, 1e-5)
    inv = (math.pi / 2 * 4.5 - 1e-5) / 153.0 + math.tan(POLE) - POLE
    at = brentq(lambda a: math.tan(a) - a - 8 / 153 / math.cos(POLE) + math.pi / 34 - inv, 0.1, 1.0)
    assert thin == pytest.approx(153.0 * math.cos(POLE) / math.cos(at) + 8.0, abs=1e-9)
    assert thin < thick


def test_sign_conditions():
    assert [one.holds for one in PAIR.sign_conditions] == [True] * 4
    for one in PAIR.sign_conditions:
        alpha = np.linspace(POLE, one.end, 401)
        sign = 1.0 if one.radius.endswith("> 0") else -1.0
        assert (sign * one.flank.curvature_radius(alpha) > 0.0).all()


@pytest.mark.parametrize(("number", "teeth", "arc"), [(2, 17, "foot_arc"), (4, 34, "head_arc")])
def test_foot_is_hollow_in_the_pitch_point_below_half_the_base_radius(number, teeth, arc):
    """Below r cos(alpha_C) / 2: the reference says r / 2, but between the two the foot is convex."""
    r = 2.25 * teeth
    limit = 0.5 * r * math.cos(POLE)

    def condition(radius):
        kept = {"head_arc": 10.0, "foot_arc": 10.0, arc: radius}
        pair = ConvexConcave(4.5, 17, 34, POLE, **kept, addendum=0.1)
        return next(one for one in pair.sign_conditions if one.number == number)

    inside, beyond = condition(0.98 * limit), condition(1.001 * limit)
    assert (inside.holds, beyond.holds) == (True, False)
    assert inside.arc_limit == pytest.approx(limit, abs=1e-12)
    assert inside.flank.curvature_radius(POLE) < 0.0
    between = 0.5 * (limit + 0.5 * r)
    assert between < 0.5 * r
    assert condition(between).flank.curvature_radius(POLE) > 0.0


def test_straight_angle_is_where_the_curvature_changes_sign():
    flank = ConvexConcaveFlank(R1, 17.0, POLE, "foot")
    at = flank.straight_angle
    assert at > POLE
    assert flank.curvature(at) == pytest.approx(0.0, abs=1e-14)
    assert flank.curvature(at - 1e-6) < 0.0 < flank.curvature(at + 1e-6)
    assert math.isnan(HEAD.straight_angle)


def test_undercut_is_where_the_foot_turns_back():
    """Dr/dalpha = 0, by the distance itself; beyond it the sense of the flank is the other one."""
    flank = ConvexConcaveFlank(12.0, 60.0, POLE, "foot")
    found = minimize_scalar(
        lambda a: float(flank.radius(a)), bounds=(POLE, 1.2), method="bounded", options={"xatol": 1e-10}
    )
    assert flank.last_angle == pytest.approx(found.x, abs=1e-6)
    near = flank.last_angle + np.array([-1e-3, 0.0, 1e-3])
    steps = np.diff(flank.points(near), axis=0)
    assert steps[0] @ steps[1] < 0.0
    assert FOOT.last_angle == HEAD.last_angle == 0.5 * math.pi


def turn(points, angle):
    cos, sin = np.cos(angle), np.sin(angle)
    x, y = points
    return np.array([cos * x - sin * y, sin * x + cos * y])


@pytest.mark.parametrize("pair", [PAIR, OTHER])
@pytest.mark.parametrize("which", [0, 1])
def test_wheel_is_the_envelope_of_the_pinion(validated, pair, which):
    """The pinion's flank rolls in the wheel's frame; where it stands still across, it envelops.

    Only values of the pinion's flank go in: tangents by a polynomial, motion by differences of
    rotations, the contact by the vanishing determinant of both.
    """
    zone = pair.zones[which]
    x, y = chebyshev(zone.pinion.points, zone.pinion.pitch_point_angle, zone.end)
    r1, r2 = 0.5 * pair.module * pair.pinion_teeth, 0.5 * pair.module * pair.wheel_teeth

    def on_wheel(a, phi):
        # Pinion turned by phi, seen from the wheel's axis half round, turned back by the wheel.
        px, py = turn((x(a), y(a)), phi)
        return turn((-px, r1 + r2 - py), phi * r1 / r2)

    def determinant(a, phi):
        tangent = turn((x.deriv()(a), y.deriv()(a)), phi)
        along = turn(-tangent, phi * r1 / r2)
        step = 1e-3
        near = [on_wheel(a, phi + n * step) for n in (-2, -1, 1, 2)]
        moved = (near[0] - 8.0 * near[1] + 8.0 * near[2] - near[3]) / (12.0 * step)
        return along[0] * moved[1] - along[1] * moved[0]

    points = []
    for alpha in np.linspace(zone.pinion.pitch_point_angle, zone.end, 12)[1:-1]:
        guess = float(zone.pinion.roll_angle(alpha))
        phi = brentq(lambda p, a=alpha: determinant(a, p), guess - 0.02, guess + 0.02, xtol=1e-14)
        touching = on_wheel(alpha, phi)
        away = minimize_scalar(
            lambda a, at=touching: math.hypot(*(zone.wheel.points(a) - at)) ** 2,
            bounds=(alpha - 1e-3, alpha + 1e-3),
            method="bounded",
            options={"xatol": 1e-12},
        )
        assert math.sqrt(away.fun) < 1e-8
        points.append((touching, zone.wheel.points(alpha)))
    quantity, (envelope, found) = "points of the wheel", np.swapaxes(points, 0, 1)
    shown, how = pair is PAIR and which == 0, "envelope of the pinion"
    validated(quantity, found, envelope, 1e-8, how, "mm", absolute=True, page=shown)


def test_backlash_turns_the_flank():
    """Turned by b/r a point moves b cos(alpha) along its normal at contact; shifted it does not.

    Both gears lose the same normal distance at a contact only if both are turned: the shift of
    the source's listing takes 18 % less at the pinion's tip.
    """
    shift = 1e-6
    alpha = HEAD.angle_at_radius(42.75)
    normal, point = HEAD.normals(alpha), HEAD.points(alpha)
    moved = turn(point, -shift / R1) - point
    assert moved @ normal == pytest.approx(-shift * math.cos(alpha), rel=1e-6)
    listed = np.array([shift, 0.0]) @ normal
    assert listed / (moved @ normal) == pytest.approx(0.8169, abs=5e-5)
    thin = ConvexConcave(4.5, 17, 34, POLE, 10.0, 10.0, 4.5, backlash=0.2)
    for gear in (thin.pinion, thin.wheel):
        assert 2.0 * gear.half_tooth * gear.pitch_radius == pytest.approx(0.5 * math.pi * 4.5 - 0.1)
        assert gear.half_tooth + gear.half_gap == pytest.approx(math.pi / gear.teeth, abs=1e-15)


@pytest.mark.parametrize("diameter", [7.0, 8.0])
def test_thinner_teeth_let_the_roller_in(diameter):
    """DM/dj by the work of the roller's radial motion against both flanks."""
    step = 1e-5
    gears = [ConvexConcaveGear(34, 4.5, POLE, 10.0, 10.0, 4.5, thinning) for thinning in (0.0, step)]
    thick, thin = (gear.over_rollers(diameter) for gear in gears)
    flank = getattr(gears[0], thick.part)
    # A flank that recedes by b cos(alpha) along its normal, which leans by beta against the gap.
    beta = thick.alpha + float(flank.roll_angle(thick.alpha)) + 0.5 * math.pi / 34
    expected = -2.0 * 0.5 * math.cos(thick.alpha) / math.sin(beta)
    assert (thin.over - thick.over) / step == pytest.approx(expected, rel=1e-4)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: HEAD.angle_at_radius(60.0), "lower module_mm or addendum_ratio"),
        (lambda: HEAD.angle_at_radius(38.0), "head of the tooth: its distance from the pitch"),
        (lambda: FOOT.angle_at_radius(38.5), "foot of the tooth: its distance from the pitch"),
        (lambda: FOOT.angle_at_depth(19.0), "below 18.7939 mm with an arc of 10 mm"),
        (
            lambda: ConvexConcaveGear(8, 4.5, POLE, 10.0, 10.0, 5.6),
            "tooth: its thickness at the tip must be above 0 mm, is -",
        ),
        (
            lambda: ConvexConcaveGear(400, 4.5, math.radians(30.0), 10.0, 10.0, 5.5),
            "must be above 0 mm, is -",
        ),
        (
            lambda: ConvexConcaveGear(5, 4.5, POLE, 30.0, 300.0, 3.0),
            "z = 5 is undercut, its foot turns back at",
        ),
        (lambda: PAIR.pinion.over_rollers(2.5), "must be from 2.9711 to"),
        (lambda: PAIR.pinion.over_rollers(40.0), "take a diameter between"),
        (
            lambda: ConvexConcaveGear(17, 4.5, POLE, 12.0, 2.0, 1.0).over_rollers(8.0),
            "8 mm is larger than the hollow of the feet of z = 17",
        ),
    ],
)
def test_what_cannot_be(make, message):
    with pytest.raises(GeometryError, match=message):
        make()
