"""Flanks that were measured or drawn."""
