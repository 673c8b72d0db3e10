"""The command line in this process: arguments in, exit code and both streams out."""

import sys
from dataclasses import dataclass

import pytest

import wearsim.cli

DRIVE = """\
format_version = 1
title = "Test drive"
[chain]
designation = "16B-1"
[sprocket]
teeth = 20
profile = "evolute"
evolute_offset_mm = 5.6
nodes = 51
[load]
power_kW = 3
speed_rpm = 100
[wear]
condition = "hardened, oiled"
[stop]
critical_depth_mm = 0.02
"""


@dataclass(frozen=True)
class Done:
    code: int
    out: str
    err: str


@pytest.fixture
def cli(monkeypatch, capsys):
    """Function that runs ``wearsim`` with arguments."""

    def run(*arguments):
        monkeypatch.setattr(sys, "argv", ["wearsim", *map(str, arguments)])
        # Which test meets kernels that no cache holds is chance: nothing is said of them.
        monkeypatch.setattr(sys.modules["wearsim.cli.main"], "announce_compiling", lambda: None)
        capsys.readouterr()
        with pytest.raises(SystemExit) as caught:
            wearsim.cli.main()
        streams = capsys.readouterr()
        assert "\x1b[" not in streams.out + streams.err
        return Done(caught.value.code or 0, streams.out, streams.err)

    return run


@pytest.fixture
def drive(tmp_path):
    """Function that writes a case, with lines replaced, and returns its path."""

    def write(name="drive", **replaced):
        text = DRIVE
        for key, value in replaced.items():
            (line,) = [line for line in text.splitlines() if line.startswith(f"{key} = ")]
            text = text.replace(line, f"{key} = {value}")
        path = tmp_path / f"{name}.toml"
        path.write_text(text)
        return path

    return write
