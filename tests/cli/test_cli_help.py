"""What ``wearsim --help`` and ``python -m wearsim`` show."""

import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from wearsim.cli.command_groups import COMMAND_GROUPS
from wearsim.cli.main import wearsim_command

EXAMPLES = [example for commands in COMMAND_GROUPS.values() for example in commands.values()]


def test_every_command_stands_in_one_group_with_one_line_and_one_example(cli):
    _, *groups = re.split(r"\n\n(?=[A-Z][a-z ]+:\n  \w)", cli("--help").out.partition("Options:")[2])
    headings = ["Design", "Life", "Maintain", "Studies", "Export", "Gears and handbook", "Housekeeping"]
    assert [group.partition(":")[0] for group in groups] == headings
    lines = [line for group in groups for line in group.strip().splitlines()[1:]]
    assert max(map(len, lines)) <= 80
    names, examples = lines[::2], [line.strip() for line in lines[1::2]]
    assert sorted(line.split()[0] for line in names) == sorted(wearsim_command.commands)
    for name, example in zip(names, examples, strict=True):
        assert re.match(r"  \S+  +\S.*[.?]$", name)
        assert example.split()[:2] == ["wearsim", name.split()[0]]


@pytest.mark.parametrize("example", EXAMPLES)
def test_example_is_a_command_line(example, tmp_path, monkeypatch):
    """Click refuses unknown options, wrong values and arguments that are missing."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "readings.csv").touch()
    _, name, *words = shlex.split(example)
    wearsim_command.commands[name].make_context(name, words)


SHORT = {
    "maintain": ("--set", "run.horizon_hours=20"),
    "report": ("--set", "run.horizon_hours=20"),
    "lubricate": ("--set", "run.horizon_hours=20"),
    "uncertainty": ("--samples", "64"),
    "sensitivity": ("--samples", "16"),
    "optimise": ("--evaluations", "20"),
    "judge": ("--particles", "100"),
}
"""What makes a command that runs many lives or fits short."""

CASES = Path(__file__).parents[2] / "cases"

OWN = {
    "calibrate": {"drive.toml": "16b-20t-oiled.toml", "readings.csv": "studies/16b-20t-readings.csv"},
    "judge": {"readings.csv": "studies/metal-wear.csv"},
}
"""In place of the files that a user has, by command."""


@pytest.mark.wide
@pytest.mark.parametrize("example", [one for one in EXAMPLES if one.split()[1] not in ("ui", "warm")])
def test_example_runs(cli, example, tmp_path, monkeypatch):
    """All but the page, which waits for a browser, and the kernels, which take a minute to compile."""
    monkeypatch.chdir(tmp_path)
    _, name, *words = shlex.split(example)
    for file, shipped in OWN.get(name, {}).items():
        shutil.copy(CASES / shipped, file)
    done = cli(name, *words, *SHORT.get(name, ()))
    assert done.code == 0, done.err


def test_help_of_a_command_ends_with_its_example(cli):
    assert cli("wave-drive", "--help").out.endswith("Example:\n    wearsim wave-drive wave-drive-100\n")


def test_module_is_the_command():
    command = [sys.executable, "-m", "wearsim", "life", "packing-conveyor"]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 2
    assert "did you mean the shipped case 'packaging-conveyor'" in done.stderr
