"""Lives of cases of any kind: one sprocket, a pair of gears, a whole drive."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from itertools import groupby
from os import PathLike
from typing import TYPE_CHECKING, Any, cast, overload

from wearsim.case.model import Case
from wearsim.drive.part_life import simulate as simulate_single
from wearsim.errors import WearsimError
from wearsim.result import Life, WearResult

if TYPE_CHECKING:
    from wearsim.drive.batch_lives import CaseLife
    from wearsim.drive.case_input import CaseInput
    from wearsim.drive.drive_case import DriveCase
    from wearsim.drive.drive_result import DriveLife


@overload
def simulate(case: Case, progress: Callable[[float], None] = ...) -> WearResult: ...


@overload
def simulate(case: "DriveCase", progress: Callable[[float], None] = ...) -> "DriveLife": ...


@overload
def simulate(
    case: str | PathLike[str] | Mapping[str, Any], progress: Callable[[float], None] = ...
) -> "WearResult | DriveLife": ...


def simulate(
    case: "CaseInput", progress: Callable[[float], None] = lambda part: None
) -> "WearResult | DriveLife":
    """Wear the sprocket of a case, or all of a drive, until the first limit and return the life.

    Parameters
    ----------
    case : Case, DriveCase, path or mapping
        One sprocket, a gear pair or a whole drive: a loaded case, the path of its file, the name of a shipped
        case, or its tables.
    progress : callable, optional
        Called with the fraction done, from 0 to 1, which never falls. Short runs do not call it.

    Returns
    -------
    WearResult or DriveLife
        Complete: life or lower bound, its band, history and worn flanks; of a drive those of every
        sprocket, and the life of the chain.

    Raises
    ------
    CaseError
        The chain jumps on new teeth.
    ContactError
        The contact leaves its theory or vanishes.
    ConvergenceError
        The life would be wrong.

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
    >>> result = wearsim.simulate(case)
    >>> result.life.hours == result.life.cycles / (60 * 100)
    True
    """
    if isinstance(case, Case):
        return simulate_single(case, progress)
    # Not above: one sprocket starts without what only whole drives take.
    from wearsim.drive.case_input import loaded
    from wearsim.drive.life import drive_life

    found = loaded(case)
    return simulate_single(found, progress) if isinstance(found, Case) else drive_life(found, progress)


def simulate_many(
    cases: "Iterable[CaseInput]", threads: int | None = None
) -> "Iterator[CaseLife | WearsimError]":
    """Find the lives of many cases.

    Cases on a strand or under a table of loads whose only limit is the critical depth run
    in compiled batches on all threads; of those that differ only in the wear coefficient
    one runs, as their lives times coefficient are the same. All others run one by one.
    So do those with contact fatigue, whose lives end by that or by wear, whichever is first, and whole
    drives, whose lives are those of the part that ends first.
    Neither cases nor results are kept: memory does not grow with their number.

    Parameters
    ----------
    cases : iterable of Case, DriveCase, path or mapping
        Taken as they are needed.
    threads : int, optional
        As many as the machine has cores where it is left out.

    Yields
    ------
    CaseLife or WearsimError
        For each case, in their order; the error that `simulate` would raise.

    Raises
    ------
    CaseError
        A path or a mapping that is no case.

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
    from wearsim.drive.batch_lives import batched_lives
    from wearsim.drive.case_input import loaded

    for single, group in groupby(map(loaded, cases), key=lambda case: isinstance(case, Case)):
        lives = batched_lives if single else _drive_lives
        yield from lives(cast("Iterable[Any]", group), threads)


def _drive_lives(
    drives: "Iterable[DriveCase]", threads: int | None = None
) -> "Iterator[CaseLife | WearsimError]":
    from wearsim.drive.life import drive_life

    for drive in drives:
        try:
            yield _case_life(drive_life(drive, threads=threads).complete())
        except WearsimError as error:
            yield error


def _case_life(found: "DriveLife") -> "CaseLife":
    from wearsim.drive.batch_lives import CaseLife
    from wearsim.drive.maintenance import part_lives

    lives = part_lives(found)
    ended = {name: life.hours for name, life in lives.items() if isinstance(life, Life)}
    return CaseLife(
        found.drive.name,
        found.life,
        min(ended, key=ended.__getitem__, default="horizon_hours"),
        found.numerical_error,
        found.warnings,
        lives,
    )
