"""``wearsim schema``: what an input file may hold, for editors and programs."""

import json
from typing import Any

import click

from wearsim.command.complete import complete_kind
from wearsim.command.options import common_options


@click.command(short_help="Print the JSON Schema of the input file or the result.")
@click.option("--result", "of_result", is_flag=True, help="Schema of the output of life --json instead.")
@click.option(
    "--of",
    "command",
    metavar="KIND",
    shell_complete=complete_kind,
    help="Schema of another input file instead: a gear pair (gear) or a calculation (wave-drive, ...).",
)
@common_options
def schema(of_result: bool, command: str | None) -> None:
    """Print the JSON Schema of the input file, which editors use to complete and check .toml files."""
    if of_result and command:
        raise click.UsageError("give --result or --of, not both")
    if of_result:
        click.echo(json.dumps(result_schema(), indent=2))
        return
    from wearsim.case.keys import CaseTablesOrDrive
    from wearsim.command.registry import CALCULATIONS, OTHER_FILES, tables_of

    if command and command not in OTHER_FILES:
        raise click.BadParameter(f"must be one of {', '.join(OTHER_FILES)}, not {command}", param_hint="--of")
    model = tables_of(command) if command else CaseTablesOrDrive
    content = {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        **model.model_json_schema(),
        "title": f"wearsim handbook {command}" if command in CALCULATIONS else f"wearsim {command or 'case'}",
    }
    click.echo(json.dumps(content, indent=2))


def result_schema() -> dict[str, Any]:
    """JSON Schema of a result, with the keys of all limits that may end a life."""
    from importlib.resources import files

    from wearsim.contact.stop_limits import LIMITS

    found: dict[str, Any] = json.loads(files("wearsim").joinpath("life.schema.json").read_text("utf-8"))
    stop = found["$defs"]["life"]["properties"]["stop"]
    stop["enum"] = [*LIMITS, *stop["enum"]]
    return found
