"""What a result tells of its flanks: the case, the time of the life, columns at a time."""

from typing import TYPE_CHECKING

import numpy as np

from wearsim.case.model import Case
from wearsim.drive.load_case import load_single
from wearsim.errors import CaseError, Fault
from wearsim.files import temporary_folder
from wearsim.geometry.profile_points import Vector
from wearsim.input.document import GivenInput
from wearsim.quantities import grouped
from wearsim.result import Life, WearResult
from wearsim.result.folder import of_one_sprocket, with_files

if TYPE_CHECKING:
    import pandas as pd


def case_of(result: WearResult) -> Case:
    """Return the case that a result was calculated for."""
    with temporary_folder() as folder:
        for name, text in result.input_files.items():
            (folder / name).write_text(text, encoding="utf-8", errors="surrogateescape")
        tables = of_one_sprocket(with_files(result.inputs, str(folder)))
        return load_single(GivenInput("case.lock.toml", result.case, folder, "", tables, tables))


def life_time(result: WearResult) -> str:
    """Return the time at which pictures show a flank as worn, and what it is."""
    what = "life" if isinstance(result.life, Life) else "limit not reached"
    if result.stop == "elongation_percent":
        what += ", ended by the chain"
    return f"{grouped(result.life.hours_run)} h ({what})"


def at_life(result: WearResult) -> dict[str, Vector]:
    """Return the columns of the flank at the end of the life; of the kind of gap that wears most."""
    times, end = np.unique(result.flank_columns["cycles"]), result.life.cycles_run
    last = int(np.clip(np.searchsorted(times, end), 1, times.size - 1))
    part = min(1.0, float((end - times[last - 1]) / (times[last] - times[last - 1])))
    before, after = snapshot(result, last - 1), snapshot(result, last)
    return {name: (1.0 - part) * before[name] + part * after[name] for name in after}


def snapshot(result: WearResult, index: int) -> dict[str, Vector]:
    """Return the columns of the flank at one snapshot; of the kind of gap that wears most."""
    columns = flanks(result, index)
    if "gap_kind" not in columns:
        return columns
    greatest = int(result.flank_columns["depth_mm"].argmax())
    at = columns["gap_kind"] == result.flank_columns["gap_kind"][greatest]
    return {name: values[at] for name, values in columns.items()}


def flanks(result: WearResult, index: int) -> dict[str, Vector]:
    """Return the columns of all flanks at one snapshot."""
    cycles = result.flank_columns["cycles"]
    at = cycles == np.unique(cycles)[index]
    return {name: values[at] for name, values in result.flank_columns.items()}


def profile_table(case: Case) -> "pd.DataFrame":
    """Return the points of a flank with what follows from them."""
    import pandas as pd

    columns = case.drive.profile_columns()
    if not columns:
        message = "the case must have a sprocket, a table of loads or gears have none: nothing to write"
        raise CaseError([Fault(message, "mechanism.kind", case.name)])
    return pd.DataFrame(columns)
