"""A chain around a sprocket: gap, layout and loads, and what the rest of wearsim asks of them."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import astuple, dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from wearsim.case.keys.drive_tables import JOINT_LAW_KEYS
from wearsim.case.model import Case, Drive, LoadBlock, WearBand, WearInput, heaviest_block, on_flank
from wearsim.catalogue.catalogues import MOST_STRANDS, Chain
from wearsim.chain.chain_loop import ChainLoop, Wheel
from wearsim.chain.drive_layout import DriveLayout, ToothMeetings
from wearsim.chain.elongation_limit import elongation_finding
from wearsim.chain.joint_wear import JointLaw, JointState, elongation_per_loop
from wearsim.chain.loop_forces import LoopForces
from wearsim.chain.loop_layout import LoopLayout
from wearsim.chain.practice_drive import PracticeDrive
from wearsim.chain.rating_findings import RatedDrive, RatingFinding, overload_fault
from wearsim.chain.service_conditions import LUBRICATIONS
from wearsim.contact.stop_limits import StopLimit, stop_limit
from wearsim.errors import CaseError, Fault
from wearsim.geometry.blank import blank_area, gap_space
from wearsim.geometry.gap import Gap
from wearsim.geometry.hub import NO_HUB, Hub
from wearsim.geometry.profile_points import Profile, Vector
from wearsim.geometry.roller_path import RollerPath, roller_path
from wearsim.geometry.scene import Scene, Stroke
from wearsim.geometry.wheel_outline import WheelShape
from wearsim.geometry.worn_tooth import measurement_over_pins, tip_land, tooth_thickness
from wearsim.mechanisms.wrap.chain_rating import (
    drive_notes,
    findings_by_load,
    meetings_note,
    rules_without_limit,
    with_hours_over_duty,
    worst_findings,
)
from wearsim.quantities import grouped

if TYPE_CHECKING:
    from wearsim.mechanisms.wrap.contact import WrapContact
    from wearsim.mechanisms.wrap.wrap_mechanism import WrapMechanism


LIGHT_CHAIN = "085-1"
"""Designation of no. 41, the light chain of 12.7 mm pitch."""

CONSTANT, PRESSURE_SPEED = "constant", "pressure_speed"
"""Laws by which joints wear, rows of the registry of wear laws."""

JOINT_COEFFICIENT = "joint.specific_wear_rate_mm2_per_N"


def law_keys(law: JointLaw) -> dict[str, float | str]:
    """Return the keys of [joint] that give a law of the joints beside its coefficient."""
    if law.is_constant:
        return {"joint.law": CONSTANT}
    numbers = astuple(law)[1:]
    keys = (f"joint.{key}" for key in JOINT_LAW_KEYS)
    return {"joint.law": PRESSURE_SPEED, **dict(zip(keys, numbers, strict=True))}


@dataclass(frozen=True)
class JointInput:
    """Wear of the chain's joints."""

    law: JointLaw  # specific wear rate of pin and bush together
    band: WearBand  # of its coefficient
    tooth_band: WearBand  # of the coefficient of the teeth, where they run on this chain
    tooth_law: JointLaw | None  # by which the teeth wear too, of their coefficient; None where they do not
    state: JointState  # where the joints run
    bearing_area: float  # projected area of pin in bush [mm2]
    alternating: bool  # whether wear lengthens every other link only, as it does
    elongation_limit: float  # relative elongation at which the chain's life ends

    @property
    def coefficient(self) -> float:
        """Specific wear rate at the reference of the law [mm2/N]."""
        return self.law.coefficient


@dataclass(frozen=True)
class WrapLoad(LoadBlock):
    """A part of the duty of a wrap."""

    slack: float  # tension of the slack strand without the centrifugal part [N]
    pull: float  # power over speed in the chain [N], on a loop that of all drivers
    base: float  # what the tightest span of the chain bears beside the pull and the centrifugal part [N]
    # tensions of the spans on both sides of every wheel on which joints turn, this sprocket first, then
    # `WrapDrive.mates` [N]
    turns: tuple[tuple[float, float], ...]
    # what speed and pitch make of the wear rate of the joints where they turn on each of these wheels
    turning_factors: tuple[float, ...]
    spans: tuple[
        float, ...
    ]  # tension of the span after each wheel of the loop, of two the driver's first [N]


@dataclass(frozen=True, eq=False)
class WrapDrive(Drive):
    """A chain around a sprocket."""

    outline: Profile  # the gap from its right tip through the seat to its left tip
    gap: Gap | None  # the exact arcs of a standard form
    gaps: int  # of the worn sprocket
    pitch_angle: float  # between successive rollers on it [rad]
    layout: DriveLayout | LoopLayout  # all sprockets and the chain
    driver: bool  # whether the worn sprocket drives the chain; of two it is number 1 of the layout then
    # rollers in a turn of the other wheels on which the chain bends, over the part of time in which it does
    mates: tuple[float, ...]
    wrap_angle: float  # of the worn sprocket [rad]
    face_width: float  # b [mm]
    blocks: tuple[WrapLoad, ...]  # the duty
    rated: tuple[WrapLoad, ...]  # loads that strength, ratings and the grip of the chain are judged by
    link_stiffness: float  # of one link [N/mm]
    bush_radius: float  # outer radius of the bush [mm]
    phases: int  # of one pitch
    slip_fraction: float  # sliding as a fraction of that of a roller that does not turn
    friction_roller_tooth: float  # coefficients of friction
    friction_roller_bush: float
    joint: JointInput
    service_factor: float  # f1 on the power in the ratings
    joint_application_factor: float  # K_e on the joint pressure in the ratings
    chain: Chain
    joint_friction: float | None = None  # coefficient of friction of pin and bush, where the case has one
    time_share: float = 1.0  # part of the time in which the chain runs on this sprocket, of several cogs
    hub: Hub = NO_HUB  # bore, keyway and hub

    rests = True
    has_tooth = True
    life_tolerance = 5e-2  # it costs more than on a strand

    @property
    def duty(self) -> tuple["WrapLoad", ...]:
        """Blocks of load on the side of the gaps that wears."""
        return on_flank(self.blocks)

    @property
    def wear_coefficients(self) -> Mapping[str, float]:
        """That of the joints."""
        return {JOINT_COEFFICIENT: self.joint.coefficient}

    @property
    def wear_settings(self) -> Mapping[str, float | str]:
        """Law of the joints, by the keys of [joint]."""
        return law_keys(self.joint.law)

    @property
    def referred_here(self) -> "WrapDrive":
        """The same drive, the law of its joints told by where they run."""
        joint = self.joint
        return replace(self, joint=replace(joint, law=joint.law.at(joint.state)))

    def alike(self, case: Case) -> Case:
        """Return a driven sprocket as a driver: friction alone tells which way round the chain runs."""
        if self.driver or self.friction_roller_tooth or self.friction_roller_bush:
            return case
        sprocket = {**case.inputs["sprocket"], "role": "driver"}
        return replace(case, drive=replace(self, driver=True), inputs={**case.inputs, "sprocket": sprocket})

    def wear_band(self, part: str, wear: WearInput) -> WearBand:
        """Return that of the joints for the chain, that of the teeth for the sprocket."""
        return self.joint.band if part == "chain" else self.joint.tooth_band

    @property
    def heaviest(self) -> WrapLoad:
        """The rated load of the largest tension."""
        return heaviest_block(self.rated)

    @property
    def slack(self) -> float:
        """Tension of the slack strand under that load without the centrifugal part [N]."""
        return self.heaviest.slack

    @property
    def profile(self) -> Profile:
        """The outline that wears."""
        return self.outline

    @property
    def pitch_line_thickness(self) -> float:
        """Chordal thickness of the tooth on the pitch circle [mm]."""
        return self.worn_thickness(self.outline.x, self.outline.y)

    def worn_thickness(self, x: Vector, y: Vector) -> float:
        """Return the thickness on the pitch circle that a worn outline leaves."""
        radius = 0.5 * self.layout.pitch / math.sin(0.5 * self.pitch_angle)
        return tooth_thickness(x, y, self.gaps, radius)

    @property
    def thinnest(self) -> float:
        """Thickness of the tooth on the pitch circle [mm]: it grows from there to the root."""
        return self.pitch_line_thickness

    @property
    def tip_land(self) -> float:
        """Length of the tip [mm]."""
        return tip_land(self.outline.x, self.outline.y, self.gaps)

    def worn_tip_land(self, x: Vector, y: Vector) -> float:
        """Return the tip land that a worn outline leaves."""
        return tip_land(x, y, self.gaps)

    @property
    def root_diameter(self) -> float:
        """Diameter of the circle at the bottom of the new gaps [mm]."""
        return 2.0 * float(np.hypot(self.outline.x, self.outline.y).min())

    @property
    def tip_diameter(self) -> float:
        """Diameter over the tips of the new teeth [mm]."""
        return 2.0 * float(np.hypot(self.outline.x, self.outline.y).max())

    @property
    def over_pins(self) -> float:
        """Measurement over pins of the roller's diameter of the new sprocket [mm]."""
        return over_pins(self.rollers.path, self.outline.x.copy(), self.outline.y.copy(), self.gaps)

    def blank_area(self) -> float:
        """Return the area of the whole wheel [mm2]."""
        return blank_area(gap_space(self.outline, self.gap), self.gaps)

    def teeth_in_words(self, case: Case) -> str:
        """Return the number of teeth and the chain."""
        return f"{super().teeth_in_words(case)}, chain {self.chain.in_words}"

    def scene(self, engaged_every: int) -> Scene:
        """Return both sprockets and the chain."""
        from wearsim.mechanisms.wrap.scene import wrap_scene

        return wrap_scene(self)

    def wheels(self, engaged_every: int, last: Mapping[str, Vector] | None = None) -> tuple[WheelShape, ...]:
        """Return the sprocket that wears, new and worn."""
        from wearsim.mechanisms.wrap.scene import wrap_wheel

        return (wrap_wheel(self, engaged_every, last),)

    def body(self) -> tuple[Stroke, ...]:
        """Return half of the teeth on both sides of the gap."""
        from wearsim.mechanisms.wrap.scene import beside_gap

        return (beside_gap(self),)

    def mate(self, last: Mapping[str, Vector], node: int) -> tuple[float, str]:
        """Return the roller."""
        return 0.5 * self.chain.roller_diameter, "roller"

    def profile_columns(self) -> dict[str, Vector]:
        """Points of the whole gap from its right tip to its left one; no radius where it is straight."""
        outline = self.outline
        theta = np.arctan2(np.abs(outline.normal_x), outline.normal_y)
        bent = np.abs(outline.curvature) > 1e-9
        curvature = np.where(bent, outline.curvature, np.nan)
        return {
            "node": np.arange(1, outline.x.size + 1),
            "x_mm": outline.x,
            "y_mm": outline.y,
            "arc_length_mm": outline.arc_length,
            "curvature_per_mm": np.where(bent, curvature, 0.0),
            "flank_radius_mm": 1.0 / np.abs(curvature),
            "pressure_angle_deg": 90.0 - np.degrees(theta + 0.5 * self.pitch_angle),
            "evolute_x_mm": outline.x - outline.normal_x / curvature,
            "evolute_y_mm": outline.y - outline.normal_y / curvature,
        }

    @cached_property
    def rollers(self) -> "WrapMechanism":
        """The rollers of the chain on the gaps that they wrap, without what wears them."""
        from wearsim.mechanisms.wrap.wrap_mechanism import StrandTensions, WrapChain, WrapMechanism

        radius = 0.5 * self.chain.roller_diameter
        return WrapMechanism(
            outline=self.outline,
            path=roller_path(self.outline, radius, (self.outline.x.size + 1) // 2),
            pitch_angle=self.pitch_angle,
            wrap_angle=self.wrap_angle,
            chain=WrapChain(
                pitch=self.chain.pitch,
                roller_radius=radius,
                bush_radius=self.bush_radius,
                link_stiffness=self.link_stiffness,
                alternating=self.joint.alternating,
            ),
            pull=StrandTensions(
                tight=self.heaviest.tension,
                slack=self.slack,
                driver=self.driver,
                friction_roller_tooth=self.friction_roller_tooth,
                friction_roller_bush=self.friction_roller_bush,
            ),
        )

    def contact(self, case: Case) -> "WrapContact":
        """Return the contact events of the chain around the sprocket."""
        from wearsim.mechanisms.wrap.contact import RollerSliding, WrapBlock, WrapContact

        pull, chain = self.rollers.pull, self.rollers.chain
        rolls = (
            pull.friction_roller_tooth * chain.roller_radius > pull.friction_roller_bush * chain.bush_radius
        )
        own, joint = 2.0 * math.pi / self.pitch_angle, self.joint
        blocks = tuple(
            WrapBlock(
                share=block.share,
                mechanism=replace(self.rollers, pull=replace(pull, tight=block.tension, slack=block.slack)),
                pitch_time=60.0 / (block.speed_rpm * own),
                wear_factor=block.wear_factor,
            )
            for block in self.duty
        )
        engaged, links = self.gaps // math.gcd(self.gaps, case.engaged_every), self.layout.links
        others = sum(own / self.time_share / mate for mate in self.mates)
        per_loop = math.fsum(
            block.share
            * elongation_per_loop(
                block.joint_factor * joint.coefficient,
                self._joint_pressures(block),
                self.chain.pin_diameter,
                self.chain.pitch,
                (own / self.time_share, *self.mates),
            )
            for block in self.blocks
        )
        return WrapContact(
            blocks=blocks,
            face_width=self.face_width,
            phases=self.phases,
            sliding=RollerSliding(
                fraction=self.slip_fraction, path_fraction=self.slip_fraction if rolls else 1.0
            ),
            modulus=case.modulus,
            same_link_kind=ToothMeetings(engaged, links).same_link_kind,
            elongation_per_cycle=per_loop * engaged / (links * self.time_share),
            elongation_limit=joint.elongation_limit,
            joint_sliding_per_cycle=2.0
            * math.pi
            * self.chain.pin_diameter
            * (1.0 + others)
            / own
            * engaged
            / links,
            # Other sprockets wear the rollers too, by the same way over their own articulation.
            mate_area_ratio=case.wear.roller_ratio * engaged / links * (1.0 + others),
            slack_limit=case.more_limits.get("min_slack_tension_N", 0.0),
        )

    def _joint_pressures(self, block: WrapLoad) -> list[tuple[float, float]]:
        """Pressures in the joints where they turn onto wheels and off, times what their law says [MPa]."""
        law, area = self.joint.law, self.joint.bearing_area

        def weighted(span: float, turning: float) -> float:
            return law.wearing_pressure((span + block.centrifugal) / area) * turning

        return [
            (weighted(on, turning), weighted(off, turning))
            for (on, off), turning in zip(block.turns, block.turning_factors, strict=True)
        ]

    def gap_limits(self, case: Case, path: RollerPath) -> tuple[StopLimit, ...]:
        """Return the limits of a worn gap whose roller takes a path, the critical depth first."""
        found, limit = self.tooth_limits(case), case.more_limits.get("over_pins_change_mm")
        if limit is None:
            return found
        new = over_pins(path, self.outline.x.copy(), self.outline.y.copy(), self.gaps)
        change = stop_limit(
            "over_pins_change_mm", limit, lambda x, y, depth: new - over_pins(path, x, y, self.gaps)
        )
        return (*found, change)

    def check(self, case: Case) -> None:
        """Raise where the chain jumps on new teeth, at no or at its limit of elongation.

        The ratings that such a drive is outside of are among the faults: a slack tension is not all it lacks.
        """
        limits = (0.0, self.joint.elongation_limit)
        least = case.more_limits.get("min_slack_tension_N")
        if not all(self.rollers.holds(elongation) for elongation in limits):
            message, key = self._jumping(limits), "drive.slack_tension_N"
        elif least is not None and not self.rollers.with_slack(least).holds(0.0):
            needed = 1.005 * self.rollers.smallest_slack_tension(0.0)  # rounded up
            message = (
                f"must be above the slack tension at which a new drive jumps, {needed:.3g} N (got {least:g})"
            )
            key = "stop.min_slack_tension_N"
        else:
            return
        faults = [Fault(message, key, case.name)]
        if overload := overload_fault(self.ratings(case)):
            faults.append(Fault(overload, "duty" if case.inputs.get("duty") else "load", case.name))
        raise CaseError(faults)

    def _jumping(self, limits: tuple[float, float]) -> str:
        """Say which slack tension holds the chain, new and stretched."""
        least = max(self.rollers.smallest_slack_tension(elongation) for elongation in limits)
        remedy = (
            f"give a slack tension of at least {1.005 * least:.3g} N"
            if least < math.inf
            else "no slack tension holds it: use more teeth or a lower elongation_percent"
        )
        return (
            f"the rollers must hold the chain, new and stretched by {100 * limits[1]:.3g} %, but with a "
            f"slack tension of {grouped(self.slack)} N the chain jumps: {remedy}"
        )

    def rated_drive(self, case: Case, load: WrapLoad) -> RatedDrive:
        """Return what the ratings need to know under a load: of the smaller sprocket.

        Its teeth and speed follow from the chain's speed where the case is about the larger one.

        Examples
        --------
        >>> import wearsim
        >>> case = wearsim.load_case({
        ...     "format_version": 1,
        ...     "chain": {"designation": "ANSI 80"},
        ...     "sprocket": {"teeth": 60, "profile": "ansi_b29", "role": "driven"},
        ...     "drive": {"mate_teeth": 20, "links": 122},
        ...     "load": {"power_kW": 30, "speed_rpm": 250},
        ...     "wear": {"condition": "hardened, oiled"},
        ... })
        >>> found = case.drive.rated_drive(case, case.drive.heaviest)
        >>> found.teeth, found.speed, round(found.power, 9)
        (20.0, 750.0, 30.0)
        """
        chain, smallest = self.chain, min(self.layout.rated_teeth)
        own = self.gaps / case.engaged_every
        # 27 gaps of which every second carries a roller are 13.5 teeth, and no more than 13.
        teeth = own if int(own) == smallest else float(smallest)
        pitches = own * load.speed_rpm
        return RatedDrive(
            pitch=chain.pitch,
            teeth=teeth,
            speed=pitches / teeth,
            power=1e-6 * load.pull * chain.pitch * pitches / 60.0,
            strands=chain.strands,
            bearing_area=chain.bearing_area,
            tensile=chain.tensile,
            own_tension=load.base + load.centrifugal,
            series=chain.series,
            light=chain.designation == LIGHT_CHAIN,
            links=self.layout.links,
        )

    @property
    def pulling(self) -> list[tuple[float, WrapLoad]]:
        """Blocks of the duty in which the chain pulls, each after its share of the time."""
        times = [block.share / block.speed_rpm for block in self.blocks]
        whole = math.fsum(times)
        return [
            (time / whole, block) for time, block in zip(times, self.blocks, strict=True) if block.pull > 0.0
        ]

    def practice(self, case: Case) -> tuple[PracticeDrive, ...]:
        """Return the drive as the published rules see it, once for every block of the duty that pulls.

        No block where it pulls nothing, or where the rules know no such number of strands.
        """
        if self.chain.strands > MOST_STRANDS:
            return ()
        small, own = min(self.layout.rated_teeth), self.gaps / case.engaged_every
        supplied, environment = supply_in_words(case)
        return tuple(
            PracticeDrive(
                pitch=self.chain.pitch,
                teeth=small,
                ratio=max(self.layout.rated_teeth) / small,
                speed=block.speed_rpm * own / small,
                links=self.layout.links,
                pull=block.pull,
                bearing_area=self.chain.bearing_area,
                pin_diameter=self.chain.pin_diameter,
                strands=self.chain.strands,
                series=self.chain.series,
                light=self.chain.designation == LIGHT_CHAIN,
                elongation=self.joint.elongation_limit,
                shock_factor=self.service_factor,
                lubrication=supplied,
                environment=environment,
                time_share=share,
            )
            for share, block in self.pulling
        )

    def forces(self, load: WrapLoad) -> LoopForces:
        """Return the forces in the whole loop under a load, with what its joints lose in friction.

        Of two sprockets the driver stands in the origin and the driven one to its right, the slack strand
        below.
        """
        layout, lever = self.layout, 0.5 * self.chain.pin_diameter * (self.joint_friction or 0.0)
        tensions = np.array(load.spans)
        if isinstance(layout, LoopLayout):
            idle = tuple(share == 0.0 for share in layout.drive.shares)
            return LoopForces(layout.loop, tensions, load.centrifugal, lever, idle)
        wheels = (
            Wheel("driver", (0.0, 0.0), layout.teeth_1),
            Wheel("driven", (layout.centre_distance, 0.0), layout.teeth_2),
        )
        return LoopForces(ChainLoop(layout.pitch, wheels), tensions, load.centrifugal, lever, (False, False))

    def _findings(self, case: Case, among: Sequence[WrapLoad]) -> list[list[RatingFinding]]:
        """What the handbooks say about every load that pulls, each named where there are several."""
        loads = []
        for load in among:
            if load.pull > 0.0:
                of = f"{grouped(load.tension)} N at {load.speed_rpm:.4g} rpm" if len(among) > 1 else ""
                loads.append((of, self.rated_drive(case, load)))
        return findings_by_load(loads, self.service_factor, self.joint_application_factor)

    def ratings(self, case: Case) -> tuple[RatingFinding, ...]:
        """Return what the handbooks say about the drive: of its worst load, but hours of the whole duty."""
        limit = elongation_finding(self.layout, self.joint.elongation_limit)
        shares = [share for share, _ in self.pulling]
        worst = worst_findings(self._findings(case, self.rated))
        return (*with_hours_over_duty(worst, shares, self._findings(case, self.blocks)), limit)

    def notes(self, case: Case) -> list[str]:
        """Return what a designer asks of a chain drive that no rule limits."""
        loaded = self.gaps // math.gcd(self.gaps, case.engaged_every)
        meetings = meetings_note(loaded, self.layout.links, self.joint.alternating)
        silent = rules_without_limit(self._findings(case, self.rated))
        return drive_notes(self.layout, self.rated_drive(case, self.heaviest), silent, meetings)


def over_pins(path: RollerPath, x: Vector, y: Vector, gaps: int) -> float:
    """Return the measurement over pins of the roller's diameter in two gaps worn alike."""
    centres = path.worn(x, y).locus
    lowest = float((centres[0] ** 2 + centres[1] ** 2).min()) ** 0.5
    return measurement_over_pins(lowest, 2.0 * path.roller_radius, gaps)


_SUPPLY = {
    "hardened, greased": "manual",
    "normalised, greased": "manual",
    "hardened, dry": "dry",
    "normalised, dry": "dry",
    "soil-contaminated": "dry",
}
"""Lubricant of a wear condition, where it stands for one."""


def supply_in_words(case: Case) -> tuple[str, str]:
    """Return the words for the supply of the joints, empty where it is not known, and the surroundings."""
    lubrication = case.inputs.get("lubrication") or {}
    of_joints = (case.inputs.get("joint") or {}).get("condition")
    condition = of_joints or case.inputs["wear"].get("condition", "")
    named = lubrication.get("lubricant")
    supplied = _SUPPLY.get(condition, "") if named is None else named if named in LUBRICATIONS else ""
    soil = condition == "soil-contaminated" or lubrication.get("environment") == "soil"
    return supplied, "mud" if soil else lubrication.get("environment", "clean")


def instead_of(case: Case) -> str:
    """Say what to do where a chain must wrap the sprocket, but does not, or that there is no chain."""
    return "this is a pair of gears" if "gear" in case.inputs else "set kind = 'wrap'"


def wrap_drive(
    case: Case, message: str, key: str = "mechanism.kind", where: str = "", others: str = ""
) -> WrapDrive:
    """Return the drive of a case whose chain wraps the sprocket; a fault on others, with what to do."""
    if not isinstance(case.drive, WrapDrive):
        raise CaseError([Fault(f"{message}: {others or instead_of(case)}", key, where or case.name)])
    return case.drive
