"""``wearsim optimise``: the best designs of a case."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from wearsim.command.complete import CasePath
from wearsim.command.options import common_options, explain_option, overrides, print_json, show, warn
from wearsim.command.study import StudyOptions, study_options
from wearsim.command.study_run import in_batches, timed
from wearsim.quantities import time_in_words

if TYPE_CHECKING:
    from wearsim.study.optimise.model import OptimiseStudy


@click.command(short_help="Find the best designs for life, mass and pressure.")
@click.argument("case", type=CasePath(path_type=Path), metavar="CASE")
@click.option(
    "--evaluations",
    type=click.IntRange(min=10, max=1_000_000),
    default=400,
    show_default=True,
    help="Largest number of designs to try.",
)
@click.option(
    "--seed", type=click.IntRange(min=0), default=1, show_default=True, help="Seed of the random search."
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
@explain_option
@study_options
@overrides
@common_options
def optimise(
    case: Path,
    evaluations: int,
    seed: int,
    as_json: bool,
    explain: bool,
    options: StudyOptions,
    settings: tuple[str, ...],
) -> int:
    """Find the best designs of CASE (.toml) among those that its table [optimise] allows.

    The table gives parameters (ranges or lists of values of any keys), objectives (life_hours,
    mass_kg, peak_pressure_MPa) and limits. One objective gives the best design, several give the
    Pareto front (pip install 'wearsim[optimise]').

    --out writes candidates.csv, front.csv, summary.md, pictures, and the best designs as cases in
    the folder designs. To continue an interrupted study, run the same command again.
    """
    from wearsim.study.optimise.model import load_optimise
    from wearsim.study.optimise.search import best_designs, check_library
    from wearsim.study.optimise.trials import check_feasible

    study = load_optimise(case, settings, evaluations, seed)
    check_library(study)
    identity = _identity(study)
    if options.dry_run:
        _show_plan(study, options, identity)
        return 0
    text = f"optimising {study.case.title}"
    with in_batches(study.unchanged, options, identity, text, evaluations + 1) as run:
        outcome = best_designs(study, run)
    from wearsim.study.optimise.sheet import (
        optimise_json,
        optimise_text,
        optimise_warnings,
        write_candidates,
        write_optimise,
    )

    if options.out is not None:
        write_candidates(outcome, options.out)
    check_feasible(study, outcome.candidates)
    if as_json:
        print_json(optimise_json(outcome), case, optimise_warnings(outcome))
    else:
        show(optimise_text(outcome, explain))
    if options.out is not None:
        write_optimise(outcome, options.out)
        warn(f"written to {options.out}")
    return 0


def _identity(study: "OptimiseStudy") -> dict[str, Any]:
    """What makes a study the same one; the number of designs is none of it: more of them go on."""
    return {
        "study": "optimise",
        "case": study.case.name,
        "seed": study.seed,
        "optimise": study.case.inputs["optimise"],
    }


def _show_plan(study: "OptimiseStudy", options: StudyOptions, identity: Mapping[str, Any]) -> None:
    from wearsim.runner.store import check_store

    options.workers()
    if options.out is not None:
        check_store(options.out, study.unchanged, identity, options.force)
    points = study.space.start(4, study.seed, study.values)
    seconds, count = timed(study.design([study.space.values(point) for point in points]))
    click.echo(f"designs      {study.evaluations} at most, beside the case as given")
    time = time_in_words(seconds * study.evaluations)
    click.echo(f"time         at least {time} in one thread, from {count} designs")
    if options.out is not None:
        click.echo(f"files        in {options.out / 'shards'}, and tables beside it")
