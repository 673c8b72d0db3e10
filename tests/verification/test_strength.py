"""Allowable stresses of gears: the numbers of section S1 of the reference text, and closed forms.

Examples A (quenched and tempered, regime II) and B (carburised, load spectrum), the load factor and the
contact stress of a pair 36/54 were worked out there from source 001, independently of this code.
"""

import math
from itertools import pairwise
from pathlib import Path

import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from wearsim.catalogue.catalogues import regimes
from wearsim.errors import CaseError, GeometryError
from wearsim.fatigue.endurance import FatigueCurve, contact_base_cycles, service_hours
from wearsim.fatigue.heat_treatment import treatments
from wearsim.handbook.strength.keys import StrengthTables
from wearsim.handbook.strength.spectrum import LoadSpectrum, load_spectrum, regime_spectrum
from wearsim.handbook.strength.tooth_stress import SpurMesh
from wearsim.input.document import load_calculation

FOLDER = Path(__file__).parents[2] / "cases" / "sizing"
CASES = {name: FOLDER / f"strength-{name}.toml" for name in ("a-tempered", "b-carburised")}
STEEL = 2.1e5 / (2.0 * (1.0 - 0.3**2))


SOURCE = "source 001 by an independent program"


def near(value):
    return pytest.approx(value, rel=1e-9)


def pair(name, *overrides):
    return load_calculation(CASES[name], StrengthTables, overrides).strength()


def both(found, kind, attribute):
    return [getattr(getattr(gear, kind), attribute) for gear in found.gears]


class TestExampleA:
    def test_cycles(self):
        found = pair("a-tempered")
        assert [gear.cycles for gear in found.gears] == near([7.2e7, 1.8e7])
        assert both(found, "contact", "equivalent_cycles") == near([1.8e7, 4.5e6])
        assert both(found, "bending", "equivalent_cycles") == near([1.0296e7, 2.574e6])

    def test_contact_by_gost(self, validated):
        found = pair("a-tempered")
        base = [gear.contact.curve.base_cycles for gear in found.gears]
        expected = [23473395.97129, 18322579.50387]
        validated("base cycles, example A", base, expected, 1e-9, SOURCE, "cycles")
        assert both(found, "contact", "endurance_limit") == near([641.0, 585.0])
        factor, expected = both(found, "contact", "factor"), [1.045242925093, 1.263656445324]
        validated("life factor of contact, example A", factor, expected, 1e-9, SOURCE)
        for gear, stress, expected in zip(
            ("pinion", "wheel"),
            both(found, "contact", "allowable"),
            (609.0915590772, 672.0354731951),
            strict=True,
        ):
            quantity = f"allowable contact stress, {gear} of example A"
            validated(quantity, stress, expected, 1e-9, SOURCE, "MPa")
        assert found.contact_governs.name == "pinion"

    def test_contact_as_the_source_reads(self):
        found = pair("a-tempered", "fatigue.base_cycles=source")
        assert [gear.contact.curve.base_cycles for gear in found.gears] == [1e7, 1e7]
        assert both(found, "contact", "raw_factor") == near([0.906681141, 1.142346655087])
        assert both(found, "contact", "factor") == near([1.0, 1.142346655087])
        assert both(found, "contact", "allowable") == near([582.7272727273, 607.5207211147])

    def test_bending(self, validated):
        found = pair("a-tempered")
        assert both(found, "bending", "endurance_limit") == near([499.625, 450.625])
        assert both(found, "bending", "raw_factor") == near([0.854211164, 1.076238626140])
        assert both(found, "bending", "factor") == near([1.0, 1.076238626140])
        stress, expected = both(found, "bending", "allowable"), [293.8970588235, 285.2823711202]
        quantity = "allowable bending stress, example A"
        validated(quantity, stress, expected, 1e-9, SOURCE, "MPa")
        assert both(found, "bending", "greatest") == near([1370.4, 1236.0])

    def test_printed_overload_without_its_safety(self):
        """The source has lost S_st; without it the stress is beyond the strength of any steel."""
        found = pair("a-tempered", "overload.static_safety=1")
        assert both(found, "bending", "greatest") == near([2398.2, 2163.0])

    def test_greatest_contact_stress_is_of_the_yield_strength(self):
        assert both(pair("a-tempered"), "contact", "greatest") == near([2.8 * 750, 2.8 * 640])


class TestExampleB:
    def test_equivalence_without_the_overload(self):
        """0.4 + 0.35 0.7^k + 0.25 0.4^k by hand."""
        spectrum = pair("b-carburised").spectrum
        assert spectrum.equivalence(3) == near(0.53605)
        assert spectrum.equivalence(9) == near(0.41418929845)
        assert spectrum.equivalence(6) == near(0.44220115)
        assert (spectrum.peak, spectrum.peak_cycles) == (1.6, 2e4)

    def test_cycles(self):
        found = pair("b-carburised")
        assert [gear.cycles for gear in found.gears] == near([2.61e8, 82857142.857143])
        assert both(found, "contact", "equivalent_cycles") == near([139909050, 44415571.428571])
        assert both(found, "bending", "equivalent_cycles") == near([108103406.89545, 34318541.871571])

    @pytest.mark.parametrize("reading", ["gost", "source"])
    def test_contact(self, validated, reading):
        found = pair("b-carburised", f"fatigue.base_cycles={reading}")
        uncapped = 30.0 * 595.0**2.4
        assert uncapped == near(136760907.027643)
        assert [gear.contact.curve.base_cycles for gear in found.gears] == [1.2e8, 1.2e8]
        assert both(found, "contact", "raw_factor") == near([0.974741013, 1.180160293455])
        assert both(found, "contact", "endurance_limit") == near([1368.5, 1368.5])
        stress, expected = both(found, "contact", "allowable"), [1140.4166666667, 1345.8744679941]
        quantity, shown = "allowable contact stress, example B", reading == "gost"
        validated(quantity, stress, expected, 1e-9, SOURCE, "MPa", page=shown)
        assert found.contact_governs.name == "pinion"
        assert both(found, "contact", "greatest") == near([2618.0, 2618.0])

    def test_bending(self, validated):
        found = pair("b-carburised")
        assert both(found, "bending", "factor") == [1.0, 1.0]
        quantity, stress = ("allowable bending stress, example B", both(found, "bending", "allowable"))
        validated(quantity, stress, 455.8823529412, 1e-9, SOURCE, "MPa")
        assert both(found, "bending", "greatest") == near([1328.5714285714] * 2)
        printed = pair("b-carburised", "overload.static_safety=1")
        assert both(printed, "bending", "greatest") == near([2325.0] * 2)

    def test_life_in_years(self):
        assert service_hours(8, 0.6, 0.25) == near(10512.0)


class TestLoad:
    KEYS = (
        "drive.gear_ratio=1.5",
        "load.pinion_torque_N_m=240",
        "load.module_mm=3",
        "load.pinion_teeth=36",
        "load.face_width_mm=76",
    )

    def test_factors(self, validated):
        load = pair("a-tempered", *self.KEYS).load
        assert load.contact_factor.application == 1.0
        assert load.contact_factor.face == near(1.052)
        assert load.contact_factor.transverse == near(1.0468)
        quantity, found = "load factor of contact, 36 and 54 teeth", load.contact_factor.total
        validated(quantity, found, 1.167307616, 1e-9, SOURCE)
        assert load.bending_factor.face == near(1.164)
        assert load.bending_factor.transverse == near(1.18)
        assert load.bending_factor.total == near(1.164 * 1.18 * 1.12)

    def test_shocks_of_the_machine_are_in_a_spectrum_but_not_in_a_constant_load(self):
        assert pair("a-tempered", "drive.regime=0").load.contact_factor.application == 1.25
        assert pair("a-tempered", "drive.regime=V").load.contact_factor.application == 1.0
        assert pair("b-carburised").load.contact_factor.application == 1.0

    def test_contact_stress(self, validated):
        load = pair("a-tempered", *self.KEYS).load
        assert load.mesh.tangential_force == near(4444.444444444)
        quantity, found = "contact stress as printed", load.printed_contact_stress
        validated(quantity, found, 475.6585130901, 1e-9, SOURCE, "MPa")
        quantity, found = "contact stress of the normal force", load.corrected_contact_stress
        validated(quantity, found, 490.6845296400, 1e-9, SOURCE, "MPa")
        assert load.contact_stress == load.corrected_contact_stress
        printed = pair("a-tempered", *self.KEYS, "load.formula=printed").load
        assert printed.contact_stress == printed.printed_contact_stress

    def test_normal_force_is_what_the_factors_of_the_standards_hold(self):
        """Z_E Z_H sqrt(F_t K_H (u + 1)/(b d1 u))."""
        angle = math.radians(20.0)
        elastic = math.sqrt(STEEL / math.pi)
        zone = math.sqrt(2.0 / (math.cos(angle) * math.sin(angle)))
        assert elastic == near(191.6456725064)
        assert zone == near(2.4945731714)
        force, width, diameter, ratio = 4000.0 / 0.9, 76.0, 108.0, 1.5
        root = math.sqrt(force * 1.167307616 * (ratio + 1.0) / (width * diameter * ratio))
        mesh = SpurMesh(240e3, 3.0, 36, ratio, width, angle, STEEL)
        assert mesh.contact_stress(1.167307616) == near(elastic * zone * root)

    def test_bending_stress(self):
        """F_t K_F Y_FS/(b m) with Y_FS = 3.47 + 13.2/z."""
        load = pair("a-tempered", *self.KEYS).load
        per_form = 4000.0 / 0.9 * 1.164 * 1.18 * 1.12 / (76.0 * 3.0)
        forms = (3.47 + 13.2 / 36.0, 3.47 + 13.2 / 54.0)
        assert load.bending_stresses == near(tuple(per_form * form for form in forms))

    def test_load_is_that_of_the_largest_long_acting_torque(self):
        """Doubling all relative torques doubles the torque and leaves the equivalence alone."""
        single = pair("b-carburised")
        steps = [(2.0, 0.4), (1.4, 0.35), (0.8, 0.25)]
        tables = load_calculation(CASES["b-carburised"], StrengthTables).model_dump(exclude_unset=True)
        tables["load_spectrum"] = [{"relative_torque": t, "share_of_time": s} for t, s in steps]
        double = load_calculation(tables, StrengthTables).strength()
        assert double.spectrum.equivalence(9) == near(single.spectrum.equivalence(9))
        assert double.load.contact_stress == near(math.sqrt(2.0) * single.load.contact_stress)
        assert double.load.bending_stresses[1] == near(2.0 * single.load.bending_stresses[1])

    def test_overload_goes_with_the_torque_and_its_root(self):
        found = pair("b-carburised")
        for contact, bending in found.stresses:
            assert contact.peak == near(math.sqrt(1.6) * contact.lasting)
            assert bending.peak == near(1.6 * bending.lasting)
            assert contact.peak_margin == near(2618.0 / contact.peak)


PUBLISHED = {
    "0": (1, 1, 1),
    "I": (0.5, 0.3, 0.2),
    "II": (0.25, 0.143, 0.1),
    "III": (0.18, 0.065, 0.036),
    "IV": (0.125, 0.038, 0.016),
    "V": (0.063, 0.013, 0.004),
}


class TestSpectrum:
    @pytest.mark.parametrize("name", PUBLISHED)
    def test_table(self, name):
        found = regime_spectrum(name)
        assert tuple(found.equivalence(k) for k in (3, 6, 9)) == PUBLISHED[name]

    @pytest.mark.parametrize("k", [3, 6, 9])
    def test_regime_ii_is_the_integral_over_all_torques(self, validated, k):
        exact = quad(lambda x: x**k, 0.0, 1.0)[0]
        quantity, found = f"mean of x^{k} in the regime II", regime_spectrum("II").equivalence(k)
        validated(quantity, found, exact, 5e-4, "integral", absolute=True, page=k == 6)

    @pytest.mark.parametrize("name", ["I", "II", "III", "IV", "V"])
    def test_an_exponent_without_a_table_is_summed_over_the_blocks(self, name):
        found = regime_spectrum(name)
        expected = sum(share * torque**7.0 for torque, share in regimes()[name])
        assert found.equivalence(7.0) == near(expected)
        assert found.equivalence(9) < found.equivalence(7.0) < found.equivalence(6)

    @pytest.mark.parametrize(
        ("name", "a", "b", "tolerance"),
        [
            ("I", 6.649, 1.967, 3e-4),
            ("II", 1, 1, 1e-3),
            ("IV", 2.169, 2.997, 8e-3),
            ("V", 1.915, 4.133, 2e-2),
        ],
    )
    def test_beta_distributions(self, name, a, b, tolerance):
        """Mean of x^k is the product of (a + i)/(a + b + i); IV and V are not met to the digit."""
        for k in (3, 6, 9):
            mean = math.prod((a + i) / (a + b + i) for i in range(k))
            assert regime_spectrum(name).equivalence(k) == pytest.approx(mean, rel=tolerance)

    def test_regime_iii_is_nearly_normal(self):
        """0.5 and the deviation that gives a mean cube of 0.18; the rest within 2.2 %."""
        variance = (0.18 - 0.125) / 1.5
        assert round(math.sqrt(variance), 5) == 0.19149
        means = [1.0, 0.5]
        for i in range(2, 10):
            means.append(0.5 * means[-1] + (i - 1) * variance * means[-2])
        assert [means[3], means[6], means[9]] == pytest.approx([0.18, 0.0658644, 0.0367651], 1e-6)
        for k in (3, 6, 9):
            assert regime_spectrum("III").equivalence(k) == pytest.approx(means[k], rel=0.022)

    def test_a_single_level(self):
        found = load_spectrum([(0.7, 1e6)], 1e6)
        assert (found.torque, found.peak) == (0.7, 1.0)
        assert [found.equivalence(k) for k in (3, 6, 9)] == [1.0, 1.0, 1.0]

    @pytest.mark.parametrize(("cycles", "excluded"), [(49999.0, True), (50000.0, False)])
    def test_an_overload_acts_for_less_than_5e4_cycles(self, cycles, excluded):
        found = load_spectrum([(1.5, cycles), (1.0, 1e6)], 1e6)
        assert found.torque == (1.0 if excluded else 1.5)
        assert found.peak == (1.5 if excluded else 1.0)
        assert found.peak_cycles == (cycles if excluded else 0.0)

    def test_two_short_torques_count_together(self):
        found = load_spectrum([(2.0, 4e4), (1.5, 4e4), (1.0, 1e6)], 1e6)
        assert (found.torque, found.peak, found.peak_cycles) == (1.5, 2.0 / 1.5, 4e4)

    def test_a_share_of_a_long_life_is_no_overload(self):
        """1e-4 of the time is 1e4 cycles of 1e8, but of a life ten times as long 1e5."""
        steps = [
            f"{{relative_torque={torque},share_of_time={share}}}"
            for torque, share in ((2.0, 1e-4), (1.0, 0.9999))
        ]
        keys = (f"load_spectrum=[{','.join(steps)}]", "drive.pinion_speed_rpm=1000")
        assert pair("b-carburised", *keys, "drive.life_hours=1666").spectrum.peak == 2.0
        assert pair("b-carburised", *keys, "drive.life_hours=16667").spectrum.peak == 1.0

    @pytest.mark.parametrize("steps", [[(1.0, 4e4)], [(1.0, 4e4), (0.0, 1e9)]])
    def test_nothing_but_overload(self, steps):
        with pytest.raises(GeometryError, match=r"load_spectrum: .* raise the life"):
            load_spectrum(steps, 1e6)

    def test_exponent_of_the_published(self):
        assert LoadSpectrum("x", ((1.0, 1.0),), published={6: 0.3}).equivalence(6.0) == 0.3


class TestFatigueCurve:
    @pytest.mark.parametrize(
        ("greatest", "exponent", "ratio"),
        [(2.6, 6, 3.237128e-3), (1.8, 6, 2.940119e-2), (4, 6, 4.0**-6), (2.5, 9, 2.5**-9)],
    )
    def test_limits_of_the_life_factor(self, greatest, exponent, ratio):
        curve = FatigueCurve(100.0, 1e7, exponent, greatest)
        at = greatest**-exponent * 1e7
        assert at / 1e7 == pytest.approx(ratio, rel=1e-6)
        assert curve.factor(0.999999 * at) == greatest
        assert curve.factor(1.000001 * at) < greatest
        assert curve.factor(1e7) == 1.0
        assert curve.factor(1e30) == 1.0

    def test_base_cycles(self):
        """Both readings: at 200 HB by the power law, a jump at 350 HB, and the upper limit."""
        assert contact_base_cycles(200.0) == 1e7
        assert contact_base_cycles(200.0 + 1e-9) == pytest.approx(9990638.49, rel=1e-8)
        assert contact_base_cycles(349.999, "source") == 1e7
        assert contact_base_cycles(350.0, "source") == pytest.approx(3.82723e7, rel=1e-6)
        cap = (12e7 / 30.0) ** (1.0 / 2.4)
        assert cap == pytest.approx(563.4538, rel=1e-7)
        for reading in ("gost", "source"):
            assert contact_base_cycles(563.4537, reading) < 12e7
            assert contact_base_cycles(563.4539, reading) == 12e7

    def test_beyond_the_base_cycles_by_gost(self):
        """Root of order 20 down to 0.75, off unless asked for."""
        found = pair("a-tempered", "fatigue.long_life=gost", "drive.life_hours=60000")
        cycles = 60.0 * 200.0 * 60000 * 0.25
        base = 30.0 * 285.5**2.4
        assert found.gears[0].contact.factor == near((base / cycles) ** 0.05)
        assert found.gears[0].contact.curve.factor(1e30) == 0.75
        assert found.gears[0].contact.curve.flat_from == near(base * 0.75**-20)
        assert pair("a-tempered", "drive.life_hours=60000").gears[0].contact.factor == 1.0

    @pytest.mark.parametrize("name", CASES)
    @pytest.mark.parametrize("reading", ["constant", "gost"])
    def test_nothing_grows_with_the_life(self, name, reading):
        hours = [10.0**i for i in range(1, 8)]
        gears = pair(name, f"fatigue.long_life={reading}").gears
        for endured in (end for gear in gears for end in (gear.contact, gear.bending)):
            found = [endured.allowable_at(each) for each in hours]
            assert all(later <= earlier for earlier, later in pairwise(found))
            assert found[-1] < found[0]


class TestLife:
    """Hours at which the stress is just allowed, found by bisection of the allowable stress."""

    @pytest.mark.parametrize(
        ("stress", "reading"), [(600, "constant"), (900, "constant"), (550, "gost"), (500, "gost")]
    )
    def test_of_a_stress_on_the_curve(self, validated, stress, reading):
        endured = pair("a-tempered", f"fatigue.long_life={reading}").gears[0].contact
        miss = lambda exponent: endured.allowable_at(10.0**exponent) - stress  # noqa: E731
        expected = 10.0 ** brentq(miss, 0.0, 8.0, xtol=1e-14)
        found = endured.life(stress)
        quantity, source = f"life at {stress} MPa", "bisection of the allowable stress"
        validated(quantity, found.hours, expected, 1e-9, source, "h", page=stress == 600)
        assert not found.bound

    def test_closed_form(self):
        """N_HG (s_Hlim/(S_H s))^6 over 60 n mu."""
        endured = pair("a-tempered").gears[0].contact
        factor = 600.0 * 1.1 / 641.0
        expected = 30.0 * 285.5**2.4 * factor**-6 / (60.0 * 200.0 * 0.25)
        assert endured.life(600.0).hours == near(expected)

    def test_always_endured(self):
        """At the limit itself and below; known up to the base cycles or the life asked for."""
        endured = pair("a-tempered").gears[0].contact
        limit = endured.curve.limit
        knee = 30.0 * 285.5**2.4 / (60.0 * 200.0 * 0.25)
        assert endured.life(limit).bound
        assert endured.life(limit).hours == near(knee)
        assert not endured.life(1.0001 * limit).bound
        longer = pair("a-tempered", "drive.life_hours=20000").gears[0].contact
        assert longer.life(500.0).hours == 20000.0

    def test_never_endured(self):
        endured = pair("a-tempered").gears[0].contact
        assert endured.life(2.6001 * endured.curve.limit).hours == 0.0
        assert endured.life(2.5999 * endured.curve.limit).hours > 0.0

    def test_margin_is_1_at_the_life(self):
        found = pair("a-tempered")
        hours = found.stresses[0][0].life.hours
        again = pair("a-tempered", f"drive.life_hours={hours!r}")
        assert again.stresses[0][0].margin == near(1.0)
        assert found.stresses[0][0].margin > 1.0


class TestTreatments:
    def test_table_2_3(self):
        """sigma_Hlim and sigma_Flim at a hardness of the band, typed from the source."""
        expected = {
            "normalised": (180, 430, 315),
            "quenched_and_tempered": (250, 570, 437.5),
            "through_hardened": (44, 848, 525),
            "surface_hardened": (48, 1016, 650),
            "carburised": (60, 1380, 775),
        }
        for name, (hardness, contact, bending) in expected.items():
            found = treatments()[name]
            assert (found.contact_limit(hardness), found.bending_limit(hardness)) == near((contact, bending))

    def test_nitrided(self):
        """12 HRC + 290 with the core's hardness is sigma_Flim; sigma_Hlim has to be given."""
        found = treatments()["nitrided"]
        assert math.isnan(found.contact_limit(60.0))
        assert found.bending_limit(30.0) == 650.0
        assert found.greatest_contact(50.0, math.nan) == 1750.0
        assert found.greatest_contact(60.0, math.nan) == 2000.0
        keys = ["pinion.treatment=nitrided", "pinion.core_hardness_HRC=30"]
        with pytest.raises(CaseError, match=r"contact_limit_MPa: .* 1050 MPa"):
            pair("b-carburised", *keys)
        gear = pair("b-carburised", *keys, "pinion.contact_limit_MPa=1050").gears[0]
        assert gear.contact.curve.limit == near(1050.0 / 1.2)
        assert gear.bending.curve.limit == near(650.0 / 1.7)

    def test_the_input_knows_them_all(self):
        schema = StrengthTables.model_json_schema()["$defs"]["StrengthGearTable"]["properties"]
        assert schema["treatment"]["enum"] == list(treatments())

    def test_exponents_safeties_and_limits(self):
        for name, found in treatments().items():
            soft = name in ("normalised", "quenched_and_tempered")
            homogeneous = soft or name == "through_hardened"
            assert found.bending_exponent == (6 if soft else 9)
            assert found.contact_safety == (1.1 if homogeneous else 1.2)
            assert found.contact_factor == (2.6 if homogeneous else 1.8)
            assert found.bending_factor == (4.0 if homogeneous else 2.5)

    def test_hardness_in_the_other_scale(self):
        """1 HRC for 10 HB."""
        rockwell = pair("b-carburised").gears[0]
        brinell = load_calculation(CASES["b-carburised"], StrengthTables).model_dump(exclude_unset=True)
        brinell["pinion"] = {"treatment": "carburised", "hardness_HB": 595}
        found = load_calculation(brinell, StrengthTables).strength().gears[0]
        assert found.contact == rockwell.contact
