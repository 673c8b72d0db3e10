"""Flanks, contact and outlines of convex-concave gears."""
