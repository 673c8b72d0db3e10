"""Everything about a case that can be found without a run."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from wearsim.case.model import Case
from wearsim.drive.drive_case import DriveCase
from wearsim.python.answer import Answer, table_of
from wearsim.python.case_input import CaseInput, loaded
from wearsim.report.check import check_json, check_text

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

    case: Case | DriveCase

    @property
    def title(self) -> str:
        """What the case is about."""
        return self.case.title

    @property
    def headline(self) -> str:
        """Whether a rating is not kept."""
        outside = [one["name"] for one in self.summary().get("rating", ()) if not one["ok"]]
        return f"outside: {', '.join(outside)}" if outside else "ok"

    @property
    def text(self) -> str:
        """Assumptions, ratings, notes and warnings in words."""
        return check_text(self.case, f"{self.title}: {self.headline}")

    @property
    def assumptions(self) -> tuple[str, ...]:
        """What was taken for granted."""
        return tuple(self.summary()["assumptions"])

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is doubtful."""
        return tuple(self.summary()["warnings"])

    @property
    def ratings(self) -> "pd.DataFrame":
        """What the handbooks allow, a row for each rating; empty where none applies."""
        return table_of(self.summary().get("rating", ()))

    def tables(self) -> "dict[str, pd.DataFrame]":
        """Return the ratings.

        Returns
        -------
        dict of pandas.DataFrame
            ``ratings``.
        """
        return {"ratings": self.ratings}

    def summary(self) -> dict[str, Any]:
        """Return the answer as ``wearsim check --json`` prints it.

        Returns
        -------
        dict
            Plain numbers, strings, lists and None; never nan.
        """
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
