"""Stresses below a line contact: against the integral of Flamant's solution, and their maxima."""

import math
from decimal import Decimal, getcontext

import numpy as np
import pytest
from scipy.integrate import quad

from wearsim.contact.line_stress import (
    axis_shear,
    axis_stresses,
    axis_von_mises,
    greatest_shear,
    greatest_von_mises,
)

getcontext().prec = 40


@pytest.mark.parametrize("depth", [0.05, 0.3, 0.78, 1.0, 2.5, 10.0])
def test_stresses_are_the_integral_of_line_loads(depth):
    """Half-plane under p = sqrt(1 - s^2): sigma = -(2 z/pi) int p (s^2 or z^2)/(s^2+z^2)^2 ds."""

    def stress(power):
        def share(s):
            return math.sqrt(1 - s * s) * s**power * depth ** (2 - power) / (s * s + depth**2) ** 2

        return -2.0 * depth / math.pi * quad(share, -1, 1, epsabs=1e-13, points=[0.0])[0]

    along, across = axis_stresses(depth)
    assert along == pytest.approx(stress(2), abs=1e-9)
    assert across == pytest.approx(stress(0), abs=1e-9)


@pytest.mark.parametrize("ratio", [0.0, 0.2, 0.3, 0.45])
def test_von_mises_is_that_of_three_principal_stresses(ratio):
    depth = np.linspace(0.0, 4.0, 41)
    x, z = axis_stresses(depth)
    y = ratio * (x + z)
    wanted = np.sqrt(0.5 * ((x - y) ** 2 + (y - z) ** 2 + (z - x) ** 2))
    np.testing.assert_allclose(axis_von_mises(depth, ratio), wanted, rtol=1e-12)
    assert axis_von_mises(0.0, ratio) == pytest.approx(1.0 - 2.0 * ratio, abs=1e-12)
    np.testing.assert_allclose(axis_shear(depth), 0.5 * (x - z), atol=1e-15)


def test_reference_maxima(validated):
    mises, shear = greatest_von_mises(0.3), greatest_shear()
    # The reference's depths are right to 2e-8 and 3e-9 only: see the next two tests.
    for name, found, expected, within in (
        ("maximum von Mises stress below a line contact, over p0", mises.stress, 0.5575162166, 5e-11),
        ("maximum shear stress below a line contact, over p0", shear.stress, 0.3002831060, 5e-11),
        ("depth of the von Mises stress, over a", mises.depth, 0.7042916644, 2.1e-8),
        ("depth of the shear, over a", shear.depth, 0.7861513807, 3.1e-9),
    ):
        how = {"absolute": True, "page": not name.startswith("depth")}
        validated(name, found, expected, within, "independent program", **how)


def von_mises_square(depth):
    """In forty digits, for nu = 0.3."""
    z = Decimal(depth)
    s = (1 + z * z).sqrt()
    x, across = -((1 + 2 * z * z) / s - 2 * z), -1 / s
    nu = Decimal("0.3")
    squares, product = 1 - nu + nu * nu, 1 + 2 * nu - 2 * nu * nu
    return squares * (x * x + across * across) - product * x * across


def test_depth_of_von_mises_is_higher_than_its_neighbours_and_the_references():
    depth = greatest_von_mises(0.3).depth
    top = von_mises_square(depth)
    assert top > von_mises_square(depth - 1e-12)
    assert top > von_mises_square(depth + 1e-12)
    assert top > von_mises_square("0.7042916644")
    assert f"{depth:.10f}" == "0.7042916846"


def test_depth_of_shear_solves_its_equation():
    """d/dz (z - z^2/s) = 0 is z^4 + z^2 = 1; the reference's depth misses it by 1e-8."""
    depth = greatest_shear().depth
    assert depth**4 + depth**2 == pytest.approx(1.0, abs=1e-15)
    assert 0.7861513807**4 + 0.7861513807**2 - 1.0 > 1e-8


def test_low_poissons_ratios_have_their_maximum_on_the_surface():
    for ratio in (0.0, 0.1, 0.19):
        found = greatest_von_mises(ratio)
        assert (found.depth, found.stress) == (0.0, 1.0 - 2.0 * ratio)
    assert greatest_von_mises(0.2).depth > 0.5
    nearly_rubber = greatest_von_mises(0.4999999)
    assert nearly_rubber.stress == pytest.approx(math.sqrt(3.0) * greatest_shear().stress, rel=1e-6)
    assert nearly_rubber.depth == pytest.approx(greatest_shear().depth, rel=1e-5)
