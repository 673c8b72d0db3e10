"""Drives of all chains and teeth that may be used: their ratings, and their lives by wear."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import product

from wearsim.catalogue.catalogues import Chain, environments, materials
from wearsim.chain.drive_layout import DriveLayout, layout_with_centre, layout_with_links, least_centre
from wearsim.chain.elongation_limit import elongation_limit
from wearsim.chain.joint_wear import JointBand, JointState, elongation_per_loop, joint_band, joint_law
from wearsim.chain.rating_findings import RatedDrive, RatingFinding, assess, deciding
from wearsim.chain.span_tension import catenary_tension, centrifugal_tension, shaft_load
from wearsim.chain.standard_teeth import standard_tip_diameter
from wearsim.errors import GeometryError
from wearsim.lubrication.clock import band_of_causes
from wearsim.lubrication.lubrication_life_factor import lubrication_life_factor
from wearsim.lubrication.recommended import recommended_lubrication
from wearsim.mechanisms.wrap.drive import LIGHT_CHAIN
from wearsim.study.select.requirements import DriveRequirements

CENTRE_IN_PITCHES = 40.0
"""Centre distance that is sought where it may be chosen; 30 to 50 pitches are usual."""

LEAST_WRAP = math.radians(120.0)
"""Wrap angle of the smaller sprocket below which handbooks do not go."""

SAG = 0.02
"""Sag of the slack span over its length; a case of wearsim has the same."""

LIFE, LUBRICATION = "chain life", "lubrication"
CENTRE, DIAMETER, WRAP = "centre distance", "largest diameter", "wrap angle"


@dataclass(frozen=True)
class Price:
    """What a metre of a chain and a kilogram of its sprockets cost, in a currency of one's own."""

    chain: float  # of a metre of the chain
    sprocket: float  # of a kilogram of a blank

    def of(self, length: float, blanks: float) -> float:
        """Return the price of a length of chain [mm] and of blanks [kg].

        Examples
        --------
        >>> Price(20.0, 5.0).of(1500.0, 4.0)
        50.0
        """
        return 1e-3 * length * self.chain + blanks * self.sprocket


@dataclass(frozen=True)
class Refusal:
    """A limit that a drive does not keep to."""

    limit: str  # name of a rating, or what there is no room or no life for
    used: float  # part of the limit that the drive takes up, above 1


@dataclass(frozen=True)
class CandidateDrive:
    """A chain on two sprockets and what speaks for and against it."""

    chain: Chain
    layout: DriveLayout  # sprocket 1 drives
    speed: float  # of the driver [rpm]
    slack: float  # tension of the slack span, that of its catenary [N]
    centrifugal: float  # tension by the chain's own speed [N]
    pull: float  # F_t [N]
    findings: tuple[RatingFinding, ...]  # what the handbooks say
    life: float  # of the chain by wear of its joints, at their typical wear rate [h]
    life_low: float  # at the high end of it [h]
    life_high: float  # at the low end of it [h]
    lubricated_life: float  # by the published factor of a poorer lubrication than recommended [h]
    tip_diameter: float  # of the larger sprocket [mm]
    mass: float  # of chain and blanks [kg]
    cost: float | None  # of both, None without prices
    refusals: tuple[Refusal, ...]  # none where the drive passes

    @property
    def chain_speed(self) -> float:
        """Mean speed of the chain [m/s]."""
        return self.layout.teeth_1 * self.layout.pitch * self.speed / 6e4

    @property
    def recommended_lubrication(self) -> str:
        """Poorest lubrication that is recommended at its pitch and speed."""
        return recommended_lubrication(self.chain.pitch, self.chain_speed)

    @property
    def shaft_load(self) -> float:
        """Force of both spans on either shaft [N]."""
        return shaft_load(self.pull + self.slack, self.slack, self.layout.inclination)

    @cached_property
    def most_used(self) -> RatingFinding:
        """The rating that leaves least, of those that decide."""
        return max(deciding(self.findings), key=lambda finding: finding.used)


def judged_drives(
    need: DriveRequirements, considered: Sequence[Chain], prices: Mapping[str, Price] | None = None
) -> tuple[CandidateDrive, ...]:
    """Return all drives of some chains, those that are refused with the limits that refuse them."""
    pairs = tuple(need.tooth_pairs())
    return tuple(_judged(need, chain, pair, prices) for chain, pair in product(considered, pairs))


def drive_mass(chain: Chain, layout: DriveLayout) -> tuple[float, float]:
    """Return the masses of the chain and of the blanks of both sprockets.

    q X p, and rho b pi/4 (d1^2 + d2^2): discs of steel of the pitch diameters, as wide as the teeth
    under all strands, without hubs.

    Parameters
    ----------
    chain : Chain
        Mass per length q and width of the teeth b.
    layout : DriveLayout
        Links X, pitch p and pitch diameters.

    Returns
    -------
    tuple of float
        Mass of the chain and of the blanks [kg].

    Examples
    --------
    80 links of 10 mm with 1 kg/m, and discs of 64 mm and 10 mm of steel with 7850 kg/m3:

    >>> chain = Chain("", 10.0, 6.0, 10.0 / 0.93, mass_per_length=1e-6)
    >>> [round(mass, 3) for mass in drive_mass(chain, layout_with_links(10.0, 20, 20, 80))]
    [0.8, 0.504]
    """
    density = 1e-9 * materials()["steel"].density
    area = 0.25 * math.pi * (layout.pitch_diameter_1**2 + layout.pitch_diameter_2**2)
    # t is 1000 kg.
    links = 1e3 * chain.mass_per_length * layout.links * layout.pitch
    return links, density * chain.face_width * area


def chain_life(
    need: DriveRequirements, chain: Chain, layout: DriveLayout, pressures: tuple[float, float]
) -> float:
    """Return how long a chain lives by wear of its joints, at their typical wear rate.

    Growth of a loop by equation (E1), loops by the driver's speed, up to 3 % or 200 % over the teeth
    of the larger sprocket. Dirt makes it shorter by its factor.

    Parameters
    ----------
    need : DriveRequirements
        Speed of the driver, wear rate of the joints and surroundings.
    chain : Chain
        Pin and pitch.
    layout : DriveLayout
        Teeth and links.
    pressures : tuple of float
        Tension of the tight and of the slack span, with their centrifugal part, over the bearing
        area [MPa].

    Returns
    -------
    float
        Life [h].

    Examples
    --------
    One loop a second that grows by 1e-9 pi of the chain; 3 % after 0.03/(3.6e-6 pi) h:

    >>> from dataclasses import replace
    >>> from wearsim.catalogue.catalogues import wear_conditions
    >>> dry = replace(wear_conditions()["hardened, dry"], joint_typical=1e-9)  # wears alike at every speed
    >>> need = DriveRequirements(1.0, 240.0, 1.0, 1.0, joints=dry)
    >>> chain = Chain("", 10.0, 6.0, 6.0, pin_diameter=5.0)
    >>> layout = layout_with_links(10.0, 20, 20, 80)
    >>> round(chain_life(need, chain, layout, (20.0, 0.0)) * 3.6e-6 * math.pi, 12)
    0.03
    """
    teeth = layout.teeth_1, layout.teeth_2
    law = joint_law(need.joints)
    turning = law.turning_factor(_small_speed(need, layout), chain.pitch)
    tight, slack = (law.wearing_pressure(pressure) * turning for pressure in pressures)
    growth = elongation_per_loop(
        law.coefficient, [(tight, slack)] * 2, chain.pin_diameter, chain.pitch, teeth
    )
    loops = 60.0 * need.speed * layout.teeth_1 / layout.links
    dirt = environments()[need.environment].factor
    return elongation_limit(max(teeth)) / (growth * loops * dirt)


def lubricated_life(
    need: DriveRequirements, chain: Chain, layout: DriveLayout, pressures: tuple[float, float], life: float
) -> float:
    """Return the life of a chain by the published factor of a lubrication below the recommended one.

    The factor is on the life with oil as recommended. A condition without oil counts some of it by its
    own rate, so that the shorter life holds: nothing is counted twice.
    """
    if not need.lubrication:
        return life
    recommended = recommended_lubrication(chain.pitch, layout.teeth_1 * chain.pitch * need.speed / 6e4)
    factor = lubrication_life_factor(need.lubrication, recommended, need.environment).factor
    return life if factor >= 1.0 else min(life, factor * chain_life(need.oiled, chain, layout, pressures))


def _small_speed(need: DriveRequirements, layout: DriveLayout) -> float:
    """Return the speed of the smaller sprocket, whose chain speed is that of either one [rpm]."""
    return need.speed * layout.teeth_1 / min(layout.teeth_1, layout.teeth_2)


def _judged(
    need: DriveRequirements, chain: Chain, pair: tuple[int, int], prices: Mapping[str, Price] | None
) -> CandidateDrive:
    """Return a drive of a chain on two numbers of teeth, the smaller one first."""
    small, large = pair
    layout = _layout(need, chain.pitch, *(pair if need.ratio >= 1.0 else (large, small)))
    rated_speed = _small_speed(need, layout)
    slack = catenary_tension(chain.mass_per_length, layout.span, SAG)
    speed = layout.chain_speed(2.0 * math.pi * need.speed / 60.0)
    centrifugal = centrifugal_tension(chain.mass_per_length, speed)
    rated = RatedDrive(
        pitch=chain.pitch,
        teeth=small,
        speed=rated_speed,
        power=need.power,
        strands=chain.strands,
        bearing_area=chain.bearing_area,
        tensile=chain.tensile,
        own_tension=slack + centrifugal,
        series=chain.series,
        light=chain.designation == LIGHT_CHAIN,
    )
    findings = assess(rated, need.service_factor, need.joint_application_factor)
    tight = rated.pull + slack + centrifugal
    pressures = (tight / chain.bearing_area, (slack + centrifugal) / chain.bearing_area)
    life = chain_life(need, chain, layout, pressures)
    lubricated = lubricated_life(need, chain, layout, pressures, life)
    state = JointState(pressures[0], rated_speed, chain.pitch)
    low, high = _life_band(need, life, joint_band(joint_law(need.joints), need.joints, state))
    tip = standard_tip_diameter(chain, large)
    links, blanks = drive_mass(chain, layout)
    price = None if prices is None else prices[chain.designation]
    return CandidateDrive(
        chain=chain,
        layout=layout,
        speed=need.speed,
        slack=slack,
        centrifugal=centrifugal,
        pull=rated.pull,
        findings=findings,
        life=life,
        life_low=low,
        life_high=high,
        lubricated_life=lubricated,
        tip_diameter=tip,
        mass=links + blanks,
        cost=None if price is None else price.of(layout.links * layout.pitch, blanks),
        refusals=(
            *_space_refusals(need, layout, tip),
            *(Refusal(one.name, one.used) for one in deciding(findings) if not one.ok),
            *([Refusal(LIFE, need.hours / life)] if life < need.hours else []),
            *([Refusal(LUBRICATION, need.hours / lubricated)] if lubricated < min(life, need.hours) else []),
        ),
    )


def _life_band(need: DriveRequirements, life: float, rate: JointBand) -> tuple[float, float]:
    """Return the ends of a life by what is known of the rate of the joints and of what dirt does to it."""
    dirt = environments()[need.environment]
    by_dirt = life * dirt.factor / dirt.high, life * dirt.factor / dirt.low
    return band_of_causes(life, [(life / rate.high, life / rate.low), by_dirt])


def _layout(need: DriveRequirements, pitch: float, teeth_1: int, teeth_2: int) -> DriveLayout:
    """Return the drive with an even number of links that fits best between the bounds of its shafts."""
    wanted = need.centre
    if wanted is None:
        wanted = max(CENTRE_IN_PITCHES * pitch, need.centre_min or 0.0)
        wanted = min(wanted, need.centre_max or math.inf)
    wanted = max(wanted, least_centre(pitch, teeth_1, teeth_2))
    above = layout_with_centre(pitch, teeth_1, teeth_2, wanted)
    if need.centre is not None or _centre_used(need, above) <= 1.0:
        return above
    try:
        below = layout_with_links(pitch, teeth_1, teeth_2, above.links - 2)
    except GeometryError:
        return above
    return min(above, below, key=lambda layout: _centre_used(need, layout))


def _centre_used(need: DriveRequirements, layout: DriveLayout) -> float:
    """Return by which factor the shafts of a drive are too near or too far, 1 or less where they are not."""
    if need.centre is not None:
        return least_centre(layout.pitch, layout.teeth_1, layout.teeth_2) / need.centre
    least = (need.centre_min or 0.0) / layout.centre_distance
    return max(least, layout.centre_distance / (need.centre_max or math.inf))


def _space_refusals(need: DriveRequirements, layout: DriveLayout, tip_diameter: float) -> tuple[Refusal, ...]:
    """Return what there is no room for."""
    wrap = min(layout.wrap_angle_1, layout.wrap_angle_2)
    used = {
        CENTRE: _centre_used(need, layout),
        DIAMETER: tip_diameter / (need.max_diameter or math.inf),
        WRAP: LEAST_WRAP / wrap,
    }
    return tuple(Refusal(limit, part) for limit, part in used.items() if part > 1.0)
