"""A flank whose load and sliding are given."""
