"""``wearsim scan``: the wear of a sprocket from a photograph of it."""

import math
from pathlib import Path
from typing import Any

import click

from wearsim.command.answered import Shown, shown_options
from wearsim.command.cases_and_runs import one_sprocket
from wearsim.command.complete import CasePath, complete_chain
from wearsim.command.options import (
    common_options,
    finite,
    given_parameters,
    keeping_runs,
    load_cases,
    overrides,
    sprocket_option,
    working,
)
from wearsim.command.single_file import format_of, write_content
from wearsim.scanning.papers import PAGE_FORMATS, PAPERS

_BESIDE_SHEET = ("sheet", "paper", "force", "quiet", "debug")

_POSITIVE = click.FloatRange(min=0.0, min_open=True)


class _FiveNumbers(click.ParamType):  # type: ignore[type-arg]  # generic in newer click only
    """Two points of a picture and a number."""

    last = ""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the five numbers."""
        try:
            numbers = tuple(float(part) for part in str(value).split(","))
        except ValueError:
            numbers = ()
        if len(numbers) != 5:
            self.fail(f"{value!r} is not five numbers x1,y1,x2,y2,{self.last}", param, ctx)
        if not all(math.isfinite(number) for number in numbers):
            self.fail(f"{value!r} must hold finite numbers", param, ctx)
        return numbers


class _ScalePoints(_FiveNumbers):
    """Two points of a picture and how far they are apart."""

    name, last = "points", "mm"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the five numbers."""
        numbers = super().convert(value, param, ctx)
        if numbers[4] <= 0.0:
            self.fail(f"the distance must be above 0 mm, is {numbers[4]:g}", param, ctx)
        return numbers


class _ChainPins(_FiveNumbers):
    """Two pins of a chain in a picture, and the number of links between them."""

    name, last = "pins", "links"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return four numbers and a whole one."""
        numbers = super().convert(value, param, ctx)
        if not (numbers[4] % 2.0 == 0.0 and 2.0 <= numbers[4] <= 200.0):
            self.fail(f"the links must be an even number from 2 to 200, are {numbers[4]:g}", param, ctx)
        return (*numbers[:4], int(numbers[4]))


@click.command(short_help="Measure the wear of a sprocket in a photograph.")
@click.argument("photo", type=click.Path(dir_okay=False, path_type=Path), metavar="[PHOTO]", required=False)
@click.option(
    "--sheet",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Without PHOTO: new file (.pdf, .svg or .png) for a marker sheet to print and lay under a sprocket. "
    "In a PHOTO it is detected automatically and gives scale, perspective and lens distortion.",
)
@click.option("--paper", type=click.Choice(tuple(PAPERS)), help="Paper of --sheet; default: a4.")
@click.option("--case", type=CasePath(path_type=Path), metavar="CASE", help="Case of the sprocket's drive.")
@click.option(
    "--chain",
    metavar="NAME",
    shell_complete=complete_chain,
    help="Chain of a standard sprocket, if there is no CASE.",
)
@click.option(
    "--teeth",
    type=click.IntRange(5, 150),
    metavar="Z",
    help="Number of teeth, with --chain; counted by default.",
)
@click.option(
    "--profile",
    type=click.Choice(("iso606", "ansi_b29", "gost591")),
    help="Tooth form, with --chain; default: that of its series.",
)
@click.option(
    "--bore-mm",
    type=_POSITIVE,
    metavar="MM",
    callback=finite,
    help="Scale: diameter of the bore, if it shows as a hole. Default: the scale of the tooth form.",
)
@click.option(
    "--scale",
    type=_ScalePoints(),
    metavar="X1,Y1,X2,Y2,MM",
    help="Scale: two points of the picture, in pixels, and their distance in mm.",
)
@click.option(
    "--dpi", type=_POSITIVE, metavar="DPI", callback=finite, help="Scale: dots per inch of a flatbed scan."
)
@click.option(
    "--ruler-mm",
    type=click.FloatRange(50.0, 200.0),
    metavar="MM",
    help="Length of the ruler on the printed marker sheet; default: 100.",
)
@click.option(
    "--thickness-mm",
    type=_POSITIVE,
    metavar="MM",
    callback=finite,
    help="Thickness of the teeth that lie on the marker sheet; default: the tooth width of the chain.",
)
@click.option(
    "--chain-beside",
    type=_ChainPins(),
    metavar="X1,Y1,X2,Y2,LINKS",
    help="Also measure the elongation of a chain that lies on its side beside a sprocket on a marker sheet: "
    "two of its pins, in pixels, and the even number of links between them. Needs --chain-width-mm.",
)
@click.option(
    "--chain-width-mm",
    type=_POSITIVE,
    metavar="MM",
    callback=finite,
    help="Width of the chain of --chain-beside over the ends of a pin.",
)
@click.option(
    "--hours",
    type=_POSITIVE,
    metavar="H",
    callback=finite,
    help="Running hours of the sprocket since it was new; with --case, the remaining hours follow.",
)
@shown_options("the overlay, tables, points and a reading")
@sprocket_option
@keeping_runs
@overrides
@common_options
def scan(
    photo: Path | None,
    sheet: Path | None,
    paper: str | None,
    case: Path | None,
    chain: str | None,
    teeth: int | None,
    profile: str | None,
    bore_mm: float | None,
    scale: tuple[float, float, float, float, float] | None,
    dpi: float | None,
    ruler_mm: float | None,
    thickness_mm: float | None,
    chain_beside: tuple[float, float, float, float, int] | None,
    chain_width_mm: float | None,
    hours: float | None,
    sprocket: str | None,
    shown: Shown,
    settings: tuple[str, ...],
) -> None:
    """Measure the wear of the sprocket in PHOTO (PNG, JPEG or TIFF), tooth by tooth.

    --sheet FILE, without PHOTO, writes a marker sheet to lay under the wheel.

    Photograph the bare wheel along its axis, from far away, dark on a bright background or the
    reverse, with all teeth in the picture. Its new form comes from --case, or from --chain for a standard
    sprocket. The picture does not leave this computer.
    """
    if sheet is not None:
        if photo is not None:
            raise click.UsageError("--sheet writes a sheet to print: give it without PHOTO")
        _check_beside_sheet(click.get_current_context())
        _write_sheet(sheet, paper or next(iter(PAPERS)), shown.force)
        return
    if photo is None:
        raise click.UsageError("give a PHOTO to measure, or --sheet FILE for a marker sheet to print")
    if paper is not None:
        raise click.UsageError("--paper belongs to --sheet")
    if (case is None) == (chain is None):
        raise click.UsageError("give the new form of the sprocket: --case CASE or --chain NAME")
    if case is None and (settings or sprocket):
        raise click.UsageError("--set and --sprocket belong to --case")
    if case is not None and (teeth or profile):
        raise click.UsageError("--teeth and --profile belong to --chain: a CASE has its own")
    if sum(one is not None for one in (bore_mm, scale, dpi)) > 1:
        raise click.UsageError("give at most one of --bore-mm, --scale and --dpi")
    if (chain_beside is None) != (chain_width_mm is None):
        raise click.UsageError("give --chain-beside and --chain-width-mm together")
    loaded = None
    if case is not None:
        loaded = one_sprocket(load_cases([case], settings, shown.as_json)[0], case, sprocket)
    shown.check(photo)
    from wearsim.scanning import answer

    with shown.failing(photo.stem), working(f"measuring {photo.name}") as progress:
        found = answer.scan(
            photo,
            loaded,
            chain=chain,
            teeth=teeth,
            profile=profile,
            bore=bore_mm,
            scale=scale,
            dpi=dpi,
            ruler=ruler_mm,
            thickness=thickness_mm,
            chain_beside=chain_beside,
            chain_width=chain_width_mm,
            hours=hours,
            progress=progress,
        )
    shown.save(found, photo)


def _check_beside_sheet(context: click.Context) -> None:
    """Raise for an option that does not say how a sheet is written."""
    for option in given_parameters(context):
        if option.name not in _BESIDE_SHEET:
            raise click.UsageError(f"{option.opts[0]} belongs to a PHOTO: leave it out with --sheet")


def _write_sheet(place: Path, paper: str, force: bool) -> None:
    """Write the marker sheet."""
    from wearsim.files import check_file

    check_file(place, force)
    form = format_of(place, None, PAGE_FORMATS, ".pdf")
    from wearsim.scanning.marker_page import marker_page

    write_content(place, marker_page(paper, form), force)
