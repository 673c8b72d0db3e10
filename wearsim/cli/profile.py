"""``wearsim profile``: the working flank of a case as points."""

from pathlib import Path

import click

from wearsim.command.cases_and_runs import one_sprocket
from wearsim.command.complete import CasePath
from wearsim.command.options import common_options, load_cases, overrides, sprocket_option
from wearsim.command.single_file import check_place


@click.command(short_help="Write the points of the working flank as CSV.")
@click.argument("case", type=CasePath(path_type=Path), metavar="CASE")
@click.option(
    "--out",
    type=click.Path(path_type=Path, allow_dash=True),
    default="-",
    show_default=True,
    help="New CSV file; - for stdout.",
)
@click.option("--force", is_flag=True, help="Replace an existing file.")
@sprocket_option
@overrides
@common_options
def profile(case: Path, out: Path, force: bool, sprocket: str | None, settings: tuple[str, ...]) -> None:
    """Write the working flank of CASE: points, curvature, pressure angle and evolute."""
    check_place(out, case, force)
    from wearsim.report.flank_view import profile_table

    (loaded,) = load_cases([case], settings, False)
    text = profile_table(one_sprocket(loaded, case, sprocket)).to_csv(index=False)
    if str(out) == "-":
        click.echo(text, nl=False)
    else:
        from wearsim.files import write_file

        write_file(out, text, force)
