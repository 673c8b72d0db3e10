"""The table [sprocket]."""

from typing import Annotated, Literal

from pydantic import Field

from wearsim.case.schema.table import Table
from wearsim.case.units import NotNegative, Positive


class SprocketTable(Table):
    """Teeth, working flank and the range of contact."""

    teeth: Annotated[int, Field(ge=5, le=1000)]
    profile: Literal["evolute", "points"]
    engaged_every: Annotated[int, Field(ge=1, le=4)] = 1
    points_file: str | None = None
    points_noise_mm: NotNegative | None = None
    face_width_mm: Positive | None = None
    evolute_offset_mm: Positive | None = None
    contact_start_mm: Positive | None = None
    contact_end_mm: Positive | None = None
    back_flank: Literal["relieved", "mirrored"] = "relieved"
    nodes: Annotated[int, Field(ge=11, le=20001)] = 201
