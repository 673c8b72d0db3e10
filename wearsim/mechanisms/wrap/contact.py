"""What every gap of a wrapped sprocket meets in one revolution."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from wearsim.contact.resting_engagement import NEW_MATE, MateWear, PressedPlaces, RestingContact
from wearsim.errors import ConvergenceError, JumpError
from wearsim.geometry.profile_points import Profile
from wearsim.geometry.roller_path import WornPath, roller_path
from wearsim.kernels.event_rows import EVENT_COUNT, EVENT_ROWS, EVENT_SLIP
from wearsim.kernels.wrap_cycle import (
    ARTICULATION_SLIP,
    CYCLE_NUMBERS,
    FACE_WIDTH,
    LOWEST,
    PATH_SLIP,
    PHASE_TIME,
    START,
    WRAP_ANGLE,
    wrap_events,
)
from wearsim.kernels.wrap_equilibrium import JUMPED, SEATED, WORK_ROWS
from wearsim.mechanisms.wrap.wrap_mechanism import WrapMechanism, jumped, stuck

Rows = NDArray[np.float64]


@dataclass(frozen=True)
class RollerSliding:
    """How far rollers slide on the teeth."""

    fraction: float  # xi: of the articulation of a roller that does not turn
    path_fraction: float  # of the way along the flank: xi where the roller rolls up it, 1 where it slides


@dataclass(frozen=True, eq=False)
class WrapBlock:
    """A part of the duty of a wrap, in which tensions and speed are constant."""

    share: float  # of the cycles; those of all blocks sum to 1 where none loads the other side of the gaps
    mechanism: WrapMechanism  # rollers and chain under the tensions of this block
    pitch_time: float  # time in which the chain advances by one pitch [s]
    wear_factor: float  # on the wear coefficient


@dataclass(frozen=True, eq=False)
class WrapContact(RestingContact):
    """Contact events of a wrap over one revolution, for the wear engine."""

    mate = "roller"
    lets_go = "the chain jumps on the worn teeth"

    blocks: tuple[
        WrapBlock, ...
    ]  # the duty that loads this side of the gaps; they differ in their tensions and speeds only
    face_width: float  # b [mm]
    phases: int  # phases of one pitch
    sliding: RollerSliding  # how far rollers slide
    modulus: float  # contact modulus E* [MPa]
    same_link_kind: bool  # whether a tooth meets only inner or only outer links for life
    # growth of the chain in a revolution of the sprocket, the mean over the blocks
    elongation_per_cycle: float
    elongation_limit: float  # relative elongation at which a new chain is put on
    # area of its section that a roller loses over that a gap would lose to it; 0 where rollers do not wear
    mate_area_ratio: float = 0.0
    # least slack tension at which the life ends once it is needed [N]; 0 for no such limit
    slack_limit: float = 0.0
    joint_sliding_per_cycle: float = 0.0  # way that a pin slides in its bush in a revolution [mm]

    @property
    def mechanism(self) -> WrapMechanism:
        """Rollers and chain in the first block."""
        return self.blocks[0].mechanism

    @property
    def heaviest_rollers(self) -> WrapMechanism:
        """Rollers and chain in the block of the largest tension, in which the chain jumps first."""
        return max((block.mechanism for block in self.blocks), key=lambda of: of.pull.tight)

    @property
    def slack_tension(self) -> float:  # type: ignore[override]
        """Tension of the slack strand without the centrifugal part [N]."""
        return self.mechanism.pull.slack

    @property
    def profile(self) -> Profile:
        """Outline of a new gap."""
        return self.mechanism.outline

    @property
    def bodies(self) -> int:
        """Gaps told apart: two where every gap meets only one kind of link."""
        return 2 if self.mechanism.chain.alternating and self.same_link_kind else 1

    @property
    def mate_radius(self) -> float:
        """Radius of the roller [mm]."""
        return self.mechanism.chain.roller_radius

    @property
    def thinnest_mate(self) -> float:  # type: ignore[override]
        """Radius of the bush that the rollers turn on [mm]."""
        return self.mechanism.chain.bush_radius

    @property
    def most_rollers(self) -> int:
        """Most rollers in the wrap at once."""
        return self.mechanism.rollers(0.0)

    @property
    def sliding_per_cycle(self) -> float:
        """Way that the rollers slide in a new gap in a cycle of a new chain [mm], the mean of the duty."""
        x, y = (np.tile(row, (self.bodies, 1)) for row in (self.profile.x, self.profile.y))
        blocks = tuple(replace(block, wear_factor=1.0) for block in self.blocks)
        table = replace(self, blocks=blocks).events(x, y, NEW_MATE, self.memory())
        return float(np.sum(table[EVENT_SLIP] * table[EVENT_COUNT])) / self.bodies

    def coarsened(self) -> "WrapContact":
        """Return the contact on every second point and half of the phases; one phase becomes two."""
        outline = self.profile
        points = outline.x.size
        keep = np.unique(np.linspace(0, points - 1, (points + 1) // 2).round().astype(int))
        coarse = Profile(outline.x[keep], outline.y[keep])
        phases = 1 if self.phases == 2 else max(2, self.phases // 2)
        return replace(self.on_outline(coarse), phases=phases)

    def refined(self) -> "WrapContact":
        """Return the contact with twice the phases."""
        return replace(self, phases=2 * self.phases)

    def on_outline(self, outline: Profile) -> "WrapContact":
        """Return the same contact on another outline."""
        path = roller_path(outline, self.mate_radius, (outline.x.size + 1) // 2)
        blocks = tuple(
            replace(block, mechanism=replace(block.mechanism, outline=outline, path=path))
            for block in self.blocks
        )
        return replace(self, blocks=blocks)

    def seating(self, law: Rows, unworn: Rows) -> PressedPlaces:
        """Return the rollers on gaps that yield like an elastic foundation, for implicit stages."""
        # A run cycle by cycle does without.
        from wearsim.mechanisms.wrap.seating import WrapSeating

        return WrapSeating(self, law, unworn)

    def memory(self) -> Rows:
        """Return the places where no roller has been found yet."""
        configurations = 2 if self.mechanism.chain.alternating else 1
        return np.full((len(self.blocks), configurations, self.phases, self.most_rollers), -1.0)

    def events(self, x: Rows, y: Rows, wear: MateWear, memory: Rows) -> Rows:
        """Return what worn gaps meet in one revolution.

        Equation physics.md (W9), of the slip where the chain articulates.

        Parameters
        ----------
        x, y : numpy.ndarray
            Worn outlines [mm], shape (bodies, points).
        wear : MateWear
            What the chain has lost.
        memory : numpy.ndarray
            Where the rollers were last; replaced by where they are.

        Returns
        -------
        numpy.ndarray
            Table of events, a column for every block, kind of link, phase and roller. How
            often each comes in a cycle holds its block's share and factor on wear. All
            zero where the chain is not pulled.

        Raises
        ------
        JumpError
            The chain jumps.
        ConvergenceError
            No equilibrium is found.
        """
        worn = self.worn_paths(x, y, wear)
        tables = [
            self._block_events(block, worn, wear, places)
            for block, places in zip(self.blocks, memory, strict=True)
        ]
        return np.concatenate(tables, axis=1)

    def worn_paths(self, x: Rows, y: Rows, wear: MateWear) -> tuple[WornPath, ...]:
        """Return where the centres of a chain's rollers can be in worn gaps."""
        path = replace(self.mechanism.path, roller_radius=self.mate_radius - wear.depth)
        return tuple(path.worn(x[body], y[body]) for body in range(self.bodies))

    def holds(self, x: Rows, y: Rows, wear: MateWear) -> bool:
        """Tell whether worn gaps hold the chain with the least slack tension allowed."""
        if not self.slack_limit:
            return True
        mechanism = self.heaviest_rollers.with_slack(self.slack_limit)
        return mechanism.holds(wear.elongation, self.worn_paths(x, y, wear))

    def _block_events(
        self, block: WrapBlock, worn: tuple[WornPath, ...], wear: MateWear, memory: Rows
    ) -> Rows:
        """Return what worn gaps meet in one revolution of a block, times its share."""
        mechanism = block.mechanism
        table = np.zeros((EVENT_ROWS, memory.size))
        if not mechanism.pull.tight > 0.0:
            return table
        configurations, _, most_rollers = memory.shape
        positions = np.where(memory < 0.0, -1.0, self._by_body(memory, [path.node_of for path in worn]))
        loci = np.array([path.locus for path in worn])
        numbers = np.zeros(CYCLE_NUMBERS)
        numbers[WRAP_ANGLE], numbers[FACE_WIDTH] = mechanism.wrap_angle, self.face_width
        numbers[ARTICULATION_SLIP] = (
            self.sliding.fraction * (self.mate_radius - wear.depth) * mechanism.pitch_angle
        )
        numbers[PATH_SLIP] = self.sliding.path_fraction
        numbers[PHASE_TIME] = block.pitch_time / self.phases
        numbers[START] = mechanism.start(wear.elongation, loci[0])
        numbers[LOWEST] = float(np.hypot(loci[0, 0], loci[0, 1]).argmin())
        status = wrap_events(
            loci,
            np.array([path.touched for path in worn]),
            configurations,
            self.phases,
            most_rollers,
            block.share * block.wear_factor * self.bodies / configurations,
            mechanism.constants(wear.elongation),
            numbers,
            positions,
            np.zeros((WORK_ROWS, most_rollers)),
            np.zeros((WORK_ROWS, most_rollers)),
            np.zeros(most_rollers + 1),
            np.zeros(most_rollers),
            table,
        )
        if status == JUMPED:
            raise JumpError(jumped(wear.elongation))
        if status != SEATED:
            raise ConvergenceError(stuck(wear.elongation))
        memory[:] = self._by_body(positions, [path.node_place for path in worn])
        return table

    def _by_body(self, values: Rows, functions: "list[Callable[[Rows], Rows]]") -> Rows:
        """Apply to the rollers of every body the function of that body."""
        if len(functions) == 1:
            return functions[0](values)
        configuration, _, roller = np.indices(values.shape)
        found = np.empty_like(values)
        for body, function in enumerate(functions):
            where = (configuration + roller) % len(functions) == body
            found[where] = function(values[where])
        return found

    def assumptions(self) -> list[str]:
        """Return what this picture takes for granted."""
        sliding = self.sliding
        return [
            *self.mechanism.assumptions(),
            f"slip of a roller on its seat at the first and the last tooth: {100.0 * sliding.fraction:g} % "
            f"of the articulation angle of {math.degrees(self.mechanism.pitch_angle):.3g} degrees; along "
            f"the flank: {100.0 * sliding.path_fraction:g} % of its path",
            "wear by the pressure of the roller on the worn gap as an elastic foundation; the pressures "
            "shown are those of a half-space contact; "
            + ("rollers wear all round" if self.mate_area_ratio else "rollers do not wear"),
            "every tooth alike"
            if self.bodies == 1
            else "teeth of two kinds: those that meet inner and those that meet outer links",
        ]
