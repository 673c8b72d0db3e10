"""What a command does not need it does not load."""

import subprocess
import sys
from pathlib import Path

import pytest

CASES = Path(__file__).parents[2] / "cases" / "sizing"

HEAVY = {"numpy", "numba", "llvmlite", "pandas", "scipy", "matplotlib", "shapely", "pint"}

PROGRAM = """\
import sys
import wearsim.cli
try:
    wearsim.cli.main()
finally:
    print(*sys.modules, file=sys.stderr)
"""


def modules(*arguments):
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, *map(str, arguments)], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return set(done.stderr.split())


def loaded(*arguments):
    return {name.partition(".")[0] for name in modules(*arguments)} & HEAVY


@pytest.mark.parametrize("arguments", [("--help",), ("life", "--help"), ("--version",)])
def test_help_loads_nothing_heavy(arguments):
    assert loaded(*arguments) == set()


def test_tables_load_nothing_heavy():
    assert loaded("list", "chains") == set()


def test_check_of_a_strand_compiles_nothing(drive):
    assert loaded("check", drive()) == {"numpy", "shapely"}


@pytest.mark.wide
def test_life_of_a_strand_runs_its_machine_code_without_numba(drive):
    loaded("life", drive())  # compiles
    assert loaded("life", drive()) == loaded("life", "--json", drive()) == {"numpy", "shapely", "llvmlite"}


def test_life_of_a_strand_loads_nothing_of_whole_drives(drive):
    of_drives = (
        "wearsim.mechanisms.wrap",
        "wearsim.drive.drive_case",
        "wearsim.drive.life",
        "wearsim.report.drive",
    )
    assert not {name for name in modules("life", drive()) if name.startswith(of_drives)}


@pytest.mark.slow
def test_life_of_a_wrap_runs_its_machine_code_without_numba():
    wrap = CASES.parent / "08b-19t-wrap.toml"
    loaded("life", wrap)  # compiles
    assert loaded("life", wrap) & {"numba", "pandas", "matplotlib"} == set()


def test_life_loads_pint_for_a_string_with_a_unit(drive):
    assert loaded("life", drive(power_kW='"3 kW"')) & {"pandas", "matplotlib", "pint"} == {"pint"}


@pytest.mark.wide
@pytest.mark.parametrize(
    ("command", "case", "needed"),
    [
        ("strength", "strength-a-tempered", {"numpy"}),
        ("wave-drive", "wave-drive-100", {"numpy", "scipy"}),
        ("stiffness-spectrum", "stiffness-spectrum-20-30", {"numpy", "scipy"}),
    ],
)
def test_calculations_load_neither_numba_nor_what_only_a_folder_needs(command, case, needed):
    assert loaded("handbook", command, CASES / f"{case}.toml") == needed
