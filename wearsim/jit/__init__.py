"""Kernels in machine code: compiled when first called, kept on disk, loaded without numba. No physics."""
