"""Handbook calculations beside the wear run: is a drive inside its rating."""
