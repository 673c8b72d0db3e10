"""``wearsim animate``: the flank as it wears, as a moving picture."""

from pathlib import Path

import click

from wearsim.command.cases_and_runs import loaded_sources, one_sprocket
from wearsim.command.complete import RunPath
from wearsim.command.options import (
    common_options,
    finite,
    keeping_runs,
    overrides,
    sprocket_option,
    working,
    worn,
)
from wearsim.command.single_file import check_place, format_of, write_content
from wearsim.errors import OutputError

_FORMATS = ("gif", "webp", "png")

_SHORTEST_S = 0.02
"""Time that a frame stays at least: readers of GIF show shorter ones longer."""


@click.command(short_help="Animate the flank as it wears.")
@click.argument("source", type=RunPath(path_type=Path), metavar="CASE_OR_RUN")
@click.option(
    "--out",
    required=True,
    type=click.Path(path_type=Path, allow_dash=True),
    help="New file: .gif, .webp or .png (animated); - for stdout.",
)
@click.option(
    "--format", "form", type=click.Choice(_FORMATS), help="File format; default: from the extension of --out."
)
@click.option(
    "--frames",
    type=click.IntRange(2, 300),
    default=60,
    show_default=True,
    help="Number of frames, equally spaced in running time.",
)
@click.option(
    "--seconds",
    type=click.FloatRange(0.1, 120.0),
    default=5.0,
    show_default=True,
    callback=finite,
    help="Duration in seconds; the last frame stays 2 s longer.",
)
@click.option(
    "--width",
    type=click.IntRange(320, 1920),
    default=960,
    show_default=True,
    metavar="PX",
    help="Width in pixels; text scales with it.",
)
@click.option("--force", is_flag=True, help="Replace an existing file.")
@sprocket_option
@keeping_runs
@overrides
@common_options
def animate(
    source: Path,
    out: Path,
    form: str | None,
    frames: int,
    seconds: float,
    width: int,
    force: bool,
    sprocket: str | None,
    settings: tuple[str, ...],
) -> None:
    """Animate the wear of the flank of a case (.toml, run now) or a run (folder of life --out).

    The new flank is dashed; the wear depth is enlarged by the factor in the legend. Beside it: the
    greatest depth over running time, on a wrap also the elongation of the chain. Gears show both flanks.
    """
    check_place(out, source, force)
    kind = format_of(out, form, _FORMATS, "--format")
    if seconds < _SHORTEST_S * frames:
        raise OutputError(
            f"--seconds: must leave every frame {_SHORTEST_S:g} s at least, {frames} frames "
            f"{_SHORTEST_S * frames:g} s (got {seconds:g}): give more seconds or fewer --frames"
        )
    from wearsim.report.animation import animation
    from wearsim.result import WearResult

    (loaded,) = loaded_sources((source,), settings, False).values()
    one = one_sprocket(loaded, source, sprocket)
    result = one if isinstance(one, WearResult) else worn(one)

    with working(f"drawing {frames} frames"):
        content = animation(result, kind, frames, seconds, width)
    write_content(out, content, force)
