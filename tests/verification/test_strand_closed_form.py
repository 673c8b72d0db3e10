"""Contact of any flank with a straight strand, against the evolute flank's closed form
and against plain rigid-body kinematics.

Evolute flank (omega = 1): l = sqrt(x^2 + h^2), v_s = l + r, v_t = rho_t (1 + R h/l^2),
rho_t = r + l^3/(R h + l^2), q = F_t share/(b cos alpha), cos alpha = x/l.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from wearsim.contact.engagement import Engagement
from wearsim.geometry.profile_points import Profile
from wearsim.mechanisms.strand.contact import StrandMechanism, load_share

MechanismMaker = Callable[..., StrandMechanism]

R, r, h = 25.4 * 20 / (2.0 * np.pi), 7.94, 5.5
OMEGA = 2.0 * np.pi * 100.0 / 60.0
PULL = 5000.0 / 17.0


def engagement(mechanism: StrandMechanism) -> Engagement:
    profile = mechanism.profile
    return mechanism.contact.engage(np.array(profile.x), np.array(profile.y), np.zeros(profile.x.size))


def compared(mechanism: StrandMechanism, nodes: int) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Found and expected values at inner nodes that carry the whole pull."""
    x = np.linspace(4.0, 30.67, nodes)
    inner = (x > 5.5) & (x < 29.0)
    l = np.sqrt(x**2 + h**2)
    rho = r + l**3 / (R * h + l**2)
    found = engagement(mechanism)
    pairs = {
        "load": (found.load_per_width, PULL * l / x),
        "slip": (found.slip, (l + r) / (rho * (1.0 + R * h / l**2))),
        "sliding speed": (found.sliding_speed, OMEGA * (l + r)),
        "relative curvature": (found.relative_curvature, 1.0 / r - 1.0 / rho),
    }
    return {
        name: (np.asarray(value)[inner], np.asarray(expected)[inner])
        for name, (value, expected) in pairs.items()
    }


def errors(mechanism: StrandMechanism, nodes: int) -> dict[str, float]:
    """Largest relative error of each."""
    return {
        name: float(np.abs(value / expected - 1.0).max())
        for name, (value, expected) in compared(mechanism, nodes).items()
    }


UNITS = {"load": "N/mm", "slip": "", "sliding speed": "mm/s", "relative curvature": "1/mm"}


def test_evolute_flank_converges_to_the_closed_form(
    validated: Callable[..., None], reference_mechanism: MechanismMaker
) -> None:
    grids = (101, 201, 401)
    for name, (value, expected) in compared(reference_mechanism(nodes=401), 401).items():
        quantity = f"{name} by the general flank method, evolute flank"
        shown = name != "sliding speed"
        validated(quantity, value, expected, 4e-5, "its closed form", UNITS[name], page=shown)
    found = [errors(reference_mechanism(nodes=nodes), nodes) for nodes in grids]
    for name in found[0]:
        coarse, middle, fine = (error[name] for error in found)
        assert np.log2(coarse / middle) >= 1.9, name
        assert np.log2(middle / fine) >= 1.9, name


def test_slip_ratio_is_sliding_speed_over_contact_speed_on_any_flank(
    validated: Callable[..., None], reference_mechanism: MechanismMaker
) -> None:
    """A circular flank of radius 20 mm: the ratio by differences of arc length over turn."""
    mechanism = reference_mechanism(nodes=2001)
    centre, radius = np.array([11.1, 78.4]), 20.0
    angle = np.linspace(np.pi + 0.22, np.pi - 0.2, 2001)
    flank = Profile(centre[0] + radius * np.cos(angle), centre[1] + radius * np.sin(angle))
    found = mechanism.contact.engage(np.array(flank.x), np.array(flank.y), np.zeros(flank.x.size))
    K = np.column_stack([flank.x, flank.y])
    n = (centre - K) / radius
    C = K + r * n
    before_pitch_point = np.sqrt((C**2).sum(axis=1) - (R - h) ** 2)
    psi = np.arctan2(R - h, -before_pitch_point) - np.arctan2(C[:, 1], C[:, 0])
    contact_speed = radius * np.abs(np.gradient(angle, psi))
    # Fixed frame: the roller moves with the chain, the sprocket turns clockwise with omega = 1.
    cos, sin = np.cos(psi), np.sin(psi)
    nx, ny = n[:, 0] * cos - n[:, 1] * sin, n[:, 0] * sin + n[:, 1] * cos
    Kx, Ky = -before_pitch_point - r * nx, (R - h) - r * ny
    chain_speed = (Ky * nx - Kx * ny) / nx
    sliding = np.abs((chain_speed - Ky) * -ny + Kx * nx)
    loaded = found.load_per_width > 0.0
    loaded[:2] = loaded[-2:] = False
    assert loaded.sum() > 500
    expected, source = (sliding / contact_speed)[loaded], "rigid-body kinematics by differences"
    validated("slip ratio on a circular flank", found.slip[loaded], expected, 1e-5, source)
    np.testing.assert_allclose(found.sliding_speed[loaded], OMEGA * sliding[loaded], rtol=1e-6)
    share = load_share(before_pitch_point, 4.0, 30.67, 25.4)
    np.testing.assert_allclose(
        found.load_per_width[loaded], (PULL * share / nx)[loaded], rtol=1e-5, atol=1e-6
    )


def test_shares_of_successive_rollers_sum_to_one() -> None:
    x = np.linspace(4.0, 4.0 + 25.4, 1001)
    total = load_share(x, 4.0, 30.67, 25.4) + load_share(x + 25.4, 4.0, 30.67, 25.4)
    np.testing.assert_allclose(total, 1.0, rtol=0.0, atol=1e-12)


@pytest.mark.parametrize("x", [3.9, 4.0, 30.67, 31.0])
def test_share_vanishes_at_and_outside_the_ends(x: float) -> None:
    assert load_share(np.array([x]), 4.0, 30.67, 25.4)[0] == pytest.approx(0.0, abs=1e-12)


def torque_error(mechanism: StrandMechanism, ramp: int) -> float:
    """Error of the moment of successive rollers; a pitch is 20 ramps of so many steps."""
    found, profile = engagement(mechanism), mechanism.profile
    arm = np.abs(profile.x * profile.normal_y - profile.y * profile.normal_x)
    moment = found.load_per_width * arm / (PULL * R)
    moment[: ramp + 1] += moment[20 * ramp :]
    return float(np.abs(moment[: 20 * ramp] - 1.0).max())


def test_torque_balance_on_the_unworn_flank(reference_mechanism: MechanismMaker) -> None:
    """The moments of the contact forces of successive rollers sum to pull times R."""
    coarse, middle, fine = (
        torque_error(reference_mechanism(nodes=21 * ramp + 1), ramp) for ramp in (10, 20, 40)
    )
    assert fine < 4e-5
    assert np.log2(coarse / middle) >= 1.9
    assert np.log2(middle / fine) >= 1.9


def test_roller_slip_fraction_scales_the_sliding_only(reference_mechanism: MechanismMaker) -> None:
    whole = reference_mechanism(nodes=51)
    part = engagement(replace(whole, slip_fraction=0.1))
    full = engagement(whole)
    np.testing.assert_allclose(part.slip, 0.1 * full.slip, rtol=1e-14)
    np.testing.assert_allclose(part.sliding_speed, 0.1 * full.sliding_speed, rtol=1e-14)
    np.testing.assert_array_equal(part.load_per_width, full.load_per_width)
    np.testing.assert_array_equal(part.relative_curvature, full.relative_curvature)


def test_contact_ratio_of_the_unworn_flank(
    validated: Callable[..., None], reference_mechanism: MechanismMaker
) -> None:
    mechanism = reference_mechanism(nodes=801)
    profile = mechanism.profile
    ratio = mechanism.worn_contact_ratio(np.array(profile.x), np.array(profile.y))
    validated("contact ratio of the strand", ratio, (30.67 - 4.0) / 25.4, 1e-5, "path over pitch")


def test_points_the_strand_does_not_reach_carry_no_load(reference_mechanism: MechanismMaker) -> None:
    """A roller whose centre circle stays inside the line (R_C < R - h) never touches."""
    mechanism = reference_mechanism(nodes=51)
    profile = mechanism.profile
    lowered = mechanism.contact.engage(np.array(profile.x), np.array(profile.y) - 1.5, np.zeros(51))
    C = np.hypot(profile.x + r * profile.normal_x, profile.y - 1.5 + r * profile.normal_y)
    missed = (R - h) >= C
    assert missed.any()
    assert not missed.all()
    assert (lowered.load_per_width[missed] == 0.0).all()
    assert (lowered.slip[missed] == 0.0).all()
    for values in (lowered.load_per_width, lowered.slip, lowered.sliding_speed):
        assert np.isfinite(values).all()
