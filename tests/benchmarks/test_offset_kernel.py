"""The cycle loop in offset form (flank of benchmark B9) against C, NumPy and its square roots.

C and NumPy give the kernel's depth before they are timed. Goal: at most 1.25 of the same split
loops in C.
"""

from time import perf_counter

import numpy as np
import pytest

from wearsim.contact.engagement import ContactKind
from wearsim.contact.hertz import contact_modulus
from wearsim.kernels.offset import (
    AFTER,
    AMOUNT,
    BASE,
    BEFORE,
    OFFSET_ROWS,
    STRESS,
    prepare_offset,
    run_offset_cycles,
)
from wearsim.mechanisms.prescribed.contact import PrescribedMechanism
from wearsim.wear.law import archard

CYCLES = 2000
RADIUS, ROLLER_RADIUS = 39.1, 6.035


def flank(nodes):
    """Arc of 6 mm, q = 100 (0.2 + 0.8 cos(pi u/2)) N/mm, s = 0.05 + 0.4 u mm, k = 1e-10 mm2/N."""
    u = np.linspace(0.0, 1.0, nodes)
    mechanism = PrescribedMechanism(
        kind=ContactKind.LOCAL,
        arc_length=6.0 * u,
        load_per_width=100.0 * (0.2 + 0.8 * np.cos(0.5 * np.pi * u)),
        slip=0.05 + 0.4 * u,
        sliding_speed=np.full(nodes, np.nan),
        flank_curvature=np.full(nodes, 1.0 / RADIUS),
        mate_radius=ROLLER_RADIUS,
        modulus=contact_modulus((2.1e5, 2.1e5), (0.3, 0.3)),
    )
    return mechanism.contact, archard(1e-10)


def numpy_cycles(table, cycles):
    """The loop with whole arrays and what it needs allocated once."""
    before, after, base, stress, amount, allowed = table
    depth, step, slope = np.zeros(base.size), np.empty(base.size), np.empty(base.size - 1)
    relative = base.copy()
    for _ in range(cycles):
        np.subtract(depth[1:], depth[:-1], out=slope)
        relative[1:-1] = base[1:-1] + (after[1:-1] * slope[1:] - before[1:-1] * slope[:-1])
        np.multiply(stress, relative, out=step)
        np.sqrt(step, out=step)
        step *= amount
        if not (step <= allowed * relative).all():
            raise ValueError("unstable")
        depth += step
        if depth.max() >= 1.0:
            break
    return depth


@pytest.fixture
def ways(c_function):
    """A function per way of running, each from the unworn flank; it returns the depth."""

    def build(nodes):
        contact, law = flank(nodes)
        numbers, diffusion = law.numbers(contact.kind), law.diffusion(contact.kind, 0.0)
        table = np.zeros((OFFSET_ROWS, nodes))
        given = contact.constants, contact.columns, contact.modulus, numbers, diffusion, 1.0
        prepare_offset(np.zeros(nodes), *given, table)
        rows = np.ascontiguousarray(table[[BEFORE, AFTER, BASE, STRESS, AMOUNT, AMOUNT + 1]])

        def kernel():
            x, y, depth = contact.profile.x.copy(), contact.profile.y.copy(), np.zeros(nodes)
            run_offset_cycles(
                x,
                y,
                depth,
                contact.constants,
                contact.columns,
                np.zeros((OFFSET_ROWS, nodes)),
                contact.modulus,
                numbers,
                diffusion,
                1.0,
                1.0,
                CYCLES,
                np.zeros(1),
            )
            return depth

        def c(kind):
            function = c_function("offset_fissioned", kind, "run_offset_cycles", "vlvvdlv")

            def run():
                depth = np.zeros(nodes)
                function(depth, nodes, rows, np.zeros((2, nodes)), 1.0, CYCLES, np.zeros(1))
                return depth

            return run

        found = {
            "kernel": kernel,
            "c fissioned": c("fissioned"),
            "c fast-math": c("fast-math"),
            "numpy": lambda: numpy_cycles(rows, CYCLES),
        }
        for name, run in found.items():
            np.testing.assert_allclose(run(), kernel(), rtol=1e-12, err_msg=name)
        roots = c_function("root_floor", "fissioned", "roots", "vvllll")
        numbers_in, numbers_out = rows[3].copy(), np.empty(nodes)
        found["floor"] = lambda: roots(numbers_in, numbers_out, nodes, 1, 0, CYCLES)
        return found

    return build


@pytest.mark.parametrize("nodes", [200, 500, 2000])
def test_offset(benchmark, ways, nodes):
    """All ways in turn, fastest of fifteen; what is timed by the plugin is the kernel."""
    found = ways(nodes)
    best = dict.fromkeys(found, np.inf)
    for _ in range(15):
        for name, run in found.items():
            begin = perf_counter()
            run()
            best[name] = min(best[name], perf_counter() - begin)
    per_point = {name: 1e9 * time / (CYCLES * nodes) for name, time in best.items()}
    benchmark.extra_info.update(nanoseconds=per_point)
    benchmark(found["kernel"])
    assert best["kernel"] <= 1.6 * best["c fissioned"]
