"""What commands show of their progress on a terminal."""

import fcntl
import json
import os
import pty
import re
import struct
import subprocess
import sys
import termios
from pathlib import Path

import pytest

WEARSIM = Path(sys.executable).with_name("wearsim")
SAMPLES = 600
STUDY = ("uncertainty", "--samples", str(SAMPLES), "--threads", "1")
"""Of three parts."""

SCATTER = """\
[run]
life_tolerance = 0.1
[uncertainty]
"load.power_kW" = {distribution = "normal", standard_deviation = 0.2}
"""


@pytest.fixture
def on_terminal(drive):
    """Function that runs a command on the test drive with stderr on a terminal of 120 columns."""
    path = drive(power_kW=3.0, title='"A [/red] drive"')
    path.write_text(path.read_text() + SCATTER)

    def run(name, *options):
        ours, theirs = pty.openpty()
        fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 40, 120, 0, 0))
        hidden = {"COLUMNS", "LINES", "NO_COLOR", "FORCE_COLOR"}
        environment = {name: value for name, value in os.environ.items() if name not in hidden}
        command = [WEARSIM, name, path, *options]
        process = subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=theirs, env={**environment, "TERM": "xterm"}
        )
        os.close(theirs)
        try:
            shown = b"".join(pieces(ours))
            out = process.communicate(timeout=60)[0].decode()
        finally:
            process.kill()
            process.communicate()
            os.close(ours)
        return process.returncode, out, re.sub(r"\x1b\[[\d;?]*[A-Za-z]", "", shown.decode())

    return run


def pieces(terminal):
    """What the other side writes, until it is closed."""
    while True:
        try:
            piece = os.read(terminal, 1 << 16)
        except OSError:
            return
        if not piece:
            return
        yield piece


@pytest.mark.wide
def test_bar_tells_counts_rate_and_time_left(on_terminal):
    code, out, shown = on_terminal(*STUDY, "--json")
    assert code == 0
    assert json.loads(out)["samples"] == SAMPLES
    lines = [line for line in re.split(r"[\r\n]+", shown) if f"/{SAMPLES}" in line]
    counts = [int(re.search(rf"(\d+)/{SAMPLES}", line)[1]) for line in lines]
    assert counts == sorted(counts)
    assert len(set(counts)) > 1
    last = lines[-1]
    assert last.startswith("sampling A [/red] drive ")
    rate = float(re.search(r" ([\d ]+(?:\.\d+)?)/s ", last)[1].replace(" ", ""))
    assert 10.0 < rate < 1e5
    assert re.search(r"/s \d:\d\d:\d\d", last)


@pytest.mark.wide
def test_quiet_shows_nothing(on_terminal):
    code, out, shown = on_terminal("uncertainty", "--samples", "16", "-q")
    assert (code, shown) == (0, "")
    assert out.startswith("A [/red] drive\n")
    assert "\x1b" not in out


def test_title_of_a_life_is_no_markup(on_terminal):
    code, out, shown = on_terminal("life")
    assert code == 0
    assert out.startswith("A [/red] drive\n")
    assert "wearing A [/red] drive" in shown


def test_time_of_a_run_cycle_by_cycle_stands_above_its_answer(cli, drive, monkeypatch):
    monkeypatch.setattr("wearsim.wear.loop._LONG", 0.0)
    words = ("life", drive(), "--method", "per_cycle", "--set", "stop.critical_depth_mm=0.003")
    done = cli(*words)
    assert done.code == 0
    assert re.fullmatch(r"cycle by cycle: \S+ updates, about \d+ s\n", done.err)
    assert cli(*words, "-q").err == ""
    assert cli("life", drive()).err == ""
