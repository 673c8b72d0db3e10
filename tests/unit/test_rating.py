"""The drive of a case as the ratings see it."""

from dataclasses import replace

import pytest

import wearsim
from wearsim.catalogue.catalogues import regimes
from wearsim.chain.rating_findings import (
    RatedDrive,
    RatingFinding,
    assess,
    deciding,
    overloading,
    rating_warnings,
    warning,
)
from wearsim.errors import CaseError

WRAP = {
    "format_version": 1,
    "chain": {"designation": "ANSI 80-2"},
    "sprocket": {"teeth": 20, "profile": "ansi_b29"},
    "drive": {"mate_teeth": 60, "links": 122},
    "load": {"power_kW": 30, "speed_rpm": 750},
    "wear": {"condition": "hardened, oiled"},
}


def ratings(case):
    return case.drive.ratings(case)


def case(**tables):
    merged = {name: {**WRAP.get(name, {}), **table} for name, table in tables.items()}
    return wearsim.load_case({**WRAP, **merged})


def test_numbers_of_the_catalogue_and_the_load():
    """Two strands of 179.4 mm2 and 55.6 kN; 20 * 25.4 mm * 750 rpm = 6.35 m/s."""
    drive = case().drive
    found = drive.rated_drive(case(), drive.heaviest)
    assert (found.pitch, found.teeth, found.speed, found.strands) == (25.4, 20.0, 750.0, 2)
    assert (found.bearing_area, found.tensile, found.light) == (358.8, 111_200.0, False)
    assert found.power == pytest.approx(30.0, rel=1e-12)
    assert found.pull == pytest.approx(30e6 / 6350.0, rel=1e-12)
    assert found.own_tension == drive.slack + drive.heaviest.centrifugal
    assert found.series == "ISO606-A/ANSI B29.1"


@pytest.mark.parametrize(
    "load",
    [
        {"torque_N_m": 30e3 / (2 * 3.141592653589793 * 12.5), "speed_rpm": 750},
        {"tension_N": 30e6 / 6350.0 + 200.0, "speed_rpm": 750},
    ],
    ids=["torque", "tension"],
)
def test_power_of_other_loads(load):
    """P = T omega = (T_t - T_s) v."""
    tables = {**WRAP, "load": load, "drive": {**WRAP["drive"], "slack_tension_N": 200.0}}
    found = wearsim.load_case(tables)
    assert found.drive.rated_drive(found, found.drive.heaviest).power == pytest.approx(30.0, rel=1e-12)


def test_no_41_is_the_light_chain():
    chain = {"designation": "085-1"}
    found = case(chain=chain, load={"power_kW": 0.2, "speed_rpm": 100})
    assert found.drive.rated_drive(found, found.drive.heaviest).light


def test_every_other_gap_of_an_odd_number_is_half_a_tooth():
    """27 gaps: 13.5 teeth, laid out with 13; against 11 teeth the others are the smaller ones."""
    track = {
        "pitch_mm": 203.2,
        "roller_diameter_mm": 66.0,
        "inner_width_mm": 90.0,
        "pin_diameter_mm": 44.0,
        "bearing_area_mm2": 6600.0,
        "mass_kg_per_m": 60.0,
    }
    for mate, teeth, speed in ((13, 13.5, 10.0), (11, 11.0, 10.0 * 13.5 / 11)):
        found = wearsim.load_case(
            {
                **WRAP,
                "chain": track,
                "sprocket": {"teeth": 27, "engaged_every": 2, "profile": "gost591"},
                "drive": {"mate_teeth": mate, "links": 42},
                "load": {"power_kW": 30, "speed_rpm": 10},
            }
        )
        rated = found.drive.rated_drive(found, found.drive.heaviest)
        assert (rated.teeth, rated.speed) == pytest.approx((teeth, speed))
        assert rated.power == pytest.approx(30.0, rel=1e-12)


def test_ansi_formula_ends_with_its_largest_chain():
    """No. 240 has a pitch of 3 in."""
    names = [found.name for found in assess(RatedDrive(76.2, 17, 100.0, 10.0))]
    assert names[:3] == ["plate fatigue", "roller impact", "corrected power"]
    assert assess(RatedDrive(76.3, 17, 100.0, 10.0)) == ()


def test_a_strand_has_no_rating():
    sprocket = {"teeth": 20, "profile": "evolute"}
    tables = {**WRAP, "sprocket": sprocket}
    del tables["drive"]
    strand = wearsim.load_case(tables)
    assert (strand.drive.ratings(strand), strand.drive.notes(strand)) == ((), [])


def test_warnings_are_of_what_is_outside():
    """Two strands carry 1.7 * 29.33 = 49.9 kW; K_e = 3 asks 4724 * 3 * 2/(358.8 * 1.7) = 46 MPa."""
    power = case(drive={"service_factor": 1.7})
    assert [found.ok for found in ratings(power)][:3] == [False, True, False]
    joints = case(drive={"joint_application_factor": 3.0})
    (text,) = rating_warnings(ratings(joints))
    assert text.startswith("outside a rating: joint pressure 46.47 MPa, allowed at most 21.62 MPa")
    assert text.endswith("(GOST practice (Dunaev); for information here)")


def test_lower_limit_in_words():
    found = RatingFinding("safety", 6.0, 7.0, "", "iwis", at_least=True)
    assert warning(found) == "outside a rating: safety 6, allowed at least 7 (iwis)"


ONE_19 = {
    "format_version": 1,
    "chain": {"designation": "08B-1"},
    "sprocket": {"teeth": 19, "profile": "iso606"},
    "drive": {"mate_teeth": 57, "links": 120},
    "mechanism": {"kind": "wrap"},
    "wear": {"condition": "hardened, oiled"},
}


def test_every_rule_is_judged_by_its_own_worst_block():
    """The lighter block runs five times as fast: each rule as of the block alone that is worse."""
    slow, fast = ({"tension_N": 790, "speed_rpm": 1000}, {"tension_N": 780, "speed_rpm": 5000})
    both = [{"share_of_time": 0.5, **slow}, {"share_of_time": 0.5, **fast}]
    together = {found.name: found for found in ratings(wearsim.load_case({**ONE_19, "duty": both}))}
    alone = [
        {found.name: found for found in ratings(wearsim.load_case({**ONE_19, "load": load}))}
        for load in (slow, fast)
    ]
    for name, found in together.items():
        worst = max((of[name] for of in alone if name in of), key=lambda one: one.used)
        assert (found.value, found.limit) == (worst.value, worst.limit)
    assert not together["roller impact"].ok
    assert together["roller impact"].load == "780 N at 5000 rpm"
    warned = rating_warnings(ratings(wearsim.load_case({**ONE_19, "duty": both})))
    assert any("with 780 N at 5000 rpm, allowed" in text for text in warned)


def test_a_rule_without_a_row_is_named():
    """The table of joint pressures ends below 5000 rpm at this pitch."""
    fast = wearsim.load_case({**ONE_19, "load": {"tension_N": 780, "speed_rpm": 5000}})
    assert fast.drive.notes(fast)[-1] == "no limit known, so not judged: joint pressure"
    slow = wearsim.load_case({**ONE_19, "load": {"tension_N": 780, "speed_rpm": 500}})
    assert not any("no limit known" in text for text in slow.drive.notes(slow))


def test_a_typical_regime_is_rated_by_the_load_given():
    constant, light = (
        ratings(wearsim.load_case({**ONE_19, "load": {"power_kW": 6, "speed_rpm": 1000, **regime}}))
        for regime in ({}, {"regime": "V"})
    )
    assert [replace(one, hours=None) for one in light] == [replace(one, hours=None) for one in constant]


def test_hours_of_impact_in_a_typical_regime_are_those_of_its_parts():
    """1/h = sum(share p^2.5)/h_1, of the same speed."""
    load = {"power_kW": 6, "speed_rpm": 1000}
    full, light = (
        next(
            one.hours
            for one in ratings(wearsim.load_case({**ONE_19, "load": {**load, **regime}}))
            if one.hours
        )
        for regime in ({}, {"regime": "V"})
    )
    assert full / light == pytest.approx(sum(share * part**2.5 for part, share in regimes()["V"]))


def test_a_typical_regime_cannot_break_the_chain():
    load = {"tension_N": 22000, "speed_rpm": 100, "regime": "V"}
    drive = {**ONE_19["drive"], "slack_tension_N": 100}
    with pytest.raises(CaseError, match=r"load\.tension_N.*tensile strength"):
        wearsim.load_case({**ONE_19, "drive": drive, "load": load})


@pytest.mark.parametrize(
    ("series", "judges"),
    [("ISO606-B", False), ("ISO606-A/ANSI B29.1", False), ("GOST13568", True), ("", True)],
)
def test_a_gost_table_informs_on_an_iso_chain(series, judges):
    """Within all other ratings, 10 kW over 40 mm2 is 55 MPa; [p] is at most 35 MPa."""
    drive = RatedDrive(25.4, 25, 430.0, 10.0, bearing_area=40.0, tensile=60e3, series=series)
    findings = assess(drive)
    pressure = next(one for one in findings if one.name == "joint pressure")
    assert not pressure.ok
    assert (pressure in overloading(findings), pressure in deciding(findings)) == (judges, judges)
    assert pressure.informs != judges


@pytest.mark.parametrize(
    ("lubricant", "hours", "factor"),
    [("drip", None, 1.0), ("forced", None, 0.8), ("manual", None, 1.5), ("dry", 16.0, 1.5 * 1.25)],
)
def test_joint_factor_follows_lubricant_and_hours(lubricant, hours, factor):
    """The GOST table: continuous 0.8, drip 1, periodic 1.5; two shifts 1.25."""
    service = {} if hours is None else {"service": {"hours_per_day": hours}}
    tables = {**WRAP, "wear": {}, "lubrication": {"lubricant": lubricant}, **service}
    assert wearsim.load_case(tables).drive.joint_application_factor == pytest.approx(factor, rel=1e-14)


@pytest.mark.parametrize(
    ("shocks", "factor"), [(1.0, 1.0), (1.4, 1.35), (1.5, 1.35), (1.8, 1.8), (1.95, 1.8)]
)
def test_joint_factor_follows_the_shocks_of_f1(shocks, factor):
    """ISO 10823, smooth driver: 1.4 moderate, 1.8 heavy shocks; the GOST table: 1.35 and 1.8."""
    tables = {**WRAP, "drive": {**WRAP["drive"], "service_factor": shocks}}
    assert wearsim.load_case(tables).drive.joint_application_factor == pytest.approx(factor, rel=1e-14)


def test_joint_factor_that_the_shocks_of_f1_exceed():
    drive = {**WRAP["drive"], "service_factor": 1.8, "joint_application_factor": 1.0}
    (told,) = [text for text in wearsim.load_case({**WRAP, "drive": drive}).warnings if "joint_app" in text]
    assert (
        "= 1 is below the 1.8 that GOST practice gives for heavy shocks (service_factor = 1.8) alone" in told
    )


def test_joint_factor_that_the_lubricant_exceeds():
    """A factor that was right for drip oil, in a case whose lubricant was changed since."""
    drive = {**WRAP["drive"], "joint_application_factor": 1.25}
    tables = {**WRAP, "wear": {}, "drive": drive, "lubrication": {"lubricant": "manual"}}
    (told,) = [text for text in wearsim.load_case(tables).warnings if "joint_application_factor" in text]
    assert "= 1.25 is below the 1.5 that GOST practice gives for lubricant 'manual' alone" in told
    dripped = wearsim.load_case({**tables, "lubrication": {"lubricant": "drip"}})
    assert not [text for text in dripped.warnings if "joint_application_factor" in text]
