"""Nodes on the kinks of the share, held against even ones: python tests/benchmarks/precision/kinks.py.

It prints the tables of reports/reference/strand_kinks.md.
"""

from dataclasses import replace

import numpy as np
from problems import PACKAGE, STRAND, Problem, depth_limit, strand

from wearsim.drive.load_case import load_case
from wearsim.geometry.profile_points import Profile
from wearsim.wear.advance import run_advance
from wearsim.wear.problem import WearProblem

EXPONENTS = (1.0, 2.0)
NODES = (200, 500, 1000, 2000)
TOLERANCES = tuple(10.0 ** (-k / 4) for k in range(8, 29))
GRIDS, FINE = (51, 101, 201, 401, 801), 3201


def places(drive, nodes, on_kinks):
    """Return where the roller is at the nodes, even or with nodes on both kinks of the share."""
    end, start = drive.contact_end, drive.contact_start
    overlap = start - end - drive.chain.pitch
    if not on_kinks:
        return np.linspace(end, start, nodes)
    ramp = max(1, round((nodes - 1) * overlap / (start - end)))
    rising = np.linspace(end, end + overlap, ramp + 1)
    flat = np.linspace(end + overlap, start - overlap, nodes - 2 * ramp)
    return np.concatenate([rising, flat[1:-1], np.linspace(start - overlap, start, ramp + 1)])


def problem(exponent, nodes, on_kinks):
    """Return the strand of work_precision.md on nodes of our choice."""
    case = load_case(STRAND, [f"sprocket.nodes={nodes}"])
    points = case.drive.tooth.strand.conjugate_points(places(case.drive, nodes, on_kinks))
    mechanism = replace(case.drive.mechanism(case), profile=Profile(*points.T))
    given = strand(exponent, nodes)
    return Problem(mechanism.contact, given.law, given.limit, given.ends)


def rates_to(error, given):
    """Return the rates from which on every run with a tighter tolerance stays within a life error."""
    truth, worst, errors, rates = PACKAGE(given, 1e-10).life, 1e-16, [], []
    for tolerance in reversed(TOLERANCES):
        run = PACKAGE(given, tolerance)
        worst = max(worst, abs(run.life / truth - 1.0))
        errors.append(np.log(worst))
        rates.append(np.log(run.rates))
    return float(np.exp(np.interp(np.log(error), errors, rates)))


def cost_lines():
    """Rates at equal error, and the exponent of K that rates times nodes grow with."""
    yield "| m | life error | nodes | " + " | ".join(f"K = {n}" for n in NODES) + " | rates times K |"
    yield "|---|---|---|" + "---|" * len(NODES) + "---|"
    for exponent in EXPONENTS:
        for error in (1e-4, 1e-5):
            for on_kinks in (False, True):
                rates = [rates_to(error, problem(exponent, nodes, on_kinks)) for nodes in NODES]
                power = np.polyfit(np.log(NODES), np.log(np.multiply(rates, NODES)), 1)[0]
                cells = " | ".join(f"{rate:.0f}" for rate in rates)
                where = "on kinks" if on_kinks else "even"
                yield f"| {exponent:g} | {error:.0e} | {where} | {cells} | K^{power:.2f} |"


def grid_lines():
    """Error of the life by the grid alone."""
    yield "| m | nodes | " + " | ".join(f"K = {nodes}" for nodes in GRIDS) + " |"
    yield "|---|---|" + "---|" * len(GRIDS)
    for exponent in EXPONENTS:
        truth = PACKAGE(problem(exponent, FINE, False), 1e-7).life
        for on_kinks in (False, True):
            lives = [PACKAGE(problem(exponent, nodes, on_kinks), 1e-8).life for nodes in GRIDS]
            cells = " | ".join(f"{life / truth - 1.0:.1e}" for life in lives)
            yield f"| {exponent:g} | {'on kinks' if on_kinks else 'even'} | {cells} |"


def drift_lines():
    """Where on the new flank, by x, the points lie that stand on the kinks as the flank wears."""
    yield "| m | part of the life | share reaches 1 at the root | at the tip | tip |"
    yield "|---|---|---|---|---|"
    for exponent in EXPONENTS:
        given = problem(exponent, 801, False)
        contact = given.contact
        run, _ = run_advance(WearProblem(contact, given.law, (depth_limit(given.limit),), 1e12), 1e-5)
        height, radius, _, end, start, per_overlap = contact.constants[:6]
        kinks = end + 1.0 / per_overlap, start - 1.0 / per_overlap
        first = None
        for shot in (0, 9, 45, 90, 180):
            worn = Profile(run.x[shot], run.y[shot])
            centre = worn.x + radius * worn.normal_x, worn.y + radius * worn.normal_y
            distance = np.sqrt(np.maximum(centre[0] ** 2 + centre[1] ** 2 - height**2, 0.0))
            first = distance if first is None else first
            low, high = np.interp(kinks, distance, first)
            yield f"| {exponent:g} | {shot / 180:.2f} | {low:.2f} | {high:.2f} | {first[-1]:.2f} |"


if __name__ == "__main__":
    for lines in (cost_lines, grid_lines, drift_lines):
        print("\n".join(lines()), end="\n\n", flush=True)
