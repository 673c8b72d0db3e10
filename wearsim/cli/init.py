"""``wearsim init``: a commented case to start from."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from wearsim.command.complete import complete_chain
from wearsim.command.options import common_options
from wearsim.errors import CaseError, Fault

if TYPE_CHECKING:
    from wearsim.case.model import Case

_FORMS = {"ISO606-A/ANSI B29.1": "ansi_b29", "ISO606-H": "ansi_b29", "GOST13568": "gost591"}
"""Tooth form that goes with the series of a chain; ISO 606 with the others."""

_SAFETY = {"strand": 10.0, "wrap": 20.0}
"""Breaking load over the pull of a starting case."""


@click.command(short_help="A commented case to start from.")
@click.option(
    "--chain", default="16B-1", show_default=True, metavar="DESIGNATION", shell_complete=complete_chain
)
@click.option("--teeth", type=int, default=20, show_default=True)
@click.option(
    "--kind",
    type=click.Choice(["strand", "wrap"]),
    default="strand",
    show_default=True,
    help="A guided strand past the sprocket, or a chain around it.",
)
@click.option(
    "--out",
    type=click.Path(path_type=Path, allow_dash=True),
    default="-",
    show_default=True,
    help="New file; - is stdout.",
)
@click.option("--force", is_flag=True, help="Replace the file.")
@common_options
def init(chain: str, teeth: int, kind: str, out: Path, force: bool) -> None:
    """Write a working case for a chain and a number of teeth, every key explained."""
    from wearsim.files import check_free, write_file

    if str(out) != "-":
        check_free(out, force)
    text = new_case(chain, teeth, kind)
    if str(out) == "-":
        click.echo(text, nl=False)
    else:
        write_file(out, text, force)


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
    from wearsim.case.load_case import load_case
    from wearsim.catalogue.catalogues import chain_name, chains

    known = chains().get(chain_name(chain) or "")
    form = _FORMS.get(known.series if known else "", "iso606") if kind == "wrap" else "evolute"
    seed = {
        "format_version": 1,
        "chain": {"designation": chain},
        "sprocket": {"teeth": teeth, "profile": form},
        "mechanism": {"kind": kind},
        "load": {"tension_N": 1000.0 if kind == "wrap" else 1.0, "speed_rpm": 1.0},
        "wear": {"condition": "hardened, oiled"},
    }
    try:
        return load_case(seed)
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
    return shown | {
        "profile": sprocket["profile"],
        "mate": drive["mate_teeth"],
        "links": drive["links"],
        "stiffness": drive["link_stiffness_N_per_mm"],
        "elongation": stop["elongation_percent"],
    }
