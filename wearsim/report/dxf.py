"""Outlines as DXF drawings."""

from pathlib import Path

from ezdxf.filemanagement import new
from ezdxf.units import MM

from wearsim.geometry.outline import Outline


def write_dxf(outline: Outline, path: Path) -> None:
    """Write an outline as one closed polyline with arcs, in mm, on the layer OUTLINE.

    Parameters
    ----------
    outline : Outline
        The outline.
    path : pathlib.Path
        File to write.
    """
    drawing = new("R2010", units=MM)
    drawing.layers.add("OUTLINE")
    drawing.modelspace().add_lwpolyline(
        [(x, y, b) for (x, y), b in zip(outline.vertices, outline.bulges, strict=True)],
        format="xyb",
        close=True,
        dxfattribs={"layer": "OUTLINE"},
    )
    drawing.saveas(path)
