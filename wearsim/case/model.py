"""A case with every default filled in: what the layers above work on."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from wearsim.case.flank_endurance import FatigueInput
from wearsim.catalogue.catalogues import Chain
from wearsim.chain.drive_layout import DriveLayout
from wearsim.geometry.gap import Gap
from wearsim.geometry.gear.mesh import ToothPair
from wearsim.geometry.profile import Profile, Vector
from wearsim.geometry.tooth import Tooth
from wearsim.geometry.worn_tooth import tip_land, tooth_thickness
from wearsim.input.csv_tables import PrescribedTable


@dataclass(frozen=True)
class Block:
    """A part of the duty in which load and speed are constant; a constant drive is one block.

    Attributes
    ----------
    share : float
        Of the cycles; those of all blocks sum to 1.
    speed_rpm : float
        Speed of the sprocket.
    tension : float
        Of the tight strand without the centrifugal part, on a straight strand the pull [N].
    centrifugal : float
        Tension that the chain's own speed adds [N], 0 on a straight strand.
    wear_factor : float
        On the wear coefficient of the tooth.
    joint_factor : float
        On that of the chain's joints, which a straight strand does not have.
    """

    share: float
    speed_rpm: float
    tension: float
    centrifugal: float
    wear_factor: float
    joint_factor: float


def heaviest(blocks: tuple[Block, ...]) -> Block:
    """Return the block of the largest tension.

    Parameters
    ----------
    blocks : tuple of Block
        A duty.

    Returns
    -------
    Block
        The first of them where several are alike.
    """
    return max(blocks, key=lambda block: block.tension)


@dataclass(frozen=True, eq=False)
class StrandDrive:
    """A sprocket on a straight strand.

    Attributes
    ----------
    tooth : Tooth
        The tooth around the working flank, with its strand.
    contact_end, contact_start : float
        Range of contact x_min, x_max [mm].
    face_width : float
        b [mm].
    blocks : tuple of Block
        The duty.
    slip_fraction : float
        Sliding as a fraction of that of a roller that does not turn.
    chain : Chain
        The chain.
    """

    tooth: Tooth
    contact_end: float
    contact_start: float
    face_width: float
    blocks: tuple[Block, ...]
    slip_fraction: float
    chain: Chain

    @property
    def heaviest(self) -> Block:
        """The block of the largest pull."""
        return heaviest(self.blocks)

    @property
    def pull(self) -> float:
        """F_t of the heaviest block [N]."""
        return self.heaviest.tension

    @property
    def profile(self) -> Profile:
        """The working flank."""
        return self.tooth.flank

    @property
    def pitch_line_thickness(self) -> float:
        """Chordal thickness of the tooth where the centrode meets it [mm]."""
        return self.tooth.pitch_line_thickness

    def worn_thickness(self, x: Vector, y: Vector) -> float:
        """Return the thickness on the centrode that a worn flank leaves.

        Parameters
        ----------
        x, y : numpy.ndarray
            Points of the worn flank [mm].

        Returns
        -------
        float
            Chordal thickness [mm]; the back flank does not wear.
        """
        return self.tooth.worn_thickness(x, y)

    @property
    def thinnest(self) -> float:
        """Smallest chordal thickness along the flank [mm]."""
        return self.tooth.neck

    @property
    def tip_land(self) -> float:
        """Length of the tip [mm]."""
        return self.tooth.tip_land

    def worn_tip_land(self, x: Vector, y: Vector) -> float:
        """Return the tip land that a worn flank leaves.

        Parameters
        ----------
        x, y : numpy.ndarray
            Points of the worn flank [mm].

        Returns
        -------
        float
            Length along the tip circle [mm].
        """
        return self.tooth.worn_tip_land(x, y)


@dataclass(frozen=True, eq=False)
class PrescribedDrive:
    """A flank whose load and sliding come from a table.

    Attributes
    ----------
    table : PrescribedTable
        The table.
    slip_fraction : float
        Scales its sliding.
    chain : Chain
        The chain whose roller touches it.
    """

    table: PrescribedTable
    slip_fraction: float
    chain: Chain


@dataclass(frozen=True)
class JointInput:
    """Wear of the chain's joints.

    Attributes
    ----------
    coefficient : float
        Specific wear rate of pin and bush together [mm2/N].
    bearing_area : float
        Projected area of pin in bush [mm2].
    alternating : bool
        Whether wear lengthens every other link only, as it does.
    elongation_limit : float
        Relative elongation at which the chain's life ends.
    """

    coefficient: float
    bearing_area: float
    alternating: bool
    elongation_limit: float


@dataclass(frozen=True, eq=False)
class WrapDrive:
    """A chain around a sprocket.

    Attributes
    ----------
    outline : Profile
        The gap from its right tip through the seat to its left tip.
    gap : Gap or None
        The exact arcs of a standard form.
    gaps : int
        Gaps of the worn sprocket.
    pitch_angle : float
        Angle between successive rollers on it [rad].
    layout : DriveLayout
        Both sprockets and the chain.
    driver : bool
        Whether the worn sprocket drives the chain; it is number 1 of the layout then.
    wrap_angle : float
        Of the worn sprocket [rad].
    face_width : float
        b [mm].
    blocks : tuple of Block
        The duty.
    rated : tuple of Block
        Loads that strength, ratings and the grip of the chain are judged by.
    slack : float
        Tension of the slack strand without the centrifugal part [N].
    link_stiffness : float
        Of one link [N/mm].
    bush_radius : float
        Outer radius of the bush [mm].
    phases : int
        Phases of one pitch.
    slip_fraction : float
        Sliding as a fraction of that of a roller that does not turn.
    friction_roller_tooth, friction_roller_bush : float
        Coefficients of friction.
    joint : JointInput
        Wear of the joints.
    service_factor : float
        f1 on the power in the ratings.
    exploitation_factor : float
        K_e on the joint pressure in the ratings.
    chain : Chain
        The chain.
    """

    outline: Profile
    gap: Gap | None
    gaps: int
    pitch_angle: float
    layout: DriveLayout
    driver: bool
    wrap_angle: float
    face_width: float
    blocks: tuple[Block, ...]
    rated: tuple[Block, ...]
    slack: float
    link_stiffness: float
    bush_radius: float
    phases: int
    slip_fraction: float
    friction_roller_tooth: float
    friction_roller_bush: float
    joint: JointInput
    service_factor: float
    exploitation_factor: float
    chain: Chain

    @property
    def heaviest(self) -> Block:
        """The rated load of the largest tension."""
        return heaviest(self.rated)

    @property
    def profile(self) -> Profile:
        """The outline that wears."""
        return self.outline

    @property
    def pitch_line_thickness(self) -> float:
        """Chordal thickness of the tooth on the pitch circle [mm]."""
        return self.worn_thickness(self.outline.x, self.outline.y)

    def worn_thickness(self, x: Vector, y: Vector) -> float:
        """Return the thickness on the pitch circle that a worn outline leaves.

        Parameters
        ----------
        x, y : numpy.ndarray
            Points of the worn outline [mm].

        Returns
        -------
        float
            Chordal thickness [mm].
        """
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
        """Return the tip land that a worn outline leaves.

        Parameters
        ----------
        x, y : numpy.ndarray
            Points of the worn outline [mm].

        Returns
        -------
        float
            Length along the tip circle [mm].
        """
        return tip_land(x, y, self.gaps)


@dataclass(frozen=True, eq=False)
class GearDrive:
    """A pinion and a wheel.

    Attributes
    ----------
    pair : ToothPair
        The new gears.
    face_width : float
        b [mm].
    torque : float
        Of the pinion [N mm].
    stiffness : float
        Of a pair of teeth per face width [N/mm2]; 0 for rigid teeth.
    wheel_wear_ratio : float
        Wear coefficient of the wheel over that of the pinion.
    points : int
        Of the flank.
    """

    pair: ToothPair
    face_width: float
    torque: float
    stiffness: float
    wheel_wear_ratio: float
    points: int

    @property
    def pole_load(self) -> float:
        """Normal load over face width of one pair of teeth in the pole [N/mm]."""
        lever = self.pair.circles.pinion_radius * math.cos(self.pair.pole_angle)
        return self.torque / (lever * self.face_width)


ChainDrive = StrandDrive | PrescribedDrive | WrapDrive
Drive = ChainDrive | GearDrive


@dataclass(frozen=True)
class WearInput:
    """The wear law as it was given.

    Attributes
    ----------
    law : str
        ``archard``, ``power`` or ``drozdov``.
    coefficient : float
        k [mm2/N], K [1/MPa^m] or the intensity K.
    pressure_exponent : float
        m; 1 for archard.
    hardness, reference_speed, speed_exponent : float
        H [MPa], v0 [mm/s] and n of the Drozdov law; 1, 1 and 0 for the others.
    low, high : float
        The coefficient at the ends of its band, as factors of it.
    band : str
        Where the band comes from.
    case_depth, core_factor : float
        Depth of the hardened layer [mm] and what the coefficient is multiplied by below it.
    roller_ratio : float
        Coefficient of the rollers over that of the teeth.
    running_in_factor, running_in_distance : float
        First coefficient over the lasting one, and the sliding distance [mm] over which the
        excess falls to 1/e.
    """

    law: str
    coefficient: float
    pressure_exponent: float
    hardness: float
    reference_speed: float
    speed_exponent: float
    low: float
    high: float
    band: str
    case_depth: float = math.inf
    core_factor: float = 1.0
    roller_ratio: float = 0.0
    running_in_factor: float = 1.0
    running_in_distance: float = 1.0


@dataclass(frozen=True)
class RunInput:
    """How the life is calculated.

    Attributes
    ----------
    method : str
        ``advance`` or ``per_cycle``.
    cycles_per_update : int
        Of ``per_cycle``.
    life_tolerance : float
        Relative tolerance of the life.
    horizon_hours : float
        Running time at which the run ends.
    """

    method: str
    cycles_per_update: int
    life_tolerance: float
    horizon_hours: float


@dataclass(frozen=True, eq=False)
class Case:
    """A complete, feasible case.

    Attributes
    ----------
    name : str
        Stem of the file, or ``case``.
    title : str
        What it is about.
    inputs : mapping
        All tables with every default taken, as an input file would give them.
    files : tuple of pathlib.Path
        CSV files and drawings that it read.
    input_files : mapping
        Their text by their names, as they were then.
    drive : StrandDrive, PrescribedDrive, WrapDrive or GearDrive
        What touches the flank.
    modulus : float
        Contact modulus E* [MPa].
    speed_rpm : float
        Speed of the sprocket, the mean over the time of its duty; of the pinion.
    engaged_every : int
        Every which gap carries a roller.
    turns_per_cycle : int
        Turns between two loadings of a gap that carries rollers: engaged_every over its
        greatest common divisor with the number of gaps.
    wear : WearInput
        The wear law.
    critical_depth : float
        Depth at which the life ends [mm].
    min_tip_land : float
        Tip land at which the life ends [mm], 0 for no such limit.
    more_limits : mapping
        Further limits of the worn tooth by their keys.
    run : RunInput
        How the life is calculated.
    fatigue : FatigueInput or None
        None where contact fatigue is not asked for.
    assumptions, warnings : tuple of str
        What was taken for granted, and what the user should look at.
    """

    name: str
    title: str
    inputs: Mapping[str, Any]
    files: tuple[Path, ...]
    input_files: Mapping[str, str]
    drive: Drive
    modulus: float
    speed_rpm: float
    engaged_every: int
    turns_per_cycle: int
    wear: WearInput
    critical_depth: float
    min_tip_land: float
    more_limits: Mapping[str, float]
    run: RunInput
    fatigue: FatigueInput | None
    assumptions: tuple[str, ...]
    warnings: tuple[str, ...]

    @property
    def cycles_per_hour(self) -> float:
        """Loadings of a gap that carries rollers in an hour: 60 n over turns per cycle.

        Equation physics.md (T1).
        """
        return 60.0 * self.speed_rpm / self.turns_per_cycle

    def with_horizon(self, hours: float) -> "Case":
        """Return the case with a horizon of at least so many hours, for a life that is required.

        Parameters
        ----------
        hours : float
            Running time [h].

        Returns
        -------
        Case
            Its inputs and assumptions tell of a horizon that was raised.
        """
        if hours <= self.run.horizon_hours:
            return self
        key = "run.horizon_hours"
        assumptions = [text for text in self.assumptions if not text.startswith(key)]
        return replace(
            self,
            run=replace(self.run, horizon_hours=hours),
            inputs={**self.inputs, "run": {**self.inputs["run"], "horizon_hours": hours}},
            assumptions=(*assumptions, f"{key} = {hours:g} (raised by --require-hours)"),
        )
