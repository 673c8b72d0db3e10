"""Exit codes and what goes with them: no traceback unless it is asked for."""

import pytest

import wearsim
from wearsim.errors import ContactError, ConvergenceError, GeometryError


def raising(error):
    def simulate(case, progress):
        raise error

    return simulate


@pytest.mark.parametrize(
    "arguments",
    [
        ("life",),
        ("life", "none.toml"),
        ("life", "."),
        ("life", "--no-such-option"),
        ("lief",),
        ("check", "none.toml"),
        ("profile", "none.toml"),
        ("compare", "none.toml", "--out", "x"),
        ("compare", "none", "--out", "x"),
        ("compare", ".", "--out", "x"),
        ("list",),
        ("list", "nothing"),
        ("init", "--chain", "none"),
        ("--no-such-option",),
    ],
)
def test_user_mistakes_are_2_and_one_message(cli, monkeypatch, tmp_path, arguments):
    monkeypatch.chdir(tmp_path)
    done = cli(*arguments)
    assert (done.code, done.out) == (2, "")
    assert done.err
    assert "Traceback" not in done.err
    assert "bug" not in done.err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("error", [ContactError, ConvergenceError, GeometryError])
@pytest.mark.parametrize("options", [(), ("--json",)])
def test_failed_calculation_is_3(cli, drive, monkeypatch, error, options):
    monkeypatch.setattr("wearsim.drive.simulate.simulate_single", raising(error("flank: must hold")))
    done = cli("life", drive(), *options)
    assert done.code == 3
    assert "flank: must hold" in done.err
    assert "Traceback" not in done.err


def test_bug_is_1_and_says_so(cli, drive, monkeypatch):
    monkeypatch.setattr("wearsim.drive.simulate.simulate_single", raising(ZeroDivisionError("by zero")))
    done = cli("life", drive())
    assert (done.code, done.out) == (1, "")
    assert "bug in wearsim: ZeroDivisionError: by zero" in done.err
    assert "--debug" in done.err
    assert "Traceback" not in done.err


def test_interrupt_is_130(cli, drive, monkeypatch):
    monkeypatch.setattr("wearsim.drive.simulate.simulate_single", raising(KeyboardInterrupt()))
    done = cli("life", drive())
    assert (done.code, done.out) == (130, "")
    assert done.err.startswith("interrupted")


@pytest.mark.parametrize("error", [ZeroDivisionError("x"), ContactError("x")])
def test_debug_shows_the_traceback(cli, drive, monkeypatch, error):
    monkeypatch.setattr("wearsim.drive.simulate.simulate_single", raising(error))
    done = cli("life", drive(), "--debug")
    assert "Traceback" in done.err
    assert "in simulate" in done.err


@pytest.mark.parametrize("place", ["before", "after"])
def test_debug_shows_the_traceback_of_a_bad_case(cli, drive, place):
    path = drive(teeth=3)
    done = cli("--debug", "life", path) if place == "before" else cli("life", path, "--debug")
    assert done.code == 2
    assert "Traceback" in done.err


def test_version(cli):
    done = cli("--version")
    assert (done.code, done.out) == (0, f"wearsim, version {wearsim.__version__}\n")


@pytest.mark.parametrize("option", ["--help", "-h"])
def test_help(cli, option):
    done = cli(option)
    assert done.code == 0
    for command in ("life", "check", "profile", "compare", "init", "schema", "list"):
        assert f"\n  {command} " in done.out


@pytest.mark.parametrize("command", ["life", "check", "profile", "compare", "init", "schema", "list"])
def test_every_command_has_help(cli, command):
    done = cli(command, "--help")
    assert done.code == 0
    assert done.out.startswith(f"Usage: wearsim {command}")
    assert "--debug" in done.out and "-q" in done.out


def test_no_arguments_show_the_help(cli):
    done = cli()
    assert done.code in (0, 2)
    assert "How long will this sprocket last?" in done.out + done.err
