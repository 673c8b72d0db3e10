"""``wearsim loads``: what each tooth of a wrapped sprocket carries."""

from pathlib import Path

import click

from wearsim.command.cases_and_runs import one_sprocket
from wearsim.command.complete import CasePath
from wearsim.command.options import (
    common_options,
    explain_option,
    finite,
    load_cases,
    overrides,
    print_json,
    show,
    sprocket_option,
    warn,
)


@click.command(short_help="Compute link tensions and tooth forces along the wrap.")
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
@explain_option
@sprocket_option
@overrides
@common_options
def loads(
    case: Path,
    elongation: float,
    phase: float | None,
    worst: bool,
    as_json: bool,
    explain: bool,
    sprocket: str | None,
    settings: tuple[str, ...],
) -> None:
    """Print the loads on the teeth of CASE; tooth 1 is at the tight end.

    For a whole drive ([[sprocket]] twice or more): spans and shafts, then the teeth of every sprocket.
    """
    if worst and phase is not None:
        raise click.UsageError("--worst looks at all phases: give --phase or --worst, not both")
    from wearsim.mechanisms.wrap.tooth_loads import tooth_loads
    from wearsim.report.drive.layout import loads_json_of, loads_text

    (loaded,) = load_cases([case], settings, as_json)
    if sprocket is not None:
        loaded = one_sprocket(loaded, case, sprocket)
    part = None if worst else 1.0 if phase is None else phase
    teeth = {name: tooth_loads(one, 0.01 * elongation, part) for name, one in loaded.single_cases.items()}
    if as_json:
        print_json(loads_json_of(loaded, teeth), case, loaded.warnings)
        return
    show(loads_text(loaded, teeth, explain))
    for text in loaded.warnings:
        warn(f"{case}: warning: {text}")
