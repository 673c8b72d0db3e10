"""What the lubricant of a case does in its life: how far contacts slide on it, and when it gives out."""

import math
from collections.abc import Mapping

import numpy as np

from wearsim.case.model import Case, heaviest_block
from wearsim.contact.engagement import ContactKind, FlankContact
from wearsim.contact.hertz import half_width
from wearsim.geometry.profile_points import Vector
from wearsim.lubrication.clock import FRESH, LubricantClock
from wearsim.lubrication.model import LASTING
from wearsim.quantities import grouped
from wearsim.result import Life, LowerBound
from wearsim.wear.mate_clock import LubricatedClock, MateClock

_APART = 1e-9
"""Part of the way between two rows of a history at which a third one is another one."""

_KNEES = 200
"""Rows that are added for the lubricants of all chains after the first one, at most."""


def late_relubrication(
    case: Case, clock: LubricantClock, parts: Mapping[str, Life | LowerBound]
) -> list[str]:
    """Return a warning for each part that ends before its first relubrication, or the run before that."""
    given = case.lubrication
    if given is None or not given.first or given.first_hours >= case.run.horizon_hours:
        return []  # the case has said so
    per_hour = case.cycles_per_hour
    first = given.at_hours[0] if given.at_hours else clock.repeats / per_hour
    lasts = clock.law.lasts / per_hour / given.dirt.ageing
    dries = lasts + clock.law.fades / per_hour / given.dirt.ageing
    found = []
    for name, life in parts.items():
        if life.hours_run < first:
            kind = "life" if isinstance(life, Life) else "run"
            end = f"the {kind} of the {name}, {grouped(life.hours_run)} h"
            found.append(given.never_relubricated(end, f"the {name} is", life.hours_run, lasts, dries))
    return found


_DRY = 2.0
"""Mean wear over that of a lubricant which lasts from which running dry is said."""


def dry_warning(case: Case, clock: LubricatedClock) -> list[str]:
    """Return a warning where contacts run dry in a large part of every interval between relubrications."""
    given, lubricant = case.lubrication, clock.lubricant
    if given is None or given.interval is None or given.phases or math.isinf(lubricant.repeats):
        return []
    times = lubricant.lasting_factor / (1.0 + given.dirt.excess)
    if times < _DRY:
        return []
    per_hour = case.cycles_per_hour
    lasts, every = lubricant.law.lasts / per_hour / given.dirt.ageing, lubricant.repeats / per_hour
    return [
        f"the lubricant lasts {grouped(lasts)} h and is renewed every {grouped(every)} h: contacts wear on "
        f"average {times:.3g} times as fast as while it lasts; relubricate more often"
    ]


_HANGS_ON = 0.5
"""Life at the lower end of how long the lubricant lasts, over the life, below which that is said."""


def lasting_warning(
    case: Case, clock: LubricatedClock, part: str, life: Life | LowerBound, is_given: bool
) -> list[str]:
    """Return a warning where a life depends strongly on how long the lubricant lasts, which nobody knows.

    Only where its band holds that, which one does not that the user gives.
    """
    given = case.lubrication
    found = next((ends for ends in clock.ends_beside(is_given) if ends.unsure == LASTING), None)
    if given is None or given.phases or found is None or not isinstance(life, Life):
        return []
    sooner = clock.run_by(found.worse, clock.steady_cycles(life.cycles))
    if sooner >= _HANGS_ON * life.cycles:
        return []
    per_hour = case.cycles_per_hour * given.dirt.ageing
    lasts, less = (grouped(one.law.lasts / per_hour) for one in (clock.lubricant, found.worse))
    return [
        f"the life of the {part} depends strongly on how long the lubricant lasts, {lasts} h: with {less} "
        f"h, within its band, it is {grouped(sooner / case.cycles_per_hour)} h instead of "
        f"{grouped(life.hours)} h; relubricate more often"
    ]


def sliding_per_cycle(case: Case, contact: FlankContact) -> float:
    """Mean path that the loaded stretch of the new flank slides in a cycle of the duty [mm]."""
    touch = contact.new_engagement()
    loaded = touch.load_per_width > 0.0
    if not loaded.any():
        return 0.0
    slip, stretch = touch.slip[loaded], np.gradient(contact.arc_length)[loaded]
    if contact.kind is ContactKind.TRAVELLING:
        load, relative = touch.load_per_width[loaded], touch.relative_curvature[loaded]
        slip = slip * 2.0 * half_width(load, np.maximum(relative, 1e-9), contact.modulus)
    path = float(np.average(slip, weights=stretch))
    blocks = case.drive.duty
    if not blocks:
        return path
    # The width of the contact goes with the root of the load.
    heaviest = heaviest_block(blocks).tension
    return path * math.fsum(block.share * math.sqrt(block.tension / heaviest) for block in blocks)


def with_knees(
    history: dict[str, Vector],
    constant: Vector,
    chains: MateClock,
    elongation_per_cycle: float,
    cycles_per_hour: float,
) -> dict[str, Vector]:
    """Return a history with rows where a lubricant gives out or is renewed, on the way to the next row."""
    clock = chains.bodies
    if clock.lubricant is FRESH:
        return history
    last = np.flatnonzero(np.diff(history["chain"]) > 0.0)
    in_use = [chains.put_on(at) for at in (0.0, *constant[last].tolist())]
    times = [clock.lubricant.knees(float(history["cycles"][-1]))]
    ends = [*constant[last[1:]].tolist(), float(constant[-1])]
    times += [chain.knees(end, _KNEES // len(ends)) for chain, end in zip(in_use[1:], ends, strict=False)]
    cycles = np.sort(np.concatenate(times))
    cycles = cycles[np.diff(cycles, prepend=-1.0) > _APART * cycles]
    steady = np.array([clock.steady_cycles(at) for at in cycles.tolist()])
    after = np.searchsorted(constant, steady, side="right")
    inside = (after > 0) & (after < constant.size)
    cycles, steady, after = cycles[inside], steady[inside], after[inside]
    share = (steady - constant[after - 1]) / (constant[after] - constant[after - 1])
    apart = (share > _APART) & (share < 1.0 - _APART)
    cycles, steady, share, after = cycles[apart], steady[apart], share[apart], after[apart]
    before = after - 1
    renewed = history["chain"][after] != history["chain"][before]
    rows = {}
    for name, column in history.items():
        start = np.where(renewed & (name == "roller_wear_mm"), 0.0, column[before])
        rows[name] = start + share * (column[after] - start)
    number = history["chain"][after]
    worn = [in_use[int(n) - 1].worn(at) for n, at in zip(number.tolist(), steady.tolist(), strict=True)]
    rows |= {"cycles": cycles, "time_hours": cycles / cycles_per_hour, "chain": number}
    rows["elongation_percent"] = 100.0 * elongation_per_cycle * np.array(worn)
    return {name: np.insert(column, after, rows[name]) for name, column in history.items()}
