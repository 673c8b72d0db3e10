"""Plane gearing and synthesis for a contact stress (source 000, first fragment).

The source prints no number. Those here come from an independent program on the reference pair
(the pair of the source's second fragment), from closed forms, and from rebuilding one profile
as the envelope of the other.
"""

import math

import numpy as np
import pytest
from numpy.polynomial import Chebyshev
from scipy.integrate import quad, solve_ivp
from scipy.optimize import newton

from wearsim.contact.hertz import contact_modulus, peak_pressure
from wearsim.contact.prescribed_stress import LineLoad
from wearsim.errors import GeometryError
from wearsim.geometry.gear.path_of_contact import involute
from wearsim.geometry.gear.path_synthesis import PathSynthesis
from wearsim.geometry.gear.plane_gearing import Contacts, PitchCircles
from wearsim.handbook.synthesise.keys import SynthesisTables
from wearsim.handbook.synthesise.model import direction_fields, stress_fields
from wearsim.input.document import load_calculation

CIRCLES = PitchCircles(135.0, 1.5)
STEEL = {"youngs_modulus_MPa": 2.1e5, "poissons_ratio": 0.3}
TORQUE = {"pinion_torque_N_m": 240, "face_width_mm": 76, "pinion_speed_rpm": 1000}
POLE = {"first_pitch_point_distance_mm": -10, "last_pitch_point_distance_mm": 10, "nodes": 41}
SIGMA = 454.1608627029
W1 = 1000 * math.pi / 30
START = math.hypot(10, 3), math.atan2(3, 10)


def tables(stress=SIGMA, phase=(POLE,), load=TORQUE, **more):
    if not isinstance(stress, dict):
        stress = {"contact_stress_MPa": stress}
    document = {
        "format_version": 1,
        "gears": {"centre_distance_mm": 135, "gear_ratio": 1.5},
        "material": {"pinion": STEEL, "wheel": STEEL},
        "load": load,
        "stress": stress,
        "phase": list(phase),
        **more,
    }
    return load_calculation(document, SynthesisTables)


def pair(stress=SIGMA, load=TORQUE):
    return tables(stress, load=load).pair()


def touching(x, y, stress, family):
    """Contacts in one point of the plane with one stress."""
    l, angle = np.copysign(math.hypot(x, y), x), math.atan(y / x)
    radius = pair(stress).reduced_radius(l, angle)
    return Contacts.of_radius(CIRCLES, l, angle, radius, family)


def segment(family, last, stress=SIGMA, nodes=5, at=None):
    synthesis = PathSynthesis(CIRCLES, pair(stress).radius_rule, family)
    return synthesis.from_point(START, np.linspace(START[0], last, nodes) if at is None else at)


def through_pitch_point(at, stress=SIGMA, load=TORQUE):
    loaded = pair(stress, load)
    return PathSynthesis(CIRCLES, loaded.radius_rule, 1).through_pitch_point(
        loaded.pitch_point_crossing(), at
    )


def exactly(printed):
    """As printed: a number within half a unit of its last digit."""
    return pytest.approx(float(printed), abs=half_unit(printed))


def half_unit(printed):
    """Half a unit of the last digit, or 2e-14 of the number where that is more."""
    return max(0.5000001 * 10.0 ** -len(printed.partition(".")[2]), 2e-14 * abs(float(printed)))


def test_constants():
    assert exactly("0.0308641975308642") == CIRCLES.curvature_sum
    assert exactly("-0.00308641975308642") == CIRCLES.curvature_bias
    assert (CIRCLES.pinion_radius, CIRCLES.wheel_radius) == (54.0, 81.0)
    assert float(CIRCLES.pitch_point_radius(math.radians(20))) == exactly("11.08145264")


def test_form_of_the_gear_standards():
    """Z_E^2 = E/(2 pi (1 - nu^2)) is E*/pi: no second definition of the contact modulus."""
    factor = math.sqrt(2.1e5 / (2 * math.pi * (1 - 0.3**2)))
    assert factor == exactly("191.6456725064184")
    modulus = contact_modulus((2.1e5, 2.1e5), (0.3, 0.3))
    assert pair().modulus == modulus
    assert float(peak_pressure(7.0, 1 / 3.0, modulus)) == pytest.approx(
        factor * math.sqrt(7.0 / 3.0), rel=1e-14
    )


@pytest.mark.parametrize(
    ("stress", "angle"), [(500, "16.0139062546"), (400, "27.9797436171"), (454.1608627, "20.000000")]
)
def test_pitch_point_angle(validated, stress, angle):
    found = math.degrees(pair(stress).pitch_point_crossing().pressure_angle)
    quantity, source = f"pressure angle at the pitch point at {stress:g} MPa", "independent program"
    how = {"absolute": True, "page": stress != 400}
    validated(quantity, found, float(angle), half_unit(angle), source, "deg", **how)


def test_least_stress_in_the_pitch_point(validated):
    found, source = pair().least_pitch_point_stress, "independent program"
    validated("minimum stress at the pitch point", found, 364.1190949303, 5e-11, source, "MPa", absolute=True)
    assert pair(364.1191).pitch_point_crossing().pressure_angle == pytest.approx(math.pi / 4, abs=1e-3)
    with pytest.raises(GeometryError, match=r"above 364\.119 at the pitch point.*45 deg.*but is 364"):
        tables(364).phases(pair(364))
    steepest = np.radians(np.linspace(1, 89, 881))
    curvature = 1 / CIRCLES.pitch_point_radius(steepest)
    stresses = peak_pressure(pair().load.at(steepest), curvature, pair().modulus)
    assert stresses.min() == pytest.approx(pair().least_pitch_point_stress, rel=1e-12)


def test_least_stress_under_a_constant_normal_load():
    """Z_E sqrt(A q), at a pressure angle of 90 deg."""
    loaded = pair(300, {"load_per_width_N_per_mm": 60, "pinion_speed_rpm": 1000})
    least = 191.6456725064184 * math.sqrt(CIRCLES.curvature_sum * 60)
    assert loaded.least_pitch_point_stress == pytest.approx(least, rel=1e-12)
    angle = loaded.pitch_point_crossing().pressure_angle
    assert math.sin(angle) == pytest.approx((least / 300) ** 2, rel=1e-12)
    with pytest.raises(GeometryError, match="90 deg"):
        pair(250, {"load_per_width_N_per_mm": 60, "pinion_speed_rpm": 9}).pitch_point_crossing()


@pytest.mark.parametrize(
    ("l", "rho", "sigma", "theta1", "theta2"),
    [
        (-8, "8.09535278", "531.36159758", "-1.27359075", "0.56016711"),
        (8, "11.29535278", "449.84008635", "0.50373226", "-1.01504131"),
    ],
)
def test_involute(validated, l, rho, sigma, theta1, theta2):
    contacts = involute(CIRCLES, math.radians(20), [l]).contacts
    assert 1 / contacts.relative_curvature[0] == exactly(rho)
    found, within = pair().contact_stress(contacts)[0], half_unit(sigma)
    quantity, source = f"stress of an involute, l = {l} mm", "independent program"
    shown = l > 0
    validated(quantity, found, float(sigma), within, source, "MPa", absolute=True, page=shown)
    assert contacts.pinion_specific_sliding[0] == exactly(theta1)
    assert contacts.wheel_specific_sliding[0] == exactly(theta2)
    assert W1 * contacts.sliding[0] / 1e3 == exactly("1.3962634" if l > 0 else "-1.3962634")


@pytest.mark.parametrize("l", [-18.0, -8.0, 3.0, 8.0, 25.0])
def test_involute_is_a_fixed_solution(l):
    """Its own reduced radius brings the straight line back."""
    contacts = involute(CIRCLES, math.radians(20), [l]).contacts
    radius = 1 / contacts.relative_curvature[0]
    assert abs(CIRCLES.turn(l, math.radians(20), radius, 1)) < 1e-13
    law = PathSynthesis(CIRCLES, lambda l, angle: _involute_radius(l), 1)
    line = law.from_point((l, math.radians(20)), np.linspace(l, 1.2 * l, 5))
    assert line.contacts.pressure_angle == pytest.approx(math.radians(20), abs=1e-12)


def _involute_radius(l):
    """(l + r1 sin(alpha)) (r2 sin(alpha) - l)/((r1 + r2) sin(alpha)) at 20 deg."""
    sine = math.sin(math.radians(20))
    return (l + 54 * sine) * (81 * sine - l) / (135 * sine)


DUALITY = [
    # x, y, stress, family: what, printed
    (
        10,
        3,
        SIGMA,
        1,
        {
            "slope": "0.003025241",
            "mu": "1.8090539",
            "p": "13.417331",
            "q": "30.413544",
            "rho1": "23.857637",
            "rho2": "19.973238",
            "sum": "3.9564102",
            "theta1": "0.63066529",
            "theta2": "-1.7075711",
        },
    ),
    (
        10,
        3,
        SIGMA,
        -1,
        {
            "slope": "-0.066939452",
            "mu": "-34.948483",
            "p": "-6.3017861",
            "q": "3.758046",
            "rho1": "4.1385204",
            "rho2": "-6.6822605",
            "sum": "-3.9564102",
            "theta1": "-1.7075711",
            "theta2": "0.63066529",
        },
    ),
    (10, 3, 600, 1, {"rho1": "29.3407964234202", "rho2": "7.90768464212457", "slope": "-0.003461297"}),
    (10, 3, 600, -1, {"rho1": "3.14441159656206", "rho2": "-6.34989095709919", "slope": "-0.060452914"}),
    (5, 2, 600, 1, {"rho1": "-444.11888", "rho2": "6.3341708"}),
    (5, 2, 600, -1, {"rho1": "1.8894143", "rho2": "-2.6763563"}),
    (-8, -3, 400, 1, {"rho1": "36.008071", "rho2": "23.821529"}),
    (-8, -3, 400, -1, {"rho1": "-5.2055283", "rho2": "3.8189242"}),
]


def measures(contacts):
    rho1, rho2 = 1 / contacts.pinion_curvature, 1 / contacts.wheel_curvature
    return {
        "rho1": rho1,
        "rho2": rho2,
        "p": rho1 - contacts.pitch_point_distance,
        "q": rho2 + contacts.pitch_point_distance,
        "slope": contacts.slope,
        "mu": np.degrees(contacts.direction),
        "sum": W1 * (contacts.pinion_rolling + contacts.wheel_rolling) / 1e3,
        "theta1": contacts.pinion_specific_sliding,
        "theta2": contacts.wheel_specific_sliding,
    }


@pytest.mark.parametrize(("x", "y", "stress", "family", "printed"), DUALITY)
def test_duality(validated, x, y, stress, family, printed):
    found = measures(touching(x, y, stress, family))
    where, source = f"at ({x}, {y}), {stress:.6g} MPa, family {family:+d}", "independent program"
    for name, text in printed.items():
        shown = name == "rho1" and (x, stress) == (10, 600)
        how = {"absolute": True, "page": shown}
        quantity, unit = f"{name} {where}", "mm" if name.startswith("rho") else ""
        validated(quantity, float(found[name]), float(text), half_unit(text), source, unit, **how)


def test_root_of_the_duality():
    assert START[0] == exactly("10.44030651") and math.degrees(START[1]) == exactly("16.69924423")
    for stress, rho, root in [(SIGMA, "10.87165746", "22.6685604458"), (600, "6.228918834", "18.46528415")]:
        radius = float(pair(stress).reduced_radius(*START))
        assert radius == exactly(rho)
        twice = 4 * CIRCLES.pitch_point_radius(START[1]) * radius
        assert math.sqrt(START[0] ** 2 + twice) == exactly(root)


def test_straight_profiles():
    """1/p = 0 at rho = s - l, 1/q = 0 at rho = s + l: a centre of curvature at infinity."""
    s = float(CIRCLES.pitch_point_radius(0.35))
    pinion = Contacts.of_radius(CIRCLES, np.array(4.0), np.array(0.35), s - 4.0, 1)
    wheel = Contacts.of_radius(CIRCLES, np.array(4.0), np.array(0.35), s + 4.0, 1)
    assert pinion.pinion_curvature == pytest.approx(0, abs=1e-15)
    assert wheel.wheel_curvature == pytest.approx(0, abs=1e-15)


def test_small_radii_near_the_pitch_point():
    """rho1 -> l r/(1 + r) and rho2 -> -l r/(1 + r), r^2 = rho/s.

    The reference text has l/2 and -l/2, which takes rho = s.
    """
    s = float(CIRCLES.pitch_point_radius(0.35))
    for rho in (s, 9.0, 30.0):
        contacts = Contacts.of_radius(CIRCLES, np.array(1e-5), np.array(0.35), rho, -1)
        part = 1 / (1 + math.sqrt(s / rho))
        assert 1 / contacts.pinion_curvature == pytest.approx(1e-5 * part, rel=1e-5)
        assert 1 / contacts.wheel_curvature == pytest.approx(-1e-5 * part, rel=1e-5)


def random_contacts(count=300):
    rng = np.random.default_rng(5)
    l = rng.uniform(0.3, 40, count) * rng.choice([-1, 1], count)
    return l, rng.uniform(0.05, 1.4, count), np.exp(rng.uniform(-1, 4, count))


def test_closed_form_solves_the_quadratic():
    """[k (s - l) - 1] p^2 + k l (2 s - l) p + k l^2 s = 0 with k = 1/rho and p = rho1 - l."""
    l, angle, rho = random_contacts()
    s, k = np.sin(angle) / CIRCLES.curvature_sum, 1 / rho
    polynomials = np.column_stack([k * (s - l) - 1, k * l * (2 * s - l), k * l**2 * s])
    roots = np.sort([np.roots(row) for row in polynomials], axis=1)
    both = [1 / Contacts.of_radius(CIRCLES, l, angle, rho, family).pinion_curvature - l for family in (1, -1)]
    assert np.sort(np.column_stack(both), axis=1) == pytest.approx(roots, rel=1e-8)


def test_families_swap_the_wheels():
    l, angle, rho = random_contacts()
    great, small = (Contacts.of_radius(CIRCLES, l, angle, rho, family) for family in (1, -1))
    root = np.sqrt(l**2 + 4 * np.sin(angle) / CIRCLES.curvature_sum * rho)
    relative = 1 + 1 / 1.5
    for one, other, sign in ((great, small, 1), (small, great, -1)):
        assert one.pinion_rolling == pytest.approx(relative * (sign * root + l) / 2, rel=1e-9)
        assert one.wheel_rolling == pytest.approx(relative * (sign * root - l) / 2, rel=1e-9)
        assert one.pinion_rolling == pytest.approx(-other.wheel_rolling, rel=1e-9)
        assert one.pinion_specific_sliding == pytest.approx(other.wheel_specific_sliding, rel=1e-9)
        assert 1 / one.relative_curvature == pytest.approx(rho, rel=1e-9)
    product = great.pinion_rolling * great.wheel_rolling
    assert product * CIRCLES.curvature_sum / (np.sin(angle) * relative**2) == pytest.approx(rho)


@pytest.mark.parametrize("angle", [0.2, 0.35, 0.7])
@pytest.mark.parametrize("turn", [-0.4, 0.0, 0.3])
def test_reduced_radius_in_the_pitch_point(angle, turn):
    """Any regular line of action has s there, whatever its direction."""
    contacts = Contacts(CIRCLES, np.array(0.0), np.array(angle), np.array(turn))
    assert 1 / contacts.relative_curvature == pytest.approx(math.sin(angle) * 32.4, rel=1e-13)


FIELD = {"x_from_mm": 0, "x_to_mm": 20, "y_from_mm": 0, "y_to_mm": 6, "field_nodes": 41}
DIRECTIONS = [
    (0, "8.5882725", "510.98091"),
    (15, "34.511129", "254.9048"),
    (-30, "3.2170611", "834.88745"),
    (-45, "43.006164", "228.34538"),
    (30, "82.922977", "164.4448"),
]


def test_field_of_a_direction():
    given = tables(field={**FIELD, "directions_deg": [*(row[0] for row in DIRECTIONS), -15]})
    fields = direction_fields(pair(), given.field.plane)
    for mu, rho, sigma in DIRECTIONS:
        assert 1 / fields[mu].contacts.relative_curvature[20, 20] == exactly(rho)
        assert fields[mu].contact_stress[20, 20] == exactly(sigma)
        assert fields[mu].infeasibility[20, 20] == ""
    assert 1 / fields[-15].contacts.relative_curvature[20, 20] == exactly("-2.48")
    assert fields[-15].infeasibility[20, 20] == "interference"
    assert math.isnan(fields[-15].contact_stress[20, 20])
    assert {*fields[0].infeasibility[1:, 0]} == {"no torque"}


def test_field_of_a_stress():
    given = tables(field={**FIELD, "x_from_mm": -20, "y_from_mm": -6})
    fields = stress_fields(pair(), given.field.plane)
    for family, field in fields.items():
        at = touching(10, 3, SIGMA, family)
        assert (field.x[30, 30], field.y[30, 30]) == (10, 3)
        assert field.contacts.pressure_angle[30, 30] == at.pressure_angle
        assert field.contacts.turn[30, 30] == pytest.approx(at.turn, rel=1e-12)
        assert field.contact_stress[30, 30] == pytest.approx(SIGMA, rel=1e-12)
        x, y = field.x, field.y
        s = 32.4 * np.copysign(1, x) * y / np.hypot(x, y).clip(1e-9)
        radius = pair().reduced_radius(np.hypot(x, y), np.arctan2(np.abs(y), np.abs(x)))
        real = x**2 + y**2 + 4 * s * radius >= 0
        assert ((field.infeasibility == "complex") == (~real & (x != 0))).all()
        assert {*field.infeasibility.ravel()} == {"", "complex", "no torque", "no rolling"}
        assert np.isnan(field.contact_stress[field.infeasibility != ""]).all()


def test_field_where_no_stress_is_given():
    law = {"contact_stress_MPa": [500, 450, 450], "pitch_point_distance_mm": [-10, 0, 10]}
    given = tables(law, field=FIELD)
    field = stress_fields(pair(law), given.field.plane)[1]
    beyond = np.hypot(field.x, field.y) > 10
    assert ((field.infeasibility == "no stress") == (beyond & (field.x > 0))).all()


LINE = [
    # l, alpha, phi1, P1, P2, rho1, rho2, involute
    (
        -10,
        "22.14540543",
        "-0.198294012",
        ("0.8144457", "51.0707510"),
        ("1.9921029", "-85.2508306"),
        "17.3026374",
        "32.0992348",
        "574.898099",
    ),
    (
        -5,
        "20.87139111",
        "-0.098789792",
        ("0.5011486", "52.4248247"),
        ("0.7862444", "-82.9093585"),
        "18.7623804",
        "27.4478014",
        "489.478588",
    ),
    (
        5,
        "19.56266306",
        "0.098376872",
        ("-0.7796230", "55.8677411"),
        ("-0.4975710", "-79.4640420"),
        "23.8184296",
        "20.6165783",
        "445.046111",
    ),
    (
        10,
        "19.54707788",
        "0.196616617",
        ("-1.9605296", "58.0818742"),
        ("-0.8067843", "-78.2197381"),
        "27.5062916",
        "18.4698216",
        "457.596636",
    ),
]


def test_line_through_the_pitch_point(validated):
    line = through_pitch_point([row[0] for row in LINE])
    straight = involute(CIRCLES, math.radians(20), line.contacts.pitch_point_distance).contacts
    for at, (_, angle, roll, first, second, rho1, rho2, compared) in enumerate(LINE):
        found, source = np.degrees(line.contacts.pressure_angle[at]), "independent program"
        quantity = f"angle of the line of constant stress, l = {LINE[at][0]} mm"
        how = {"absolute": True, "page": at in (0, 3)}
        validated(quantity, found, float(angle), half_unit(angle), source, "deg", **how)
        assert line.roll_angle[at] == exactly(roll)
        assert tuple(line.pinion_profile[at]) == tuple(exactly(text) for text in first)
        assert tuple(line.wheel_profile[at]) == tuple(exactly(text) for text in second)
        assert 1 / line.contacts.pinion_curvature[at] == exactly(rho1)
        assert 1 / line.contacts.wheel_curvature[at] == exactly(rho2)
        assert pair().contact_stress(straight)[at] == exactly(compared)


def test_slope_in_the_pitch_point():
    contacts = through_pitch_point([-1e-3, 0.0, 1e-3]).contacts
    assert contacts.slope[1] == exactly("-0.00229082468817")
    cosine = math.cos(math.radians(20))
    closed = 2 * CIRCLES.curvature_bias * cosine / (4 * cosine**2 - 1)
    assert contacts.slope == pytest.approx(closed, rel=1e-3)
    numerical = np.gradient(contacts.pressure_angle, contacts.pitch_point_distance)
    assert numerical[1] == pytest.approx(closed, rel=1e-6)


NORMAL = {"load_per_width_N_per_mm": 240e3 / (76 * 54 * math.cos(math.radians(20))), "pinion_speed_rpm": 1000}


def test_line_under_a_constant_normal_load():
    contacts = through_pitch_point([-10, 0, 10], load=NORMAL).contacts
    first, pitch_point, last = np.degrees(contacts.pressure_angle)
    assert (first, last) == (exactly("22.06360010"), exactly("19.57968422"))
    assert pitch_point == pytest.approx(20, abs=1e-9)
    cosine = math.cos(math.radians(20))
    assert contacts.slope[1] == pytest.approx(2 * CIRCLES.curvature_bias / (3 * cosine))


SEGMENTS = [
    (
        1,
        SIGMA,
        16,
        {
            "angle": "17.6974610",
            "roll": "0.107772616",
            "x": "15.2427993",
            "y": "4.8638535",
            "x1": "8.8227249",
            "y1": "60.1619124",
            "x2": "9.7379171",
            "y2": "-77.0339451",
            "rho1": "30.0047861",
            "rho2": "17.1940707",
        },
    ),
    (
        -1,
        SIGMA,
        7,
        {
            "angle": "40.4234058",
            "roll": "-0.071758498",
            "x": "5.3289144",
            "y": "4.5390166",
            "x1": "9.5122680",
            "y1": "58.0062975",
            "x2": "8.9792396",
            "y2": "-76.1186742",
            "rho1": "2.7763095",
            "rho2": "-3.4833069",
        },
    ),
    (
        1,
        600,
        16,
        {
            "angle": "16.3261368",
            "x1": "9.0000552",
            "y1": "59.8059162",
            "rho1": "30.7568754",
            "rho2": "7.7918835",
        },
    ),
    (-1, 600, 7, {"angle": "36.9155750", "rho1": "2.2217600", "rho2": "-3.1636996"}),
]


@pytest.mark.parametrize(("family", "stress", "last", "printed"), SEGMENTS)
def test_segments_in_one_quarter(family, stress, last, printed):
    line = segment(family, last, stress)
    found = {
        **measures(line.contacts),
        "angle": np.degrees(line.contacts.pressure_angle),
        "roll": line.roll_angle,
        **dict(zip("xy", line.contacts.points.T, strict=True)),
        **dict(zip(("x1", "y1"), line.pinion_profile.T, strict=True)),
        **dict(zip(("x2", "y2"), line.wheel_profile.T, strict=True)),
    }
    assert {name: float(found[name][-1]) for name in printed} == {
        name: exactly(text) for name, text in printed.items()
    }


def nodes(first, last, count=48):
    """Chebyshev points from one end to the other."""
    return first + (last - first) * 0.5 * (1 - np.cos(np.pi * np.linspace(0, 1, count)))


LINES = {
    "pitch point": lambda: through_pitch_point(nodes(-10, 10)),
    "pitch point, normal load": lambda: through_pitch_point(nodes(-10, 10), load=NORMAL),
    **{
        f"{family:+d} at {stress} MPa": lambda family=family, last=last, stress=stress: segment(
            family, last, stress, at=nodes(START[0], last)
        )
        for family, stress, last, _ in SEGMENTS
    },
}


def fitted(l, points):
    """Polynomials through the coordinates, with their first and second derivatives."""
    ends = [min(l), max(l)]
    fits = [Chebyshev.fit(l, column, 36, domain=ends) for column in points.T]
    return [np.array([fit.deriv(order)(l) for fit in fits]).T for order in (0, 1, 2)]


def rotated(points, angle):
    x, y = np.moveaxis(np.asarray(points), -1, 0)
    return np.stack([np.cos(angle) * x - np.sin(angle) * y, np.sin(angle) * x + np.cos(angle) * y], -1)


@pytest.mark.parametrize("name", LINES)
def test_wheel_is_the_envelope_of_the_pinion(name):
    """Where the pinion's profile, as it rolls, moves along itself as seen from the wheel.

    Only the points of the pinion's profile and the rigid motion enter: no pitch point, no normal.
    """
    line = LINES[name]()
    point, tangent, _ = fitted(line.contacts.pitch_point_distance, line.pinion_profile)

    def seen(roll):
        """The pinion's points in the wheel's frame, and their motion there, by the roll angle."""
        fixed = rotated(point, -roll) - [0.0, 135.0]
        moved = rotated(point, -roll) @ [[0.0, -1.0], [1.0, 0.0]]
        spin = fixed @ [[0.0, -1.0], [1.0, 0.0]]
        return rotated(fixed, -roll / 1.5), rotated(moved + spin / 1.5, -roll / 1.5)

    def across(roll):
        along = rotated(rotated(tangent, -roll), -roll / 1.5)
        motion = seen(roll)[1]
        return along[:, 0] * motion[:, 1] - along[:, 1] * motion[:, 0]

    roll = newton(across, line.roll_angle + 3e-4, tol=1e-14)
    assert np.abs(seen(roll)[0] - line.wheel_profile).max() < 1e-8
    assert roll == pytest.approx(line.roll_angle, abs=1e-9)


def normal_curvature(first, second, side):
    """Curvature of a curve towards a side."""
    normal = np.column_stack([first[:, 1], -first[:, 0]])
    normal *= np.sign(np.sum(normal * side, axis=1))[:, None]
    speed = np.hypot(*first.T)
    return np.sum(second * normal, axis=1) / speed**3


@pytest.mark.parametrize("name", LINES)
def test_stress_from_the_points_of_both_profiles(validated, name):
    line = LINES[name]()
    l, angle = line.contacts.pitch_point_distance, line.contacts.pressure_angle
    normal = np.column_stack([np.cos(angle), np.sin(angle)])
    _, *pinion = fitted(l, line.pinion_profile)
    _, *wheel = fitted(l, line.wheel_profile)
    first = normal_curvature(*pinion, -rotated(normal, line.roll_angle))
    second = normal_curvature(*wheel, rotated(normal, -line.roll_angle / 1.5))
    # The ends of the range are left out: derivatives of a polynomial are worst there.
    inner = slice(3, -3)
    assert first[inner] == pytest.approx(line.contacts.pinion_curvature[inner], abs=1e-6)
    assert second[inner] == pytest.approx(line.contacts.wheel_curvature[inner], abs=1e-6)
    load = NORMAL["load_per_width_N_per_mm"] if "normal" in name else 240e3 / 4104 / np.cos(angle)
    stress = 191.6456725064184 * np.sqrt(load * (first + second))
    expected = 600.0 if "600" in name else SIGMA
    quantity, source = f"stress along the line {name!r}", "curvature of the points of both profiles"
    shown = name == "+1 at 600 MPa"
    validated(quantity, expected, stress[inner], 0.01, source, "MPa", absolute=True, page=shown)


@pytest.mark.parametrize("name", LINES)
def test_stress_is_constant(name):
    loaded = pair(600.0 if "600" in name else SIGMA, NORMAL if "normal" in name else TORQUE)
    stress = loaded.contact_stress(LINES[name]().contacts)
    assert stress == pytest.approx(float(loaded.stress.at(0)), rel=1e-9)


def test_line_by_another_equation():
    """dy/dl = B l + eps (A/2) sqrt(l^2 + 4 rho y/(A l)) for y = l sin(alpha), rho = const."""
    line = through_pitch_point(np.linspace(1, 10, 10), load=NORMAL)
    a, b = CIRCLES.curvature_sum, CIRCLES.curvature_bias
    rho = math.sin(math.radians(20)) / a
    l, y = line.contacts.pitch_point_distance, line.contacts.points[:, 1]
    found = solve_ivp(
        lambda l, y: b * l + 0.5 * a * np.sqrt(l**2 + 4 * rho * y / (a * l)),
        (1, 10),
        y[:1],
        "Radau",
        l,
        rtol=1e-10,
        atol=1e-12,
    )
    assert found.y[0] == pytest.approx(y, abs=1e-8)
    advance = quad(lambda at: 1 / (54 * math.sqrt(1 - (np.interp(at, l, y) / at) ** 2)), 1, 10)[0]
    assert line.roll_angle[-1] - line.roll_angle[0] == pytest.approx(advance, abs=1e-4)


def end_by_angle(start, family=-1):
    """l where the pressure angle comes to 90 deg, integrated over the angle instead."""
    a, b, loaded = CIRCLES.curvature_sum, CIRCLES.curvature_bias, pair()

    def rate(angle, l):
        reach = np.sqrt(l**2 + 4 * np.sin(angle) / a * loaded.reduced_radius(l, angle))
        return l * np.cos(angle) / (b * l - np.sin(angle) + family * a * reach / 2)

    last = math.radians(89.9999)
    return solve_ivp(rate, (start[1], last), start[:1], "LSODA", rtol=1e-10, atol=1e-10).y[0, -1]


def test_small_radii_end_before_the_pitch_point(validated):
    end, angle = PathSynthesis(CIRCLES, pair().radius_rule, -1).end(START, 1e-5)
    assert math.degrees(angle) == pytest.approx(90, abs=0.01)
    expected, source = end_by_angle(START), "integration over the angle instead"
    validated("end of a line with small radii", end, expected, 1e-6, source, "mm", absolute=True)
    assert end == pytest.approx(5.585639, abs=1e-6)
    with pytest.raises(GeometryError, match=r"family -1 .* 5\.58564 mm.*90 deg.*reach 5"):
        segment(-1, 5)
    assert segment(-1, 5.587).contacts.pressure_angle[-1] > 1.5
    with pytest.raises(GeometryError, match=r"before l = 5\.5857 mm.* 89\.3 deg"):
        segment(-1, 5.5857)


def test_small_radii_end_before_the_pitch_point_on_its_other_side():
    start = (-math.hypot(8, 3), math.atan2(3, 8))
    end, angle = PathSynthesis(CIRCLES, pair().radius_rule, -1).end(start, -1e-5)
    assert -6 < end < -4 and math.degrees(angle) == pytest.approx(90, abs=0.01)
    assert end == pytest.approx(end_by_angle(start), abs=1e-6)


def test_lines_end_at_a_pressure_angle_of_zero():
    """There the contact stands still on a profile, and would run back on it."""
    for family, last in ((-1, 30), (1, 1e-5)):
        end, angle = PathSynthesis(CIRCLES, pair().radius_rule, family).end(START, last)
        assert angle == pytest.approx(0, abs=1e-12)
        contacts = segment(family, end * (1 + 1e-9 * (START[0] - end))).contacts
        still = contacts.wheel_rolling[-1] if family == 1 else contacts.pinion_rolling[-1]
        assert abs(still) < 1e-6
    with pytest.raises(GeometryError, match=r"19\.1033 mm.* 0 deg.*reach 20"):
        segment(-1, 20)


@pytest.mark.parametrize(
    ("load", "power"), [(NORMAL, 0.5), (TORQUE, 0.5 * (1 - math.tan(math.radians(20)) ** 2))]
)
def test_one_line_goes_through_the_pitch_point_below_45_degrees(load, power):
    """What is added to it near the pitch point fades outward as l^(-power)."""
    synthesis = PathSynthesis(CIRCLES, pair(load=load).radius_rule, 1)
    exact = through_pitch_point([1e-4, 1e-2], load=load).contacts.pressure_angle
    for shift in (1e-6, -1e-6):
        off = synthesis.end((1e-4, exact[0] + shift), 1e-2)[1] - exact[1]
        assert off / shift == pytest.approx(100**-power, rel=1e-3)


@pytest.mark.parametrize("degrees", [60, 65, 75, 80])
def test_many_lines_go_through_the_pitch_point_above_45_degrees(degrees):
    """Under a constant torque 70 deg has the same stress at the pitch point as 20 deg.

    "Only one line of constant stress crosses the pole" (the pitch point) holds for the smaller angle only: at
    the greater one perturbations fade towards the pitch point, and every line nearby ends up in it.
    """
    synthesis = PathSynthesis(CIRCLES, pair().radius_rule, 1)
    for start, last in ((3.0, 1e-5), (-3.0, -1e-5)):
        end, angle = synthesis.end((start, math.radians(degrees)), last)
        assert end == pytest.approx(last)
        assert math.degrees(angle) == pytest.approx(70, abs=1e-4)


TABLE = {"contact_stress_MPa": [560, 470, 440, 520], "pitch_point_distance_mm": [-10, -2, 1, 10]}
CORNER = {"contact_stress_MPa": [560, 454, 520], "pitch_point_distance_mm": [-10, 0, 10]}


@pytest.mark.parametrize(("family", "nearest", "end"), [(1, 5, None), (-1, 5, 5.585639), (-1, 6, None)])
def test_inner_end_is_looked_for_where_a_stress_is_given(family, nearest, end):
    law = {"contact_stress_MPa": [SIGMA, SIGMA], "pitch_point_distance_mm": [nearest, 20]}
    start = {"start_x_mm": 10, "start_y_mm": 3, "last_pitch_point_distance_mm": 10.5, "nodes": 11}
    given = tables(law, [{"family": family, **start}])
    (phase,) = given.phases(given.pair())
    found = phase.inner_end and phase.inner_end[0]
    assert found == (end and pytest.approx(end, abs=1e-6))


@pytest.mark.parametrize("law", [TABLE, CORNER])
def test_stress_between_points(law):
    loaded = pair(law)
    (phase,) = tables(law).phases(loaded)
    l = phase.line.contacts.pitch_point_distance
    expected = np.interp(l, law["pitch_point_distance_mm"], law["contact_stress_MPa"])
    stress = loaded.contact_stress(phase.line.contacts)
    assert stress == pytest.approx(expected, rel=1e-9)
    assert not phase.involute.contacts.turn.any()


def test_slopes_on_both_sides_of_a_corner_in_the_pitch_point():
    loaded = pair(CORNER)
    crossing = loaded.pitch_point_crossing()
    near = np.array([-0.02, -0.01, 0.01, 0.02])
    angle = (
        PathSynthesis(CIRCLES, loaded.radius_rule, 1)
        .through_pitch_point(crossing, near)
        .contacts.pressure_angle
    )
    advance = 54 * math.cos(crossing.pressure_angle)
    slopes = (angle - crossing.pressure_angle) / near
    extrapolated = 2 * slopes[[1, 2]] - slopes[[0, 3]]
    expected = np.array([crossing.turn_before, crossing.turn_after]) / advance
    assert extrapolated == pytest.approx(expected, rel=1e-4)
    assert expected[0] > 0 > expected[1]
    beside = PathSynthesis(CIRCLES, loaded.radius_rule, 1).through_pitch_point(crossing, [-1e-9, 1e-9])
    assert tuple(beside.contacts.turn) == (crossing.turn_before, crossing.turn_after)


def test_load_laws():
    assert LineLoad(60.0, 1).at(np.radians(60)) == pytest.approx(120)
    assert LineLoad(60.0, 0).at(np.radians(60)) == pytest.approx(60)
    step = 1e-6
    for load in (LineLoad(60.0, 1), LineLoad(60.0, 0)):
        rise = (math.log(load.at(0.4 + step)) - math.log(load.at(0.4 - step))) / (2 * step)
        assert load.growth(0.4) == pytest.approx(rise, abs=1e-8)
