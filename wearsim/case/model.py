"""A case with every default filled in: what the layers above work on."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from wearsim.case.tables import PrescribedTable
from wearsim.catalogue.tables import Chain
from wearsim.geometry.profile import Profile
from wearsim.geometry.tooth import Tooth


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
    pull : float
        F_t [N].
    slip_fraction : float
        Sliding as a fraction of that of a roller that does not turn.
    """

    tooth: Tooth
    contact_end: float
    contact_start: float
    face_width: float
    pull: float
    slip_fraction: float

    @property
    def profile(self) -> Profile:
        """The working flank."""
        return self.tooth.flank


@dataclass(frozen=True, eq=False)
class PrescribedDrive:
    """A flank whose load and sliding come from a table.

    Attributes
    ----------
    table : PrescribedTable
        The table.
    slip_fraction : float
        Scales its sliding.
    """

    table: PrescribedTable
    slip_fraction: float


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
        CSV files that it read.
    chain : Chain
        The chain.
    drive : StrandDrive or PrescribedDrive
        What touches the flank.
    modulus : float
        Contact modulus E* [MPa].
    speed_rpm : float
        Speed of the sprocket.
    engaged_every : int
        Every which gap carries a roller.
    wear : WearInput
        The wear law.
    critical_depth : float
        Depth at which the life ends [mm].
    min_tip_land : float
        Tip land at which the life ends [mm], 0 for no such limit.
    run : RunInput
        How the life is calculated.
    assumptions, warnings : tuple of str
        What was taken for granted, and what the user should look at.
    """

    name: str
    title: str
    inputs: Mapping[str, Any]
    files: tuple[Path, ...]
    chain: Chain
    drive: StrandDrive | PrescribedDrive
    modulus: float
    speed_rpm: float
    engaged_every: int
    wear: WearInput
    critical_depth: float
    min_tip_land: float
    run: RunInput
    assumptions: tuple[str, ...]
    warnings: tuple[str, ...]

    @property
    def cycles_per_hour(self) -> float:
        """Loadings of one gap in an hour: 60 n / engaged_every."""
        return 60.0 * self.speed_rpm / self.engaged_every
