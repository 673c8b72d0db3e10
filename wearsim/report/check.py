"""What is known of a case without a run, as ``wearsim check`` shows it."""

from typing import Any

from wearsim._version import ANSWER_HEAD
from wearsim.case.model import Case
from wearsim.chain.selection import rating_warnings
from wearsim.drive.drive_case import DriveCase, chain_case
from wearsim.report.drive.layout import layout_json, layout_text
from wearsim.report.rating import notes_text, rating_json, rating_table


def check_json(case: Case | DriveCase) -> dict[str, Any]:
    """Return what is known of a case without a run as ``wearsim check --json`` prints it."""
    return {
        **ANSWER_HEAD,
        "case": case.name,
        **_layout(case),
        "assumptions": list(_assumptions(case)),
        "warnings": _warnings(case),
        **rating_json(chain_case(case)),
    }


def check_text(case: Case | DriveCase, head: str) -> str:
    """Return what is known of a case without a run in words, below a head."""
    one = chain_case(case)
    lines = [
        head,
        layout_text(case) if isinstance(case, DriveCase) else "",
        *(f"  assumes  {text}" for text in _assumptions(case)),
        rating_table(one),
        notes_text(one),
        *(f"  warning  {text}" for text in _warnings(case)),
    ]
    return "\n".join(filter(None, lines))


def _layout(case: Case | DriveCase) -> dict[str, Any]:
    if isinstance(case, Case):
        return {}
    return {"sprockets": [one.name for one in case.sprockets], "layout": layout_json(case)}


def _assumptions(case: Case | DriveCase) -> tuple[str, ...]:
    """Return what is taken for granted before a run, and the film ratio where the oil is given."""
    if isinstance(case, DriveCase) or case.film is None:
        return case.assumptions
    from wearsim.simulation.film_ratio import film_assumptions

    return (*film_assumptions(case), *case.assumptions)


def _warnings(case: Case | DriveCase) -> list[str]:
    """Return what is doubtful about a case before a run, its ratings among it."""
    one = chain_case(case)
    return [*case.warnings, *rating_warnings(one.drive.ratings(one))]
