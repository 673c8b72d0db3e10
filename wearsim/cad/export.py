"""The wheel for CAD, and a gauge of its wear limit."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from wearsim._version import ANSWER_HEAD
from wearsim.cad import DRAWINGS, STATES, WHEELS, States, format_by_ending
from wearsim.cad.gauge_sheet import gauge_sheet, is_worn_out, long_enough
from wearsim.cad.wheel_drawing import wheel_points
from wearsim.cad.wheel_formats import check_solid
from wearsim.cad.wheel_formats import export as content
from wearsim.case.model import Case
from wearsim.drive.case_input import CaseInput, loaded
from wearsim.drive.drive_case import DriveCase
from wearsim.drive.drive_result import DriveLife
from wearsim.drive.part_life import simulate
from wearsim.errors import OutputError, check_ranges
from wearsim.files import check_free, write_file
from wearsim.geometry.wheel_outline import State
from wearsim.report.flank_view import case_of
from wearsim.report.public_answer import Answer
from wearsim.report.worn_flank import wheel_shapes
from wearsim.result import WearResult

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, repr=False, eq=False)
class ExportResult(Answer):
    """The wheels of a case.

    Attributes
    ----------
    case : Case
        Whose wheels they are.
    result : WearResult or None
        Its life, where the worn wheel or a gauge takes it.
    states : tuple of str
        ``new``, ``worn``.
    files : tuple of pathlib.Path
        What was written.
    """

    _tables = ("outline",)

    case: Case
    result: WearResult | None
    states: tuple[State, ...]
    files: tuple[Path, ...]

    @property
    def title(self) -> str:
        """What the case is about."""
        return self.case.title

    @property
    def headline(self) -> str:
        """The files that were written."""
        return ", ".join(map(str, self.files)) or "no file written"

    @property
    def text(self) -> str:
        """The files that were written, a line for each."""
        return "\n".join(f"written to {file}" for file in self.files)

    @property
    def outline(self) -> "pd.DataFrame":
        """The points of the wheels [mm], as ``wearsim export --format csv`` writes them."""
        return wheel_points(wheel_shapes(self.case, self.result), self.states)

    def content(self, form: str) -> bytes:
        """Return the wheels as the content of a file.

        Parameters
        ----------
        form : str
            One of ``wearsim export --format``; ``step`` takes the extra ``step``.

        Returns
        -------
        bytes
            What a file of this format holds.

        Raises
        ------
        CaseError
            The wheels cannot be drawn so.
        GeometryError
            There is no such format.
        """
        check_ranges("content", {"form": form}, {"form": tuple(WHEELS)})
        check_solid(self.case, form)
        return content(self.case, self.result, self.states, form)

    def _content(self) -> dict[str, Any]:
        files = list(map(str, self.files))
        return {**ANSWER_HEAD, "case": self.case.name, "states": list(self.states), "files": files}


def export(
    source: CaseInput | WearResult | DriveLife,
    out: str | PathLike[str] | None = None,
    *,
    state: States | None = None,
    template: str | PathLike[str] | None = None,
    sprocket: str | None = None,
    force: bool = False,
) -> ExportResult:
    """Return the wheel of a case or of a result for CAD, and write it where a place is given.

    Parameters
    ----------
    source : Case, DriveCase, WearResult, DriveLife, path or mapping
        What has the wheel; a worn wheel of a case is worn first.
    out : path, optional
        New file of the wheel; its ending is one of the formats of ``wearsim export --format``.
    state : str, optional
        ``new``, ``worn`` or ``both``; without it new for a case, both for a result.
    template : path, optional
        New file of a go/no-go gauge of the wear limit; its ending is one of ``wearsim export --template``.
    sprocket : str, optional
        Which sprocket of a whole drive, by its name. A whole drive needs it: one call exports one wheel.
    force : bool
        Replace the files.

    Returns
    -------
    ExportResult
        Its ``outline``, and the content in any of the formats.

    Raises
    ------
    CaseError
        The case has no such wheel.
    GeometryError
        There is no such state.
    OutputError
        A file is there, or has no such format.

    Examples
    --------
    >>> import wearsim
    >>> wheel = wearsim.export({
    ...     "format_version": 1,
    ...     "chain": {"designation": "08B-1"},
    ...     "sprocket": {"teeth": 19, "profile": "iso606", "tip_diameter_mm": 82.0},
    ...     "drive": {"mate_teeth": 38, "links": 100},
    ...     "load": {"tension_N": 500, "speed_rpm": 60},
    ...     "wear": {"condition": "hardened, oiled"},
    ... })
    >>> round(float((wheel.outline.x_mm**2 + wheel.outline.y_mm**2).max()) ** 0.5, 6)
    41.0
    """
    check_ranges("export", {"state": state}, {"state": (*STATES, None)})
    case, result = _case(source, sprocket)
    states = STATES[state or ("new" if result is None else "both")]
    forms = [_format(out, WHEELS), _format(template, DRAWINGS)]
    if forms[0] and WHEELS[forms[0]].one_state and len(states) > 1:
        raise OutputError(f"{out}: must hold one state of the wheel, but two are given: choose new or worn")
    check_solid(case, forms[0])
    for place in (out, template):
        if place is not None:
            check_free(Path(place), force)
    if result is None and ("worn" in states or template is not None):
        result = simulate(case)
    found = ExportResult(case, result, states, _paths(out, template))
    if out is not None and forms[0] is not None:
        write_file(Path(out), found.content(forms[0]), force)
    if template is not None and forms[1] is not None and result is not None:
        worn_out = result if is_worn_out(result) else simulate(long_enough(case))
        write_file(Path(template), gauge_sheet(case, worn_out, forms[1]), force)
    return found


def _case(source: CaseInput | WearResult | DriveLife, sprocket: str | None) -> tuple[Case, WearResult | None]:
    if isinstance(source, WearResult):
        return replace(case_of(source), name=source.case, title=source.title), source
    found = loaded(source.drive if isinstance(source, DriveLife) else source)
    if not isinstance(found, DriveCase):
        return found, None
    one = found.titled_case(sprocket)
    return one, source.results[sprocket or ""] if isinstance(source, DriveLife) else None


def _format(place: str | PathLike[str] | None, known: Iterable[str]) -> str | None:
    """Return the format of a file by its ending."""
    if place is None:
        return None
    form = format_by_ending(Path(place))
    if form not in known:
        endings = ", ".join(f".{name}" for name in known)
        raise OutputError(f"{place}: must end in one of {endings}: choose another name")
    return form


def _paths(*places: str | PathLike[str] | None) -> tuple[Path, ...]:
    return tuple(Path(place) for place in places if place is not None)
