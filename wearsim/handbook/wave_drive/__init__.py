"""How large the flexspline of a wave drive must be, by eight methods side by side."""

from typing import TYPE_CHECKING

from wearsim.lazy import lazy_names

if TYPE_CHECKING:
    from wearsim.handbook.wave_drive.model import MethodComparison, flexspline_diameters

__all__ = ["MethodComparison", "flexspline_diameters"]
__getattr__, __dir__ = lazy_names(__name__, dict.fromkeys(__all__, "wearsim.handbook.wave_drive.model"))
