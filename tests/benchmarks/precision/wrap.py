"""Life error against time of the wrap: semi-implicit steps that are halved from level to level."""

from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

from wearsim.case.load_case import load_case
from wearsim.contact.stop_limits import depth_limit
from wearsim.wear.implicit_steps import run_resting
from wearsim.wear.law import archard

CASE = Path(__file__).parents[3] / "cases" / "520-15t-wrap.toml"
LEVELS, PRODUCTION = 6, 3
"""Levels run here, and the last of a production run."""

TOLERANCES = (3e-2, 1e-2, 3e-3)


@dataclass(frozen=True)
class Level:
    """Life in cycles with steps halved so often, the steps, seconds."""

    life: float
    steps: int
    seconds: float


def wrap_levels():
    """Run the sprocket of a motorcycle on the thinned contact, as production does."""
    case = load_case(CASE)
    contact, law = case.drive.contact(case).with_fewer_phases(), archard(case.wear.coefficient)
    stop_limits = (depth_limit(case.critical_depth),)
    found = []
    for level in range(LEVELS):
        begin = perf_counter()
        run = run_resting(contact, law, stop_limits, 1e12, level)
        found.append(Level(float(run.cycles[-1]), run.updates, perf_counter() - begin))
    return found


def production_level(levels, tolerance):
    """Level at which a production run stops, and the change of the life that it reports."""
    for level in range(1, PRODUCTION + 1):
        change = abs(levels[level - 1].life / levels[level].life - 1.0)
        if change <= 0.5 * tolerance:
            break
    return level, change


def wrap_lines(levels):
    """The section of the report."""
    last, limit = levels[-1].life, 2.0 * levels[-1].life - levels[-2].life
    yield "## The wrap has its own engine"
    yield ""
    yield (
        "The steps above do not apply there: they need the pressure as a function of the curvature at "
        "each point, but in the wrap a roller rests in the gap, and where it touches and how hard "
        "follows from the gap between both outlines by an equilibrium. Every step finds that "
        "equilibrium after its own wear, so it is stable at any size and of first order; a production "
        "run halves its steps until two lives agree, at most to level 3."
    )
    yield ""
    yield (
        f"Case {CASE.stem}, thinned contact, one run each, all of it timed. Error against level "
        f"{LEVELS - 1}, whose own is about {limit / last - 1.0:.0e} by extrapolation from the last two."
    )
    yield ""
    yield "| level | steps | life, cycles | life error | change from the level before | s |"
    yield "|---|---|---|---|---|---|"
    for place, level in enumerate(levels):
        error = f"{level.life / last - 1.0:.1e}" if place < LEVELS - 1 else "-"
        change = f"{level.life / levels[place - 1].life - 1.0:.1e}" if place else "-"
        yield (f"| {place} | {level.steps} | {level.life:.5g} | {error} | {change} | {level.seconds:.2f} |")
    yield ""
    for tolerance in TOLERANCES:
        stop, change = production_level(levels, tolerance)
        kept = "" if change <= tolerance else ", and the run warns"
        seconds = sum(level.seconds for level in levels[: stop + 1])
        yield (
            f"- life_tolerance {tolerance:g}: stops at level {stop} after {seconds:.1f} s of steps, "
            f"states {change:.1e}, is {abs(levels[stop].life / limit - 1.0):.1e} from the extrapolated "
            f"life{kept}."
        )
    yield ""
