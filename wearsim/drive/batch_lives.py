"""Lives of many cases: those of one mechanism together in compiled batches, on all cores."""

import os
from collections import deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from itertools import islice

import numpy as np

from wearsim.case.model import Case
from wearsim.contact.engagement import FlankContact
from wearsim.contact.hertz import half_width
from wearsim.drive.flank_grids import LEVELS, FlankRun, GridSearch, SettledLife, settle_grid
from wearsim.drive.lubricant import late_relubrication
from wearsim.drive.validity import few_cycles, low_contact_ratio_in_the_end, wide_contact
from wearsim.drive.wear_task import WearTask, wear_tasks
from wearsim.errors import WearsimError
from wearsim.kernels.controlled_steps import widest
from wearsim.kernels.hertz_wear import DEPTH, LOAD, RELATIVE, flank_rate
from wearsim.kernels.rosenbrock import WORK_ROWS
from wearsim.result import Life, LowerBound, life_of
from wearsim.wear.advance import StartAndEnd, advance_batch
from wearsim.wear.problem import WearProblem

_BATCH = 32
"""Flanks of one compiled call."""

_AHEAD = 2
"""Chunks that are under way while the one before is handed out."""


@dataclass(frozen=True)
class CaseLife:
    """The life of one case, without the tables of a `WearResult`."""

    case: str  # name of the case
    life: Life | LowerBound  # as `simulate` gives it, to the bit; with contact fatigue its `earliest_life`
    # key of the limit that was met, `horizon_hours` where none was; the name of a life by contact fatigue
    # that ends before, such as `sprocket_fatigue`
    stop: str
    # relative error of the life by its steps and its grid, as `simulate` states it, to rounding
    numerical_error: float
    warnings: tuple[str, ...]  # what is doubtful about the case and the worn flank
    # lives of the parts of a whole drive, a cassette is one; of a wrap those of chain and sprocket
    parts: Mapping[str, Life | LowerBound] = field(default_factory=dict)


Worn = tuple[StartAndEnd, float] | None
"""Start and end of a flank over cycles times coefficient, and the error of its steps, if they are found."""


class _AloneError(Exception):
    """A case whose runs in batches do not tell its life."""


@dataclass(frozen=True, eq=False)
class _BatchRun(FlankRun):
    """A run of which only start and end are known."""

    trajectory: StartAndEnd

    def change(self, other: FlankRun) -> float:
        """Return the relative difference to another that ended in the same way."""
        if (self.trajectory.met is None) != (other.trajectory.met is None):
            raise _AloneError
        return super().change(other)


@dataclass(frozen=True, eq=False)
class _FlankJob:
    """A flank of a case on one grid, for a batch."""

    task: WearTask[FlankContact]

    @property
    def horizon(self) -> float:
        """Cycles times coefficient."""
        return self.task.horizon * self.task.law.coefficient

    def problem(self, horizon: float) -> WearProblem[FlankContact]:
        """Return what is worn for it and for all of equal wear: with coefficient 1 until a horizon."""
        task = self.task
        return WearProblem(task.contact, replace(task.law, coefficient=1.0), task.stop_limits, horizon)

    @property
    def kind(self) -> tuple[object, ...]:
        """What the flanks of one compiled call have in common."""
        contact = self.task.contact
        return contact.kernel, contact.profile.x.size, contact.columns.shape

    @property
    def wear(self) -> tuple[object, ...]:
        """What the wear depends on but for the coefficient, which only scales the cycles."""
        task, contact = self.task, self.task.contact
        arrays = (
            contact.profile.x,
            contact.profile.y,
            contact.constants,
            contact.columns,
            task.law.unit_numbers(contact.kind),
        )
        numbers = contact.modulus, task.depth_limit, task.life_tolerance
        return (*self.kind, *numbers, *(array.tobytes() for array in arrays))

    def run(self, worn: Worn, run_to: float) -> _BatchRun | None:
        """Return what came of a run to a horizon; None where it has no life."""
        if worn is None:
            return None
        (run, change), task = worn, self.task
        # Of cases that share a run, one that ends at its own horizon was run to another's.
        if run_to > self.horizon and (1.0 + task.life_tolerance) * float(run.cycles[-1]) > self.horizon:
            raise _AloneError
        time = float(run.cycles[-1]) if run.met is not None else self.horizon
        cycles = task.clock.running_cycles(np.array([0.0, time]) / task.law.coefficient)
        return _BatchRun(task, replace(run, cycles=cycles), change * task.clock.amplification)


class _CaseJob:
    """A case on its way through batches: the flanks that it wants worn next, or its life."""

    def __init__(self, case: Case) -> None:
        self._case = case
        mechanism, tolerance = case.drive.mechanism(case), case.run.life_tolerance
        self._search: GridSearch = settle_grid(mechanism, tolerance, LEVELS)
        self._begun = False
        self.settled: SettledLife | None = None
        self.wanted = self._wanted(next(self._search))

    def _wanted(self, contacts: list[FlankContact]) -> list[_FlankJob]:
        return [_FlankJob(task) for task in wear_tasks(self._case, contacts)]

    def send(self, flanks: Sequence[tuple[Worn, float]]) -> None:
        """Go on with what came of the flanks, if that tells all of the case's own life."""
        wanted, self.wanted, first = self.wanted, [], not self._begun
        self._begun = True
        try:
            runs = [one.run(*worn) for one, worn in zip(wanted, flanks, strict=True)]
            if not first or runs[0] is not None:
                self.wanted = self._wanted(self._search.send(runs))
        except StopIteration as end:
            self.settled = end.value
        except _AloneError:
            return


def batched_lives(cases: Iterable[Case], threads: int | None = None) -> Iterator[CaseLife | WearsimError]:
    """Give the lives of cases of one sprocket or a pair of gears in their order, as `simulate_many` does."""
    threads = threads or os.cpu_count() or 1
    remaining = iter(cases)
    under_way: deque[tuple[list[Case], list[_CaseJob | None], list[_Batch]]] = deque()
    # Not in a `with`: lives that nobody takes to their end may be finalised by the garbage collector inside
    # `threading`, where a join waits for ever. Threads of a pool that is gone end by themselves.
    pool = ThreadPoolExecutor(threads)
    while True:
        chunk = list(islice(remaining, 2 * _BATCH * threads))
        if chunk:
            jobs = [_job(case) for case in chunk]
            under_way.append((chunk, jobs, _submit(pool, jobs)))
        if len(under_way) > _AHEAD or not chunk:
            if not under_way:
                pool.shutdown()
                return
            chunk, jobs, batches = under_way.popleft()
            while batches:
                _collect(jobs, batches)
                batches = _submit(pool, jobs)
            yield from map(_life, chunk, jobs)


_Batch = tuple[list[list[_FlankJob]], list[float], "Future[list[Worn]]"]
"""Flanks of equal wear, one list a run, the horizons of the runs, and what comes of them."""


def _job(case: Case) -> _CaseJob | None:
    """Return the job of a case; None where it runs alone, to its error if it has one."""
    alone = case.drive.rests or case.fatigue is not None or case.wear.is_own
    if alone or case.run.method != "advance":
        return None
    try:
        job = _CaseJob(case)
    except WearsimError:
        return None
    return None if len(job.wanted[0].task.stop_limits) > 1 else job


def _submit(pool: ThreadPoolExecutor, jobs: list[_CaseJob | None]) -> list[_Batch]:
    """Hand flanks to the pool: those of equal wear as one, until the longest of their horizons."""
    equal: dict[tuple[object, ...], list[_FlankJob]] = {}
    for job in jobs:
        for wanted in job.wanted if job is not None else ():
            equal.setdefault(wanted.wear, []).append(wanted)
    kinds: dict[tuple[object, ...], list[list[_FlankJob]]] = {}
    for group in equal.values():
        kinds.setdefault(group[0].kind, []).append(group)
    batches = []
    for groups in kinds.values():
        for first in range(0, len(groups), _BATCH):
            part = groups[first : first + _BATCH]
            horizons = [max(wanted.horizon for wanted in group) for group in part]
            problems = [group[0].problem(horizon) for group, horizon in zip(part, horizons, strict=True)]
            tolerances = [group[0].task.life_tolerance for group in part]
            batches.append((part, horizons, pool.submit(advance_batch, problems, tolerances)))
    return batches


def _collect(jobs: list[_CaseJob | None], batches: list[_Batch]) -> None:
    """Wait for batches and hand the jobs what came of their flanks."""
    found: dict[int, tuple[Worn, float]] = {}
    for groups, horizons, future in batches:
        for group, worn, run_to in zip(groups, future.result(), horizons, strict=True):
            found.update((id(wanted), (worn, run_to)) for wanted in group)
    for job in jobs:
        if job is not None and job.wanted:
            job.send([found[id(wanted)] for wanted in job.wanted])


def _life(case: Case, job: _CaseJob | None) -> CaseLife | WearsimError:
    """Return the life of a case: of its job, or alone where that does not tell all of it."""
    if job is None or job.settled is None:
        return _alone(case)
    settled, task, run = job.settled, job.settled.run.task, job.settled.run.trajectory
    assert isinstance(run, StartAndEnd)
    cycles, reached = float(run.cycles[-1]), run.met is not None
    warnings = [
        *case.warnings,
        *settled.warnings(case.run.life_tolerance),
        *wide_contact(task.contact, _half_width(task, run)),
    ]
    if reached:
        warnings += few_cycles(cycles)
    life = life_of(cycles, case.cycles_per_hour, reached)
    warnings += low_contact_ratio_in_the_end(settled.mechanism.worn_contact_ratio(run.x[-1], run.y[-1]))
    warnings += late_relubrication(case, task.clock.lubricant, {"flank": life})
    return CaseLife(
        case.name,
        life,
        task.stop_limits[0].name if reached else "horizon_hours",
        settled.error,
        tuple(warnings),
    )


def _half_width(task: WearTask[FlankContact], run: StartAndEnd) -> float:
    """Return the greatest half-width of the contact over the run [mm]."""
    contact, law = task.contact, task.law.unit_numbers(task.contact.kind)
    work = np.empty((WORK_ROWS, contact.profile.x.size))
    state = np.stack([run.x[-1], run.y[-1], run.depth[-1]])
    flank_rate(
        contact.kernel, state, state[DEPTH], contact.constants, contact.columns, contact.modulus, law, work
    )
    return float(half_width(widest(work[LOAD], work[RELATIVE], run.widest), 1.0, contact.modulus))


def _alone(case: Case) -> CaseLife | WearsimError:
    from wearsim.drive.part_life import simulate

    try:
        result = simulate(case)
    except WearsimError as error:
        return error
    by_fatigue = result.governing in result.fatigue
    stop = str(result.governing) if by_fatigue else result.stop
    return CaseLife(
        case.name, result.earliest_life, stop, result.numerical_error, result.warnings, result.parts
    )
