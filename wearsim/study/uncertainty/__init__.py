"""How sure a life is."""
