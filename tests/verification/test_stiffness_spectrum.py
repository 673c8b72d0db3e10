"""Spectrum of the contacts of gears with pitch errors against closed forms and a reference.

The reference numbers are those of an independent program for z = 20 and 30, 20 degrees, module
3 mm, one wave of error in a turn: pitch errors of 20 and 25 um, and of 0.30 and 0.40 mm.
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import fftconvolve
from scipy.special import jv

from wearsim.handbook.stiffness_spectrum.contact_number import (
    GearPair,
    Wheel,
    contact_number,
    contact_ratio,
    wheel_contacts,
)
from wearsim.handbook.stiffness_spectrum.contact_number_series import (
    bessel_coefficients,
    one_sided,
    series_coefficients,
)
from wearsim.handbook.stiffness_spectrum.model import combinations

RATIO = 1.6051760921390599
PERFECT = GearPair(Wheel(20, 0.0), Wheel(30, 0.0), RATIO)
FINE = GearPair(Wheel(20, 0.020 / 30.0), Wheel(30, 0.025 / 45.0), RATIO)
COARSE = GearPair(Wheel(20, 0.30 / 30.0), Wheel(30, 0.40 / 45.0), RATIO)
UNEVEN = GearPair(Wheel(20, 0.012, 2, 0.7), Wheel(30, 0.006, 3, 2.1), RATIO)
PAIRS = {"perfect": PERFECT, "fine": FINE, "coarse": COARSE, "uneven": UNEVEN}

MESH = (0, 60, 120, 180)
SIDES = (57, 63, 58, 62, 117, 123)
"""wz -+ w1, wz -+ w2 and 2 wz -+ w1; w1 is harmonic 3, w2 is 2."""


def magnitudes(pair, model, harmonics):
    return np.abs(contact_number(pair, model).coefficients(harmonics))


def sinc(x):
    return math.sin(x) / x


def test_contact_ratio():
    assert contact_ratio(20, 30, math.radians(20.0)) == pytest.approx(RATIO, abs=2e-15)


def test_contact_ratio_is_the_path_between_the_tip_circles_over_the_base_pitch(validated):
    """z = 20 and 30, m = 3 mm: tips at 33 and 48 mm, base circles and axes by hand."""
    cosine, sine = math.cos(math.radians(20.0)), math.sin(math.radians(20.0))
    path = math.sqrt(33.0**2 - (30.0 * cosine) ** 2) + math.sqrt(48.0**2 - (45.0 * cosine) ** 2)
    wanted = (path - 75.0 * sine) / (math.pi * 3.0 * cosine)
    quantity, found = "contact ratio, 20 and 30 teeth", contact_ratio(20, 30, math.radians(20.0))
    validated(quantity, found, wanted, 1e-14, "path between the tip circles by hand")


@pytest.mark.parametrize(
    ("model", "mean", "factor", "lines"),
    [
        ("double_sum", 2.8155282764171794, 3.0, (-0.9032737124956, -0.2930588027874, 0.1743176129178)),
        ("pairs", RATIO, 1.0, (-0.3010912375, -0.0976862676, 0.0581058710)),
    ],
)
def test_without_errors_it_is_the_closed_form(validated, model, mean, factor, lines):
    """S_l = 3 eps sinc(pi l eps) of the double sum, whose mean is 3 eps - 2; a third for pairs."""
    contacts = contact_number(PERFECT, model)
    found = contacts.coefficients([60, 120, 180])
    exact = [factor * RATIO * sinc(math.pi * l * RATIO) for l in (1, 2, 3)]
    quantity = f"mean number of contacts without errors, {model}"
    validated(quantity, contacts.mean, mean, 1e-13, "closed form", absolute=True)
    assert contacts.mean == pytest.approx(RATIO if factor == 1.0 else 3.0 * RATIO - 2.0, abs=1e-13)
    np.testing.assert_allclose(found.real, lines, atol=6e-14 if factor == 3.0 else 6e-11)
    np.testing.assert_allclose(found, exact, atol=1e-14)
    assert set(contacts.values) == ({1.0, 4.0} if model == "double_sum" else {1.0, 2.0})


@pytest.mark.parametrize(("angle", "counts"), [(20.0, (1, 4)), (14.5, (4, 9))])
def test_mean_of_the_double_sum_on_either_side_of_two(angle, counts):
    """The square of the number of teeth in mesh: n^2 + (2 n + 1)(eps - n) for n < eps < n + 1."""
    ratio = contact_ratio(40, 70, math.radians(angle))
    n = int(ratio)
    contacts = contact_number(GearPair(Wheel(40, 0.0), Wheel(70, 0.0), ratio), "double_sum")
    assert set(contacts.values) == set(counts)
    assert contacts.mean == pytest.approx(n**2 + (2 * n + 1) * (ratio - n), abs=1e-13)


@pytest.mark.parametrize(
    ("pair", "model", "harmonics", "reference"),
    [
        (FINE, "double_sum", MESH, (2.8136029088, 0.9038469249, 0.2914722135, 0.1758388196)),
        (
            FINE,
            "double_sum",
            SIDES,
            (0.0031624935, 0.0027358188, 0.0038985762, 0.0035820304, 0.0013900076, 0.0024311282),
        ),
        (COARSE, "double_sum", MESH, (2.7853335361, 0.9004941863, 0.2539286344, 0.1767585071)),
        (
            COARSE,
            "double_sum",
            SIDES,
            (0.0472307050, 0.0411257667, 0.0620872251, 0.0574238786, 0.0201144095, 0.0351540223),
        ),
        (COARSE, "double_sum", (55, 65, 61), (0.0007810777, 0.0063064157, 0.0039242604)),
        (
            COARSE,
            "double_sum",
            (3, 2, 118, 122, 6),
            (0.0096506828, 0.0078624761, 0.0289782866, 0.0414441158, 0.0020964217),
        ),
        (
            COARSE,
            "pairs",
            (0, 60, 57, 63, 58, 62),
            (1.5749813519, 0.3066440949, 0.0156401751, 0.0146913507, 0.0205507730, 0.0205006063),
        ),
    ],
)
def test_reference_lines(validated, pair, model, harmonics, reference):
    size = "fine" if pair is FINE else "coarse"
    lines = {MESH: "tooth lines", SIDES: "sidebands"}.get(harmonics, "lines")
    quantity, found = f"{lines} of {size} errors, {model}", magnitudes(pair, model, harmonics)
    how = {"absolute": True, "page": pair is COARSE and lines != "lines"}
    validated(quantity, found, reference, 6e-11, "independent program", **how)


def near(x, centre, half):
    """Whether angles are within a half width of a centre, on the circle."""
    return np.abs((x - centre + math.pi) % (2.0 * math.pi) - math.pi) < half


def counted(pair, model, x):
    """The definition itself, tooth by tooth, over angles of the common period."""
    turns = (pair.pinion_turns, pair.wheel_turns)
    wheels = (pair.pinion, pair.wheel)
    if model == "double_sum":
        both = [
            sum(
                near(turn * x, angle, math.pi * RATIO / wheel.teeth).astype(int)
                for angle in wheel.tooth_angles
            )
            for wheel, turn in zip(wheels, turns, strict=True)
        ]
        return both[0] * both[1]
    half, total = math.pi * RATIO / pair.meshes, np.zeros_like(x)
    for j in range(pair.meshes):
        on = np.ones_like(x, dtype=bool)
        for wheel, turn in zip(wheels, turns, strict=True):
            place = 2.0 * math.pi * j / wheel.teeth
            error = wheel.error_angle * math.sin(wheel.error_order * place + wheel.error_phase)
            on &= near(x, (place + error) / turn, half)
        total += on
    return total


@pytest.mark.parametrize("model", ["double_sum", "pairs"])
@pytest.mark.parametrize("name", ["coarse", "uneven"])
def test_edges_give_what_sampling_the_definition_gives(name, model):
    """Fourier sums over 2^15 midpoints; a jump between two of them is misplaced by half a step."""
    size = 2**15
    x = (np.arange(size) + 0.5) * 2.0 * math.pi / size
    values = counted(PAIRS[name], model, x)
    contacts = contact_number(PAIRS[name], model)
    harmonics = np.arange(130)
    sampled = np.fft.fft(values)[:130] / size * np.exp(-0.5j * 2.0 * math.pi / size * harmonics)
    np.testing.assert_allclose(contacts.coefficients(harmonics), sampled, atol=1e-3)
    assert np.mean(contacts.at(x) != values) == 0.0


@pytest.mark.parametrize(
    ("harmonics", "reference"),
    [
        ((19, 20, 21), (0.0623283165, 0.289167491, 0.0519977224)),
        ((38, 39, 40, 41, 42), (0.00179683122, 0.0234244287, 0.0826706528, 0.0462603749, 0.0115773832)),
    ],
)
def test_reference_coefficients_of_one_wheel(validated, harmonics, reference):
    found = bessel_coefficients(Wheel(20, 0.02), RATIO, 60)[np.array(harmonics) + 60]
    quantity, source = f"lines of one wheel from {harmonics[0]} on", "independent program"
    validated(quantity, np.abs(found), reference, 3e-9, source, page=len(harmonics) == 3)


@pytest.mark.parametrize(
    ("wheel", "rounding"),
    [
        (Wheel(20, 0.02), 1.2e-15),
        (Wheel(20, 0.0), 1.2e-15),
        (UNEVEN.pinion, 1.2e-15),
        (UNEVEN.wheel, 1.2e-15),
        (Wheel(31, 0.05, 15, 4.0), 4e-15),
    ],
)
def test_bessel_form_is_the_direct_sum(wheel, rounding):
    found = bessel_coefficients(wheel, RATIO, 200)
    n, duty = np.arange(-200, 201), RATIO / wheel.teeth
    direct = duty * np.sinc(n * duty) * np.exp(-1j * n[:, np.newaxis] * wheel.tooth_angles).sum(axis=1)
    np.testing.assert_allclose(found, direct, rtol=0.0, atol=rounding)


def test_leading_sidebands_are_bessel_functions_of_n_beta_with_a_sign_on_one_side():
    wheel = Wheel(20, 0.02)
    found = bessel_coefficients(wheel, RATIO, 30)
    for n, sign in ((19, 1.0), (21, -1.0)):
        pulse = RATIO * sinc(n * math.pi * RATIO / 20.0)
        assert found[n + 30] == pytest.approx(sign * pulse * jv(1, n * 0.02), rel=1e-12)


def test_one_wheel_of_the_exact_edges_is_the_closed_form():
    for wheel in (COARSE.pinion, UNEVEN.wheel):
        exact = wheel_contacts(wheel, RATIO).coefficients(np.arange(61))
        np.testing.assert_allclose(exact, bessel_coefficients(wheel, RATIO, 60)[60:], atol=1e-14)


LINES = (*MESH, *SIDES, 55, 65, 61, 3, 2, 118, 122, 6)


@pytest.mark.parametrize(("name", "bound"), [("fine", 8e-5), ("coarse", 1.5e-5), ("perfect", 5.1e-4)])
def test_convolution_of_the_closed_forms_comes_to_the_exact_lines(name, bound):
    """With 6000 harmonics of either wheel; the acceptance is 1e-3."""
    found = series_coefficients(PAIRS[name], LINES, 6000)
    exact = contact_number(PAIRS[name], "double_sum").coefficients(LINES)
    assert 0.1 * bound < np.abs(found - exact).max() <= bound


def test_convolution_converges_as_one_over_its_harmonics():
    exact = contact_number(PERFECT, "double_sum").coefficients([0])
    few, many = (abs(series_coefficients(PERFECT, [0], n) - exact)[0] for n in (6000, 24000))
    assert few / many == pytest.approx(4.0, rel=0.1)


def test_convolution_is_that_of_the_coefficients_on_the_common_grid():
    """The whole product by fast Fourier transforms."""
    limit = 121
    spread = np.zeros((2, 2 * 3 * limit + 1), dtype=complex)
    spread[0, ::3] = bessel_coefficients(UNEVEN.pinion, RATIO, limit)
    spread[1, limit : 5 * limit + 1 : 2] = bessel_coefficients(UNEVEN.wheel, RATIO, limit)
    whole = fftconvolve(spread[0], spread[1])
    harmonics = np.arange(-200, 201)
    wanted = whole[harmonics + 6 * limit]
    np.testing.assert_allclose(series_coefficients(UNEVEN, harmonics, limit), wanted, rtol=0.0, atol=1e-14)


def test_first_order_terms_and_how_small_the_printed_ones_are():
    """Rows of the source's table for a coarse error: wheel or pinion times the other's mean."""
    first, second = (
        RATIO * bessel_coefficients(wheel, RATIO, 60)[60:].real for wheel in (COARSE.pinion, COARSE.wheel)
    )
    printed = RATIO * bessel_coefficients(COARSE.pinion, RATIO, 60, "printed_argument")[60:].real
    assert first[20] == pytest.approx(-0.4784834806, abs=6e-11)
    assert second[30] == pytest.approx(-0.4747504884, abs=6e-11)
    assert printed[20] == pytest.approx(-0.4832923734, abs=6e-11)
    assert first[19] == pytest.approx(-5.071e-2, rel=1e-4)
    assert printed[19] == pytest.approx(-2.681e-3, rel=1e-4)
    assert first[19] / printed[19] == pytest.approx(19.0, rel=0.01)
    assert printed[19] == pytest.approx(RATIO**2 * sinc(19 * math.pi * RATIO / 20) * jv(1, 0.01))


def test_printed_table_without_differences_is_7_to_41_percent_wrong():
    found = series_coefficients(PERFECT, MESH, 600, "printed").real
    np.testing.assert_allclose(found, (2.576590, -0.966609, -0.222951, 0.245365), atol=6e-7)
    exact = contact_number(PERFECT, "double_sum").coefficients(MESH).real
    assert np.abs(found / exact - 1.0).min() > 0.065
    assert np.abs(found / exact - 1.0).max() == pytest.approx(0.41, abs=0.005)


def test_printed_table_is_its_rows():
    """The sums of the source for tooth lines and sidebands, typed out, with its J_k(k beta)."""
    beta, gamma = COARSE.pinion.error_angle, COARSE.wheel.error_angle

    def a(n, z):
        return RATIO * sinc(n * math.pi * RATIO / z)

    rows = {
        60: RATIO * (a(20, 20) * jv(0, beta) + a(30, 30) * jv(0, gamma)),
        120: RATIO * (a(40, 20) * jv(0, beta) + a(60, 30) * jv(0, gamma))
        + a(20, 20) * a(30, 30) * jv(0, beta) * jv(0, gamma),
        57: RATIO * a(19, 20) * jv(1, beta),
        63: -RATIO * a(21, 20) * jv(1, beta),
        123: -RATIO * a(41, 20) * jv(1, beta) - a(21, 20) * a(30, 30) * jv(1, beta) * jv(0, gamma),
    }
    found = series_coefficients(COARSE, list(rows), 600, "printed").real
    np.testing.assert_allclose(found, list(rows.values()), atol=1e-7)
    assert series_coefficients(COARSE, [3], 600, "printed") == pytest.approx(0.0, abs=1e-7)


def test_each_slip_of_the_source_can_be_taken_alone():
    lines = (60, 57, 123)
    good = series_coefficients(COARSE, lines, 600)
    argument, sums = (
        series_coefficients(COARSE, lines, 600, f"printed_{slip}") for slip in ("argument", "sums")
    )
    both = series_coefficients(COARSE, lines, 600, "printed")
    assert abs(argument[1] / good[1]) < 0.06
    assert np.all(np.abs(sums / good - 1.0) > 0.03)
    assert np.all(np.abs(both / argument - 1.0) > 0.03)
    for formula in ("corrected", "printed_argument", "printed_sums"):
        np.testing.assert_array_equal(one_sided(good, formula), 2.0 * np.abs(good))
    for formula in ("printed", "printed_amplitude"):
        np.testing.assert_array_equal(one_sided(good, formula), np.abs(good))
    plain = series_coefficients(COARSE, lines, 600, "printed_amplitude")
    np.testing.assert_array_equal(plain, good)


@pytest.mark.parametrize("model", ["double_sum", "pairs"])
@pytest.mark.parametrize(
    ("pair", "step"),
    [
        (PERFECT, 60),
        (replace(COARSE, wheel=Wheel(30, 0.0)), 3),
        (replace(COARSE, pinion=Wheel(20, 0.0)), 2),
        (GearPair(Wheel(20, 0.01, 10, 1.0), Wheel(30, 0.0), RATIO), 30),
        (GearPair(Wheel(20, 0.01, 2), Wheel(30, 0.01, 2), RATIO), 2),
    ],
)
def test_no_lines_off_the_lattice(pair, step, model):
    """Off the sums of tooth lines and turns of the errors all is zero; on it not."""
    harmonics = np.arange(1, 200)
    on = harmonics % step == 0
    found = magnitudes(pair, model, harmonics)
    assert found[~on].max() < 1e-14
    lines = [h for h in combinations(pair, 3, 1) if h < 200]
    assert found[np.array(lines) - 1].min() > 1e-4
    assert all(h % step == 0 for h in combinations(pair, 3, 3))


@pytest.mark.parametrize("model", ["double_sum", "pairs"])
def test_lines_of_vanishing_errors_are_those_without(model):
    small = GearPair(Wheel(20, 1e-9), Wheel(30, 2e-9), RATIO)
    found, bare = magnitudes(small, model, LINES), magnitudes(PERFECT, model, LINES)
    np.testing.assert_allclose(found, bare, rtol=0.0, atol=2e-8)
    half = GearPair(Wheel(20, 0.5e-9), Wheel(30, 1e-9), RATIO)
    sides = magnitudes(small, model, SIDES) / magnitudes(half, model, SIDES)
    np.testing.assert_allclose(sides, 2.0, rtol=1e-5)


@pytest.mark.parametrize("model", ["double_sum", "pairs"])
def test_parseval(model):
    """Variance = 2 sum |S_h|^2; jumps leave a rest that halves with twice the lines."""
    contacts = contact_number(COARSE, model)
    powers = 2.0 * np.abs(contacts.coefficients(np.arange(1, 6001))) ** 2
    x = (np.arange(2**16) + 0.5) * 2.0 * math.pi / 2**16
    assert contacts.variance == pytest.approx(np.var(contacts.at(x)), rel=2e-3)
    rests = contacts.variance - np.array([powers[:3000].sum(), powers.sum()])
    assert 0.0 < rests[1] < 0.01 * contacts.variance
    assert rests[0] / rests[1] == pytest.approx(2.0, rel=0.1)


@pytest.mark.parametrize("model", ["double_sum", "pairs"])
def test_the_first_tooth_is_anyones(model):
    """Numbering the teeth from the s-th on turns both phases and leaves all magnitudes."""
    s = 7
    rotated = replace(
        UNEVEN,
        pinion=replace(UNEVEN.pinion, error_phase=0.7 + 2.0 * math.pi * 2 * s / 20),
        wheel=replace(UNEVEN.wheel, error_phase=2.1 + 2.0 * math.pi * 3 * s / 30),
    )
    one, other = (magnitudes(pair, model, np.arange(130)) for pair in (UNEVEN, rotated))
    np.testing.assert_allclose(one, other, atol=1e-13)


@pytest.mark.parametrize("model", ["double_sum", "pairs"])
def test_pinion_and_wheel_are_alike(model):
    other = GearPair(UNEVEN.wheel, UNEVEN.pinion, RATIO)
    harmonics = np.arange(130)
    one, two = (magnitudes(pair, model, harmonics) for pair in (UNEVEN, other))
    np.testing.assert_allclose(one, two, atol=1e-13)
