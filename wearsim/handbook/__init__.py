"""Handbook calculations beside the wear run: a folder each."""
