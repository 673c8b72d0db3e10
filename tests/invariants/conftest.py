"""Every mechanism under one signature, so that no test knows which one it looks at."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest

from wearsim.contact.engagement import ContactKind, FlankContact, Mechanism
from wearsim.contact.prescribed_stress import LineLoad, LoadedPair, StressProfile
from wearsim.contact.synthesised_pair import SynthesisedPair
from wearsim.geometry.forms.evolute import Strand, evolute_flank
from wearsim.geometry.gear.convex_concave import ConvexConcave
from wearsim.geometry.gear.involute import InvolutePair
from wearsim.geometry.gear.mesh import ToothPair
from wearsim.geometry.gear.plane_gearing import PitchCircles
from wearsim.geometry.measured.points import flank_from_points
from wearsim.geometry.profile_points import Profile
from wearsim.geometry.roller_path import roller_path
from wearsim.kernels.gear_pair import SLIP
from wearsim.mechanisms.gear_pair.contact import GearPairMechanism
from wearsim.mechanisms.prescribed.contact import PrescribedMechanism
from wearsim.mechanisms.strand.contact import StrandMechanism
from wearsim.mechanisms.wrap.contact import RollerSliding, WrapBlock, WrapContact
from wearsim.mechanisms.wrap.wrap_mechanism import StrandTensions, WrapChain, WrapMechanism

MODULUS = 2.1e5 / (2.0 * 0.91)
"""Contact modulus of steel on steel [MPa]."""

Build = Callable[..., Mechanism]
"""Of nodes, and of factors on all lengths, on the load and on the sliding."""


def on_strand(profile: Profile, strand: Strand, length: float, load: float, slip: float) -> Mechanism:
    return StrandMechanism(
        strand=Strand(length * strand.centrode_radius, length * strand.roller_radius, length * strand.offset),
        profile=Profile(length * profile.x, length * profile.y),
        contact_end=length * 4.0,
        contact_start=length * 30.67,
        pitch=length * 25.4,
        pull_per_width=load * 5000.0 / 17.0 / length,
        angular_speed=10.0,
        slip_fraction=slip,
        modulus=MODULUS / length**2,
    )


def evolute(nodes: int, length: float = 1.0, load: float = 1.0, slip: float = 1.0) -> Mechanism:
    strand = Strand(25.4 * 20 / (2.0 * np.pi), 7.94, 5.5)
    flank = evolute_flank(strand, 4.0, 30.67, nodes)
    return on_strand(flank.profile, strand, length, load, slip)


def points(nodes: int, length: float = 1.0, load: float = 1.0, slip: float = 1.0) -> Mechanism:
    strand = Strand(25.4 * 20 / (2.0 * np.pi), 7.94, 5.5)
    exact = strand.conjugate_points(np.linspace(4.0, 30.67, 200))
    noise = 1e-4 * np.random.default_rng(3).standard_normal((200, 2))
    flank = flank_from_points(*(exact + noise).T, 1e-4, nodes)
    return on_strand(flank, strand, length, load, slip)


def prescribed(
    kind: ContactKind, nodes: int, length: float = 1.0, load: float = 1.0, slip: float = 1.0
) -> Mechanism:
    u = np.linspace(0.0, 1.0, nodes)
    path = length if kind is ContactKind.LOCAL else 1.0
    return PrescribedMechanism(
        kind=kind,
        arc_length=length * 10.0 * u,
        load_per_width=load / length * 100.0 * (0.4 + 0.6 * np.sin(np.pi * u)),
        slip=slip * path * (0.2 + 0.3 * u),
        sliding_speed=slip * length * 100.0 * (1.0 + u),
        flank_curvature=(-0.05 + 0.02 * u) / length,
        mate_radius=length * 6.0,
        modulus=MODULUS / length**2,
    )


def slip_ratio(nodes: int, length: float = 1.0, load: float = 1.0, slip: float = 1.0) -> Mechanism:
    return prescribed(ContactKind.TRAVELLING, nodes, length, load, slip)


def sliding_distance(nodes: int, length: float = 1.0, load: float = 1.0, slip: float = 1.0) -> Mechanism:
    return prescribed(ContactKind.LOCAL, nodes, length, load, slip)


@dataclass(frozen=True)
class Wrapped:
    """A wrap under the signature of the others."""

    contact: WrapContact

    def mate_columns(self, depth: np.ndarray) -> dict[str, np.ndarray]:
        return {}

    def worn_contact_ratio(self, x: np.ndarray, y: np.ndarray) -> float:
        return np.nan

    def assumptions(self) -> list[str]:
        return self.contact.assumptions()


def wrap(nodes: int, length: float = 1.0, load: float = 1.0, slip: float = 1.0) -> Mechanism:
    """Two rollers in wide round gaps of eight teeth, about the loaded stretch of the outline.

    Large rollers on soft teeth: 0.05 mm off changes little of the contact, so that steps of the
    first order come near enough to their limit.
    """
    pitch, radius, seat = length * 1000.0, length * 200.0, length * 400.0
    lowest = 0.5 * pitch / np.sin(np.pi / 8.0) - radius
    angle = np.radians(np.linspace(10.0, -20.0, nodes))
    outline = Profile(seat * np.sin(angle), lowest + seat * (1.0 - np.cos(angle)))
    mechanism = WrapMechanism(
        outline=outline,
        path=roller_path(outline, radius, (nodes + 1) // 2),
        pitch_angle=0.25 * np.pi,
        wrap_angle=0.225 * np.pi,
        chain=WrapChain(pitch, radius, 0.5 * radius, 5e7 / length, alternating=False),
        pull=StrandTensions(
            load * 1e6, load * 0.9e6, driver=True, friction_roller_tooth=0.0, friction_roller_bush=0.0
        ),
    )
    return Wrapped(
        WrapContact(
            blocks=(WrapBlock(1.0, mechanism, pitch_time=0.1, wear_factor=1.0),),
            face_width=length * 10.0,
            phases=1,
            sliding=RollerSliding(0.0082 * slip, 0.0082 * slip),
            modulus=0.1 * MODULUS / length**2,
            same_link_kind=False,
            elongation_per_cycle=0.0,
            elongation_limit=0.03,
        )
    )


@dataclass(frozen=True)
class Part:
    """A mechanism with another contact."""

    whole: Mechanism
    contact: FlankContact

    def mate_columns(self, depth: np.ndarray) -> dict[str, np.ndarray]:
        return self.whole.mate_columns(depth)

    def worn_contact_ratio(self, x: np.ndarray, y: np.ndarray) -> float:
        return self.whole.worn_contact_ratio(x, y)

    def assumptions(self) -> list[str]:
        return self.whole.assumptions()


def gears(
    pair: ToothPair, stiffness: float, nodes: int, length: float, load: float, slip: float
) -> Mechanism:
    """Gears ten times as large; a part of the sliding, which a gear pair has no number for."""
    torque = load * 400.0 / length * pair.circles.pinion_radius
    stiffness /= length**2
    whole = GearPairMechanism(pair, torque, slip * 10.0, MODULUS / length**2, 1.0, stiffness, nodes)
    columns = whole.contact.columns.copy()
    columns[SLIP] *= slip
    return Part(whole, replace(whole.contact, columns=columns))


def c14(size: float) -> ToothPair:
    """FZG C14."""
    return InvolutePair(
        (16, 24), 4.5 * size, np.radians(20.0), (0.1817, 0.1715), (41.318 * size, 59.272 * size)
    )


def constant_stress(size: float) -> ToothPair:
    load = LineLoad(size * 3000.0 / 54.0, 1)
    stress = StressProfile(np.array([0.0]), np.array([454.16]))
    loaded = LoadedPair(PitchCircles(135.0 * size, 1.5), MODULUS, load, stress, 0.0)
    return SynthesisedPair(loaded, (36, 54), (-7.0 * size, 7.0 * size))


def rigid_gears(nodes: int, length: float = 1.0, load: float = 1.0, slip: float = 1.0) -> Mechanism:
    return gears(c14(10.0 * length), 0.0, nodes, length, load, slip)


def elastic_gears(nodes: int, length: float = 1.0, load: float = 1.0, slip: float = 1.0) -> Mechanism:
    return gears(c14(10.0 * length), 1400.0, nodes, length, load, slip)


def convex_concave(nodes: int, length: float = 1.0, load: float = 1.0, slip: float = 1.0) -> Mechanism:
    size = 10.0 * length
    pair = ConvexConcave(4.5 * size, 17, 34, np.radians(20.0), 10.0 * size, 9.0 * size, 4.5 * size)
    return gears(pair, 100.0, nodes, length, load, slip)


def synthesised(nodes: int, length: float = 1.0, load: float = 1.0, slip: float = 1.0) -> Mechanism:
    return gears(constant_stress(10.0 * length), 1400.0, nodes, length, load, slip)


SMOOTH = (evolute, points, slip_ratio, sliding_distance, wrap)
"""Mechanisms with no kink in the middle of the flank, as gears have one at the pitch point."""

MECHANISMS = (*SMOOTH, rigid_gears, elastic_gears, convex_concave, synthesised)


@pytest.fixture(params=MECHANISMS, ids=lambda build: build.__name__)
def build(request: pytest.FixtureRequest) -> Build:
    """Return the function that builds one of the mechanisms."""
    return request.param


@pytest.fixture(params=SMOOTH, ids=lambda build: build.__name__)
def smooth(request: pytest.FixtureRequest) -> Build:
    """Return the function that builds one of the mechanisms without kinks."""
    return request.param
