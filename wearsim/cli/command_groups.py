"""All commands in the groups of ``wearsim --help``, each with an example."""

import click

from wearsim.cli.animate import animate
from wearsim.cli.check import check
from wearsim.cli.cite import cite
from wearsim.cli.compare import compare
from wearsim.cli.completion import completion
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
from wearsim.handbook.convex_concave.command import convex_concave
from wearsim.handbook.face_load.command import face_load
from wearsim.handbook.hertz_check.command import hertz_check
from wearsim.handbook.stiffness_spectrum.command import stiffness_spectrum
from wearsim.handbook.strength.command import strength
from wearsim.handbook.synthesise.command import synthesise
from wearsim.handbook.wave_drive.command import wave_drive
from wearsim.study.calibrate.command import calibrate
from wearsim.study.judge.command import judge
from wearsim.study.lubricate.command import lubricate
from wearsim.study.maintain.command import maintain
from wearsim.study.optimise.command import optimise
from wearsim.study.remaining.command import remaining
from wearsim.study.select.command import select
from wearsim.study.sensitivity.command import sensitivity
from wearsim.study.sweep.command import sweep
from wearsim.study.uncertainty.command import uncertainty

COMMAND_GROUPS: dict[str, dict[click.Command, str]] = {
    "Design": {
        init: "wearsim init --chain 12B-1 --driver 21 --driven 57 --out drive.toml",
        select: "wearsim select --power 3 --rpm 120 --ratio 2.7 --hours 15000",
        check: "wearsim check packaging-conveyor",
        loads: "wearsim loads a40-19t-rating --elongation 1",
        ui: "wearsim ui packaging-conveyor",
    },
    "Life": {
        life: "wearsim life 16b-20t-oiled --explain",
        compare: "wearsim compare 16b-20t-oiled 16a-20t-oilbath",
        report: "wearsim report packaging-conveyor --out sheet.html",
        animate: "wearsim animate 16b-20t-oiled --out wear.gif",
    },
    "Maintain": {
        maintain: "wearsim maintain packaging-conveyor",
        lubricate: "wearsim lubricate bicycle-17t-lubricants",
        remaining: "wearsim remaining 16b-20t-oiled --hours 900 --depth-mm 0.1",
        calibrate: "wearsim calibrate drive.toml readings.csv",
        judge: "wearsim judge readings.csv",
    },
    "Studies": {
        sweep: "wearsim sweep teeth-and-tension",
        uncertainty: "wearsim uncertainty 16b-20t-oiled --samples 1024",
        sensitivity: "wearsim sensitivity 16b-20t-oiled --samples 256",
        optimise: "wearsim optimise 16b-20t-lightest",
    },
    "Export": {
        export: "wearsim export 16b-20t-oiled --out wheel.dxf",
        profile: "wearsim profile 16b-20t-oiled --out flank.csv",
    },
    "Gears and handbook": {
        strength: "wearsim strength strength-a-tempered",
        stiffness_spectrum: "wearsim stiffness-spectrum stiffness-spectrum-20-30",
        face_load: "wearsim face-load face-load-mill-drive",
        hertz_check: "wearsim hertz-check hertz-check-36-54",
        synthesise: "wearsim synthesise synthesise-two-segments",
        convex_concave: "wearsim convex-concave convex-concave-17-34",
        wave_drive: "wearsim wave-drive wave-drive-100",
    },
    "Housekeeping": {
        list_table: "wearsim list chains",
        schema: "wearsim schema --of gear",
        cite: "wearsim cite --format bibtex",
        doctor: "wearsim doctor",
        warm: "wearsim warm",
        completion: "wearsim completion bash",
    },
}


class CommandGroups(click.Group):
    """A command whose help shows all others in their groups."""

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write what each command does, and beneath it the example."""
        for group, commands in COMMAND_GROUPS.items():
            with formatter.section(group):
                formatter.write_dl(
                    [
                        row
                        for command, example in commands.items()
                        for row in ((command.name or "", command.short_help or ""), ("", example))
                    ]
                )
