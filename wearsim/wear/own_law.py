"""A wear law that a program gives as a function: the depth of a cycle at every point of a flank.

The engine takes the depth of a cycle for the slip of its contact, and a law that is that slip alone: so
compiled steps wear by a function of Python.
"""

import math
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np

from wearsim.catalogue.own_wear_laws import OwnWearLaw
from wearsim.contact.engagement import ContactKind, Engagement, FlankContact
from wearsim.contact.hertz import peak_pressure
from wearsim.errors import CaseError, Fault, WearsimError
from wearsim.geometry.profile_points import Vector
from wearsim.wear.law import WearLaw
from wearsim.wear.python_contact import PythonContact

_ORDER = 24
"""Points of Gauss and Legendre over half a contact; exponents of the pressure from 1 on are good to 1e-8."""

_SMOOTH = 1e-4
"""Relative difference of a depth on twice as many points above which a law is not smooth in the pressure."""

_TRIED = (0.5, 1.0, 1.5)
"""Pressures at which a law is tried, over those of the new flank: worn flanks have others."""

_STEP = 1e-4
"""Relative change of the pressure by which its exponent is found."""


@dataclass(frozen=True)
class SlipLaw(WearLaw):
    """Depth = coefficient * slip, where the contact writes the depth of its own law for the slip."""

    def _numbers(self, kind: ContactKind, coefficient: float) -> Vector:
        return np.array(
            [coefficient, 0.0, 0.0, 0.0, self.case_depth, self.core_factor, *self.severity.numbers]
        )


@cache
def _gauss(order: int) -> tuple[Vector, Vector]:
    nodes, weights = np.polynomial.legendre.leggauss(order)
    return nodes, weights


class DepthFunction:
    """The depth of one cycle by a law of the program, with the constants of a case."""

    def __init__(self, law: OwnWearLaw, constants: dict[str, float], case: str) -> None:
        self.law, self.constants, self.case = law, constants, case

    def fault(self, message: str) -> CaseError:
        """Return an error of the function."""
        return CaseError([Fault(f"{self.law.name!r} {message}", "wear.law", self.case)])

    def per_distance(self, pressure: Vector, load: Vector, speed: Vector, slip: Vector) -> Vector:
        """Return the depth worn off per sliding distance [mm/mm], shape as of the pressure."""
        try:
            found: Any = self.law.function(pressure, load, speed, slip, **self.constants)
            depth = np.broadcast_to(np.asarray(found, dtype=float), pressure.shape)
        except WearsimError:
            raise
        except Exception as error:
            raise self.fault(f"raised {type(error).__name__}: {error}") from error
        wrong = ~(depth >= 0.0) | ~np.isfinite(depth)
        if wrong.any():
            at = np.unravel_index(int(wrong.argmax()), wrong.shape)
            values = (np.broadcast_to(one, depth.shape)[at] for one in (pressure, load, speed, slip))
            shown = ", ".join(f"{value:.4g}" for value in values)
            raise self.fault(
                f"must return a depth of at least 0 everywhere, but gives {depth[at]:.4g} at pressure, load, "
                f"speed and slip of {shown} (nan where a table does not give it)"
            )
        return depth

    def of_cycle(self, touch: Engagement, modulus: float, order: int = _ORDER, scale: float = 1.0) -> Vector:
        """Return the depth of one cycle at every point, at a multiple of the pressure.

        In a travelling contact it is the integral over the width that sweeps a point, 2a = 4 q/(pi sigma_H),
        with sigma = sigma_H cos(theta) at a sin(theta) from the middle.

        Equation physics.md (L1).

        Parameters
        ----------
        touch : Engagement
            The flank in contact.
        modulus : float
            Contact modulus E* [MPa].
        order : int
            Points over half a contact.
        scale : float
            Pressures over those of the contact; its width stays.

        Returns
        -------
        numpy.ndarray
            Depth [mm], 0 where nothing presses or slides.
        """
        curvature = np.maximum(touch.relative_curvature, 0.0)
        rubs = (touch.load_per_width > 0.0) & (touch.slip > 0.0) & (curvature > 0.0)
        load, slip, speed = (one[rubs] for one in (touch.load_per_width, touch.slip, touch.sliding_speed))
        highest = peak_pressure(load, curvature[rubs], modulus)
        found = np.zeros(rubs.size)
        if touch.kind is ContactKind.LOCAL:
            found[rubs] = slip * self.per_distance(scale * highest, load, speed, np.full(load.size, np.nan))
            return found
        nodes, weights = _gauss(order)
        cosine = np.cos(0.25 * math.pi * (nodes + 1.0))[:, None]
        local = self.per_distance(scale * highest * cosine, load, speed, slip)
        mean = 0.25 * math.pi * (weights[:, None] * cosine * local).sum(axis=0)
        found[rubs] = slip * 4.0 * load / (math.pi * highest) * mean
        return found

    def depends_on_slip(self, touch: Engagement, modulus: float) -> bool:
        """Tell whether the depth per sliding distance changes with the slip."""
        twice = self.of_cycle(replace(touch, slip=2.0 * touch.slip), modulus)
        return not np.allclose(twice, 2.0 * self.of_cycle(touch, modulus), rtol=1e-9, atol=0.0)


def own_law(depth: DepthFunction, contact: FlankContact, coefficient: float) -> tuple[SlipLaw, FlankContact]:
    """Return a law of the program for the engine, and the contact that goes with it.

    Raises `CaseError` where the function does not return depths, is not smooth in the pressure, or makes
    the shape of the flank ill-posed.
    """
    touch = contact.new_engagement()
    lowest, highest = _exponents(depth, touch, contact.modulus)
    # The pressure exponent of a law with that of the swept width: as `WearLaw.diffusion` takes it.
    law = SlipLaw(coefficient, highest, 0.0)
    least = SlipLaw(coefficient, lowest, 0.0).diffusion(contact.kind, contact.slip_curvature_exponent)
    if least < -_STEP:
        raise depth.fault(
            "must rise at least with the first power of the pressure here, but rises by the power "
            f"{lowest:.3g} at some point: a pit deepens itself and the problem is ill-posed"
        )
    _check_smooth(depth, touch, contact.modulus)
    return law, replace(contact, kernel=PythonContact(_depth_for_slip(depth, contact)))


def _depth_for_slip(depth: DepthFunction, contact: FlankContact) -> Any:
    """Return a contact that writes the depth of a cycle in the place of the slip."""

    def write(*arrays: Vector) -> None:
        contact.kernel(*arrays)
        load, slip, speed, relative = arrays[-4:]
        touch = Engagement(contact.kind, contact.arc_length, load, np.ones(load.size), slip, speed, relative)
        slip[:] = depth.of_cycle(touch, contact.modulus)

    return write


def _exponents(depth: DepthFunction, touch: Engagement, modulus: float) -> tuple[float, float]:
    """Return the least and the greatest power of the pressure with which the law rises."""
    found = []
    for scale in _TRIED:
        low, high = (depth.of_cycle(touch, modulus, scale=scale * (1.0 + way)) for way in (-_STEP, _STEP))
        worn = (low > 0.0) & (high > 0.0)
        found.append(np.log(high[worn] / low[worn]) / math.log((1.0 + _STEP) / (1.0 - _STEP)))
    powers = np.concatenate(found)
    if not powers.size:
        raise depth.fault("must wear something off the new flank, but gives 0 at all of its points")
    # To more digits than the step is good for: 1 is 1, which leaves the curvature out.
    return round(float(powers.min()), 6), round(float(powers.max()), 6)


def _check_smooth(depth: DepthFunction, touch: Engagement, modulus: float) -> None:
    coarse, fine = (depth.of_cycle(touch, modulus, order) for order in (_ORDER, 2 * _ORDER))
    change = float(np.abs(fine - coarse).max() / fine.max())
    if change > _SMOOTH:
        raise depth.fault(
            "must be smooth in the pressure, but the depth of a cycle changes by "
            f"{100.0 * change:.2g} % on twice as many points of the contact: round off jumps and corners"
        )
