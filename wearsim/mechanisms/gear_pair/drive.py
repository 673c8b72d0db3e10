"""A pinion and a wheel: their wear, and contact fatigue until pitting is to be expected."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from wearsim.case.model import Case, Drive, FatigueInput
from wearsim.contact.engagement import Engagement, FlankContact, Mechanism
from wearsim.contact.hertz import peak_pressure
from wearsim.contact.stop_limits import StopLimit, stop_limit
from wearsim.fatigue.contact_fatigue import fatigue_life
from wearsim.fatigue.endurance import EnduredHours, cycles_per_hour
from wearsim.geometry.gear.mesh import ToothPair
from wearsim.geometry.profile_points import Vector
from wearsim.geometry.scene import Scene
from wearsim.geometry.wheel_outline import WheelShape
from wearsim.kernels.gear_pair import MATE_DEPTH


@dataclass(frozen=True, eq=False)
class GearDrive(Drive):
    """A pinion and a wheel."""

    pair: ToothPair  # the new gears
    face_width: float  # b [mm]
    torque: float  # of the pinion [N mm]
    stiffness: float  # of a pair of teeth per face width [N/mm2]; 0 for rigid teeth
    wheel_wear_ratio: float  # wear coefficient of the wheel over that of the pinion
    points: int  # of the flank

    @property
    def pitch_point_load(self) -> float:
        """Normal load over face width of one pair of teeth at the pitch point [N/mm]."""
        lever = self.pair.circles.pinion_radius * math.cos(self.pair.pitch_point_angle)
        return self.torque / (lever * self.face_width)

    def teeth_in_words(self, case: Case) -> str:
        """Return the numbers of teeth."""
        return f"{self.pair.teeth[0]} and {self.pair.teeth[1]} teeth"

    def scene(self, engaged_every: int) -> Scene:
        """Return both gears."""
        from wearsim.mechanisms.gear_pair.scene import gear_scene

        return gear_scene(self.pair, self.points)

    def wheels(self, engaged_every: int, last: Mapping[str, Vector] | None = None) -> tuple[WheelShape, ...]:
        """Return pinion and wheel, new and worn."""
        from wearsim.mechanisms.gear_pair.scene import gear_wheels

        return gear_wheels(self.pair, self.points, self.face_width, last)

    def mate(self, last: Mapping[str, Vector], node: int) -> tuple[float, str]:
        """Return the wheel's flank where it meets the pinion's."""
        mesh = self.pair.mesh(self.points)
        curvature = float(np.interp(last["path_mm"][node], mesh.pitch_point_distance, mesh.curvature[1]))
        return 1.0 / curvature, "wheel"

    def mechanism(self, case: Case) -> Mechanism:
        """Return both flanks, in the cycles of the pinion."""
        from wearsim.mechanisms.gear_pair.contact import GearPairMechanism

        return GearPairMechanism(
            pair=self.pair,
            torque=self.torque / self.face_width,
            angular_speed=2.0 * np.pi * case.speed_rpm / 60.0,
            modulus=case.modulus,
            mate_coefficient=self.wheel_wear_ratio,
            stiffness=self.stiffness,
            points=self.points,
        )

    def entrainment_speed(self, case: Case, touch: Engagement) -> Vector:
        """Return the mean speed at which the contact runs along both flanks [mm/s]."""
        rolling = self.pair.mesh(self.points).rolling
        return np.asarray(np.pi * case.speed_rpm / 60.0 * rolling.sum(axis=0))

    def stop_limits(self, case: Case, contact: FlankContact) -> tuple[StopLimit, ...]:
        """Return the limits of the pinion's flank, and that of the wheel."""
        ratio, key = contact.columns[MATE_DEPTH], "wheel_critical_depth_mm"
        wheel = stop_limit(key, case.more_limits[key], lambda x, y, depth: float((ratio * depth).max()))
        return (*self.tooth_limits(case), wheel)

    def fatigue_lives(
        self, case: Case, fatigue: FatigueInput, stresses: Sequence[tuple[float, float]]
    ) -> dict[str, EnduredHours]:
        """Return the hours for which the contact stress of the new flanks is allowed.

        It is that at the pitch point of source document 001, or the highest on the path of contact if that is
        more; both by strength.md (21) to (26) under the constant load.
        """
        ((highest, _),) = stresses
        stress = max(pitch_point_stress(self, fatigue.load_factor, case.modulus), highest)
        speeds = {"pinion": case.speed_rpm, "wheel": case.speed_rpm / self.pair.circles.gear_ratio}
        return {
            name: fatigue_life(
                fatigue.materials[name], [(stress, 1.0)], cycles_per_hour(speed), case.run.horizon_hours
            )
            for name, speed in speeds.items()
        }


def pitch_point_stress(drive: GearDrive, load_factor: float, modulus: float) -> float:
    """Return the contact stress at the pitch point, where one pair of teeth carries the whole load.

    Equation gears.md (7).

    Parameters
    ----------
    drive : GearDrive
        The gears.
    load_factor : float
        K_H on the load.
    modulus : float
        Contact modulus E* [MPa].

    Returns
    -------
    float
        sigma_H of the new flanks with the load factor [MPa], source document 001.
    """
    curvature = 1.0 / float(drive.pair.circles.pitch_point_radius(drive.pair.pitch_point_angle))
    return float(peak_pressure(load_factor * drive.pitch_point_load, curvature, modulus))
