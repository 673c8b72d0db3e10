"""Policies of maintenance side by side: text, JSON, CSV files and a picture."""

from typing import Any

from wearsim._version import ANSWER_HEAD
from wearsim.quantities import grouped
from wearsim.report.answer_table import AnswerTable, Column, in_currency, life_columns
from wearsim.report.text_lines import answer_text, closing
from wearsim.result import Life, LowerBound
from wearsim.study.maintain.model import MaintenancePlan, ReplacementPolicy
from wearsim.study.maintain.tooth_count import ToothCount


def policies_table(plan: MaintenancePlan) -> AnswerTable[ReplacementPolicy]:
    """Return a row for every policy."""
    cost = in_currency("cost per 1000 h", plan.currency)
    return AnswerTable(
        [
            Column("replace_at_percent", _percent, "replace at", "{:g} %"),
            Column("turned", lambda one: one.reversed_, "turned", lambda turned: "yes" if turned else "no"),
            Column("chain_life_hours", lambda one: one.chain_hours, "chain", lambda at: f"{grouped(at)} h"),
            Column("chains_per_sprocket", lambda one: one.chains if _reached(one) else None),
            Column("chains_per_sprocket_at_least", lambda one: None if _reached(one) else one.chains),
            Column("", lambda one: one.chains if _reached(one) else f"> {one.chains - 1}", "chains"),
            Column(
                "last_chain_used",
                lambda one: one.last_chain_used if _reached(one) else None,
                "last used",
                lambda part: f"{100.0 * part:.0f} %",
            ),
            *life_columns("sprocket_life_hours", lambda one: one.sprocket, "sprocket"),
            Column("life_reached", _reached),
            Column("hours_run", lambda one: one.hours),
            Column("stops", lambda one: one.stops if _reached(one) else None, "stops"),
            Column("cost_per_1000_h", lambda one: one.cost, cost, grouped),
            Column("numerical_error", lambda one: one.numerical_error),
        ],
        plan.policies,
    )


def counts_table(plan: MaintenancePlan) -> AnswerTable[ToothCount]:
    """Return a row for every number of teeth and links."""
    return AnswerTable(
        [
            Column("teeth", lambda one: one.meetings.teeth, "teeth"),
            Column("links", lambda one: one.meetings.links, "links"),
            Column("classes", lambda one: one.meetings.classes, "classes"),
            Column("same_link_kind", lambda one: one.meetings.same_link_kind),
            Column("", _met, "a tooth meets"),
            *life_columns("chain_life_hours", lambda one: one.lives.get("chain"), "chain"),
            *life_columns("sprocket_life_hours", lambda one: one.lives.get("sprocket"), "sprocket"),
        ],
        plan.counts,
    )


def maintenance_json(plan: MaintenancePlan) -> dict[str, Any]:
    """Return the plan as ``wearsim maintain --json`` prints it."""
    cheapest = plan.cheapest
    return {
        **ANSWER_HEAD,
        "case": plan.case,
        "title": plan.title,
        "policies": policies_table(plan).records(),
        "cheapest": None if cheapest is None else plan.policies.index(cheapest),
        "tooth_counts": counts_table(plan).records(),
        "assumptions": [*plan.conventions, *plan.assumptions],
        "warnings": list(plan.warnings),
    }


def maintenance_text(plan: MaintenancePlan, explain: bool = False) -> str:
    """Return the plan as ``wearsim maintain`` prints it."""
    parts: list[object] = [plan.title, policies_table(plan), *(f"  {text}" for text in _answers(plan))]
    if plan.counts:
        parts += ["", _counts_title(plan), counts_table(plan)]
    return answer_text(*parts, "", *closing((*_notes(plan), *plan.assumptions), plan.warnings, explain))


def maintenance_page(plan: MaintenancePlan) -> str:
    """Return the plan as a page of Markdown."""
    parts = [f"# {plan.title}", policies_table(plan).markdown()]
    parts += [*_answers(plan), "![policies](maintenance.svg)"]
    if plan.counts:
        parts += [f"## {_counts_title(plan)}", counts_table(plan).markdown()]
    parts.append("\n".join(f"- warning: {text}" for text in plan.warnings) or "No warnings.")
    texts = [*_notes(plan), *plan.assumptions]
    parts.append("\n".join(f"{i}. {text}" for i, text in enumerate(texts, start=1)))
    return "\n\n".join(parts) + "\n"


def maintenance_files(plan: MaintenancePlan) -> dict[str, str]:
    """Return tables and page, each as the content of a file."""
    counts = {"tooth_counts.csv": counts_table(plan).csv()} if plan.counts else {}
    return {"policies.csv": policies_table(plan).csv(), **counts, "maintenance.md": maintenance_page(plan)}


def _reached(policy: ReplacementPolicy) -> bool:
    return isinstance(policy.sprocket, Life)


def _percent(policy: ReplacementPolicy) -> float:
    return float(f"{100.0 * policy.replace_at:.12g}")


def _counts_title(plan: MaintenancePlan) -> str:
    return f"Teeth and links, chain replaced at {100 * plan.count_limit:g} %"


def _met(count: ToothCount) -> str:
    meetings = count.meetings
    if meetings.hunts:
        return "every roller"
    met = f"{meetings.rollers_per_tooth} of {meetings.links} rollers"
    return f"{met}, one kind of link" if meetings.same_link_kind else met


def _answers(plan: MaintenancePlan) -> list[str]:
    """Return the policy to take, or why it is not known."""
    cheapest = plan.cheapest
    if cheapest is not None:
        reversed_ = ", sprocket turned" if cheapest.reversed_ else ""
        known = " of those whose cost is known" if None in [one.cost for one in plan.policies] else ""
        return [f"cheapest{known}: a new chain at {_percent(cheapest):g} %{reversed_}"]
    if any(isinstance(policy.sprocket, LowerBound) for policy in plan.policies):
        return [
            "> : the sprocket's limit was not reached, so the cost is unknown (raise run.horizon_hours, "
            "or see the warnings)"
        ]
    return ["no cost without maintenance.chain_price and maintenance.sprocket_price"]


def _notes(plan: MaintenancePlan) -> list[str]:
    """Return what the tables rest on, beside the assumptions of the case."""
    texts = list(plan.conventions)
    if plan.counts:
        texts.append(
            "classes: sets of teeth that never share a roller, gcd of teeth and links; with 1, a hunting "
            "drive, all teeth and rollers wear alike"
        )
    if any(not count.run for count in plan.counts):
        texts.append(
            "- in the table of teeth and links: life not calculated; it is calculated for the numbers of "
            "the case and for one tooth or two links more"
        )
    return texts
