"""Intervals of relubrication side by side: text, JSON, CSV and a picture."""

import math
from collections.abc import Iterator
from typing import Any

from wearsim._version import ANSWER_HEAD
from wearsim.quantities import grouped
from wearsim.report.answer_table import AnswerTable, Column, plain
from wearsim.report.text_lines import Finding, answer_text, closing
from wearsim.study.lubricate.intervals import MissedRelubrication, RelubricationPolicy, WornPart
from wearsim.study.lubricate.model import LubricantPlan, LubricationStudy

_AT_THE_EDGE = (
    ". The lubricant is exhausted there, and its duration scatters: choose a shorter interval than the "
    "cheapest"
)


def policy_rows(study: LubricationStudy) -> list[dict[str, Any]]:
    """Return a row for every lubricant and interval, in the units of the columns."""
    return [row for plan in study.plans for row in _policies(study, plan).records()]


def _policies(study: LubricationStudy, plan: LubricantPlan) -> AnswerTable[RelubricationPolicy]:
    """Return a row for every interval of a lubricant."""
    return AnswerTable(
        [
            Column("lubricant", lambda _: plan.name),
            Column("interval_hours", lambda one: one.interval),
            Column("interval_km", lambda one: one.interval * (study.km_per_hour or math.inf)),
            Column("", lambda one: _interval(study, one.interval) + _mark(plan, one), "interval"),
            Column("mean_wear_factor", lambda one: one.wear_factor),
            *(column for part in plan.parts for column in _lives(part)),
            Column("", lambda one: one.wear_factor, "wear factor", "{:.3g}"),
            Column("relubrications_per_1000_h", lambda one: 1000.0 / one.interval),
            Column("cost_per_1000_h", lambda one: one.cost, "cost per 1000 h", grouped),
            Column("cost_low_per_1000_h", lambda one: one.cost_low),
            Column("cost_high_per_1000_h", lambda one: one.cost_high),
        ],
        plan.policies,
    )


def _lives(part: WornPart) -> Iterator[Column[RelubricationPolicy]]:
    name, form = part.name, "{} h" if part.reached else "> {} h"
    yield Column(f"{name}_life_hours", lambda one: one.lives[name], name, lambda at: form.format(grouped(at)))
    yield Column(f"{name}_life_low_hours", lambda one: one.lives_low[name])
    yield Column(f"{name}_life_high_hours", lambda one: one.lives_high[name])
    yield Column(f"{name}_life_reached", lambda _: part.reached)


def _mark(plan: LubricantPlan, policy: RelubricationPolicy) -> str:
    """Return what marks the interval that a lubricant has."""
    return " *" if policy is plan.own or (plan.own and policy.interval == plan.own.interval) else ""


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


def lubrication_text(study: LubricationStudy, explain: bool = False) -> str:
    """Return the study as ``wearsim lubricate`` prints it."""
    parts: list[object] = [study.title]
    for plan in study.plans:
        parts += ["", *_plan_parts(study, plan)]
    return answer_text(*parts, "", *_pays(study), *closing(study.assumptions, study.warnings, explain))


def _pays(study: LubricationStudy) -> Iterator[Finding]:
    """Say which of several lubricants pays."""
    best = study.cheapest
    if best is not None and len(study.plans) > 1:
        yield Finding("Pays", "; ".join([f"{_named(best)}, {_advice(study, best)}", *_without_oil(study)]))
    elif best is None and len(study.plans) > len(study.untold) > 0:
        unknown = "; ".join(f"{_named(plan)} ({plan.unknown})" for plan in study.untold)
        yield Finding("Pays", f"not known, as there is no least cost for {unknown}")


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


def _plan_parts(study: LubricationStudy, plan: LubricantPlan) -> Iterator[object]:
    yield Finding("Lubricant", _effect(study, plan))
    yield _policies(study, plan)
    if plan.supplied:
        yield Finding("Cost", plan.unknown or _advice(study, plan))
        return
    advice = f"no interval: {plan.unknown}" if plan.cheapest is None else _advice(study, plan)
    yield Finding("Cheapest", advice)
    if plan.missed is not None:
        yield Finding("Missed", _missed(study, plan.missed))


def _effect(study: LubricationStudy, plan: LubricantPlan) -> str:
    if plan.supplied:
        return f"{plan.name}: supplied continuously"
    way = f" ({grouped(plan.lasts * study.km_per_hour)} km)" if study.km_per_hour else ""
    fades = f" and fades over {grouped(plan.fades)} h" if plan.fades > 0.0 else ""
    return (
        f"{_named(plan)}: lasts {grouped(plan.lasts)} h{way}{fades}; dry contacts wear {plan.dry_factor:g} "
        "times as fast"
    )


def _missed(study: LubricationStudy, missed: MissedRelubrication) -> str:
    if missed.lost is None:
        every = _interval(study, missed.interval)
        return f"not told for intervals of {every}: a part does not outlast two of them"
    lost = f"{grouped(missed.lost)} h of life of every part"
    if not missed.lost > 0.0:
        lost = "no life of any part"
    cost = ""
    if missed.cost is not None:
        amount = grouped(abs(missed.cost))
        cost = f", which is worth {amount}" if missed.cost >= 0.0 else f" and saves {amount}"
    every = _interval(study, missed.interval)
    return f"skipping one relubrication of those every {every} costs {lost}{cost}"


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
