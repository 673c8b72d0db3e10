"""The command ``wearsim`` and what its exit codes mean."""

import errno
import gc
import os
import re
import signal
import sys
import traceback
from pathlib import Path
from types import FrameType

import click

from wearsim._version import __version__
from wearsim.cli.command_groups import COMMAND_GROUPS
from wearsim.cli.completion import use_own_bash
from wearsim.cli.handbook import commands_of_before
from wearsim.command.example_group import ExampleGroup
from wearsim.command.options import BAD_INPUT, common_options, exit_code, show_error, uses_colour
from wearsim.errors import CaseError, Fault, WearsimError, quoted

_HELP = """How long will this sprocket last?

Start from what you know of a drive (init, select, ui), then compute its life. CASE is a file
(.toml), - for standard input, or the name of a shipped case (wearsim list cases).

\b
Exit codes: 0 done, 1 bug in wearsim, 2 bad input, 3 calculation failed,
4 --require-hours or --strict not met, 5 some of several cases failed,
130 interrupted, 141 closed pipe.
"""


def announce_compiling() -> None:
    """Have the kernels that this command takes and no cache holds compiled side by side, with a message."""
    from wearsim.jit.compiled import Kernel, compile_by

    context = click.get_current_context()

    def compile_together(kernels: list[Kernel]) -> None:
        from wearsim.command.compile_ahead import compile_ahead

        compile_ahead(context, kernels)

    compile_by(compile_together)


@click.group(
    cls=ExampleGroup,
    groups=COMMAND_GROUPS,
    help=_HELP,
    short_help="Compute the wear life of chain drives and gears.",
    context_settings={"help_option_names": ["-h", "--help"]},
)
@click.version_option(__version__, prog_name="wearsim")
@common_options
def wearsim_command() -> None:
    """Group of all commands."""
    announce_compiling()


for _command in commands_of_before():
    wearsim_command.add_command(_command)


class _Interrupt:
    """Ctrl-C, remembered: compiled code that it hits may raise something else instead."""

    seen = False

    def __call__(self, number: int, frame: FrameType | None) -> None:
        self.seen = True
        raise KeyboardInterrupt


def main() -> None:
    """Run the command line and exit with its code."""
    # Importing makes some hundred thousand objects that stay: not to be looked through again and again.
    gc.set_threshold(50_000)
    # Pictures go to files: no window is opened, so which one is asked for does not matter.
    os.environ.pop("MPLBACKEND", None)
    interrupt = _Interrupt()
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, interrupt)
    try:
        if "_WEARSIM_COMPLETE" in os.environ:
            use_own_bash()
            wearsim_command.main(prog_name="wearsim")
        _open_closed_streams()
        _check_environment()
        _check_working_folder()
        # Not click's own main: it turns a closed pipe into exit code 1.
        with wearsim_command.make_context("wearsim", sys.argv[1:], color=uses_colour()) as context:
            code = wearsim_command.invoke(context)
        sys.stdout.flush()
        sys.exit(code if isinstance(code, int) else 0)
    except click.exceptions.Exit as done:
        sys.exit(done.exit_code)
    except click.ClickException as error:
        error.show()
        sys.exit(error.exit_code)
    except (click.Abort, KeyboardInterrupt):
        sys.exit(_interrupted())
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(141)
    except WearsimError as error:
        show_error(error)
        sys.exit(exit_code(error))
    except Exception as error:
        sys.exit(_interrupted() if interrupt.seen else _unexpected(error))


def _open_closed_streams() -> None:
    """Open what is closed as empty, so that no file takes its number; raise where nothing can be printed."""
    prints = sys.stdout is not None
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        if getattr(sys, name) is None:
            setattr(sys, name, Path(os.devnull).open(mode, encoding="utf-8"))  # noqa: SIM115 - stays open
    if not prints:
        message = "must be open to print to, but is closed: send it to a file or to /dev/null"
        raise CaseError([Fault(message, "", "standard output")])


_MOST_THREADS = 100_000
_LAST_SECOND = 253_402_300_799
"""Of the year 9999, after which there are no dates."""


def _check_environment() -> None:
    """Raise where a variable that the libraries read is no whole number, each for itself and late."""
    for name, least, most in (
        ("NUMBA_NUM_THREADS", 1, _MOST_THREADS),
        ("SOURCE_DATE_EPOCH", 0, _LAST_SECOND),
    ):
        value = os.environ.get(name)
        if value and not (re.fullmatch("[0-9]{1,12}", value) and least <= int(value) <= most):
            message = f"must be a whole number from {least} to {most} (got {quoted(value)}): unset it"
            raise CaseError([Fault(message, "", f"environment variable {name}")])


def _check_working_folder() -> None:
    """Raise where the folder that the process is in has been removed: no name in it leads anywhere."""
    try:
        Path.cwd()
    except OSError as error:
        message = f"must exist, but is gone ({error.strerror}): change to another folder"
        raise CaseError([Fault(message, "", "working folder")]) from None


def _interrupted() -> int:
    click.echo("interrupted: no partial files are left; run the same command again", err=True)
    return 130


def _unexpected(error: Exception) -> int:
    if isinstance(error, OSError) and error.errno == errno.ENOSPC:
        click.echo(f"output: there must be disk space to write it: {error.strerror}", err=True)
        return BAD_INPUT
    click.echo(f"wearsim: this is a bug in wearsim: {type(error).__name__}: {error}", err=True)
    if "--debug" in sys.argv:
        traceback.print_exception(error)
    else:
        click.echo("run again with --debug to see where, and report it", err=True)
    return 1
