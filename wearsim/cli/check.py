"""``wearsim check``: everything about a case that can be found without a run."""

import json
from pathlib import Path

import click

from wearsim.command.complete import CasePath
from wearsim.command.options import common_options, explain_option, load_cases, overrides, show


@click.command(short_help="Check a case: keys, geometry, ratings.")
@click.argument("cases", nargs=-1, required=True, type=CasePath(path_type=Path), metavar="CASE...")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object per case.")
@explain_option
@overrides
@common_options
def check(cases: tuple[Path, ...], as_json: bool, explain: bool, settings: tuple[str, ...]) -> None:
    """Check each CASE (.toml): keys, files, geometry and ratings."""
    loaded = load_cases(cases, settings, as_json)
    from wearsim.report.check import check_json, check_text

    for path, case in zip(cases, loaded, strict=True):
        if as_json:
            click.echo(json.dumps(check_json(case), ensure_ascii=False))
            continue
        names = case.single_cases
        sprockets = f", sprockets {', '.join(names)}" if len(names) > 1 else ""
        show(check_text(case, f"{path}: ok{sprockets}", explain))
