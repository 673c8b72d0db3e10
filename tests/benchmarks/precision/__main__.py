"""Runs every method on every case and writes the report with its diagram."""

import math
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from time import perf_counter

import numpy as np
from figure import write_figure
from problems import (
    PACKAGE,
    PI_CONTROLLED,
    STEPS,
    Compiled,
    Problem,
    Run,
    b9,
    by_lsoda,
    by_rk45,
    by_updates,
    depth_limit,
    every_cycle,
    strand,
)
from report import report
from wrap import wrap_levels

from wearsim.wear.advance import run_advance
from wearsim.wear.problem import WearProblem

FOLDER = Path(__file__).parents[3] / "reports" / "reference"
NODES = (200, 500, 1000, 2000)
CASES = {"B9": b9, "strand, m = 1": partial(strand, 1.0), "strand, m = 2": partial(strand, 2.0)}
OURS, BEFORE = "ROS34PW2", "LSODA"
METHODS = {
    OURS: PACKAGE,
    "ROS34PW2, PI": PI_CONTROLLED,
    **{name: Compiled(step, (power, power, 0.0)) for name, (step, power) in STEPS.items()},
    BEFORE: by_lsoda,
}
TOLERANCES = tuple(10.0 ** (-k / 4) for k in range(8, 29))
DRAWN, TOLD = TOLERANCES[::2], TOLERANCES[::4]
LADDERS = dict.fromkeys(METHODS, TOLERANCES) | {"RKC2": TOLD, BEFORE: TOLD[1:]}
ROUNDS, SLOW = 5, 0.12
"""Runs of every method and tolerance, in turn. What takes so many seconds is run once, and a
compiled method no tighter."""


@dataclass
class Study:
    """The fastest run of every method and tolerance on one problem, and the true life.

    ``agreement``: of the true life with explicit updates, extrapolated.
    """

    problem: Problem
    runs: dict[str, dict[float, Run]] = field(default_factory=dict)
    truth: float = math.nan
    agreement: float = math.nan

    def error(self, run):
        return run.life / self.truth - 1.0

    def milliseconds(self, method, error):
        """Time from which on every run with a tighter tolerance stays within an error, or nan."""
        worst, errors, times = 0.0, [], []
        for _, run in sorted(self.runs[method].items()):
            worst = max(worst, abs(self.error(run)) if run.life > 0.0 else math.inf)
            errors.append(math.log(max(worst, 1e-16)))
            times.append(math.log(1e3 * run.seconds))
        if math.log(error) < errors[0]:
            return math.nan
        return math.exp(np.interp(math.log(error), errors, times))

    def points(self):
        """Errors and milliseconds by method, at the tolerances of the figure."""
        found = {}
        for name, runs in self.runs.items():
            drawn = [runs[one] for one in DRAWN if one in runs and runs[one].life > 0.0]
            found[name] = ([abs(self.error(run)) for run in drawn], [1e3 * run.seconds for run in drawn])
        return found


def study(problem):
    """Measure every method; the true life is that of a far tighter run."""
    found = Study(problem, {name: {} for name in METHODS})
    ladders = dict(LADDERS)
    for name, method in METHODS.items():
        # The first call compiles.
        method(problem, ladders[name][0])
    for _ in range(ROUNDS):
        for name, method in METHODS.items():
            slow = set()
            for tolerance in ladders[name]:
                run = method(problem, tolerance)
                best = found.runs[name].get(tolerance, run)
                found.runs[name][tolerance] = min(best, run, key=lambda one: one.seconds)
                if run.seconds > SLOW:
                    slow.add(tolerance)
                    if name != BEFORE:
                        slow.update(one for one in ladders[name] if one < tolerance)
                        break
            ladders[name] = tuple(one for one in ladders[name] if one not in slow)
    found.truth = PACKAGE(problem, 1e-11).life
    cycles = found.truth / (0.1 * problem.contact.profile.x.size**2)
    coarse, fine = by_updates(problem, cycles), by_updates(problem, 0.5 * cycles)
    found.agreement = (2.0 * fine.life - coarse.life) / found.truth - 1.0
    return found


def seconds_for(lives):
    """Fastest whole ``run_advance`` of B9 on 500 nodes for each of some lives, runs in turn."""
    problem, times = b9(500), dict.fromkeys(lives, math.inf)
    time = PACKAGE(problem, 1e-6).life * problem.law.coefficient
    stop_limits = (depth_limit(problem.limit),)
    for _ in range(8 * ROUNDS):
        for life in lives:
            law = replace(problem.law, coefficient=time / life)
            begin = perf_counter()
            run, _ = run_advance(WearProblem(problem.contact, law, stop_limits, 1e14), 1e-4)
            times[life] = min(times[life], perf_counter() - begin)
            assert abs(run.cycles[-1] / life - 1.0) < 1e-4
    return times


def main():
    studies = {}
    for case, build in CASES.items():
        studies[case] = {nodes: study(build(nodes)) for nodes in NODES}
        print(case, flush=True)
    facts = {
        "every cycle": every_cycle(b9(500)),
        "handing in": 1e3 * min(PACKAGE(b9(3), 1e-3, 0.0).seconds for _ in range(50)),
        "explicit": [(nodes, *found) for nodes in (200, 500) for found in explicit(nodes)],
        "lives": seconds_for((1e6, 1e12)),
        "wrap": wrap_levels(),
    }
    points = {
        case: {nodes: found.points() for nodes, found in by_nodes.items()}
        for case, by_nodes in studies.items()
    }
    write_figure(points, FOLDER / "work_precision.svg")
    text = "\n".join(report(studies, facts, list(METHODS), TOLD))
    (FOLDER / "work_precision.md").write_text(text + "\n", encoding="utf-8")


def explicit(nodes):
    """Runs of the explicit pair on B9, with their tolerances."""
    problem = b9(nodes)
    return [(tolerance, by_rk45(problem, tolerance)) for tolerance in (1e-3, 1e-4)]


if __name__ == "__main__":
    main()
