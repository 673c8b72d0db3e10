"""Which profiles of a gear pair have a prescribed contact stress."""

from typing import TYPE_CHECKING

from wearsim.lazy import lazy_names

if TYPE_CHECKING:
    from wearsim.handbook.synthesise.model import (
        MeshPhase,
        MeshPlane,
        PhaseStart,
        direction_fields,
        loaded_pair,
        profile_phases,
        stress_fields,
    )

__all__ = [
    "MeshPhase",
    "MeshPlane",
    "PhaseStart",
    "direction_fields",
    "loaded_pair",
    "profile_phases",
    "stress_fields",
]
__getattr__, __dir__ = lazy_names(__name__, dict.fromkeys(__all__, "wearsim.handbook.synthesise.model"))
