"""Face load factor against closed forms on an elastic foundation, and against a wear loop.

The closed forms are derived in docs/face-load.md; x = c F_beta / q_m throughout.
"""

import math

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import dawsn

from wearsim.handbook.face_load.face_slices import (
    WideMesh,
    equivalent_misalignment,
    load_moments,
    self_aligned_gap,
    slice_loads,
)
from wearsim.handbook.face_load.face_wear import WearingFace, opening_rate
from wearsim.handbook.face_load.keys import FaceLoadTables
from wearsim.handbook.face_load.model import gap_kinds, wear_rates
from wearsim.input.document import load_calculation

WIDTH, STIFFNESS, MEAN = 800.0, 1.5e4, 900.0
"""mm, N/mm2, N/mm."""


def mesh(slices=400):
    return WideMesh.of(WIDTH, slices, STIFFNESS, MEAN * WIDTH)


def gap_of(x):
    """Misalignment [mm] with c F/q_m = x."""
    return x * MEAN / STIFFNESS


def factor(loads):
    return float(np.max(loads)) / MEAN


POWER, SPEED, DIAMETER, RATIO = 3000.0, 150.0, 500.0, 8.0
RATE, WHEEL, SLIP = 2e-11, 1.5, 0.25


def solved(misalignment, hours=1000.0, lever=None, slices=400, wheel=WHEEL):
    """The same mesh by its input file; misalignment in um."""
    power = MEAN * WIDTH * math.pi * DIAMETER * SPEED / 60.0 / 1e6
    own = {} if lever is None else {"pivot_friction_lever_mm": lever}
    tables = {
        "format_version": 1,
        "pair": {
            "face_width_mm": WIDTH,
            "pinion_pitch_diameter_mm": DIAMETER,
            "gear_ratio": RATIO,
            "mesh_stiffness_N_per_mm_um": STIFFNESS / 1e3,
            "slices": slices,
        },
        "load": {"power_kW": power, "pinion_speed_rpm": SPEED},
        "misalignment": misalignment,
        "running_in": {
            "specific_wear_rate_mm2_per_N": RATE,
            "wheel_wear_ratio": wheel,
            "slip_ratio": SLIP,
            "time_hours": hours,
        },
        "self_aligning": own,
    }
    return load_calculation(tables, FaceLoadTables).factors()


def micrometres(**x):
    """Keys of the misalignment by their x."""
    words = {key: value for key, value in x.items() if isinstance(value, str)}
    numbers = {key: 1e3 * gap_of(value) for key, value in x.items() if key not in words}
    return {
        **{f"{key}_misalignment_um": v for key, v in numbers.items() if key != "crown"},
        **{f"{key}_um": v for key, v in numbers.items() if key == "crown"},
        **words,
    }


def worn(gaps, hours=1000.0, slices=400):
    """The same with a fixed pinion alone: fixed and varying misalignment and crown by their x."""
    here = mesh(slices)
    varies_with = gaps.get("varies_with", "load")
    fixed, varying, crown = (gap_of(gaps.get(name, 0.0)) for name in ("fixed", "varying", "crown"))
    gap, share = gap_kinds(here.position, fixed, varying, varies_with, crown)
    rates = wear_rates(RATE, WHEEL, SLIP, RATIO, varies_with, 60.0 * SPEED)
    return WearingFace(here, gap, share, rates).run_in(hours)


TIME = 1.0 / (STIFFNESS * RATE * SLIP * (1.0 + WHEEL / RATIO) * 60.0 * SPEED)
"""Hours in which both flanks take all but 1/e of a fixed gap: 1/(c k s (1 + r/u) 60 n)."""


@pytest.mark.parametrize("x", [0.0, 0.3, 1.0, 1.999])
def test_linear_gap_in_full_contact_is_exact(validated, x):
    """K = 1 + c F b/(2 P): a linear load is integrated exactly by slices."""
    here = mesh(10)
    loads = slice_loads(here, gap_of(x) * here.position / WIDTH)
    quantity, source = f"K of a linear gap, x = {x:g}", "1 + x/2"
    validated(quantity, factor(loads), 1.0 + x / 2.0, 1e-12, source, page=x == 1.0)


@pytest.mark.parametrize("x", [2.0, 2.5, 8.0, 50.0])
def test_linear_gap_in_partial_contact(validated, x):
    """K = (2 x)^(1/2) on a width b_c = b (2/x)^(1/2); the slices are of second order."""
    errors = []
    for slices in (200, 400, 800):
        here = mesh(slices)
        loads = slice_loads(here, gap_of(x) * here.position / WIDTH)
        errors.append(abs(factor(loads) / math.sqrt(2.0 * x) - 1.0))
        loaded = here.width[loads > 0.0].sum()
        assert loaded == pytest.approx(WIDTH * math.sqrt(2.0 / x), abs=2 * WIDTH / slices)
    assert max(errors) < 2e-3
    quantity, shown = f"K of a linear gap in partial contact, x = {x:g}", x in (2.5, 50.0)
    validated(quantity, factor(loads), math.sqrt(2.0 * x), 2e-3, "(2 x)^(1/2)", page=shown)
    assert errors[2] < max(errors[0] / 4.0, 1e-12)


def linear(x):
    """K of a linear gap, face-load.md (2)."""
    return 1.0 + x / 2.0 if x <= 2.0 else math.sqrt(2.0 * x)


@pytest.mark.parametrize("x", [0.0, 0.7, 2.0, 9.0])
def test_misalignment_with_the_same_factor(x):
    assert equivalent_misalignment(mesh(), linear(x)) == pytest.approx(gap_of(x), abs=1e-15)


@pytest.mark.parametrize("x", [0.5, 1.4])
def test_crown_in_full_contact(validated, x):
    """q = q_m + c C (1/3 - eta^2): K = 1 + x/3 up to x = 3/2."""
    here = mesh()
    loads = slice_loads(here, gap_of(x) * (2.0 * here.position / WIDTH) ** 2)
    quantity, shown = f"K of a crown, x = {x:g}", x == 1.4
    validated(quantity, factor(loads), 1.0 + x / 3.0, 1e-5, "1 + x/3", page=shown)


@pytest.mark.parametrize("x", [2.0, 20.0])
def test_crown_in_partial_contact(validated, x):
    """q = c C (a^2 - eta^2) with q_m = c C (2/3) a^3: K = x a^2, a = (3/(2 x))^(1/3)."""
    here = mesh()
    loads = slice_loads(here, gap_of(x) * (2.0 * here.position / WIDTH) ** 2)
    expected, source = x ** (1 / 3) * 1.5 ** (2 / 3), "x^(1/3) (3/2)^(2/3)"
    quantity, shown = f"K of a crown in partial contact, x = {x:g}", x == 20.0
    validated(quantity, factor(loads), expected, 1e-4, source, page=shown)


def test_crown_and_linear_gap_together(validated):
    """q = q_m + c C/3 - c C eta^2 - c F eta/2 is largest at eta = -F/(4 C)."""
    here = mesh()
    crown, linear = 0.8, 0.6
    gap = gap_of(crown) * (2.0 * here.position / WIDTH) ** 2 + gap_of(linear) * here.position / WIDTH
    expected = 1.0 + crown / 3.0 + linear**2 / (16.0 * crown)
    found, source = factor(slice_loads(here, gap)), "its maximum in closed form"
    validated("K of a crown on a linear gap", found, expected, 1e-5, source)


def test_any_gap_carries_its_load_by_an_independent_root():
    """Force and load of ten random gaps against a root of the balance."""
    random = np.random.default_rng(2)
    here = mesh(50)
    gaps = random.uniform(0.0, 0.3, (10, 51))
    loads = slice_loads(here, gaps)
    for gap, found in zip(gaps, loads, strict=True):

        def missing(approach, gap=gap):
            carried = STIFFNESS * np.maximum(0.0, approach - gap)
            return carried @ here.width - here.force

        expected = STIFFNESS * np.maximum(0.0, brentq(missing, 0.0, 10.0, xtol=1e-15) - gap)
        assert found == pytest.approx(expected, rel=1e-9, abs=1e-6)


def test_force_is_power_over_the_speed_of_the_pitch_circle():
    """7090 kW at 170 rpm on 650 mm: 5.7858 m/s, 1225.4 kN."""
    tables = {
        "format_version": 1,
        "pair": {"face_width_mm": 1000, "pinion_pitch_diameter_mm": 650, "gear_ratio": 12.5},
        "load": {"power_kW": 7090, "pinion_speed_rpm": 170, "application_factor": 1.5},
        "misalignment": {"fixed_misalignment_um": 180},
        "running_in": {"specific_wear_rate_mm2_per_N": 1e-11, "slip_ratio": 0.3, "time_hours": 1},
    }
    found = load_calculation(tables, FaceLoadTables).factors()
    force = 7.09e6 / (math.pi * 0.650 * 170 / 60)
    assert force == pytest.approx(1.2254e6, rel=1e-4)
    assert found.mesh.force == pytest.approx(1.5 * force, rel=1e-12)
    x = 2e4 * 0.18 / (1.5 * force / 1000)
    assert found.fixed.states[0].factor == pytest.approx(1 + x / 2, rel=1e-12)
    assert found.mesh.stiffness == pytest.approx(2e4)


def test_difference_from_uniform_decays_exponentially_in_full_contact():
    """K - 1 falls with exp(-t/T), T = 1/(c k s (1 + r/u) 60 n)."""
    found = solved(micrometres(fixed=1.6), hours=0.7 * TIME)
    assert found.fixed_hours == pytest.approx(TIME, rel=1e-12)
    run = found.fixed
    assert run.states[1].factor == pytest.approx(1.0 + 0.8 * math.exp(-0.7), rel=1e-6)
    expected = 1.0 + 0.8 * np.exp(-run.hours / TIME)
    assert run.factors == pytest.approx(expected, rel=1e-7)
    assert run.settled
    assert run.states[2].factor == pytest.approx(1.0, abs=1e-4)
    opening = run.states[2].opening
    assert opening[0] - opening[-1] == pytest.approx(gap_of(1.6), rel=1e-4)


def test_opening_in_the_mean_is_that_of_the_mean_load():
    """k s (1 + r/u) q_m per turn of the pinion, before and after it has run in."""
    for hours in (0.5 * TIME, 40.0 * TIME):
        state = solved(micrometres(fixed=1.0), hours).fixed.states[1]
        turns = hours * 60.0 * SPEED
        expected = RATE * SLIP * (1.0 + WHEEL / RATIO) * MEAN * turns
        assert state.opening @ mesh().width / WIDTH == pytest.approx(expected, rel=1e-6)


def partial_contact(x, t):
    """K of a linear gap that starts in partial contact, t = time/T.

    Where flanks touch, q' = c delta' - q (in t); the force stays, so that c delta' = F/a on a
    touching width a, whose edge moves with delta = F_beta a/b: a = a0 (1 + t)^(1/2), a0 =
    b (2/x)^(1/2). At the loaded edge q is then K0 e^-t and an integral of e^s (1 + s)^(-1/2).
    """
    k0 = math.sqrt(2.0 * x)
    return k0 * (dawsn(np.sqrt(1.0 + t)) + np.exp(-t) * (1.0 - dawsn(1.0)))


def test_partial_contact_runs_in_by_its_closed_form(validated):
    """Up to the time x/2 - 1, when the whole face touches; exponentially after it."""
    x = 6.0
    full = x / 2.0 - 1.0
    run = worn({"fixed": x}, 1.9 * TIME)
    t = run.hours / TIME
    expected = np.where(
        t < full, partial_contact(x, t), 1.0 + (partial_contact(x, full) - 1.0) * np.exp(-(t - full))
    )
    assert (t > full).sum() > 5
    quantity, source = "K while a partial contact runs in", "closed form with Dawson's integral"
    validated(quantity, run.factors, expected, 2e-4, source)
    touching = mesh().width[run.states[1].loads[0] > 0.0].sum()
    assert touching == pytest.approx(WIDTH * math.sqrt(2.0 * 2.9 / x), abs=4.0)


@pytest.mark.parametrize("x", [0.4, 1.5, 2.0, 3.0, 12.0])
def test_what_changes_with_the_load_stays_but_never_above_2(x):
    """Run in: the mean of both gaps is even. K = min(1 + x/2, 2).

    Where one of both gaps lifts off, the other carries all of the mean, which is 2 q_m.
    """
    run = worn({"varying": x}, slices=200)
    assert run.states[0].factor == pytest.approx(linear(x), rel=1e-3)
    assert run.states[2].factor == pytest.approx(min(1.0 + x / 2.0, 2.0), rel=2e-4)
    carried = run.states[2].loads
    assert carried.mean(axis=0) == pytest.approx(MEAN, rel=2e-4)


def test_the_fixed_part_runs_in_beside_it():
    """New as one gap of both; run in as the changing one alone."""
    run = worn({"fixed": 0.9, "varying": 0.7})
    assert run.states[0].factor == pytest.approx(1.0 + 1.6 / 2.0, rel=1e-9)
    assert run.states[2].factor == pytest.approx(1.0 + 0.7 / 2.0, rel=1e-4)
    t = 0.9
    run = worn({"fixed": 0.9, "varying": 0.7}, t * TIME)
    expected = 1.0 + (0.9 * math.exp(-t) + 0.7) / 2.0
    assert run.states[1].factor == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize(
    ("varies_with", "own"),
    [("wheel", (WHEEL / RATIO) / (1.0 + WHEEL / RATIO)), ("pinion", 1.0 / (1.0 + WHEEL / RATIO))],
)
def test_what_turns_with_a_wheel_is_worn_by_its_own_teeth(varies_with, own):
    """K = 1 + (x_fix e^-t + x_var e^(-t own/all))/2; wheel teeth mesh u times less often."""
    gaps = micrometres(fixed=0.5, varying=0.8, varies_with=varies_with)
    t = 1.3
    found = solved(gaps, hours=t * TIME, slices=50)
    expected = 1.0 + (0.5 * math.exp(-t) + 0.8 * math.exp(-t * own)) / 2.0
    assert found.fixed.states[1].factor == pytest.approx(expected, rel=1e-6)
    assert found.varying_hours == pytest.approx(TIME / own)
    assert found.fixed.states[2].factor == pytest.approx(1.0, abs=1e-3)


def test_what_turns_with_a_wheel_that_does_not_wear_stays():
    gaps = micrometres(fixed=0.5, varying=0.8, varies_with="wheel")
    found = solved(gaps, wheel=0.0, slices=50)
    assert math.isinf(found.varying_hours)
    assert found.fixed.states[2].factor == pytest.approx(1.4, rel=1e-4)


def test_against_wear_mesh_by_mesh(validated):
    """Alternating meshes with their own root for the approach, 200 of them in a time constant.

    Starts in partial contact; explicit steps, so they agree to the size of one.
    """
    here, steps, t = mesh(60), 400, 2.0
    gaps, share = gap_kinds(here.position, gap_of(2.0), gap_of(1.5), "load", gap_of(0.4))
    opening = np.zeros(61)
    for step in range(steps):
        gap = gaps[step % 2] + opening

        def missing(approach, gap=gap):
            return STIFFNESS * np.maximum(0.0, approach - gap) @ here.width - here.force

        opening += t / steps * np.maximum(0.0, brentq(missing, 0.0, 20.0, xtol=1e-14) - gap)
    expected = factor(slice_loads(here, gaps + opening))
    state = worn({"fixed": 2.0, "varying": 1.5, "crown": 0.4}, t * TIME, 60).states[1]
    quantity, source = "K after two time constants", "wear mesh by mesh in explicit steps"
    validated(quantity, state.factor, expected, 5e-3, source)
    assert state.opening == pytest.approx(opening, rel=0.02)
    assert share.sum() == pytest.approx(1.0)


def test_self_aligning_pinion_takes_a_linear_gap_at_once():
    for x in (0.5, 5.0):
        run = solved(micrometres(fixed=x), slices=50).self_aligning
        assert [state.factor for state in run.states] == pytest.approx([1.0] * 3, rel=1e-9)


def test_self_aligning_pinion_leaves_crown_and_change():
    """The crown runs in; a gap that changes does not where the pinion follows the mean."""
    crowned = solved(micrometres(fixed=1.1, crown=0.9), slices=200).self_aligning
    assert crowned.states[0].factor == pytest.approx(1.0 + 0.9 / 3.0, rel=1e-4)
    assert crowned.states[2].factor == pytest.approx(1.0, rel=1e-3)
    changing = solved(micrometres(fixed=1.1, varying=0.8), slices=200).self_aligning
    assert [state.factor for state in changing.states] == pytest.approx([1.4] * 3, rel=1e-6)


@pytest.mark.parametrize(
    ("lever", "expected"),
    [
        (0.0, 1.0),
        (20.0, 1.0 + 6.0 * 20.0 / WIDTH),
        (WIDTH / 6.0, 2.0),
        (300.0, 4.0 / (3.0 * (1.0 - 600.0 / WIDTH))),
    ],
)
def test_friction_in_the_pivot_leaves_a_moment(validated, lever, expected):
    """M = F e: K = 1 + 6 e/b up to b/6, then 4/(3 (1 - 2 e/b)) as the load ends in a triangle."""
    here = mesh(800)
    gaps, share = gap_kinds(here.position, gap_of(1.0), gap_of(60.0), "load", 0.0)
    loads = slice_loads(here, self_aligned_gap(here, gaps, share, lever))
    quantity, source = f"K of a self-aligning pinion, lever {lever:.4g} mm", "closed form"
    validated(quantity, factor(loads), expected, 1e-4, source, page=lever in (20.0, 300.0))


def test_moments_of_an_aligned_pinion():
    """Their mean vanishes; with friction each is at most what friction holds."""
    here = mesh()
    gaps, share = gap_kinds(here.position, gap_of(3.0), gap_of(2.0), "wheel", gap_of(0.7))
    carried = load_moments(here, slice_loads(here, self_aligned_gap(here, gaps, share, None)))
    assert abs(share @ carried) < 1e-9 * here.force * WIDTH
    assert np.abs(carried).max() > 0.05 * here.force * WIDTH
    held = here.force * 15.0
    carried = load_moments(here, slice_loads(here, self_aligned_gap(here, gaps, share, 15.0)))
    assert np.abs(carried).max() == pytest.approx(held, rel=1e-9)
    assert (np.abs(carried) <= held * (1 + 1e-9)).all()


def test_share_of_the_wear_by_hand():
    """k s = 3e-12 of the pinion; k s r/u = 3e-12 x 2/12 of the wheel."""
    args = (1e-11, 2.0, 0.3, 12.0)
    for varies_with, own in (("load", 0.0), ("wheel", 5e-13), ("pinion", 3e-12)):
        rates = wear_rates(*args, varies_with, 1.0)
        assert (rates.total, rates.own) == pytest.approx((3.5e-12, own), rel=1e-12, abs=1e-30)
    loads, share = np.array([[1.0, 3.0], [5.0, 1.0]]), np.array([0.5, 0.5])
    rates = wear_rates(*args, "wheel", 1.0)
    expected = 3e-12 * np.array([3.0, 2.0]) + 5e-13 * loads
    assert opening_rate(loads, share, rates) == pytest.approx(expected, rel=1e-12, abs=1e-30)
