"""What each tooth of a wrapped sprocket carries."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from wearsim.case.model import Case
from wearsim.drive.case_input import CaseInput, loaded
from wearsim.drive.drive_case import DriveCase
from wearsim.errors import Range, check_ranges
from wearsim.mechanisms.wrap.tooth_loads import ToothLoads, tooth_loads
from wearsim.quantities import grouped
from wearsim.report.answer_table import table_of
from wearsim.report.drive.layout import loads_json_of, loads_text
from wearsim.report.loads_table import loads_json
from wearsim.report.public_answer import Answer

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure


@dataclass(frozen=True, repr=False)
class LoadsResult(Answer):
    """What teeth carry, of a whole drive also its spans and shafts.

    Attributes
    ----------
    case : Case or DriveCase
        What is loaded.
    by_sprocket : dict
        Loads of every sprocket by its name; of the only one by ``sprocket``.
    """

    _tables = ("teeth", "spans", "shafts")

    case: Case | DriveCase
    by_sprocket: dict[str, ToothLoads]

    @property
    def title(self) -> str:
        """What the case is about."""
        return self.case.title

    @property
    def headline(self) -> str:
        """The greatest force on a tooth."""
        greatest = {name: float(one.loads.force.max()) for name, one in self.by_sprocket.items()}
        name = max(greatest, key=greatest.__getitem__)
        return f"greatest force on a tooth {grouped(greatest[name])} N ({name})"

    @property
    def text(self) -> str:
        """What ``wearsim loads`` prints."""
        return loads_text(self.case, self.by_sprocket)

    @property
    def explained(self) -> str:
        """The text with every assumption and default."""
        return loads_text(self.case, self.by_sprocket, explain=True)

    @property
    def teeth(self) -> "pd.DataFrame":
        """A row for each tooth in the wrap, tooth 1 at the tight end: tension, force, place."""
        rows = (
            {"sprocket": name, **row}
            for name, found in self.by_sprocket.items()
            for row in loads_json(found)["teeth"]
        )
        return table_of(rows)

    @property
    def spans(self) -> "pd.DataFrame":
        """Length and tension of every span of a whole drive; empty of one sprocket."""
        return table_of(self._content().get("layout", {}).get("spans", ()))

    @property
    def shafts(self) -> "pd.DataFrame":
        """Load, torque and place of every shaft of a whole drive; empty of one sprocket."""
        return table_of(self._content().get("layout", {}).get("sprockets", ()))

    def _content(self) -> dict[str, Any]:
        return loads_json_of(self.case, self.by_sprocket)

    def plot(self) -> "Figure":
        """Draw the normal force on each tooth.

        Returns
        -------
        matplotlib.figure.Figure
            A panel for each sprocket; a notebook shows it.
        """
        from wearsim.report.result_pictures import tooth_loads_picture

        titles = [self.title] if isinstance(self.case, Case) else list(self.by_sprocket)
        drawn = zip(titles, self.by_sprocket.values(), strict=True)
        return tooth_loads_picture({title: (found,) for title, found in drawn})


def loads(
    case: CaseInput, *, elongation_percent: float = 0.0, phase: float = 1.0, worst: bool = False
) -> LoadsResult:
    """Return what the teeth of a chain drive carry.

    Parameters
    ----------
    case : Case, DriveCase, path or mapping
        A chain that wraps a sprocket, or a whole drive.
    elongation_percent : float
        Elongation of the chain [%].
    phase : float
        Part of a pitch gone since the first roller came in, from 0 to 1.
    worst : bool
        The phase with the largest force on a tooth instead.

    Returns
    -------
    LoadsResult
        ``teeth``, and of a whole drive ``spans`` and ``shafts``.

    Raises
    ------
    CaseError
        The case has no chain that wraps a sprocket.
    GeometryError
        Elongation or phase are outside their ranges.

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
    >>> teeth = wearsim.loads(tables).teeth
    >>> round(float(teeth.tension_N[0]), 6)  # the tight strand's, at the first tooth
    500.0
    """
    check_ranges("loads", {"elongation_percent": elongation_percent, "phase": phase}, _RANGES)
    found = loaded(case)
    part = None if worst else float(phase)
    cases = found.single_cases
    loaded_teeth = {name: tooth_loads(one, 0.01 * elongation_percent, part) for name, one in cases.items()}
    return LoadsResult(found, loaded_teeth)


_RANGES = {"elongation_percent": Range(0.0, 10.0), "phase": Range(0.0, 1.0)}
