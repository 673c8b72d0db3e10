"""What a simulation hands back, and the folder that holds it."""

from wearsim.result.lives import Life, LimitState, LowerBound, life_keys, life_of
from wearsim.result.wear_result import WearResult, environment

__all__ = ["Life", "LimitState", "LowerBound", "WearResult", "environment", "life_keys", "life_of"]
