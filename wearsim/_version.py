"""The version, for `wearsim` itself and for all that names it below."""

__version__ = "0.2.0"

ANSWER_HEAD: dict[str, object] = {"schema_version": 1, "wearsim_version": __version__}
"""The first keys of an answer as JSON: the version of its form and the wearsim that computed it."""
