"""Chain length, centre distance, wrap, speed and span tensions against worked handbook drives.

A: Shigley, example 17-5, no. 140, 17 and 34 teeth, 25 pitches. B: a published no. 50 drive, 20
and 63 teeth, 36 pitches. C: no. 80, 20 and 60 teeth, 40 pitches. D: a conveyor drive with
ПР-25,4, 27 and 51 teeth, 30 pitches. E: the 19-tooth rating drive of no. 40 and 08B, 40 pitches.
"""

import cmath
import itertools
import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy.optimize import fsolve

from wearsim.chain.chain_length import belt_centre, belt_links, even_links, polygon_swing
from wearsim.chain.drive_layout import (
    DriveLayout,
    ToothMeetings,
    layout_with_centre,
    layout_with_links,
    polygon_effect,
)
from wearsim.chain.span_tension import catenary_tension, centrifugal_tension
from wearsim.errors import GeometryError
from wearsim.geometry.gap import pitch_diameter

# teeth 1, teeth 2, wished centre distance in pitches, links chosen
DRIVES = {
    "A": (17, 34, 25.0, 76),
    "B": (20, 63, 36.0, 114),
    "C": (20, 60, 40.0, 122),
    "D": (27, 51, 30.0, 100),
    "E": (19, 57, 40.0, 120),
}


def handbook_links(teeth_1: int, teeth_2: int, centre: float) -> float:
    """As ISO 606 and the handbooks print it: the first terms of the series."""
    return 2 * centre + (teeth_1 + teeth_2) / 2 + ((teeth_2 - teeth_1) / (2 * math.pi)) ** 2 / centre


def handbook_centre(teeth_1: int, teeth_2: int, links: float) -> float:
    """The same, solved for the centre distance."""
    spans = links - (teeth_1 + teeth_2) / 2
    return (spans + math.sqrt(spans**2 - 8 * ((teeth_2 - teeth_1) / (2 * math.pi)) ** 2)) / 4


def radians_per_second(rpm: float) -> float:
    return 2.0 * math.pi * rpm / 60.0


@pytest.mark.parametrize(("drive", "links", "digits"), [("A", 75.793, 3), ("B", 114.801, 3), ("D", 99.49, 2)])
def test_handbook_links(validated: Callable[..., None], drive: str, links: float, digits: int) -> None:
    """The handbooks' series is short of the exact links by less than 0.004 here."""
    one, two, centre, _ = DRIVES[drive]
    quantity, source = f"links of drive {drive}", "printed answer of the handbook"
    assert round(handbook_links(one, two, centre), digits) == links
    validated(quantity, belt_links(one, two, centre), links, 4e-3, source, "pitches", absolute=True)


@pytest.mark.parametrize(
    ("drive", "centre", "digits"), [("A", 25.1042, 4), ("B", 35.592, 3), ("D", 768.58 / 25.4, 3)]
)
def test_handbook_centre(drive: str, centre: float, digits: int) -> None:
    one, two, _, links = DRIVES[drive]
    assert round(handbook_centre(one, two, links), digits) == round(centre, digits)
    assert centre - 3e-3 < belt_centre(one, two, links) < centre + 0.5 * 10.0**-digits


def taut_polygons(
    pitch: float, teeth_1: int, teeth_2: int, links: int, near: float, phases: int
) -> list[float]:
    """Centre distances of convex polygons of rigid links, joints of the wheels in phases of a tooth."""
    (radius_1, radius_2), (step_1, step_2) = (
        [pitch / (2 * math.sin(math.pi / teeth)) for teeth in (teeth_1, teeth_2)],
        [2 * math.pi / teeth for teeth in (teeth_1, teeth_2)],
    )
    leans = math.pi / 2 + math.asin((radius_2 - radius_1) / near)  # where the upper span touches
    found = []
    for phase in range(phases):
        turned = phase * step_1 / phases
        upper = [round((leans - turned) / step_1) + i for i in (-1, 0, 1)]
        lower = [round((2 * math.pi - leans - turned) / step_1) + i for i in (-1, 0, 1)]
        round_2 = [round(2 * leans / step_2) + i for i in (-1, 0, 1)]
        spans = [round(near * math.sin(leans) / pitch) + i for i in (-1, 0, 1)]
        for first, last, on_2, above in itertools.product(upper, lower, round_2, spans):
            below = links - (last - first) - on_2 - above
            ends = [radius_1 * cmath.exp(1j * (turned + i * step_1)) for i in (first, last)]

            def misses(place: tuple[float, float], ends=ends, on_2=on_2, above=above, below=below) -> list:
                joints = [place[0] + radius_2 * cmath.exp(1j * (place[1] - i * step_2)) for i in (0, on_2)]
                return [abs(joints[0] - ends[0]) - above * pitch, abs(joints[1] - ends[1]) - below * pitch]

            place, _, solved, _ = fsolve(misses, [near, leans], full_output=True, xtol=1e-13)
            seats_1 = [radius_1 * cmath.exp(1j * (turned + i * step_1)) for i in range(first - 1, last + 2)]
            seats_2 = [
                place[0] + radius_2 * cmath.exp(1j * (place[1] - i * step_2)) for i in range(on_2 + 1, -2, -1)
            ]
            corners = np.array([*seats_1[1:-1], *seats_2[1:-1]])
            sides = np.roll(corners, -1) - corners
            free = np.array([seats_1[0], seats_1[-1], seats_2[0], seats_2[-1]])
            inside = (sides.conj()[:, None] * (free[None, :] - corners[:, None])).imag.min() > -1e-6
            if solved == 1 and inside and (sides.conj() * np.roll(sides, -1)).imag.min() > -1e-9:
                found.append(float(place[0]))
                break
    return found


@pytest.mark.parametrize(
    ("pitch", "teeth", "links", "taut", "ends"),
    [
        (7.774, (12, 82), 104, 202.764, (202.749, 202.782)),
        (25.4, (11, 20), 47, 398.388, (398.336, 398.452)),
        (12.7, (57, 19), 120, 514.961, (514.951, 514.970)),
    ],
)
def test_taut_chain_is_the_mean_of_its_polygons(pitch, teeth, links, taut, ends) -> None:
    """Rigid links in eight phases of a tooth, whose mean the formula is, within 0.002 mm."""
    centre = layout_with_links(pitch, *teeth, links).centre_distance
    assert round(centre, 3) == taut
    found = taut_polygons(pitch, *teeth, links, near=taut, phases=8)
    assert len(found) == 8
    assert sum(found) / 8 == pytest.approx(centre, abs=2e-3)
    assert (round(min(found), 3), round(max(found), 3)) == ends
    swing = pitch * polygon_swing(*teeth, links)
    assert swing == pytest.approx(max(max(found) - centre, centre - min(found)), abs=1e-6)


def test_given_by_distance_or_by_links_is_one_drive() -> None:
    """A taut distance with three decimals, up or down, is that of its links."""
    taut = layout_with_links(7.774, 12, 82, 104)
    for centre in (202.763, 202.764, 202.765, 202.80):
        assert layout_with_centre(7.774, 12, 82, centre) == taut
    assert layout_with_centre(7.774, 12, 82, 202.85).links == 106
    assert DriveLayout(7.774, 12, 82, 104, 202.8).links == 104
    with pytest.raises(GeometryError, match=r"needs 104\.0196 links, has 104: use 106"):
        DriveLayout(7.774, 12, 82, 104, 202.848)


def test_belt_of_case_b(validated: Callable[..., None]) -> None:
    """Three spans and arcs added up: 70.690 + 8.784 + 35.331 pitches."""
    quantity, source = "links of drive B by the exact belt length", "spans and arcs added up by hand"
    validated(quantity, belt_links(20, 63, 36.0), 114.805, 5e-4, source, "pitches", absolute=True)
    assert round(belt_centre(20, 63, 114), 3) == 35.590
    inclination = math.asin((1 / math.sin(math.pi / 63) - 1 / math.sin(math.pi / 20)) / 72.0)
    straight = 2.0 * 36.0 * math.cos(inclination)
    arcs = 20 * (math.pi - 2 * inclination) + 63 * (math.pi + 2 * inclination)
    assert belt_links(20, 63, 36.0) == pytest.approx(straight + arcs / (2 * math.pi), rel=1e-14)


def test_case_b_was_printed_half_a_link_off() -> None:
    """The paper's "exact" 114.305 links is 0.5 short; 35.8447 belongs to 114.5 links, not 114."""
    assert round(belt_links(20, 63, 36.0) - 114.305, 3) == 0.5
    assert round(belt_centre(20, 63, 114.5), 4) == 35.8447


def test_case_d_was_printed_with_misprints() -> None:
    """The page has 99.12 links for 99.49 and 1.6 m/s for 1.303."""
    one, two, centre, links = DRIVES["D"]
    assert round(handbook_links(one, two, centre), 2) == 99.49 != 99.12
    layout = layout_with_links(25.4, one, two, links)
    assert round(1e-3 * layout.chain_speed(radians_per_second(114.0)), 3) == 1.303
    assert even_links(99.12) == even_links(99.49) == 100


@pytest.mark.parametrize("drive", DRIVES)
def test_formulas_are_inverted_and_agree(drive: str) -> None:
    one, two, centre, links = DRIVES[drive]
    assert handbook_links(one, two, handbook_centre(one, two, links)) == pytest.approx(links, rel=1e-13)
    assert belt_links(one, two, belt_centre(one, two, links)) == pytest.approx(links, rel=1e-12)
    assert belt_links(two, one, centre) == pytest.approx(belt_links(one, two, centre), rel=1e-14)
    assert 0.0 < belt_links(one, two, centre) - handbook_links(one, two, centre) < 4.0e-3


@pytest.mark.parametrize(("teeth", "short"), [((17, 34), 7.1e-3), ((9, 150), 5.9e-2)])
def test_handbook_formula_is_short_by_what_its_docstring_says(teeth: tuple[int, int], short: float) -> None:
    centre = 1.6 * (1 / math.sin(math.pi / teeth[1]) - 1 / math.sin(math.pi / teeth[0]))
    found = belt_links(*teeth, centre) - handbook_links(*teeth, centre)
    assert found == pytest.approx(short, rel=0.02)


@pytest.mark.parametrize("drive", ["A", "C", "D", "E"])
def test_wished_centre_distance_gives_the_published_links(drive: str) -> None:
    one, two, centre, links = DRIVES[drive]
    layout = layout_with_centre(25.4, one, two, 25.4 * centre)
    assert layout.links == links
    assert not layout.needs_offset_link
    assert layout.centre_distance / 25.4 == pytest.approx(belt_centre(one, two, links), rel=1e-14)


def test_case_b_was_rounded_down() -> None:
    """114.80 became 114 there, and 36 pitches 35.592; the next even number upwards is 116."""
    assert layout_with_centre(15.875, 20, 63, 36 * 15.875).links == 116
    layout = layout_with_links(15.875, 20, 63, 114)
    assert round(layout.centre_distance / 15.875, 3) == 35.590


def test_whole_links_stay() -> None:
    """A centre distance that comes from 120 links gives 120 links again, rounding or not."""
    for links in range(60, 200, 2):
        centre = layout_with_links(12.7, 19, 41, links).centre_distance
        assert layout_with_centre(12.7, 19, 41, centre).links == links


def test_wrap_of_case_a(validated: Callable[..., None]) -> None:
    """167.6 degrees at 25 pitches; both wraps make a full turn, 17 * 167.61/360 pitches engaged."""
    layout = DriveLayout(44.45, 17, 34, 76, 25 * 44.45)
    found, source = math.degrees(layout.wrap_angle_1), "Shigley, example 17-5"
    validated("wrap of drive A", found, 167.6, 0.05, source, "deg", absolute=True)
    assert layout.wrap_angle_1 + layout.wrap_angle_2 == pytest.approx(2 * math.pi, rel=1e-15)
    assert layout.engaged_1 == pytest.approx(17 * 167.6097 / 360, rel=1e-6)
    assert layout.engaged_2 == pytest.approx(34 * (360 - 167.6097) / 360, rel=1e-6)


def test_span_and_arcs_make_the_chain() -> None:
    layout = layout_with_links(15.875, 20, 63, 114)
    total = 2 * layout.span / 15.875 + layout.engaged_1 + layout.engaged_2
    centre = layout.centre_distance / 15.875
    assert total == pytest.approx(belt_links(20, 63, centre), rel=1e-13)
    legs = (layout.span, 0.5 * (layout.pitch_diameter_2 - layout.pitch_diameter_1))
    assert math.hypot(*legs) == pytest.approx(layout.centre_distance, rel=1e-14)


def test_driver_may_be_the_larger_sprocket() -> None:
    down, up = layout_with_links(12.7, 19, 57, 120), layout_with_links(12.7, 57, 19, 120)
    assert up.wrap_angle_1 == pytest.approx(down.wrap_angle_2, rel=1e-15)
    assert (down.ratio, up.ratio) == (3.0, pytest.approx(1 / 3))


@pytest.mark.parametrize(
    ("pitch", "teeth", "rpm", "speed"),
    [(44.45, 17, 300, 3.778), (15.875, 20, 1200, 6.35), (25.4, 20, 750, 6.35), (25.4, 27, 114, 1.303)],
)
def test_chain_speed(
    validated: Callable[..., None], pitch: float, teeth: int, rpm: float, speed: float
) -> None:
    """Cases A to D [m/s]."""
    layout = layout_with_links(pitch, teeth, 51, 122)
    quantity, source = f"chain speed, {teeth} teeth at {rpm} rpm", "printed answer of the handbook"
    found, shown = 1e-3 * layout.chain_speed(radians_per_second(rpm)), teeth == 27
    validated(quantity, found, speed, 5e-4, source, "m/s", absolute=True, page=shown)


@pytest.mark.parametrize(
    ("teeth", "diameter"), [(9, 2.9238), (17, 5.4422), (19, 6.0755), (25, 7.9787), (57, 18.1529)]
)
def test_pitch_diameter_of_unit_pitch(validated: Callable[..., None], teeth: int, diameter: float) -> None:
    """ISO 606, annex A."""
    quantity, found = f"pitch diameter over pitch, {teeth} teeth", pitch_diameter(1.0, teeth)
    shown = teeth == 17
    validated(quantity, found, diameter, 5e-5, "ISO 606, annex A", absolute=True, page=shown)


@pytest.mark.parametrize(
    ("teeth", "percent"), [(9, 6.03), (11, 4.05), (13, 2.91), (17, 1.70), (19, 1.36), (25, 0.79)]
)
def test_polygon_effect(teeth: int, percent: float) -> None:
    assert round(100.0 * polygon_effect(teeth), 2) == percent


@pytest.mark.parametrize(("teeth", "links"), [(17, 76), (20, 114), (20, 120), (27, 100), (51, 102)])
def test_meetings_by_counting(teeth: int, links: int) -> None:
    """Roll the chain over the sprocket until tooth 0 meets roller 0 again."""
    pairs, engagement = set(), 0
    while (engagement % teeth, engagement % links) not in pairs:
        pairs.add((engagement % teeth, engagement % links))
        engagement += 1
    found = ToothMeetings(teeth, links)
    assert found.rollers_per_tooth == len({roller for tooth, roller in pairs if tooth == 0})
    assert found.rollers_per_tooth * teeth == engagement
    assert found.hunts == (len(pairs) == teeth * links)
    kinds = {roller % 2 for tooth, roller in pairs if tooth == 0}
    assert found.same_link_kind == (len(kinds) == 1)


@pytest.mark.parametrize("sag", [0.005, 0.01, 0.02, 0.03])
def test_catenary(validated: Callable[..., None], sag: float) -> None:
    """f = c (cosh(a/2c) - 1) with H = c q g, solved by bisection: the parabola is 4 f^2/3a^2 low."""
    low, high = 1.0, 1.0e4
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if middle * (math.cosh(0.5 / middle) - 1) > sag else (low, middle)
    mass, span = 2.6e-6, 800.0
    horizontal = low * mass * 9806.65 * span
    found = catenary_tension(mass, span, sag)
    quantity, source = f"tension of a strand that sags {100 * sag:g} %", "catenary by bisection"
    validated(quantity, found, horizontal, 1.5 * sag**2, source, "N", page=sag == 0.02)
    assert found < horizontal


def test_catenary_at_two_percent_and_on_a_slope() -> None:
    """6.25 q g a for 1 kg/m over 1 m; cos 60 deg = 1/2."""
    assert catenary_tension(1e-6, 1e3) == pytest.approx(6.25 * 9.80665, rel=1e-12)
    assert catenary_tension(1e-6, 1e3, slope=math.pi / 3) == pytest.approx(0.5 * 6.25 * 9.80665, rel=1e-12)


def test_tensions_of_case_b() -> None:
    """q = 1 kg/m at 6.35 m/s: 40.3 N; the teeth do not feel it."""
    fast = centrifugal_tension(1e-6, 6350.0)
    assert fast == pytest.approx(6.35**2, rel=1e-12)
    on_teeth = 1174.0 + catenary_tension(1e-6, 36 * 15.875)
    assert round(0.4225 * on_teeth) == 511  # P1 at 29 deg pressure angle


@pytest.mark.parametrize(
    ("pitch", "teeth", "links", "message"),
    [
        (12.7, (19, 57), 57, "exceed the 57 teeth of the larger sprocket, is 57"),
        (12.7, (19, 57), 39, "exceed the 57 teeth"),
        (12.7, (19, 57), 58, "use 68 links or more"),
        (12.7, (4, 57), 120, "at least 5 teeth"),
        (0.0, (19, 57), 120, "above 0"),
    ],
)
def test_links_that_cannot_be(pitch: float, teeth: tuple[int, int], links: int, message: str) -> None:
    with pytest.raises(GeometryError, match=message):
        layout_with_links(pitch, *teeth, links)


def test_named_links_and_distance_are_enough() -> None:
    """Tips: 12.7/2 (1.2 + cot(180/19) + cot(180/57)) = 6.35 * 25.318 = 160.769 mm."""
    assert layout_with_links(12.7, 19, 57, 68).links == 68
    with pytest.raises(GeometryError, match="use 68 links or more"):
        layout_with_links(12.7, 19, 57, 66)
    with pytest.raises(GeometryError, match=r"at least 160\.77 mm") as error:
        layout_with_centre(12.7, 19, 57, 160.0)
    least = float(str(error.value).split()[-2])
    assert layout_with_centre(12.7, 19, 57, least).links == 68


def test_chain_must_reach_but_may_sag() -> None:
    """Case D: 769 mm by the formula, installed at 767 mm."""
    taut = layout_with_links(25.4, 27, 51, 100)
    assert round(taut.centre_distance) == 769
    assert DriveLayout(25.4, 27, 51, 100, 767.0).wrap_angle_1 < taut.wrap_angle_1
    with pytest.raises(GeometryError, match=r"needs 100\.1118 links, has 100: use 102"):
        DriveLayout(25.4, 27, 51, 100, 770.0)


def test_belt_and_sag_that_cannot_be() -> None:
    with pytest.raises(GeometryError, match="exceed the 63 teeth"):
        belt_centre(20, 63, 63)
    with pytest.raises(GeometryError, match="sag must be above 0"):
        catenary_tension(1e-6, 1e3, sag=0.0)


def test_odd_chain_needs_an_offset_link() -> None:
    assert layout_with_links(12.7, 19, 57, 119).needs_offset_link
