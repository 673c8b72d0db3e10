"""Wear laws as the engine takes them; expected values are the formulas written out here."""

import inspect
import math

import numpy as np
import pytest

from wearsim.case.keys.wear_tables import WearTable
from wearsim.catalogue.catalogues import wear_laws
from wearsim.contact.engagement import ContactKind
from wearsim.kernels.hertz_wear import wear_depth
from wearsim.wear.law import LAWS as CONSTRUCTORS
from wearsim.wear.law import WearLaw, archard, drozdov, mean_pressure_factor, power

MODULUS = 115384.6153846154


def depth(law: WearLaw, kind: ContactKind, load: float, slip: float, speed: float, relative: float) -> float:
    """Depth of one cycle at one point."""
    step = np.empty(1)
    arrays = [np.array([value]) for value in (load, slip, speed, relative)]
    wear_depth(*arrays, MODULUS, law.numbers(kind), step)
    return float(step[0])


LAWS = [
    archard(3e-9),
    power(1e-9, 0.7),
    power(1e-11, 1.5),
    power(1e-12, 2.0),
    power(1e-15, 3.0),
    drozdov(1e-6, 1.2, 5500.0, 1000.0, -0.3),
    drozdov(1e-6, 2.0, 5500.0, 1000.0, 0.8),
]


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("kind", [ContactKind.TRAVELLING, ContactKind.LOCAL])
def test_depth_is_the_formula(law: WearLaw, kind: ContactKind) -> None:
    """K sigma^m v^n times c_m 2a lambda, or times s."""
    q, slip, speed, relative = 120.0, 0.4, 650.0, 0.11
    sigma = math.sqrt(q * MODULUS * relative / math.pi)
    half_width = math.sqrt(4.0 * q / (math.pi * MODULUS * relative))
    m, n = law.pressure_exponent, law.speed_exponent
    path = mean_pressure_factor(m) * 2.0 * half_width * slip if kind is ContactKind.TRAVELLING else slip
    step = depth(law, kind, q, slip, speed, relative)
    assert step == pytest.approx(law.coefficient * sigma**m * speed**n * path, rel=1e-13)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("kind", [ContactKind.TRAVELLING, ContactKind.LOCAL])
def test_nothing_wears_without_load_or_slip(law: WearLaw, kind: ContactKind) -> None:
    assert depth(law, kind, 0.0, 0.4, 650.0, 0.11) == 0.0
    assert depth(law, kind, 120.0, 0.0, 650.0, 0.11) == 0.0


@pytest.mark.parametrize("law", LAWS[-2:])
def test_nothing_wears_at_rest_even_with_a_falling_speed_law(law: WearLaw) -> None:
    assert depth(law, ContactKind.TRAVELLING, 120.0, 0.4, 0.0, 0.11) == 0.0


def test_drozdov_refers_pressure_to_hardness_and_speed_to_its_reference() -> None:
    law = drozdov(1e-6, 1.7, 4000.0, 250.0, 0.6)
    sigma = math.sqrt(120.0 * MODULUS * 0.11 / math.pi)
    step = depth(law, ContactKind.LOCAL, 120.0, 2.0, 900.0, 0.11)
    expected = 1e-6 * (sigma / 4000.0) ** 1.7 * (900.0 / 250.0) ** 0.6 * 2.0
    assert step == pytest.approx(expected, rel=1e-13)


def test_archard_is_the_power_law_with_exponent_one() -> None:
    assert archard(2e-9) == power(2e-9, 1.0)


@pytest.mark.parametrize(
    ("kind", "slip_exponent", "expected"),
    [
        (ContactKind.TRAVELLING, 1.0, lambda m: 0.5 * (m + 1.0)),
        (ContactKind.TRAVELLING, 0.0, lambda m: 0.5 * (m - 1.0)),
        (ContactKind.LOCAL, 0.0, lambda m: 0.5 * m),
    ],
    ids=["strand", "slip-ratio", "sliding-distance"],
)
@pytest.mark.parametrize("m", [1.0, 1.5, 2.0])
def test_diffusion_exponent(kind: ContactKind, slip_exponent: float, expected, m: float) -> None:
    """physics.md 3: (m+1)/2 on the strand, m/2 and (m-1)/2 with a prescribed slip."""
    assert power(1e-9, m).diffusion(kind, slip_exponent) == pytest.approx(expected(m), rel=1e-15)


@pytest.mark.parametrize("m", [1.0, 1.5, 2.0])
@pytest.mark.parametrize("kind", [ContactKind.TRAVELLING, ContactKind.LOCAL])
def test_diffusion_exponent_is_the_slope_of_the_depth(kind: ContactKind, m: float) -> None:
    """d(ln depth)/d(ln 1/rho_H) by a central difference at given slip."""
    step = 1e-5
    low, high = (
        depth(power(1e-9, m), kind, 120.0, 0.4, 1.0, 0.11 * (1.0 + sign * step)) for sign in (-1.0, 1.0)
    )
    slope = (math.log(high) - math.log(low)) / (2.0 * step)
    assert slope == pytest.approx(power(1e-9, m).diffusion(kind, 0.0), abs=1e-8)


@pytest.mark.parametrize("exponent", [0.1, 1.0, 2.0, 4.0])
def test_mean_pressure_factor_falls_with_the_exponent(exponent: float) -> None:
    assert 1.0 > mean_pressure_factor(exponent) > mean_pressure_factor(exponent + 0.5) > 0.0


def test_every_law_of_the_registry_has_a_constructor_that_takes_its_keys_and_they_are_input() -> None:
    registry = {name: entry.keys for name, entry in wear_laws().items() if entry.kind == "law"}
    assert registry.keys() == CONSTRUCTORS.keys()
    for name, keys in registry.items():
        arguments = list(inspect.signature(CONSTRUCTORS[name]).parameters)
        assert len(arguments) == len(keys), name
        assert all(map(str.startswith, keys[1:], arguments[1:])), name
        assert set(keys) <= WearTable.model_fields.keys()
