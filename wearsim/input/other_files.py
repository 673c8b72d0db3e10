"""Which command an input file is for, by the tables that it holds."""

from collections.abc import Mapping
from typing import Any

from wearsim.errors import CaseError, Fault

NEEDED = {
    "strength": {"drive", "pinion", "wheel"},
    "stiffness-spectrum": {"gear_pair", "pinion", "wheel"},
    "wave-drive": {"wave_drive"},
    "face-load": {"pair", "load", "misalignment", "running_in"},
    "convex-concave": {"convex_concave"},
    "synthesise": {"gears", "load", "stress", "phase"},
    "hertz-check": {"contact"},
    "sweep": {"case"},
}
"""Commands with an input file of their own, and what it must hold beside its version."""


def command_of(tables: Mapping[str, Any]) -> str:
    """Return the command that an input is for; empty where its tables do not tell.

    Examples
    --------
    >>> command_of({"format_version": 1, "wave_drive": {}}), command_of({"chain": {}}), command_of({})
    ('wave-drive', 'life', '')
    """
    if {"chain", "sprocket", "gear"} & tables.keys():
        return "life"
    return next((command for command, needed in NEEDED.items() if needed <= tables.keys()), "")


def check_command(tables: Mapping[str, Any], file: str, own: str = "") -> None:
    """Raise where an input is plainly that of another command."""
    command = command_of(tables)
    if command not in ("", own):
        text = f"must be an input of this command, but is one of wearsim {command}: run that"
        raise CaseError([Fault(text, "", file)])
