"""What a wheel has about its axis: a bore with a keyway, and a hub on one side of the face."""

import math
from dataclasses import dataclass

import numpy as np

from wearsim.geometry.outline import Outline


def circle(diameter: float) -> Outline:
    """Return a circle about the origin as two half circles."""
    radius = 0.5 * diameter
    return Outline(np.array([[radius, 0.0], [-radius, 0.0]]), np.ones(2))


@dataclass(frozen=True)
class Hub:
    """Bore, keyway and hub of a wheel; 0 where there is none."""

    bore: float = 0.0  # diameter [mm]
    keyway_width: float = 0.0  # [mm]
    keyway_depth: float = 0.0  # from the edge of the bore, on the keyway's centre line [mm]
    hub_diameter: float = 0.0  # [mm]
    hub_length: float = 0.0  # beyond the face [mm]

    @property
    def bore_reach(self) -> float:
        """Greatest distance of bore and keyway from the axis [mm].

        Examples
        --------
        The corners of a keyway 6 mm wide lie 3 mm beside its centre line:

        >>> Hub(bore=7.0, keyway_width=6.0, keyway_depth=0.5).bore_reach
        5.0
        """
        return math.hypot(0.5 * self.keyway_width, 0.5 * self.bore + self.keyway_depth)

    @property
    def reach(self) -> float:
        """Greatest distance of bore, keyway and hub from the axis [mm]."""
        return max(self.bore_reach, 0.5 * self.hub_diameter)

    @property
    def bore_outline(self) -> Outline | None:
        """Bore about the origin with its keyway on +y: an arc and three lines; None without a bore.

        Examples
        --------
        A keyway from edge to edge of a bore of 2 mm, 1 mm deep: a half circle and a rectangle.

        >>> outline = Hub(bore=2.0, keyway_width=2.0, keyway_depth=1.0).bore_outline
        >>> round(outline.area - 0.5 * math.pi, 12)
        4.0
        """
        if not self.bore:
            return None
        if not self.keyway_width:
            return circle(self.bore)
        radius, half = 0.5 * self.bore, 0.5 * self.keyway_width
        edge, bottom = math.sqrt(radius**2 - half**2), radius + self.keyway_depth
        sweep = math.tau - 2.0 * math.asin(half / radius)
        vertices = np.array([[half, edge], [half, bottom], [-half, bottom], [-half, edge]])
        return Outline(vertices, np.array([0.0, 0.0, 0.0, math.tan(0.25 * sweep)]))

    @property
    def notes(self) -> tuple[str, ...]:
        """What there is, in words."""
        found = []
        if self.bore:
            keyway = f", keyway {self.keyway_width:g} mm wide and {self.keyway_depth:g} mm deep"
            where = " on the centre line of a gap"
            found.append(f"bore {self.bore:g} mm{keyway + where if self.keyway_width else ''}")
        if self.hub_diameter:
            found.append(f"hub {self.hub_diameter:g} mm, {self.hub_length:g} mm beyond one side of the face")
        return tuple(found)


NO_HUB = Hub()
"""Of a wheel without any of them."""
