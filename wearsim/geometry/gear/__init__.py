"""Gears: flanks, mesh, paths of contact."""
