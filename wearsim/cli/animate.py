"""``wearsim animate``: the flank as it wears, as a moving picture."""

from pathlib import Path

import click

from wearsim.command.cases_and_runs import loaded_sources, one_sprocket
from wearsim.command.complete import RunPath
from wearsim.command.options import common_options, finite, overrides, sprocket_option, working, worn
from wearsim.command.single_file import check_place, format_of, write_content
from wearsim.errors import OutputError

_FORMATS = ("gif", "webp", "png")

_SHORTEST_S = 0.02
"""Time that a frame stays at least: readers of GIF show shorter ones longer."""


@click.command(short_help="The flank as it wears, as a moving picture.")
@click.argument("source", type=RunPath(path_type=Path), metavar="CASE_OR_RUN")
@click.option(
    "--out",
    required=True,
    type=click.Path(path_type=Path, allow_dash=True),
    help="New file: .gif, .webp or .png (animated); - is stdout.",
)
@click.option("--format", "form", type=click.Choice(_FORMATS), help="Of --out; else its ending tells.")
@click.option(
    "--frames",
    type=click.IntRange(2, 300),
    default=60,
    show_default=True,
    help="Pictures, at equal steps of running time.",
)
@click.option(
    "--seconds",
    type=click.FloatRange(0.1, 120.0),
    default=5.0,
    show_default=True,
    callback=finite,
    help="What they take; the last one stays 2 s longer.",
)
@click.option(
    "--width",
    type=click.IntRange(320, 1920),
    default=960,
    show_default=True,
    metavar="PX",
    help="Of the picture; its letters grow with it.",
)
@click.option("--force", is_flag=True, help="Replace the file.")
@sprocket_option
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
    """Show how the flank of a run (folder of life --out) or of a case (.toml, run now) wears.

    The new flank is dashed, the depth of the worn one enlarged by the factor in the legend; beside
    it the greatest depth against hours, on a wrap the elongation of the chain too. Gears show both
    flanks.
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
    result = loaded if isinstance(loaded, WearResult) else worn(one_sprocket(loaded, source, sprocket))

    with working(f"drawing {frames} frames"):
        content = animation(result, kind, frames, seconds, width)
    write_content(out, content, force)
