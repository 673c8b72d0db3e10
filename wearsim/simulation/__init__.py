"""The one place that wires case, mechanism, wear engine and result."""

from collections.abc import Callable

from wearsim.case.model import Case, WrapDrive
from wearsim.result import WearResult

__all__ = ["simulate"]


def simulate(case: Case, progress: Callable[[float], None] = lambda part: None) -> WearResult:
    """Wear the sprocket of a case until its first limit and return its life.

    Parameters
    ----------
    case : Case
        A complete case.
    progress : callable, optional
        Told by a wrap how much of its run is done, from 0 to 1; from 0 again where a run
        with smaller steps follows.

    Returns
    -------
    WearResult
        Complete: life or lower bound, its band, history and worn flanks.

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
    # Kernels compile where their module is imported for the first time: only those needed.
    if isinstance(case.drive, WrapDrive):
        from wearsim.simulation.loads import check_hold
        from wearsim.simulation.wrap import simulate_wrap

        check_hold(case)
        return simulate_wrap(case, case.drive, progress)
    from wearsim.simulation.pointwise import simulate_points

    return simulate_points(case)
