"""What stands on the pages: all of it as data, for the templates to lay out."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from markupsafe import Markup

from wearsim._version import __version__
from wearsim.case.model import Case
from wearsim.chain.rating_findings import RatingFinding
from wearsim.citation import apa
from wearsim.input.input_origins import input_rows
from wearsim.quantities import grouped, percentile_meaning, percentile_name, percentile_shares
from wearsim.report.answer import ending, overload_text, page_findings
from wearsim.report.answer_table import AnswerTable
from wearsim.report.comparison import comparison_table, differing_limits
from wearsim.report.figures import comparison_figures, picture
from wearsim.report.flank_view import case_of
from wearsim.report.html.charts import Chart
from wearsim.report.html.inputs import Input, catalogue_sources, input_table
from wearsim.report.html.margins import Margin, margins
from wearsim.report.html.paper import SheetHead, foot
from wearsim.report.html.run_charts import along_chart, history_chart, lives_chart, tooth_load_chart
from wearsim.report.html.sketch import sketch
from wearsim.report.html.tooth_chart import tooth_charts
from wearsim.report.rating import sheet_ratings
from wearsim.report.text_lines import Finding, stated_and_defaults
from wearsim.report.verification import given_rows, verification_rows
from wearsim.result import Life, WearResult
from wearsim.result.ends import END_HEAD, PartEnd, before_wear, end_rows, first_hours, wear_only
from wearsim.result.events import EVENT_HEAD, Event, event_rows
from wearsim.result.lives import hours
from wearsim.result.second_opinions import RULE_HEAD, SecondOpinions, practice_text, rule_rows


class HtmlTable(NamedTuple):
    """A table under a heading of its own."""

    place: str  # of its element on the page
    title: str
    about: str
    head: Sequence[str]
    rows: Sequence[Sequence[str]]


@dataclass(frozen=True, eq=False)
class CasePage:
    """The page of one drive."""

    name: str  # of the file, and of the drive
    title: str  # of the file, and of the drive
    brief: bool  # whether the page is the short one
    head: list[tuple[str, str]]  # who made it, and when; empty where nothing is said of it
    foot: Markup  # style of the foot of its printed pages
    given: list[tuple[str, str]]  # what was given of a chain that wraps the sprocket
    verification: list[tuple[str, str]]  # loads, factors and lubrication of such a drive
    first: str  # the answer: hours of what ends first
    ending: str  # what ended it
    life: str  # by wear, with the coefficient as given
    # by how much the drive is outside the ratings of its load; empty where it is not
    overloaded: str
    wear_only: bool  # whether no hours are known but those of wear
    reached: bool  # whether it is a life and not a bound
    low: str  # life at the short end of the band
    high: str  # life at its long end
    band: str  # where that comes from
    percentiles: list[tuple[str, str]]  # names and hours, where they are known
    findings: list[Finding]  # the rest of the answer
    margins: list[Margin]  # of every stop limit
    ratings: AnswerTable[RatingFinding]  # what the handbooks allow; without rows where they say nothing
    rating_notes: list[str]  # what the marks at their sources mean
    chain_tables: list[HtmlTable]  # what ends first, published rules and events, where a chain wraps it
    tooth: list[Chart]  # the flank before and after
    charts: list[Chart]  # all others
    sketch: Markup  # the drive; empty where no more than a flank is known
    pictures: dict[str, str]  # still pictures as data URIs, by the stems that charts name
    inputs: list[Input]  # every key
    sources: list[tuple[str, str]]  # of the catalogue's numbers
    assumptions: list[str]  # what is taken for granted
    defaults: list[str]  # values taken where the input gives none
    warnings: tuple[str, ...]  # of the result
    versions: list[tuple[str, str]]  # of what calculated it and of what wrote the page
    citation: str  # how to cite


@dataclass(frozen=True, eq=False)
class ComparisonPage:
    """The page that compares several drives."""

    names: list[str]  # of the pages and of the drives
    titles: list[str]  # of the pages and of the drives
    table: AnswerTable[WearResult]
    limits: str  # a warning where limits differ
    warnings: list[tuple[str, str]]  # cases with their warnings
    charts: list[Chart]  # of all drives together
    pictures: dict[str, str]  # still pictures as data URIs, by the stems that charts name
    citation: str  # how to cite


def case_page(result: WearResult, name: str, brief: bool, head: SheetHead | None = None) -> CasePage:
    """Return the page of one drive."""
    case = case_of(result)
    known = head is not None and head.says_something
    tooth = tooth_charts(result)
    charts = [] if brief else _charts(result, case)
    figures = comparison_figures([result], {chart.still for chart in (*tooth, *charts)})
    taken, defaults = stated_and_defaults(result.assumptions)
    ratings, rating_notes = sheet_ratings(result.ratings)
    return CasePage(
        name=name,
        title=result.title,
        brief=brief,
        head=head.rows if head and known else [],
        foot=foot(result.title, head if known else None),
        given=[] if brief else given_rows(_as_given(result), case),
        verification=[] if brief else verification_rows(case, result.ratings),
        first=first_hours(result.ends, result.life),
        ending=_ending(result),
        life=hours(result.life),
        overloaded=overload_text(result),
        wear_only=wear_only(result.ends),
        reached=isinstance(result.life, Life),
        low=hours(result.life_low),
        high=hours(result.life_high),
        band=result.band,
        percentiles=_percentiles(result, case),
        findings=page_findings(result),
        margins=margins(result, case),
        ratings=ratings,
        rating_notes=rating_notes,
        chain_tables=chain_tables(result.ends, result.practice, result.events),
        tooth=tooth,
        charts=charts,
        sketch=Markup() if brief else sketch(case.drive.scene(case.engaged_every)),
        pictures={stem: picture(figure) for stem, figure in figures.items()},
        inputs=[] if brief else input_table(result),
        sources=[] if brief else catalogue_sources(result),
        assumptions=taken,
        defaults=defaults,
        warnings=result.warnings,
        versions=[("page written by", f"wearsim {__version__}"), *result.environment.items()],
        citation=apa(result.environment["wearsim"]),
    )


def _as_given(result: WearResult) -> dict[str, Any]:
    """Return the tables of a case without the keys of which wearsim took the value."""
    taken = {row.key for row in input_rows(result.inputs, result.assumptions) if row.origin == "taken"}
    return {
        name: {key: value for key, value in table.items() if f"{name}.{key}" not in taken}
        if isinstance(table, dict)
        else table
        for name, table in result.inputs.items()
    }


def _ending(result: WearResult) -> str:
    first, worn = before_wear(result.ends), ending(result)
    return f"by {first.mode} of the {first.part}; by wear {hours(result.life)} {worn}" if first else worn


def chain_tables(
    ends: Sequence[PartEnd], practice: SecondOpinions | None, events: Sequence[Event]
) -> list[HtmlTable]:
    """Return what may end the parts of a chain drive, what published rules say, and what happens when."""
    if practice is None:
        return []
    return [
        HtmlTable("ends", "What ends first", ENDS_NOTE, END_HEAD, end_rows(ends)),
        HtmlTable(
            "practice", "Published rules", f"{practice_text(practice)}.", RULE_HEAD, rule_rows(practice)
        ),
        HtmlTable(
            "events", "Events", "Time to the first replacement of each part.", EVENT_HEAD, event_rows(events)
        ),
    ]


ENDS_NOTE = (
    "Wear by calculation; fatigue and galling by their ratings, with hours only where a slope is published."
)


def _percentiles(result: WearResult, case: Case) -> list[tuple[str, str]]:
    if not result.inputs.get("uncertainty"):
        return []
    from wearsim.runner.scaled_percentiles import scaled_percentiles  # takes 0.4 s, for scipy.stats

    shares = percentile_shares()
    return [
        (f"{percentile_name(share)}: {percentile_meaning(share)}", f"{grouped(value)} h")
        for share, value in zip(shares, scaled_percentiles(result, case, shares), strict=False)
    ]


def _charts(result: WearResult, case: Case) -> list[Chart]:
    label, loads = [result.case], tooth_load_chart(case)
    along = [along_chart([result], label), history_chart([result], label)]
    return along if loads is None else [loads, *along]


def comparison_page(results: Sequence[WearResult], names: Sequence[str]) -> ComparisonPage:
    """Return the page that compares several drives."""
    several = list(results)
    table = comparison_table(several)
    charts = [lives_chart(several, names), along_chart(several, names), history_chart(several, names)]
    figures = comparison_figures(several, {chart.still for chart in charts})
    return ComparisonPage(
        names=list(names),
        titles=[result.title for result in several],
        table=table,
        limits=differing_limits(several),
        warnings=[(result.title, text) for result in several for text in result.warnings],
        charts=charts,
        pictures={stem: picture(figure) for stem, figure in figures.items()},
        citation=apa(),
    )
