"""Benchmark B1: Hertz line contact, p0 = sqrt(q E*/(pi rho)), a = sqrt(4 q rho/(pi E*)).

Expected numbers: K. L. Johnson, Contact Mechanics, section 4.2, for E = 2.1e5, nu = 0.3,
q = 100 N/mm, a roller of 6.035 mm on three flanks (worked out outside this package).
"""

import math
from collections.abc import Callable

import pytest

from wearsim.contact.hertz import contact_modulus, half_width, peak_pressure

STEEL = contact_modulus((2.1e5, 2.1e5), (0.3, 0.3))

ROLLER = 6.035
PAIRS = [
    pytest.param(0.0, 780.1181, 0.081606, id="flat"),
    # ISO 606 flank, 0.12 d1 (z + 2) for 12B-1 and 25 teeth.
    pytest.param(1.0 / (0.12 * 12.07 * 27), 838.1537, 0.075955, id="convex-39.10"),
    pytest.param(-1.0 / (0.505 * 12.07), 77.6247, 0.820126, id="concave-6.09535"),
]


@pytest.mark.parametrize(("flank_curvature", "pressure", "width"), PAIRS)
def test_pressure_and_half_width(
    validated: Callable[..., None], flank_curvature: float, pressure: float, width: float
) -> None:
    relative = 1.0 / ROLLER + flank_curvature
    kind = "concave" if flank_curvature < 0 else "convex" if flank_curvature else "flat"
    source = "Johnson, Contact Mechanics, 4.2"
    found = float(peak_pressure(100.0, relative, STEEL)), float(half_width(100.0, relative, STEEL))
    validated(f"peak pressure on a {kind} flank", found[0], pressure, 1e-6, source, "MPa")
    shown = kind == "concave"
    validated(f"half-width on a {kind} flank", found[1], width, 1e-5, source, "mm", page=shown)


def test_contact_modulus_of_steel() -> None:
    assert pytest.approx(115384.6, rel=1e-6) == STEEL
    assert pytest.approx(2.1e5 / (2.0 * 0.91), rel=1e-15) == STEEL


def test_contact_modulus_of_a_rigid_mate() -> None:
    """E* tends to E/(1 - nu^2) of the soft body."""
    assert contact_modulus((2.8e3, 1e15), (0.35, 0.3)) == pytest.approx(2.8e3 / (1 - 0.35**2))


def test_exact_coefficients_of_steel(validated: Callable[..., None]) -> None:
    """0.4182051 in sigma = C sqrt(q E/rho), 1.522267 in a = C sqrt(q rho/E)."""
    load, radius, modulus = 250.0, 7.3, 2.1e5
    pressure = float(peak_pressure(load, 1.0 / radius, STEEL))
    width = float(half_width(load, 1.0 / radius, STEEL))
    exact, how = "sqrt(1/(2 pi (1 - nu^2))), sqrt(8 (1 - nu^2)/pi)", {"absolute": True}
    found = pressure / math.sqrt(load * modulus / radius)
    validated("C in sigma = C sqrt(q E/rho)", found, 0.4182051, 5e-8, exact, **how)
    found = width / math.sqrt(load * radius / modulus)
    validated("C in a = C sqrt(q rho/E)", found, 1.522267, 5e-7, exact, **how)


def test_load_is_the_integral_of_the_ellipse() -> None:
    """q = (pi/2) p0 a for any load and curvature."""
    for load, relative in ((10.0, 0.01), (300.0, 0.2), (5.0, 1.0)):
        p0 = float(peak_pressure(load, relative, STEEL))
        a = float(half_width(load, relative, STEEL))
        assert 0.5 * math.pi * p0 * a == pytest.approx(load, rel=1e-14)
