"""A chain drive as the published rules of wear life see it.

Written in the handbooks' units: m/s, rpm, kW; elongation as a fraction.
"""

from dataclasses import dataclass

from wearsim.catalogue.catalogues import MOST_STRANDS, environments
from wearsim.chain.power_rating import strand_factor
from wearsim.chain.service_conditions import LUBRICATIONS
from wearsim.errors import CaseError, Fault
from wearsim.lubrication.lubrication_life_factor import LubricationFactor, lubrication_life_factor
from wearsim.lubrication.recommended import recommended_lubrication

RATED_ELONGATION = 0.03
"""At which the rules take a chain for worn out."""


@dataclass(frozen=True)
class PracticeDrive:
    """What the published rules need to know of a drive.

    Raises
    ------
    CaseError
        A number is not above 0, or a word is none of the lubrications or environments.

    Examples
    --------
    A 12B-1 over 21 and 57 teeth that carries 3 kW at 120 rpm:

    >>> conveyor = PracticeDrive(19.05, 21, 57 / 21, 120.0, 124, 3750.0, 89.3, 5.72)
    >>> round(conveyor.power, 3), round(conveyor.pressure, 1), conveyor.recommended
    (3.0, 42.0, 'drip')
    """

    pitch: float  # chain pitch [mm]
    teeth: float  # gaps of the smaller sprocket
    ratio: float  # gaps of the larger sprocket over those of the smaller
    speed: float  # speed of the smaller sprocket [rpm]
    links: float  # links of the chain
    pull: float  # F_t without shocks [N]
    bearing_area: float  # projected area of pin in bush, all strands together [mm2]
    pin_diameter: float  # d2 [mm]
    strands: int = 1  # chains side by side
    series: str = ""  # as in the catalogue: `ISO606-A/ANSI B29.1`, `ISO606-B`, `ISO606-H`, `GOST13568`
    light: bool = False  # whether the chain is no. 41 (085-1)
    elongation: float = RATED_ELONGATION  # at which the chain is worn out, as a fraction
    shock_factor: float = 1.0  # on the pull, f1 of ISO 10823 or the load's part of K_e
    lubrication: str = ""  # word for the supply; empty: as recommended
    environment: str = "clean"  # row of the table of environments
    time_share: float = 1.0  # part of the time that it runs so, of a duty of several blocks

    def __post_init__(self) -> None:
        positive = ("pitch", "teeth", "speed", "links", "pull", "bearing_area", "pin_diameter")
        faults = [
            Fault(f"practice: {name} must be above 0, is {getattr(self, name):g}: give the drive's")
            for name in (*positive, "strands", "elongation", "shock_factor", "time_share")
            if not getattr(self, name) > 0.0
        ]
        words = {"lubrication": ("", *LUBRICATIONS), "environment": tuple(environments())}
        if self.ratio < 1.0:
            faults.append(Fault(f"practice: ratio must be at least 1, is {self.ratio:g}"))
        if self.strands > MOST_STRANDS:
            faults.append(Fault(f"practice: strands must be at most {MOST_STRANDS}, are {self.strands}"))
        faults += [
            Fault(f"practice: {name} must be one of {', '.join(filter(None, known))}, is {word!r}")
            for name, known in words.items()
            if (word := getattr(self, name)) not in known
        ]
        if faults:
            raise CaseError(faults)

    @property
    def chain_speed(self) -> float:
        """V = z p n [m/s]."""
        return self.teeth * self.pitch * self.speed / 6.0e4

    @property
    def power(self) -> float:
        """P = F_t v [kW]."""
        return 1.0e-3 * self.pull * self.chain_speed

    @property
    def pressure(self) -> float:
        """Joint pressure without shocks [MPa]: of several strands that of the one that carries most."""
        return self.pull / (self.bearing_area / self.strands * strand_factor(self.strands))

    @property
    def recommended(self) -> str:
        """Lubrication that is recommended at this pitch and speed."""
        return recommended_lubrication(self.pitch, self.chain_speed)

    @property
    def lubrication_factor(self) -> LubricationFactor:
        """What its lubrication and environment do to its life."""
        supplied = self.lubrication or self.recommended
        return lubrication_life_factor(supplied, self.recommended, self.environment)
