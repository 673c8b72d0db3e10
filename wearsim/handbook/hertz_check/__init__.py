"""Contact stress of a gear pair at the pitch point, against published ones and finite elements."""
