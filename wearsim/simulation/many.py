"""Lives of many cases: those of one mechanism together in compiled batches, on all cores."""

import os
from collections import deque
from collections.abc import Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np

from wearsim.case.model import Case, WrapDrive
from wearsim.contact.engagement import Mechanism
from wearsim.errors import WearsimError
from wearsim.result import Life, LowerBound, life_of
from wearsim.simulation.pointwise import pointwise_mechanism
from wearsim.simulation.task import task
from wearsim.simulation.validity import few_cycles, low_contact_ratio_in_the_end, wide_contact
from wearsim.wear.many import Flank, Worn, advance_many
from wearsim.wear.running_in import RunningIn

_BATCH = 32
"""Flanks of one compiled call."""

_AHEAD = 2
"""Chunks that are under way while the one before is handed out."""


@dataclass(frozen=True)
class CaseLife:
    """The life of one case, without the tables of a `WearResult`.

    Attributes
    ----------
    case : str
        Name of the case.
    life : Life or LowerBound
        As `simulate` gives it, to the bit; with contact fatigue its `earliest_life`.
    stop : str
        Key of the limit that was met, ``horizon_hours`` where none was; the name of a life by
        contact fatigue that ends before, such as ``sprocket_fatigue``.
    numerical_error : float
        Relative error of the life by its steps; that of the grid is not estimated.
    warnings : tuple of str
        What is doubtful about the case and the worn flank.
    """

    case: str
    life: Life | LowerBound
    stop: str
    numerical_error: float
    warnings: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class _Job:
    """A case that goes into a batch."""

    case: Case
    mechanism: Mechanism
    flank: Flank
    limit: str
    running_in: RunningIn
    coefficient: float

    @property
    def kind(self) -> tuple[object, ...]:
        """What the flanks of one compiled call have in common."""
        contact = self.flank.contact
        return contact.kernel, contact.profile.x.size, contact.columns.shape

    @property
    def wear(self) -> tuple[object, ...]:
        """What the wear depends on but for the coefficient, which only scales the cycles."""
        flank, contact = self.flank, self.flank.contact
        arrays = (
            contact.profile.x,
            contact.profile.y,
            contact.constants,
            contact.columns,
            flank.law.unit_numbers(contact.kind),
        )
        numbers = contact.modulus, flank.critical_depth, flank.life_tolerance
        return (*self.kind, *numbers, *(array.tobytes() for array in arrays))


def simulate_many(
    cases: Iterable[Case], threads: int | None = None
) -> Iterator[CaseLife | WearsimError]:
    """Find the lives of many cases.

    Cases on a strand or under a table of loads whose only limit is the critical depth run
    in compiled batches on all threads; of those that differ only in the wear coefficient
    one runs, as their lives times coefficient are the same. All others run one by one.
    So do those with contact fatigue, whose lives end by that or by wear, whichever is first.
    Neither cases nor results are kept: memory does not grow with their number.

    Parameters
    ----------
    cases : iterable of Case
        Complete cases, taken as they are needed.
    threads : int, optional
        As many as the machine has cores where it is left out.

    Yields
    ------
    CaseLife or WearsimError
        For each case, in their order; the error that `simulate` would raise.

    Examples
    --------
    >>> import wearsim
    >>> case = wearsim.load_case({
    ...     "format_version": 1,
    ...     "chain": {"designation": "16B-1"},
    ...     "sprocket": {"teeth": 20, "profile": "evolute"},
    ...     "load": {"power_kW": 3, "speed_rpm": 100},
    ...     "wear": {"condition": "hardened, oiled"},
    ... })
    >>> [found] = wearsim.simulate_many([case])
    >>> found.life == wearsim.simulate(case).life
    True
    """
    threads = threads or os.cpu_count() or 1
    remaining = iter(cases)
    under_way: deque[tuple[list[Case], list[_Job | None], list[_Batch]]] = deque()
    with ThreadPoolExecutor(threads) as pool:
        while True:
            chunk = list(islice(remaining, 2 * _BATCH * threads))
            if chunk:
                jobs = [_job(case) for case in chunk]
                under_way.append((chunk, jobs, _submit(pool, jobs)))
            if len(under_way) > _AHEAD or not chunk:
                if not under_way:
                    return
                yield from _lives(*under_way.popleft())


_Batch = tuple[list[list[_Job]], "Future[list[Worn | None]]"]
"""Jobs of equal wear, one list a flank, and what comes of the flanks."""


def _job(case: Case) -> _Job | None:
    """Return the job of a case; None where it runs alone, to its error if it has one."""
    alone = isinstance(case.drive, WrapDrive) or case.fatigue is not None
    if alone or case.run.method != "advance":
        return None
    try:
        mechanism = pointwise_mechanism(case)
        asked = task(case, mechanism.contact)
    except WearsimError:
        return None
    if len(asked.criteria) > 1:
        return None
    limit, coefficient = asked.criteria[0], asked.law.coefficient
    flank = Flank(
        asked.contact, asked.law, limit.limit, asked.horizon * coefficient, asked.life_tolerance
    )
    return _Job(case, mechanism, flank, limit.name, asked.running_in, coefficient)


def _submit(pool: ThreadPoolExecutor, jobs: list[_Job | None]) -> list[_Batch]:
    """Hand jobs to the pool: those of equal wear as one, until the longest of their horizons."""
    equal: dict[tuple[object, ...], list[_Job]] = {}
    for job in jobs:
        if job is not None:
            equal.setdefault(job.wear, []).append(job)
    kinds: dict[tuple[object, ...], list[list[_Job]]] = {}
    for group in equal.values():
        kinds.setdefault(group[0].kind, []).append(group)
    batches = []
    for groups in kinds.values():
        for first in range(0, len(groups), _BATCH):
            part = groups[first : first + _BATCH]
            flanks = [
                replace(group[0].flank, horizon=max(job.flank.horizon for job in group))
                for group in part
            ]
            batches.append((part, pool.submit(advance_many, flanks)))
    return batches


def _lives(
    cases: list[Case], jobs: list[_Job | None], batches: list[_Batch]
) -> Iterator[CaseLife | WearsimError]:
    found: dict[int, Worn] = {}
    for groups, future in batches:
        for group, worn in zip(groups, future.result(), strict=True):
            if worn is not None:
                found.update((id(job), worn) for job in group)
    for case, job in zip(cases, jobs, strict=True):
        worn = found.get(id(job))
        life = _life(job, worn) if job is not None and worn is not None else None
        yield life or _alone(case)


def _life(job: _Job, worn: Worn) -> CaseLife | None:
    """Return the life of a job; None where that of the batch does not tell all of it."""
    reached = worn.reached and worn.time <= job.flank.horizon
    # Of jobs that share a run, one that ends at its own horizon was run to another's.
    near = 1.0 + job.flank.life_tolerance
    if worn.horizon > job.flank.horizon and near * worn.time > job.flank.horizon:
        return None
    constant = np.array([worn.time if reached else job.flank.horizon]) / job.coefficient
    cycles = float(job.running_in.running_cycles(constant)[0])
    life = life_of(cycles, job.case.cycles_per_hour, reached)
    warnings = [*job.case.warnings, *wide_contact(job.flank.contact, worn.half_width)]
    if reached:
        warnings += few_cycles(cycles)
    warnings += low_contact_ratio_in_the_end(job.mechanism.worn_contact_ratio(worn.x, worn.y))
    stop = job.limit if reached else "horizon_hours"
    error = worn.change * job.running_in.amplification
    return CaseLife(job.case.name, life, stop, error, tuple(warnings))


def _alone(case: Case) -> CaseLife | WearsimError:
    from wearsim.simulation import simulate

    try:
        result = simulate(case)
    except WearsimError as error:
        return error
    by_fatigue = result.governing in result.fatigue
    stop = str(result.governing) if by_fatigue else result.stop
    return CaseLife(case.name, result.earliest_life, stop, result.numerical_error, result.warnings)
