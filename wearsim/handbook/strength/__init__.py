"""What the teeth of a gear pair endure, and how long they last: stresses, life factors, hours."""

from typing import TYPE_CHECKING

from wearsim.lazy import lazy_names

if TYPE_CHECKING:
    from wearsim.handbook.strength.model import (
        GearMaterial,
        PairLoad,
        PairStrength,
        SpectrumStep,
        StrengthRules,
        pair_strength,
    )

__all__ = ["GearMaterial", "PairLoad", "PairStrength", "SpectrumStep", "StrengthRules", "pair_strength"]
__getattr__, __dir__ = lazy_names(__name__, dict.fromkeys(__all__, "wearsim.handbook.strength.model"))
