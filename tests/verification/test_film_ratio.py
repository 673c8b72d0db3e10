"""Film ratio of new flanks: Dowson and Higginson's formula, with speeds from kinematics written out here."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import wearsim
from wearsim.drive.validity import film_ratio
from wearsim.errors import CaseError
from wearsim.lubrication.film import Lubricant, minimum_film

CASES = Path(__file__).parents[2] / "cases"
FILM = ("film.viscosity_mPa_s=80", "film.pressure_viscosity_per_GPa=20", "film.roughness_um=0.5")
OIL = Lubricant(8e-8, 0.02)


def formula(speed: float, load: float, radius: float, modulus: float) -> float:
    """Thickness over 0.5 um: H = 2.65 G^0.54 U^0.7 / W^0.13 with E' = 2 E* [mm]."""
    full = 2.0 * modulus
    logarithm = math.log(2.65) + 0.54 * math.log(0.02 * full)
    logarithm += 0.7 * math.log(8e-8 * speed / (full * radius)) - 0.13 * math.log(load / (full * radius))
    return radius * math.exp(logarithm) / 5e-4


def test_film_of_two_discs(validated: Callable[..., None]) -> None:
    film = minimum_film(OIL, *(np.array([value]) for value in (3000.0, 120.0, 0.08)), 115384.6)
    validated(
        "film ratio of two discs",
        float(film[0]) / 5e-4,
        formula(3000.0, 120.0, 12.5, 115384.6),
        *(1e-12, "formula of Dowson and Higginson"),
    )


def test_film_at_the_pitch_point_of_gears() -> None:
    """Both flanks roll there at omega r sin(alpha)."""
    case = wearsim.load_case(CASES / "fzg-c14-16t-mild.toml", FILM)
    mechanism = case.drive.mechanism(case)
    place = int(np.abs(mechanism.mesh.pitch_point_distance).argmin())
    angle, radius = case.drive.pair.pitch_point_angle, case.drive.pair.circles.pinion_radius
    speed = 2.0 * math.pi * case.speed_rpm / 60.0 * radius * math.sin(angle)
    load = mechanism.contact.engage(
        mechanism.flank.x.copy(), mechanism.flank.y.copy(), np.zeros(mechanism.points)
    ).load_per_width[place]
    expected = formula(speed, float(load), 1.0 / float(mechanism.curvature[place]), case.modulus)
    assert film_ratio(case, case.film)[place] == pytest.approx(expected, rel=2e-2)


def test_film_on_an_evolute_flank() -> None:
    """By (S6) the flank comes at omega rho_t (1 + R h/l^2), the roller at omega r R h/l^2."""
    case = wearsim.load_case(
        CASES / "16b-20t-oiled.toml", [*FILM, "mechanism.roller_slip_fraction=1", "sprocket.nodes=61"]
    )
    mechanism = case.drive.mechanism(case)
    strand, touch = mechanism.strand, wearsim.simulate(case)
    assert any("film ratio" in text for text in touch.assumptions)
    ratio = film_ratio(case, case.film)
    contact = mechanism.contact
    engaged = contact.engage(contact.profile.x.copy(), contact.profile.y.copy(), np.zeros(61))
    loaded = engaged.load_per_width > 0.0
    omega, radius, height = mechanism.angular_speed, strand.roller_radius, strand.offset
    lever = engaged.sliding_speed[loaded] / omega - radius  # l
    turn = strand.centrode_radius * height / lever**2
    flank = 1.0 / (1.0 / radius - engaged.relative_curvature[loaded])  # rho_t
    speed = 0.5 * omega * (flank * (1.0 + turn) + radius * turn)
    middle = loaded.sum() // 2
    expected = formula(
        float(speed[middle]),
        float(engaged.load_per_width[loaded][middle]),
        1.0 / float(engaged.relative_curvature[loaded][middle]),
        case.modulus,
    )
    assert ratio[middle] == pytest.approx(expected, rel=1e-3)


@pytest.mark.parametrize("key", ["viscosity_mPa_s", "pressure_viscosity_per_GPa", "roughness_um"])
def test_every_key_changes_the_ratio_and_none_may_lack(key: str) -> None:
    case = CASES / "fzg-c14-16t-mild.toml"
    plain = wearsim.load_case(case, FILM)
    value = dict(text.split("=") for text in FILM)[f"film.{key}"]
    other = wearsim.load_case(case, [*FILM, f"film.{key}={2.0 * float(value)!r}"])
    change = film_ratio(other, other.film) / film_ratio(plain, plain.film)
    power = {"viscosity_mPa_s": 0.7, "pressure_viscosity_per_GPa": 0.54, "roughness_um": -1.0}[key]
    np.testing.assert_allclose(change, 2.0**power, rtol=1e-12)
    with pytest.raises(CaseError, match=key):
        wearsim.load_case(case, [text for text in FILM if key not in text])


def test_the_wear_does_not_change() -> None:
    few = ["sprocket.nodes=61", "stop.critical_depth_mm=0.01"]
    lives = [
        wearsim.simulate(wearsim.load_case(CASES / "16b-20t-oiled.toml", [*few, *film])).cycles
        for film in ((), FILM)
    ]
    assert lives[0] == lives[1]


def test_a_contact_without_rolling_is_refused(prescribed: Callable[..., wearsim.Case]) -> None:
    columns: dict[str, Any] = {
        "arc_length_mm": np.linspace(0.0, 6.0, 31),
        "load_per_width_N_per_mm": 100.0,
        "flank_curvature_per_mm": 0.0,
        "sliding_distance_mm": 0.3,
    }
    case = prescribed(columns, {"specific_wear_rate_mm2_per_N": 1e-9}, 0.01, 6.0, list(FILM))
    with pytest.raises(CaseError, match=r"film.*slip_ratio"):
        film_ratio(case, case.film)
    with pytest.raises(CaseError, match=r"film.*wrap"):
        wearsim.load_case(CASES / "08b-19t-wrap.toml", FILM)
