"""Everything about a case that can be found without a run, as ``wearsim check`` shows it."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from wearsim._version import ANSWER_HEAD
from wearsim.case.model import Case
from wearsim.chain.rating_findings import rating_warnings
from wearsim.drive.case_input import CaseInput, loaded
from wearsim.drive.drive_case import DriveCase
from wearsim.report.answer_table import table_of
from wearsim.report.drive.layout import layout_json, layout_text
from wearsim.report.public_answer import Answer
from wearsim.report.rating import notes_text, rating_json, rating_text
from wearsim.report.text_lines import counted_assumptions

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, repr=False)
class CheckResult(Answer):
    """What is known of a case before a run.

    Attributes
    ----------
    case : Case or DriveCase
        What was checked.
    """

    _tables = ("ratings",)

    case: Case | DriveCase

    @property
    def title(self) -> str:
        """What the case is about."""
        return self.case.title

    @property
    def headline(self) -> str:
        """Whether a rating is not kept."""
        outside = [one["name"] for one in self._content().get("rating", ()) if not one["ok"]]
        return f"outside: {', '.join(outside)}" if outside else "ok"

    @property
    def text(self) -> str:
        """Ratings, notes and warnings in words, and how much is assumed."""
        return check_text(self.case, f"{self.title}: {self.headline}")

    @property
    def explained(self) -> str:
        """The text with every assumption and default."""
        return check_text(self.case, f"{self.title}: {self.headline}", explain=True)

    @property
    def assumptions(self) -> tuple[str, ...]:
        """What was taken for granted."""
        return tuple(self._content()["assumptions"])

    @property
    def ratings(self) -> "pd.DataFrame":
        """What the handbooks allow, a row for each rating; empty where none applies."""
        return table_of(self._content().get("rating", ()))

    def _content(self) -> dict[str, Any]:
        return check_json(self.case)


def check(case: CaseInput) -> CheckResult:
    """Find everything about a case that takes no run: complete, feasible, within the ratings.

    Parameters
    ----------
    case : Case, DriveCase, path or mapping
        One sprocket, a gear pair or a whole drive.

    Returns
    -------
    CheckResult
        Ratings, assumptions and warnings.

    Raises
    ------
    CaseError
        What is wrong with it; all of it at once.

    Examples
    --------
    >>> import wearsim
    >>> tables = {
    ...     "format_version": 1,
    ...     "chain": {"designation": "08B-1"},
    ...     "sprocket": {"teeth": 19, "profile": "iso606"},
    ...     "drive": {"mate_teeth": 38, "links": 100, "slack_tension_N": 50},
    ...     "load": {"tension_N": 500, "speed_rpm": 60},
    ...     "wear": {"condition": "hardened, oiled"},
    ... }
    >>> ratings = wearsim.check(tables).ratings
    >>> power = float(ratings.set_index("name").value["plate fatigue"])
    >>> round(power, 6)  # (500 - 50) N at 19 teeth of 12.7 mm in a second, in kW
    0.108585
    """
    found = loaded(case)
    found.check()
    return CheckResult(found)


def check_json(case: Case | DriveCase) -> dict[str, Any]:
    """Return what is known of a case without a run as ``wearsim check --json`` prints it."""
    return {
        **ANSWER_HEAD,
        "case": case.name,
        **_layout(case),
        "assumptions": list(_assumptions(case)),
        "warnings": _warnings(case),
        **rating_json(case.chain_case),
    }


def check_text(case: Case | DriveCase, head: str, explain: bool = False) -> str:
    """Return what is known of a case without a run in words, below a head."""
    one = case.chain_case
    assumptions = _assumptions(case)
    lines = [
        head,
        layout_text(case) if isinstance(case, DriveCase) else "",
        *([f"  assumes  {text}" for text in assumptions] if explain else []),
        rating_text(one),
        notes_text(one),
        *(f"  warning  {text}" for text in _warnings(case)),
        *([] if explain else [f"  assumes  {counted_assumptions(assumptions)}"]),
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
    from wearsim.drive.validity import film_assumptions

    return (*film_assumptions(case), *case.assumptions)


def _warnings(case: Case | DriveCase) -> list[str]:
    """Return what is doubtful about a case before a run, its ratings among it."""
    one = case.chain_case
    return [*case.warnings, *rating_warnings(one.drive.ratings(one))]
