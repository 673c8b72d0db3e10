"""Gears: flanks, mesh, lines of action."""
