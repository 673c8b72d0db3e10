"""Wear of a flank under any contact: law, cycle loop, advance, stop limits, hours."""
