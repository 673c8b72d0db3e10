"""Outlines as DXF drawings."""

import io
from pathlib import Path
from typing import TYPE_CHECKING

from ezdxf.filemanagement import new
from ezdxf.units import MM

from wearsim.geometry.outline import Outline
from wearsim.geometry.profile import Vector

if TYPE_CHECKING:
    from ezdxf.document import Drawing


def new_drawing() -> "Drawing":
    """Return an empty drawing in mm."""
    return new("R2010", setup=["linetypes"], units=MM)


def add_polyline(drawing: "Drawing", layer: str, vertices: Vector, bulges: Vector, closed: bool) -> None:
    """Add one polyline with arcs."""
    own = bulges.tolist() + [0.0] * (len(vertices) - len(bulges))
    drawing.modelspace().add_lwpolyline(
        [(x, y, bulge) for (x, y), bulge in zip(vertices.tolist(), own, strict=True)],
        format="xyb",
        close=closed,
        dxfattribs={"layer": layer},
    )


def dxf_text(drawing: "Drawing") -> str:
    """Return a drawing as the text of a DXF file."""
    stream = io.StringIO()
    drawing.write(stream)
    return stream.getvalue()


def write_dxf(outline: Outline, path: Path) -> None:
    """Write an outline as one closed polyline with arcs, in mm, on the layer OUTLINE."""
    drawing = new_drawing()
    drawing.layers.add("OUTLINE")
    add_polyline(drawing, "OUTLINE", outline.vertices, outline.bulges, closed=True)
    drawing.saveas(path)
