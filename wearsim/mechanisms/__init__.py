"""What touches a flank, where, how hard and with how much slip; no wear, no time."""
