"""The best designs of a case."""
