"""The life of a case or of a whole drive."""

from collections.abc import Callable, Mapping
from os import PathLike
from typing import Any, overload

from wearsim.case.model import Case
from wearsim.drive.drive_case import DriveCase
from wearsim.drive.drive_result import DriveLife
from wearsim.drive.simulate import simulate as simulate_loaded
from wearsim.python.case_input import CaseInput, loaded
from wearsim.result import WearResult


@overload
def simulate(case: Case, progress: Callable[[float], None] = ...) -> WearResult: ...


@overload
def simulate(case: DriveCase, progress: Callable[[float], None] = ...) -> DriveLife: ...


@overload
def simulate(
    case: str | PathLike[str] | Mapping[str, Any], progress: Callable[[float], None] = ...
) -> WearResult | DriveLife: ...


def simulate(
    case: CaseInput, progress: Callable[[float], None] = lambda part: None
) -> WearResult | DriveLife:
    """Wear the sprocket of a case, or all of a drive, until the first limit and return the life.

    Parameters
    ----------
    case : Case, DriveCase, path or mapping
        One sprocket, a gear pair or a whole drive; which of them a file is, only its answer tells.
    progress : callable, optional
        Told by a wrap how much of its run is done, from 0 to 1; from 0 again where a run
        with smaller steps follows.

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
    return simulate_loaded(loaded(case), progress)
