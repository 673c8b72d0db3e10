"""What crosses from a mechanism to the engine, and the flank of a prescribed contact.

Expected: columns handed over as they are given; curvature by second differences of parabolas;
a flank of constant curvature is a circle.
"""

import numpy as np
import pytest

from wearsim.contact.engagement import ContactKind, FlankContact
from wearsim.mechanisms.prescribed.contact import PrescribedMechanism, flank_from_curvature

ARC = np.array([0.0, 0.4, 1.0, 1.5, 2.3, 3.0, 3.6, 4.4, 5.0])


def prescribed(curvature: np.ndarray, kind: ContactKind = ContactKind.TRAVELLING) -> PrescribedMechanism:
    return PrescribedMechanism(
        kind=kind,
        arc_length=ARC,
        load_per_width=10.0 + ARC,
        slip=0.1 * (1.0 + ARC),
        sliding_speed=np.full(ARC.size, np.nan),
        flank_curvature=curvature,
        mate_radius=6.0,
        modulus=1e5,
    )


def engage(contact: FlankContact, depth: np.ndarray):
    worn = contact.profile.recede(depth)
    return contact.engage(np.array(worn.x), np.array(worn.y), depth)


@pytest.mark.parametrize("kind", list(ContactKind))
def test_prescribed_values_are_handed_over(kind: ContactKind) -> None:
    curvature = -0.05 + 0.01 * ARC
    found = engage(prescribed(curvature, kind).contact, np.zeros(ARC.size))
    assert found.kind is kind
    np.testing.assert_array_equal(found.arc_length, ARC)
    np.testing.assert_array_equal(found.load_per_width, 10.0 + ARC)
    np.testing.assert_array_equal(found.slip, 0.1 * (1.0 + ARC))
    np.testing.assert_array_equal(found.per_cycle, 1.0)
    assert np.isnan(found.sliding_speed).all()
    np.testing.assert_allclose(found.relative_curvature, 1.0 / 6.0 + curvature, rtol=1e-15)


def test_curvature_of_a_worn_prescribed_flank_is_exact_for_a_parabola() -> None:
    """w = 0.01 (s - 2)^2 adds w'' = 0.02 on any spacing; the end rows keep the given curvature."""
    found = engage(prescribed(np.full(ARC.size, -0.05)).contact, 0.01 * (ARC - 2.0) ** 2)
    expected = np.full(ARC.size, 1.0 / 6.0 - 0.05)
    expected[1:-1] += 0.02
    np.testing.assert_allclose(found.relative_curvature, expected, rtol=1e-12)


def test_uniform_wear_keeps_the_curvature() -> None:
    found = engage(prescribed(np.full(ARC.size, -0.05)).contact, np.full(ARC.size, 0.3))
    np.testing.assert_allclose(found.relative_curvature, 1.0 / 6.0 - 0.05, rtol=1e-13)


@pytest.mark.parametrize("radius", [12.0, -7.0])
def test_flank_of_constant_curvature_is_a_circle(radius: float) -> None:
    """It starts at (0, 0) along -x with its normal to +y, so the centre is (0, -R)."""
    profile = flank_from_curvature(ARC, np.full(ARC.size, 1.0 / radius))
    np.testing.assert_allclose(np.hypot(profile.x, profile.y + radius), abs(radius), rtol=1e-14)
    angle = ARC / radius
    np.testing.assert_allclose(profile.x, -radius * np.sin(angle), atol=1e-14)
    np.testing.assert_allclose(profile.y, radius * (np.cos(angle) - 1.0), atol=1e-14)
    np.testing.assert_allclose(profile.curvature[1:-1], 1.0 / radius, rtol=1e-12)
    assert profile.normal_y[0] > 0.9


def test_flank_of_linear_curvature_is_a_clothoid() -> None:
    """Direction pi + s^2/40 for a curvature s/20; the points by fine quadrature."""
    fine = np.linspace(0.0, 5.0, 200_001)
    direction = np.pi + fine**2 / 40.0
    middle = 0.5 * (direction[1:] + direction[:-1])
    step = fine[1]
    end = (step * np.cos(middle).sum(), step * np.sin(middle).sum())
    arc = np.linspace(0.0, 5.0, 401)
    profile = flank_from_curvature(arc, arc / 20.0)
    assert (profile.x[-1], profile.y[-1]) == pytest.approx(end, abs=5e-6)


def test_coarsened_contact_keeps_ends_and_values() -> None:
    contact = prescribed(np.full(ARC.size, -0.05)).contact
    coarse = contact.coarsened()
    assert coarse.profile.x.size == 5
    np.testing.assert_array_equal(coarse.arc_length, ARC[::2])
    np.testing.assert_array_equal(coarse.profile.x, contact.profile.x[::2])
    np.testing.assert_array_equal(coarse.columns, contact.columns[:, ::2])
    found = engage(coarse, np.zeros(5))
    np.testing.assert_array_equal(found.load_per_width, (10.0 + ARC)[::2])


def test_prescribed_contact_has_no_contact_ratio() -> None:
    mechanism = prescribed(np.zeros(ARC.size))
    assert np.isnan(mechanism.worn_contact_ratio(ARC, ARC))
