"""What ends a life: the one list of limits, and limits on a worn flank.

A limit on a worn tooth is a row of `LIMITS` and its key in the table of names. One whose quantity the row
cannot tell from the tooth, a mechanism adds to its own limits.

Where inside a step a limit is met is found in `wearsim/wear/limit_in_step.py`, by `_retreat` and `_on_limit`
of the reference loop, `wearsim/wear/loop.py`, and for a depth by `part_to_depth` of the kernel
`controlled_steps.py`.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:  # the list is read with every input file, shapes with few
    from wearsim.geometry.profile_points import Vector


class Tooth(Protocol):
    """The tooth around a flank, which limits ask."""

    @property
    def pitch_line_thickness(self) -> float:
        """Chordal thickness of the new tooth on the pitch line [mm]."""

    @property
    def tip_land(self) -> float:
        """Length of the new tip [mm]."""

    def worn_thickness(self, x: "Vector", y: "Vector") -> float:
        """Thickness on the pitch line that a worn flank leaves [mm]."""

    def worn_tip_land(self, x: "Vector", y: "Vector") -> float:
        """Tip land that a worn flank leaves [mm]."""


def deepest(tooth: Tooth, x: "Vector", y: "Vector", depth: "Vector") -> float:
    """Greatest depth of a flank [mm]."""
    return float(depth.max())


@dataclass(frozen=True)
class LimitKey:
    """A key of [stop]: its quantity, and its words.

    In `ending`, ``{value}`` is the limit and ``{depth}`` the same with the digits of a depth.
    """

    key: str  # with its unit, as in the input file
    label: str  # in a form
    ending: str  # what ends a life, in words
    # quantity of the tooth and its worn flank; none where a mechanism has it
    worn: "Callable[[Tooth, Vector, Vector, Vector], float] | None" = None
    new: Callable[[Tooth], float] | None = None  # of a new tooth; none where the quantity starts at 0
    new_words: str = ""  # what that is, in a fault
    needs: str = ""  # what there must be of a tooth for it, in a fault; empty where a flank is enough
    falling: bool = False  # whether the quantity falls to its limit, instead of rising to it
    kind: str = ""  # mechanism that it belongs to; empty where all with a chain have it
    ending_unset: str = ""  # what ends a life where the limit is not the user's
    words: str = ""  # what it is called beside its value; empty where the key tells
    least: float | None = None  # bounds of the value itself
    most: float | None = None


_ATOM = 1e-9
"""Wear depth: a value far below the size of an atom is a typing error."""

_LIST = (
    LimitKey(
        "critical_depth_mm", "Allowable wear depth", "until {depth} mm is worn off", deepest, least=_ATOM
    ),
    LimitKey(
        "wheel_critical_depth_mm",
        "Wheel critical depth",
        "until {depth} mm is worn off the wheel",
        kind="gear_pair",
    ),
    LimitKey(
        "min_tip_land_mm",
        "Smallest width of the tooth tip",
        "until the tip land is down to {value:.3g} mm",
        lambda tooth, x, y, depth: tooth.worn_tip_land(x, y),
        new=lambda tooth: tooth.tip_land,
        new_words="the tip land of the new tooth",
        needs="no tooth and no tip",
        falling=True,
    ),
    LimitKey(
        "case_depth_mm", "Case depth", "until the hardened layer of {depth} mm is gone", deepest, least=_ATOM
    ),
    LimitKey(
        "min_tooth_thickness_mm",
        "Smallest tooth thickness",
        "until a tooth is {value:.3g} mm thick",
        lambda tooth, x, y, depth: tooth.worn_thickness(x, y),
        new=lambda tooth: tooth.pitch_line_thickness,
        new_words="the thickness of the new tooth at the pitch line",
        needs="no tooth",
        falling=True,
    ),
    LimitKey(
        "over_pins_change_mm",
        "Decrease of the measurement over pins",
        "until the measurement over pins is {value:.3g} mm less",
        kind="wrap",
    ),
    LimitKey(
        "min_slack_tension_N",
        "Smallest slack tension",
        "until the chain needs a slack tension of {value:.3g} N on the worn teeth",
        kind="wrap",
        ending_unset="until the chain jumps on the worn teeth",
        words="slack tension needed not to jump",
    ),
    LimitKey(
        "elongation_percent",
        "Elongation of the chain",
        "until the chain elongation reaches {value:.3g} %",
        kind="wrap",
        most=10.0,
    ),
)

LIMITS = {row.key: row for row in _LIST}
"""The one list of limits by their keys, in the order of the input file; the critical depth is the first."""

CHAIN_LIMITS = tuple(row for row in _LIST if row.kind in ("", "wrap"))
"""Those of a drive with a chain."""


@dataclass(frozen=True)
class StopLimit:
    """A limit on the worn flank."""

    name: str  # key of the quantity with its unit, as in the input file
    limit: float  # value at which the life ends
    # of x, y and depth [mm]; above zero as long as the limit is not met
    margin: "Callable[[Vector, Vector, Vector], float]"
    falling: bool = False  # whether the quantity falls to its limit, instead of rising to it

    def value(self, x: "Vector", y: "Vector", depth: "Vector") -> float:
        """Return what the quantity has come to."""
        margin = self.margin(x, y, depth)
        return self.limit + margin if self.falling else self.limit - margin


def stop_limit(name: str, limit: float, value: "Callable[[Vector, Vector, Vector], float]") -> StopLimit:
    """Return the stop limit that a quantity rises or falls to, as the list says.

    Examples
    --------
    >>> import numpy as np
    >>> depth = stop_limit("case_depth_mm", 0.5, lambda x, y, depth: float(depth.max()))
    >>> depth.margin(np.zeros(2), np.zeros(2), np.array([0.1, 0.25]))
    0.25
    >>> tip = stop_limit("min_tip_land_mm", 1.0, lambda x, y, depth: 1.5)
    >>> tip.margin(np.zeros(2), np.zeros(2), np.zeros(2))
    0.5
    """
    if LIMITS[name].falling:
        return StopLimit(name, limit, lambda x, y, depth: value(x, y, depth) - limit, True)
    return StopLimit(name, limit, lambda x, y, depth: limit - value(x, y, depth))


FAR_FROM_JUMPING = 100.0
"""Slack tension over that at which a chain jumps from which on no more is told of this one."""


def jump_limit(slack_tension: float) -> StopLimit:
    """Return the stop limit that a chain meets when it jumps on the worn teeth."""
    return StopLimit("min_slack_tension_N", slack_tension, lambda x, y, depth: 0.0)
