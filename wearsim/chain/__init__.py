"""Roller chains: length, layout of a drive, tension of spans, ratings."""
