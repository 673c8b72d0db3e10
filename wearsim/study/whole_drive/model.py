"""Lives of all parts of a drive on one clock."""

import math
import os
import threading
from collections.abc import Callable
from concurrent.futures import FIRST_EXCEPTION, ThreadPoolExecutor, wait
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING

from wearsim.chain.selection import RatingFinding, rating_warnings
from wearsim.errors import ContactError, ConvergenceError, WearsimError
from wearsim.notebook import html_rows, one_line
from wearsim.report.answer import hours
from wearsim.report.events import Event, drive_events
from wearsim.result import Life, LowerBound, WearResult
from wearsim.result.ends import PartEnd, part_ends
from wearsim.result.second_opinions import SecondOpinions
from wearsim.simulation import simulate
from wearsim.simulation.wrap_life import part_band
from wearsim.study.whole_drive.keys import DriveCase, DriveSprocket
from wearsim.study.whole_drive.said_of_sprockets import said_of_sprockets

if TYPE_CHECKING:
    from matplotlib.figure import Figure

CHAIN = "chain"


class _GivenUpError(Exception):
    """Nobody waits for the runs of a drive any more."""


@dataclass(frozen=True)
class DriveLife:
    """How long the chain and every sprocket of a drive live.

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

    def complete(self) -> "DriveLife":
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

    def plot(self) -> "Figure":
        """Draw the flanks of all sprockets, new and at the end of their lives.

        Returns
        -------
        matplotlib.figure.Figure
            A notebook shows it; ``savefig`` writes it.
        """
        from wearsim.report.result_pictures import flank_picture

        return flank_picture(self._titled())

    def plot_history(self) -> "Figure":
        """Draw the greatest depth of all sprockets, and the elongation of the chain, over running time.

        Returns
        -------
        matplotlib.figure.Figure
            A notebook shows it; ``savefig`` writes it.
        """
        from wearsim.report.result_pictures import history_picture

        return history_picture(self._titled())

    def plot_loads(self) -> "Figure":
        """Draw the force on each tooth of all sprockets, under a new chain and one at its limit.

        Returns
        -------
        matplotlib.figure.Figure
            A notebook shows it; ``savefig`` writes it.
        """
        from wearsim.report.result_pictures import new_and_grown, tooth_loads_picture

        return tooth_loads_picture({one.name: new_and_grown(one.case) for one in self.drive.sprockets})

    def _titled(self) -> list[WearResult]:
        return [replace(result, title=name) for name, result in self.results.items()]

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
        """Life of the chain and of every sprocket."""
        return {CHAIN: self.chain, **self.sprockets}

    @property
    def first(self) -> str:
        """The part that ends first; empty where none ends within the horizon."""
        ended = {name: life.hours for name, life in self.parts.items() if isinstance(life, Life)}
        return min(ended, key=ended.__getitem__, default="")

    @property
    def life(self) -> Life | LowerBound:
        """Life of the part that ends first, or how long all live at least."""
        parts = self.parts
        return parts[self.first] if self.first else min(parts.values(), key=lambda life: life.hours_run)

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
        pitting = {name: life for one in self.results.values() for name, life in _named_fatigue(one).items()}
        return part_ends({**self.parts, **pitting}, bands, self.reference.ratings)

    @property
    def practice(self) -> SecondOpinions | None:
        """What published rules say of the life of the chain."""
        return self.reference.practice

    @property
    def events(self) -> tuple[Event, ...]:
        """What happens to the chain and the sprockets when, in the order of time."""
        limit = 100.0 * self.drive.driver.drive.joint.elongation_limit
        history = self.reference.history_columns
        return drive_events(self.drive.driver.case.inputs, history, self.chain, limit, self.sprockets)

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
        failed = (f"{name}: no life: {error}" for name, error in self.failed.items())
        return (*failed, *said_of_sprockets(texts, self.drive.wheels))

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is doubtful: first the ratings that are not kept, with the loads and speeds of the driver."""
        return (*rating_warnings(self.reference.ratings), *self.doubts)


def _named_fatigue(result: WearResult) -> dict[str, Life | LowerBound]:
    """Return lives of a sprocket by contact fatigue under the name of the sprocket."""
    return {f"{result.case}_fatigue": life for life in result.fatigue.values()}


def drive_life(
    drive: DriveCase,
    least_horizon: float | None = None,
    progress: Callable[[float], None] = lambda part: None,
    threads: int | None = None,
) -> DriveLife:
    """Wear all sprockets of a drive, each with the chains that run on it.

    The chain grows by its joints alone, at all sprockets: every sprocket meets the same chains at the
    same times, and each is worn on its own. Where the run of one fails the others go on.

    Parameters
    ----------
    drive : DriveCase
        Sprockets and chain.
    least_horizon : float, optional
        Hours that the runs cover at least if nothing ends before; above 0.
    progress : callable, optional
        Told how much of the runs is done, from 0 to 1.
    threads : int, optional
        Sprockets that run side by side; as many as there are cores where it is left out.

    Returns
    -------
    DriveLife
        Results of all sprockets, and what the runs of some have failed with.

    Raises
    ------
    WearsimError
        As `wearsim.simulate` does for the case of a sprocket, where no run comes to its end.
    """
    done = dict.fromkeys((one.name for one in drive.sprockets), 0.0)
    lock, given_up = threading.Lock(), threading.Event()

    def _watch(name: str) -> Callable[[float], None]:
        def _report(part: float) -> None:
            if given_up.is_set():
                raise _GivenUpError
            with lock:
                done[name] = part
                progress(math.fsum(done.values()) / len(done))

        return _report

    def _run(one: DriveSprocket) -> WearResult | WearsimError:
        report = _watch(one.name)
        report(0.0)  # may end what nobody waits for before it begins
        try:
            return simulate(one.case.with_horizon(least_horizon or 0.0), report)
        except (ContactError, ConvergenceError) as error:
            report(1.0)
            return error

    with ThreadPoolExecutor(max_workers=threads or os.cpu_count()) as pool:
        runs = {one.name: pool.submit(_run, one) for one in drive.sprockets}
        try:
            ended, _ = wait(runs.values(), return_when=FIRST_EXCEPTION)
        finally:
            given_up.set()  # the user has stopped them
        ends = {name: run.result() for name, run in runs.items() if run in ended}
    results = {name: end for name, end in ends.items() if isinstance(end, WearResult)}
    failed = {name: end for name, end in ends.items() if isinstance(end, WearsimError)}
    found = DriveLife(drive, results, failed)
    return found if results else found.complete()
