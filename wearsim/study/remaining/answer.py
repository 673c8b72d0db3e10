"""What readings in service leave of a life."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, overload

from wearsim.case.model import Case
from wearsim.drive.case_input import CaseInput, loaded
from wearsim.drive.drive_case import DriveCase
from wearsim.errors import Allowed, Range, check_ranges
from wearsim.readings.chain_state import chain_state
from wearsim.readings.dated_rows import readings_file
from wearsim.readings.shared_reading import BAND, check_sprocket, read_reading
from wearsim.report.answer_table import table_of
from wearsim.report.public_answer import Answer
from wearsim.result import Life, LowerBound
from wearsim.result.lives import hours as in_hours
from wearsim.runner.in_threads import Progress, silent
from wearsim.study.remaining.chain_answer import ChainReadingsResult
from wearsim.study.remaining.model import (
    DEPTH,
    ELONGATION,
    OVER_PINS,
    RemainingLife,
    SingleReading,
    from_size,
    read_part,
    remaining_life,
)
from wearsim.study.remaining.sheet import remaining_json, remaining_text

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, repr=False, eq=False)
class RemainingResult(Answer):
    """What is left of the life of the part that was measured.

    Attributes
    ----------
    case : Case
        What was measured.
    found : RemainingLife
        Reading, lives and coefficient as objects.
    """

    _tables = ("parts",)

    case: Case
    found: RemainingLife

    @property
    def title(self) -> str:
        """What the case is about."""
        return self.found.title

    @property
    def headline(self) -> str:
        """The hours that are left, and of which part."""
        return f"{in_hours(self.remaining)} left to the {self.found.part}"

    @property
    def text(self) -> str:
        """What ``wearsim remaining`` prints."""
        return remaining_text(self.found, self.case.inputs)

    @property
    def explained(self) -> str:
        """The text with every assumption and default."""
        return remaining_text(self.found, self.case.inputs, explain=True)

    @property
    def life(self) -> Life | LowerBound:
        """The life from new."""
        return self.found.life

    @property
    def remaining(self) -> Life | LowerBound:
        """The life from the reading on."""
        return self.found.remaining

    @property
    def remaining_low(self) -> Life | LowerBound:
        """The same, had the part worn as much more as the error of the reading."""
        return self.found.remaining_low

    @property
    def remaining_high(self) -> Life | LowerBound:
        """The same, had the part worn as much less as the error of the reading."""
        return self.found.remaining_high

    @property
    def coefficient(self) -> float:
        """The wear coefficient that the reading stands for, in the unit of the case's law."""
        return self.found.coefficient

    @property
    def parts(self) -> "pd.DataFrame":
        """One row: the part, its life and the hours that are left, with their ends; nan where unknown."""
        names = ("life_hours", "remaining_hours", "remaining_hours_low", "remaining_hours_high")
        found = self._content()
        return table_of([{"part": found["part"], **{name: found[name] for name in names}}])

    def _content(self) -> dict[str, Any]:
        return remaining_json(self.found, self.case.inputs)


@overload
def remaining(
    case: CaseInput,
    hours: float,
    *,
    depth: float | None = None,
    over_pins: float | None = None,
    size_over_pins: float | None = None,
    new_over_pins: float | None = None,
    elongation_percent: float | None = None,
    error: float | None = None,
    sprocket: str | None = None,
    progress: Progress = silent,
) -> RemainingResult: ...


@overload
def remaining(
    case: CaseInput, *, reading: str | PathLike[str], sprocket: str | None = None, progress: Progress = silent
) -> RemainingResult: ...


@overload
def remaining(
    case: CaseInput,
    *,
    readings: "str | PathLike[str] | pd.DataFrame | Sequence[Mapping[str, Any]]",
    error: float | None = None,
) -> ChainReadingsResult: ...


def remaining(
    case: CaseInput,
    hours: float | None = None,
    *,
    depth: float | None = None,
    over_pins: float | None = None,
    size_over_pins: float | None = None,
    new_over_pins: float | None = None,
    elongation_percent: float | None = None,
    reading: str | PathLike[str] | None = None,
    readings: "str | PathLike[str] | pd.DataFrame | Sequence[Mapping[str, Any]] | None" = None,
    error: float | None = None,
    sprocket: str | None = None,
    progress: Progress = silent,
) -> RemainingResult | ChainReadingsResult:
    """Return the hours that are left after readings in service.

    One reading takes the place of the wear coefficient of the case: life times coefficient is constant.
    Give hours and one of depth, over_pins, size_over_pins and elongation_percent, or the file of a shared
    reading. Or give readings, all of one chain, for intervals of 50 and 90 %. `calibrate` takes several
    readings of the teeth too.

    Parameters
    ----------
    case : Case, DriveCase, path or mapping
        One sprocket, a gear pair or a whole drive.
    hours : float, optional
        Running hours of the part that was measured, since it was new [h]; of one reading.
    depth : float, optional
        Worn off a tooth at its deepest point [mm].
    over_pins : float, optional
        How much less the measurement over pins is than when new [mm].
    size_over_pins : float, optional
        The measurement over pins of the roller's diameter itself [mm].
    new_over_pins : float, optional
        The same when the sprocket was new [mm]; without it that of the case.
    elongation_percent : float, optional
        Of the chain [%].
    reading : path, optional
        The ``reading.toml`` of a scan: hours, depth and its standard error, of which two are the error.
    readings : path, pandas.DataFrame or sequence of mapping, optional
        Rows of a chain: ``quantity``, ``value``, one of ``time_hours``, ``distance_km`` and ``date``,
        and ``links``, ``result`` and ``error`` where a row needs them.
    error : float, optional
        Of the reading, to either side [mm, of an elongation %]; 0.02 mm or 0.05 % without it. Of
        readings that state none the standard deviation [%].
    sprocket : str, optional
        Which sprocket of a whole drive was measured, by its name; of depth and over_pins only.
    progress : callable, optional
        Called with the fraction done, from 0 to 1.

    Returns
    -------
    RemainingResult or ChainReadingsResult
        ``remaining``, ``remaining_low``, ``remaining_high``, ``life`` and ``coefficient``; of a table
        of readings ``intervals`` and ``readings``.

    Raises
    ------
    TypeError
        None or several of the readings are given, or one without hours.
    GeometryError
        Hours, reading or error are not above 0.
    CaseError
        What is wrong with the case, or the reading cannot be one of its life.
    ContactError, ConvergenceError
        The case cannot be run.

    Examples
    --------
    A tooth at its limit after half of its life wears at twice the coefficient, and has no hours left.

    >>> import wearsim
    >>> case = wearsim.load_case({
    ...     "format_version": 1,
    ...     "chain": {"designation": "16B-1"},
    ...     "sprocket": {"teeth": 20, "profile": "evolute"},
    ...     "load": {"power_kW": 3, "speed_rpm": 100},
    ...     "wear": {"specific_wear_rate_mm2_per_N": 5e-11},
    ...     "stop": {"critical_depth_mm": 0.2},
    ... })
    >>> life = wearsim.simulate(case).life.hours
    >>> left = wearsim.remaining(case, 0.5 * life, depth=0.2)
    >>> round(left.coefficient / 5e-11, 6), left.remaining.hours
    (2.0, 0.0)

    A chain that is read well to have half of its allowance left has as many hours left as it has run.

    >>> wrapped = case.with_({"sprocket.profile": "iso606", "mechanism.kind": "wrap",
    ...     "drive": {"mate_teeth": 40, "links": 120, "slack_tension_N": 10}, "stop.elongation_percent": 1})
    >>> rows = [{"time_hours": 100, "quantity": "elongation_percent", "value": 0.5, "error": 1e-5}]
    >>> round(wearsim.remaining(wrapped, readings=rows).summary()["remaining_hours"], 2)
    100.0
    """
    alone = (hours, depth, over_pins, size_over_pins, new_over_pins, elongation_percent)
    if reading is not None:
        if any(value is not None for value in (*alone, readings, error)):
            raise TypeError("remaining: a reading holds hours, depth and error, must be given without others")
        return _of_shared(loaded(case), Path(reading), sprocket, progress)
    if readings is not None:
        if any(value is not None for value in (*alone, sprocket)):
            raise TypeError("remaining: readings hold hours and values, must be given without others")
        check_ranges("remaining", {"error": error}, {"error": _ABOVE_0})
        found = loaded(case)
        with readings_file(readings) as file:
            state = chain_state(found, file, _USUAL if error is None else error)
        return ChainReadingsResult(state)
    if hours is None:
        raise TypeError("remaining: must be given hours and one reading, or readings")
    given = {
        "depth": depth,
        "over_pins": over_pins,
        "size_over_pins": size_over_pins,
        "elongation_percent": elongation_percent,
    }
    values = [(name, value) for name, value in given.items() if value is not None]
    if len(values) != 1:
        raise TypeError(
            "remaining: must be given one of depth, over_pins, size_over_pins and elongation_percent"
        )
    check_ranges(
        "remaining", {"hours": hours, **given, "new_over_pins": new_over_pins, "error": error}, _ALLOWED
    )
    ((name, value),) = values
    quantity, usual_error = _READINGS[name]
    single = SingleReading(quantity, value, usual_error if error is None else error, hours)
    part = read_part(loaded(case), single, sprocket)
    if name == "size_over_pins":
        single = from_size(part, single, new_over_pins)
    return RemainingResult(part, remaining_life(part, single, progress))


def _of_shared(
    case: Case | DriveCase, file: Path, sprocket: str | None, progress: Progress
) -> RemainingResult:
    """Return what is left after the reading in a file."""
    shared = read_reading(file)
    read = shared.reading
    single = SingleReading(DEPTH, read.depth_mm, BAND * read.depth_se_mm, read.time_hours)
    part = read_part(case, single, sprocket)
    check_sprocket(shared, part, file)
    return RemainingResult(part, remaining_life(part, single, progress))


_ABOVE_0 = Range(above=0.0, optional=True)

_ALLOWED: dict[str, Allowed] = {
    "hours": Range(above=0.0),
    "depth": _ABOVE_0,
    "over_pins": _ABOVE_0,
    "size_over_pins": _ABOVE_0,
    "new_over_pins": _ABOVE_0,
    "elongation_percent": _ABOVE_0,
    "error": _ABOVE_0,
}

_USUAL = 0.05
"""Error of an elongation [%]."""

_READINGS = {
    "depth": (DEPTH, 0.02),
    "over_pins": (OVER_PINS, 0.02),
    "size_over_pins": (OVER_PINS, 0.02),
    "elongation_percent": (ELONGATION, _USUAL),
}
"""What each argument reads, and its usual error."""
