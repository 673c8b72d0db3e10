"""Outlines of wheels as a table of points."""

from collections.abc import Sequence

import numpy as np
import pandas as pd

from wearsim.export.wheel_drawing import CHORD_TOLERANCE
from wearsim.export.wheel_states import State, WheelShape
from wearsim.geometry.outline import along_ways
from wearsim.geometry.wheel import Chain


def wheel_points(shapes: Sequence[WheelShape], states: Sequence[State]) -> pd.DataFrame:
    """Return the outlines of wheels by points."""
    tables = [
        _chain_points(chain).assign(wheel=shape.name, state=state)
        for shape in shapes
        for state in states
        for chain in shape.chains(state)
    ]
    return pd.concat(tables)[["wheel", "state", "tooth", "stretch", "x_mm", "y_mm"]]


def _chain_points(chain: Chain) -> pd.DataFrame:
    rows, numbers, names = [], [], []
    for stretch, tooth in zip(chain.stretches, chain.teeth, strict=True):
        points, _ = along_ways(stretch.vertices[:-1], stretch.vertices[1:], stretch.bulges, CHORD_TOLERANCE)
        if not chain.closed and stretch is chain.stretches[-1]:
            points = np.concatenate([points, stretch.vertices[-1:]])
        rows.append(points)
        numbers += [tooth] * len(points)
        names += [stretch.part] * len(points)
    x, y = np.concatenate(rows).T
    return pd.DataFrame({"tooth": numbers, "stretch": names, "x_mm": x, "y_mm": y})
