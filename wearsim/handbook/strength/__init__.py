"""Allowable stresses, life factors and fatigue life of a gear pair."""
