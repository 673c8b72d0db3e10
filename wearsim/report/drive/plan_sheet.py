"""The plan of a drive as text, JSON and CSV files."""

from collections.abc import Sequence
from functools import partial
from typing import Any

from wearsim._version import ANSWER_HEAD
from wearsim.case.keys import maintenance_of
from wearsim.drive.maintenance import DrivePlan
from wearsim.drive.replacement_rules import ReplacementRule, Stop
from wearsim.quantities import grouped
from wearsim.report.answer_table import AnswerTable, Column, csv_of, in_currency, table_of
from wearsim.report.drive.plan_words import rule_text
from wearsim.report.text_lines import Finding, answer_text, closing, fenced
from wearsim.result import Life, LowerBound, life_keys
from wearsim.result.ends import CHAIN, before_wear
from wearsim.result.lives import hours, service_measures

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
                **_numbers(rule),
                "description": rule_text(rule),
                "parts": _parts(rule),
                "schedule": [_stop(plan, stop) for stop in rule.schedule],
            }
            for rule in plan.rules
        ],
        "cheapest": None if best is None else best[0],
        "cheapest_is_certain": None if best is None else best[1],
        "least_possible_cost_per_1000_h": None if plan.no_less is None else _PER * plan.no_less,
        "assumptions": [*plan.conventions, *plan.drive.assumptions],
        "warnings": list(plan.found.warnings),
    }


def plan_files(plan: DrivePlan, text: str) -> dict[str, str]:
    """Return policies, their parts and their first stops, and the words, each as the content of a file."""
    rules = plan.rules
    tables: dict[str, list[dict[str, Any]]] = {
        "policies": [_numbers(rule) for rule in rules],
        "parts": [{"policy": rule.name, **one} for rule in rules for one in _parts(rule)],
        "schedule": [
            {"policy": rule.name, **_stop(plan, stop), "parts": ", ".join(stop.parts)}
            for rule in rules
            for stop in rule.schedule
        ],
    }
    files = {f"{name}.csv": csv_of(table_of(rows)) for name, rows in tables.items()}
    return {**files, "maintenance.md": fenced(text)}


def _numbers(rule: ReplacementRule) -> dict[str, Any]:
    cost = None if rule.cost is None else _PER * rule.cost
    return {
        "policy": rule.name,
        **_bounded("stops_per_1000_h", _PER * rule.stop_rate, rule.stops_at_most),
        **_bounded("cost_per_1000_h", cost, bool(rule.at_most)),
    }


def _parts(rule: ReplacementRule) -> list[dict[str, Any]]:
    return [
        {"part": name, **_bounded("parts_per_1000_h", _PER / every, name in rule.at_most)}
        for name, every in rule.every.items()
    ]


def _bounded(key: str, value: float | None, at_most: bool) -> dict[str, float | None]:
    return {key: None if at_most else value, f"{key}_at_most": value if at_most else None}


def _stop(plan: DrivePlan, stop: Stop) -> dict[str, Any]:
    return {
        "hours": stop.hours,
        **service_measures(plan.drive.driver.case.inputs, stop.hours),
        "parts": list(stop.parts),
    }


def plan_text(plan: DrivePlan, explain: bool = False) -> str:
    """Return the plan as ``wearsim maintain`` prints it."""
    lives = ", ".join(_life(plan, name, life) for name, life in plan.lives.items())
    rows = [
        *_cheapest(plan),
        Finding("Replace", rule_text(plan.best)),
        Finding("Stops", f"{plan.best.name}: {_stops(plan, plan.best)}"),
        *(Finding("Not known", text) for text in _not_known(plan)),
        *closing((*plan.conventions, *plan.drive.assumptions), plan.found.warnings, explain),
    ]
    return answer_text(plan.drive.title, Finding("Lives", lives), _table(plan), *rows)


def _life(plan: DrivePlan, name: str, life: Life | LowerBound) -> str:
    first = before_wear(plan.found.ends, name)
    return f"{name} {hours(life).replace('> ', '>= ')}" + (f" by {first.mode}" if first else "")


def _table(plan: DrivePlan) -> AnswerTable[ReplacementRule]:
    """Return parts, stops and cost of every rule in 1000 h."""
    sprockets = [name for name in plan.lives if name != CHAIN]
    each = {name: [name] for name in sprockets}
    groups = {CHAIN: [CHAIN], **(each if len(sprockets) <= _MAX_COLUMNS else {"sprockets": sprockets})}
    rules, cost = (
        plan.rules,
        None
        if plan.rules[0].cost is None
        else in_currency("cost", maintenance_of(plan.drive.chain_case.inputs).currency),
    )
    columns: list[Column[ReplacementRule]] = [
        Column("", lambda rule: rule.name, "in 1000 h", side="<"),
        Column("", lambda rule: _limited(_PER * rule.stop_rate, rule.stops_at_most), "stops"),
        *(Column("", partial(_counted, names), head) for head, names in groups.items()),
        Column("", lambda rule: _limited(_PER * (rule.cost or 0.0), bool(rule.at_most)), cost),
    ]
    return AnswerTable(columns, rules if len(rules) <= _MAX_RULES else (*rules[:_FIRST], rules[-1]))


def _counted(names: Sequence[str], rule: ReplacementRule) -> str:
    return _limited(_PER * sum(1.0 / rule.every[name] for name in names), not rule.at_most.isdisjoint(names))


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
    return [f"{text}; a longer run.horizon_hours may show"]
