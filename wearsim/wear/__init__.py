"""Wear of a flank under any contact: law, cycle loop, advance, criteria, hours."""
