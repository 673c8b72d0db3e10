"""Rollers of a straight strand on a flank."""
