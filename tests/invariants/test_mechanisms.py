"""What must hold for every mechanism and every method, whatever the numbers.

Expected: zero load or slip wears nothing, wear is linear in k, no point gains material, the
removed area closes, the answer does not depend on the unit of length or on the grid.
"""

from collections.abc import Callable

import numpy as np
import pytest

from tests.drives import depth_limit
from wearsim.contact.engagement import ContactKind, Mechanism
from wearsim.errors import ContactError
from wearsim.geometry.profile_points import area_between
from wearsim.wear.advance import run_advance
from wearsim.wear.law import power
from wearsim.wear.loop import run_per_cycle
from wearsim.wear.problem import WearProblem
from wearsim.wear.trajectory import Trajectory

pytestmark = pytest.mark.wide

Build = Callable[..., Mechanism]

DEPTH = 0.05
EXPONENTS = (1.0, 1.5)


@pytest.fixture(params=["advance", "per_cycle"])
def run(request: pytest.FixtureRequest) -> Callable[..., Trajectory]:
    """Return one of the two ways to wear a flank, in some thousand updates where it has updates."""

    def wear(
        mechanism: Mechanism, exponent: float = 1.0, factor: float = 1.0, length: float = 1.0
    ) -> Trajectory:
        # The coefficient has the unit area/force for m = 1 and changes with the unit of length.
        coefficient = factor * 1e-7 * length**2 * (length**2 / 1000.0) ** (exponent - 1.0)
        law, stop_limits = power(coefficient, exponent), (depth_limit(DEPTH * length),)
        if request.param == "advance":
            return run_advance(WearProblem(mechanism.contact, law, stop_limits, 1e9), 1e-5)[0]
        return run_per_cycle(WearProblem(mechanism.contact, law, stop_limits, 1e9), 1)

    return wear


Run = Callable[..., Trajectory]


@pytest.mark.parametrize("exponent", EXPONENTS)
def test_result_is_complete_and_finite(build: Build, run: Run, exponent: float) -> None:
    worn = run(build(51), exponent)
    assert worn.met is not None
    for values in (worn.cycles, worn.x, worn.y, worn.depth):
        assert np.isfinite(values).all()
    assert (np.diff(worn.cycles) > 0.0).all()
    assert worn.depth[-1].max() == pytest.approx(DEPTH, rel=1e-6)


@pytest.mark.parametrize("exponent", EXPONENTS)
def test_no_point_gains_material(build: Build, run: Run, exponent: float) -> None:
    worn = run(build(51), exponent)
    assert (worn.depth[0] == 0.0).all()
    assert (np.diff(worn.depth, axis=0) >= -1e-12 * DEPTH).all()


@pytest.mark.parametrize("quantity", ["load", "slip"])
def test_nothing_wears_without_load_or_slip(build: Build, run: Run, quantity: str) -> None:
    """A life that does not exist is an error, never a number."""
    with pytest.raises(ContactError, match="cycle 0"):
        run(build(51, **{quantity: 0.0}))


def test_wear_is_linear_in_k(build: Build, run: Run) -> None:
    """A tenth of k: ten times the cycles (explicit updates of finite size: to their error)."""
    whole, tenth = run(build(51)), run(build(51), factor=0.1)
    assert tenth.cycles[-1] == pytest.approx(10.0 * whole.cycles[-1], rel=1e-3)


def test_wear_is_linear_in_slip(build: Build, run: Run) -> None:
    whole, half = run(build(51)), run(build(51, slip=0.5))
    assert half.cycles[-1] == pytest.approx(2.0 * whole.cycles[-1], rel=1e-3)


@pytest.mark.parametrize("exponent", EXPONENTS)
def test_area_closes(build: Build, run: Run, exponent: float) -> None:
    """The shoelace area is the time integral of the wear over the current arc."""
    worn = run(build(201), exponent)
    chord = np.hypot(np.diff(worn.x, axis=1), np.diff(worn.y, axis=1))
    cell = np.zeros_like(worn.x)
    cell[:, 1:] += 0.5 * chord
    cell[:, :-1] += 0.5 * chord
    integral = np.sum(np.diff(worn.depth, axis=0) * 0.5 * (cell[1:] + cell[:-1]))
    area = area_between(worn.x[0], worn.y[0], worn.x[-1], worn.y[-1])
    assert area > 0.0
    assert integral == pytest.approx(area, rel=1e-4)


@pytest.mark.parametrize("exponent", EXPONENTS)
def test_unit_of_length_does_not_matter(build: Build, run: Run, exponent: float) -> None:
    """The same run in units of 1/1024 mm: a power of two scales without rounding."""
    unit = 2.0**-10
    mm, other = run(build(51), exponent), run(build(51, length=unit), exponent, length=unit)
    assert other.cycles[-1] == pytest.approx(mm.cycles[-1], rel=1e-9)
    np.testing.assert_allclose(other.depth[-1] / unit, mm.depth[-1], rtol=0, atol=1e-9 * DEPTH)


@pytest.mark.parametrize("exponent", EXPONENTS)
def test_grid_does_not_matter(build: Build, run: Run, exponent: float) -> None:
    coarse, fine = (run(build(nodes), exponent) for nodes in (101, 201))
    assert fine.cycles[-1] == pytest.approx(coarse.cycles[-1], rel=1e-3)
    areas = [area_between(w.x[0], w.y[0], w.x[-1], w.y[-1]) for w in (coarse, fine)]
    assert areas[0] == pytest.approx(areas[1], rel=2e-3)


@pytest.mark.parametrize("exponent", EXPONENTS)
def test_methods_agree(build: Build, exponent: float) -> None:
    law, stop_limits = power(1e-7 / 1000.0 ** (exponent - 1.0), exponent), (depth_limit(DEPTH),)
    contact = build(51).contact
    advance, _ = run_advance(WearProblem(contact, law, stop_limits, 1e9), 1e-5)
    per_cycle = run_per_cycle(WearProblem(contact, law, stop_limits, 1e9), 1)
    # Each cycle by itself, the rollers of a wrap rest where rigid teeth would have them: on the soft teeth
    # here that is 1.5 % of the life, and at the edges of the contact some of the depth.
    near, beside = (0.02, 0.08) if contact.kind is ContactKind.RESTING else (3e-4, 3e-4)
    assert advance.cycles[-1] == pytest.approx(per_cycle.cycles[-1], rel=near)
    np.testing.assert_allclose(advance.depth[-1], per_cycle.depth[-1], rtol=0, atol=beside * DEPTH)


def test_same_input_gives_the_same_numbers(build: Build, run: Run) -> None:
    first, second = run(build(51)), run(build(51))
    np.testing.assert_array_equal(first.cycles, second.cycles)
    np.testing.assert_array_equal(first.depth, second.depth)


def test_pressure_falls_where_a_pit_deepens(build: Build) -> None:
    """More removed at one point makes the flank there more concave."""
    contact = build(51).contact
    x, y = np.array(contact.profile.x), np.array(contact.profile.y)
    depth = np.zeros(51)
    depth[25] = 1e-4
    pit = contact.profile.recede(depth)
    flat = contact.engage(x, y, np.zeros(51))
    worn = contact.engage(np.array(pit.x), np.array(pit.y), depth)
    assert worn.relative_curvature[25] < flat.relative_curvature[25]
    assert worn.relative_curvature[24] > flat.relative_curvature[24]
    assert worn.relative_curvature[26] > flat.relative_curvature[26]


def test_assumptions_are_stated(build: Build) -> None:
    stated = build(51).assumptions()
    assert stated
    assert all(text.strip() for text in stated)
