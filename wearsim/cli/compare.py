"""``wearsim compare``: several lives side by side, with pictures."""

import json
from pathlib import Path

import click

from wearsim.cli.sources import results_of
from wearsim.cli.standard import SOME_FAILED, overrides, standard, warn


@click.command(short_help="Several lives side by side: tables and pictures.")
@click.argument(
    "sources", nargs=-1, required=True, type=click.Path(path_type=Path), metavar="CASE_OR_RUN..."
)
@click.option("--out", required=True, type=click.Path(path_type=Path), help="New folder.")
@click.option("--force", is_flag=True, help="Replace the folder.")
@click.option("--json", "as_json", is_flag=True, help="One JSON object per case on stdout.")
@overrides
@standard
def compare(
    sources: tuple[Path, ...], out: Path, force: bool, as_json: bool, settings: tuple[str, ...]
) -> int:
    """Compare cases (.toml, run now) and runs (folders of life --out).

    The folder holds summary.csv and summary.md and pictures of the flanks, of depth,
    pressure and sliding along them, and of depth against hours.
    """
    from wearsim.output import check_folder

    check_folder(out, force)
    found = results_of(sources, settings, as_json)
    from wearsim.report.compare import differing_limits, distinct, save_comparison

    results = distinct(list(found.values()), [str(path) for path in found])
    summary = save_comparison(results, out, force)
    if as_json:
        from wearsim.report.service import life_json

        for result in results:
            click.echo(json.dumps(life_json(result), ensure_ascii=False, allow_nan=False))
    else:
        click.echo(summary)
    if limits := differing_limits(results):
        warn(f"warning: {limits}")
    warn(f"written to {out}")
    return SOME_FAILED if len(found) < len(set(sources)) else 0
