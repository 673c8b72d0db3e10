"""The sheet of a whole drive as one page of HTML that fetches nothing and prints on A4."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from markupsafe import Markup

from wearsim._version import __version__
from wearsim.drive.drive_result import DriveLife
from wearsim.drive.maintenance import DrivePlan, drive_plan, planned_events
from wearsim.files import check_file, check_folder, new_folder, write_file
from wearsim.geometry.scene import Circle, Scene
from wearsim.quantities import grouped
from wearsim.report import html
from wearsim.report.answer import overload_text
from wearsim.report.answer_table import AnswerTable
from wearsim.report.drive.drive_drawings import flank_place, layout_sketch, lives_bars
from wearsim.report.drive.drive_words import (
    against_hours,
    first_text,
    jumping_text,
    outside_practice,
    taken_for_granted,
    within_text,
)
from wearsim.report.drive.page_tables import (
    chain_rows,
    geometry_table,
    life_table,
    loss_text,
    lubrication_rows,
    plan_table,
    shaft_table,
    span_table,
)
from wearsim.report.html.environment import environment
from wearsim.report.html.page_content import HtmlTable, chain_tables
from wearsim.report.html.paper import SheetHead, foot
from wearsim.report.html.pdf import check_pdf, is_page, is_pdf, save_pdf
from wearsim.report.html.sketch import sketch
from wearsim.report.rating import sheet_ratings
from wearsim.report.text_lines import unbroken
from wearsim.report.verification import given_rows, verification_rows
from wearsim.report.worn_flank import WornFlank, around_flank, worn_flanks
from wearsim.result import WearResult
from wearsim.result.ends import first_hours

_TEMPLATES = Path(__file__).parent / "templates"
_STYLE = Path(html.__file__).with_name("style.css")

_AROUND = 0.12
"""Room around a flank, as a fraction of its extent."""


@dataclass(frozen=True)
class FlankPicture:
    """The flank of one sprocket, new and worn."""

    place: str  # of its element on the page
    name: str
    drawing: Markup


@dataclass(frozen=True)
class SheetPage:
    """What stands on the sheet of a drive."""

    title: str
    head: list[tuple[str, str]]
    foot: Markup  # style of the foot of its printed pages
    given: list[tuple[str, str]]
    verification: list[tuple[str, str]]
    life: str  # of what is replaced first
    first: str
    overloaded: str  # empty where it is not
    within: str
    jumping: str
    layout: Markup
    ratings: AnswerTable[Any]
    rating_notes: list[str]
    chain: list[tuple[str, str]]
    geometry: AnswerTable[Any]
    shafts: AnswerTable[Any]
    spans: AnswerTable[Any]
    losses: str
    lubrication: list[tuple[str, str]]
    lives: AnswerTable[Any]
    bars: Markup
    chain_tables: list[HtmlTable]
    against: str  # which ratings may end the chain before its hours; empty where it is within them
    plan: AnswerTable[Any]
    plan_until: str
    plan_rule: str
    plan_goes_on: bool
    flanks: list[FlankPicture]
    warnings: tuple[str, ...]
    assumptions: tuple[str, ...]
    defaults: tuple[str, ...]


def save_sheet(found: DriveLife, head: SheetHead, out: Path, force: bool) -> Path:
    """Write the page into a file *.html or *.pdf, else as index.html of a folder; return its path."""
    text = sheet_html(found, head)
    if is_pdf(out):
        save_pdf(text, out, force)
        return out
    if is_page(out):
        write_file(out, text, force)
        return out
    with new_folder(out, force) as place:
        (place / "index.html").write_text(text, encoding="utf-8", newline="\n")
    return out / "index.html"


def check_sheet(out: Path, force: bool) -> None:
    """Raise where a sheet cannot be written or replaced."""
    if is_pdf(out):
        check_pdf(out, force)
    elif is_page(out):
        check_file(out, force)
    else:
        check_folder(out, force)


def sheet_html(found: DriveLife, head: SheetHead) -> str:
    """Return the page."""
    style = _STYLE.read_text("utf-8") + (_TEMPLATES / "drive_sheet.css").read_text("utf-8")
    return (
        environment(_TEMPLATES)
        .get_template("drive_sheet.html.j2")
        .render(
            page=_page(found, head),
            version=__version__,
            style=Markup(style),  # noqa: S704
        )
    )


def _page(found: DriveLife, head: SheetHead) -> SheetPage:
    drive = found.drive
    driver, places = found.reference, [one.name for one in drive.sprockets]
    ratings, notes = sheet_ratings(driver.ratings)
    plan = drive_plan(found)
    assumptions, defaults = taken_for_granted(found)
    return SheetPage(
        title=drive.title,
        head=head.rows,
        foot=foot(drive.title, head),
        given=given_rows(drive.inputs, drive.driver.case),
        verification=verification_rows(drive.driver.case, driver.ratings),
        life=f"{outside_practice(found)}{first_hours(found.ends, found.life)}",
        first=unbroken(first_text(plan)),
        overloaded=overload_text(driver),
        within=within_text(driver),
        jumping=jumping_text(found),
        layout=layout_sketch(drive),
        ratings=ratings,
        rating_notes=notes,
        chain=chain_rows(drive),
        geometry=geometry_table(drive),
        shafts=shaft_table(drive),
        spans=span_table(drive),
        losses=loss_text(drive),
        lubrication=lubrication_rows(found),
        lives=life_table(found),
        bars=lives_bars(plan),
        chain_tables=chain_tables(found.ends, found.practice, planned_events(plan)),
        against=against_hours(found),
        plan=plan_table(plan),
        plan_until=_plan_until(plan),
        plan_rule=plan.best.name,
        plan_goes_on=plan.goes_on,
        flanks=[
            FlankPicture(flank_place(places.index(name) + 1), name, sketch(scene))
            for name, scene in gap_scenes(found.results).items()
        ],
        warnings=found.warnings,
        assumptions=assumptions,
        defaults=defaults,
    )


def _plan_until(plan: DrivePlan) -> str:
    what, end = min(plan.ends.items(), key=lambda item: item[1])
    return f"{grouped(end)} h, {what}"


def gap_scenes(results: Mapping[str, WearResult]) -> dict[str, Scene]:
    """Return the flanks of the sprockets, new and at the end of their own lives, enlarged alike."""
    flanks = {name: worn_flanks(result)[0] for name, result in results.items()}
    factor = min((flank.factor for flank in flanks.values()), default=1)
    return {name: _flank(results[name], flank, factor) for name, flank in flanks.items()}


def _flank(result: WearResult, flank: WornFlank, factor: int) -> Scene:
    depth = flank.depth[-1]
    between, new, worn, deepest = flank.strokes(flank.x[-1], flank.y[-1], depth, factor)
    room = _AROUND * flank.extent
    low, high = new.vertices.min(axis=0) - room, new.vertices.max(axis=0) + room
    box = float(low[0]), float(low[1]), float(high[0] - low[0]), float(high[1] - low[1])
    spots = [Circle("spot", (float(x), float(y)), 0.15 * room) for x, y in deepest.vertices]
    depth_text = f"{float(depth.max()):.3g} mm deep at most"
    return Scene(
        box,
        (*around_flank(result, flank), between, new, worn, *spots),
        f"A gap of the sprocket new and worn, {depth_text}, drawn {factor} times as deep.",
        (unbroken(f"{depth_text} after {grouped(result.hours_run)} h"), f"drawn {factor} times as deep"),
    )
