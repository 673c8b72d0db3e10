"""``wearsim uncertainty``: how sure a life is."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from wearsim.command.complete import CasePath
from wearsim.command.options import (
    NOT_MET,
    common_options,
    explain_option,
    finite,
    overrides,
    print_json,
    show,
    warn,
    working,
)
from wearsim.command.study import StudyOptions, study_options
from wearsim.command.study_run import exit_code, run

if TYPE_CHECKING:
    from wearsim.runner.samples import Method
    from wearsim.study.uncertainty.life_statistics import UncertaintyAnswer


_ROUNDING = 1e-9


@click.command(short_help="Compute P10, P50 and P90 life for scattering inputs.")
@click.argument("case", type=CasePath(path_type=Path), metavar="CASE")
@click.option(
    "--samples",
    type=click.IntRange(min=2, max=10_000_000),
    default=1024,
    show_default=True,
    help="Number of lives to compute.",
)
@click.option(
    "--seed", type=click.IntRange(min=0), default=1, show_default=True, help="Seed of the random samples."
)
@click.option(
    "--method",
    type=click.Choice(("sobol", "lhs", "random")),
    default="sobol",
    show_default=True,
    help="Sampling: scrambled Sobol' points, Latin hypercube or independent samples.",
)
@click.option(
    "--require-hours",
    type=click.FloatRange(min=0.0, min_open=True),
    metavar="H",
    callback=finite,
    help="Exit with code 4 if P10 is shorter; raises the horizon to at least H.",
)
@click.option(
    "--cross-check",
    is_flag=True,
    help="Repeat the fits with the library reliability (pip install 'wearsim[crosscheck]').",
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
@explain_option
@study_options
@overrides
@common_options
def uncertainty(
    case: Path,
    samples: int,
    seed: int,
    method: "Method",
    require_hours: float | None,
    cross_check: bool,
    as_json: bool,
    explain: bool,
    options: StudyOptions,
    settings: tuple[str, ...],
) -> int:
    """Print the lives that 90 %, 50 % and 10 % of drives like CASE (.toml) exceed.

    The table [uncertainty] of the case gives the distributions of its keys; a wear coefficient that
    it does not name scatters as published.

    --out writes cases.csv, convergence.csv, summary.md and pictures. To continue an interrupted
    study, run the same command again.
    """
    from wearsim.extras import check_installed
    from wearsim.study.uncertainty.model import load_uncertainty

    if cross_check:
        check_installed(("reliability",), "crosscheck", "--cross-check")
    study = load_uncertainty(case, settings, samples, seed, method, require_hours)
    identity = {"study": "uncertainty", "case": study.scattered.case.name, "method": method, "seed": seed}
    table = run(study.design, options, identity, f"sampling {study.scattered.case.title}")
    if table is None:
        return 0
    from wearsim.study.uncertainty.life_statistics import UncertaintyAnswer, uncertainty_warnings
    from wearsim.study.uncertainty.sheet import uncertainty_json, uncertainty_text, write_uncertainty

    code, answer = exit_code(table), UncertaintyAnswer(study, table)
    if cross_check:
        answer = _cross_checked(answer)
    if as_json:
        print_json(uncertainty_json(answer), case, uncertainty_warnings(answer))
    else:
        show(uncertainty_text(answer, explain))
    if options.out is not None:
        write_uncertainty(answer, options.out)
        warn(f"written to {options.out}")
    missed = _missed(answer, require_hours)
    return code or missed


def _cross_checked(answer: "UncertaintyAnswer") -> "UncertaintyAnswer":
    # The library takes two seconds to load.
    from wearsim.study.uncertainty.cross_check import cross_check

    with working("repeating the fits by reliability"):
        return replace(answer, crossed=cross_check(answer.hours, answer.reached, answer.fits))


def _missed(answer: "UncertaintyAnswer", require_hours: float | None) -> int:
    if require_hours is None:
        return 0
    from wearsim.study.uncertainty.percentiles import B10, percentile

    p10 = percentile(answer.hours, answer.reached, B10)
    if p10.hours >= (1.0 - _ROUNDING) * require_hours:
        return 0
    warn(f"{answer.study.scattered.case.name}: P10 {p10.hours:.6g} h is below {require_hours:g} h")
    return NOT_MET
