"""``wearsim sweep``: lives over values of any input keys."""

from pathlib import Path

import click

from wearsim.command.complete import CasePath
from wearsim.command.options import common_options, overrides, warn
from wearsim.command.study import StudyOptions, study_options
from wearsim.command.study_run import exit_code, run


@click.command(short_help="Compute lives for many values of any keys.")
@click.argument("study", type=CasePath(path_type=Path), metavar="STUDY")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object per case.")
@study_options
@overrides
@common_options
def sweep(study: Path, as_json: bool, options: StudyOptions, settings: tuple[str, ...]) -> int:
    """Run the case of STUDY (.toml) for many values of its keys and print the lives.

    STUDY names the case and gives values in [grid] (every combination), [[zip]] (keys that change
    together) and [[design]] (single designs). --set changes keys of the case.

    --out writes cases.csv, summary.md and pictures. To continue an interrupted study, run the same
    command again.
    """
    from wearsim.study.sweep.model import load_sweep

    loaded = load_sweep(study, settings)
    identity = {"study": "sweep", "title": loaded.title, "case": loaded.design.name}
    table = run(loaded.design, options, identity, f"sweeping {loaded.title}")
    if table is None:
        return 0
    from wearsim.study.sweep.sheet import (
        sweep_accuracy,
        sweep_caution,
        sweep_json,
        sweep_lines,
        sweep_warning,
        write_sweep,
    )

    for line in (sweep_json if as_json else sweep_lines)(loaded, table):
        click.echo(line)
    of_cases = "" if as_json else sweep_warning(table)
    for warning in filter(None, [sweep_caution(loaded, table), sweep_accuracy(table), of_cases]):
        warn(f"warning: {warning}")
    if options.out is not None:
        write_sweep(loaded, table, options.out)
        warn(f"written to {options.out}")
    return exit_code(table)
