"""Wear averaged over a duty of several loads."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

from wearsim.contact.engagement import Kind
from wearsim.wear.law import Law


@dataclass(frozen=True)
class DutyPart:
    """A part of a duty, relative to the load and speed that a contact is made for.

    Attributes
    ----------
    share : float
        Of the cycles.
    load, speed : float
        Over those of the contact.
    wear_factor : float
        On the wear coefficient.
    """

    share: float
    load: float
    speed: float
    wear_factor: float


def equivalent_factor(law: Law, kind: Kind, parts: Iterable[DutyPart]) -> float:
    """Return the factor on the coefficient that puts one constant load in the place of a duty.

    Where load and sliding speed at every point are proportional to those of the drive and the
    slip does not depend on them, the depth of a cycle is proportional to
    load^((m+1)/2) speed^n in a travelling contact and to load^(m/2) speed^n in a local one
    (sigma ~ sqrt(load), swept width ~ sqrt(load)), whatever the worn shape. The mean
    over the cycles is then exact.

    Equation physics.md (R4).

    Parameters
    ----------
    law : Law
        The wear law.
    kind : Kind
        How the contact meets the points; not one that dwells.
    parts : iterable of DutyPart
        The duty, shares summing to 1.

    Returns
    -------
    float
        Sum of share * wear_factor * load^p * speed^n.

    Examples
    --------
    Half of the cycles at a quarter of the load, m = 2: (1 + 0.25^1.5)/2

    >>> parts = [DutyPart(0.5, 1.0, 1.0, 1.0), DutyPart(0.5, 0.25, 1.0, 1.0)]
    >>> equivalent_factor(Law(1e-12, 2.0, 0.0), Kind.TRAVELLING, parts)
    0.5625
    """
    pressure, load, speed = (float(number) for number in law.numbers(kind)[1:4])
    exponent = 0.5 * pressure + load
    return math.fsum(
        part.share * part.wear_factor * part.load**exponent * part.speed**speed for part in parts
    )
