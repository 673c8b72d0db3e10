"""The table [sprocket]."""

from typing import Annotated, Literal

from pydantic import Field

from wearsim.input.schema.table import Table
from wearsim.input.units import NotNegative, Positive

STANDARD_FORMS = ("iso606", "ansi_b29", "gost591")

BETWEEN_FORMS = ("seat_radius_mm", "flank_radius_mm", "seating_angle_deg")
"""What ISO 606 leaves free between its minimum and its maximum form."""

_BELONGS_TO = {
    "form": ("iso606",),
    **dict.fromkeys(BETWEEN_FORMS, ("iso606",)),
    "displaced": ("gost591",),
    "seat_centre": STANDARD_FORMS,
    "tip_diameter_mm": STANDARD_FORMS,
    "points_file": ("points",),
    "points_noise_mm": ("points", "dxf"),
    "dxf_file": ("dxf",),
    "dxf_layer": ("dxf",),
    "back_flank": ("evolute", "points"),
    "evolute_offset_mm": ("evolute", "points"),
    "contact_start_mm": ("evolute", "points"),
    "contact_end_mm": ("evolute", "points"),
}


class SprocketTable(Table):
    """Teeth, tooth form and, on a strand, the range of contact."""

    teeth: Annotated[int, Field(ge=5, le=1000)]
    profile: Literal["evolute", "points", "iso606", "ansi_b29", "gost591", "dxf"]
    role: Literal["driver", "driven"] | None = None
    engaged_every: Annotated[int, Field(ge=1, le=4)] = 1
    form: Literal["min", "max"] | None = None
    seat_radius_mm: Positive | None = None
    flank_radius_mm: Positive | None = None
    seating_angle_deg: Positive | None = None
    displaced: bool | None = None
    seat_centre: Literal["pitch_circle", "root_diameter"] | None = None
    tip_diameter_mm: Positive | None = None
    points_file: str | None = None
    points_noise_mm: NotNegative | None = None
    dxf_file: str | None = None
    dxf_layer: str | None = None
    face_width_mm: Positive | None = None
    evolute_offset_mm: Positive | None = None
    contact_start_mm: Positive | None = None
    contact_end_mm: Positive | None = None
    back_flank: Literal["relieved", "mirrored"] = "relieved"
    nodes: Annotated[int, Field(ge=11, le=20001)] | None = None

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        found = [
            (key, f"belongs to profile = {' or '.join(map(repr, profiles))}: remove it")
            for key, profiles in _BELONGS_TO.items()
            if key in self.model_fields_set and self.profile not in profiles
        ]
        found += [
            (key, f"profile = {self.profile!r} needs this key")
            for key in ("points_file", "dxf_file")
            if self.profile in _BELONGS_TO[key] and getattr(self, key) is None
        ]
        found += [
            (key, f"form = {self.form!r} gives this already: remove one of both")
            for key in BETWEEN_FORMS
            if self.form is not None and getattr(self, key) is not None
        ]
        return found
