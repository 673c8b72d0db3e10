"""Take-up of a chain loop: the wheel that is moved so that a whole number of links fits."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from wearsim.chain.chain_loop import ChainLoop
from wearsim.chain.loop_path import Floats
from wearsim.errors import CaseError, Fault, GeometryError

_POSITIONS = 65
"""Places along the travel between which a fit is looked for."""


@dataclass(frozen=True)
class TakeUp:
    """A wheel that is moved along a straight guide.

    Raises
    ------
    CaseError
        The direction has no length, or the travel no room.

    Examples
    --------
    >>> TakeUp("driven", (3.0, 4.0), 0.0, 50.0).unit
    (0.6, 0.8)
    """

    wheel: str  # name of the wheel
    direction: tuple[float, float]  # in which the travel counts, of any length
    # least, most: ends of the travel from the place that the loop gives the wheel [mm]
    least: float
    most: float

    def __post_init__(self) -> None:
        if not 0.0 < math.hypot(*self.direction) < math.inf:
            message = f"the direction must have a length, is {self.direction}: give two numbers, not both 0"
            raise CaseError([Fault(f"take-up of {self.wheel!r}: {message}")])
        if not -math.inf < self.least < self.most < math.inf:
            message = (
                f"the travel must increase, is {self.least:g} to {self.most:g} mm: give the smaller end first"
            )
            raise CaseError([Fault(f"take-up of {self.wheel!r}: {message}")])

    @property
    def unit(self) -> tuple[float, float]:
        """Direction of length 1."""
        size = math.hypot(*self.direction)
        return self.direction[0] / size, self.direction[1] / size

    def moved(self, loop: ChainLoop, travel: float) -> ChainLoop:
        """Return the loop with the wheel at a travel [mm]."""
        at = loop.index(self.wheel)
        (x, y), (along_x, along_y) = loop.wheels[at].centre, self.unit
        wheel = replace(loop.wheels[at], centre=(x + travel * along_x, y + travel * along_y))
        return replace(loop, wheels=(*loop.wheels[:at], wheel, *loop.wheels[at + 1 :]))


def fitting_travel(loop: ChainLoop, take_up: TakeUp, links: int, elongation: float = 0.0) -> float:
    """Return the travel of a take-up at which a chain fits without slack, the one nearest to 0.

    Equation physics.md (D6).

    Parameters
    ----------
    loop : ChainLoop
        The wheels with the take-up at its travel 0.
    take_up : TakeUp
        Which wheel moves, and how far it may.
    links : int
        Links X of the chain.
    elongation : float
        Growth of its pitch, from 0 to below 1; rollers ride as much higher on the wheels.

    Returns
    -------
    float
        Travel [mm], within 1e-9 mm.

    Raises
    ------
    CaseError
        No place within the travel makes a loop.
    GeometryError
        The travel gives no room for so many links.

    Examples
    --------
    Two more links than 80 move a wheel by a pitch:

    >>> from wearsim.chain.chain_loop import Wheel
    >>> loop = ChainLoop(10.0, (Wheel("driver", (0.0, 0.0), 20), Wheel("driven", (300.0, 0.0), 20)))
    >>> round(fitting_travel(loop, TakeUp("driven", (1.0, 0.0), 0.0, 50.0), 82), 6)
    10.0
    """
    from scipy.optimize import brentq

    worn = replace(loop, elongation=elongation)

    def excess(travel: float) -> float:
        return take_up.moved(worn, travel).links - links

    places = np.linspace(take_up.least, take_up.most, _POSITIONS)
    found = _where_possible(excess, places)
    signs = np.sign(found)
    brackets = np.flatnonzero(signs[:-1] * signs[1:] <= 0.0)
    if not brackets.size:
        least, most = links + np.nanmin(found), links + np.nanmax(found)
        raise GeometryError(
            f"take-up of {take_up.wheel!r}: {links} links must fit within its travel of {take_up.least:g} to "
            f"{take_up.most:g} mm, which allows {least:.6g} to {most:.6g} links: use another number, or "
            "more travel"
        )
    fits = [float(brentq(excess, places[i], places[i + 1], xtol=1e-10)) for i in brackets]
    return min(fits, key=abs)


def _where_possible(excess: Callable[[float], float], places: Floats) -> Floats:
    """Excess of links at the places, nan where they make no loop; the fault of the last one if all do not."""
    found, fault = np.full(len(places), np.nan), None
    for i, place in enumerate(places):
        try:
            found[i] = excess(place)
        except CaseError as error:
            fault = error
    if fault and np.all(np.isnan(found)):
        raise fault
    return found
