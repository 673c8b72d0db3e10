"""Lives over values of any input keys."""
