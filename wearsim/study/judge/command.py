"""``wearsim judge``: which law of wear a table of readings follows."""

from pathlib import Path

import click

from wearsim.command.answered import Shown, shown_options
from wearsim.command.complete import ReadingsPath
from wearsim.command.options import common_options, working


@click.command(short_help="Find the wear law that your readings follow.")
@click.argument("data", type=ReadingsPath(), metavar="DATA")
@click.option(
    "--particles",
    type=click.IntRange(100, 20_000),
    default=1000,
    show_default=True,
    metavar="N",
    help="Number of random draws of the constants of each law.",
)
@shown_options("tables and a picture")
@common_options
def judge(data: Path, particles: int, shown: Shown) -> None:
    """Fit each applicable wear law to some of the readings in DATA (.csv), and score it on the rest.

    Each row of the table is a reading: series, cycles (or time_hours, distance_km, distance_m),
    wear_um (or wear_mm, wear_mg, elongation_percent), and, if known, load_N, reading_error,
    censored, environment, relubricated, t_gamma_N_per_mm2, speed_m_per_s and held_out. Without
    held_out, the later half of each series is held out.
    """
    shown.check(data)
    from wearsim.study.judge import answer

    with shown.failing(data.stem), working(f"judging {data.stem}") as progress:
        found = answer.judge(data, particles=particles, progress=progress)
    shown.save(found, data)
