"""All commands in the groups of ``wearsim --help``, each with an example."""

import click

from wearsim.cli.animate import animate
from wearsim.cli.check import check
from wearsim.cli.cite import cite
from wearsim.cli.compare import compare
from wearsim.cli.completion import completion
from wearsim.cli.doctor import doctor
from wearsim.cli.export import export
from wearsim.cli.handbook import handbook
from wearsim.cli.init import init
from wearsim.cli.life import life
from wearsim.cli.list import list_table
from wearsim.cli.loads import loads
from wearsim.cli.profile import profile
from wearsim.cli.report import report
from wearsim.cli.schema import schema
from wearsim.cli.ui import ui
from wearsim.cli.warm import warm
from wearsim.scanning.command import scan
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
        scan: "wearsim scan sprocket.jpg --chain 08B --out worn",
        remaining: "wearsim remaining 16b-20t-oiled --hours 900 --depth-mm 0.1",
        calibrate: "wearsim calibrate 16b-20t-oiled 16b-20t-readings",
        judge: "wearsim judge metal-wear",
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
    "Gears": {handbook: "wearsim handbook strength strength-a-tempered"},
    "Housekeeping": {
        list_table: "wearsim list chains",
        schema: "wearsim schema --of gear",
        cite: "wearsim cite --format bibtex",
        doctor: "wearsim doctor",
        warm: "wearsim warm",
        completion: "wearsim completion bash",
    },
}
