"""A wheel as an outline for CAD, new and worn."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from wearsim.geometry.wheel import Chain, Space, ring

State = Literal["new", "worn"]


@dataclass(frozen=True, eq=False)
class WheelShape:
    """A wheel, new and worn."""

    name: str  # `sprocket`, `pinion` or `wheel`
    # new, worn: spaces between the teeth, counterclockwise; no worn ones without a run
    new: tuple[Space, ...]
    worn: tuple[Space, ...]
    # radius of the circle that rolls, or through the centres of the rollers [mm]
    pitch_radius: float
    width: float  # of the face [mm]
    notes: tuple[str, ...]  # what the outline takes for granted
    turn: float = 0.0  # angle by which the first space is turned from +y counterclockwise [rad]
    centre: tuple[float, float] = (0.0, 0.0)  # where the axis lies [mm]
    most_worn: int = 0  # index of a space that is worn most

    def chains(self, state: State) -> tuple[Chain, ...]:
        """Return the outline in one state, where it lies in the drawing."""
        spaces = self.new if state == "new" else self.worn
        return tuple(chain.moved(self.centre) for chain in ring(spaces, self.turn))

    @property
    def tip_radius(self) -> float:
        """Radius of the tips of the new teeth [mm]."""
        space = self.new[0]
        return math.hypot(*(space.left or space.right)[-1].vertices[-1])

    @property
    def root_radius(self) -> float:
        """Least radius of the new outline [mm], of the flanks where there is no root."""
        stretches = self.new[0].right + self.new[0].left
        return min(float(np.hypot(*part.vertices.T).min()) for part in stretches)
