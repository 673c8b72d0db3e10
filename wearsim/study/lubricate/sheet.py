"""Intervals of relubrication side by side: text, JSON, CSV and a picture."""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from wearsim._version import ANSWER_HEAD
from wearsim.quantities import grouped
from wearsim.report.study_files import plain
from wearsim.report.text_lines import numbered_assumptions, row, table_lines
from wearsim.study.lubricate.intervals import MissedRelubrication, RelubricationPolicy
from wearsim.study.lubricate.model import LubricantPlan, LubricationStudy

_AT_THE_EDGE = (
    ". The lubricant gives out there, and what it lasts scatters: take a shorter one than the cheapest"
)


def policy_rows(study: LubricationStudy) -> list[dict[str, Any]]:
    """Return a row for every lubricant and interval, in the units of the columns."""
    return [
        {
            "lubricant": plan.name,
            "interval_hours": plain(policy.interval),
            "interval_km": plain(policy.interval * (study.km_per_hour or math.inf)),
            "mean_wear_factor": policy.wear_factor,
            **_lives(plan, policy),
            "relubrications_per_1000_h": 1000.0 / policy.interval,
            "cost_per_1000_h": policy.cost,
            "cost_low_per_1000_h": policy.cost_low,
            "cost_high_per_1000_h": policy.cost_high,
        }
        for plan in study.plans
        for policy in plan.policies
    ]


def _lives(plan: LubricantPlan, policy: RelubricationPolicy) -> dict[str, Any]:
    columns = {}
    for part in plan.parts:
        for end, lives in (("", policy.lives), ("_low", policy.lives_low), ("_high", policy.lives_high)):
            columns[f"{part.name}_life{end}_hours"] = lives[part.name]
        columns[f"{part.name}_life_reached"] = part.reached
    return columns


def lubrication_json(study: LubricationStudy) -> dict[str, Any]:
    """Return the study as ``wearsim lubricate --json`` prints it."""
    best = study.cheapest
    return {
        **ANSWER_HEAD,
        "case": study.case,
        "title": study.title,
        "lubricants": [_plan_json(plan) for plan in study.plans],
        "policies": policy_rows(study),
        "cheapest_lubricant": None if best is None else best.name,
        "assumptions": list(study.assumptions),
        "warnings": list(study.warnings),
    }


def _plan_json(plan: LubricantPlan) -> dict[str, Any]:
    (low, high), missed = plan.cheap or (None, None), plan.missed
    return {
        "lubricant": plan.name,
        "supplied": plan.supplied,
        "lasts_hours": plain(plan.lasts),
        "fades_over_hours": plan.fades,
        "dry_factor": plain(plan.dry_factor),
        "own_interval_hours": None if plan.own is None else plan.own.interval,
        "cheapest_interval_hours": None if plan.cheapest is None else plain(plan.cheapest.interval),
        "cheapest_cost_per_1000_h": None if plan.cheapest is None else plan.cheapest.cost,
        "cheap_from_hours": low,
        "cheap_to_hours": high,
        "no_cheapest_interval": plan.unknown or None,
        "missed_interval_hours": None if missed is None else missed.interval,
        "missed_lost_hours": None if missed is None else missed.lost,
        "missed_cost": None if missed is None else missed.cost,
    }


def lubrication_text(study: LubricationStudy) -> str:
    """Return the study as ``wearsim lubricate`` prints it."""
    lines = [study.title]
    for plan in study.plans:
        lines += ["", *_plan_lines(study, plan)]
    lines.append("")
    best = study.cheapest
    if best is not None and len(study.plans) > 1:
        lines.append(
            row("Pays", "; ".join([f"{_named(best)}, {_advice(study, best)}", *_without_oil(study)]))
        )
    elif best is None and len(study.plans) > len(study.untold) > 0:
        unknown = "; ".join(f"{_named(plan)} ({plan.unknown})" for plan in study.untold)
        lines.append(row("Pays", f"not told, as no least cost is known for {unknown}"))
    lines.append(row("Assumes", numbered_assumptions(study.assumptions)))
    lines.append(row("Warnings", "; ".join(study.warnings) or "none"))
    return "\n".join(lines)


def _named(plan: LubricantPlan) -> str:
    return plan.name or "the lubricant of the case"


def _without_oil(study: LubricationStudy) -> Iterator[str]:
    """Say of each lubricant that is supplied at an unknown price below which one it pays."""
    best = study.cheapest
    for plan in study.plans:
        cost = plan.cost_without_oil
        if cost is None or best is None or best.cheapest is None:
            continue
        left = (best.cheapest.cost or 0.0) - cost
        if left > 0.0:
            yield f"{plan.name} pays where its oil costs less than {grouped(left)} per 1000 h"


def _plan_lines(study: LubricationStudy, plan: LubricantPlan) -> Iterator[str]:
    yield row("Lubricant", _effect(study, plan))
    yield from _policy_table(study, plan)
    if plan.supplied:
        yield row("Cost", plan.unknown or _advice(study, plan))
        return
    if plan.cheapest is not None:
        yield row("Cheapest", _advice(study, plan))
    else:
        yield row("Cheapest", f"no interval: {plan.unknown}")
    if plan.missed is not None:
        yield row("Missed", _missed(study, plan.missed))


def _effect(study: LubricationStudy, plan: LubricantPlan) -> str:
    if plan.supplied:
        return f"{plan.name}: supplied all the time"
    way = f" ({grouped(plan.lasts * study.km_per_hour)} km)" if study.km_per_hour else ""
    fades = f" and fades over {grouped(plan.fades)} h" if plan.fades > 0.0 else ""
    return (
        f"{_named(plan)}: lasts {grouped(plan.lasts)} h{way}{fades}; dry contacts wear {plan.dry_factor:g} "
        "times as fast"
    )


def _policy_table(study: LubricationStudy, plan: LubricantPlan) -> Iterator[str]:
    head = ["interval", *(part.name for part in plan.parts), "wear factor", "cost per 1000 h"]
    cells = [[*_cells(study, plan, policy)] for policy in plan.policies]
    yield from (f"  {line}" for line in table_lines([head, *cells]))


def _missed(study: LubricationStudy, missed: MissedRelubrication) -> str:
    if missed.lost is None:
        every = _interval(study, missed.interval)
        return f"not told for intervals of {every}: a part does not outlive two of them"
    lost = f"{grouped(missed.lost)} h of the life of every part"
    if not missed.lost > 0.0:
        lost = "nothing of the life of any part"
    cost = ""
    if missed.cost is not None:
        cost = f", which {'costs' if missed.cost >= 0.0 else 'saves'} {grouped(abs(missed.cost))}"
    every = _interval(study, missed.interval)
    return f"one relubrication left out of those every {every} takes {lost}{cost}"


def _advice(study: LubricationStudy, plan: LubricantPlan) -> str:
    best, cheap = plan.cheapest, plan.cheap
    assert best is not None and best.cost is not None
    band = (
        f" ({grouped(best.cost_low)} to {grouped(best.cost_high)})"
        if best.cost_low and best.cost_high
        else ""
    )
    cost = f"{grouped(best.cost)}{band} per 1000 h"
    if cheap is None:
        return f"{_interval(study, best.interval)}, {cost}"
    low, high = (_interval(study, end) for end in cheap)
    return (
        f"every {_interval(study, best.interval)}, {cost}; from {low} to "
        f"{high} it costs at most 5 % more{_AT_THE_EDGE if plan.gives_out else ''}"
    )


def _interval(study: LubricationStudy, interval: float) -> str:
    if math.isinf(interval):
        return "all the time"
    way = f" ({grouped(interval * study.km_per_hour)} km)" if study.km_per_hour else ""
    return f"{grouped(interval)} h{way}"


def _cells(study: LubricationStudy, plan: LubricantPlan, policy: RelubricationPolicy) -> Iterator[str]:
    mark = " *" if policy is plan.own or (plan.own and policy.interval == plan.own.interval) else ""
    yield _interval(study, policy.interval) + mark
    for part in plan.parts:
        yield f"{'' if part.reached else '> '}{grouped(policy.lives[part.name])} h"
    yield f"{policy.wear_factor:.3g}"
    yield "-" if policy.cost is None else grouped(policy.cost)


def write_lubrication(study: LubricationStudy, place: Path) -> None:
    """Write table and picture into a folder."""
    import pandas as pd

    from wearsim.report.figures import save_figure
    from wearsim.study.lubricate.figure import lubrication_figure

    pd.DataFrame(policy_rows(study)).to_csv(place / "intervals.csv", index=False)
    (place / "lubrication.txt").write_text(lubrication_text(study) + "\n", encoding="utf-8")
    save_figure(lubrication_figure(study), place, "lubrication")
