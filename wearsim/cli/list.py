"""``wearsim list``: the tables that come with wearsim."""

import json
from pathlib import Path

import click

from wearsim.command.options import common_options

_TABLES = ("chains", "materials", "wear-conditions", "cases", "quantities")


@click.command("list", short_help="Chains, materials, wear conditions, cases, quantities.")
@click.argument("table", type=click.Choice(_TABLES))
@click.option("--json", "as_json", is_flag=True, help="As a JSON array.")
@common_options
def list_table(table: str, as_json: bool) -> None:
    """Print a TABLE with the source of its numbers."""
    rows = _rows(table)
    if as_json:
        click.echo(json.dumps(rows, ensure_ascii=False))
        return
    names = list(rows[0])
    widths = {name: max(len(name), *(len(row[name]) for row in rows)) for name in names}
    for row in ({name: name for name in names}, *rows):
        click.echo("  ".join(f"{row[name]:<{widths[name]}}" for name in names).rstrip())


def _rows(table: str) -> list[dict[str, str]]:
    if table == "quantities":
        from wearsim.quantities import quantities

        return [vars(quantity) for quantity in quantities().values()]
    if table == "cases":
        return [_case(path) for path in shipped_cases()]
    from wearsim.catalogue.catalogues import catalogue_rows

    return list(catalogue_rows(table.replace("-", "_")))


def shipped_cases() -> list[Path]:
    """Return the cases that come with wearsim, whole drives last."""
    package = Path(__file__).parent.parent
    for folder in (package / "cases", package.parent / "cases"):
        found = [*sorted(folder.glob("*.toml")), *sorted(folder.glob("drives/*.toml"))]
        if found:
            return found
    return []


def _case(path: Path) -> dict[str, str]:
    import tomllib

    title = tomllib.loads(path.read_text(encoding="utf-8")).get("title", "")
    return {"file": str(path), "title": title}
