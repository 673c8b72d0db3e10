"""A case with every default filled in, and what its drive answers: what the layers above work on."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple, TypeVar

import numpy as np

from wearsim.case.read_tables import ReadTables
from wearsim.catalogue.own_wear_laws import own_wear_laws
from wearsim.chain.rating_findings import RatingFinding
from wearsim.contact.engagement import ContactKind, Engagement, FlankContact, Mechanism
from wearsim.contact.stop_limits import LIMITS, StopLimit, deepest, stop_limit
from wearsim.errors import CaseError, Fault
from wearsim.fatigue.contact_fatigue import FlankMaterial, fatigue_life
from wearsim.fatigue.endurance import EnduredHours
from wearsim.geometry.profile_points import Vector
from wearsim.geometry.scene import Scene, Stroke
from wearsim.geometry.wheel_outline import WheelShape
from wearsim.input.document import GivenInput, read_document
from wearsim.input.input_origins import input_lines
from wearsim.input.mechanism_registry import read_case
from wearsim.lubrication.model import LubricationInput
from wearsim.notebook import html_rows, one_line

if TYPE_CHECKING:
    from wearsim.case.keys import SprocketTable


@dataclass(frozen=True)
class LoadBlock:
    """A part of the duty in which load and speed are constant; a constant drive is one block."""

    share: float  # of the cycles; those of all blocks sum to 1
    speed_rpm: float  # of the sprocket
    tension: float  # of the tight strand without the centrifugal part, on a straight strand the pull [N]
    centrifugal: float  # tension that the chain's own speed adds [N], 0 on a straight strand
    wear_factor: float  # on the wear coefficient of the tooth; 0 where the other flank bears the load
    joint_factor: float  # on that of the chain's joints, which a straight strand does not have


_Load = TypeVar("_Load", bound=LoadBlock)


def heaviest_block(blocks: tuple[_Load, ...]) -> _Load:
    """Return the block of the largest tension, the first of them where several are alike."""
    return max(blocks, key=lambda block: block.tension)


def on_flank(blocks: tuple[_Load, ...]) -> tuple[_Load, ...]:
    """Return the blocks that load the flank which wears."""
    return tuple(block for block in blocks if block.wear_factor > 0.0)


class Drive:
    """What wears in a case: the answers of a bare flank, of which a mechanism changes what differs."""

    rests: ClassVar[bool] = False
    """Whether mates rest in the outline instead of passing every point of a flank once a cycle."""

    life_tolerance: ClassVar[float] = 1e-3
    """Relative tolerance of a life by default."""

    has_tooth: ClassVar[bool] = False
    """Whether the tooth around the flank is known."""

    @property
    def duty(self) -> tuple[LoadBlock, ...]:
        """Blocks of load on the flank; none where the load is one and the same."""
        return ()

    @property
    def wear_coefficients(self) -> Mapping[str, float]:
        """Wear coefficients of other parts than the flank by their keys."""
        return {}

    @property
    def wear_settings(self) -> Mapping[str, float | str]:
        """Keys that, beside these coefficients, say how those parts wear."""
        return {}

    def alike(self, case: "Case") -> "Case":
        """Return the case that stands for all that wear as this one does, number by number."""
        return case

    def wear_band(self, part: str, wear: "WearInput") -> "WearBand":
        """Return the band of the coefficient that ends the life of a part."""
        return WearBand(wear.low, wear.high, wear.band, wear.band_is_given)

    @property
    def pitch_line_thickness(self) -> float:
        """Chordal thickness of the new tooth on the pitch line [mm]; nan without a tooth."""
        return float("nan")

    @property
    def thinnest(self) -> float:
        """Smallest thickness of the new tooth [mm]; nan without a tooth."""
        return float("nan")

    @property
    def tip_land(self) -> float:
        """Length of the new tip [mm]; nan without a tooth."""
        return float("nan")

    def worn_thickness(self, x: Vector, y: Vector) -> float:
        """Return the thickness on the pitch line that a worn flank leaves [mm]."""
        return float("nan")

    def worn_tip_land(self, x: Vector, y: Vector) -> float:
        """Return the tip land that a worn flank leaves [mm]."""
        return float("nan")

    def teeth_in_words(self, case: "Case") -> str:
        """Return the number of teeth and, if there is one, the chain."""
        return f"{case.inputs['sprocket']['teeth']} teeth"

    def blank_area(self) -> float | None:
        """Return the area of the whole wheel [mm2]; None where its outline is not known."""
        return None

    def profile_columns(self) -> dict[str, Vector]:
        """Return the flank as the columns of a table; empty where there is none."""
        return {}

    def scene(self, engaged_every: int) -> Scene | None:
        """Return the drive to scale; None where no more than a flank is known."""
        return None

    def wheels(self, engaged_every: int, last: Mapping[str, Vector] | None = None) -> tuple[WheelShape, ...]:
        """Return the wheels, worn as in the columns of a flank if given; none where unknown."""
        return ()

    def body(self) -> tuple[Stroke, ...]:
        """Return the steel around the new flank, as far as it is known."""
        return ()

    def mate(self, last: Mapping[str, Vector], node: int) -> tuple[float, str] | None:
        """Return the radius [mm] and the name of what touches the flank at a node; None if it is flat."""
        return None

    def mechanism(self, case: "Case") -> Mechanism:
        """Return what loads every point of the flank once a cycle."""
        raise NotImplementedError(f"{type(self).__name__}: mates rest in the outline")

    def entrainment_speed(self, case: "Case", touch: Engagement) -> Vector:
        """Return the mean speed of both surfaces towards their contact [mm/s], nan where it is not known.

        The contact runs along the flank at v_t, so that its surface comes at v_t and that of a mate that
        slides at v_t - v_s.
        """
        if touch.kind is not ContactKind.TRAVELLING:
            return np.full(touch.slip.size, np.nan)
        with np.errstate(invalid="ignore", divide="ignore"):
            rolling = touch.sliding_speed / touch.slip
        return np.abs(rolling - 0.5 * touch.sliding_speed)

    def stop_limits(self, case: "Case", contact: FlankContact) -> tuple[StopLimit, ...]:
        """Return what ends the life of a flank with this contact, the critical depth first."""
        return self.tooth_limits(case)

    def tooth_limits(self, case: "Case") -> tuple[StopLimit, ...]:
        """Return the limits of a worn flank or outline on its own, the critical depth first."""
        given = {"critical_depth_mm": case.critical_depth, **case.more_limits}
        known = [row for row in LIMITS.values() if row.key in given and (self.has_tooth or not row.needs)]
        # Limits on the depth come first: of several that are met at once the first is named.
        known.sort(key=lambda row: row.worn is not deepest)
        return tuple(
            stop_limit(row.key, given[row.key], partial(row.worn, self)) for row in known if row.worn
        )

    def fatigue_lives(
        self, case: "Case", fatigue: "FatigueInput", stresses: Sequence[tuple[float, float]]
    ) -> dict[str, EnduredHours]:
        """Return the hours until pitting of each part, from the pressures of a duty and their shares."""
        material = fatigue.materials["sprocket"]
        hours = fatigue_life(material, stresses, case.cycles_per_hour, case.run.horizon_hours)
        return {"sprocket": hours}

    def check(self, case: "Case") -> None:
        """Raise where the new drive does not work at all, which takes no run to find."""

    def ratings(self, case: "Case") -> tuple[RatingFinding, ...]:
        """Return what the handbooks say about the drive."""
        return ()

    def notes(self, case: "Case") -> list[str]:
        """Return what a designer asks of a drive that no rule limits."""
        return []


@dataclass(frozen=True)
class WearInput:
    """The wear law as it was given."""

    law: str  # a law of the registry, `wearsim list wear-laws`
    coefficient: float  # k [mm2/N], K [1/MPa^m], the intensity K, or a factor on published constants
    constants: Mapping[str, float]  # all others of the law, by their keys in the order of the registry
    # low, high: the coefficient at the ends of its band, as factors of it
    low: float
    high: float
    band: str  # where the band comes from
    band_is_given: bool = False  # whether the user says it of this drive
    # case_depth, core_factor: depth of the hardened layer [mm] and what the coefficient is multiplied by
    # below it
    case_depth: float = math.inf
    core_factor: float = 1.0
    roller_ratio: float = 0.0  # coefficient of the rollers over that of the teeth
    # running_in_factor, running_in_distance: first coefficient over the lasting one, and the sliding distance
    # [mm] over which the excess falls to 1/e
    running_in_factor: float = 1.0
    running_in_distance: float = 1.0
    # cycles_exponent, reference_hours: power of the accumulated cycles, and the running time [h] after which
    # as much has worn as by a constant coefficient
    cycles_exponent: float = 1.0
    reference_hours: float = 1.0
    # pv_limit, severe_factor: peak pressure times sliding speed [MPa mm/s] beyond which the coefficient is so
    # many times as high
    pv_limit: float = math.inf
    severe_factor: float = 1.0

    @property
    def pressure_exponent(self) -> float:
        """Power m of the pressure; 1 of a law without a key for it."""
        return 1.0 if self.is_own else self.constants.get("pressure_exponent", 1.0)

    @property
    def is_own(self) -> bool:
        """Whether the law is a function that the program gave."""
        return self.law in own_wear_laws()

    @property
    def is_steady(self) -> bool:
        """Whether the coefficient does not change with the cycles run."""
        return self.running_in_factor == 1.0 and self.cycles_exponent == 1.0

    @property
    def changes_with_load(self) -> str:
        """Key of [wear] by which the mechanism of wear changes with load and speed; empty for none."""
        if self.severe_factor != 1.0:
            return "pv_limit_MPa_mm_per_s"
        return "law" if self.law == "t_gamma" or self.is_own else ""


class WearBand(NamedTuple):
    """The ends of the band of a coefficient."""

    # low, high: the coefficient there over that of the case
    low: float
    high: float
    source: str  # where the band comes from
    is_given: bool = False  # whether the user says it of this drive, so that it holds all that is not known


_NORMAL_95 = 1.6448536269514722


def log_deviation(low: float, high: float) -> float:
    """Return the standard deviation of the logarithm of a log-normal factor whose band holds 90 %.

    Examples
    --------
    >>> round(log_deviation(0.5, 2.0), 4)  # ln 2/1.645
    0.4214
    """
    return 0.5 * math.log(high / low) / _NORMAL_95


@dataclass(frozen=True)
class FilmInput:
    """The oil between the flanks and their roughness."""

    viscosity: float  # dynamic [MPa s]
    pressure_viscosity: float  # [1/MPa]
    roughness: float  # composite, rms [mm]


@dataclass(frozen=True)
class RunInput:
    """How the life is calculated."""

    method: str  # `advance` or `per_cycle`
    cycles_per_update: int  # of `per_cycle`
    life_tolerance: float  # relative tolerance of the life
    horizon_hours: float  # running time at which the run ends


@dataclass(frozen=True)
class FatigueInput:
    """Contact fatigue as it was asked for."""

    load_factor: float  # K_H on the load, for contact fatigue only
    materials: Mapping[str, FlankMaterial]  # of `pinion` and `wheel`, or of `sprocket`


@dataclass(frozen=True, eq=False)
class Case(ReadTables):
    """A complete, feasible case.

    Attributes
    ----------
    name : str
        Stem of the file, or ``case``.
    title : str
        What it is about.
    inputs : mapping
        All tables with every default taken, as an input file would give them.
    tables : CaseTables
        The same with keys as attributes, ``case.tables.wear.law``, read-only; `chain`, `sprocket`, `load`,
        `mechanism`, `material`, `joint` and `stop` are attributes of the case too, ``case.load.power_kW``.
    files : tuple of pathlib.Path
        CSV files and drawings that it read.
    input_files : mapping
        Their text by their names, as they were then.
    drive : Drive
        What wears, and what touches it.
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
    more_limits : mapping
        Further limits that were given, by their keys.
    run : RunInput
        How the life is calculated.
    fatigue : FatigueInput or None
        None where contact fatigue is not asked for.
    assumptions, warnings : tuple of str
        What was taken for granted, and what the user should look at.
    given : GivenInput or None
        What it was read from; None for one sprocket of a whole drive.
    lubrication : LubricationInput or None
        How it is lubricated; None where that stays as the wear coefficients say.
    film : FilmInput or None
        The oil between the flanks; None where it is not given.
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
    more_limits: Mapping[str, float]
    run: RunInput
    fatigue: FatigueInput | None
    assumptions: tuple[str, ...]
    warnings: tuple[str, ...]
    given: GivenInput | None = None
    lubrication: LubricationInput | None = None
    film: FilmInput | None = None

    def __repr__(self) -> str:
        return one_line("Case", self.title, f"{len(self.assumptions)} assumptions", *self.warnings[:1])

    def _repr_html_(self) -> str:
        return html_rows(self.title, input_lines(self.inputs, self.assumptions, self.warnings))

    @property
    def complete_inputs(self) -> Mapping[str, Any]:
        """All tables with every default taken."""
        return self.inputs

    @cached_property
    def sprocket(self) -> "SprocketTable | None":
        """Keys of [sprocket]; None where a table gives the loads."""
        return self.tables.sprocket

    @property
    def single_cases(self) -> "dict[str, Case]":
        """Case of the only sprocket by its name, as a whole drive has one of each."""
        return {"sprocket": self}

    @property
    def chain_case(self) -> "Case":
        """Case itself, where a whole drive has one of its chain."""
        return self

    @property
    def cycles_per_hour(self) -> float:
        """Loadings of a gap that carries rollers in an hour: 60 n over turns per cycle.

        Equation physics.md (T1).
        """
        return 60.0 * self.speed_rpm / self.turns_per_cycle

    def with_(self, changes: Mapping[str, Any]) -> "Case":
        """Return the case with other values of some keys, read anew.

        Parameters
        ----------
        changes : mapping
            Values by dotted keys of the input file, or nested tables: numbers in the unit of the key,
            text with a unit such as ``"6 kN"``, words. None removes a key. A value takes the place of
            what says the same in another way: a tension that of a power.

        Returns
        -------
        Case
            Complete as if it had been written so; its title tells the changes.

        Raises
        ------
        CaseError
            What is wrong with it then, or that it is one sprocket of a whole drive.

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
        >>> changed = case.with_({"load.tension_N": "6 kN"})
        >>> changed.inputs["load"]
        {'tension_N': 6000.0, 'speed_rpm': 100.0}
        """
        from wearsim.input.changes import changed

        if self.given is None:
            text = "must be changed as a whole: this is one sprocket of a drive, use with_ of the drive"
            raise CaseError([Fault(text, "", self.name)])
        document = read_document(changed(self.given, changes), ())
        found: Case = read_case(document)
        return found

    def check(self) -> None:
        """Raise `CaseError` where the drive cannot run: a chain that jumps on new teeth."""
        self.drive.check(self)

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
        given = self.given
        if given is not None:
            run = {**given.tables.get("run", {}), "horizon_hours": hours}
            given = replace(given, tables={**given.tables, "run": run})
        return replace(
            self,
            given=given,
            run=replace(self.run, horizon_hours=hours),
            inputs={**self.inputs, "run": {**self.inputs["run"], "horizon_hours": hours}},
            assumptions=(*assumptions, f"{key} = {hours:g} (raised by --require-hours)"),
        )
