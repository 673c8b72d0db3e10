"""A sprocket on a straight strand: the tooth, its load, and what the rest of wearsim asks of it."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from wearsim.case.model import Case, Drive, LoadBlock, heaviest_block, on_flank
from wearsim.catalogue.catalogues import Chain
from wearsim.contact.engagement import Mechanism
from wearsim.geometry.blank import blank_area, tooth_space
from wearsim.geometry.hub import NO_HUB, Hub
from wearsim.geometry.profile_points import Profile, Vector
from wearsim.geometry.scene import (
    Circle,
    Label,
    Scene,
    Stroke,
    around,
    letter_height,
    line,
    straight_arrow,
    turn_arrow,
)
from wearsim.geometry.tooth import Tooth
from wearsim.geometry.wheel_outline import ToothSpace, WheelShape, worn_alike, worn_space
from wearsim.quantities import grouped

_FINE = 2e-4
"""Deviation of the wheel's outline around a flank, as a part of the pitch."""


@dataclass(frozen=True, eq=False)
class StrandDrive(Drive):
    """A sprocket on a straight strand."""

    tooth: Tooth  # around the working flank, with its strand
    contact_end: float  # range of contact x_min, x_max [mm]
    contact_start: float
    face_width: float  # b [mm]
    blocks: tuple[LoadBlock, ...]  # the duty
    slip_fraction: float  # sliding as a fraction of that of a roller that does not turn
    chain: Chain
    evolute: bool  # whether the flank is an evolute profile, so that its evolute is known exactly
    hub: Hub = NO_HUB  # bore, keyway and hub

    has_tooth = True

    @property
    def duty(self) -> tuple[LoadBlock, ...]:
        """Blocks of load on the flank."""
        return on_flank(self.blocks)

    @property
    def heaviest(self) -> LoadBlock:
        """The block of the largest pull on the flank."""
        return heaviest_block(self.duty)

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
        """Return the thickness on the centrode that a worn flank leaves."""
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
        """Return the tip land that a worn flank leaves."""
        return self.tooth.worn_tip_land(x, y)

    def blank_area(self) -> float:
        """Return the area of the whole wheel [mm2]."""
        return blank_area(tooth_space(self.tooth), self.tooth.teeth)

    def profile_columns(self) -> dict[str, Vector]:
        """Return the flank with the centres of its curvature."""
        flank, strand = self.profile, self.tooth.strand
        if self.evolute:
            x = np.linspace(self.contact_end, self.contact_start, flank.x.size)
            curvature = -1.0 / strand.flank_radius(x)
            angle = strand.pressure_angle(x)
            evolute = strand.evolute_points(x)
        else:
            curvature = flank.curvature
            angle = _pressure_angle(flank, strand.height, strand.roller_radius)
            evolute = np.column_stack(
                [flank.x - flank.normal_x / curvature, flank.y - flank.normal_y / curvature]
            )
        return {
            "node": np.arange(1, flank.x.size + 1),
            "x_mm": flank.x,
            "y_mm": flank.y,
            "arc_length_mm": flank.arc_length,
            "curvature_per_mm": curvature,
            "flank_radius_mm": 1.0 / np.abs(curvature),
            "pressure_angle_deg": np.degrees(angle),
            "evolute_x_mm": evolute[:, 0],
            "evolute_y_mm": evolute[:, 1],
        }

    def teeth_in_words(self, case: Case) -> str:
        """Return the number of teeth and the chain."""
        return f"{super().teeth_in_words(case)}, chain {self.chain.in_words}"

    def scene(self, engaged_every: int) -> Scene:
        """Return the sprocket on its strand."""
        (wheel,) = self.wheels(engaged_every)
        return strand_scene(wheel, self.tooth, self.chain.pitch, self.pull, engaged_every)

    def wheels(self, engaged_every: int, last: Mapping[str, Vector] | None = None) -> tuple[WheelShape, ...]:
        """Return the sprocket, new and worn."""
        return (strand_wheel(self.tooth, self.face_width, self.hub, engaged_every, last),)

    def body(self) -> tuple[Stroke, ...]:
        """Return the whole sprocket where its flank is an evolute profile."""
        return (self.wheels(1)[0].sketched("body", _FINE),) if self.evolute else ()

    def mate(self, last: Mapping[str, Vector], node: int) -> tuple[float, str]:
        """Return the roller."""
        return 0.5 * self.chain.roller_diameter, "roller"

    def mechanism(self, case: Case) -> Mechanism:
        """Return the rollers of the heaviest block on the flank."""
        from wearsim.mechanisms.strand.contact import StrandMechanism

        return StrandMechanism(
            strand=self.tooth.strand,
            profile=self.profile,
            contact_end=self.contact_end,
            contact_start=self.contact_start,
            pitch=self.chain.pitch,
            pull_per_width=self.pull / self.face_width,
            angular_speed=2.0 * np.pi * self.heaviest.speed_rpm / 60.0,
            slip_fraction=self.slip_fraction,
            modulus=case.modulus,
        )


def _pressure_angle(flank: Profile, height: float, radius: float) -> Vector:
    """Angle of the normal when the roller on the strand touches; nan where it does not reach."""
    centre_x, centre_y = flank.x + radius * flank.normal_x, flank.y + radius * flank.normal_y
    with np.errstate(invalid="ignore"):
        distance = np.sqrt(centre_x**2 + centre_y**2 - height**2)
    turn = np.arctan2(height, -distance) - np.arctan2(centre_y, centre_x)
    return np.asarray(np.arctan2(flank.normal_y, flank.normal_x) + turn)


def strand_wheel(
    tooth: Tooth, face_width: float, hub: Hub, engaged_every: int, last: Mapping[str, Vector] | None
) -> WheelShape:
    """Return the sprocket, worn to the last snapshot of a run where there is one."""
    new = tooth_space(tooth)
    every = math.gcd(tooth.teeth, engaged_every)
    worn: tuple[ToothSpace, ...] = ()
    if last is not None:
        gone = worn_space(new, np.column_stack([last["x_mm"], last["y_mm"]]))
        worn = tuple(new if number % every else gone for number in range(tooth.teeth))
    notes = (
        "seat and tip are arcs, the tip about the axis; back flank and seat do not wear",
        worn_alike(every),
        *hub.notes,
    )
    radius = tooth.strand.centrode_radius
    return WheelShape("sprocket", (new,) * tooth.teeth, worn, radius, face_width, notes, hub=hub)


def strand_scene(wheel: WheelShape, tooth: Tooth, pitch: float, pull: float, engaged_every: int) -> Scene:
    """Return the sprocket with its straight strand."""
    strand, tip = tooth.strand, tooth.tip_radius
    radius = strand.roller_radius
    reach = math.ceil(1.35 * tip / pitch) * pitch
    rollers = np.arange(-reach, 1.5 * reach, pitch)
    y, above = strand.height, strand.height + 2.2 * radius
    box = around([((0.0, 0.0), tip), ((-reach, y), radius), ((reach, y), radius), ((0.0, y), 2.6 * radius)])
    return Scene(
        box,
        (
            wheel.sketched("worn"),
            Circle("pitch", (0.0, 0.0), strand.centrode_radius),
            line("chain", [(-reach, y), (reach, y)]),
            *(Circle("roller", (x, y), radius) for x in rollers.tolist() if x <= reach + 0.1 * pitch),
            *turn_arrow((0.0, 0.0), 0.3 * tip, -1),
            *straight_arrow((0.45 * reach, above), (0.95 * reach, above), radius),
            Label("text", "strand", (0.7 * reach, y + 2.8 * radius), letter_height(box)),
        ),
        f"A sprocket of {tooth.teeth} teeth to scale under the straight strand that it moves, pitch "
        f"{pitch:g} mm, {strand.offset:.4g} mm inside its centrode.",
        (
            f"{tooth.teeth} teeth, pitch {pitch:g} mm, centrode radius {strand.centrode_radius:.2f} mm, line "
            f"of roller centres {strand.offset:.4g} mm inside it",
            f"a roller in {'every gap' if engaged_every == 1 else f'one gap out of {engaged_every}'}; the "
            "strand is straight and guided: no wrap, no second sprocket",
            f"pull {grouped(pull)} N at most",
        ),
    ).with_scale()
