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
from wearsim.errors import WearsimError
from wearsim.result import Life, LowerBound, life_of
from wearsim.simulation.flank_grids import LEVELS, GridSearch, SettledLife, settle_grid
from wearsim.simulation.lubricant import late_relubrication
from wearsim.simulation.validity import few_cycles, low_contact_ratio_in_the_end, wide_contact
from wearsim.simulation.wear_task import WearTask, wear_tasks
from wearsim.wear.accuracy import depth_missed
from wearsim.wear.flank_batch import BatchFlank, BatchResult, advance_batch

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
    # lives of the parts of a whole drive; a cassette is one
    parts: Mapping[str, Life | LowerBound] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class _FlankJob:
    """A flank of a case on one grid, for a batch."""

    task: WearTask

    @property
    def flank(self) -> BatchFlank:
        task, limit = self.task, self.task.stop_limits[0].limit
        horizon = task.horizon * task.law.coefficient
        return BatchFlank(task.contact, task.law, limit, horizon, task.life_tolerance)

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
        numbers = contact.modulus, task.stop_limits[0].limit, task.life_tolerance
        return (*self.kind, *numbers, *(array.tobytes() for array in arrays))

    def run(self, worn: BatchResult | None) -> "_BatchRun | None":
        """Return what came of it; None where it has no life."""
        if worn is None:
            return None
        task, coefficient = self.task, self.task.law.coefficient
        horizon = task.horizon * coefficient
        # Of cases that share a run, one that ends at its own horizon was run to another's.
        if worn.horizon > horizon and (1.0 + task.life_tolerance) * worn.time > horizon:
            raise _AloneError
        steady = np.array([worn.time if worn.reached else horizon]) / coefficient
        return _BatchRun(task, worn, float(task.clock.running_cycles(steady)[0]))


@dataclass(frozen=True, eq=False)
class _BatchRun:
    """A run on one grid."""

    task: WearTask
    worn: BatchResult
    cycles: float

    @property
    def spacing(self) -> float:
        return self.task.contact.end_spacing

    @property
    def own_error(self) -> float:
        missed = depth_missed(self.worn.x, self.worn.y, self.worn.depth)
        return self.worn.change * self.task.clock.amplification + missed

    def change(self, other: "_BatchRun") -> float:
        if self.worn.reached and other.worn.reached:
            return abs(other.cycles / self.cycles - 1.0)
        if self.worn.reached or other.worn.reached:
            raise _AloneError
        return abs(float(other.worn.depth.max()) / float(self.worn.depth.max()) - 1.0)


class _AloneError(Exception):
    """A case whose runs in batches do not tell its life."""


class _CaseJob:
    """A case on its way through batches: the flanks that it wants worn next, or its life."""

    def __init__(self, case: Case) -> None:
        self._case = case
        mechanism, tolerance = case.drive.mechanism(case), case.run.life_tolerance
        self._search: GridSearch[_BatchRun] = settle_grid(mechanism, tolerance, LEVELS)
        self._begun = False
        self.settled: SettledLife[_BatchRun] | None = None
        self.wanted = self._wanted(next(self._search))

    def _wanted(self, contacts: list[FlankContact]) -> list[_FlankJob]:
        return [_FlankJob(task) for task in wear_tasks(self._case, contacts)]

    def send(self, flanks: Sequence[BatchResult | None]) -> None:
        """Go on with what came of the flanks, if that tells all of the case's own life."""
        wanted, self.wanted, first = self.wanted, [], not self._begun
        self._begun = True
        try:
            runs = [one.run(worn) for one, worn in zip(wanted, flanks, strict=True)]
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


_Batch = tuple[list[list[_FlankJob]], "Future[list[BatchResult | None]]"]
"""Flanks of equal wear, one list a run, and what comes of the runs."""


def _job(case: Case) -> _CaseJob | None:
    """Return the job of a case; None where it runs alone, to its error if it has one."""
    alone = case.drive.rests or case.fatigue is not None
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
            flanks = [
                replace(group[0].flank, horizon=max(wanted.flank.horizon for wanted in group))
                for group in part
            ]
            batches.append((part, pool.submit(advance_batch, flanks)))
    return batches


def _collect(jobs: list[_CaseJob | None], batches: list[_Batch]) -> None:
    """Wait for batches and hand the jobs what came of their flanks."""
    found: dict[int, BatchResult | None] = {}
    for groups, future in batches:
        for group, worn in zip(groups, future.result(), strict=True):
            found.update((id(wanted), worn) for wanted in group)
    for job in jobs:
        if job is not None and job.wanted:
            job.send([found[id(wanted)] for wanted in job.wanted])


def _life(case: Case, job: _CaseJob | None) -> CaseLife | WearsimError:
    """Return the life of a case: of its job, or alone where that does not tell all of it."""
    if job is None or job.settled is None:
        return _alone(case)
    settled, run = job.settled, job.settled.run
    worn, contact = run.worn, run.task.contact
    warnings = [
        *case.warnings,
        *settled.warnings(case.run.life_tolerance),
        *wide_contact(contact, worn.half_width),
    ]
    if worn.reached:
        warnings += few_cycles(run.cycles)
    life = life_of(run.cycles, case.cycles_per_hour, worn.reached)
    warnings += low_contact_ratio_in_the_end(settled.mechanism.worn_contact_ratio(worn.x, worn.y))
    warnings += late_relubrication(case, run.task.clock.lubricant, {"flank": life})
    return CaseLife(
        case.name,
        life,
        run.task.stop_limits[0].name if worn.reached else "horizon_hours",
        settled.error,
        tuple(warnings),
    )


def _alone(case: Case) -> CaseLife | WearsimError:
    from wearsim.simulation import simulate

    try:
        result = simulate(case)
    except WearsimError as error:
        return error
    by_fatigue = result.governing in result.fatigue
    stop = str(result.governing) if by_fatigue else result.stop
    return CaseLife(case.name, result.earliest_life, stop, result.numerical_error, result.warnings)
