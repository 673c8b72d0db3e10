"""The plan of the next twelve months as text, JSON and files."""

import math
from functools import partial
from typing import Any

from wearsim._version import ANSWER_HEAD
from wearsim.quantities import grouped
from wearsim.report.answer_table import AnswerTable, Column, in_currency
from wearsim.report.text_lines import Finding, answer_text, closing, fenced
from wearsim.study.maintain.from_readings import YearPlan
from wearsim.study.maintain.year_plan import KEEP, RELUBRICATE, Job, PartNow, used_percent

_MOST_ROWS = 20
"""Jobs that the screen shows, of relubrications the first ones; files hold all."""


def year_text(plan: YearPlan, explain: bool = False) -> str:
    """Return the plan as ``wearsim maintain`` prints it with readings, on request with its assumptions."""
    now = plan.state.log.machine
    table = jobs_table(plan)
    shown = AnswerTable(table.columns, _shown(plan))
    more = len(plan.rows) - len(shown.rows)
    rows = [
        *(
            [Finding("More", f"{more} more relubrications in the year: --out DIR writes them all")]
            if more
            else []
        ),
        Finding("In total", _total(plan)),
        *closing(plan.assumptions, plan.warnings, explain),
    ]
    title = f"Next 12 months, from {plan.state.day(now)}"
    return answer_text(
        plan.state.case.title, Finding("Now", _now(plan)), Finding("Plan", title), shown, *rows
    )


def _shown(plan: YearPlan) -> tuple[Job, ...]:
    """Return the rows of the screen: every replacement and kept part, and the first relubrications."""
    relubricated = [row for row in plan.jobs if row.job == RELUBRICATE]
    room = max(_MOST_ROWS - (len(plan.jobs) - len(relubricated)), 0)
    left_out = {id(row) for row in relubricated[room:]}
    return tuple(row for row in plan.rows if id(row) not in left_out)


def _now(plan: YearPlan) -> str:
    elongation = plan.state.of("elongation_percent").middle
    used = used_percent(plan.parts)
    chain, *sprockets = plan.parts
    limit, of_chain = plan.state.limit, used[chain.name]
    texts = [f"chain {elongation:.3g} % longer of {limit:g} %, {of_chain:.0f} % of its life used"]
    texts += [f"{one.name} {'' if one.worn_out else '< '}{used[one.name]:.0f} %" for one in sprockets]
    return ", ".join(texts)


def _total(plan: YearPlan) -> str:
    if plan.total is None:
        if plan.prices is None:
            return "not known without maintenance.chain_price and a price of every sprocket"
        known = sum(job.cost or 0.0 for job in plan.jobs)
        return f"{money(plan, known)}, and relubrications: lubrication.price_per_application is not known"
    return money(plan, plan.total)


def money(plan: YearPlan, amount: float) -> str:
    """Return an amount in the currency of the prices."""
    return f"{grouped(amount)} {plan.currency}".rstrip()


def jobs_table(plan: YearPlan) -> AnswerTable[Job]:
    """Return a row for each job, and for each part that is kept."""
    return AnswerTable(
        [
            Column("date", partial(_day, plan), "day", side="<"),
            Column("date_low", lambda job: _end(plan, job.low)),
            Column("date_high", lambda job: _end(plan, job.high)),
            Column("", lambda job: _interval(plan, job), "90 %", side="<"),
            Column("job", lambda job: job.job, "job", side="<"),
            Column("parts", lambda job: ", ".join(job.parts), "parts", side="<"),
            Column("hours", lambda job: job.hours, "in", lambda hours: f"{grouped(hours)} h"),
            Column(
                "cost",
                lambda job: None if job.job == KEEP else job.cost,
                in_currency("cost", plan.currency),
                grouped,
            ),
        ],
        plan.rows,
    )


def parts_table(plan: YearPlan) -> AnswerTable[PartNow]:
    """Return a row for each part as it is now."""
    used = used_percent(plan.parts)
    return AnswerTable(
        [
            Column("part", lambda one: one.name),
            Column("life_hours", lambda one: one.life if one.worn_out else None),
            Column("life_hours_at_least", lambda one: None if one.worn_out else one.life),
            Column("used_hours", lambda one: one.used),
            Column("used_percent", lambda one: used[one.name]),
            Column("remaining_hours", lambda one: one.left if one.worn_out else None),
            Column("remaining_hours_low", lambda one: _known(one.low)),
            Column("remaining_hours_high", lambda one: _known(one.high)),
        ],
        plan.parts,
    )


def _known(hours: float) -> float | None:
    return None if math.isnan(hours) else hours


def _day(plan: YearPlan, job: Job) -> str | None:
    day = plan.state.day(plan.state.log.machine + job.hours)
    if job.job != KEEP:
        return day or None
    return f"until {'> ' if job.at_least else ''}{day or 'beyond the calendar'}"


def _end(plan: YearPlan, hours: float) -> str | None:
    if math.isnan(hours):
        return None
    return plan.state.day(plan.state.log.machine + hours) or None


def _interval(plan: YearPlan, job: Job) -> str | None:
    if math.isnan(job.low):
        return None
    low, high = (_end(plan, hours) or "beyond the calendar" for hours in (job.low, job.high))
    return f"> {low}" if job.at_least else low if low == high else f"{low} to {high}"


def year_json(plan: YearPlan) -> dict[str, Any]:
    """Return the plan as ``wearsim maintain --json`` prints it with readings."""
    case = plan.state.case
    return {
        **ANSWER_HEAD,
        "case": case.name,
        "title": case.title,
        "from": plan.state.day(plan.state.log.machine),
        "elongation_percent": plan.state.of("elongation_percent").middle,
        "parts": parts_table(plan).records(),
        "jobs": jobs_table(plan).records(),
        "currency": plan.currency or None,
        "cost": plan.total,
        "assumptions": [*plan.assumptions, *plan.state.case.assumptions],
        "warnings": list(plan.warnings),
    }


def year_files(plan: YearPlan, text: str) -> dict[str, str]:
    """Return tables and words, each as the content of a file."""
    return {"jobs.csv": jobs_table(plan).csv(), "parts.csv": parts_table(plan).csv(), "plan.md": fenced(text)}
