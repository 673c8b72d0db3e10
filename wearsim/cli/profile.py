"""``wearsim profile``: the working flank of a case as points."""

from pathlib import Path

import click

from wearsim.command.complete import CasePath
from wearsim.command.options import load_cases, overrides, standard
from wearsim.errors import OutputError


@click.command(short_help="The working flank as a CSV file of points.")
@click.argument("case", type=CasePath(path_type=Path), metavar="CASE")
@click.option(
    "--out",
    type=click.Path(path_type=Path, allow_dash=True),
    default="-",
    show_default=True,
    help="New CSV file; - is stdout.",
)
@click.option("--force", is_flag=True, help="Replace the file.")
@overrides
@standard
def profile(case: Path, out: Path, force: bool, settings: tuple[str, ...]) -> None:
    """Write the working flank of CASE: points, curvature, pressure angle and evolute."""
    from wearsim.files import check_free, write_file

    if str(out) != "-":
        check_free(out, force)
        if out.resolve() == case.resolve():
            raise OutputError(f"{out}: must not be the case itself: choose another place")
    (loaded,) = load_cases([case], settings, as_json=False)
    from wearsim.report.flank_table import profile_table

    text = profile_table(loaded).to_csv(index=False)
    if str(out) == "-":
        click.echo(text, nl=False)
    else:
        write_file(out, text, force)
