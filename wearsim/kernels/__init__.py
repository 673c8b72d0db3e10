"""Compiled loops: floats and float64 arrays in, floats and arrays out, nothing raised."""
