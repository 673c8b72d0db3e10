"""Life error against time of wraps: implicit stages, their steps halved from level to level."""

from dataclasses import dataclass
from pathlib import Path
from time import process_time

import numpy as np
from problems import depth_limit

from wearsim.drive.load_case import load_case
from wearsim.wear.implicit_steps import run_seated
from wearsim.wear.law import archard
from wearsim.wear.problem import WearProblem

CASES = ("520-15t-wrap", "bicycle-17t-road", "d6-crawler-27t-wrap", "08b-19t-wrap", "a40-19t-rating")
LEVELS = range(-1, 5)
"""Levels run here; a production run takes level 0 first."""


@dataclass(frozen=True)
class Level:
    """Life in cycles with steps halved so often, the steps, seconds of a processor."""

    life: float
    steps: int
    seconds: float


def wrap_levels():
    """Run the sprocket of each case on all levels."""
    return {name: [levelled(name, level) for level in LEVELS] for name in CASES}


def levelled(name, level):
    """Run the sprocket of a case."""
    case = load_case(Path(__file__).parents[3] / "cases" / f"{name}.toml")
    contact, law = case.drive.contact(case), archard(case.wear.coefficient)
    begin = process_time()
    run = run_seated(WearProblem(contact, law, (depth_limit(case.critical_depth),), 1e12), level)
    return Level(float(run.cycles[-1]), run.updates, process_time() - begin)


def wrap_lines(found):
    """The section of the report."""
    yield "## Wraps"
    yield ""
    yield (
        "A roller rests in the gap, and where it touches and how hard follows from the gap between both "
        "outlines by an equilibrium. Every stage of a step finds places and wear together, so a step is "
        "stable at any size."
    )
    yield ""
    yield (
        "One run each of the sprocket of shipped cases, all of it timed. Error against level "
        f"{LEVELS[-1]} on the same points and phases; what these make of the life is in validation.md."
    )
    yield ""
    yield "| case | level | steps | life, cycles | life error | s of a processor |"
    yield "|---|---|---|---|---|---|"
    orders, left = {}, 0.0
    for name, levels in found.items():
        last = levels[-1].life
        for place, level in zip(LEVELS, levels, strict=True):
            error = f"{level.life / last - 1.0:.1e}" if place < LEVELS[-1] else "-"
            yield f"| {name} | {place} | {level.steps} | {level.life:.5g} | {error} | {level.seconds:.2f} |"
        # Of the last level, the reference, a part is left in each error: it makes the order look higher.
        errors = [abs(level.life / last - 1.0) for level in levels[:-1]]
        orders[name] = -np.polyfit(LEVELS[:-1], np.log2(errors), 1)[0]
        left = max(left, *errors[1:])
    yield ""
    reached = sum(order >= 1.8 for order in orders.values())
    yield (
        f"Order by these: {', '.join(f'{name} {order:.1f}' for name, order in orders.items())} (goal 1.8: "
        f"reached on {reached} of {len(orders)}). From level 0 on the error is at most "
        f"{100.0 * left:.2g} %. That is no error that an order could show: rollers change places, and edges "
        "of the worn part pass points, in leaps that fall to other times with other steps."
    )
    yield ""
