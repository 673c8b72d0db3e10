"""The diameter of the flexspline of a wave drive by eight methods."""
