"""The command ``wearsim`` and what its exit codes mean."""

import errno
import gc
import os
import signal
import sys
import traceback
from types import FrameType

import click

from wearsim._version import __version__
from wearsim.cli.animate import animate
from wearsim.cli.check import check
from wearsim.cli.cite import cite
from wearsim.cli.compare import compare
from wearsim.cli.completion import completion, use_own_bash
from wearsim.cli.doctor import doctor
from wearsim.cli.export import export
from wearsim.cli.init import init
from wearsim.cli.life import life
from wearsim.cli.list import list_table
from wearsim.cli.loads import loads
from wearsim.cli.profile import profile
from wearsim.cli.report import report
from wearsim.cli.schema import schema
from wearsim.cli.ui import ui
from wearsim.cli.warm import warm
from wearsim.command.options import BAD_INPUT, common_options, exit_code, show_error
from wearsim.errors import WearsimError
from wearsim.handbook.convex_concave.command import convex_concave
from wearsim.handbook.face_load.command import face_load
from wearsim.handbook.hertz_check.command import hertz_check
from wearsim.handbook.stiffness_spectrum.command import stiffness_spectrum
from wearsim.handbook.strength.command import strength
from wearsim.handbook.synthesise.command import synthesise
from wearsim.handbook.wave_drive.command import wave_drive
from wearsim.study.calibrate.command import calibrate
from wearsim.study.maintain.command import maintain
from wearsim.study.optimise.command import optimise
from wearsim.study.remaining.command import remaining
from wearsim.study.select.command import select
from wearsim.study.sensitivity.command import sensitivity
from wearsim.study.sweep.command import sweep
from wearsim.study.uncertainty.command import uncertainty

_EXAMPLES = """\b
How long will this sprocket live?
  wearsim init --out pair.toml       a whole drive from what is known of it
  wearsim init --teeth 20 > drive.toml         a case of one of its sprockets
  wearsim check drive.toml           is it complete, and can it run?
  wearsim life drive.toml            the life in hours
  wearsim compare drive.toml other.toml --out reports/first
  wearsim report drive.toml --out reports/page      pages for a browser
  wearsim ui drive.toml              a local page: edit it, see the life change
  wearsim select --power "3 kW" --rpm 120 --ratio 2.7 --hours 15000
  wearsim maintain drive.toml        when to replace the chain, and the cost
  wearsim remaining drive.toml --hours 4200 --depth-mm 0.18
  wearsim calibrate drive.toml readings.csv         coefficients and hours left
  wearsim uncertainty drive.toml     what 9 of 10, half, 1 of 10 drives exceed
  wearsim optimise drive.toml        the best profile by its table [optimise]

\b
Exit codes: 0 done, 1 bug in wearsim, 2 bad input, 3 calculation failed,
4 --require-hours or --strict not met, 5 some of several cases failed,
130 interrupted, 141 closed pipe.
"""


def announce_compiling() -> None:
    """Have the kernels that this command takes and no cache holds compiled side by side, with a message."""
    from wearsim.kernels.compiled import Kernel, compile_by

    context = click.get_current_context()

    def compile_together(kernels: list[Kernel]) -> None:
        from wearsim.command.compile_ahead import compile_ahead

        compile_ahead(context, kernels)

    compile_by(compile_together)


@click.group(help=_EXAMPLES, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="wearsim")
@common_options
def wearsim_command() -> None:
    """Group of all commands."""
    announce_compiling()


for _command in (
    life,
    check,
    loads,
    profile,
    export,
    animate,
    compare,
    report,
    ui,
    select,
    maintain,
    remaining,
    sweep,
    uncertainty,
    sensitivity,
    calibrate,
    optimise,
    strength,
    stiffness_spectrum,
    wave_drive,
    face_load,
    convex_concave,
    synthesise,
    hertz_check,
    init,
    schema,
    list_table,
    cite,
    doctor,
    warm,
    completion,
):
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
    interrupt = _Interrupt()
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, interrupt)
    try:
        if "_WEARSIM_COMPLETE" in os.environ:
            use_own_bash()
            wearsim_command.main(prog_name="wearsim")
        # Not click's own main: it turns a closed pipe into exit code 1.
        with wearsim_command.make_context("wearsim", sys.argv[1:]) as context:
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


def _interrupted() -> int:
    click.echo("interrupted: nothing half-written is left; run the same command again", err=True)
    return 130


def _unexpected(error: Exception) -> int:
    if isinstance(error, OSError) and error.errno == errno.ENOSPC:
        click.echo(f"output: must have room to be written: {error.strerror}", err=True)
        return BAD_INPUT
    click.echo(f"wearsim: this is a bug in wearsim: {type(error).__name__}: {error}", err=True)
    if "--debug" in sys.argv:
        traceback.print_exception(error)
    else:
        click.echo("run again with --debug to see where, and report it", err=True)
    return 1
