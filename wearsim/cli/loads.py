"""``wearsim loads``: what each tooth of a wrapped sprocket carries."""

import json
from pathlib import Path

import click

from wearsim.command.colours import show
from wearsim.command.complete import CasePath
from wearsim.command.options import common_options, finite, overrides, sprocket_option, warn


@click.command(short_help="Link tension and tooth force along the wrap.")
@click.argument("case", type=CasePath(path_type=Path), metavar="CASE")
@click.option(
    "--elongation",
    type=click.FloatRange(0.0, 10.0),
    default=0.0,
    show_default=True,
    metavar="PERCENT",
    callback=finite,
    help="Elongation of the chain, in percent.",
)
@click.option(
    "--phase",
    type=click.FloatRange(0.0, 1.0),
    metavar="F",
    callback=finite,
    help="Fraction of a pitch since the first roller entered; default: 1, the end of its articulation.",
)
@click.option("--worst", is_flag=True, help="Use the phase with the largest tooth force.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
@sprocket_option
@overrides
@common_options
def loads(
    case: Path,
    elongation: float,
    phase: float | None,
    worst: bool,
    as_json: bool,
    sprocket: str | None,
    settings: tuple[str, ...],
) -> None:
    """Print the loads on the teeth of CASE; tooth 1 is at the tight end.

    For a whole drive ([[sprocket]] twice or more): spans and shafts, then the teeth of every sprocket.
    """
    if worst and phase is not None:
        raise click.UsageError("--worst looks at all phases: give --phase or --worst, not both")
    from wearsim.mechanisms.wrap.tooth_loads import tooth_loads
    from wearsim.report.loads_table import loads_json, loads_table
    from wearsim.study.whole_drive.command import is_drive, load_one, loaded_teeth

    part = None if worst else 1.0 if phase is None else phase
    if sprocket is None and is_drive(case):
        loaded_teeth(case, settings, as_json, 0.01 * elongation, part)
        return
    loaded = load_one(case, settings, sprocket, as_json)
    found = tooth_loads(loaded, 0.01 * elongation, part)
    if as_json:
        click.echo(json.dumps(loads_json(found), ensure_ascii=False, allow_nan=False))
    else:
        show(loads_table(found))
    for text in loaded.warnings:
        warn(f"{case}: warning: {text}")
