"""``wearsim export``: the wheel for CAD, and a gauge that tells when it is worn out."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from wearsim.cad import DRAWINGS, STATES, WHEELS, format_by_ending
from wearsim.command.cases_and_runs import is_drive, loaded_sources, one_sprocket
from wearsim.command.complete import RunPath
from wearsim.command.options import (
    common_options,
    keeping_runs,
    overrides,
    sprocket_option,
    warn,
    working,
    worn,
)
from wearsim.command.single_file import check_place, format_of, write_content
from wearsim.errors import OutputError
from wearsim.quantities import either

if TYPE_CHECKING:
    from wearsim.case.model import Case
    from wearsim.drive.drive_case import DriveCase
    from wearsim.drive.drive_result import DriveLife
    from wearsim.geometry.wheel_outline import State
    from wearsim.result import WearResult

_FORMATS = tuple(WHEELS)
_GAUGES = tuple(DRAWINGS)


@click.command(short_help="Export sprockets, gears or wear-limit gauges for CAD.")
@click.argument("source", type=RunPath(path_type=Path), metavar="CASE_OR_RUN")
@click.option(
    "--out",
    type=click.Path(path_type=Path, allow_dash=True),
    help="New file for the wheel, - for stdout; for a whole drive, a new folder with a file per wheel.",
)
@click.option(
    "--format", "form", type=click.Choice(_FORMATS), help="File format; default: from the extension of --out."
)
@click.option(
    "--state",
    type=click.Choice(tuple(STATES)),
    help="State of the wheel; default: new for a case, both for a run.",
)
@click.option(
    "--template",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help=f"New file ({either(f'.{name}' for name in _GAUGES)}) for a go/no-go gauge of the wear limit, "
    "to print at 1:1.",
)
@click.option("--force", is_flag=True, help="Replace existing files.")
@sprocket_option
@keeping_runs
@overrides
@common_options
def export(
    source: Path,
    out: Path | None,
    form: str | None,
    state: str | None,
    template: Path | None,
    force: bool,
    sprocket: str | None,
    settings: tuple[str, ...],
) -> None:
    """Write the wheel of a case (.toml) or of a run (folder of life --out) for CAD.

    DXF and SVG have the outlines on separate layers, circles and a note; CSV has the points; STEP has
    a solid (pip install 'wearsim[step]'), STL its surface. Bore, keyway and hub come from [sprocket].
    To draw the worn wheel of a case, wearsim first wears it to its limit. For a whole drive without
    --sprocket, all wheels are written to a folder, as DXF by default.
    --template draws a gauge of the gap at the wear limit, with a bar to check the print scale.
    """
    if out is None and template is None:
        raise click.UsageError("give --out FILE, --template FILE or both")
    (loaded,) = loaded_sources((source,), settings, False).values()
    if out is not None and sprocket is None and is_drive(loaded) and _is_folder(out):
        if template is not None:
            raise click.UsageError("--template is the gauge of one sprocket: give --sprocket NAME")
        _export_all(loaded, out, form or _FORMATS[0], state, force)
        return
    places = [path for path in (out, template) if path is not None and str(path) != "-"]
    _check_places(places, source, force)
    kind = None if out is None else format_of(out, form, _FORMATS, "--format")
    gauge = None if template is None else format_of(template, None, _GAUGES, ".pdf")
    _check_library(kind)
    case, result = _wheel(loaded, source, sprocket)
    shown = state or ("new" if result is None else "both")
    states = STATES[shown]
    _check_states(kind, states)
    from wearsim.cad.wheel_formats import check_solid
    from wearsim.cad.wheel_formats import export as content

    check_solid(case, kind)
    if result is None and ("worn" in states or template is not None):
        result = worn(case)
    written: list[tuple[Path, bytes]] = []
    if out is not None and kind is not None:
        written.append((out, content(case, result, states, kind)))
    if template is not None and gauge is not None and result is not None:
        from wearsim.cad.gauge_sheet import gauge_sheet

        written.append((template, gauge_sheet(case, _worn_out(case, result), gauge)))
    for path, data in written:
        write_content(path, data, force)


def _is_folder(out: Path) -> bool:
    """Tell whether a place is a folder for all wheels of a drive, and no file by its ending."""
    return str(out) != "-" and format_by_ending(out) not in WHEELS


def _export_all(
    source: "Case | DriveCase | WearResult | DriveLife", out: Path, form: str, state: str | None, force: bool
) -> None:
    """Write the wheels of all sprockets of a drive into a folder, each cog of a cassette for itself."""
    from wearsim.cad.wheel_formats import export as content
    from wearsim.drive.drive_case import DriveCase
    from wearsim.drive.drive_result import DriveLife
    from wearsim.drive.life import drive_life
    from wearsim.files import check_folder, file_names, new_folder

    run = source.complete() if isinstance(source, DriveLife) else None
    drive = source.drive if isinstance(source, DriveLife) else source
    assert isinstance(drive, DriveCase)
    states = STATES[state or ("both" if run else "new")]
    _check_library(form)
    _check_states(form, states)
    check_folder(out, force)
    if run is None and "worn" in states:
        with working(f"wearing {drive.title}") as report_progress:
            run = drive_life(drive, report_progress).complete()
    cases, results = drive.titled_cases(), run.results if run else {}
    with new_folder(out, force) as place:
        for file, (name, case) in zip(file_names(list(cases)), cases.items(), strict=True):
            (place / f"{file}.{form}").write_bytes(content(case, results.get(name), states, form))
    warn(f"written to {out}: {len(cases)} wheels")


def _check_library(kind: str | None) -> None:
    if kind and WHEELS[kind].library:
        from wearsim.extras import check_installed

        check_installed((WHEELS[kind].library,), kind, f"--format {kind}")


def _check_states(kind: str | None, states: "tuple[State, ...]") -> None:
    one = WHEELS[kind].one_state if kind else ""
    if one and len(states) > 1:
        raise click.UsageError(f"{one} holds one state of the wheel: give --state new or --state worn")


def _worn_out(case: "Case", result: "WearResult") -> "WearResult":
    """Return a run to the limit of the teeth, a longer one where that was not reached."""
    from wearsim.cad.gauge_sheet import is_worn_out, long_enough

    return result if is_worn_out(result) else worn(long_enough(case))


def _check_places(places: list[Path], source: Path, force: bool) -> None:
    for place in places:
        check_place(place, source, force)
    if len({place.resolve() for place in places}) < len(places):
        raise OutputError(f"{places[0]}: must not be both --out and --template: choose two places")


def _wheel(
    loaded: "Case | DriveCase | WearResult | DriveLife", source: Path, sprocket: str | None
) -> "tuple[Case, WearResult | None]":
    """Return the case of a wheel, and its run where the folder of one is given."""
    from wearsim.result import WearResult

    one = one_sprocket(loaded, source, sprocket, ", or --out FOLDER alone for all wheels")
    if not isinstance(one, WearResult):
        return one, None
    from dataclasses import replace

    from wearsim.report.flank_view import case_of

    return replace(case_of(one), name=one.case, title=one.title), one
