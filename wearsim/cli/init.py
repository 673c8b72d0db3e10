"""``wearsim init``: a commented case to start from."""

import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from wearsim.command.complete import complete_chain
from wearsim.command.options import common_options
from wearsim.drive.known_drive import KNOWN, Known, Values, read_known
from wearsim.errors import CaseError, Fault
from wearsim.quantities import either

if TYPE_CHECKING:
    from wearsim.case.model import Case


def drive_options(function: Callable[..., Any]) -> Callable[..., Any]:
    """Add an option for everything that may be known of a drive."""
    for known in reversed(KNOWN):
        add = click.option(
            known.option,
            metavar=known.metavar,
            help=known.help,
            shell_complete=complete_chain if known.option == "--chain" else _completing(known.words),
        )
        function = add(function)
    return function


def _completing(words: tuple[str, ...]) -> Callable[..., list[str]]:
    return lambda context, parameter, incomplete: [word for word in words if word.startswith(incomplete)]


def ask_for_drive() -> str:
    """Ask for everything one by one, and again for what does not fit; return the text of the drive."""
    from wearsim.drive.drive_start import start_text

    typed: dict[str, str | None] = {}
    questions = [known for known in KNOWN if known.asked]
    while True:
        for known in questions:
            typed[known.name] = _answer(known, read_known(typed)[0])
        try:
            return start_text(typed)
        except CaseError as error:
            wrong = {fault.file for fault in error.faults}
            questions = [known for known in KNOWN if known.asked and known.option in wrong]
            if not questions:
                raise
            click.echo(str(error), err=True)


def _answer(known: Known, values: Values) -> str:
    def _checked(text: str) -> str:
        try:
            known.read(text)
        except ValueError as error:
            raise click.UsageError(str(error)) from None
        return text

    default = known.default(values)
    return str(click.prompt(known.what, default=default, value_proc=_checked, show_default=bool(default)))


_SAFETY = {"strand": 10.0, "wrap": 20.0}
"""Breaking load over the pull of a starting case."""


@click.command(short_help="Write a commented case to start from.")
@drive_options
@click.option("--teeth", type=int, help="Number of teeth of a single sprocket.  [default: 20]")
@click.option(
    "--kind",
    type=click.Choice(["drive", "strand", "wrap"]),
    help="Kind of case: a whole drive, or a single sprocket with a guided strand or a wrapped chain.  "
    "[default: drive; strand with --teeth]",
)
@click.option(
    "--out",
    type=click.Path(path_type=Path, allow_dash=True),
    default="-",
    show_default=True,
    help="New file; - for stdout.",
)
@click.option("--force", is_flag=True, help="Replace an existing file.")
@common_options
def init(teeth: int | None, kind: str | None, out: Path, force: bool, **typed: str | None) -> None:
    """Write a working case from what is known of a drive, with every line explained.

    Power, speed, distance and hours may have a unit: --power "4 hp". On a terminal, without any of
    these options, it asks for them one by one. --teeth and --kind write a case of one sprocket.
    """
    from wearsim.files import check_free, write_file

    if str(out) != "-":
        check_free(out, force)
    text = _text(typed, teeth, kind or ("drive" if teeth is None else "strand"))
    if str(out) == "-":
        click.echo(text, nl=False)
    else:
        write_file(out, text, force)


def at_terminal() -> bool:
    """Tell whether someone is there to be asked."""
    return sys.stdin.isatty() and sys.stdout.isatty()


def _text(typed: Mapping[str, str | None], teeth: int | None, kind: str) -> str:
    if kind == "drive":
        if teeth is not None:
            raise CaseError(
                [
                    Fault(
                        "belongs to one sprocket, not to --kind drive: give --driver and --driven",
                        "",
                        "--teeth",
                    )
                ]
            )
        if at_terminal() and all(value is None for value in typed.values()):
            return ask_for_drive()
        from wearsim.drive.drive_start import start_text

        return start_text(typed)
    given = [known for known in KNOWN if typed[known.name] is not None and known.option != "--chain"]
    if given:
        message = (
            f"belongs to a whole drive, not to --kind {kind}: remove it, or give --driver and --driven in "
            "place of --teeth"
        )
        raise CaseError([Fault(message, "", known.option) for known in given])
    return new_case(typed["chain"] or "16B-1", 20 if teeth is None else teeth, kind)


def new_case(chain: str, teeth: int, kind: str) -> str:
    """Return the text of a working case."""
    case = _seed(chain, teeth, kind)
    # A chain speed of 1 m/s, and a pull that keeps a wrap within its ratings.
    pitch, tensile = _size(case)
    speed = float(f"{60_000.0 / (pitch * teeth):.2g}")
    power = float(f"{tensile / _SAFETY[kind] * pitch * teeth * speed / 6e7:.2g}")
    template = Path(__file__).with_name("templates") / f"{kind}.toml"
    return template.read_text(encoding="utf-8").format(teeth=teeth, power=power, speed=speed, **_values(case))


def _seed(chain: str, teeth: int, kind: str) -> "Case":
    """A case that takes every default."""
    from wearsim.catalogue.catalogues import chains
    from wearsim.catalogue.chain_names import chain_name
    from wearsim.chain.standard_teeth import standard_form
    from wearsim.drive.load_case import load_single

    known = chains().get(chain_name(chain) or "")
    form = standard_form(known) if kind == "wrap" and known else "evolute"
    seed = {
        "format_version": 1,
        "chain": {"designation": chain},
        "sprocket": {"teeth": teeth, "profile": form},
        "mechanism": {"kind": kind},
        "load": {"tension_N": 1000.0 if kind == "wrap" else 1.0, "speed_rpm": 1.0},
        "wear": {"condition": "hardened, oiled"},
    }
    try:
        return load_single(seed)
    except CaseError as error:
        options = {"chain": "--chain"}
        raise CaseError(
            [
                Fault(fault.message, "", options.get(fault.key.partition(".")[0], "--teeth"))
                for fault in error.faults
            ]
        ) from None


def _size(case: "Case") -> tuple[float, float]:
    """Pitch [mm] and breaking load [N] of the chain."""
    from wearsim.catalogue.catalogues import chains

    chain = chains()[case.inputs["chain"]["designation"]]
    return chain.pitch, chain.tensile


def _values(case: "Case") -> dict[str, Any]:
    """What the template shows of the defaults."""
    from wearsim.geometry.forms import TOOTH_FORMS

    sprocket, stop = case.inputs["sprocket"], case.inputs["stop"]
    shown = {
        "chain": case.inputs["chain"]["designation"],
        "width": sprocket["face_width_mm"],
        "depth": stop["critical_depth_mm"],
    }
    if case.inputs["mechanism"]["kind"] == "strand":
        return shown | {
            "start": sprocket["contact_start_mm"],
            "end": sprocket["contact_end_mm"],
            "offset": sprocket["evolute_offset_mm"],
        }
    drive = case.inputs["drive"]
    # Standard forms first: they are what most sprockets have.
    forms = sorted(TOOTH_FORMS, key=lambda name: not TOOTH_FORMS[name].standard_gap)
    return shown | {
        "profile": sprocket["profile"],
        "forms": either(forms),
        "mate": drive["mate_teeth"],
        "links": drive["links"],
        "stiffness": drive["link_stiffness_N_per_mm"],
        "elongation": stop["elongation_percent"],
    }
