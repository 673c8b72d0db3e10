"""The rollers of a case's chain on the gaps that they wrap: without what wears them."""

from wearsim.case.model import Case, WrapDrive
from wearsim.geometry.roller_path import roller_path
from wearsim.mechanisms.wrap.equilibrium import Pull, WrapChain, WrapMechanism


def wrap_mechanism(case: Case, drive: WrapDrive) -> WrapMechanism:
    """Return the mechanism of a chain around a sprocket."""
    radius = 0.5 * drive.chain.roller_diameter
    return WrapMechanism(
        outline=drive.outline,
        path=roller_path(drive.outline, radius, (drive.outline.x.size + 1) // 2),
        pitch_angle=drive.pitch_angle,
        wrap_angle=drive.wrap_angle,
        chain=WrapChain(
            pitch=drive.chain.pitch,
            roller_radius=radius,
            bush_radius=drive.bush_radius,
            link_stiffness=drive.link_stiffness,
            alternating=drive.joint.alternating,
        ),
        pull=Pull(
            tight=drive.heaviest.tension,
            slack=drive.slack,
            driver=drive.driver,
            friction_roller_tooth=drive.friction_roller_tooth,
            friction_roller_bush=drive.friction_roller_bush,
        ),
    )
