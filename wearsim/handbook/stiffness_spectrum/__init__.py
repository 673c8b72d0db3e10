"""The spectrum of the mesh stiffness of gears with pitch errors."""
