"""``wearsim select``: chains and teeth of the catalogue that carry a power and live long enough."""

import shlex
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from wearsim.command.options import (
    FAILED,
    common_options,
    error_json,
    explain_option,
    keeping_runs,
    print_json,
    warn,
    working,
)
from wearsim.command.single_file import write_content
from wearsim.errors import CaseError, OutputError, WearsimError

if TYPE_CHECKING:
    from click.shell_completion import CompletionItem

    from wearsim.study.select.sheet import SelectionAnswer
    from wearsim.study.select.wish import Wish

_Function = TypeVar("_Function", bound=Callable[..., Any])


def _offer(words: Sequence[str]) -> Callable[..., "list[CompletionItem[str]]"]:
    def _complete(
        context: click.Context, parameter: click.Parameter, incomplete: str
    ) -> "list[CompletionItem[str]]":
        from click.shell_completion import CompletionItem

        return [CompletionItem(word) for word in words if word.startswith(incomplete)]

    return _complete


def _lubrications(
    context: click.Context, parameter: click.Parameter, incomplete: str
) -> "list[CompletionItem[str]]":
    from wearsim.chain.service_conditions import LUBRICATIONS

    return _offer(tuple(LUBRICATIONS))(context, parameter, incomplete)


def _requirement_options(function: _Function) -> _Function:
    """Add the options that say what the drive is to do and what may be used for it."""
    options = (
        click.option(
            "--power", metavar="KW", help="Transmitted power in kW, or with a unit, such as '4 hp'."
        ),
        click.option("--rpm", metavar="RPM", help="Speed of the driver."),
        click.option("--ratio", metavar="I", help="Speed ratio: driver speed over driven speed."),
        click.option("--hours", metavar="H", help="Required life of the chain, in running hours."),
        click.option("--centre", metavar="MM", help="Centre distance in mm; default: about 40 pitches."),
        click.option("--centre-min", metavar="MM", help="Smallest centre distance allowed."),
        click.option("--centre-max", metavar="MM", help="Largest centre distance allowed."),
        click.option("--max-diameter", metavar="MM", help="Largest tip diameter allowed."),
        click.option(
            "--lubrication",
            default="drip",
            show_default=True,
            metavar="WORD",
            shell_complete=_lubrications,
            help="Lubrication: drip, oil bath, forced, manual, greased or dry.",
        ),
        click.option(
            "--environment",
            default="clean",
            show_default=True,
            metavar="WORD",
            shell_complete=_offer(("clean", "dust", "wet", "mud", "soil")),
            help="Environment of the chain: clean, dust, wet, mud or soil.",
        ),
        click.option(
            "--tooth-hardness",
            default="hardened",
            show_default=True,
            metavar="WORD",
            shell_complete=_offer(("hardened", "normalised")),
            help="Teeth: hardened or normalised.",
        ),
        click.option(
            "--shock",
            default="smooth",
            show_default=True,
            metavar="WORD",
            shell_complete=_offer(("smooth", "moderate", "heavy")),
            help="Shocks from the driven machine: smooth, moderate or heavy.",
        ),
        click.option(
            "--hours-per-day", default="8", show_default=True, metavar="H", help="Running hours per day."
        ),
        click.option(
            "--series",
            default="A,B,H,GOST",
            show_default=True,
            metavar="WORDS",
            shell_complete=_offer(("A", "B", "H", "GOST")),
            help="Chain series to choose from, separated by commas.",
        ),
        click.option(
            "--strands",
            default="1-3",
            show_default=True,
            metavar="N-M",
            help="Number of strands, from N to M.",
        ),
        click.option(
            "--ratio-tolerance",
            default="3 %",
            show_default=True,
            metavar="PERCENT",
            help="Allowed deviation of the ratio.",
        ),
        click.option(
            "--teeth-min",
            default="17",
            show_default=True,
            metavar="Z",
            help="Fewest teeth on the smaller sprocket.",
        ),
        click.option(
            "--teeth-max",
            default="25",
            show_default=True,
            metavar="Z",
            help="Most teeth on the smaller sprocket.",
        ),
    )
    for option in reversed(options):
        function = option(function)
    return function


@click.command(short_help="Choose a chain and teeth for a drive.")
@_requirement_options
@click.option(
    "--price",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Price list, to rank by price: CSV with designation, price_per_m, sprocket_price_per_kg.",
)
@click.option(
    "--every-pair", is_flag=True, help="Show every pair of tooth numbers of a chain, not only the best."
)
@click.option(
    "--count",
    type=click.IntRange(min=1),
    default=10,
    show_default=True,
    metavar="N",
    help="Number of drives to show.",
)
@click.option(
    "--verify",
    type=click.IntRange(min=0),
    default=0,
    show_default=True,
    metavar="N",
    help="Also wear the sprockets of the first N drives, for up to twice the hours.",
)
@click.option(
    "--out",
    type=click.Path(path_type=Path, allow_dash=True),
    metavar="FILE",
    help="New case file for the best drive; - for stdout.",
)
@click.option(
    "--csv",
    "csv_file",
    type=click.Path(path_type=Path, allow_dash=True),
    metavar="FILE",
    help="New CSV file for the drives shown; - for stdout.",
)
@click.option("--force", is_flag=True, help="Replace existing files.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
@explain_option
@keeping_runs
@common_options
def select(
    price: Path | None,
    every_pair: bool,
    count: int,
    verify: int,
    out: Path | None,
    csv_file: Path | None,
    force: bool,
    as_json: bool,
    explain: bool,
    **texts: str | None,
) -> int:
    """Choose chains and teeth of the catalogue for a drive.

    A drive passes if it is within the ratings and its chain lasts long enough. The lightest drive
    comes first, or the cheapest with --price. The exit code is 3 if no drive passes, or if one that
    --verify wears does not last the hours.
    """
    from wearsim.study.select.sheet import answer_to, selection_json, selection_text
    from wearsim.study.select.wish import read_wish

    _check_places(out, csv_file, as_json, force)
    try:
        wish = read_wish(texts, price)
    except CaseError as error:
        if as_json:
            click.echo(error_json("select", error))
        raise
    answer = answer_to(wish, every_pair, count)
    verified = _verified(answer, wish, verify)
    if as_json:
        content = selection_json(answer)
        print_json({**content, "verified": verified} if verify else content, Path("select"))
    else:
        # A file on stdout leaves stderr for the table.
        on_stdout = "-" in (str(out), str(csv_file))
        (warn if on_stdout else click.echo)(
            "\n".join([selection_text(answer, explain), *map(_verified_text, verified)])
        )
    if not answer.shown:
        warn("select: no drive meets all limits: see the line Refused")
        return FAILED
    _write(answer, wish, out, csv_file, force)
    short = [one["title"] for one in verified if not one.get("long_enough")]
    if short:
        warn(f"select: not long enough, or not worn: {'; '.join(short)}; see Verified")
    return FAILED if short else 0


def _check_places(out: Path | None, csv_file: Path | None, as_json: bool, force: bool) -> None:
    from wearsim.files import check_free

    on_stdout = [name for name, place in (("--out", out), ("--csv", csv_file)) if str(place) == "-"]
    if as_json:
        on_stdout.append("--json")
    if len(on_stdout) > 1:
        raise click.UsageError(f"{' and '.join(on_stdout)} both write to stdout: give one of them a file")
    if out is not None and csv_file is not None and out.resolve() == csv_file.resolve():
        raise OutputError(f"{out}: must not be the file of --csv: choose another place")
    for place in (out, csv_file):
        if place is not None and str(place) != "-":
            check_free(place, force)


def _verified(answer: "SelectionAnswer", wish: "Wish", count: int) -> list[dict[str, Any]]:
    """Return the lives of all parts of the first drives."""
    if not count:
        return []
    from wearsim.study.select.selected_case import case_tables
    from wearsim.study.select.verified_lives import part_lives

    found = []
    for drive in answer.shown[:count]:
        tables = case_tables(drive, wish.need, wish.hours_per_day)
        title = str(tables["title"])
        with working(f"wearing {title}") as report_progress:
            try:
                found.append({"title": title, **part_lives(tables, wish.need.hours, report_progress)})
            except WearsimError as error:
                found.append({"title": title, "error": str(error)})
    return found


def _verified_text(verified: dict[str, Any]) -> str:
    from wearsim.report.text_lines import row
    from wearsim.study.select.verified_lives import lives_text

    return row("Verified", lives_text(verified))


def _write(
    answer: "SelectionAnswer", wish: "Wish", out: Path | None, csv_file: Path | None, force: bool
) -> None:
    """Write the case of the best drive and the table."""
    if out is not None:
        from wearsim.study.select.selected_case import case_tables, case_text

        tables = case_tables(answer.shown[0], wish.need, wish.hours_per_day)
        command = shlex.join(["wearsim", *sys.argv[1:]]).replace("\n", " ")
        write_content(out, case_text(tables, command).encode(), force)
    if csv_file is not None:
        from wearsim.study.select.sheet import drives_table

        write_content(csv_file, drives_table(answer.shown).csv().encode(), force)
