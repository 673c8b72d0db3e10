"""How long all parts of a drive live, on one clock."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from wearsim.chain.rating_findings import RatingFinding, rating_warnings
from wearsim.drive.drive_case import DriveCase, said_of_sprockets
from wearsim.drive.wrap_life import part_band
from wearsim.errors import WearsimError
from wearsim.notebook import html_rows, one_line
from wearsim.result import Life, LowerBound, WearResult
from wearsim.result.ends import CHAIN, PartEnd, before_wear, earliest_life, first_end, part_ends
from wearsim.result.lives import hours
from wearsim.result.second_opinions import SecondOpinions

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

_PICTURES, _JSON = "wearsim.report.result_pictures", "wearsim.report.drive.drive_json"
_FOLDER = "wearsim.report.drive.drive_folder"
"""What shows and writes a result; they know results, and not the other way round."""


@dataclass(frozen=True)
class DriveLife:
    """How long the chain and every sprocket of a drive last.

    Attributes
    ----------
    drive : DriveCase
        What was worn.
    results : dict of WearResult
        Of every sprocket by its name, in the order of the file.
    failed : dict of WearsimError
        What the runs of the others ended with, by their names; none as a rule.
    """

    drive: DriveCase
    results: dict[str, WearResult]
    failed: dict[str, WearsimError] = field(default_factory=dict)

    def complete(self) -> DriveLife:
        """Return this where every sprocket has a life.

        Returns
        -------
        DriveLife
            This.

        Raises
        ------
        ContactError, ConvergenceError
            What the run of a sprocket ended with.
        """
        for name, error in self.failed.items():
            raise type(error)(f"{name!r}: {error}") from error
        return self

    @property
    def reference(self) -> WearResult:
        """Result of the driver, of another sprocket where its run has failed; chain and ratings are alike."""
        return self.results.get(self.drive.driver.name) or next(iter(self.results.values()))

    def __repr__(self) -> str:
        lives = (f"{name} {hours(life)}" for name, life in self.parts.items())
        return one_line("DriveLife", self.drive.title, *lives)

    def _repr_html_(self) -> str:
        lives = [(name, hours(life)) for name, life in self.parts.items()]
        texts = ("assumes", self.drive.assumptions), ("warnings", self.warnings or "none")
        return html_rows(self.drive.title, [*lives, ("first", self.first), *texts])

    def plot(self) -> Figure:
        """Draw the flanks of all sprockets, new and at the end of their lives.

        Returns
        -------
        matplotlib.figure.Figure
            A notebook shows it; ``savefig`` writes it.
        """
        figure: Figure = import_module(_PICTURES).flank_picture(self._titled())
        return figure

    def plot_history(self) -> Figure:
        """Draw the greatest depth of all sprockets, and the elongation of the chain, over running time.

        Returns
        -------
        matplotlib.figure.Figure
            A notebook shows it; ``savefig`` writes it.
        """
        figure: Figure = import_module(_PICTURES).history_picture(self._titled())
        return figure

    def plot_loads(self) -> Figure:
        """Draw the force on each tooth of all sprockets, under a new chain and one at its limit.

        Returns
        -------
        matplotlib.figure.Figure
            A notebook shows it; ``savefig`` writes it.
        """
        pictures = import_module(_PICTURES)
        loads = {one.name: pictures.new_and_grown(one.case) for one in self.drive.sprockets}
        figure: Figure = pictures.tooth_loads_picture(loads)
        return figure

    def _titled(self) -> list[WearResult]:
        return [replace(result, title=name) for name, result in self.results.items()]

    def titled(self) -> list[WearResult]:
        """Return the results of the sprockets under names and titles that say which one of what drive."""
        return [
            replace(result, case=name, title=f"{self.title}: {name}") for name, result in self.results.items()
        ]

    @property
    def title(self) -> str:
        """What the drive is."""
        return self.drive.title

    @property
    def cycles(self) -> float:
        """Loading cycles of the part that ends first; raises where none does."""
        return self.life.cycles

    @property
    def numerical_error(self) -> float:
        """The greatest of the stated relative errors of the sprockets' lives; of depths where none ends."""
        worn = [one for one in self.results.values() if isinstance(one.parts["sprocket"], Life)]
        return max(result.numerical_error for result in worn or self.results.values())

    @property
    def life_tolerance(self) -> float:
        """What was asked for."""
        return self.reference.life_tolerance

    @cached_property
    def history(self) -> pd.DataFrame:
        """The runs over time: a row for every sprocket and snapshot."""
        return self._table("history")

    @cached_property
    def flank(self) -> pd.DataFrame:
        """The worn flanks: a row for every sprocket, snapshot and point."""
        return self._table("flank")

    def _table(self, name: str) -> pd.DataFrame:
        import pandas as pd

        tables = []
        for sprocket, result in self.results.items():
            table = pd.DataFrame(getattr(result, f"{name}_columns"))
            table.insert(0, "sprocket", sprocket)
            tables.append(table)
        return pd.concat(tables, ignore_index=True)

    def summary(self) -> dict[str, Any]:
        """Return the answer as ``wearsim life --json`` prints it.

        Returns
        -------
        dict
            Plain numbers, strings, lists and None; never nan.
        """
        found: dict[str, Any] = import_module(_JSON).drive_json(self)
        return found

    def save(self, folder: str | Path, force: bool = False, parquet: bool = False) -> None:
        """Write the result into a folder, all of it or nothing.

        Parameters
        ----------
        folder : path
            New folder for drive.json, drive.lock.toml, history.csv, flank.csv, ``inputs`` with the
            files of the drive, and ``parts`` with the folder of each sprocket's result.
        force : bool
            Replace a folder that is there.
        parquet : bool
            Write history.parquet and flank.parquet too (extra ``parquet``).

        Raises
        ------
        OutputError
            The folder is there, or cannot be written.
        CaseError
            pyarrow is not installed, which Parquet needs.
        """
        import_module(_FOLDER).write_drive(self, Path(folder), force, parquet)

    @classmethod
    def load(cls, folder: str | Path) -> DriveLife:
        """Read a result that was saved.

        Parameters
        ----------
        folder : path
            Folder with drive.json.

        Returns
        -------
        DriveLife
            Equal to what was saved, number by number.

        Raises
        ------
        OutputError
            The folder does not hold a complete result of this version, or its input is now read
            otherwise, as by other defaults.
        """
        found: DriveLife = import_module(_FOLDER).read_drive(Path(folder))
        return found

    @property
    def named_lives(self) -> dict[str, Life | LowerBound]:
        """Lives of all parts by what they are in words, those that wear does not end first by that too."""
        firsts = [first for name in self.parts if (first := before_wear(self.ends, name))]
        return {
            **{f"life of the {name}": life for name, life in self.parts.items()},
            **{f"life of the {first.part} by {first.mode}": first.life for first in firsts},
        }

    @property
    def chain(self) -> Life | LowerBound:
        """Life of the chain, in cycles of the driver."""
        driver, life = self.drive.driver, self.reference.parts[CHAIN]
        if driver.name in self.results:
            return life
        return type(life)(life.hours_run * driver.case.cycles_per_hour, life.hours_run)

    @property
    def sprockets(self) -> dict[str, Life | LowerBound]:
        """Life of every sprocket by its name, each in its own cycles."""
        return {name: result.parts["sprocket"] for name, result in self.results.items()}

    @property
    def parts(self) -> dict[str, Life | LowerBound]:
        """Life of the chain and of every sprocket by wear."""
        return {CHAIN: self.chain, **self.sprockets}

    @property
    def earliest_lives(self) -> dict[str, Life | LowerBound]:
        """Life of the chain and of every sprocket by what ends it first."""
        return {name: earliest_life(name, life, self.ends) for name, life in self.parts.items()}

    @property
    def first(self) -> str:
        """The part that ends first, by whatever mode; empty where none is known to end."""
        first = first_end(self.ends)
        return "" if first is None else first.part

    @property
    def first_worn(self) -> str:
        """The part that wears out first; empty where none does within the horizon."""
        worn = {name: life.hours for name, life in self.parts.items() if isinstance(life, Life)}
        return min(worn, key=worn.__getitem__, default="")

    @property
    def life(self) -> Life | LowerBound:
        """Life of the part that wears out first, or how long all last at least."""
        parts, first = self.parts, self.first_worn
        return parts[first] if first else min(parts.values(), key=lambda life: life.hours_run)

    def band(self, name: str) -> tuple[Life | LowerBound, Life | LowerBound]:
        """Return the life of a part at the high and at the low end of its wear coefficient.

        The chain's is that of its joints where they take that of a wear condition, else that of the teeth.

        Parameters
        ----------
        name : str
            ``chain``, or that of a sprocket.

        Returns
        -------
        tuple of Life or LowerBound
            The shorter life first.
        """
        if name == CHAIN:
            return part_band(self.drive.driver.case, CHAIN, self.chain)
        case = next(one.case for one in self.drive.sprockets if one.name == name)
        return part_band(case, name, self.sprockets[name])

    def chains_with(self, name: str) -> int:
        """Return how many chains run on a sprocket in its life.

        Parameters
        ----------
        name : str
            Name of the sprocket.

        Returns
        -------
        int
            The one at its end included.
        """
        return int(self.results[name].history_columns["chain"][-1])

    @cached_property
    def ends(self) -> tuple[PartEnd, ...]:
        """Everything that may end a part, that which comes first at the head."""
        bands = {name: self.band(name) for name in self.parts}
        pitting = {
            f"{name}_fatigue": life
            for name, result in self.results.items()
            for life in result.fatigue.values()
        }
        return part_ends({**self.parts, **pitting}, bands, self.reference.ratings)

    @property
    def practice(self) -> SecondOpinions | None:
        """What published rules say of the life of the chain."""
        return self.reference.practice

    @property
    def overloaded(self) -> tuple[RatingFinding, ...]:
        """Ratings that the drive does not meet; all sprockets have the same."""
        return self.reference.overloaded

    @property
    def doubts(self) -> tuple[str, ...]:
        """What is doubtful but the ratings, each once, with the sprockets that it is about."""
        texts = {
            name: [text for text in result.warnings if text not in rating_warnings(result.ratings)]
            for name, result in self.results.items()
        }
        failed = [f"{name}: failed: {error}" for name, error in self.failed.items()]
        first = before_wear(self.ends, CHAIN)
        sooner = [] if first is None else [_chains_end_sooner(self.chain, first)]
        return (*failed, *sooner, *said_of_sprockets(texts, self.drive.wheels))

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is doubtful: first of practice, then the ratings that are not kept, as the driver has them."""
        first = self.practice.warnings if self.practice else ()
        others = (text for text in self.doubts if text not in first)
        return (*first, *rating_warnings(self.reference.ratings), *others)


def _chains_end_sooner(worn: Life | LowerBound, first: PartEnd) -> str:
    return (
        f"sprocket lives assume that every chain runs until it is worn ({hours(worn)}); {first.mode} ends "
        f"its life at {hours(first.life)}, which the tooth wear does not account for"
    )
