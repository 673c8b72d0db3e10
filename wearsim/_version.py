"""The version, for `wearsim` itself and for all that names it below."""

__version__ = "0.1.0"
