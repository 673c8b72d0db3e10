"""Ratings of chain drives against published answers and the handbooks' tables.

A: Shigley, example 17-5. B: a published no. 50 drive. C: a published no. 80 drive. D: a conveyor
drive with ПР-25,4 and its joint pressure. E: the rating point of no. 40 and its 08B neighbour.
No. 41: a rating table in horsepower (engineersedge.com).
"""

import math
from collections.abc import Callable

import pytest

from wearsim.catalogue.catalogues import catalogue_rows, chains
from wearsim.chain.drive_layout import layout_with_links
from wearsim.chain.elongation_limit import elongation_limit
from wearsim.chain.joint_pressure import (
    allowable_joint_pressure,
    joint_application,
    joint_application_factor,
    joint_pressure,
    least_safety,
    speed_limits,
)
from wearsim.chain.power_rating import (
    HORSEPOWER,
    application_factor,
    corrected_power,
    plate_fatigue_rating,
    power_rating,
    roller_impact_rating,
    strand_factor,
    tooth_factor,
)
from wearsim.chain.rating_findings import (
    RATINGS,
    RatedDrive,
    RatingFinding,
    assess,
    overloading,
    rating_note,
    rating_warnings,
    warning,
)
from wearsim.chain.span_tension import catenary_tension, centrifugal_tension
from wearsim.errors import CaseError
from wearsim.result.ends import rating_ends

RATING_40 = 6.17 * HORSEPOWER


def bisected(rating, target):
    """Number of teeth, no whole one, at which a rating that grows with it meets a target."""
    low, high = 1.0, 200.0
    for _ in range(80):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if rating(middle) < target else (low, middle)
    return low


def finding(drive: RatedDrive, name: str, *factors: float) -> RatingFinding:
    return next(found for found in assess(drive, *factors) if found.name == name)


@pytest.mark.parametrize(
    ("pitch", "teeth", "speed", "horsepower"),
    [(44.45, 17, 300, 72.39), (25.4, 20, 750, 39.33), (12.7, 19, 1000, 6.17)],
    ids=["no. 140", "no. 80", "no. 40"],
)
def test_plates_govern_at_low_speed(
    validated: Callable[..., None], pitch: float, teeth: int, speed: float, horsepower: float
) -> None:
    quantity = f"rating by link plate fatigue, pitch {pitch:g} mm, {teeth} teeth, {speed} rpm"
    found, source = plate_fatigue_rating(pitch, teeth, speed) / HORSEPOWER, "published drive"
    validated(quantity, found, horsepower, 5e-3, source, "hp", absolute=True)
    assert power_rating(pitch, teeth, speed) == plate_fatigue_rating(pitch, teeth, speed)


def test_teeth_of_the_no_50_drive(validated: Callable[..., None]) -> None:
    """15 hp at 1200 rpm: 20.046 teeth by the plates, 14.184 by the rollers with Kr = 17.

    The paper prints 141.84 for the latter, a misplaced point. Kr = 29, once claimed for no. 25 to
    240, would give 9.94 teeth.
    """
    plates = bisected(lambda teeth: plate_fatigue_rating(15.875, teeth, 1200), 15 * HORSEPOWER)
    impact = bisected(lambda teeth: roller_impact_rating(15.875, teeth, 1200), 15 * HORSEPOWER)
    source = "published no. 50 drive"
    validated("teeth for 15 hp by link plate fatigue", plates, 20.046, 5e-4, source, absolute=True)
    validated("teeth for 15 hp by roller impact", impact, 14.184, 5e-4, source, absolute=True)
    assert round(impact * (17 / 29) ** (2 / 3), 2) == 9.94


@pytest.mark.parametrize(
    ("teeth", "speed", "horsepower"),
    [(17, 100, 0.38), (11, 1000, 1.88), (20, 400, 1.57), (20, 1400, 3.33), (11, 1200, 1.71)],
)
def test_no_41_by_a_printed_table(
    validated: Callable[..., None], teeth: int, speed: float, horsepower: float
) -> None:
    """0.0022 and Kr = 3.4 for the light chain; the last two are governed by the rollers."""
    rating = power_rating(12.7, teeth, speed, light=True) / HORSEPOWER
    quantity, source = f"rating of no. 41, {teeth} teeth, {speed} rpm", "printed table"
    shown = speed == 1400
    validated(quantity, rating, horsepower, 6e-3, source, "hp", absolute=True, page=shown)


@pytest.mark.parametrize(("pitch", "constant"), [(6.35, 29), (9.525, 29), (12.7, 17), (76.2, 17)])
def test_impact_constant(pitch: float, constant: float) -> None:
    """With 25 teeth at 100 rpm H2 = 1000 Kr 0.125 P^0.8 hp."""
    expected = 125.0 * constant * (pitch / 25.4) ** 0.8
    assert roller_impact_rating(pitch, 25, 100) / HORSEPOWER == pytest.approx(expected, rel=1e-9)


def test_horsepower() -> None:
    """550 ft lbf/s with 0.3048 m and 4.4482216 N."""
    assert pytest.approx(550 * 0.3048 * 4.4482216152605e-3, rel=1e-8) == HORSEPOWER


@pytest.mark.parametrize(("strands", "factor"), [(1, 1.0), (2, 1.7), (3, 2.5), (4, 3.3), (5, 3.9), (6, 4.6)])
def test_strand_factors(strands: int, factor: float) -> None:
    """Shigley, table 17-23; GOST knows the first three (a public program has 15.1 and 25.1)."""
    assert strand_factor(strands) == factor
    if strands <= 3:
        assert strand_factor(strands, "GOST") == factor


def test_iso_factors() -> None:
    """f1 of ISO 10823 by the driven machine; f2 = (19/17)^1.08 and (19/25)^1.08."""
    drivers, driven = (
        ("smooth", "slight shocks", "moderate shocks"),
        ("smooth", "moderate shocks", "heavy shocks"),
    )
    table = [[application_factor(one, two) for one in drivers] for two in driven]
    assert table == [[1.0, 1.1, 1.3], [1.4, 1.5, 1.7], [1.8, 1.9, 2.1]]
    assert tooth_factor(19) == 1.0
    assert tooth_factor(17) == pytest.approx(math.exp(1.08 * math.log(19 / 17)), rel=1e-14)
    assert round(tooth_factor(25), 4) == 0.7435
    assert corrected_power(10.0, 1.5, 19) == 15.0


def test_correction_is_that_of_the_plates() -> None:
    """P f1 f2 <= H1(19) and P f1 <= H1(z) are the same condition."""
    for teeth in (11, 17, 25, 40):
        ratio = plate_fatigue_rating(25.4, teeth, 300) / plate_fatigue_rating(25.4, 19, 300)
        assert ratio * tooth_factor(teeth) == pytest.approx(1.0, rel=1e-12)


class TestShigley:
    """Case A: 67.1 kW, 300 rpm, 17 teeth, service factor 1.3, reserve 1.5."""

    FACTOR = 1.3 * 1.5

    def drive(self, pitch: float, strands: int) -> RatedDrive:
        return RatedDrive(pitch, 17, 300.0, 67.1, strands, series="ISO606-A/ANSI B29.1")

    @pytest.mark.parametrize(
        ("pitch", "strands", "holds"),
        [
            (63.5, 1, True),
            (50.8, 2, True),
            (44.45, 3, True),
            (44.45, 4, True),
            (50.8, 1, False),
            (44.45, 2, False),
            (38.1, 4, False),
        ],
        ids=["200-1", "160-2", "140-3", "140-4", "160-1", "140-2", "120-4"],
    )
    def test_published_options_hold_and_the_next_smaller_do_not(
        self, pitch: float, strands: int, holds: bool
    ) -> None:
        found = finding(self.drive(pitch, strands), "plate fatigue", self.FACTOR)
        assert found.ok == holds
        assert found.note == ""

    def test_choice_is_three_strands_of_no_140(self) -> None:
        """Required 70.4 hp a strand (176 hp with rounded steps) against 72.4 hp."""
        found = finding(self.drive(44.45, 3), "plate fatigue", self.FACTOR)
        assert found.value / (2.5 * HORSEPOWER) == pytest.approx(70.4, abs=0.3)
        assert round(found.limit / (2.5 * HORSEPOWER), 1) == 72.4
        assert finding(self.drive(44.45, 3), "corrected power", self.FACTOR).ok
        assert finding(self.drive(44.45, 3), "roller impact", self.FACTOR).ok


def test_no_50_drive_needs_21_teeth() -> None:
    """Case B: 10 hp with service factor 1.5 needs 20.046 teeth; 20 are a little short."""
    drives = [RatedDrive(15.875, teeth, 1200.0, 10 * HORSEPOWER) for teeth in (20, 21)]
    assert [finding(drive, "plate fatigue", 1.5).ok for drive in drives] == [False, True]
    assert round(drives[0].pull) == 1174


def test_no_80_drive_is_just_over() -> None:
    """Case C: required 40.2 hp against 39.33."""
    drive = RatedDrive(25.4, 20, 750.0, 30.0)
    found = finding(drive, "plate fatigue")
    assert (round(found.value / HORSEPOWER, 1), round(found.limit / HORSEPOWER, 2)) == (40.2, 39.33)
    assert not found.ok
    assert round(drive.pull) == 4724


def test_joint_pressure_of_the_conveyor_drive() -> None:
    """Case D: 2110 N, K_e 1.3, 179.7 mm2. The page allows 31 MPa, the table 32.87 at 114 rpm."""
    found = joint_pressure(2110.0, 179.7, application=1.3)
    assert found == pytest.approx(2110 * 1.3 / 179.7, rel=1e-14)
    assert found < 31.0
    assert round(allowable_joint_pressure(25.4, 114.0), 2) == 32.87
    drive = RatedDrive(25.4, 27, 114.0, 2.7494, bearing_area=179.7, series="GOST13568")
    assessed = finding(drive, "joint pressure", 1.0, 1.3)
    assert assessed.value == pytest.approx(found, rel=1e-4)
    assert assessed.ok
    assert assessed.note == ""


# Chain, teeth, links, speed [rpm], power [kW] (E: its full rating of 6.174 hp), strand factor and
# length of the slack span in pitches (the wished centre distance); then v [m/s], F_t [N], T1 [N m]
# and p_r [MPa] of the reference.
WORKED = {
    "A": ("ANSI 140", 17, 34, 76, 300, 67.1, 2.5, 25, 3.778, 17.76e3, 2148.5, 16.3),
    "B": ("ANSI 50", 20, 63, 114, 1200, 10 * HORSEPOWER, 1, 36, 6.35, 1174, None, 17.8),
    "C": ("ANSI 80", 20, 60, 122, 750, 30.0, 1, 40, 6.35, 4724, None, 27.8),
    "D": ("ПР-25,4-60", 27, 51, 100, 114, 2.7494, 1, 30, 1.303, 2110, 230.8, 12.4),
    "E": ("ANSI 40", 19, 57, 120, 1000, 4.604, 1, 40, 4.022, 1145, None, 26.4),
    "E 08B": ("08B", 19, 57, 120, 1000, 3.0, 1, 40, 4.022, 746, None, 15.5),
}


@pytest.mark.parametrize("case", WORKED)
def test_loads_of_the_worked_drives(validated: Callable[..., None], case: str) -> None:
    """v = z p n, F_t = P/v, T1 = F_t d1/2 and p_r = T_t/(d2 b2) to the printed digits."""
    name, one, two, links, rpm, power, strands, span, *printed = WORKED[case]
    speed_printed, pull_printed, torque_printed, pressure_printed = printed
    chain = chains()[name]
    layout = layout_with_links(chain.pitch, one, two, links)
    speed = layout.chain_speed(2 * math.pi * rpm / 60)
    pull = 1e6 * power / speed
    assert round(1e-3 * speed, 3) == speed_printed
    within, how = 5.0 if case == "A" else 0.5, {"absolute": True, "page": case in "AD"}
    source = "printed answer, see the test"
    validated(f"tension of drive {case}", pull, pull_printed, within, source, "N", **how)
    assert RatedDrive(chain.pitch, one, rpm, power).pull == pytest.approx(pull, rel=1e-12)
    tight = (
        pull / strands
        + catenary_tension(chain.mass_per_length, span * chain.pitch)
        + centrifugal_tension(chain.mass_per_length, speed)
    )
    found = tight / chain.bearing_area
    validated(f"joint pressure, drive {case}", found, pressure_printed, 0.05, source, "MPa", **how)
    if case == "A":
        assert round(1e-3 * tight, 2) == 7.72
    if torque_printed:
        torque = 0.5e-3 * pull * layout.pitch_diameter_1
        assert torque == pytest.approx(torque_printed, abs=0.5)


def test_torque_of_the_reference_is_not_that_of_the_shaft() -> None:
    """F_t d1/2 exceeds P/omega by (pi/z)/sin(pi/z), as z p is less than the pitch circle.

    Case A: 2148.5 N m for 90 hp (67.1 kW rounded: 2148.1), where the shaft has 2136.3.
    """
    layout = layout_with_links(44.45, 17, 34, 76)
    omega = 2 * math.pi * 300 / 60
    power = 90 * HORSEPOWER
    torque = 0.5e3 * power / layout.chain_speed(omega) * layout.pitch_diameter_1
    assert round(torque, 1) == 2148.5
    assert round(1e3 * power / omega, 1) == 2136.3
    excess = (math.pi / 17) / math.sin(math.pi / 17)
    assert torque * omega / (1e3 * power) == pytest.approx(excess, rel=1e-12)


# Dunaev/Ivanov: [p] in MPa at 50, 200, 400, 600, 800, 1000, 1200, 1600, 2800 rpm.
ALLOWED = {
    (12.7, 15.875): (35, 31.5, 28.5, 26, 24, 22.5, 21, 18.5, 14),
    (19.05, 25.4): (35, 30, 26, 23.5, 21, 19, 17.5, 15),
    (31.75, 38.1): (35, 29, 24, 21, 18.5, 16.5, 15),
    (44.45, 50.8): (35, 26, 21, 17.5, 15),
}
SPEEDS = (50, 200, 400, 600, 800, 1000, 1200, 1600, 2800)


@pytest.mark.parametrize("pitches", ALLOWED)
def test_allowable_joint_pressure(pitches: tuple[float, float]) -> None:
    column = ALLOWED[pitches]
    for pitch in pitches:
        for speed, pressure in zip(SPEEDS, column, strict=False):
            assert allowable_joint_pressure(pitch, speed) == pressure
        assert allowable_joint_pressure(pitch, 125.0) == 0.5 * (column[0] + column[1])
        assert allowable_joint_pressure(pitch, 5.0) == 35.0
        assert allowable_joint_pressure(pitch, SPEEDS[len(column) - 1] + 1.0) is None


@pytest.mark.parametrize("pitch", [9.525, 17.0, 28.0, 41.0, 63.5])
def test_no_pressure_for_other_pitches(pitch: float) -> None:
    assert allowable_joint_pressure(pitch, 100.0) is None


def test_joint_application_factor() -> None:
    """1.35 * 1.5 * 1.45 * 1.25, and 0.15 sqrt(81) = 1.35 on a slope of 81 degrees."""
    assert joint_application_factor() == 1.0
    worst = joint_application_factor("moderate shocks", "periodic", "three", "none")
    assert worst == pytest.approx(1.35 * 1.5 * 1.45 * 1.25, rel=1e-14)
    best = joint_application_factor("heavy shocks", "continuous", "two", "tensioner")
    assert best == pytest.approx(1.8 * 0.8 * 1.25 * 1.1, rel=1e-14)
    assert joint_application_factor(slope=math.radians(81)) == pytest.approx(1.35, rel=1e-12)
    assert joint_application_factor(slope=math.radians(60)) == 1.0


def test_joint_pressure_of_several_strands() -> None:
    """A is one strand's: three strands of 180 mm2 carry 2.5 times 180 mm2."""
    assert joint_pressure(9000.0, 3 * 180.0, strands=3) == pytest.approx(20.0, rel=1e-14)


@pytest.mark.parametrize(
    ("pitch", "limits"),
    [
        (12.7, (1250, 3100)),
        (15.875, (1000, 2300)),
        (19.05, (900, 1800)),
        (25.4, (800, 1200)),
        (38.1, (500, 900)),
        (44.45, (400, 600)),
        (50.8, (300, 450)),
        (9.525, None),
    ],
)
def test_speed_limits(pitch: float, limits: tuple[float, float] | None) -> None:
    assert speed_limits(pitch) == limits


@pytest.mark.parametrize(
    ("teeth", "limit"), [(20, 0.03), (66, 0.03), (67, 2 / 67), (100, 0.02), (134, 2 / 134)]
)
def test_elongation_limit(teeth: int, limit: float) -> None:
    """200/z % from 67 teeth on, 3 % below; 1.5 % where nothing takes the slack up."""
    assert elongation_limit(teeth) == limit
    assert elongation_limit(teeth, adjustable=False) == min(0.015, limit)


def test_rating_point_has_every_finding() -> None:
    """Case E lies at its plate rating; the GOST table allows less: 22.5 of its 25.7 MPa."""
    chain = chains()["ANSI 40"]
    drive = RatedDrive(
        chain.pitch,
        19,
        1000.0,
        RATING_40,
        bearing_area=chain.bearing_area,
        tensile=chain.tensile,
        own_tension=28.4,
        series=chain.series,
    )
    found = {entry.name: entry for entry in assess(drive)}
    assert set(found) == {
        "plate fatigue",
        "roller impact",
        "corrected power",
        "joint pressure",
        "recommended speed",
        "greatest speed",
        "safety against breaking",
        "galling speed",
    }
    # 1172.4 N = 263.6 lbf: 82.5/(2.8196 1.6836 1.0766) = 16.143, to the power of 1/1.3944 7.351.
    assert found["galling speed"].limit == pytest.approx(7351.0, rel=1e-3)
    assert all(entry.source for entry in found.values())
    assert found["plate fatigue"].value / found["plate fatigue"].limit == pytest.approx(1, abs=1e-3)
    assert found["joint pressure"].value == pytest.approx(1144.0 / 44.5, rel=1e-3)
    assert not found["joint pressure"].ok
    assert found["safety against breaking"].value == pytest.approx(13900 / 1172.4, rel=1e-3)
    assert found["safety against breaking"].ok
    assert {name for name, entry in found.items() if not entry.ok} == {"joint pressure"}


def test_safety_is_a_lower_limit() -> None:
    weak = RatedDrive(25.4, 20, 750.0, 30.0, tensile=6.9 * 4724.41)
    assert not finding(weak, "safety against breaking").ok


# Norms [s] of chains ПР and 2ПР, course notes after Chernavsky: pitch [mm] down, speed [rpm] across.
SAFETY_SPEEDS = (50, 100, 300, 500, 750, 1000, 1250)
SAFETIES = {
    12.7: (7.1, 7.3, 7.9, 8.5, 9.3, 10.0, 10.6),
    15.875: (7.2, 7.4, 8.2, 8.9, 10.0, 10.8, 11.6),
    19.05: (7.2, 7.5, 8.4, 9.4, 10.7, 11.7, 12.7),
    25.4: (7.3, 7.6, 8.9, 10.2, 12.0, 13.3, 14.5),
    31.75: (7.4, 7.8, 9.4, 11.0, 13.0, 15.0),
    38.1: (7.5, 8.0, 9.8, 11.8, 14.0),
    44.45: (7.6, 8.1, 10.3, 12.5),
    50.8: (7.6, 8.3, 10.8),
}


@pytest.mark.parametrize("pitch", SAFETIES)
def test_least_safety(pitch: float) -> None:
    column = SAFETIES[pitch]
    for speed, safety in zip(SAFETY_SPEEDS, column, strict=False):
        assert least_safety(pitch, speed) == safety
    assert least_safety(pitch, 200.0) == pytest.approx(0.5 * (column[1] + column[2]), rel=1e-14)
    assert least_safety(pitch, 5.0) == column[0]
    assert least_safety(pitch, SAFETY_SPEEDS[len(column) - 1] + 1.0) is None


def test_pitches_without_a_least_safety() -> None:
    assert all(least_safety(pitch, 100.0) is None for pitch in (8.0, 9.525, 20.0, 63.5))


GOST = {"tensile": 60_000.0, "own_tension": 100.0, "series": "GOST13568"}


def test_safety_of_a_gost_chain_is_that_of_the_handbook() -> None:
    """s = Q/(k_d F_t + F_v + F_f), 60 kN over 1.4 * 4724.41 N + 100 N, against 12 at 750 rpm."""
    drive = RatedDrive(25.4, 20, 750.0, 30.0, **GOST)
    found = finding(drive, "safety against breaking", 1.4)
    assert found.value == pytest.approx(60_000.0 / (1.4 * 4724.41 + 100.0), rel=1e-6)
    assert (found.limit, found.note, found.ok) == (12.0, "", False)
    said = "outside a rating: safety against breaking 8.936, allowed at least 12 (GOST practice"
    assert warning(found).startswith(said)
    assert found in overloading(assess(drive, 1.4))
    assert warning(found) in rating_warnings(assess(drive, 1.4))


def test_other_chains_keep_the_safety_of_their_makers() -> None:
    """7 without shocks: the table of [s] is for chains ПР and 2ПР, and of 50.8 mm pitch to 300 rpm."""
    for series in ("ISO606-A/ANSI B29.1", "ISO606-B", "ISO606-H", ""):
        drive = RatedDrive(25.4, 20, 750.0, 30.0, **{**GOST, "series": series})
        found = finding(drive, "safety against breaking", 1.4)
        assert found.value == pytest.approx(60_000.0 / 4824.41, rel=1e-6)
        assert (found.limit, found.note) == (7.0, "")
    for drive in (
        RatedDrive(25.4, 20, 750.0, 30.0, strands=3, **GOST),
        RatedDrive(50.8, 20, 301.0, 30.0, **GOST),
    ):
        assert finding(drive, "safety against breaking").limit == 7.0


def test_application_factor_has_a_part_for_the_pressure_and_one_for_hours() -> None:
    """1.35, 1.1 and 0.15 sqrt(81) = 1.35 press the joint harder; 1.5 and 1.45 stand for hours."""
    words = ("moderate shocks", "periodic", "three", "tensioner")
    used = joint_application(*words, slope=math.radians(81.0))
    assert used.pressure == pytest.approx(1.35 * 1.1 * 1.35, rel=1e-14)
    assert used.hours == pytest.approx(1.5 * 1.45, rel=1e-14)
    assert used.factor == pytest.approx(used.pressure * used.hours, rel=1e-14)
    assert used.factor == joint_application_factor(*words, slope=math.radians(81.0))


def test_shifts_are_hours_by_the_cube_law() -> None:
    """Twice and three times the hours, life ~ p^-3: 1.260 and 1.442. 1.5 for three is 4 % more."""
    for shifts, word in ((1, "one"), (2, "two"), (3, "three")):
        assert joint_application(shifts=word).shifts == pytest.approx(shifts ** (1 / 3), rel=0.01)


def test_speed_beyond_the_limit_is_found() -> None:
    fast = RatedDrive(25.4, 20, 1201.0, 1.0)
    assert not finding(fast, "greatest speed").ok
    assert finding(RatedDrive(25.4, 20, 801.0, 1.0), "greatest speed").ok
    assert not finding(RatedDrive(25.4, 20, 801.0, 1.0), "recommended speed").ok


def test_unknown_numbers_leave_their_findings_out() -> None:
    names = [found.name for found in assess(RatedDrive(9.525, 20, 750.0, 1.0))]
    assert names == ["plate fatigue", "roller impact", "corrected power", "galling speed"]


@pytest.mark.parametrize(
    ("series", "words"),
    [
        ("ISO606-B", "B chain"),
        ("ISO606-H", "thicker plates"),
        ("GOST13568", "joint pressure"),
        ("", "not known"),
    ],
)
def test_power_ratings_are_indicative_outside_the_a_series(series: str, words: str) -> None:
    drive = RatedDrive(12.7, 19, 1000.0, 3.0, bearing_area=50.3, series=series)
    assert rating_note(series).startswith("indicative")
    assert words in finding(drive, "plate fatigue").note
    assert bool(finding(drive, "joint pressure").note) == (series != "GOST13568")


@pytest.mark.parametrize("series", sorted({row.series for row in chains().values()}))
def test_every_series_of_the_catalogue_is_known(series: str) -> None:
    assert "not known" not in rating_note(series)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: application_factor("smoth", "smooth"), "driver must be one of smooth, slight"),
        (lambda: application_factor("smooth", "hevy shocks"), "did you mean 'heavy shocks'"),
        (lambda: joint_application_factor(shifts="four"), "state must be one of one, two, three"),
        (lambda: strand_factor(7), "strands must be one of 1, 2, 3, 4, 5, 6, is '7'"),
        (lambda: strand_factor(4, "GOST"), "strands must be one of 1, 2, 3, is '4'"),
        (lambda: joint_pressure(1.0, 0.0), "bearing area must be above 0"),
        (lambda: RatedDrive(0.0, 19, 1000.0, 0.0), "(?s)pitch must be above 0.*power must be above"),
    ],
)
def test_numbers_and_words_that_cannot_be(call, message: str) -> None:
    with pytest.raises(CaseError, match=message):
        call()


@pytest.mark.parametrize(
    "table",
    [
        "application_factors",
        "exploitation_factors",
        "joint_pressure",
        "least_safety",
        "speed_limits",
        "strand_factors",
    ],
)
def test_every_row_has_a_source(table: str) -> None:
    assert all(row["source"].strip() for row in catalogue_rows(table))


def test_every_rating_of_the_list_is_found_in_its_order_and_no_other() -> None:
    drive = RatedDrive(25.4, 20, 750.0, 20.0, bearing_area=180.0, tensile=60_000.0, links=100.0)
    assert [found.name for found in assess(drive)] == list(RATINGS)


def test_a_chain_ends_by_the_ratings_that_say_so() -> None:
    ratings = [RatingFinding(name, 1.0, 2.0, "rpm", "whose", hours=500.0) for name in RATINGS]
    ends = {end.mode: (end.hours, end.verdict) for end in rating_ends(ratings)}
    within = "within its rating for 15 000 h: 50 % used"
    assert ends == {
        "link plate fatigue": (500.0, within),
        "roller and bush impact": (500.0, within),
        "galling of pin and bush": (500.0, "within its limit of speed: 50 % used"),
    }
