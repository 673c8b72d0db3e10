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

TWO_SPROCKETS = """\
format_version = 1
[chain]
designation = "08B-1"
[[sprocket]]
teeth = 17
profile = "iso606"
nodes = 61
[[sprocket]]
name = "roll"
teeth = 20
profile = "iso606"
nodes = 61
[drive]
links = 110
[load]
power_kW = 1.3
speed_rpm = 300
[joint]
specific_wear_rate_mm2_per_N = 1e-8
[wear]
specific_wear_rate_mm2_per_N = 5e-9
[mechanism]
phases = 2
[run]
life_tolerance = 0.1
[service]
hours_per_day = 16
start_date = "2027-01-04"
"""

LOOP = """\
format_version = 1
[chain]
designation = "08B-1"
[[sprocket]]
name = "motor"
teeth = 17
profile = "iso606"
nodes = 61
position_mm = [0, 0]
[[sprocket]]
name = "tensioner"
role = "idler"
teeth = 13
profile = "iso606"
nodes = 61
position_mm = [62, 155]
outside = true
take_up = {tensioner_force_N = 80, guide_deg = -37.5, travel_mm = [-25, 30]}
[[sprocket]]
name = "pump"
teeth = 20
profile = "iso606"
nodes = 61
position_mm = [200, 250]
power_share = 0.7
[[sprocket]]
name = "fan"
teeth = 25
profile = "iso606"
nodes = 61
position_mm = [306, 0]
power_share = 0.3
[drive]
links = 92
[load]
power_kW = 1.3
speed_rpm = 300
[wear]
specific_wear_rate_mm2_per_N = 1e-9
[joint]
specific_wear_rate_mm2_per_N = 1e-9
[mechanism]
phases = 2
[run]
life_tolerance = 0.1
"""

CASSETTE = """\
format_version = 1
[chain]
designation = "08B-1"
[[sprocket]]
name = "ring"
teeth = 38
profile = "iso606"
nodes = 61
[[sprocket]]
name = "cassette"
profile = "iso606"
nodes = 61
cog = [{teeth = 13, share_of_time = 0.25}, {teeth = 17, share_of_time = 0.75}]
[drive]
links = 110
[load]
power_kW = 0.8
speed_rpm = 100
[wear]
specific_wear_rate_mm2_per_N = 1e-9
[joint]
specific_wear_rate_mm2_per_N = 1e-9
[mechanism]
phases = 2
[run]
life_tolerance = 0.1
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


@pytest.fixture(scope="session")
def two_sprockets():
    """Text of a drive with two sprockets, one clock and dates."""
    return TWO_SPROCKETS


@pytest.fixture(scope="session")
def loop():
    """Text of a drive with four sprockets at their places, one of them an outside idler with a spring."""
    return LOOP


@pytest.fixture(scope="session")
def cassette():
    """Text of a drive with a cassette of two cogs."""
    return CASSETTE
