"""A case with every default filled in: what the layers above work on."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from wearsim.case.drive import Drive
from wearsim.fatigue.contact_fatigue import FlankMaterial


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


@dataclass(frozen=True)
class FatigueInput:
    """Contact fatigue as it was asked for."""

    load_factor: float  # K_H on the load, for contact fatigue only
    materials: Mapping[str, FlankMaterial]  # of `pinion` and `wheel`, or of `sprocket`


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
