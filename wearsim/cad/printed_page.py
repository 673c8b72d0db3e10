"""Drawings as files: DXF, and on paper SVG and PDF of the same, 1 mm of it 1 mm of the page."""

import io
from typing import TYPE_CHECKING

from wearsim.cad import DRAWINGS
from wearsim.cad.dxf_writer import Layers, dxf_drawing
from wearsim.geometry.scene import Box, Scene
from wearsim.lazy import named

if TYPE_CHECKING:
    from ezdxf.addons.drawing.config import Configuration
    from ezdxf.document import Drawing

_UNITS_PER_MM = 1e4
"""Of the coordinates of an SVG file, which are whole numbers: steps of 0.1 um."""

_POINTS_PER_MM = 72.0 / 25.4
_THINNEST = 0.1
"""Line in a PDF [points]."""


def drawing_bytes(scene: Scene, layers: Layers, form: str, title: str = "") -> bytes:
    """Return a drawing as the content of a file, in a format of `DRAWINGS`."""
    content: bytes = named(DRAWINGS[form])(dxf_drawing(scene.shapes, layers), scene.box, title)
    return content


def dxf_bytes(drawing: "Drawing", box: Box, title: str) -> bytes:
    """Return a drawing as it is."""
    stream = io.StringIO()
    drawing.write(stream)
    return stream.getvalue().encode()


def svg_bytes(drawing: "Drawing", box: Box, title: str) -> bytes:
    """Return a drawing as SVG in its true size."""
    from ezdxf.addons.drawing.frontend import Frontend
    from ezdxf.addons.drawing.layout import Margins, Page, Settings, Units
    from ezdxf.addons.drawing.properties import RenderContext
    from ezdxf.addons.drawing.svg import SVGBackend
    from ezdxf.math import BoundingBox2d

    left, bottom, width, height = box
    backend = SVGBackend()
    Frontend(RenderContext(drawing), backend, config=_ink(1.0)).draw_layout(drawing.modelspace())
    text = backend.get_string(
        Page(width, height, Units.mm, Margins.all(0.0)),
        settings=Settings(fit_page=False, output_coordinate_space=max(width, height) * _UNITS_PER_MM),
        render_box=BoundingBox2d([(left, bottom), (left + width, bottom + height)]),
    )
    return text.encode()


def pdf_bytes(drawing: "Drawing", box: Box, title: str) -> bytes:
    """Return a drawing as a PDF page in its true size."""
    from ezdxf.addons.drawing.frontend import Frontend
    from ezdxf.addons.drawing.matplotlib import MatplotlibBackend
    from ezdxf.addons.drawing.properties import RenderContext
    from matplotlib.figure import Figure

    left, bottom, width, height = box
    figure = Figure(figsize=(width / 25.4, height / 25.4))
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    backend = MatplotlibBackend(axes, adjust_figure=False)
    ink = _ink(_POINTS_PER_MM)
    Frontend(RenderContext(drawing), backend, config=ink).draw_layout(drawing.modelspace())
    axes.set_aspect("auto")
    axes.set_xlim(left, left + width)
    axes.set_ylim(bottom, bottom + height)
    stream = io.BytesIO()
    metadata = {"Title": title, "CreationDate": None, "Creator": "wearsim"}
    figure.savefig(stream, format="pdf", metadata=metadata)
    return stream.getvalue()


def _ink(units_per_mm: float) -> "Configuration":
    """Colours on white, lines as thick as their layers say."""
    from ezdxf.addons.drawing.config import BackgroundPolicy, Configuration

    return Configuration(
        background_policy=BackgroundPolicy.WHITE, lineweight_scaling=units_per_mm, min_lineweight=_THINNEST
    )
