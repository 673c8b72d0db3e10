"""``wearsim list``: the tables that come with wearsim."""

import json
import textwrap
from collections.abc import Iterator, Mapping
from pathlib import Path

import click

from wearsim.command.options import common_options

_WIDTH = 100
_DOUBTFUL = "?"

_COLUMNS: dict[str, dict[str, str]] = {
    "chains": {
        "designation": "designation",
        "pitch_mm": "p\nmm",
        "roller_diameter_mm": "d1\nmm",
        "inner_width_mm": "b1\nmm",
        "pin_diameter_mm": "d2\nmm",
        "bearing_area_mm2": "A\nmm2",
        "transverse_pitch_mm": "p_t\nmm",
        "tensile_kN": "Q\nkN",
        "mass_kg_per_m": "q\nkg/m",
        _DOUBTFUL: _DOUBTFUL,
    },
    "materials": {
        "name": "name",
        "youngs_modulus_MPa": "E\nMPa",
        "poissons_ratio": "nu",
        "density_kg_per_m3": "rho\nkg/m3",
        "source": "source",
    },
    "wear-conditions": {
        "condition": "condition",
        "lubricated": "lubri-\ncated",
        "low_mm2_per_N": "k low\nmm2/N",
        "typical_mm2_per_N": "typical",
        "high_mm2_per_N": "high",
        "joint_low_mm2_per_N": "k_j low\nmm2/N",
        "joint_typical_mm2_per_N": "typical",
        "joint_high_mm2_per_N": "high",
    },
    "lubricants": {
        "lubricant": "lubricant",
        "wear_condition": "wear condition",
        "supply": "supply",
        "lasts_sliding_m": "s_L\nm",
        "dry_factor": "R",
        "contamination_removed": "removed",
    },
    "environments": {
        "environment": "environment",
        "contamination_factor": "1+C",
        "low": "low",
        "high": "high",
        "ageing_factor": "ageing",
    },
    "wear-laws": {"law": "law", "kind": "kind", "formula": "formula", "keys": "keys"},
    "cases": {"name": "name", "command": "command", "title": "title"},
    "quantities": {"name": "name", "symbol": "symbol", "unit": "unit", "meaning": "meaning"},
}
"""Columns of each table on the screen, with their headings; JSON has all of them, under their names."""


@click.command("list", short_help="List chains, materials, wear conditions, laws or cases.")
@click.argument("table", type=click.Choice(tuple(_COLUMNS)))
@click.option("--json", "as_json", is_flag=True, help="Print a JSON array with all columns.")
@common_options
def list_table(table: str, as_json: bool) -> None:
    """Print a TABLE with the sources of its numbers.

    The table of cases lists those that come with wearsim; any command accepts them by name.
    """
    rows = _rows(table)
    if as_json:
        click.echo(json.dumps(rows, ensure_ascii=False))
        return
    click.echo(_table_text(_COLUMNS[table], rows))
    for line in (*_legend(_COLUMNS[table]), *_doubts(table), *_notes(_COLUMNS[table], rows)):
        click.echo(line)


def _rows(table: str) -> list[dict[str, str]]:
    if table == "quantities":
        from wearsim.quantities import quantities

        return [vars(quantity) for quantity in quantities().values()]
    if table == "cases":
        from wearsim.catalogue.shipped_cases import shipped_cases

        return [_case(name, path) for name, path in shipped_cases().items()]
    from wearsim.catalogue.catalogues import catalogue_rows, chain_rows

    return list(chain_rows() if table == "chains" else catalogue_rows(table.replace("-", "_")))


def _case(name: str, path: Path) -> dict[str, str]:
    import tomllib

    from wearsim.input.document import command_of

    tables = tomllib.loads(path.read_text(encoding="utf-8"))
    return {"name": name, "command": command_of(tables), "title": tables.get("title", ""), "file": str(path)}


def _table_text(columns: Mapping[str, str], rows: list[dict[str, str]]) -> str:
    """Return some columns side by side, long words folded so that a line has at most 100 characters."""
    from rich.console import Console
    from rich.table import Table

    table = Table(box=None, pad_edge=False, padding=(0, 1, 0, 0))
    for name, heading in columns.items():
        if "_" in name:
            table.add_column(heading, justify="right", no_wrap=True)
        else:
            table.add_column(heading, overflow="fold")
    for row in rows:
        flag = _DOUBTFUL if "doubtful" in row.get("trust", "") else ""
        table.add_row(*({**row, _DOUBTFUL: flag}[name] for name in columns))
    console = Console(width=_WIDTH, color_system=None, markup=False, emoji=False, highlight=False)
    with console.capture() as shown:
        console.print(table)
    return "\n".join(line.rstrip() for line in shown.get().splitlines())


def _legend(columns: Mapping[str, str]) -> Iterator[str]:
    """Give what the symbols above columns stand for."""
    from wearsim.quantities import quantities

    known = (quantities()[name] for name in columns if name in quantities())
    lines = [f"{one.symbol:<4} {one.meaning}" for one in known if one.symbol]
    yield from ["", *lines] if lines else []


_NOTES = ("range", "not_for", "source", "joint_source")
"""Columns of whole sentences, which are printed below a table unless they stand in it."""


def _notes(columns: Mapping[str, str], rows: list[dict[str, str]]) -> Iterator[str]:
    """Give what is to say of each row and too long for a column, once for rows that share it."""
    for name in (name for name in _NOTES if name in rows[0] and name not in columns):
        yield f"\n{name.replace('_', ' ')}"
        rows_of: dict[str, list[str]] = {}
        for row in rows:
            rows_of.setdefault(row[name], []).append(next(iter(row.values())))
        for note, names in rows_of.items():
            text = f"{', '.join(names)}: {note}"
            yield textwrap.fill(text, _WIDTH, initial_indent="  ", subsequent_indent="    ")


def _doubts(table: str) -> Iterator[str]:
    if _DOUBTFUL in _COLUMNS[table]:
        yield f"{_DOUBTFUL:<4} has doubtful numbers: wearsim list {table} --json names them in trust and note"
