"""Standard sprocket teeth against numbers worked out apart from the code.

Printed numbers come from tables calculated with the standards' formulas; a string is one of
them and holds to half a unit of its last digit. Four of that table's numbers were wrong and are
replaced here by a calculation with 40 digits or a closed form: the pointed diameters of 08B
z = 17 (77.382 and 73.590, as off a sampled flank), the tip land 1.290 of GOST 12.7 z = 17
(1.28949) and the pitch diameter 132.748 of 50.8 z = 8, which is 132.747.
"""

import math
from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest

from wearsim.catalogue.catalogues import chains
from wearsim.geometry import worn_tooth
from wearsim.geometry.forms import gost591, iso606
from wearsim.geometry.forms.ansi_b29 import TypeIITooth, ansi_b29_gap
from wearsim.geometry.forms.gost591 import GostTooth, gost591_gap
from wearsim.geometry.forms.iso606 import iso606_gap
from wearsim.geometry.gap import Gap, pitch_diameter
from wearsim.geometry.segments import ArcSegment, LineSegment

INCH = 25.4
FORMS: dict[str, Callable[..., Gap]] = {
    "ISO min": lambda *chain, **how: iso606_gap(*chain, form="min", **how),
    "ISO max": lambda *chain, **how: iso606_gap(*chain, form="max", **how),
    "ANSI": ansi_b29_gap,
    "GOST": gost591_gap,
    "GOST displaced": lambda *chain, **how: gost591_gap(*chain, displaced=True, **how),
}
CONVENTIONS = ("pitch_circle", "root_diameter")
CHAINS = sorted({(chain.pitch, chain.roller_diameter) for chain in chains().values()})


def check(printed: str, value: float) -> None:
    decimals = len(printed.partition(".")[2])
    assert abs(value - float(printed)) <= 0.5000001 * 10.0**-decimals, (printed, value)


def check_all(printed: str, *values: float) -> None:
    for number, value in zip(printed.split(), values, strict=True):
        check(number, value)


def in_degrees(gap: Gap) -> list[float]:
    return [float(np.degrees(gap.pressure_angle(part.end_tangent))) for part in gap.segments[:-1]]


def test_unit_pitch_diameters() -> None:
    teeth = (9, 11, 13, 15, 17, 18, 19, 20, 21, 23, 25, 38, 57)
    check_all(
        "2.9238 3.5495 4.1786 4.8097 5.4422 5.7588 6.0755 6.3925 6.7095 7.3439 7.9787 12.1096 18.1529",
        *(pitch_diameter(1.0, z) for z in teeth),
    )
    assert pitch_diameter(50.8, 8) == pytest.approx(50.8 * math.sqrt(4.0 + math.sqrt(8.0)))
    check("164.392", pitch_diameter(50.8, 10))


@pytest.mark.parametrize(
    ("pitch", "roller", "teeth", "diameters", "radii"),
    [
        (12.7, 8.51, 17, "69.1158 60.6058 76.4808 72.1105", "19.4028 31.9295"),
        (12.7, 8.51, 18, "73.1364 64.6264 80.5014 76.1975", "20.4240 34.3123"),
        (19.05, 12.07, 23, "139.9021 127.8321 151.6446 145.5569", "36.2100 68.4610"),
        (25.4, 15.88, 19, "154.3186 138.4386 170.1886 161.6996", "40.0176 68.7286"),
    ],
)
def test_iso_diameters_and_flank_radii(
    pitch: float, roller: float, teeth: int, diameters: str, radii: str
) -> None:
    """The root 127.8321 of 12B is 139.9021 - 12.07."""
    low, high = iso606.tip_diameter_limits(pitch, roller, teeth)
    root = iso606.root_diameter(pitch, roller, teeth)
    check_all(diameters, pitch_diameter(pitch, teeth), root, high, low)
    check_all(radii, iso606.re_small(roller, teeth), iso606.re_large(roller, teeth))


@pytest.mark.parametrize(
    ("roller", "teeth", "seat_radii", "angles"),
    [
        (8.51, 17, "4.2976 4.4384", "134.7059 114.7059"),
        (8.51, 18, "4.2976 4.4384", "135.0 115.0"),
        (15.88, 19, "8.0194 8.1928", "135.2632 115.2632"),
    ],
)
def test_iso_seats(roller: float, teeth: int, seat_radii: str, angles: str) -> None:
    forms = [iso606.gap_form(name, roller, teeth) for name in ("min", "max")]
    check_all(seat_radii, *(form.seat_radius for form in forms))
    check_all(angles, *(math.degrees(form.seating_angle) for form in forms))


@pytest.mark.parametrize(
    ("form", "seat_end", "theta_end"),
    [("min", "3.9662 32.9031", "67.3529"), ("max", "3.7372 32.1636", "57.3529")],
)
def test_iso_seat_end(form: str, seat_end: str, theta_end: str) -> None:
    seat, flank = iso606_gap(12.7, 8.51, 17, form=form).segments
    check_all(seat_end, *seat.end)
    check_all(seat_end, *flank.start)
    check(theta_end, math.degrees(seat.end_tangent))


def test_iso_half_gap_on_the_pitch_circle() -> None:
    """The radius pairings of the standard, and the two crossed ones."""
    least, greatest = (iso606.gap_form(name, 8.51, 17) for name in ("min", "max"))
    slim = iso606.GapForm(greatest.flank_radius, least.seat_radius, least.seating_angle)
    bold = iso606.GapForm(least.flank_radius, greatest.seat_radius, greatest.seating_angle)
    for printed, form in (("4.750", "min"), ("4.713", slim), ("5.431", "max"), ("5.547", bold)):
        left = iso606_gap(12.7, 8.51, 17, form=form).outline(2001)
        x, y = left.x[1001:], left.y[1001:]
        check(printed, -float(np.interp(0.5 * pitch_diameter(12.7, 17), y, x)))


@pytest.mark.parametrize(
    ("form", "tip", "land"), [("min", 72.1105, "2.526"), ("max", 72.1105, "0.847"), ("min", 76.4808, "0.488")]
)
def test_iso_tip_land(form: str, tip: float, land: str) -> None:
    gap = iso606_gap(12.7, 8.51, 17, form=form, tip_diameter=tip)
    check(land, gap.tip_land)
    assert not gap.truncated
    assert gap.tip_radius == pytest.approx(0.5 * tip, rel=1e-15)
    assert math.hypot(*gap.segments[-1].end) == pytest.approx(0.5 * tip, rel=1e-14)


@pytest.mark.parametrize(
    ("form", "seat_centre", "pointed"),
    [
        ("min", "pitch_circle", 77.35548695064398),
        ("min", "root_diameter", 77.46635276399040),
        ("max", "pitch_circle", 73.55608918340673),
        ("max", "root_diameter", 74.02841082468872),
    ],
)
def test_iso_pointed_diameter(form: str, seat_centre: str, pointed: float) -> None:
    """With C the flank's centre and u, m along and across the tooth: C.u + sqrt(re^2 - (C.m)^2)."""
    gap = iso606_gap(12.7, 8.51, 17, form=form, seat_centre=seat_centre, tip_diameter=80.0)
    assert 2.0 * gap.pointed_radius == pytest.approx(pointed, rel=1e-15, abs=2e-14)
    assert gap.truncated
    assert gap.tip_land == 0.0
    x, y = gap.segments[-1].end
    assert math.atan2(x, y) == pytest.approx(math.pi / 17, rel=1e-14)
    da_max = iso606.tip_diameter_limits(12.7, 8.51, 17)[1]
    assert (2.0 * gap.pointed_radius < da_max) is (form == "max")


def test_iso_default_tip_lies_within_what_the_standard_and_the_flanks_allow() -> None:
    """The middle of 72.1105 and 76.4808 (min), of 72.1105 and 73.5561 (max)."""
    check("37.1478", iso606_gap(12.7, 8.51, 17, form="min").tip_radius)
    check("36.4167", iso606_gap(12.7, 8.51, 17, form="max").tip_radius)
    for form in ("min", "max"):
        for pitch, roller in CHAINS:
            for teeth in (9, 10, 17, 40, 150):
                gap = iso606_gap(pitch, roller, teeth, form=form)
                low, high = iso606.tip_diameter_limits(pitch, roller, teeth)
                assert low < 2.0 * gap.tip_radius < high
                assert gap.tip_land > 0.0


def pointed_height(tooth: TypeIITooth) -> float:
    """From the foot of the head's centre to the pointed tip on the tooth's axis (H) [mm]."""
    return math.sqrt(tooth.head_radius**2 - (1.4 * tooth.roller_diameter - 0.5 * tooth.pitch) ** 2)


def pointed_diameter(tooth: TypeIITooth, shift: float = 0.0) -> float:
    """Diameter at which teeth are pointed, by the handbook, the seats moved out by a shift [mm]."""
    half = math.pi / tooth.teeth
    return tooth.pitch / math.tan(half) + 2.0 * math.cos(half) * shift + 2.0 * pointed_height(tooth)


def test_ansi_40_in_inches() -> None:
    tooth = TypeIITooth(0.5 * INCH, 0.3125 * INCH, 20)
    check("3.19623", tooth.pitch_diameter / INCH)
    check_all("0.317063 0.158531", tooth.seating_diameter / INCH, tooth.seat_radius / INCH)
    check_all(
        "38.0000 15.2000", 90.0 - math.degrees(tooth.seat_half_angle), math.degrees(tooth.working_angle)
    )
    check("0.408531", tooth.working_radius / INCH)
    check_all("-0.197003 0.153915", *(part / INCH for part in tooth.working_centre))
    check_all("0.0388111 0.257594", tooth.straight_length / INCH, tooth.head_radius / INCH)
    check_all("0.432114 -0.0684401", *(part / INCH for part in tooth.head_centre))
    check("0.176631", pointed_height(tooth) / INCH)
    check_all("3.45688 3.51014", tooth.outside_diameter / INCH, pointed_diameter(tooth) / INCH)
    check("2.88373", tooth.root_diameter("root_diameter") / INCH)
    gap = ansi_b29_gap(0.5 * INCH, 0.3125 * INCH, 20)
    centre = (0.0, gap.seat_centre)
    for printed, part in zip(
        ("0.124924 -0.097602", "0.179607 -0.004397", "0.194647 0.031382"), gap.segments[:-1], strict=True
    ):
        check_all(printed, *((a - b) / INCH for a, b in zip(part.end, centre, strict=True)))
    angles = in_degrees(gap)
    check_all("29.0 13.8 21.4", angles[0], angles[1], 0.5 * (angles[0] + angles[1]))


def test_ansi_40_metric() -> None:
    tooth = TypeIITooth(12.7, 7.92, 20)
    check_all("81.1842 4.0179 10.3539", tooth.pitch_diameter, tooth.seat_radius, tooth.working_radius)
    check_all("6.5284 0.98363 4.49123", tooth.head_radius, tooth.straight_length, pointed_height(tooth))
    check_all("87.8046 89.1671", tooth.outside_diameter, pointed_diameter(tooth))


def test_ansi_bottom_by_convention() -> None:
    """PD - Ds or PD - Dr, 3.196227 - 0.3170625 or 3.196227 - 0.3125 in."""
    for seat_centre, printed in zip(CONVENTIONS, ("2.87916", "2.88373"), strict=True):
        gap = ansi_b29_gap(0.5 * INCH, 0.3125 * INCH, 20, seat_centre=seat_centre)
        check(printed, 2.0 * gap.bottom_radius / INCH)
        tooth = TypeIITooth(0.5 * INCH, 0.3125 * INCH, 20)
        check(printed, tooth.root_diameter(seat_centre) / INCH)


@pytest.mark.parametrize(("pitch", "roller"), [(12.7, 7.9375), (6.35, 3.3), (76.2, 47.63)])
def test_ansi_pointed_diameter(pitch: float, roller: float) -> None:
    """Exact for a seat on the pitch circle.

    Shifting a by s outwards also brings the head's centre nearer to the tooth's axis, by
    s sin(180/N). The handbook's formula leaves that out, so that it is too small; exact is
    2 sqrt(F^2 - (1.4 Dr - P/2 - s sin(180/N))^2) in the place of 2 H.
    """
    for teeth in range(9, 151):
        tooth, half = TypeIITooth(pitch, roller, teeth), math.pi / teeth
        gap = ansi_b29_gap(pitch, roller, teeth)
        assert 2.0 * gap.pointed_radius == pytest.approx(pointed_diameter(tooth), rel=1e-14)
        shifted = ansi_b29_gap(pitch, roller, teeth, seat_centre="root_diameter")
        s = 0.0025 * roller + 0.0381
        aside = 1.4 * roller - 0.5 * pitch - s * math.sin(half)
        height = math.sqrt(tooth.head_radius**2 - aside**2)
        exact = pitch / math.tan(half) + 2.0 * math.cos(half) * s + 2.0 * height
        assert 2.0 * shifted.pointed_radius == pytest.approx(exact, rel=1e-14)
        assert pointed_diameter(tooth, s) < exact


def test_ansi_pointed_formula_when_the_root_diameter_is_exact() -> None:
    """3.51014 + cos 9 deg 0.0045625 in by the handbook, 0.019 mm below the geometry."""
    tooth = TypeIITooth(0.5 * INCH, 0.3125 * INCH, 20)
    printed = 3.51014 + 0.0045625 * math.cos(math.radians(9.0))
    by_formula = pointed_diameter(tooth, 0.0025 * tooth.roller_diameter + 0.0381)
    assert by_formula / INCH == pytest.approx(printed, abs=5e-6)
    gap = ansi_b29_gap(0.5 * INCH, 0.3125 * INCH, 20, seat_centre="root_diameter")
    assert 2.0 * gap.pointed_radius - by_formula == pytest.approx(0.0192, abs=5e-5)


@pytest.mark.parametrize("teeth", [5, 9, 17, 20, 57, 150])
def test_ansi_point_identities(teeth: int) -> None:
    """Points x, y and z of the standard from its own letters, mirrored to the right."""
    pitch, roller = 25.4, 15.88
    A, B = math.radians(35.0 + 60.0 / teeth), math.radians(18.0 - 56.0 / teeth)
    R = 0.5025 * roller + 0.0381
    M, T = 0.8 * roller * math.cos(A), 0.8 * roller * math.sin(A)
    E = 1.3025 * roller + 0.0381
    W = 1.4 * roller * math.cos(math.pi / teeth)
    V = 1.4 * roller * math.sin(math.pi / teeth)
    F = (
        roller
        * (
            0.8 * math.cos(math.radians(18.0 - 56.0 / teeth))
            + 1.4 * math.cos(math.radians(17.0 - 64.0 / teeth))
            - 1.3025
        )
        - 0.0381
    )
    a = pitch_diameter(pitch, teeth) / 2.0
    x = (R * math.cos(A), a - R * math.sin(A))
    y = (-M + E * math.cos(A - B), a + T - E * math.sin(A - B))
    z = (W - F * math.cos(A - B), a - V + F * math.sin(A - B))
    gap = ansi_b29_gap(pitch, roller, teeth)
    for expected, part in zip((x, y, z), gap.segments[:-1], strict=True):
        np.testing.assert_allclose(part.end, expected, rtol=0.0, atol=1e-15 * 4.0 * a)
    yz = 1.4 * roller * math.sin(math.radians(17.0 - 64.0 / teeth)) - 0.8 * roller * math.sin(B)
    assert math.dist(y, z) == pytest.approx(yz, abs=1e-15 * 10.0 * a)


def test_gost_25_4_z_25() -> None:
    tooth = GostTooth(25.4, 15.88, 25)
    assert gost591.tooth_height_factor(25.4, 15.88) == 0.532
    check_all("202.6597 214.5745 186.6003", tooth.pitch_diameter, tooth.outside_diameter, tooth.root_diameter)
    check_all("8.0297 20.7337 10.5619", tooth.seat_radius, tooth.working_radius, tooth.head_radius)
    angles = (tooth.seat_half_angle, tooth.working_angle, tooth.half_tooth_angle)
    check_all("52.6000 15.7600 14.4400", *map(math.degrees, angles))
    check_all("1.4598 0.7620", tooth.straight_length, tooth.displacement)
    check_all("-10.0922 7.7161", *tooth.working_centre)
    check_all("19.5359 -2.4680", *tooth.head_centre)
    gap = gost591_gap(25.4, 15.88, 25)
    for printed, part in zip(
        ("6.3789 -4.8770", "9.1801 0.0701", "9.7185 1.4270"), gap.segments[:-1], strict=True
    ):
        check_all(printed, part.end[0], part.end[1] - gap.seat_centre)
    check_all("2.264 214.5745", gap.tip_land, 2.0 * gap.tip_radius)


def test_gost_12_7_z_17() -> None:
    tooth = GostTooth(12.7, 8.51, 17)
    assert gost591.tooth_height_factor(12.7, 8.51) == 0.480
    check_all("74.0350 60.4633", tooth.outside_diameter, tooth.root_diameter)
    check_all("4.3263 11.1343 5.7228", tooth.seat_radius, tooth.working_radius, tooth.head_radius)
    check_all("0.6877 0.381", tooth.straight_length, tooth.displacement)
    assert gost591_gap(12.7, 8.51, 17).tip_land == pytest.approx(1.289489033055680, rel=1e-13)


def test_gost_19_05_z_20_and_15_875_z_21() -> None:
    tooth = GostTooth(19.05, 11.91, 20)
    assert gost591.tooth_height_factor(19.05, 11.91) == 0.532
    check_all("121.7762 130.4116 109.7067", tooth.pitch_diameter, tooth.outside_diameter, tooth.root_diameter)
    check_all(
        "6.0348 15.5628 7.9740 1.0246",
        tooth.seat_radius,
        tooth.working_radius,
        tooth.head_radius,
        tooth.straight_length,
    )
    tooth = GostTooth(15.875, 10.16, 21)
    check_all("106.5134 113.7692 96.2026", tooth.pitch_diameter, tooth.outside_diameter, tooth.root_diameter)
    check_all("6.7820 0.8883", tooth.head_radius, tooth.straight_length)


def test_gost_displaced_halves_are_the_plain_ones_moved_apart() -> None:
    plain, displaced = (gost591_gap(25.4, 15.88, 25, displaced=moved) for moved in (False, True))
    flat, *rest = displaced.segments
    assert isinstance(flat, LineSegment)
    assert (flat.length, flat.start[0]) == (pytest.approx(0.381), 0.0)
    assert displaced.bottom_radius == plain.bottom_radius
    for moved, part in zip(rest[:-1], plain.segments[:-1], strict=True):
        np.testing.assert_allclose(np.subtract(moved.end, part.end), [0.381, 0.0], atol=1e-13)
    assert displaced.tip_radius == plain.tip_radius
    x, y = 19.5359 + 0.381, 101.32987 - 2.4680
    far, tip = math.hypot(x, y), 214.5745 / 2.0
    angle = math.atan2(x, y) - math.acos((tip**2 + far**2 - 10.5619**2) / (2.0 * tip * far))
    assert displaced.tip_land == pytest.approx(2.0 * tip * (math.pi / 25 - angle), abs=5e-4)


def test_measuring() -> None:
    over = worn_tooth.measurement_over_pins
    for pitch, roller, teeth, printed in (
        (12.7, 8.51, 17, "77.3310"),
        (12.7, 8.51, 18, "81.6464"),
        (19.05, 12.07, 23, "151.6460"),
        (25.4, 15.88, 19, "169.6715"),
    ):
        gap = iso606_gap(pitch, roller, teeth, seat_centre="root_diameter")
        check(printed, over(gap.bottom_radius + 0.5 * roller, roller, teeth))
    check("3.50873", over(0.5 * pitch_diameter(0.5, 20), 0.3125, 20))
    check("3.02199", over(0.5 * pitch_diameter(0.5, 17), 0.3125, 17))
    check("2.72110", pitch_diameter(0.5, 17))


def test_measurement_over_pins_of_a_worn_seat_drops_by_both_seats() -> None:
    """Both seats 0.1 mm deeper: 0.2 mm less for even z, 0.2 cos(90/z) for odd z."""
    for teeth, less in ((18, 0.2), (17, 0.2 * math.cos(math.pi / 34))):
        new, worn = (worn_tooth.measurement_over_pins(rc, 8.51, teeth) for rc in (36.0, 35.9))
        assert new - worn == pytest.approx(less, abs=1e-13)


def tangency_error(gap: Gap) -> float:
    """Largest step between two segments: as a part of the pitch radius, or in rad."""
    return max(
        max(
            math.dist(before.end, after.start) / gap.pitch_radius,
            abs(before.end_tangent - after.start_tangent),
        )
        for before, after in pairwise(gap.segments)
    )


@pytest.mark.parametrize("seat_centre", CONVENTIONS)
@pytest.mark.parametrize("form", FORMS)
def test_tangency(form: str, seat_centre: str) -> None:
    """Every arc is placed by its standard's own coordinates, so this tests the standard."""
    worst = max(
        tangency_error(FORMS[form](pitch, roller, teeth, seat_centre=seat_centre))
        for pitch, roller in ((6.35, 3.3), (12.7, 8.51), (114.3, 72.39))
        for teeth in range(9, 151)
    )
    assert worst < 1e-12


@pytest.mark.parametrize("seat_centre", CONVENTIONS)
@pytest.mark.parametrize("form", FORMS)
def test_pressure_angles(form: str, seat_centre: str) -> None:
    """At the seat's end and at the straight part, from each standard's own formula."""
    for teeth in range(9, 151):
        angles = in_degrees(FORMS[form](12.7, 8.51, teeth, seat_centre=seat_centre))
        expected = {"ISO min": [20.0 - 135.0 / teeth], "ISO max": [30.0 - 135.0 / teeth]}.get(
            form, [35.0 - 120.0 / teeth, 17.0 - 64.0 / teeth, 17.0 - 64.0 / teeth]
        )
        np.testing.assert_allclose(angles[-len(expected) :], expected, rtol=0.0, atol=1e-12)


@pytest.mark.parametrize("seat_centre", CONVENTIONS)
@pytest.mark.parametrize("form", FORMS)
def test_outline_is_simple_and_stays_in_its_sector(form: str, seat_centre: str) -> None:
    some = [(pitch, roller, teeth) for pitch, roller in CHAINS for teeth in (9, 11, 23, 150)]
    for pitch, roller, teeth in [*some, *((12.7, 8.51, teeth) for teeth in range(9, 151))]:
        gap = FORMS[form](pitch, roller, teeth, seat_centre=seat_centre)
        outline = gap.outline(61)
        assert outline.is_simple
        radius = np.hypot(outline.x, outline.y)
        assert np.abs(np.arctan2(outline.x, outline.y)).max() <= math.pi / teeth * (1.0 + 1e-14)
        assert radius.max() == pytest.approx(gap.tip_radius, rel=1e-14)
        assert radius.min() == gap.bottom_radius
        assert (np.diff(radius[:31]) < 0.0).all()


@pytest.mark.parametrize("form", FORMS)
def test_outline_clears_the_seated_roller(form: str) -> None:
    for pitch, roller in CHAINS:
        for teeth in (9, 17, 60):
            gap = FORMS[form](pitch, roller, teeth)
            outline = gap.outline(401)
            assert np.hypot(outline.x, outline.y - gap.pitch_radius).min() >= 0.5 * roller


@pytest.mark.parametrize("form", FORMS)
def test_outline_has_the_curvature_and_the_area_of_the_arcs(form: str) -> None:
    """Curvature -1/r, +1/re and 0; area by Green's theorem on every exact segment."""
    gap = FORMS[form](25.4, 15.88, 19)
    errors = []
    for nodes in (401, 801):
        outline = gap.outline(nodes)
        twice = 0.0
        way = gap.half_length * np.abs(np.linspace(1.0, -1.0, nodes))
        step, start = way[0] - way[1], 0.0
        for part in gap.segments:
            inner = (way > start + step) & (way < start + part.length - step)
            inner[[0, -1]] = False
            sign = 1.0 if part is gap.segments[-1] else -1.0
            expected = sign / part.radius if isinstance(part, ArcSegment) else 0.0
            np.testing.assert_allclose(outline.curvature[inner], expected, rtol=1e-9, atol=1e-9)
            start += part.length
            if isinstance(part, ArcSegment):
                (cx, cy), r, p, q = part.centre, part.radius, part.first, part.last
                twice += r * (r * (q - p) + cx * (np.sin(q) - np.sin(p)) - cy * (np.cos(q) - np.cos(p)))
            else:
                twice += part.start[0] * part.end[1] - part.end[0] * part.start[1]
        shoelace = np.dot(outline.x[1:], outline.y[:-1]) - np.dot(outline.x[:-1], outline.y[1:])
        errors.append(abs(shoelace / 2.0 - twice))
    assert errors[0] < 1e-2
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.1)


@pytest.mark.parametrize("form", FORMS)
def test_roller_touches_along_its_path(form: str) -> None:
    """Points of path and outline at one theta are d1/2 apart, along (-sin, cos)."""
    gap = FORMS[form](25.4, 15.88, 19)
    for part, path in zip(gap.segments, gap.roller_path(), strict=True):
        share = np.linspace(0.0, 1.0, 7)
        theta = part.start_tangent + share * (part.end_tangent - part.start_tangent)
        gaps = path.point_at(share * path.length) - part.point_at(share * part.length)
        expected = 7.94 * np.column_stack([-np.sin(theta), np.cos(theta)])
        np.testing.assert_allclose(gaps, expected, rtol=0.0, atol=1e-12)


def test_ansi_constants_are_exact_inches() -> None:
    """0.003 in and 0.0015 in."""
    assert TypeIITooth.seat_allowance == pytest.approx(0.0381, rel=1e-15)
    tooth = TypeIITooth(12.7, 7.92, 20)
    assert tooth.seating_diameter - 1.005 * 7.92 == pytest.approx(0.0762, rel=1e-13)
