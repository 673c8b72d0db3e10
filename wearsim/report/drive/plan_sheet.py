"""The plan of a drive as text, JSON and CSV files."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from wearsim._version import ANSWER_HEAD
from wearsim.drive.maintenance import DrivePlan
from wearsim.drive.plan import ReplacementRule, Stop
from wearsim.quantities import grouped
from wearsim.report.drive.plan_words import rule_text
from wearsim.report.table import Column, Row, Table, table_of
from wearsim.report.text_lines import Finding, answer_text, fenced
from wearsim.result import Life, LowerBound, life_keys
from wearsim.result.ends import CHAIN, before_wear
from wearsim.result.lives import hours
from wearsim.result.service import service_measures

_PER = 1000.0
"""Hours for which parts, stops and cost are given."""

_MAX_COLUMNS = 4
"""Sprockets with a column of their own; more are summed up in one."""

_MAX_STOPS = 6
_FIRST, _MAX_RULES = 4, 6
"""Rules that are always shown, and most rows: of more, the first ones and the last."""


def plan_json(plan: DrivePlan) -> dict[str, Any]:
    """Return the plan as ``wearsim maintain --json`` prints it."""
    best = plan.cheapest
    return {
        **ANSWER_HEAD,
        "case": plan.drive.name,
        "title": plan.drive.title,
        "parts": [{"part": name, **life_keys("life_hours", life)} for name, life in plan.lives.items()],
        "policies": [
            {
                **numbers,
                "description": rule_text(rule),
                "parts": _parts([rule]).records(),
                "schedule": [_stop(plan, stop) for stop in rule.schedule],
            }
            for rule, numbers in zip(plan.rules, _policies(plan, plan.rules).records(), strict=True)
        ],
        "cheapest": None if best is None else best[0],
        "cheapest_is_certain": None if best is None else best[1],
        "least_possible_cost_per_1000_h": None if plan.no_less is None else _PER * plan.no_less,
        "assumptions": [*plan.conventions, *plan.drive.assumptions],
        "warnings": list(plan.found.warnings),
    }


def plan_files(plan: DrivePlan, text: str) -> dict[str, str]:
    """Return policies, their parts and their first stops, and the words, each as the content of a file."""
    stops = [
        {"policy": rule.name, **_stop(plan, stop), "parts": ", ".join(stop.parts)}
        for rule in plan.rules
        for stop in rule.schedule
    ]
    return {
        "policies.csv": _policies(plan, plan.rules).csv(),
        "parts.csv": _parts(plan.rules, Column("policy", lambda one: one[0].name)).csv(),
        "schedule.csv": table_of(stops).to_csv(index=False, lineterminator="\n"),
        "maintenance.md": fenced(text),
    }


def _policies(plan: DrivePlan, rules: Sequence[ReplacementRule]) -> Table[ReplacementRule]:
    """Return stops and cost of rules in 1000 h; on the screen also the parts that they take."""
    sprockets = [name for name in plan.lives if name != CHAIN]
    groups = {name: [name] for name in (CHAIN, *sprockets)}
    if len(sprockets) > _MAX_COLUMNS:
        groups = {CHAIN: [CHAIN], "sprockets": sprockets}
    return Table(
        [
            Column("policy", lambda one: one.name, "in 1000 h", side="<"),
            *_bounded(
                "stops_per_1000_h", lambda one: _PER * one.stop_rate, lambda one: one.stops_at_most, "stops"
            ),
            *(Column("", partial(_counted, names), head) for head, names in groups.items()),
            *_bounded(
                "cost_per_1000_h",
                lambda one: None if one.cost is None else _PER * one.cost,
                lambda one: bool(one.at_most),
                None if rules[0].cost is None else "cost",
            ),
        ],
        rules,
    )


def _counted(names: Sequence[str], rule: ReplacementRule) -> str:
    return _limited(_PER * sum(1.0 / rule.every[name] for name in names), not rule.at_most.isdisjoint(names))


_RulePart = tuple[ReplacementRule, str]


def _parts(rules: Sequence[ReplacementRule], *before: Column[_RulePart]) -> Table[_RulePart]:
    """Return how many of each part rules take in 1000 h."""
    return Table(
        [
            *before,
            Column("part", lambda one: one[1]),
            *_bounded(
                "parts_per_1000_h",
                lambda one: _PER / one[0].every[one[1]],
                lambda one: one[1] in one[0].at_most,
            ),
        ],
        [(rule, name) for rule in rules for name in rule.every],
    )


def _bounded(
    key: str, of: Callable[[Row], Any], at_most: Callable[[Row], bool], head: str | None = None
) -> tuple[Column[Row], Column[Row], Column[Row]]:
    """Return the columns of a number that is known, of one that is a bound, and of both on the screen."""
    return (
        Column(key, lambda row: None if at_most(row) else of(row)),
        Column(f"{key}_at_most", lambda row: of(row) if at_most(row) else None),
        Column("", lambda row: _limited(of(row), at_most(row)), head),
    )


def _stop(plan: DrivePlan, stop: Stop) -> dict[str, Any]:
    return {
        "hours": stop.hours,
        **service_measures(plan.drive.driver.case.inputs, stop.hours),
        "parts": list(stop.parts),
    }


def plan_text(plan: DrivePlan, source: str) -> str:
    """Return the plan as ``wearsim maintain`` prints it."""
    lives = ", ".join(_life(plan, name, life) for name, life in plan.lives.items())
    rows = [
        *_cheapest(plan),
        Finding("Replace", rule_text(plan.best)),
        Finding("Stops", f"{plan.best.name}: {_stops(plan, plan.best)}"),
        *(Finding("Not known", text) for text in _not_known(plan)),
        Finding("Assumes", f"{'; '.join(plan.conventions)}; all else: wearsim check {source}"),
        Finding("Warnings", "; ".join(plan.found.warnings) or "none"),
    ]
    shown = plan.rules if len(plan.rules) <= _MAX_RULES else (*plan.rules[:_FIRST], plan.rules[-1])
    return answer_text(plan.drive.title, Finding("Lives", lives), _policies(plan, shown), *rows)


def _life(plan: DrivePlan, name: str, life: Life | LowerBound) -> str:
    first = before_wear(plan.found.ends, name)
    return f"{name} {hours(life).replace('> ', '>= ')}" + (f" by {first.mode}" if first else "")


def _limited(value: float, at_most: bool) -> str:
    return f"<= {grouped(value)}" if at_most else grouped(value)


def _cheapest(plan: DrivePlan) -> list[Finding]:
    best = plan.cheapest
    if best is None:
        if plan.rules[0].cost is not None:
            return []
        return [Finding("Cost", "not known without maintenance.chain_price and a price of every sprocket")]
    rule = plan.rules[best[0]]
    assert rule.cost is not None
    most = "at most " if rule.at_most else ""
    text = f"{rule.name}, {most}{grouped(_PER * rule.cost)} in 1000 h"
    certain = "" if best[1] else ", as far as is known: a longer run may name another"
    no_less = f"; no plan costs less than {grouped(_PER * plan.no_less)}" if plan.no_less else ""
    return [Finding("Cheapest", text + certain + no_less)]


def _stops(plan: DrivePlan, rule: ReplacementRule) -> str:
    texts = []
    for stop in rule.schedule[:_MAX_STOPS]:
        day = service_measures(plan.drive.driver.case.inputs, stop.hours).get("date")
        when = f"{grouped(stop.hours)} h" + (f" ({day})" if day else "")
        texts.append(f"{when} {', '.join(stop.parts)}")
    text = "; ".join(texts)
    if len(rule.schedule) > _MAX_STOPS:
        return f"{text}; and so on"
    outlived = [life.hours_run for name, life in plan.lives.items() if name in rule.at_most]
    return f"{text or 'none'}; not known after {grouped(min(outlived))} h" if outlived else text


def _not_known(plan: DrivePlan) -> list[str]:
    outlived = [name for name, life in plan.lives.items() if isinstance(life, LowerBound)]
    if not outlived:
        return []
    text = f"when to replace {', '.join(outlived)}: did not wear out in the simulated time"
    return [f"{text}; a longer run.horizon_hours may tell"]
