"""``wearsim judge``: which law of wear a table of readings follows."""

from pathlib import Path

import click

from wearsim.command.colours import show
from wearsim.command.options import common_options, error_json, print_json, warn, working
from wearsim.errors import WearsimError


@click.command(short_help="Which wear law do your readings follow?")
@click.argument("data", type=click.Path(path_type=Path, exists=True, dir_okay=False), metavar="DATA")
@click.option(
    "--particles",
    type=click.IntRange(100, 20_000),
    default=1000,
    show_default=True,
    metavar="N",
    help="Number of random draws of the constants of each law.",
)
@click.option("--out", type=click.Path(path_type=Path), help="New folder for tables and a picture.")
@click.option("--force", is_flag=True, help="Replace an existing folder.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
@common_options
def judge(data: Path, particles: int, out: Path | None, force: bool, as_json: bool) -> None:
    """Fit each applicable wear law to some of the readings in DATA (.csv), and score it on the rest.

    Each row of the table is a reading: series, cycles (or time_hours, distance_km, distance_m),
    wear_um (or wear_mm, wear_mg, elongation_percent), and, if known, load_N, reading_error,
    censored, environment, relubricated, t_gamma_N_per_mm2, speed_m_per_s and held_out. Without
    held_out, the later half of each series is held out.
    """
    if out is not None:
        from wearsim.files import check_folder

        if data.resolve().is_relative_to(out.resolve()):
            raise click.UsageError(f"--out {out} must not be the folder of {data}: choose another place")
        check_folder(out, force)
    from wearsim.study.judge.model import judge_series
    from wearsim.study.judge.series_file import read_series

    try:
        series = read_series(data)
    except WearsimError as fault:
        if as_json:
            click.echo(error_json(data.stem, fault))
        raise
    with working(f"judging {data.stem}") as report_progress:
        found = judge_series(series, particles, progress=report_progress)
    from wearsim.study.judge.sheet import judgement_json, judgement_text, save_judgement

    if as_json:
        print_json(judgement_json(found, data.name), data, series.warnings)
    else:
        show(judgement_text(found))
    if out is not None:
        save_judgement(found, data, out, force)
        warn(f"written to {out}")
