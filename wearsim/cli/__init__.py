"""The command line: arguments, exit codes and printing only."""

from wearsim.cli.main import main

__all__ = ["main"]
