"""``wearsim schema``: what an input file may hold, for editors and programs."""

import json

import click

from wearsim.cli.standard import standard


@click.command(short_help="JSON Schema of the input file or of the result.")
@click.option("--result", "of_result", is_flag=True, help="Of what life --json prints instead.")
@standard
def schema(of_result: bool) -> None:
    """Print the JSON Schema of the input file; editors complete and check .toml files with it."""
    if of_result:
        from importlib.resources import files

        click.echo(files("wearsim").joinpath("result.schema.json").read_text("utf-8").rstrip())
        return
    from wearsim.case.schema import CaseTables

    content = {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        **CaseTables.model_json_schema(),
        "title": "wearsim case",
    }
    click.echo(json.dumps(content, indent=2))
