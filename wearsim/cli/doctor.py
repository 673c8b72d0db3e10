"""``wearsim doctor``: whether this installation is in order."""

import json
from dataclasses import asdict

import click

from wearsim._version import ANSWER_HEAD
from wearsim.catalogue.shipped_cases import shipped_cases
from wearsim.command.options import common_options

_NOT_IN_ORDER = 1
_SELF_TEST = "hertz-arc-prescribed"


@click.command(short_help="Check the installation and suggest fixes.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
@common_options
def doctor(as_json: bool) -> int:
    """Check versions, kernels, cache, folders, extras and browser, and compute a life that is known.

    The exit code is 1 if something required has failed. Notes do not count.
    """
    from wearsim.installation import installation_checks

    found = installation_checks(shipped_cases().get(_SELF_TEST))
    failed = [one.name for one in found if one.state == "failed"]
    if as_json:
        content = {**ANSWER_HEAD, "in_order": not failed, "findings": [asdict(one) for one in found]}
        click.echo(json.dumps(content, ensure_ascii=False))
        return _NOT_IN_ORDER if failed else 0
    width = max(len(one.name) for one in found)
    for one in found:
        click.echo(f"{one.state:<6}  {one.name:<{width}}  {one.found}")
        if one.advice:
            click.echo(f"{'':<6}  {'':<{width}}  -> {one.advice}")
    click.echo(f"to be mended: {', '.join(failed)}" if failed else "all that is needed is in order")
    return _NOT_IN_ORDER if failed else 0
