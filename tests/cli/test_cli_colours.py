"""Colours: on a terminal, never off one, and not where the environment asks for none."""

import os
import pty
import re
import subprocess
import sys

import pytest

BOLD_RED, BOLD_YELLOW = "\x1b[31m\x1b[1m", "\x1b[33m\x1b[1m"
COMMAND = [sys.executable, "-m", "wearsim", "check", "packaging-conveyor"]


def environment(**more):
    hidden = {"NO_COLOR", "FORCE_COLOR"}
    return (
        {name: value for name, value in os.environ.items() if name not in hidden} | {"TERM": "xterm"} | more
    )


def on_terminal(**more):
    ours, theirs = pty.openpty()
    process = subprocess.Popen(COMMAND, stdout=theirs, env=environment(**more))
    os.close(theirs)
    shown = b""
    try:
        while piece := os.read(ours, 1 << 16):
            shown += piece
    except OSError:  # the other side is closed
        pass
    os.close(ours)
    assert process.wait(timeout=60) == 0
    return shown.decode()


def test_outside_is_red_and_a_warning_yellow():
    """3 kW are 4.2 kW with a service factor of 1.4, more than the 2.5 kW of the plates."""
    shown = on_terminal()
    assert f"{BOLD_RED}OUTSIDE\x1b[0m" in re.search(r"plate fatigue .*", shown)[0]
    assert f"{BOLD_YELLOW}warning\x1b[0m  outside a rating: plate fatigue" in shown
    assert "\x1b" not in re.search(r"rating +roller impact .*", shown)[0]


@pytest.mark.wide
@pytest.mark.parametrize("more", [{"NO_COLOR": "1"}, {"TERM": "dumb"}])
def test_no_colour_where_none_is_wanted(more):
    shown = on_terminal(**more)
    assert "OUTSIDE" in shown
    assert "\x1b" not in shown


def test_no_colour_off_a_terminal():
    done = subprocess.run(COMMAND, capture_output=True, text=True, env=environment(FORCE_COLOR="1"))
    assert "OUTSIDE" in done.stdout
    assert "\x1b" not in done.stdout + done.stderr
