"""The one place that wires case, mechanism, wear engine and result."""

from wearsim.case.model import Case, WrapDrive
from wearsim.result import WearResult
from wearsim.simulation.loads import ToothLoads, check_hold, tooth_loads
from wearsim.simulation.pointwise import simulate_points
from wearsim.simulation.wrap import simulate_wrap

__all__ = ["ToothLoads", "check_hold", "simulate", "tooth_loads"]


def simulate(case: Case) -> WearResult:
    """Wear the sprocket of a case until its first limit and return its life.

    Parameters
    ----------
    case : Case
        A complete case.

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
    if isinstance(case.drive, WrapDrive):
        check_hold(case)
        return simulate_wrap(case, case.drive)
    return simulate_points(case)
