"""Profiles of a gear pair with a prescribed contact stress."""
