"""A chain with a whole number of links round the wheels of a drive: who turns, who takes up, what hangs."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from wearsim.chain.chain_length import STRETCH, belt_centre, even_links
from wearsim.chain.chain_loop import ChainLoop
from wearsim.chain.loop_forces import LoopForces, SpanLevel, inclination, loop_forces, looser_span
from wearsim.chain.span_tension import catenary_tension, fitted_tension
from wearsim.chain.take_up import TakeUp, fitting_travel
from wearsim.errors import CaseError, Fault, GeometryError

LARGEST_SAG = 0.1
"""Sag over span up to which a span without take-up is taken for a parabola."""


@dataclass(frozen=True)
class LoopDrive:
    """Wheels with a chain round them, as a case gives them.

    Examples
    --------
    >>> from wearsim.chain.chain_loop import Wheel
    >>> wheels = Wheel("driver", (0.0, 0.0), 20), Wheel("driven", (300.0, 0.0), 20)
    >>> LoopDrive(ChainLoop(10.0, wheels), (1.0, -1.0)).driver
    0
    """

    loop: ChainLoop  # as given, before the take-up is moved
    # share of each wheel in what the drivers give: above 0 for drivers, below for driven, 0 for idlers
    shares: tuple[float, ...]
    take_up: TakeUp | None = None
    # of the take-up along its direction, by a spring or a weight [N]; 0 where it is moved by hand and fixed
    take_up_force: float = 0.0

    @property
    def driver(self) -> int:
        """The first wheel that drives."""
        return next(i for i, share in enumerate(self.shares) if share > 0.0)


@dataclass(frozen=True)
class LoopLayout:
    """A loop that a whole number of links fits, seen from one of its wheels.

    Examples
    --------
    Wheels of 20 teeth 300 mm apart take 80 links of 10 mm without slack:

    >>> from wearsim.chain.chain_loop import Wheel
    >>> wheels = Wheel("driver", (0.0, 0.0), 20), Wheel("driven", (300.0, 0.0), 20)
    >>> drive = LoopDrive(ChainLoop(10.0, wheels), (1.0, -1.0), TakeUp("driven", (1.0, 0.0), -20.0, 20.0))
    >>> layout = loop_layout(drive)
    >>> layout.links, layout.mates, round(layout.travel, 9)
    (80, (20,), 0.0)
    """

    drive: LoopDrive
    loop: ChainLoop  # with the take-up where the new chain fits
    links: int
    travel: float  # of the take-up from the place that the case gives it [mm]; 0 without one
    wheel: int = 0  # the one that the layout is seen from

    @property
    def pitch(self) -> float:
        """Pitch of the new chain [mm]."""
        return self.loop.pitch

    @property
    def wrap_angle(self) -> float:
        """Wrap angle of the wheel [rad]."""
        return float(self.loop.wrap_angles[self.wheel])

    @property
    def mates(self) -> tuple[float, ...]:
        """Teeth of the other wheels, of a smooth one the links round it."""
        each = zip(self.loop.wheels, self.loop.teeth.tolist(), strict=True)
        return tuple(wheel.teeth or links for i, (wheel, links) in enumerate(each) if i != self.wheel)

    @property
    def all_teeth(self) -> tuple[int, ...]:
        """Teeth of all sprockets."""
        return tuple(wheel.teeth for wheel in self.loop.wheels if wheel.teeth)

    @property
    def rated_teeth(self) -> tuple[int, ...]:
        """Teeth of the wheels that drive or are driven, by which a chain is rated."""
        return tuple(
            wheel.teeth
            for wheel, share in zip(self.loop.wheels, self.drive.shares, strict=True)
            if share != 0.0
        )

    @property
    def excess(self) -> float:
        """Links more than the loop takes without slack, 0 with a take-up."""
        return self.links - self.loop.links

    @property
    def braked(self) -> "LoopLayout":
        """The loop while its drivers are driven: every wheel gives what it takes else."""
        return replace(self, drive=replace(self.drive, shares=tuple(-share for share in self.drive.shares)))

    def sag(self, span: int) -> float:
        """Return sag over span where one span holds the whole excess, sqrt(3 dX p/(8 a)).

        The length of a parabola exceeds that of its chord by 8 f^2/(3 a).
        """
        excess = max(self.excess, 0.0) * self.pitch
        return math.sqrt(0.375 * excess / float(self.loop.span_lengths[span]))

    def level(
        self,
        mass_per_length: float,
        slack_tension: float | None,
        sag: float | None,
        link_stiffness: float,
        shares: tuple[float, ...] = (),
    ) -> SpanLevel:
        """Return what sets the tensions: a given tension, a force of the take-up, or a span that sags.

        Parameters
        ----------
        mass_per_length : float
            q [t/mm].
        slack_tension : float or None
            Tension of the loosest span [N]; None where it follows.
        sag : float or None
            Sag of the loosest span over its length; None for that of the excess of links.
        link_stiffness : float
            Stiffness of a link [N/mm], by which a chain stretches that has no excess.
        shares : tuple of float
            Of each wheel in the power, by which one span is the loosest; by default those of the drive.
        """
        loosest = looser_span(self.loop, shares or self.drive.shares)
        take_up = self.drive.take_up
        if slack_tension is not None:
            return SpanLevel(slack_tension, span=loosest)
        if take_up is not None and self.drive.take_up_force:
            return SpanLevel(
                self.drive.take_up_force, wheel=self.loop.index(take_up.wheel), direction=take_up.unit
            )
        slope = inclination(self.loop, loosest)
        span = float(self.loop.span_lengths[loosest])
        if sag is None:
            excess, yielding = self.excess * self.pitch, self.links / link_stiffness
            return SpanLevel(fitted_tension(mass_per_length, span, excess, yielding, slope), span=loosest)
        return SpanLevel(catenary_tension(mass_per_length, span, sag, slope), span=loosest)

    def forces(
        self,
        pull: float,
        level: SpanLevel,
        friction_lever: float = 0.0,
        centrifugal: float = 0.0,
        shares: tuple[float, ...] = (),
    ) -> LoopForces:
        """Return the forces under a pull, with the shares of the drive or of a block of its duty."""
        return loop_forces(self.loop, pull, shares or self.drive.shares, level, friction_lever, centrifugal)

    def travel_at(self, elongation: float) -> float:
        """Return the travel of the take-up for a chain that has grown [mm]; 0 without one."""
        take_up = self.drive.take_up
        if take_up is None:
            return 0.0
        return fitting_travel(self.drive.loop, take_up, self.links, elongation)


def loop_layout(drive: LoopDrive, links: int | None = None) -> LoopLayout:
    """Return a drive with a whole number of links.

    Parameters
    ----------
    drive : LoopDrive
        Wheels and take-up.
    links : int, optional
        Links of the chain; by default the even number next to what fits: the nearest one that the take-up
        has room for, without a take-up the next one upwards.

    Returns
    -------
    LoopLayout
        The loop with its take-up moved, seen from its first wheel.

    Raises
    ------
    CaseError
        The links do not fit: no room at the take-up, or without one too few or far too many.
    """
    fits, take_up = drive.loop.links, drive.take_up
    if take_up is not None:
        refused: list[GeometryError] = []
        for number in [links] if links is not None else _even_near(fits):
            try:
                travel = fitting_travel(drive.loop, take_up, number)
            except GeometryError as error:
                refused.append(error)
                continue
            return LoopLayout(drive, take_up.moved(drive.loop, travel), number, travel)
        raise refused[0]
    layout = LoopLayout(drive, drive.loop, links if links is not None else even_links(fits), 0.0)
    numbers = [layout.links] if links is not None else [layout.links - 2, layout.links]
    if not _misfit(layout):
        return layout
    found = "; ".join(_misfit(replace(layout, links=number)) for number in numbers)
    message = (
        f"a whole number of links must fit: the wheels as placed need {fits:.7g} links; {found}: "
        f"{_remedy(drive.loop, numbers)}"
    )
    raise CaseError([Fault(f"chain loop: {message}")])


def _misfit(layout: LoopLayout) -> str:
    """Return by how much a chain is too short or too long for wheels that stand; empty where it fits."""
    loop, short = layout.loop, -layout.excess / layout.links
    if short > STRETCH:
        return (
            f"{layout.links} links are {-layout.excess * layout.pitch:.3g} mm too short, "
            f"{100.0 * short:.2g} % of their length, and can stretch by {100.0 * STRETCH:g} %"
        )
    loosest = looser_span(loop, layout.drive.shares)
    sag = layout.sag(loosest)
    if sag > LARGEST_SAG:
        span = loop.span_name(loosest)
        return f"with {layout.links} links the span {span} sags by {100.0 * sag:.3g} % of its length"
    return ""


def _remedy(loop: ChainLoop, numbers: Sequence[int]) -> str:
    """Return how wheels come to stand where a whole number of links fits; of two, how far apart."""
    take_up = "give one wheel a take_up"
    if len(loop.wheels) > 2:
        return f"{take_up}, or move a wheel"
    one, two = (wheel.teeth for wheel in loop.wheels)
    fitting = (
        f"{loop.pitch * belt_centre(one, two, number):.3f} mm for {number} links"
        for number in numbers
        if number > max(one, two)
    )
    return f"{take_up}, or set the centre distance to {' or '.join(fitting)}"


def _even_near(links: float) -> list[int]:
    """Return even numbers by their distance from what fits."""
    below = 2 * math.floor(0.5 * links)
    near = [below + 2 * step for step in range(-2, 4) if below + 2 * step > 0]
    return sorted(near, key=lambda number: abs(number - links))


def seen_from(layout: LoopLayout, wheel: int) -> LoopLayout:
    """Return the same loop seen from another wheel."""
    return replace(layout, wheel=wheel)
