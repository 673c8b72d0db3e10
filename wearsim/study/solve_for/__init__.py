"""The value of a key at which a case lives as long as required."""
