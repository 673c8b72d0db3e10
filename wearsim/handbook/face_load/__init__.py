"""The face load factor of a wide, misaligned pair, new and run in."""
