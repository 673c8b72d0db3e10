"""What the edges of a wide, misaligned pair carry, new and run in: the face load factor."""

from typing import TYPE_CHECKING

from wearsim.lazy import lazy_names

if TYPE_CHECKING:
    from wearsim.handbook.face_load.model import FaceGaps, FaceLoad, FlankWear, WidePair, face_load_factors

__all__ = ["FaceGaps", "FaceLoad", "FlankWear", "WidePair", "face_load_factors"]
__getattr__, __dir__ = lazy_names(__name__, dict.fromkeys(__all__, "wearsim.handbook.face_load.model"))
