"""The answer to a case of one sprocket, in steps: is it sound, about how long, how long, how it looks."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from wearsim.case.model import Case
from wearsim.drive.load_case import load_single
from wearsim.drive.part_life import simulate
from wearsim.errors import CaseError, Fault, WearsimError
from wearsim.geometry.scene import Scene
from wearsim.input.document import CaseText
from wearsim.page.case_file import CaseFile
from wearsim.page.edited_input import edited_title
from wearsim.report.html.charts import Chart
from wearsim.report.html.margins import Margin, margins
from wearsim.report.html.run_charts import along_chart, history_chart
from wearsim.report.html.tooth_chart import tooth_charts
from wearsim.result import WearResult

_ROUGH = {"mechanism.phases": 4, "sprocket.nodes": 101}
"""Most of what a first estimate takes of a wrap."""

ROUGH_TOLERANCE = 0.1
"""Of the life of a first estimate."""


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
    case = load_single(source)
    return replace(case, title=edited_title(source, file) or case.title)


def is_slow(case: Case) -> bool:
    """Whether the life of a case takes so long that an estimate helps."""
    return case.drive.rests


def estimate(source: CaseText, case: Case, check: Callable[[float], None]) -> WearResult | None:
    """Return a first estimate of a life that takes seconds, on few points and with long steps."""
    rough = []
    for key, roughest in _ROUGH.items():
        table, _, name = key.partition(".")
        rough.append(f"{key}={min(roughest, case.inputs[table][name])}")
    tolerance = max(ROUGH_TOLERANCE, case.run.life_tolerance)
    try:
        return simulate(
            load_single(source, [*rough, f"run.life_tolerance={tolerance}", "run.method=advance"]), check
        )
    except WearsimError:
        return None


def pictures(case: Case, result: WearResult) -> Pictures:
    """Return what a result looks like."""
    label: Sequence[str] = [result.case]
    return Pictures(
        tooth_charts(result),
        [along_chart([result], label), history_chart([result], label)],
        case.drive.scene(case.engaged_every),
        margins(result, case),
    )
