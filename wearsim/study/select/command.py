"""``wearsim select``: chains and teeth of the catalogue that carry a power and live long enough."""

import shlex
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from wearsim.command.options import FAILED, common_options, print_json, warn, working
from wearsim.command.single_file import write_content
from wearsim.errors import CaseError, Fault, OutputError, WearsimError

if TYPE_CHECKING:
    from click.shell_completion import CompletionItem

    from wearsim.chain.service_conditions import ServiceConditions
    from wearsim.study.select.prices import Price
    from wearsim.study.select.requirements import DriveRequirements
    from wearsim.study.select.sheet import SelectionAnswer

_Function = TypeVar("_Function", bound=Callable[..., Any])

_REQUIRED = ("power", "rpm", "ratio", "hours")

_FIELDS = {"rpm": "speed"}
"""Fields of the requirements whose options have other names."""

_QUANTITIES = {
    "power": "kW",
    "rpm": "rpm",
    "ratio": "",
    "hours": "h",
    "centre": "mm",
    "centre_min": "mm",
    "centre_max": "mm",
    "max_diameter": "mm",
    "ratio_tolerance": "%",
    "hours_per_day": "",
    "teeth_min": "",
    "teeth_max": "",
}
"""Units of the options that hold a number, which may be written behind it."""

_WHOLE = ("teeth_min", "teeth_max")


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
        click.option("--power", metavar="KW", help="Power that the drive transmits, such as 3 or '4 hp'."),
        click.option("--rpm", metavar="RPM", help="Speed of the driver."),
        click.option("--ratio", metavar="I", help="Its speed over that of the driven shaft."),
        click.option("--hours", metavar="H", help="Running hours that the chain must live."),
        click.option("--centre", metavar="MM", help="Distance of the shafts; about 40 pitches without it."),
        click.option("--centre-min", metavar="MM", help="Least distance of the shafts."),
        click.option("--centre-max", metavar="MM", help="Greatest distance of the shafts."),
        click.option("--max-diameter", metavar="MM", help="Largest tip circle that there is room for."),
        click.option(
            "--lubrication",
            default="drip",
            show_default=True,
            metavar="WORD",
            shell_complete=_lubrications,
            help="drip, oil bath, forced, periodic, grease or dry.",
        ),
        click.option(
            "--shock",
            default="steady",
            show_default=True,
            metavar="WORD",
            shell_complete=_offer(("steady", "moderate", "heavy")),
            help="Load of the driven machine: steady, moderate or heavy shocks.",
        ),
        click.option("--hours-per-day", default="8", show_default=True, metavar="H", help="Hours of a day."),
        click.option(
            "--series",
            default="A,B,H,GOST",
            show_default=True,
            metavar="WORDS",
            shell_complete=_offer(("A", "B", "H", "GOST")),
            help="Series of chains, with commas between them.",
        ),
        click.option(
            "--strands", default="1-3", show_default=True, metavar="N-M", help="Strands of a chain."
        ),
        click.option(
            "--ratio-tolerance",
            default="3 %",
            show_default=True,
            metavar="PERCENT",
            help="Part by which the ratio may be off.",
        ),
        click.option(
            "--teeth-min", default="17", show_default=True, metavar="Z", help="Of the smaller sprocket."
        ),
        click.option("--teeth-max", default="25", show_default=True, metavar="Z", help="Of the same."),
    )
    for option in reversed(options):
        function = option(function)
    return function


@click.command(short_help="Chains and teeth of the catalogue for a drive.")
@_requirement_options
@click.option(
    "--price",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="CSV of designation, price_per_m, sprocket_price_per_kg: the cheapest drive first.",
)
@click.option("--every-pair", is_flag=True, help="Show all teeth of a chain, not only the best.")
@click.option(
    "--count", type=click.IntRange(min=1), default=10, show_default=True, metavar="N", help="Drives shown."
)
@click.option(
    "--verify",
    type=click.IntRange(min=0),
    default=0,
    show_default=True,
    metavar="N",
    help="Wear the sprockets of the first N drives shown too, up to twice the hours.",
)
@click.option(
    "--out",
    type=click.Path(path_type=Path, allow_dash=True),
    metavar="FILE",
    help="New case of the best drive; - is stdout.",
)
@click.option(
    "--csv",
    "csv_file",
    type=click.Path(path_type=Path, allow_dash=True),
    metavar="FILE",
    help="New table of the drives shown; - is stdout.",
)
@click.option("--force", is_flag=True, help="Replace the files.")
@click.option("--json", "as_json", is_flag=True, help="As one JSON object.")
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
    **texts: str | None,
) -> int:
    """Choose chains and teeth of the catalogue for a drive.

    A drive passes where it keeps to the ratings and its chain lives long enough by wear. The
    lightest one comes first, or the cheapest. Exit code 3 where none passes.
    """
    _check_places(out, csv_file, as_json, force)
    wish = _wish(texts, price)
    answer = _answer(wish, every_pair, count)
    from wearsim.study.select.sheet import selection_json, selection_text

    verified = _verified(answer, wish, verify)
    if as_json:
        content = selection_json(answer)
        print_json({**content, "verified": verified} if verify else content, Path("select"))
    else:
        # A file on stdout leaves stderr for the table.
        on_stdout = "-" in (str(out), str(csv_file))
        (warn if on_stdout else click.echo)(
            "\n".join([selection_text(answer), *map(_verified_text, verified)])
        )
    if not answer.shown:
        warn("select: a drive must keep to all limits, but none does: see what refuses them")
        return FAILED
    _write(answer, wish, out, csv_file, force)
    return 0


@dataclass(frozen=True)
class _Wish:
    """What was asked for."""

    need: "DriveRequirements"
    service: "ServiceConditions"
    hours_per_day: float
    use: str  # in words
    prices: "dict[str, Price] | None"


def _check_places(out: Path | None, csv_file: Path | None, as_json: bool, force: bool) -> None:
    from wearsim.files import check_free

    on_stdout = [name for name, place in (("--out", out), ("--csv", csv_file)) if str(place) == "-"]
    if as_json:
        on_stdout.append("--json")
    if len(on_stdout) > 1 and on_stdout != ["--json"]:
        raise click.UsageError(f"{' and '.join(on_stdout)} both write to stdout: give one of them a file")
    if out is not None and csv_file is not None and out.resolve() == csv_file.resolve():
        raise OutputError(f"{out}: must not be the file of --csv: choose another place")
    for place in (out, csv_file):
        if place is not None and str(place) != "-":
            check_free(place, force)


def _wish(texts: dict[str, str | None], price: Path | None) -> _Wish:
    """Return what the options ask for; name everything that is wrong with them."""
    from wearsim.catalogue.catalogues import wear_conditions
    from wearsim.chain.service_conditions import service_conditions
    from wearsim.study.select.prices import read_prices
    from wearsim.study.select.requirements import DriveRequirements, requirement_faults

    faults: list[Fault] = []
    given = _numbers(texts, faults)
    hours_per_day = given.pop("hours_per_day", 8.0)
    words = str(texts["lubrication"]), str(texts["shock"])
    service, prices = None, None
    try:
        service = service_conditions(*words, hours_per_day)
    except CaseError as error:
        faults += _by_option(error.faults)
    faults += _by_option(requirement_faults(given))
    if price is not None:
        try:
            prices = read_prices(price)
        except CaseError as error:
            faults += error.faults
    if faults or service is None:
        raise CaseError(faults)
    joints = wear_conditions()[service.wear_condition]
    need = DriveRequirements(
        **given,
        service_factor=service.service_factor,
        joint_application_factor=service.joint_application_factor,
        joint_rate=joints.joint_typical,
        joint_rate_low=joints.joint_low,
        joint_rate_high=joints.joint_high,
    )
    use = f"{words[0]}, {words[1]} load, {hours_per_day:g} h a day"
    return _Wish(need, service, hours_per_day, use, prices)


def _by_option(faults: Sequence[Fault]) -> list[Fault]:
    """Return faults of fields with the names of their options."""
    names = {field: option for option, field in _FIELDS.items()}
    names |= {"strands_min": "strands", "strands_max": "strands"}
    return [
        Fault(fault.message, "", f"--{names.get(fault.key, fault.key).replace('_', '-')}") for fault in faults
    ]


def _numbers(texts: dict[str, str | None], faults: list[Fault]) -> dict[str, Any]:
    """Return the numbers of the options by the names of their fields, those that can be read."""
    found: dict[str, Any] = {}
    for name, unit in _QUANTITIES.items():
        text = texts[name]
        option = f"--{name.replace('_', '-')}"
        if text is None:
            if name in _REQUIRED:
                faults.append(Fault("must be given: the drive is chosen for it", "", option))
            continue
        try:
            value = _number(text, unit)
        except ValueError as error:
            faults.append(Fault(f"{error} (got {text!r})", "", option))
            continue
        if name in _WHOLE and value.is_integer():
            found[name] = int(value)
        else:
            found[_FIELDS.get(name, name)] = value
    found["series"] = tuple(word.strip() for word in str(texts["series"]).split(","))
    found |= _strands(str(texts["strands"]), faults)
    return found


def _number(text: str, unit: str) -> float:
    """Return a number of an option in a unit."""
    if unit == "%":
        return 0.01 * _number(text.strip().removesuffix("%"), "")
    try:
        return float(text)
    except ValueError:
        pass
    if not unit:
        raise ValueError("must be a number: write it with a point")
    from wearsim.input.units import convert

    return convert(text, unit)


def _strands(text: str, faults: list[Fault]) -> dict[str, int]:
    low, dash, high = text.partition("-")
    try:
        return {"strands_min": int(low), "strands_max": int(high if dash else low)}
    except ValueError:
        message = f"must be a whole number or two with a dash between, such as 1-3 (got {text!r})"
        faults.append(Fault(f"{message}: correct it", "", "--strands"))
        return {}


def _answer(wish: _Wish, every_pair: bool, count: int) -> "SelectionAnswer":
    from wearsim.study.select.considered_chains import considered_chains
    from wearsim.study.select.model import judged_drives
    from wearsim.study.select.sheet import SelectionAnswer

    considered = considered_chains(wish.need, wish.prices)
    return SelectionAnswer(
        need=wish.need,
        use=wish.use,
        considered=considered,
        drives=judged_drives(wish.need, considered.chains, wish.prices),
        every_pair=every_pair,
        count=count,
        priced=wish.prices is not None,
    )


def _verified(answer: "SelectionAnswer", wish: _Wish, count: int) -> list[dict[str, Any]]:
    """Return the lives of all parts of the first drives."""
    if not count:
        return []
    from wearsim.study.select.case_file import case_tables
    from wearsim.study.select.verified_lives import part_lives

    found = []
    for drive in answer.shown[:count]:
        tables = case_tables(drive, wish.need, wish.service.wear_condition, wish.hours_per_day)
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
    answer: "SelectionAnswer", wish: _Wish, out: Path | None, csv_file: Path | None, force: bool
) -> None:
    """Write the case of the best drive and the table."""
    if out is not None:
        from wearsim.study.select.case_file import case_tables, case_text

        tables = case_tables(answer.shown[0], wish.need, wish.service.wear_condition, wish.hours_per_day)
        command = shlex.join(["wearsim", *sys.argv[1:]])
        write_content(out, case_text(tables, command).encode(), force)
    if csv_file is not None:
        from wearsim.study.select.sheet import selection_csv

        write_content(csv_file, selection_csv(answer).encode(), force)
