"""A pair of gears whose flanks wear each other."""
