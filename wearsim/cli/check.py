"""``wearsim check``: everything about a case that can be found without a run."""

import json
from pathlib import Path

import click

from wearsim.command.colours import show
from wearsim.command.complete import CasePath
from wearsim.command.options import common_options, load_cases, overrides


@click.command(short_help="Check a case: keys, geometry, ratings.")
@click.argument("cases", nargs=-1, required=True, type=CasePath(path_type=Path), metavar="CASE...")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object per case.")
@overrides
@common_options
def check(cases: tuple[Path, ...], as_json: bool, settings: tuple[str, ...]) -> None:
    """Check each CASE (.toml): keys, files, geometry and ratings; print what it assumes."""
    from wearsim.study.whole_drive.command import are_drives, checked

    if are_drives(cases):
        checked(cases, settings, as_json)
        return
    loaded = load_cases(cases, settings, as_json)
    from wearsim.report.rating import check_assumptions, check_json, check_warnings, notes_text, rating_table

    for path, case in zip(cases, loaded, strict=True):
        if as_json:
            click.echo(json.dumps(check_json(case), ensure_ascii=False))
            continue
        click.echo(f"{path}: ok")
        for text in check_assumptions(case):
            click.echo(f"  assumes  {text}")
        for text in (rating_table(case), notes_text(case)):
            if text:
                show(text)
        for text in check_warnings(case):
            show(f"  warning  {text}")
