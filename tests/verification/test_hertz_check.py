"""Contact at the pitch point: the printed formulas, the inputs, the lost cell (source 000, second paper)."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from wearsim.contact import hertz
from wearsim.errors import GeometryError
from wearsim.handbook.hertz_check.hertz_fem import _pressure
from wearsim.handbook.hertz_check.model import difference, stresses_at, whole_stresses
from wearsim.handbook.hertz_check.pitch_point_contact import PitchPointContact, share_for, single_changes
from wearsim.handbook.hertz_check.published import load_hertz_check

CASE = Path(__file__).parents[2] / "cases" / "sizing" / "hertz-check-36-54.toml"
BASE = PitchPointContact(240e3, 1.5, 76.0, 108.0, math.radians(20.0))
PRINTED = replace(BASE, torque=600e3, gear_ratio=5.0)


@pytest.fixture(scope="module")
def check():
    return load_hertz_check(CASE)[0].check()


LITERAL = [
    (600, 5, 76, 609.021845),
    (600, 1.5, 76, 717.739128),
    (600, 5, 82, 586.317343),
    (600, 1.5, 82, 690.981616),
    (240, 5, 76, 385.179235),
    (240, 1.5, 76, 453.938082),
    (240, 5, 82, 370.819647),
    (240, 1.5, 82, 437.015145),
]


def test_literal_inputs(validated, check):
    source = "formula of the source by an independent program"
    for one, (torque, ratio, width, stress) in zip(check.literal, LITERAL, strict=True):
        assert (one.torque / 1e3, one.gear_ratio, one.face_width) == (torque, ratio, width)
        quantity = f"stress by the printed formula, {torque} N m, u = {ratio:g}, b = {width} mm"
        how = {"absolute": True, "page": (ratio, width) == (1.5, 76)}
        validated(quantity, one.printed_stress, stress, 5e-7, source, "MPa", **how)
    nearest = min(check.literal, key=lambda one: abs(one.printed_stress - 464.0))
    assert nearest == check.contact == BASE
    assert 100.0 * (nearest.printed_stress / 464.0 - 1.0) == pytest.approx(-2.17, abs=0.005)


def test_loads_and_radii():
    assert PRINTED.normal_force == pytest.approx(11824.197472, abs=5e-7)
    assert PRINTED.load_per_width == pytest.approx(155.581546, abs=5e-7)
    assert PRINTED.reduced_radius == pytest.approx(15.390906, abs=5e-7)
    assert BASE.normal_force == pytest.approx(4729.678989, abs=5e-7)
    assert BASE.load_per_width == pytest.approx(62.232618, abs=5e-7)
    assert BASE.reduced_radius == pytest.approx(11.081453, abs=5e-7)
    sagging = 2.0 / (108.0 * math.sin(math.radians(20.0))) * (1.5 + 1.0) / 1.5
    assert 1.0 / BASE.reduced_radius == pytest.approx(sagging, rel=1e-14)
    assert replace(BASE, youngs_modulus=(1e5, 3e5)).reduced_modulus == 1.5e5


def test_exact_coefficient_is_that_of_hertz(validated):
    source, how = "independent program", {"absolute": True}
    found = BASE.exact_coefficient
    validated("exact coefficient", found, 0.4182051433, 5e-11, source, page=False, **how)
    quantity = "stress at the pitch point by the exact coefficient"
    validated(quantity, BASE.peak_pressure, 454.160863, 5e-7, source, "MPa", **how)
    for contact in (BASE, PRINTED, replace(BASE, youngs_modulus=(2e5, 1.1e5), poissons_ratio=0.25)):
        by_coefficient = contact.exact_coefficient * math.sqrt(
            contact.load_per_width * contact.reduced_modulus / contact.reduced_radius
        )
        modulus = hertz.contact_modulus(contact.youngs_modulus, (contact.poissons_ratio,) * 2)
        curvature = sum(1.0 / radius for radius in contact.flank_radii)
        by_hertz = hertz.peak_pressure(contact.load_per_width, curvature, modulus)
        assert by_coefficient == pytest.approx(float(by_hertz), rel=1e-14)
        assert contact.peak_pressure == pytest.approx(float(by_hertz), rel=1e-14)


def test_half_width(validated):
    found, source = BASE.half_width, "independent program"
    validated("half-width at the pitch point", found, 0.0872345429, 5e-11, source, "mm", absolute=True)
    by_load = 2.0 * BASE.load_per_width / (math.pi * BASE.half_width)
    assert by_load == pytest.approx(BASE.peak_pressure, rel=1e-13)


def test_contact_ratio_shares_the_load(validated, check):
    found, source = check.contact_ratio, "independent program"
    validated("contact ratio, 36 and 54 teeth", found, 1.7300954414, 5e-11, source, absolute=True)
    shared = PRINTED.printed_stress / math.sqrt(check.contact_ratio)
    assert shared == pytest.approx(463.018, abs=5e-4)
    assert PRINTED.printed_stress / math.sqrt(1.72) == pytest.approx(464.375, abs=5e-4)


def test_missing_factor(validated):
    changes = {change.key: change for change in single_changes(BASE, 464.0, 0.5)}
    factor = changes["load_factor"]
    quantity, source = "load factor that gives the published 464 MPa", "independent program"
    validated(quantity, factor.needed, 1.04482, 5e-6, source, absolute=True)
    assert factor.ends == pytest.approx((1.04257, 1.04708), abs=5e-6)
    assert changes["face_width_mm"].needed == pytest.approx(72.740, abs=5e-4)
    assert changes["torque_N_m"].needed == pytest.approx(250.757, abs=6e-4)
    assert changes["working_pressure_angle_deg"].needed == pytest.approx(19.0, abs=0.02)
    assert changes["youngs_modulus_MPa"].needed == pytest.approx(2.1e5 * factor.needed, rel=1e-12)
    assert changes["pinion_pitch_diameter_mm"].needed == pytest.approx(
        108.0 / math.sqrt(factor.needed), rel=1e-12
    )
    assert 1.0 + 1.0 / changes["gear_ratio"].needed == pytest.approx(
        (1.0 + 1.0 / 1.5) * factor.needed, rel=1e-12
    )


ANGLE = math.radians(20.0)

SINGLE = [
    (replace(BASE, load_factor=1.045), 464.039),
    (replace(BASE, pressure_angle=math.radians(19.0)), 463.831),
    (replace(BASE, torque=250e3), 463.299),
    (replace(BASE, youngs_modulus=(2.2e5, 2.2e5)), 464.620),
    (replace(BASE, load_factor=1.0 / math.cos(ANGLE), youngs_modulus=(2.06e5, 2.06e5)), 463.797),
    (replace(PRINTED, gear_ratio=1.5, load_factor=0.418), 464.039),
]


@pytest.mark.parametrize(("contact", "stress"), SINGLE)
def test_changes_that_give_464_or_nearly(contact, stress):
    assert contact.printed_stress == pytest.approx(stress, abs=5.1e-4)


def test_exact_stress_with_250():
    assert replace(BASE, torque=250e3).peak_pressure == pytest.approx(463.526, abs=5e-4)


def test_shares_of_the_printed_load():
    assert 1.0 / share_for(PRINTED, 464.0) == pytest.approx(1.7228, abs=5e-5)
    assert 1.0 / share_for(PRINTED, 464.5) == pytest.approx(1.7191, abs=5e-5)
    assert 1.0 / share_for(PRINTED, 463.5) == pytest.approx(1.7265, abs=5e-5)
    assert share_for(replace(PRINTED, gear_ratio=1.5), 464.0) == pytest.approx(0.41793, abs=5e-6)


@pytest.mark.parametrize("change", single_changes(BASE, 464.0, 0.5), ids=lambda change: change.key)
def test_every_change_gives_464_when_put_in(change):
    """Through the input file: the needed value of a key alone."""
    settings = [f"contact.{change.key}={change.needed!r}"]
    again = load_hertz_check(CASE, settings)[0].check().contact
    assert again.printed_stress == pytest.approx(464.0, abs=1e-9)


def test_no_value_of_a_key_that_cannot():
    """However small the wheel's curvature, the pinion's is left."""
    changes = {change.key: change for change in single_changes(BASE, 300.0, 0.5)}
    assert math.isnan(changes["gear_ratio"].needed)
    assert changes["torque_N_m"].needed == pytest.approx(240.0 * (300.0 / 453.938082) ** 2, rel=1e-8)


def test_completed_table(validated, check):
    columns = check.comparison.columns
    assert check.comparison.references == ("larger",)
    assert [columns[name].hertz for name in columns] == pytest.approx([464.0, 185.6, 259.84])
    assert [columns[name].finite_elements for name in columns] == [418.0, 216.0, 228.0]
    assert columns["depth"].candidates == (228,)
    larger = [columns[name].differences["larger"] for name in columns]
    quantity, source = ("published differences of Hertz and FE, completed", "by hand, over the larger")
    expected = [9.9138, 14.0741, 12.2537]
    validated(quantity, larger, expected, 5e-5, source, "%", absolute=True)
    assert [round(value, 1) for value in larger] == [9.9, 14.1, 12.3]
    computed = [columns[name].computed for name in columns]
    assert computed == pytest.approx([453.938, 181.575, 254.205], abs=6e-4)
    off = [columns[name].computed_difference for name in columns]
    assert off == pytest.approx([7.917, 15.937, 10.309], abs=5e-4)


def test_lost_cell():
    assert stresses_at(259.84, 12.3, "larger") == pytest.approx((227.880, 296.283), abs=5e-4)
    found = [difference(259.84, value, "larger") for value in (227, 228, 229, 296, 297)]
    assert found == pytest.approx([12.64, 12.2537, 11.87, 12.22, 12.51], abs=5e-3)
    brute = [n for n in range(1, 2000) if round(difference(259.84, n, "larger"), 1) == 12.3]
    assert whole_stresses(259.84, 12.3, "larger") == brute == [228]
    assert whole_stresses(259.84, 12.3, "finite_elements") == []
    assert pytest.approx(0.5455, abs=5e-5) == 228 / 418
    assert pytest.approx(185.6) == 0.4 * 464


@pytest.mark.parametrize("reference", ["larger", "hertz", "finite_elements"])
@pytest.mark.parametrize(("stress", "percent"), [(259.84, 12.3), (80.0, 1.2), (950.0, 40.0)])
def test_whole_stresses_are_all_there_are(reference, stress, percent):
    every = np.arange(1, 4000)
    hits = [int(n) for n in every if abs(difference(stress, float(n), reference) - percent) < 0.05 + 1e-9]
    assert whole_stresses(stress, percent, reference) == hits
    for end in stresses_at(stress, percent, reference):
        assert difference(stress, end, reference) == pytest.approx(percent, rel=1e-12)


def test_teeth_that_cannot_run():
    tables, _ = load_hertz_check(CASE, ["teeth.pinion_teeth=5"])
    with pytest.raises(GeometryError, match="base circle"):
        tables.check()


def test_contact_conditions_give_hertz_pressure_on_half_planes(validated):
    """The solver of ``--fem`` on a compliance in closed form: strips of pressure on half-planes."""
    cells, width, modulus, radius, load = 120, 1.5, 1.15e5, 11.0, 60.0
    a = math.sqrt(4.0 * load * radius / (math.pi * modulus))
    peak = math.sqrt(load * modulus / (math.pi * radius))
    step = width * a / cells
    middle = (np.arange(cells) + 0.5) * step

    def sunk(x):
        """Sinking at x under unit pressure on a strip around 0, over that at 100 a."""
        ends = [x + 0.5 * step, x - 0.5 * step]
        primitive = [end * (np.log(np.abs(end) / (100.0 * a)) - 1.0) for end in ends]
        return -2.0 / (math.pi * modulus) * (primitive[0] - primitive[1])

    between = middle[:, None] - middle[None, :], middle[:, None] + middle[None, :]
    compliance = step * (sunk(between[0]) + sunk(between[1]))
    weights = np.full(cells, step)
    pressure = _pressure(compliance, weights * middle**2 / (2.0 * radius), weights, 0.5 * load)
    assert weights @ pressure == pytest.approx(0.5 * load, rel=1e-10)
    wanted = peak * np.sqrt(np.maximum(1.0 - (middle / a) ** 2, 0.0))
    inside = middle < 0.95 * a
    quantity, source = "pressures by the contact solver of --fem on half-planes", "Hertz"
    validated(quantity, pressure[inside], wanted[inside], 0.01, source, "MPa")
    assert np.all(pressure[middle > a + step] == 0.0)
