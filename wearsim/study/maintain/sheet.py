"""Policies of maintenance side by side: text, JSON, CSV files and a picture."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from wearsim._version import ANSWER_HEAD
from wearsim.quantities import grouped
from wearsim.report.text_lines import numbered_assumptions, row, table_lines
from wearsim.result import Life, LowerBound, life_keys
from wearsim.result.lives import hours
from wearsim.study.maintain.model import MaintenancePlan, ReplacementPolicy
from wearsim.study.maintain.tooth_count import ToothCount

POLICY_HEAD = ("replace at", "turned", "chain", "chains", "last used", "sprocket", "stops", "cost per 1000 h")
COUNT_HEAD = ("teeth", "links", "classes", "a tooth meets", "chain", "sprocket")


def policy_rows(plan: MaintenancePlan) -> list[dict[str, Any]]:
    """Return a row for every policy, in the units of the columns."""
    return [
        {
            "replace_at_percent": _percent(policy),
            "turned": policy.reversed_,
            "chain_life_hours": policy.chain_hours,
            "chains_per_sprocket": _known(policy.chains, policy),
            "chains_per_sprocket_at_least": (None if isinstance(policy.sprocket, Life) else policy.chains),
            "last_chain_used": _known(policy.last_chain_used, policy),
            **life_keys("sprocket_life_hours", policy.sprocket),
            "life_reached": isinstance(policy.sprocket, Life),
            "hours_run": policy.hours,
            "stops": _known(policy.stops, policy),
            "cost_per_1000_h": policy.cost,
            "numerical_error": policy.numerical_error,
        }
        for policy in plan.policies
    ]


def count_rows(plan: MaintenancePlan) -> list[dict[str, Any]]:
    """Return a row for every number of teeth and links."""
    return [
        {
            "teeth": count.meetings.teeth,
            "links": count.meetings.links,
            "classes": count.meetings.classes,
            "same_link_kind": count.meetings.same_link_kind,
            **life_keys("chain_life_hours", count.lives.get("chain")),
            **life_keys("sprocket_life_hours", count.lives.get("sprocket")),
        }
        for count in plan.counts
    ]


def maintenance_json(plan: MaintenancePlan) -> dict[str, Any]:
    """Return the plan as ``wearsim maintain --json`` prints it."""
    cheapest = plan.cheapest
    return {
        **ANSWER_HEAD,
        "case": plan.case,
        "title": plan.title,
        "policies": policy_rows(plan),
        "cheapest": None if cheapest is None else plan.policies.index(cheapest),
        "tooth_counts": count_rows(plan),
        "assumptions": [*plan.conventions, *plan.assumptions],
        "warnings": list(plan.warnings),
    }


def maintenance_text(plan: MaintenancePlan) -> str:
    """Return the plan as ``wearsim maintain`` prints it."""
    lines = [plan.title, *_aligned(POLICY_HEAD, [_policy_cells(p) for p in plan.policies])]
    lines += [f"  {text}" for text in _answers(plan)]
    if plan.counts:
        lines += ["", f"Teeth and links, chain replaced at {100 * plan.count_limit:g} %"]
        lines += _aligned(COUNT_HEAD, [_count_cells(count) for count in plan.counts])
    lines += [
        "",
        row("Assumes", numbered_assumptions((*_notes(plan), *plan.assumptions))),
        row("Warnings", "; ".join(plan.warnings) or "none"),
    ]
    return "\n".join(lines)


def maintenance_page(plan: MaintenancePlan) -> str:
    """Return the plan as a page of Markdown."""
    parts = [f"# {plan.title}", _markdown(POLICY_HEAD, [_policy_cells(p) for p in plan.policies])]
    parts += [*_answers(plan), "![policies](maintenance.svg)"]
    if plan.counts:
        parts.append(f"## Teeth and links, chain replaced at {100 * plan.count_limit:g} %")
        parts.append(_markdown(COUNT_HEAD, [_count_cells(count) for count in plan.counts]))
    parts.append("\n".join(f"- warning: {text}" for text in plan.warnings) or "No warnings.")
    texts = [*_notes(plan), *plan.assumptions]
    parts.append("\n".join(f"{i}. {text}" for i, text in enumerate(texts, start=1)))
    return "\n\n".join(parts) + "\n"


def write_maintenance(plan: MaintenancePlan, place: Path) -> None:
    """Write tables and picture into a folder."""
    import pandas as pd

    from wearsim.report.figures import save_figure
    from wearsim.study.maintain.figure import maintenance_figure

    pd.DataFrame(policy_rows(plan)).to_csv(place / "policies.csv", index=False)
    if plan.counts:
        pd.DataFrame(count_rows(plan)).to_csv(place / "tooth_counts.csv", index=False)
    (place / "maintenance.md").write_text(maintenance_page(plan), encoding="utf-8")
    save_figure(maintenance_figure(plan), place, "maintenance")


def _known(value: float, policy: ReplacementPolicy) -> float | None:
    """A number of the sprocket's life, None where that is not known."""
    return value if isinstance(policy.sprocket, Life) else None


def _percent(policy: ReplacementPolicy) -> float:
    return float(f"{100.0 * policy.replace_at:.12g}")


def _policy_cells(policy: ReplacementPolicy) -> list[str]:
    reached = isinstance(policy.sprocket, Life)
    return [
        f"{_percent(policy):g} %",
        "yes" if policy.reversed_ else "no",
        f"{grouped(policy.chain_hours)} h",
        f"{policy.chains}" if reached else f"> {policy.chains - 1}",
        f"{100.0 * policy.last_chain_used:.0f} %" if reached else "-",
        hours(policy.sprocket),
        f"{policy.stops}" if reached else "-",
        "-" if policy.cost is None else grouped(policy.cost),
    ]


def _count_cells(count: ToothCount) -> list[str]:
    meetings, lives = count.meetings, count.lives
    met = f"{meetings.rollers_per_tooth} of {meetings.links} rollers"
    if meetings.hunts:
        met = "every roller"
    elif meetings.same_link_kind:
        met += ", one kind of link"
    return [
        f"{meetings.teeth}",
        f"{meetings.links}",
        f"{meetings.classes}",
        met,
        *(hours(lives[part]) if part in lives else "-" for part in ("chain", "sprocket")),
    ]


def _answers(plan: MaintenancePlan) -> list[str]:
    """Return the policy to take, or why it is not known."""
    cheapest = plan.cheapest
    if cheapest is not None:
        reversed_ = ", sprocket turned" if cheapest.reversed_ else ""
        known = " of those whose cost is known" if None in [one.cost for one in plan.policies] else ""
        return [f"cheapest{known}: a new chain at {_percent(cheapest):g} %{reversed_}"]
    if any(isinstance(policy.sprocket, LowerBound) for policy in plan.policies):
        return [
            "> : the sprocket's limit was not reached, so its cost is not known (raise run.horizon_hours, "
            "or see the warnings)"
        ]
    return ["no cost without maintenance.chain_price and maintenance.sprocket_price"]


def _notes(plan: MaintenancePlan) -> list[str]:
    """Return what the tables rest on, beside the assumptions of the case."""
    texts = list(plan.conventions)
    if plan.counts:
        texts.append(
            "classes: of teeth that never share a roller, gcd of teeth and links; 1 is a hunting drive, "
            "all teeth and rollers wear alike"
        )
    if any(not count.run for count in plan.counts):
        texts.append(
            "- among teeth and links: a life that was not calculated; those of the case's own numbers and "
            "of one tooth or two links more are"
        )
    return texts


def _aligned(head: Sequence[str], rows: list[list[str]]) -> list[str]:
    return [f"  {line}" for line in table_lines([head, *rows])]


def _markdown(head: Sequence[str], rows: list[list[str]]) -> str:
    lines = ["| " + " | ".join(row) + " |" for row in (head, *rows)]
    return "\n".join([lines[0], "|" + "---|" * len(head), *lines[1:]])
