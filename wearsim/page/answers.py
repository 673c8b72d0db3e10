"""The answer to an input, in steps: is it sound, about how long, how long, what it looks like."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from wearsim.case.load_case import load_case
from wearsim.case.model import Case
from wearsim.errors import CaseError, Fault, WearsimError
from wearsim.geometry.scene import Scene
from wearsim.input.document import CaseText, retitled
from wearsim.page.case_file import CaseFile
from wearsim.page.toml_source import parsed_tables
from wearsim.report.html.charts import Chart
from wearsim.report.html.margins import Margin, margins
from wearsim.report.html.run_charts import along_chart, history_chart
from wearsim.report.html.tooth_chart import tooth_charts
from wearsim.result import WearResult
from wearsim.simulation import simulate

_ROUGH = {"mechanism.phases": 4, "sprocket.nodes": 101}
"""Most of what a first estimate takes of a wrap."""

_ROUGH_TOLERANCE = 0.1


class StaleError(Exception):
    """Nobody waits for the answer any more."""


@dataclass(frozen=True, eq=False)
class Pictures:
    """What an answer looks like."""

    tooth: list[Chart]  # the flank before and after
    charts: list[Chart]  # depth, pressure and sliding along the flank, and wear over time
    scene: Scene | None  # the drive to scale, where it is known
    margins: list[Margin]  # how near every limit is


def error_faults(error: WearsimError) -> tuple[Fault, ...]:
    """Return what is wrong, each as the command line prints it."""
    return error.faults if isinstance(error, CaseError) else (Fault(str(error)),)


def edited_case(source: CaseText, file: CaseFile) -> Case:
    """Return the case of an input whose title tells what is not yet in its file."""
    case = load_case(source)
    tables, written = parsed_tables(source.text) or {}, parsed_tables(file.text) or {}
    return replace(case, title=retitled(tables, written).get("title") or case.title)


def is_slow(case: Case) -> bool:
    """Whether the life of a case takes so long that an estimate helps."""
    return case.drive.rests


def estimate(source: CaseText, case: Case, is_stale: Callable[[], bool]) -> WearResult | None:
    """Return a first estimate of a life that takes seconds, on few points and with long steps."""
    rough = []
    for key, greatest in _ROUGH.items():
        table, _, name = key.partition(".")
        rough.append(f"{key}={min(greatest, case.inputs[table][name])}")
    tolerance = max(_ROUGH_TOLERANCE, case.run.life_tolerance)
    try:
        return simulate(
            load_case(source, [*rough, f"run.life_tolerance={tolerance}", "run.method=advance"]),
            _watch(is_stale, lambda part: None),
        )
    except WearsimError:
        return None


def life(case: Case, is_stale: Callable[[], bool], progress: Callable[[float], None]) -> WearResult:
    """Wear a case, as ``wearsim life`` does."""
    if is_stale():
        raise StaleError
    return simulate(case, _watch(is_stale, progress))


def pictures(case: Case, result: WearResult) -> Pictures:
    """Return what a result looks like."""
    label: Sequence[str] = [result.case]
    return Pictures(
        tooth_charts(result),
        [along_chart([result], label), history_chart([result], label)],
        case.drive.scene(case.engaged_every),
        margins(result, case),
    )


def _watch(is_stale: Callable[[], bool], progress: Callable[[float], None]) -> Callable[[float], None]:
    """Tell of progress, or end a run that nobody waits for."""

    def report_progress(part: float) -> None:
        if is_stale():
            raise StaleError
        progress(part)

    return report_progress
