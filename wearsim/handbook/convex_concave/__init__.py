"""What gears with convex-concave teeth look like: flanks, contact, outlines, measurement."""

from typing import TYPE_CHECKING

from wearsim.lazy import lazy_names

if TYPE_CHECKING:
    from wearsim.handbook.convex_concave.model import GearBlanks, PairLayout, pair_layout

__all__ = ["GearBlanks", "PairLayout", "pair_layout"]
__getattr__, __dir__ = lazy_names(__name__, dict.fromkeys(__all__, "wearsim.handbook.convex_concave.model"))
