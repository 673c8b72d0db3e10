"""Wear coefficients and what goes with them, fitted to what was measured in service."""
