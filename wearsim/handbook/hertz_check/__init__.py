"""What the contact stress of a gear pair at the pitch point is, and whether a published one holds."""

from typing import TYPE_CHECKING

from wearsim.lazy import lazy_names

if TYPE_CHECKING:
    from wearsim.handbook.hertz_check.model import (
        HertzCheck,
        PublishedStresses,
        TeethOfPair,
        pitch_point_check,
    )
    from wearsim.handbook.hertz_check.pitch_point_contact import PitchPointContact

__all__ = ["HertzCheck", "PitchPointContact", "PublishedStresses", "TeethOfPair", "pitch_point_check"]
__getattr__, __dir__ = lazy_names(
    __name__,
    {
        **dict.fromkeys(__all__, "wearsim.handbook.hertz_check.model"),
        "PitchPointContact": "wearsim.handbook.hertz_check.pitch_point_contact",
    },
)
