"""Shell completion: what click answers, and what a real bash makes of it."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import wearsim

PROGRAM = "import wearsim.cli; wearsim.cli.main()"
GEARS = "[gear]\npinion_teeth = 19\n"


@pytest.fixture
def folder(tmp_path):
    """A folder with cases, a run and other files."""
    (tmp_path / "cases").mkdir()
    for name in ("drive.toml", "cases/a.toml", "cases/b.toml"):
        (tmp_path / name).write_text("format_version = 1\n")
    (tmp_path / "gears.toml").write_text(GEARS)
    (tmp_path / "notes.txt").touch()
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "result.json").touch()
    (tmp_path / "run" / "case.lock.toml").touch()
    return tmp_path


def environment(**more):
    package = str(Path(wearsim.__file__).parents[1])
    return {**os.environ, "PYTHONPATH": package, **more}


@pytest.fixture
def complete(folder):
    """Function from the words of a line, the last one unfinished, to what is offered."""

    def offered(*words, of="bash"):
        line = " ".join(["wearsim", *words])
        more = {"COMP_WORDS": line, "COMP_CWORD": str(len(words))}
        if of == "fish":
            more["COMP_CWORD"] = words[-1]
        done = subprocess.run(
            [sys.executable, "-c", PROGRAM],
            env=environment(_WEARSIM_COMPLETE=f"{of}_complete", **more),
            cwd=folder,
            capture_output=True,
            text=True,
        )
        assert done.stderr == ""
        return [line for line in done.stdout.splitlines() if line]

    return offered


def plain(*values):
    return [f"plain,{value}" for value in values]


def test_commands(complete):
    assert complete("l") == plain("life", "list", "loads", "lubricate")
    assert complete("compl") == plain("completion")
    assert complete("handbook", "st") == plain("stiffness-spectrum", "strength")
    assert complete("st") == []


def test_options(complete):
    assert complete("life", "--xl") == plain("--xlsx")
    assert "plain,--parquet" in complete("life", "--")
    assert complete("cite", "--format", "b") == plain("bibtex")
    assert complete("completion", "") == plain("bash", "zsh", "fish")


@pytest.mark.wide
def test_cases_but_no_other_files(complete):
    for command in ("life", "check", "loads", "profile", "maintain", "remaining", "handbook strength"):
        assert complete(*command.split(), "dri") == plain("drive.toml")
    everything = plain("cases/a.toml", "cases/b.toml", "drive.toml", "gears.toml")
    assert complete("life", "") == everything
    assert complete("life", "cases/") == plain("cases/a.toml", "cases/b.toml")
    assert complete("life", "./cases/b") == plain("./cases/b.toml")
    assert complete("life", "drive.toml", "cases/a") == plain("cases/a.toml")


def test_shipped_cases_once_something_is_typed(complete):
    assert complete("life", "pack") == plain("packaging-conveyor")
    assert complete("handbook", "strength", "strength-b") == plain("strength-b-carburised")
    assert complete("sweep", "teeth-") == plain("teeth-and-tension")
    assert complete("check", "fzg-c14-16t-mild", "--set", "gear.mod") == plain("gear.module_mm=")


def test_runs_for_compare(complete):
    assert complete("compare", "r") == plain("run")
    assert complete("life", "r") == ["file,r"]


def test_other_places_are_left_to_the_shell(complete):
    assert complete("life", "drive.toml", "--out", "x") == ["file,x"]
    assert complete("life", "nothing") == ["file,nothing"]


def test_names_of_catalogues(complete):
    assert complete("init", "--chain", "20B-") == plain("20B-1", "20B-2", "20B-3")
    assert complete("init", "--chain", "20b-1") == plain("20B-1")
    assert complete("init", "--lubrication", "d") == plain("drip", "dry")
    assert complete("schema", "--of", "wave") == plain("wave-drive")
    assert complete("list", "wear") == plain("wear-conditions", "wear-laws")


@pytest.mark.wide
def test_keys(complete):
    assert complete("life", "drive.toml", "--set", "run.hor") == plain("run.horizon_hours=")
    assert complete("life", "--solve-for", "run.hor") == plain("run.horizon_hours")
    assert complete("check", "gears.toml", "--set", "gear.mod") == plain("gear.module_mm=")
    assert complete("loads", "gears.toml", "--set", "gear.mod") == plain("gear.module_mm=")
    assert complete("check", "drive.toml", "--set", "gear.mod") == []
    torque = plain("load.pinion_torque_N_m=")
    assert complete("handbook", "strength", "x.toml", "--set", "load.pinion_to") == torque
    assert not [line for line in complete("life", "--set", "duty") if "[" in line]


@pytest.mark.wide
def test_words_of_a_key_apart_as_bash_hands_them_over(complete):
    assert complete("life", "--set", "mechanism.kind", "=", "wr") == plain("wrap")
    kinds = plain("strand", "prescribed", "wrap")
    assert complete("life", "--set", "mechanism.kind", "=") == kinds
    assert complete("life", "--set", "=", "mechanism.kind", "=", "wr") == plain("wrap")
    assert complete("life", "--set", "chain.designation", "=", "20B-1") == plain("20B-1")
    assert complete("life", "--set", "material.sprocket.name", "=", "st") == plain("steel")
    assert complete("life", "--set", "sprocket.teeth", "=", "2") == []


def test_fish_gets_whole_words(complete):
    found = complete("life", "--set", "mechanism.kind=wr", of="fish")
    assert "mechanism.kind=wrap" in "\n".join(found)


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_script(cli, shell):
    done = cli("completion", shell)
    assert (done.code, done.err) == (0, "")
    assert f"_WEARSIM_COMPLETE={shell}_complete" in done.out
    assert "wearsim" in done.out


def test_unknown_shell(cli):
    assert cli("completion", "csh").code == 2


BASH = """
source "$1"
printf '%s\\n' "$(complete -p wearsim)"
COMP_WORDS=(wearsim life --set mechanism.kind '=' wr); COMP_CWORD=5
_wearsim_completion wearsim 2> /dev/null; printf '%s\\n' "${COMPREPLY[@]}"
COMPREPLY=(); COMP_WORDS=(wearsim life cases/); COMP_CWORD=2
_wearsim_completion wearsim 2> /dev/null; printf '%s\\n' "${COMPREPLY[@]}"
"""


@pytest.mark.skipif(shutil.which("bash") is None, reason="bash is not installed")
def test_real_bash(cli, folder):
    """Bash sources the script and calls the function that completes."""
    (folder / "bin").mkdir()
    program = folder / "bin" / "wearsim"
    program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -c "{PROGRAM}"\n')
    program.chmod(0o755)
    script = folder / "script.bash"
    script.write_text(cli("completion", "bash").out)
    done = subprocess.run(
        ["bash", "--norc", "-c", BASH, "bash", str(script)],
        env=environment(PATH=f"{folder / 'bin'}{os.pathsep}{os.environ['PATH']}"),
        cwd=folder,
        capture_output=True,
        text=True,
    )
    first, *rest = done.stdout.splitlines()
    assert first == "complete -o nosort -F _wearsim_completion wearsim"
    assert rest == ["wrap", "cases/a.toml", "cases/b.toml"], done.stderr
    assert "[[ $value == *= ]] && compopt -o nospace" in script.read_text()
