"""Tensions of the spans of a closed chain, loads of its shafts, and what its joints lose in friction."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from wearsim.chain.chain_loop import ChainLoop
from wearsim.chain.loop_path import FULL_TURN, Floats
from wearsim.errors import CaseError, Fault
from wearsim.quantities import grouped

_ROUNDING = 1e-12
"""Part of a vector below which a component is what rounding left of none."""


@dataclass(frozen=True)
class SpanLevel:
    """What sets the level of all tensions: a span of given tension, or a force on a wheel.

    Examples
    --------
    A force that pulls the second wheel to the right:

    >>> SpanLevel(80.0, wheel=1, direction=(1.0, 0.0)).span is None
    True
    """

    force: float  # of the span without its centrifugal part, or on the wheel [N], above 0
    span: int | None = None  # the span that has this tension
    wheel: int | None = None  # the wheel on which the force acts, where no span is given
    direction: tuple[float, float] = (0.0, 0.0)  # unit vector of that force


@dataclass(frozen=True, eq=False)
class LoopForces:
    """Forces in a loop that runs steadily.

    Examples
    --------
    Equal wheels, a pull of 1000 N on a slack span of 50 N: the shafts bear both spans.

    >>> from wearsim.chain.chain_loop import Wheel
    >>> loop = ChainLoop(10.0, (Wheel("driver", (0.0, 0.0), 20), Wheel("driven", (300.0, 0.0), 20)))
    >>> forces = loop_forces(loop, 1000.0, (1.0, -1.0), SpanLevel(50.0, span=0))
    >>> forces.tensions.tolist(), forces.shaft_loads.round(6).tolist()
    ([50.0, 1050.0], [1100.0, 1100.0])
    """

    loop: ChainLoop
    tensions: Floats  # of span i, from wheel i to the next one, without the centrifugal part [N], shape (n,)
    centrifugal: float  # q v^2, which loads the joints and no wheel [N]
    friction_lever: float  # coefficient of friction of the joints times the radius of their pins [mm]
    idle: tuple[bool, ...]  # wheels whose shaft gives and takes nothing

    @property
    def arriving(self) -> Floats:
        """Tension of the span that arrives at each wheel [N], shape (n,)."""
        return np.roll(self.tensions, 1)

    @property
    def pulls(self) -> Floats:
        """What each wheel takes off the chain's tension [N], shape (n,); below 0 where the chain drives it.

        Equation physics.md (D7).
        """
        return self.arriving - self.tensions

    @property
    def losses(self) -> Floats:
        """Friction work of the joints over the way of the chain at each wheel [N], shape (n,).

        Equation physics.md (D8).
        """
        turned = FULL_TURN / self.loop.teeth
        pulled = self.arriving + self.tensions + 2.0 * self.centrifugal
        return self.friction_lever * turned * pulled / self.loop.chain_pitch

    @property
    def shaft_pulls(self) -> Floats:
        """Power of each shaft over the chain's speed [N], shape (n,); above 0 where the shaft drives."""
        found: Floats = np.where(self.idle, 0.0, self.pulls + self.losses)
        return found

    @property
    def torques(self) -> Floats:
        """Torque that each shaft gives the wheel in the sense in which it turns [N mm], shape (n,)."""
        return self.shaft_pulls * self.loop.mean_radii

    @cached_property
    def efficiency(self) -> float:
        """Power that the driven shafts receive over that which the drivers give."""
        shafts = self.shaft_pulls
        return float(-shafts[shafts < 0.0].sum() / shafts[shafts > 0.0].sum())

    @property
    def shaft_vectors(self) -> Floats:
        """Force of the chain on each shaft [N], shape (n, 2), centrifugal part left out, which none bears.

        Equation physics.md (D9).
        """
        directions = self.loop.directions
        arriving = np.roll(directions, 1, axis=0)
        return self.tensions[:, None] * directions - self.arriving[:, None] * arriving

    @property
    def shaft_loads(self) -> Floats:
        """Size of the force on each shaft [N], shape (n,)."""
        return np.array(np.hypot(*self.shaft_vectors.T))

    @property
    def shaft_directions(self) -> Floats:
        """Direction of the force on each shaft, from x towards y [rad], shape (n,)."""
        return direction_angles(self.shaft_vectors)


def direction_angles(vectors: Floats) -> Floats:
    """Return the directions of vectors from x towards y [rad], shape (n,).

    A component that only rounding left counts as none.

    Examples
    --------
    >>> direction_angles(np.array([[1000.0, -1e-13], [-1000.0, -1e-13], [3e-14, 500.0]])).tolist()
    [0.0, 3.141592653589793, 1.5707963267948966]
    """
    size = np.hypot(*vectors.T)[:, None]
    x, y = np.where(np.abs(vectors) > _ROUNDING * size, vectors, 0.0).T
    return np.array(np.arctan2(y, x))


def loop_forces(
    loop: ChainLoop,
    pull: float,
    shares: Sequence[float],
    level: SpanLevel,
    friction_lever: float = 0.0,
    centrifugal: float = 0.0,
) -> LoopForces:
    """Return the tensions of all spans from the balance of every wheel.

    A driver takes its share of the pull off the tension, a driven wheel adds its share of what the idlers
    leave of it, an idler adds the friction of the joints that turn on it. What joints lose on drivers and
    driven wheels comes from their shafts.

    Equations physics.md (D7) and (D8).

    Parameters
    ----------
    loop : ChainLoop
        The wheels.
    pull : float
        Sum of what the drivers take off the tension, power over speed in the chain [N], above 0.
    shares : sequence of float
        Share of each wheel in it: above 0 for drivers, which sum to 1, below 0 for driven ones, which
        sum to -1, 0 for idlers.
    level : SpanLevel
        What the tensions start from.
    friction_lever : float
        Coefficient of friction of the joints times the radius of their pins [mm].
    centrifugal : float
        Tension that the chain's speed adds to every span [N].

    Returns
    -------
    LoopForces
        Tensions, shaft loads and losses.

    Raises
    ------
    CaseError
        Drivers and driven wheels do not balance, or a span would be pushed.

    Examples
    --------
    Two driven wheels share a pull of 1000 N as 7 to 3:

    >>> from wearsim.chain.chain_loop import Wheel
    >>> places = (0.0, 0.0), (300.0, 0.0), (150.0, 250.0)
    >>> wheels = [Wheel(name, place, 20) for name, place in zip("abc", places)]
    >>> forces = loop_forces(ChainLoop(10.0, wheels), 1000.0, (1.0, -0.7, -0.3), SpanLevel(50.0, span=0))
    >>> forces.tensions.round(6).tolist()
    [50.0, 750.0, 1050.0]
    """
    given = np.array(shares, float)
    count = len(loop.wheels)
    if given.shape != (count,) or not (
        abs(given[given > 0.0].sum() - 1.0) < 1e-9 and abs(given[given < 0.0].sum() + 1.0) < 1e-9
    ):
        message = (
            "the shares of drivers must sum to 1 and those of driven wheels to -1, are "
            f"{', '.join(f'{share:g}' for share in given)}: correct them"
        )
        raise CaseError([Fault(f"chain loop: {message}")])
    # Unknown are the tensions and what the driven wheels take together.
    matrix, right = np.zeros((count + 1, count + 1)), np.zeros(count + 1)
    idle = given == 0.0
    lost = friction_lever * FULL_TURN / (loop.teeth * loop.chain_pitch)
    for i in range(count):
        rubbed = lost[i] if idle[i] else 0.0
        matrix[i, i] += 1.0 - rubbed
        matrix[i, (i - 1) % count] -= 1.0 + rubbed
        right[i] = 2.0 * rubbed * centrifugal - max(given[i], 0.0) * pull
        matrix[i, count] = min(given[i], 0.0)
    if level.span is not None:
        matrix[count, level.span] = 1.0
        right[count] = level.force
    else:
        assert level.wheel is not None
        along = loop.directions @ np.array(level.direction)
        matrix[count, level.wheel] = along[level.wheel]
        matrix[count, (level.wheel - 1) % count] -= along[level.wheel - 1]
        right[count] = -level.force
        if abs(along[level.wheel] - along[level.wheel - 1]) < 1e-6:
            name = loop.wheels[level.wheel].name
            message = (
                f"the force on wheel {name!r} must tension the chain, but acts across its spans: change its "
                "direction"
            )
            raise CaseError([Fault(f"chain loop: {message}")])
    found: Floats = np.array(np.linalg.solve(matrix, right)[:count], float)
    if found.min() <= 0.0:
        span = loop.span_name(int(found.argmin()))
        message = (
            f"every span must be in tension, {span} would have {grouped(found.min())} N: use more "
            "tension at the take-up, reverse its force, or put it on the slack side, where the chain leaves "
            "a driver"
        )
        raise CaseError([Fault(f"chain loop: {message}")])
    return LoopForces(loop, found, centrifugal, friction_lever, tuple(bool(one) for one in idle))


def looser_span(loop: ChainLoop, shares: Sequence[float]) -> int:
    """Return the span of the least tension, whatever its level; friction of idlers left out.

    Examples
    --------
    >>> from wearsim.chain.chain_loop import Wheel
    >>> loop = ChainLoop(10.0, (Wheel("driven", (0.0, 0.0), 20), Wheel("driver", (300.0, 0.0), 20)))
    >>> looser_span(loop, (-1.0, 1.0))  # it leaves the driver
    1
    """
    tensions = -np.cumsum(np.array(shares, float))
    # Of spans of one tension, on both sides of an idler, the longest hangs deepest.
    loosest = np.flatnonzero(tensions < tensions.min() + 1e-9)
    return int(loosest[loop.span_lengths[loosest].argmax()])


def inclination(loop: ChainLoop, span: int) -> float:
    """Return the angle of a span to the horizontal, from 0 to pi/2 [rad]."""
    return math.asin(min(1.0, abs(float(loop.directions[span, 1]))))
