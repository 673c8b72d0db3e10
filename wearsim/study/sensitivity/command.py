"""``wearsim sensitivity``: what of the input matters to a life."""

from pathlib import Path

import click

from wearsim.command.complete import CasePath
from wearsim.command.options import common_options, explain_option, overrides, print_json, show, warn, working
from wearsim.command.study import StudyOptions, study_options
from wearsim.command.study_run import run


def _power_of_two(context: click.Context, parameter: click.Parameter, value: int) -> int:
    if value & (value - 1):
        raise click.BadParameter(f"{value} is not a power of two.")
    return value


@click.command(short_help="Rank inputs by their effect on the life (Sobol', Morris).")
@click.argument("case", type=CasePath(path_type=Path), metavar="CASE")
@click.option(
    "--samples",
    type=click.IntRange(min=8, max=1 << 20),
    default=256,
    show_default=True,
    callback=_power_of_two,
    help="Base samples of Sobol's method, a power of two; each takes keys + 2 lives.",
)
@click.option(
    "--trajectories",
    type=click.IntRange(min=4, max=10_000),
    default=20,
    show_default=True,
    help="Trajectories of Morris' method; each takes keys + 1 lives.",
)
@click.option(
    "--seed", type=click.IntRange(min=0), default=1, show_default=True, help="Seed of the random samples."
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
@explain_option
@study_options
@overrides
@common_options
def sensitivity(
    case: Path,
    samples: int,
    trajectories: int,
    seed: int,
    as_json: bool,
    explain: bool,
    options: StudyOptions,
    settings: tuple[str, ...],
) -> int:
    """Print which keys of CASE (.toml) its life depends on, and what would double it.

    The table [uncertainty] of the case gives the distributions of its keys. --out writes
    sensitivity.csv, cases.csv, summary.md and a tornado chart. To continue an interrupted study, run
    the same command again. Needs SALib (pip install 'wearsim[study]').
    """
    from wearsim.extras import check_installed

    check_installed(("SALib",), "study", "sensitivity")
    from wearsim.study.sensitivity.model import doubling, effects, load_sensitivity

    study = load_sensitivity(case, settings, samples, trajectories, seed)
    scattered = study.scattered
    identity = {"study": "sensitivity", "case": scattered.case.name, "seed": seed}
    table = run(study.design, options, identity, f"sampling {scattered.case.title}")
    if table is None:
        return 0
    found = effects(study, table)
    with working(f"doubling the life of {scattered.case.title}"):
        doubled = doubling(scattered, found)
    from wearsim.study.sensitivity.sheet import (
        SensitivityAnswer,
        sensitivity_json,
        sensitivity_text,
        sensitivity_warnings,
        write_sensitivity,
    )

    doubts = sensitivity_warnings(found, scattered.case)
    answer = SensitivityAnswer(study, float(table["life_hours"][0]), found, doubled, doubts)
    if as_json:
        print_json(sensitivity_json(answer), case, answer.warnings)
    else:
        show(sensitivity_text(answer, explain))
    if options.out is not None:
        write_sensitivity(answer, table, options.out)
        warn(f"written to {options.out}")
    return 0
