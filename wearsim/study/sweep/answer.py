"""Lives over values of any keys."""

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pandas as pd

from wearsim.drive.case_input import CaseInput, given_input, keys_of, loaded
from wearsim.errors import check_ranges
from wearsim.input.changes import changed
from wearsim.input.document import GivenInput
from wearsim.input.units import in_unit_of, plain_value
from wearsim.quantities import grouped
from wearsim.report.public_answer import DrawnAnswer
from wearsim.report.text_lines import counts_by_kind
from wearsim.runner.in_threads import THREADS, Progress, run, silent
from wearsim.runner.run_study import failures
from wearsim.study.sweep.model import Sweep, load_sweep
from wearsim.study.sweep.sheet import sweep_accuracy, sweep_caution, sweep_json, sweep_text, write_sweep

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True, repr=False, eq=False)
class SweepResult(DrawnAnswer):
    """Lives over values of keys.

    Attributes
    ----------
    study : Sweep
        What was asked.
    cases : pandas.DataFrame
        A row for each case: its values, life, what ended it, warnings, error.
    """

    _tables = ("cases",)

    study: Sweep
    cases: pd.DataFrame

    @property
    def title(self) -> str:
        """What the study is about."""
        return self.study.title

    @property
    def headline(self) -> str:
        """The longest life and its values."""
        lives = self.cases["life_hours"]
        count = f"{len(self.cases)} case{'' if len(self.cases) == 1 else 's'}"
        if not lives.notna().any():
            return f"{count}, no limit reached"
        best = int(lives.fillna(0.0).to_numpy().argmax())
        keys = zip(self.study.design.keys, self.study.design.rows[best], strict=True)
        values = ", ".join(f"{key} = {value}" for key, value in keys)
        return f"{count}, longest life {grouped(lives.iloc[best])} h at {values}"

    @property
    def text(self) -> str:
        """What ``wearsim sweep`` prints."""
        return sweep_text(self.study, self.cases)

    def _content(self) -> dict[str, Any]:
        lines = [json.loads(line) for line in sweep_json(self.study, self.cases)]
        return {"case": self.study.design.name, "cases": lines, "warnings": self._warnings()}

    def _warnings(self) -> list[str]:
        """Return how many cases failed, and warnings that differ in more than their numbers."""
        texts = (text for joined in self.cases["warnings"] for text in filter(None, joined.split("\n")))
        found = [
            f"{count} of {len(self.cases)} cases, such as: {text}" for text, count in counts_by_kind(texts)
        ]
        of_all = failures(self.cases), sweep_caution(self.study, self.cases), sweep_accuracy(self.cases)
        return [*filter(None, of_all), *found]

    def pictures(self) -> "dict[str, Figure]":
        """Return curves, a heat map and parallel coordinates, as far as they suit the study.

        Returns
        -------
        dict of matplotlib.figure.Figure
            ``curves``, ``heat_map``, ``parallel``.
        """
        from wearsim.study.sweep.figure import sweep_figures

        return sweep_figures(self.study, self.cases)

    def _write(self, place: Path) -> None:
        write_sweep(self.study, self.cases, place)


def sweep(
    case: CaseInput,
    grid: Mapping[str, Any] | None = None,
    *,
    together: Sequence[Mapping[str, Sequence[Any]]] = (),
    designs: Sequence[Mapping[str, Any]] = (),
    threads: int | None = None,
    progress: Progress = silent,
) -> SweepResult:
    """Run a case over values of its keys.

    Parameters
    ----------
    case : Case, DriveCase, path or mapping
        The case; without values the input of a study (a .toml with its ``case`` and ``[grid]``).
    grid : mapping, optional
        Values by dotted keys, every combination of which is run: a sequence, or
        ``{"from": 1, "to": 100, "count": 5, "spacing": "log"}``. Text may give a unit. A swept key
        takes the place of what says the same in another way, as in `Case.with_`.
    together : sequence of mapping
        Values of keys that go together, one group each.
    designs : sequence of mapping
        Values as they are, a design each, all of the same keys.
    threads : int, optional
        Cases that run side by side; one a core without it.
    progress : callable, optional
        Called with the fraction done, from 0 to 1.

    Returns
    -------
    SweepResult
        Its table ``cases``, and pictures.

    Raises
    ------
    CaseError
        What is wrong with the case or the values.
    GeometryError
        There must be at least one thread.
    StudyError
        Every case failed.

    Examples
    --------
    A tooth wears as fast as it is loaded and as often: life goes with 1/speed.

    >>> import wearsim
    >>> case = wearsim.load_case({
    ...     "format_version": 1,
    ...     "chain": {"designation": "16B-1"},
    ...     "sprocket": {"teeth": 20, "profile": "evolute"},
    ...     "load": {"tension_N": 3000, "speed_rpm": 100},
    ...     "wear": {"condition": "hardened, oiled"},
    ... })
    >>> hours = wearsim.sweep(case, {"load.speed_rpm": [100, 200]}).cases.life_hours
    >>> round(float(hours[0] / hours[1]), 9)
    2.0
    """
    check_ranges("sweep", {"threads": threads}, {"threads": THREADS})
    if grid is None and not together and not designs:
        study = load_sweep(_study(case))
    else:
        study = _study_of(case, keys_of("grid", grid), together, designs)
    table = run(study.design, threads, progress)
    failures(table)
    return SweepResult(study, table)


def _study(source: CaseInput) -> Path | Mapping[str, Any]:
    if isinstance(source, Mapping):
        return source
    if isinstance(source, str | PathLike):
        return Path(source)
    raise TypeError("sweep: must be given values of keys beside a case: give grid, together or designs")


def _study_of(
    source: CaseInput,
    grid: Mapping[str, Any],
    together: Sequence[Mapping[str, Any]],
    designs: Sequence[Mapping[str, Any]],
) -> Sweep:
    case, given = loaded(source), given_input(source)
    tables = {
        "format_version": 1,
        "title": case.title,
        "case": case.name,
        "grid": _plain(grid),
        "zip": [_plain(group) for group in together],
        "design": [_plain(design) for design in designs],
    }
    return load_sweep(tables, (), _without_replaced(given, tables, case.title))


def _without_replaced(given: GivenInput, tables: Mapping[str, Any], title: str) -> GivenInput:
    """Return the case with the first value of each key, without what that takes the place of."""
    first = dict(changed(given, dict(_first_values(tables))).tables)
    if "title" in first:
        first["title"] = title
    # As if it had been written so: the title is not to tell of first values.
    return replace(given, text="", written=first, tables=first)


def _plain(values: Mapping[str, Any]) -> dict[str, Any]:
    return {key: _plain_values(key, value) for key, value in values.items()}


def _plain_values(key: str, value: Any) -> Any:
    """Return a range, a list of values or one value of a key, texts with a unit as numbers."""
    if isinstance(value, Mapping):
        return {name: in_unit_of(key, plain_value(one)) for name, one in value.items()}
    plain = plain_value(value)
    return [in_unit_of(key, one) for one in plain] if isinstance(plain, list) else in_unit_of(key, plain)


def _first_values(tables: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    for group in (tables["grid"], *tables["zip"]):
        for key, values in group.items():
            if isinstance(values, Mapping):
                yield key, values.get("from")
            elif isinstance(values, list) and values:
                yield key, values[0]
    yield from (tables["design"][0].items() if tables["design"] else ())
