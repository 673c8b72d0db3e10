"""Wheels and gauges for CAD and on paper: THE lists of their formats; a new one is a row and its writer."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from wearsim.geometry.wheel_outline import State

DRAWINGS = {
    "pdf": "wearsim.cad.printed_page:pdf_bytes",
    "svg": "wearsim.cad.printed_page:svg_bytes",
    "dxf": "wearsim.cad.printed_page:dxf_bytes",
}
"""Formats of a gauge, and of whatever else is a drawing, with what writes each."""


@dataclass(frozen=True)
class WheelFormat:
    """A format of a wheel for CAD."""

    writer: str = ""  # `module:function` that is imported with its first use; empty for one of `DRAWINGS`
    hub: bool = True  # whether it shows bore and hub
    solid: bool = False  # whether outlines must be closed for it
    one_state: str = ""  # what a file is called that cannot hold both states of a wheel
    library: str = ""  # what the extra of the format's name brings
    endings: tuple[str, ...] = ()  # of files, beside the format's name


WHEELS = {
    "dxf": WheelFormat(),
    "svg": WheelFormat(),
    "csv": WheelFormat("wearsim.cad.wheel_drawing:csv_bytes", hub=False),
    "step": WheelFormat("wearsim.cad.step:step_bytes", solid=True, library="build123d", endings=("stp",)),
    "stl": WheelFormat("wearsim.cad.stl:stl_bytes", solid=True, one_state="an STL file"),
}
"""The first one is what the wheels of a whole drive are written in by default."""

States = Literal["new", "worn", "both"]
STATES: "dict[str, tuple[State, ...]]" = {"new": ("new",), "worn": ("worn",), "both": ("new", "worn")}
"""What is drawn of a wheel."""


def format_by_ending(place: Path) -> str:
    """Format that the ending of a file stands for; the ending itself where there is no such format.

    Examples
    --------
    >>> format_by_ending(Path("wheel.STP")), format_by_ending(Path("wear.gif"))
    ('step', 'gif')
    """
    ending = place.suffix.removeprefix(".").lower()
    return next((name for name, wheel in WHEELS.items() if ending in wheel.endings), ending)
