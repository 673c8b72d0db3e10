"""What ``wearsim --help`` and ``python -m wearsim`` show."""

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

import wearsim
from tests.photographs import Camera, new_gap, picture, wheel, with_pocket
from wearsim.cli.command_groups import COMMAND_GROUPS
from wearsim.cli.handbook import HANDBOOK
from wearsim.cli.main import wearsim_command
from wearsim.extras import libraries

EXAMPLES = sorted(
    {example for commands in (*COMMAND_GROUPS.values(), HANDBOOK) for example in commands.values()}
)


def test_every_command_stands_in_one_group_with_one_line_and_one_example(cli):
    _, *groups = re.split(r"\n\n(?=[A-Z][a-z ]+:\n  \w)", cli("--help").out.partition("Options:")[2])
    headings = ["Design", "Life", "Maintain", "Studies", "Export", "Gears", "Housekeeping"]
    assert [group.partition(":")[0] for group in groups] == headings
    lines = [line for group in groups for line in group.strip().splitlines()[1:]]
    assert max(map(len, lines)) <= 80
    names, examples = lines[::2], [line.strip() for line in lines[1::2]]
    assert sorted(line.split()[0] for line in names) == sorted(
        name for name, command in wearsim_command.commands.items() if not command.hidden
    )
    for name, example in zip(names, examples, strict=True):
        assert re.match(r"  \S+  +\S.*[.?]$", name)
        assert example.split()[:2] == ["wearsim", name.split()[0]]


@pytest.mark.parametrize("columns", ["0", "1", "3", "10"])
def test_help_on_a_narrow_terminal(cli, monkeypatch, columns):
    """Examples are never broken."""
    monkeypatch.setenv("COLUMNS", columns)
    done = cli("--help")
    assert (done.code, done.err) == (0, "")
    assert all(example in done.out for commands in COMMAND_GROUPS.values() for example in commands.values())


@pytest.mark.parametrize("example", EXAMPLES)
def test_example_is_a_command_line(example, tmp_path, monkeypatch):
    """Click refuses unknown options, wrong values and arguments that are missing."""
    monkeypatch.chdir(tmp_path)
    _, name, *words = shlex.split(example)
    context = wearsim_command.commands[name].make_context(name, words)
    if name == "handbook":
        name, *words = words
        CALCULATION_OF[name].make_context(name, words, parent=context)


CALCULATION_OF = {command.name: command for command in HANDBOOK}

HIDDEN = [
    "SALib",
    "build123d",
    "distributed",
    "jinja2",
    "nicegui",
    "optuna",
    "pandera",
    "plotly",
    "pyarrow",
    "reliability",
    "skfem",
    "xlsxwriter",
]
"""Modules that only the extras bring."""

NEEDS = {"calibrate": "study", "report": "report", "sensitivity": "study", "ui": "ui"}
"""The extra that a command cannot do without."""


def test_what_is_hidden_is_what_the_extras_bring():
    extras = {one.name for one in libraries() if one.extra not in ("", "docs", "browser")}
    always = {one.name for one in libraries() if not one.extra}
    assert {name.replace("skfem", "scikit-fem") for name in HIDDEN} == extras - always


BARE = f"""
import sys
sys.modules |= dict.fromkeys({HIDDEN})
sys.argv[0] = "wearsim"
import wearsim.cli
wearsim.cli.main()
"""


@pytest.fixture
def bare(tmp_path):
    """Function that runs a line in an empty folder, on an installation without extras."""

    def run(line):
        package = str(Path(wearsim.__file__).parents[1])
        return subprocess.run(
            [sys.executable, "-c", BARE, *shlex.split(line)[1:]],
            env={**os.environ, "PYTHONPATH": package},
            cwd=tmp_path,
            capture_output=True,
            text=True,
        )

    return run


@pytest.mark.slow
@pytest.mark.parametrize("example", [one for one in EXAMPLES if one.split()[1] not in (*NEEDS, "warm")])
def test_example_runs_as_printed_on_the_bare_installation(bare, example, tmp_path):
    """All but the kernels, which take a minute to compile; the photograph of the example is rendered."""
    if example.split()[1] == "scan":
        gap = with_pocket(new_gap(12.7, 8.51, 19, "iso606"), 0.3)
        picture(wheel([gap] * 19), Camera()).save(tmp_path / "sprocket.jpg")
    done = bare(example)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("name", NEEDS)
def test_example_that_needs_an_extra_says_how_to_install_it(cli, bare, name):
    (example,) = [one for one in EXAMPLES if one.split()[1] == name]
    done = bare(example)
    assert (done.returncode, done.stdout) == (2, "")
    install = f"pip install 'wearsim[{NEEDS[name]}]'"
    assert done.stderr.endswith(f"which is not installed: {install}\n")
    assert install in " ".join(cli(name, "--help").out.split())


@pytest.mark.wide
@pytest.mark.parametrize("name", sorted(NEEDS.keys() - {"ui"}))
def test_example_runs_as_printed_with_its_extra(cli, tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    (example,) = [one for one in EXAMPLES if one.split()[1] == name]
    done = cli(*shlex.split(example)[1:])
    assert done.code == 0, done.err


def test_help_of_a_command_ends_with_its_example(cli):
    example = "wearsim handbook wave-drive wave-drive-100"
    assert cli("handbook", "wave-drive", "--help").out.endswith(f"Example:\n    {example}\n")


def test_no_example_of_the_handbook_is_broken(cli):
    shown = cli("handbook", "--help").out.splitlines()
    assert {line.strip() for line in shown} >= set(HANDBOOK.values())
    assert max(map(len, shown)) <= 80


@pytest.mark.parametrize("name", ["strength", "wave-drive"])
def test_calculation_by_its_name_of_before(cli, name):
    """It does the same, is not shown, and says what it is called now."""
    (case,) = [example.split()[-1] for example in EXAMPLES if f" {name} " in example]
    before, now = cli(name, case), cli("handbook", name, case)
    assert (before.code, before.out) == (0, now.out)
    assert (
        f"wearsim {name} is now wearsim handbook {name}; the old name works until wearsim 0.4" in before.err
    )
    assert now.err in before.err
    assert f"\n  {name} " not in cli("--help").out


def test_module_is_the_command():
    command = [sys.executable, "-m", "wearsim", "life", "packing-conveyor"]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 2
    assert "did you mean the shipped case 'packaging-conveyor'" in done.stderr
