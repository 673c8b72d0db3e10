"""Drawings as DXF."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from ezdxf.filemanagement import new
from ezdxf.units import MM

from wearsim.geometry.outline import Outline
from wearsim.geometry.scene import Circle, Label, Shape, Stroke

if TYPE_CHECKING:
    from ezdxf.document import Drawing

Layers = Mapping[str, tuple[int, int, str]]
"""Colour, thickness [0.01 mm] and kind of the lines of each role; its name in capitals is the layer's."""


def dxf_drawing(shapes: Iterable[Shape], layers: Layers) -> "Drawing":
    """Return lines, circles and labels as a drawing with a layer for each role."""
    drawing = new("R2010", setup=["linetypes"], units=MM)
    for role, (color, weight, kind) in layers.items():
        drawing.layers.add(role.upper(), color=color, lineweight=weight, linetype=kind)
    space = drawing.modelspace()
    for shape in shapes:
        ink = {"layer": shape.role.upper()}
        if isinstance(shape, Circle):
            space.add_circle(shape.centre, shape.radius, dxfattribs=ink)
        elif isinstance(shape, Label):
            # %%d and the like are codes in a DXF text, and so is a caret.
            plain = " ".join(shape.text.replace("%%", "% %").replace("^", "^ ").split())
            space.add_text(plain, height=shape.height, dxfattribs={**ink, "insert": shape.place})
        elif len(shape.vertices) == 2 and not shape.bulges:
            start, end = shape.vertices.tolist()
            space.add_line(start, end, dxfattribs=ink)
        else:
            rows, bulges = shape.vertices.tolist(), [*shape.bulges]
            bulges += [0.0] * (len(rows) - len(bulges))
            points = [(x, y, bulge) for (x, y), bulge in zip(rows, bulges, strict=True)]
            space.add_lwpolyline(points, format="xyb", close=shape.closed, dxfattribs=ink)
    # The library takes their names from a set: in another order in every process.
    classes = drawing.classes
    classes.add_required_classes(drawing.dxfversion)
    classes.classes = dict(sorted(classes.classes.items()))
    return drawing


def write_dxf(outline: Outline, path: Path) -> None:
    """Write an outline as one closed polyline with arcs, in mm, on the layer OUTLINE."""
    stroke = Stroke("outline", outline.vertices, outline.bulges.tolist(), closed=True)
    dxf_drawing([stroke], {"outline": (7, -3, "Continuous")}).saveas(path)
