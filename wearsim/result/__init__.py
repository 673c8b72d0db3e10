"""What a simulation hands back, and the folder that holds it."""

from wearsim.result.life import Life, LowerBound
from wearsim.result.wear_result import WearResult, environment

__all__ = ["Life", "LowerBound", "WearResult", "environment"]
