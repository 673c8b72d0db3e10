"""A roller chain around a sprocket: tension from tooth to tooth, and where each roller sits."""

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from wearsim.contact.stop_limits import FAR_FROM_JUMPING
from wearsim.errors import ContactError, JumpError
from wearsim.geometry.profile_points import Profile, Vector
from wearsim.geometry.roller_path import RollerPath, WornPath
from wearsim.kernels.wrap_cycle import LOOSEST
from wearsim.kernels.wrap_equilibrium import (
    CENTRE_X,
    CENTRE_Y,
    CONSTANTS,
    FRICTION,
    JUMPED,
    NORMAL_X,
    NORMAL_Y,
    PITCH_ANGLE,
    PITCH_EVEN,
    PITCH_ODD,
    SEATED,
    SLACK_TENSION,
    STALLED,
    STIFFNESS,
    TIGHT_TENSION,
    WORK_ROWS,
    residual,
    solve_wrap,
)
from wearsim.quantities import grouped

_PHASES = 9
"""Phases of a pitch, ends included, in which a chain is tried for jumping."""

_TOLERANCE = 1e-9
"""Force along a locus left unbalanced, as a fraction of the tight tension."""


def jumped(elongation: float) -> str:
    """Say that a chain jumps."""
    return (
        f"wrap at an elongation of {100 * elongation:.3g} %: the rollers must hold the chain, but it jumps "
        "on the worn teeth: raise the slack tension or replace the chain earlier"
    )


def stuck(elongation: float) -> str:
    """Say that no equilibrium is found."""
    return (
        f"wrap at an elongation of {100 * elongation:.3g} %: the solver must find where the rollers rest in "
        "the worn gaps, but does not: use other nodes or phases"
    )


@dataclass(frozen=True)
class WrapChain:
    """What the wrap needs to know of the chain."""

    pitch: float  # p of the new chain [mm]
    roller_radius: float  # d1/2 [mm]
    bush_radius: float  # outer radius of the bush that the roller turns on [mm]
    link_stiffness: float  # force over lengthening of one link [N/mm]
    # joint wear lengthens every other link by twice as much, as it does; else every link alike
    alternating: bool

    def pitches(self, elongation: float) -> tuple[float, float]:
        """Return the pitches of an inner and of an outer link.

        Equation physics.md (W7).

        Parameters
        ----------
        elongation : float
            Mean relative elongation of the chain.

        Returns
        -------
        tuple of float
            p and p (1 + 2 eps), or p (1 + eps) twice [mm].
        """
        if self.alternating:
            return self.pitch, self.pitch * (1.0 + 2.0 * elongation)
        longer = self.pitch * (1.0 + elongation)
        return longer, longer


@dataclass(frozen=True)
class StrandTensions:
    """Tensions of the two strands and the friction of the rollers."""

    # tight, slack: tension without the centrifugal part [N]
    tight: float
    slack: float
    driver: bool  # whether the sprocket drives the chain
    # friction_roller_tooth, friction_roller_bush: coefficients of friction
    friction_roller_tooth: float
    friction_roller_bush: float


@dataclass(frozen=True, eq=False)
class WrapLoads:
    """Equilibrium of the rollers of a wrap in one phase, tooth 1 at the tight end.

    Equation physics.md (W2), of the pressure angle.
    """

    tension: Vector  # of the link on the tight side of each roller, without the centrifugal part [N]
    force: Vector  # normal force on each tooth [N]
    # 90 degrees - theta - 180/z with the contact's angle theta from the inward radius [rad]
    pressure_angle: Vector
    seat_radius: Vector  # distance of the roller's centre from the sprocket's [mm]
    radius_shift: Vector  # the same less the pitch radius [mm]
    contact_arc_length: Vector  # where the outline is touched, from its right tip [mm]
    centre: NDArray[np.float64]  # roller centres in the frame of the first gap [mm], shape (rollers, 2)
    normal: NDArray[np.float64]  # unit normals out of the teeth there, shape (rollers, 2)
    # tight_direction, slack_direction: unit vectors along the strands, away from the sprocket
    tight_direction: Vector
    slack_direction: Vector


@dataclass(frozen=True, eq=False)
class WrapMechanism:
    """Rollers in the gaps of a sprocket under the tensions of two strands.

    Elastic links between rollers that sit on the roller path of their gap; of all places
    the rollers take those of least potential energy, physics.md (W3). Teeth are rigid.
    """

    outline: Profile  # unworn gap from its right tip through the seat to its left tip (the tight side)
    path: RollerPath  # its line of roller centres
    pitch_angle: float  # angle between successive rollers, 2 pi/z [rad]
    wrap_angle: float  # between the points where the straight strands touch the pitch circle [rad]
    chain: WrapChain  # the chain
    pull: StrandTensions  # tensions and friction

    @property
    def pitch_radius(self) -> float:
        """Radius of the circle through the roller centres of a new chain [mm].

        Equation physics.md (W1).
        """
        return 0.5 * self.chain.pitch / math.sin(0.5 * self.pitch_angle)

    @property
    def friction_angle_tangent(self) -> float:
        """Friction along the flank over normal force, the least of slipping there and on the bush.

        A roller that would slip on its bush first rolls on the flank (Naji & Marshek 1983,
        with the two radii).

        Equation physics.md (W8).
        """
        pull, chain = self.pull, self.chain
        on_bush = pull.friction_roller_bush * chain.bush_radius / chain.roller_radius
        return min(pull.friction_roller_tooth, on_bush)

    @cached_property
    def unworn(self) -> WornPath:
        """Roller path of the unworn gap."""
        return self.path.worn(np.array(self.outline.x), np.array(self.outline.y))

    def rollers(self, phase: float) -> int:
        """Return the number of rollers between the straight strands."""
        return max(1, math.ceil(self.wrap_angle / self.pitch_angle + 1.0 - phase - 1e-9))

    def angles(self, phase: float) -> tuple[float, float]:
        """Return how far both strands point below the tangents at the first and last roller."""
        step = self.pitch_angle
        tight = step * (phase - 0.5)
        return tight, self.wrap_angle - tight - (self.rollers(phase) - 1) * step

    def constants(self, elongation: float) -> Vector:
        """Return the numbers that a solve takes."""
        numbers = np.empty(CONSTANTS)
        numbers[PITCH_ANGLE] = self.pitch_angle
        numbers[STIFFNESS] = self.chain.link_stiffness
        numbers[PITCH_EVEN], numbers[PITCH_ODD] = self.chain.pitches(elongation)
        numbers[TIGHT_TENSION], numbers[SLACK_TENSION] = self.pull.tight, self.pull.slack
        numbers[FRICTION] = self.friction_angle_tangent * (1.0 if self.pull.driver else -1.0)
        return numbers

    def start(self, elongation: float, locus: NDArray[np.float64]) -> float:
        """Return a node of the roller path to start a solve from: on the flank where a chain climbs to."""
        radius = np.hypot(locus[0], locus[1])
        lowest = int(radius.argmin())
        climbed = max(self.pitch_radius * (1.0 + elongation), radius[lowest])
        above = np.flatnonzero(radius[lowest:] > climbed + 1e-3 * self.chain.roller_radius)
        return float(lowest + above[0]) if above.size else float(locus.shape[1] - 2)

    def loads(
        self, phase: float, elongation: float = 0.0, first: int = 0, worn: tuple[WornPath, ...] = ()
    ) -> WrapLoads:
        """Return the equilibrium of one phase."""
        paths = worn or (self.unworn,)
        status, position, work, tension, force = self._solve(
            phase, elongation, first, paths[0].locus, paths[-1].locus
        )
        if status != SEATED:
            raise ContactError(self._jump(phase, elongation, status))
        count = force.size
        turn = self.pitch_angle * np.arange(count)
        centre = np.column_stack([work[CENTRE_X], work[CENTRE_Y]])
        normal = np.column_stack([work[NORMAL_X], work[NORMAL_Y]])
        across = normal[:, 0] * np.cos(turn) - normal[:, 1] * np.sin(turn)
        up = normal[:, 0] * np.sin(turn) + normal[:, 1] * np.cos(turn)
        places = [paths[(i + first) % len(paths)].touched for i in range(count)]
        touched = np.array(
            [np.interp(position[i], np.arange(places[i].size), places[i]) for i in range(count)]
        )
        arc = self.outline.arc_length
        tight, slack = self.angles(phase)
        last = turn[-1] + slack
        radius = np.hypot(*centre.T)
        return WrapLoads(
            tension=tension[:-1],
            force=force,
            pressure_angle=0.5 * math.pi - np.arctan2(across, up) - 0.5 * self.pitch_angle,
            seat_radius=radius,
            radius_shift=radius - self.pitch_radius,
            contact_arc_length=np.interp(touched, np.arange(arc.size), arc),
            centre=centre,
            normal=normal,
            tight_direction=np.array([-math.cos(tight), -math.sin(tight)]),
            slack_direction=np.array([math.cos(last), -math.sin(last)]),
        )

    def seats(
        self, phase: float, elongation: float, first: int, worn: tuple[WornPath, ...]
    ) -> NDArray[np.float64]:
        """Return where rollers rest on rigid worn gaps, each in the frame of its own gap [mm].

        Raises
        ------
        JumpError
            The chain jumps.
        """
        status, _, work, _, force = self._solve(phase, elongation, first, worn[0].locus, worn[-1].locus)
        loose = status == STALLED and residual(force.size, work) <= LOOSEST * self.pull.tight
        if status != SEATED and not loose:
            raise JumpError(self._jump(phase, elongation, status))
        turn = self.pitch_angle * np.arange(force.size)
        x, y = work[CENTRE_X], work[CENTRE_Y]
        return np.column_stack([np.cos(turn) * x - np.sin(turn) * y, np.sin(turn) * x + np.cos(turn) * y])

    def _solve(
        self, phase: float, elongation: float, first: int, even: NDArray[np.float64], odd: NDArray[np.float64]
    ) -> tuple[int, Vector, NDArray[np.float64], Vector, Vector]:
        count = self.rollers(phase)
        constants = self.constants(elongation)
        work, tension, force = np.zeros((WORK_ROWS, count)), np.zeros(count + 1), np.zeros(count)
        # Near the tips a step from the flank can pass over them: the seat is the second try.
        for start in (self.start(elongation, even), float(np.hypot(*even[:2]).argmin())):
            position = np.full(count, start)
            status = solve_wrap(
                even,
                odd,
                first,
                count,
                constants,
                *self.angles(phase),
                _TOLERANCE * self.pull.tight,
                position,
                work,
                tension,
                force,
            )
            if status == SEATED:
                break
        return int(status), position, work, tension, force

    def _jump(self, phase: float, elongation: float, status: int) -> str:
        what = "a roller climbs over its tooth" if status == JUMPED else "it finds no equilibrium"
        least = self.smallest_slack_tension(elongation)
        remedy = (
            f"slack tension of at least {1.005 * least:.3g} N"  # rounded up
            if least < math.inf
            else "shorter elongation"
        )
        return (
            f"wrap at an elongation of {100 * elongation:.3g} %, phase {phase:.3g}: the rollers must "
            f"hold the chain with a slack tension of {grouped(self.pull.slack)} N, but {what}: the chain "
            f"jumps; give a {remedy}"
        )

    def holds(self, elongation: float, worn: tuple[WornPath, ...] = ()) -> bool:
        """Tell whether the rollers find an equilibrium in every phase."""
        return all(self._seated(place, elongation, worn) for place in self._places(elongation))

    def _places(self, elongation: float) -> list[tuple[float, int]]:
        """Return phases and kinds of the first link that together show whether a chain holds."""
        firsts = (0, 1) if self.chain.alternating and elongation > 0.0 else (0,)
        return [(phase, first) for first in firsts for phase in np.linspace(0.0, 1.0, _PHASES)]

    def _seated(self, place: tuple[float, int], elongation: float, worn: tuple[WornPath, ...]) -> bool:
        """Tell whether the rollers rest, on a worn path as nearly as wear takes them to."""
        phase, first = place
        paths = worn or (self.unworn,)
        status, _, work, _, force = self._solve(phase, elongation, first, paths[0].locus, paths[-1].locus)
        if status == STALLED:
            return bool(residual(force.size, work) <= LOOSEST * self.pull.tight)
        return status == SEATED

    def with_slack(self, slack: float) -> "WrapMechanism":
        """Return the same wrap with another slack tension at the same difference of tensions."""
        tight = self.pull.tight - self.pull.slack + slack
        return replace(self, pull=replace(self.pull, tight=tight, slack=slack))

    def smallest_slack_tension(self, elongation: float, worn: tuple[WornPath, ...] = ()) -> float:
        """Return the slack tension below which the chain jumps, at the same difference of tensions.

        To 1 %, and not below a hundredth of the slack tension that there is: so far off nothing jumps. It is
        that of the phase which jumps first, so the others are only held against it.
        """

        def _seated(place: tuple[float, int], slack: float) -> bool:
            return self.with_slack(slack)._seated(place, elongation, worn)

        low = least = max(self.pull.slack / FAR_FROM_JUMPING, 1e-9 * self.pull.tight)
        high = max(self.pull.tight - self.pull.slack, self.pull.slack)
        if not self.with_slack(high).holds(elongation, worn):
            # A chain that rides high on many teeth may jump where both of its strands are hard pulled.
            high = self.pull.slack
            if not self.with_slack(high).holds(elongation, worn):
                return math.inf
        for place in self._places(elongation):
            if _seated(place, least):
                continue
            below, above = low, high
            while above > 1.01 * below:
                middle = math.sqrt(below * above)
                holds = middle > least and _seated(place, middle)
                below, above = (below, middle) if holds else (middle, above)
            least = above
        return least

    def assumptions(self) -> list[str]:
        """Return what this picture takes for granted."""
        pull = self.pull
        friction = (
            f"friction acts {'up' if pull.driver else 'down'} the working flank, "
            f"{self.friction_angle_tangent:.3g} of the force"
            if self.friction_angle_tangent
            else "no friction between rollers and teeth"
        )
        return [
            "roller positions minimise the elastic energy of the chain; teeth are rigid, all "
            "gaps alike, strands straight and at rest (no vibration, no impact)",
            friction,
        ]
