"""What the page shows of an input, step by step: is it sound, about how long, how long, how it looks."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import date
from typing import Any

from markupsafe import Markup

from wearsim.case.model import Case
from wearsim.chain.rating_findings import RatingFinding
from wearsim.drive.drive_case import DriveCase
from wearsim.drive.drive_result import DriveLife
from wearsim.drive.life import drive_life
from wearsim.drive.load_case import load_case, load_drive, load_single
from wearsim.drive.maintenance import drive_plan
from wearsim.drive.part_life import simulate
from wearsim.errors import CaseError, Fault, WearsimError
from wearsim.files import file_names
from wearsim.input.document import CaseText
from wearsim.page.case_file import CaseFile
from wearsim.page.edited_input import EditedInput, edited_title
from wearsim.report.answer import OVERLOADED, chain_findings, ending, headline, overload_text, page_findings
from wearsim.report.drive.drive_drawings import flank_place, layout_sketch, lives_bars
from wearsim.report.drive.drive_words import (
    band_text,
    drive_headline,
    first_text,
    part_findings,
    ratings_text,
    taken_for_granted,
    worn_most_text,
)
from wearsim.report.drive.page_tables import wheel_of
from wearsim.report.drive.report_page import sheet_html
from wearsim.report.html.charts import Chart
from wearsim.report.html.margins import Margin, margins
from wearsim.report.html.page_content import case_page
from wearsim.report.html.page_writer import render
from wearsim.report.html.paper import SheetHead
from wearsim.report.html.run_charts import along_chart, history_chart, tooth_load_chart
from wearsim.report.html.sketch import sketch
from wearsim.report.html.tooth_chart import tooth_charts, worn_out_chart
from wearsim.report.text_lines import stated_and_defaults, unbroken
from wearsim.result import Life, LowerBound, WearResult
from wearsim.result.ends import first_hours
from wearsim.result.lives import hours

_ROUGH_NODES, _ROUGH_PHASES, _ROUGH_DRIVE_PHASES = 101, 4, 2
"""Most of what a first estimate takes."""

_ROUGH_TOLERANCE = 0.1
"""Of the life of a first estimate."""

Rows = Sequence[tuple[str, str]]


@dataclass(frozen=True, eq=False)
class Words:
    """What an answer says."""

    title: str
    hours: str  # until something ends first
    lines: Sequence[str]  # what ends then
    alarm: str  # by how much the drive is overloaded, empty where it is not
    band: Rows  # the life at both ends of the band, and as given
    note: str  # where the band comes from
    rows: Rows  # what else belongs to the lives
    warnings: Sequence[str]
    ratings: Sequence[RatingFinding]
    findings: Mapping[str, Rows]  # under their headings
    stated: Sequence[str]  # assumptions of the input
    defaults: Sequence[str]


@dataclass(frozen=True, eq=False)
class FirstLooks:
    """What is known before a life that takes long."""

    layout: Markup | None = None  # where the chain runs and how hard it pulls
    loads: Chart | None = None  # what the teeth carry


@dataclass(frozen=True, eq=False)
class Pictures:
    """What an answer looks like."""

    flanks: Mapping[str, Sequence[Chart]]  # of every sprocket before and after
    drawing: Markup | None = None  # the drive to scale, where it was not known before
    places: Mapping[str, str] = field(default_factory=dict)  # names of sprockets by links of the drawing
    bars: Markup | None = None  # lives of all parts over time
    margins: Sequence[Margin] = ()  # how near every limit is
    charts: Sequence[Chart] = ()  # depth, pressure and sliding along the flank, and wear over time


@dataclass(frozen=True, eq=False)
class Answered:
    """What can be saved of an answer."""

    runs: Mapping[str, tuple[Case, WearResult]]  # case and result of every sprocket
    sheet: Callable[[], str]  # makes the page of ``wearsim report``


def error_faults(error: Exception) -> tuple[Fault, ...]:
    """Return what is wrong, each as the command line prints it."""
    if not isinstance(error, WearsimError):
        return (Fault(f"this is a bug in wearsim: {type(error).__name__}: {error}"),)
    return error.faults if isinstance(error, CaseError) else (Fault(str(error)),)


def edited_case(source: CaseText, file: CaseFile) -> Case | DriveCase:
    """Return the case of an input whose title tells what is not yet in its file."""
    case = load_case(source)
    return replace(case, title=edited_title(source, file) or case.title)


def answer_to(edited: EditedInput) -> "SprocketAnswer | DriveAnswer":
    """Return what answers an input."""
    case = edited_case(edited.source, edited.file)
    if isinstance(case, DriveCase):
        return DriveAnswer(edited.source, case)
    return SprocketAnswer(edited.source, case)


@dataclass(frozen=True, eq=False)
class SprocketAnswer:
    """The answer to a case of one sprocket, or of a pair of gears."""

    source: CaseText
    case: Case

    @property
    def is_slow(self) -> bool:
        """Whether the life takes so long that an estimate helps."""
        return self.case.drive.rests

    def taken(self) -> dict[str, Any]:
        """Return the tables of the input with what it takes where they give nothing."""
        return {**self.case.inputs, "title": self.case.title}

    def first_looks(self) -> FirstLooks:
        """Return what the teeth carry."""
        return FirstLooks(loads=tooth_load_chart(self.case))

    def estimate(self, check: Callable[[float], None]) -> WearResult | None:
        """Return a first estimate, on few points and with long steps; none where it fails."""
        tolerance = max(_ROUGH_TOLERANCE, self.case.run.life_tolerance)
        settings = [
            f"mechanism.phases={min(_ROUGH_PHASES, self.case.inputs['mechanism']['phases'])}",
            f"sprocket.nodes={min(_ROUGH_NODES, self.case.inputs['sprocket']['nodes'])}",
            f"run.life_tolerance={tolerance}",
            "run.method=advance",
        ]
        try:
            return simulate(load_single(self.source, settings), check)
        except WearsimError:
            return None

    def life(self, watch: Callable[[float], None]) -> WearResult:
        """Run the case."""
        return simulate(self.case, watch)

    def headline(self, result: WearResult) -> str:
        """Return when something ends first."""
        return headline(result)

    def lives(self, result: WearResult) -> Mapping[str, Life | LowerBound]:
        """Return the life by its name."""
        return {"life": result.life}

    def runs(self, result: WearResult) -> dict[str, tuple[Case, WearResult]]:
        """Return case and result of the only wheel."""
        return {self.case.name: (self.case, result)}

    def sheet(self, result: WearResult) -> str:
        """Return the page of ``wearsim report --single-file``."""
        page = case_page(result, file_names([result.case])[0], brief=False)
        return render("case.html.j2", page, single_file=True, several=False)

    def words(self, result: WearResult) -> Words:
        """Return what the answer says."""
        reached = isinstance(result.life, Life)
        stated, defaults = stated_and_defaults(result.assumptions)
        findings = {"Findings": page_findings(result)}
        if result.practice is not None:
            findings["What ends first, published rules, events"] = chain_findings(
                result.ends, result.practice, result.events
            )
        return Words(
            title=result.title,
            hours=headline(result),
            lines=[ending(result) + ("" if reached else " (limit not reached)")],
            alarm=f"{OVERLOADED} {overload_text(result)}" if result.overloaded else "",
            band=[
                ("at the high end of the wear coefficient", hours(result.life_low)),
                ("as given", hours(result.life)),
                ("at the low end", hours(result.life_high)),
            ],
            note=f"Band: {result.band}.",
            rows=[],
            warnings=result.warnings,
            ratings=result.ratings,
            findings=findings,
            stated=stated,
            defaults=defaults,
        )

    def pictures(self, result: WearResult) -> Pictures:
        """Return what the answer looks like."""
        label, scene = [result.case], self.case.drive.scene(self.case.engaged_every)
        return Pictures(
            {result.case: tooth_charts(result)},
            drawing=None if scene is None else sketch(scene),
            margins=margins(result, self.case),
            charts=[along_chart([result], label), history_chart([result], label)],
        )


@dataclass(frozen=True, eq=False)
class DriveAnswer:
    """The answer to a whole drive."""

    source: CaseText
    drive: DriveCase
    is_slow = True

    def taken(self) -> dict[str, Any]:
        """Return the tables of the input with what it takes where they give nothing."""
        return taken_inputs(self.drive)

    def first_looks(self) -> FirstLooks:
        """Return where the chain runs and how hard it pulls."""
        return FirstLooks(layout=layout_sketch(self.drive))

    def estimate(self, check: Callable[[float], None]) -> DriveLife | None:
        """Return first lives, in few phases, on few points and with long steps; none where they fail."""
        case = self.drive.driver.case
        settings = [
            f"mechanism.phases={min(_ROUGH_DRIVE_PHASES, case.inputs['mechanism']['phases'])}",
            f"run.life_tolerance={max(_ROUGH_TOLERANCE, case.run.life_tolerance)}",
        ]
        for number, sprocket in enumerate(self.taken()["sprocket"], start=1):
            settings.append(f"sprocket.{number}.nodes={min(_ROUGH_NODES, sprocket['nodes'])}")
        try:
            return drive_life(load_drive(self.source, settings), progress=check).complete()
        except WearsimError:
            return None

    def life(self, watch: Callable[[float], None]) -> DriveLife:
        """Run the drive."""
        return drive_life(self.drive, progress=watch)

    def headline(self, found: DriveLife) -> str:
        """Return when something is replaced first and what."""
        return drive_headline(found)

    def lives(self, found: DriveLife) -> Mapping[str, Life | LowerBound]:
        """Return the lives of all parts by their names."""
        return found.parts

    def runs(self, found: DriveLife) -> dict[str, tuple[Case, WearResult]]:
        """Return case and result of every sprocket."""
        cases = self.drive.single_cases
        return {name: (cases[name], result) for name, result in found.results.items()}

    def sheet(self, found: DriveLife) -> str:
        """Return the calculation sheet of ``wearsim report``."""
        return sheet_html(found, SheetHead(date.today()))

    def words(self, found: DriveLife) -> Words:
        """Return what the answer says."""
        stated, defaults = taken_for_granted(found)
        ratings = [] if found.overloaded else [f"Ratings: {ratings_text(found)}."]
        return Words(
            title=found.drive.title,
            hours=first_hours(found.ends, found.life),
            lines=[unbroken(first_text(drive_plan(found))), *ratings],
            alarm=ratings_text(found) if found.overloaded else "",
            band=[],
            note="",
            rows=[*part_findings(found), ("Band", band_text(found)), ("Worn most", worn_most_text(found))],
            warnings=found.doubts,
            ratings=found.reference.ratings,
            findings={},
            stated=stated,
            defaults=defaults,
        )

    def pictures(self, found: DriveLife) -> Pictures:
        """Return what the answer looks like."""
        named = enumerate((one.name for one in found.drive.sprockets), start=1)
        return Pictures(
            {name: [worn_out_chart(result)] for name, result in found.results.items()},
            places={flank_place(number): name for number, name in named if name in found.results},
            bars=lives_bars(drive_plan(found)),
        )


def taken_inputs(drive: DriveCase) -> dict[str, Any]:
    """Return the tables of a drive with what it takes where they give nothing."""
    cases = {
        wheel.name: one.case for one, wheel in zip(drive.sprockets, wheel_of(drive).values(), strict=True)
    }
    given = zip(drive.wheels, drive.inputs["sprocket"], strict=True)
    sprockets = [
        {
            **(cases[wheel.name].inputs["sprocket"] if wheel.parts else table),
            "name": wheel.name,
            "role": wheel.role,
        }
        for wheel, table in given
    ]
    return {**drive.driver.case.inputs, "title": drive.title, "sprocket": sprockets}
