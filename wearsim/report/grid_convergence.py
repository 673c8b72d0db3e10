"""A study of three grids, as text and as JSON."""

import math
from typing import Any

from wearsim.report.lines import row
from wearsim.wear.accuracy import LEAST_ORDER, MOST_ORDER, GridStudy


def grid_json(grid: GridStudy) -> dict[str, Any]:
    """Return a study of three grids as ``wearsim life --verify-grid --json`` prints it."""
    return {
        "nodes": list(grid.points),
        "quantity": grid.quantity,
        "values": list(grid.values),
        "order": None if math.isnan(grid.order) else grid.order,
        "error": grid.error,
        "richardson": grid.extrapolates,
    }


def grid_text(grid: GridStudy) -> str:
    """Return a study of three grids as ``wearsim life --verify-grid`` prints it."""
    nodes = ", ".join(map(str, grid.points))
    values = ", ".join(f"{value:.7g}" for value in grid.values)
    unit = "cycles" if grid.quantity == "cycles" else "mm deep"
    if grid.extrapolates:
        found = f"order {grid.order:.2f}, Richardson error {grid.error:.1g}"
    else:
        order = "no order" if math.isnan(grid.order) else f"order {grid.order:.2g}"
        found = (
            f"{order} instead of {LEAST_ORDER:g} to {MOST_ORDER:g}, so no extrapolation: spread of the "
            f"three {grid.error:.1g}"
        )
    return row("Grid", f"{nodes} nodes: {values} {unit}; {found}")
