"""One half-space line contact: contacts of 30, 100 and 200 cells, elastic, in wear, wear alone.

A roller on a flat scar worn by 162 mm of sliding (benchmark B4), 5 % more in the step, starting
from the pressure before it (warm) or from nothing (cold). Goal: 30 us for a warm contact of
100 cells where wear outweighs elasticity, and 8 times as fast as LU with an active set. Both are recorded,
as they depend on the machine: processors with wide vectors give LU 5 to 6 times the time. What is asserted is
half of that, which no machine explains.
"""

from time import perf_counter

import numpy as np
import pytest

from wearsim.kernels import half_space

MODULUS, RADIUS, LOAD, RATE = 2.1e5 / 1.82, 6.035, 100.0, 1e-7
SLIDING = {"elastic": 0.0, "both": 162.0, "wear": 1e4}
RATIO = 1.05


def half_width(sliding):
    """Of the scar of B4; Hertz without one."""
    hertz = np.sqrt(4.0 * LOAD * RADIUS / (np.pi * MODULUS))
    roots = np.roots([4.0, 0.0, -3.0 * hertz**2, -6.0 * RADIUS * RATE * LOAD * sliding])
    return max(hertz, roots[np.abs(roots.imag) < 1e-9].real.max())


def scar(kind, cells, tolerance):
    """Return the arguments of the kernel on a worn scar, its pressure with them."""
    n, sliding = round(1.2 * cells), SLIDING[kind]
    h = 2.0 * half_width(sliding) / cells
    x = (np.arange(n) + 0.5 - 0.5 * n) * h
    coefficients = np.empty(2 * n - 1)
    half_space.influence_coefficients(MODULUS, coefficients)
    given = {
        "x": x,
        "y": np.zeros(n),
        "width": np.full(n, h),
        "wear_compliance": np.zeros(n),
        "recess": np.zeros(n),
        "coefficients": coefficients,
        "constants": np.array([0.0, RADIUS, RADIUS, 0.0, 1.0, LOAD, tolerance, 500.0]),
        "pressure": np.zeros(n),
        "work": np.empty((half_space.WORK_ROWS, n)),
        "result": np.empty(7),
    }
    for step in np.diff(sliding * RATIO ** np.arange(-60.0, 1.0), prepend=0.0):
        given["wear_compliance"][:] = RATE * step
        half_space.line_contact(*given.values())
        given["y"] -= RATE * step * given["pressure"]
    given["wear_compliance"][:] = RATE * sliding * (RATIO - 1.0)
    if kind == "elastic":  # its own solution would need no iteration at all
        given["pressure"] *= 1.0 + 0.02 * np.cos(np.arange(n))
    return given


def dense(given):
    """The same contact with LU and a primal-dual active set; starts like the kernel."""
    centre_x, centre_y, radius, _, _, load = given["constants"][:6]
    to_x, to_y = centre_x - given["x"], centre_y - given["y"]
    distance = np.hypot(to_x, to_y)
    cosine, gap, n = to_y / distance, distance - radius, to_x.size
    sine = to_x / distance
    lag = np.subtract.outer(np.arange(n), np.arange(n)) + n - 1
    matrix = given["coefficients"][lag] * (np.outer(cosine, cosine) + np.outer(sine, sine))
    matrix = matrix * given["width"] + np.diag(given["wear_compliance"])
    active = given["pressure"] > 0.0
    while True:
        on = np.flatnonzero(active)
        system = np.zeros((on.size + 1, on.size + 1))
        system[:-1, :-1] = matrix[np.ix_(on, on)]
        system[:-1, -1] = -cosine[on]
        system[-1, :-1] = (cosine * given["width"])[on]
        solution = np.linalg.solve(system, np.append(-gap[on], load))
        pressure = np.zeros(n)
        pressure[on] = solution[:-1]
        left = gap + matrix @ pressure - solution[-1] * cosine
        changed = np.where(active, pressure > 0.0, left < 0.0)
        if (changed == active).all():
            return pressure
        active = changed


def solver(given, start):
    """A call of the kernel that starts from the same pressure every time."""
    warm = given["pressure"].copy() if start == "warm" else np.zeros(given["x"].size)
    values = tuple(given.values())

    def run():
        given["pressure"][:] = warm
        return half_space.line_contact(*values)

    return run


@pytest.mark.parametrize("tolerance", [1e-6, 1e-9])
@pytest.mark.parametrize("start", ["warm", "cold"])
@pytest.mark.parametrize("kind", SLIDING)
@pytest.mark.parametrize("cells", [30, 100, 200])
def test_contact(benchmark, cells, kind, start, tolerance):
    given = scar(kind, cells, tolerance)
    expected = dense(given)
    run = solver(given, start)
    assert run() == half_space.CONVERGED
    assert np.abs(given["pressure"] - expected).max() < 100.0 * tolerance * expected.max()
    benchmark.extra_info.update(
        cells=int(np.sum(given["pressure"] > 0.0)), iterations=int(given["result"][6])
    )
    benchmark(run)


def test_contact_reaches_its_goal(benchmark):
    """Fastest of nine rounds taken in turn, so that both see the same machine."""
    given = scar("wear", 100, 1e-9)
    run = solver(given, "warm")
    run()
    warm = {**given, "pressure": given["pressure"].copy()}

    def fastest(function, calls):
        begin = perf_counter()
        for _ in range(calls):
            function()
        return (perf_counter() - begin) / calls

    rounds = [(fastest(run, 100), fastest(lambda: dense(warm), 3)) for _ in range(9)]
    kernel, arrays = (min(times) for times in zip(*rounds, strict=True))
    benchmark.extra_info.update(microseconds=1e6 * kernel, to_numpy=arrays / kernel)
    benchmark(run)
    assert arrays / kernel >= 2.5
