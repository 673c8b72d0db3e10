"""A roller that rests on a flat and slides: benchmark B4 and the area balance through the wear engine.

B4, closed form: 4 a^3 - 3 a a0^2 = 6 R k q s, w0 = (a^2 - a0^2 ln 2)/(2 R), for a above about 2 a0,
here with the flat wearing instead of the cylinder, which for a roller that stays is the same. A
dense solve of the free half-space, apart from this code, gives w0 = 4.8526 um at s = 162. The area
of linear wear is k q s for any pressure where its directions are parallel.
"""

import numpy as np
import pytest

from tests.drives import depth_limit
from wearsim.contact.resting_engagement import NEW_MATE, RestingContact
from wearsim.geometry.profile_points import Profile, area_between
from wearsim.kernels import event_rows as kernels
from wearsim.wear.implicit_steps import run_resting
from wearsim.wear.law import archard, power
from wearsim.wear.problem import StartState, WearProblem
from wearsim.wear.resting_bodies import highest_load

R, q, k = 6.035, 100.0, 1e-7
MODULUS = 2.1e5 / (2.0 * 0.91)
NEVER = (depth_limit(0.02),)


class Resting(RestingContact):
    """Rollers above given places of a flat outline, each with load, path and count per cycle.

    A place is x, load [N/mm], path [mm], how often, body; the outline runs towards -x.
    """

    elongation_per_cycle = 0.0
    elongation_limit = 0.03
    slack_tension = 0.0

    def __init__(self, *places, radius=R, half=0.6, points=401, bodies=1):
        x = np.linspace(half, -half, points)
        self._profile, self._bodies, self._radius = Profile(x, 0.0 * x), bodies, radius
        self._places = places
        self.modulus = MODULUS

    @property
    def profile(self):
        return self._profile

    @property
    def bodies(self):
        return self._bodies

    @property
    def mate_radius(self):
        return self._radius

    def coarsened(self):
        raise NotImplementedError

    def memory(self):
        return np.zeros((1, 1))

    def events(self, x, y, wear, memory, at=0.5):
        table = np.zeros((kernels.EVENT_ROWS, len(self._places)))
        start, step = self.profile.x[0], self.profile.x[0] - self.profile.x[1]
        for column, (place, load, path, count, body) in zip(table.T, self._places, strict=True):
            column[kernels.EVENT_CENTRE_X], column[kernels.EVENT_CENTRE_Y] = place, self._radius
            column[kernels.EVENT_NORMAL_Y] = 1.0
            column[kernels.EVENT_TOUCHED] = (start - place) / step
            column[kernels.EVENT_LOAD], column[kernels.EVENT_SLIP] = load, path
            column[kernels.EVENT_SPEED] = 10.0 * path
            column[kernels.EVENT_COUNT], column[kernels.EVENT_BODY] = count, body
        return table


def closed_form(sliding):
    """Half-width and depth of the scar."""
    hertz = np.sqrt(4.0 * q * R / (np.pi * MODULUS))
    roots = np.roots([4.0, 0.0, -3.0 * hertz**2, -6.0 * R * k * q * sliding])
    half = float(roots[np.abs(roots.imag) < 1e-12].real.max())
    return half, (half**2 - hertz**2 * np.log(2.0)) / (2.0 * R)


def slid(sliding, *, steps=0, level=1, law=None, **outline):
    """Wear the flat by so many cycles of 1 mm of sliding, in so many equal steps if any."""
    contact = Resting((0.0, q, 1.0, 1.0, 0), **outline)
    size = sliding / steps if steps else 0.0
    return run_resting(WearProblem(contact, law or archard(k), NEVER, sliding), level, size)


def half_width(run):
    """Of a worn parabola: its second moment is a^2/5 of its area."""
    x, depth = run.x[0], run.depth[-1]
    return np.sqrt(5.0 * np.sum(depth * x**2) / np.sum(depth))


def teeth(depth):
    """Share of the depth that alternates from point to point."""
    return np.abs(depth[:-3] - 3.0 * depth[1:-2] + 3.0 * depth[2:-1] - depth[3:]).max() / depth.max()


@pytest.mark.parametrize("sliding", [162.0, 324.0, 1000.0])
def test_scar_of_a_resting_roller(validated, sliding):
    """Depth within 0.5 %, width within 1 % from s = 162 on."""
    half, depth = closed_form(sliding)
    run = slid(sliding)
    name, source = f"by the engine after {sliding:g} mm", "closed form, see docs/physics.md"
    quantity, shown = f"depth of the scar {name}", sliding != 324
    validated(quantity, run.depth[-1].max(), depth, 5e-3, source, "mm", page=shown)
    validated(f"half-width {name}", half_width(run), half, 1e-2, source, "mm", page=sliding == 162)


def test_scar_of_a_dense_solve(validated):
    depth = slid(162.0, level=3).depth[-1].max()
    source = "dense solve of the free half-space"
    validated("depth of the scar, fine steps", depth, 4.8526e-3, 1e-3, source, "mm")


def test_printed_numbers_of_the_closed_form():
    assert closed_form(162.0) == pytest.approx((0.251572, 4.86100e-3), rel=1e-5)


@pytest.mark.parametrize("exponent", [1.0, 2.0])
def test_steps_of_any_size_are_stable(exponent):
    """One step for the whole way, 14 times the explicit limit: no teeth, the right depth nearly."""
    law = power(k / 200.0 ** (exponent - 1.0), exponent)
    coarsest = 0.08 if exponent == 1.0 else 0.12
    fine = slid(324.0, steps=500, law=law)
    for steps, within in ((1, coarsest), (10, 0.02), (100, 2e-3)):
        run = slid(324.0, steps=steps, law=law)
        assert run.depth[-1].max() == pytest.approx(fine.depth[-1].max(), rel=within)
        assert teeth(run.depth[-1]) < 2.0 * teeth(fine.depth[-1]) + 1e-3
    spacing = run.x[0, 0] - run.x[0, 1]
    assert 10.0 * 4.0 * spacing / (np.pi * k * MODULUS) < 324.0


def test_first_order_in_the_step():
    """Twice the steps, half the error: 20, 40, 80 and 160 steps of one way."""
    depths = [slid(324.0, steps=steps).depth[-1].max() for steps in (20, 40, 80, 160)]
    change = np.abs(np.diff(depths))
    np.testing.assert_allclose(change[1:] / change[:-1], 0.5, atol=0.1)


def test_first_order_in_the_level():
    """The life by steps of a depth: the same way, halved from level to level."""
    contact = Resting((0.0, q, 1.0, 1.0, 0))
    limit = (depth_limit(5e-3),)
    lives = [run_resting(WearProblem(contact, archard(k), limit, 1e9), n).cycles[-1] for n in range(5)]
    change = np.abs(np.diff(lives))
    np.testing.assert_allclose(change[1:] / change[:-1], 0.5, atol=0.12)
    assert change[0] < 5e-3 * lives[-1]


def test_grid_of_the_scar():
    """201, 401 and 801 points on the same flat."""
    depths = [slid(324.0, points=points).depth[-1].max() for points in (201, 401, 801)]
    np.testing.assert_allclose(depths, depths[-1], rtol=1e-3)


@pytest.mark.parametrize("level", [0, 2])
def test_area_is_k_q_s(validated, level):
    """A roller so large that its radii are parallel: k sum(q s count) cycles, to rounding."""
    places = (
        (0.0, 1.0e-3, 1.0, 1.0, 0),
        (0.2, 2.0e-3, 0.5, 0.5, 0),
        (-0.1, 0.5e-3, 2.0, 1.0, 1),
        (0.1, 0.0, 2.0, 1.0, 1),
    )
    contact = Resting(*places, radius=1e6, bodies=2, half=1.2)
    run = run_resting(WearProblem(contact, archard(1e-4), (depth_limit(1e-5),), 300.0), level)
    worn = sum(load * path * count for _, load, path, count, _ in places)
    cycles = run.cycles[-1]
    assert run.met is not None and cycles < 300.0
    # The last step is cut at the limit, in a straight line: the area is too.
    quantity, found = "worn area under rollers with several loads", 1e-4 * worn * cycles
    validated(quantity, run.area, found, 1e-12, "k sum(q s)", "mm2", page=level == 0)
    x = contact.profile.x
    outlines = sum(area_between(x, 0.0 * x, x, -depth) for depth in run.all_depth[-1])
    assert outlines == pytest.approx(run.area, rel=1e-9)


def test_area_is_that_between_the_outlines():
    """Where the scar is round the radii are not parallel: 1 - (a/R)^2/10 on the mean."""
    run = slid(1000.0)
    area = area_between(run.x[0], run.y[0], run.x[-1], run.y[-1])
    assert run.area == pytest.approx(area, rel=1e-9)
    half, _ = closed_form(1000.0)
    assert run.area == pytest.approx(k * q * 1000.0, rel=0.2 * (half / R) ** 2)


def test_bodies_wear_alone():
    """A body wears as if the other were not there."""
    near, far = (0.0, q, 1.0, 1.0, 0), (0.1, 2.0 * q, 0.5, 1.0, 1)
    both = run_resting(WearProblem(Resting(near, far, bodies=2), archard(k), NEVER, 100.0), 0, 2.0)
    for body, place in enumerate((near, far)):
        alone = Resting((*place[:4], 0))
        run = run_resting(WearProblem(alone, archard(k), NEVER, 100.0), 0, 2.0)
        np.testing.assert_array_equal(run.depth[-1], both.all_depth[-1, body])
    assert both.depth[-1].max() == both.all_depth[-1].max()


def test_order_of_events_matters_less_with_smaller_steps():
    """Two rollers at one place, of 100 and 300 N/mm, in both orders."""
    light, heavy = (0.0, q, 1.0, 1.0, 0), (0.02, 3.0 * q, 1.0, 1.0, 0)
    change = []
    for steps in (10, 40):
        runs = [
            run_resting(WearProblem(Resting(*order), archard(k), NEVER, 81.0), 0, 81.0 / steps).depth[-1]
            for order in ((light, heavy), (heavy, light))
        ]
        change.append(np.abs(runs[0] - runs[1]).max() / runs[0].max())
    assert change[0] < 0.02
    assert change[1] < 0.4 * change[0]


def test_highest_load_is_that_of_the_outline_as_it_is():
    """Hertz on the flat whatever the coefficient; as in the scar at its end afterwards."""
    contact = Resting((0.0, q, 1.0, 3.0, 0), half=0.15)
    hertz = np.sqrt(4.0 * q * R / (np.pi * MODULUS))
    start = StartState(np.zeros((1, contact.profile.x.size)), NEW_MATE, 1)
    pressure, speed = highest_load(contact, archard(1e-3), start)
    assert pressure == pytest.approx(2.0 * q / (np.pi * hertz), rel=1e-3)
    assert speed == 10.0
    run = slid(162.0)
    worn, _ = highest_load(
        Resting((0.0, q, 1.0, 3.0, 0)), archard(k), StartState(run.all_depth[-1], NEW_MATE, 1)
    )
    assert q / (2.4 * half_width(run)) < worn < 0.5 * pressure


def test_power_law_under_the_pressure_of_the_end():
    """m = 2 in one tiny step: depth K s p^2 at every point under Hertz pressure."""
    coefficient = 1e-14
    run = slid(1.0, steps=1, law=power(coefficient, 2.0), half=0.15)
    hertz = np.sqrt(4.0 * q * R / (np.pi * MODULUS))
    peak = 2.0 * q / (np.pi * hertz)
    pressure = peak * np.sqrt(np.maximum(1.0 - (run.x[0] / hertz) ** 2, 0.0))
    inside = np.abs(run.x[0]) < 0.9 * hertz
    np.testing.assert_allclose(run.depth[-1][inside], coefficient * pressure[inside] ** 2, rtol=5e-3)
