"""THE list of tooth forms: a new standard is a row here and the file of its gap."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from wearsim.lazy import named

if TYPE_CHECKING:
    from wearsim.geometry.gap import Gap

BETWEEN_FORMS = ("seat_radius_mm", "flank_radius_mm", "seating_angle_deg")
"""What ISO 606 leaves free between its minimum and its maximum form."""

_STRAND = ("evolute_offset_mm", "contact_start_mm", "contact_end_mm", "back_flank")
_STANDARD = ("seat_centre", "tip_diameter_mm")


@dataclass(frozen=True)
class ToothForm:
    """What a value of `sprocket.profile` stands for; the gap of a standard is imported with its first use."""

    own_keys: tuple[str, ...] = ()  # of [sprocket], that belong to it
    file: str = ""  # the one of them that it cannot do without
    on_strand: str = ""  # what its sprocket is called on a guided strand; empty where it is made for a wrap
    standard_gap: str = ""  # `module:function`; empty where no standard gives it
    options: Mapping[str, Any] = field(default_factory=dict)  # keys that the function takes, with defaults
    series: tuple[str, ...] = ()  # of the catalogue, whose chains it is cut for
    usual_for: tuple[str, ...] = ()  # those of them for which new sprockets have this form

    @property
    def keys(self) -> tuple[str, ...]:
        """All keys of [sprocket] that belong to it, though not to every form."""
        return (*self.options, *self.own_keys, *(_STANDARD if self.standard_gap else ()))

    def gap(self, pitch: float, roller_diameter: float, teeth: int, **options: Any) -> "Gap":
        """Make the gap of a standard; options are its own, `seat_centre` and `tip_diameter` [mm]."""
        gap: Gap = named(self.standard_gap)(pitch, roller_diameter, teeth, **options)
        return gap


TOOTH_FORMS = {
    "evolute": ToothForm(own_keys=_STRAND, on_strand="Evolute sprocket"),
    "points": ToothForm(
        own_keys=("points_file", "points_noise_mm", *_STRAND),
        file="points_file",
        on_strand="Sprocket from points",
    ),
    "iso606": ToothForm(
        own_keys=BETWEEN_FORMS,
        standard_gap="wearsim.geometry.forms.iso606:iso606_gap",
        options={"form": "min"},
        series=("ISO606-A/ANSI B29.1", "ISO606-B", "ISO606-H"),
        usual_for=("ISO606-B",),
    ),
    "ansi_b29": ToothForm(
        standard_gap="wearsim.geometry.forms.ansi_b29:ansi_b29_gap",
        series=("ISO606-A/ANSI B29.1", "ISO606-H"),
        usual_for=("ISO606-A/ANSI B29.1", "ISO606-H"),
    ),
    "gost591": ToothForm(
        standard_gap="wearsim.geometry.forms.gost591:gost591_gap",
        options={"displaced": False},
        series=("GOST13568",),
        usual_for=("GOST13568",),
    ),
    "dxf": ToothForm(
        own_keys=("dxf_file", "dxf_layer", "dxf_join_tolerance_mm", "points_noise_mm"), file="dxf_file"
    ),
}
