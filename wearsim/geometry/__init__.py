"""Shapes only, no load: profiles, the evolute flank, teeth and wheels."""
