"""``wearsim life --solve-for``: the value of a key at which a case lives as long as required."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from wearsim.command.options import (
    NOT_MET,
    answer_text,
    error_json,
    load_cases,
    print_json,
    show,
    warn,
    working,
)
from wearsim.errors import CaseError, Fault, WearsimError

if TYPE_CHECKING:
    from wearsim.case.model import Case
    from wearsim.drive.drive_case import DriveCase
    from wearsim.runner.solve_for import Solved


def solve(
    path: Path,
    key: str,
    hours: float,
    settings: Sequence[str],
    folder: Path | None,
    force: bool,
    as_json: bool,
) -> int:
    """Print the value of a key at which a case lives so long, and its answer there."""
    (case,) = load_cases([path], settings, as_json)
    from wearsim.drive.load_case import load_case
    from wearsim.runner.solve_for import solve_for

    try:
        start = _start(case, key)
        with working(f"solving {case.title} for {key}"):
            solved = solve_for(
                lambda value: load_case(path, [*settings, _setting(key, value, start)]),
                start,
                hours,
                whole=isinstance(start, int),
            )
    except WearsimError as error:
        if as_json:
            click.echo(error_json(path.stem, error))
        raise
    if folder is not None:
        solved.trial.result.save(folder, force)
    _show(solved, path, key, hours, start, as_json)
    return 0 if solved.met else NOT_MET


def _start(case: "Case | DriveCase", key: str) -> float:
    """Return the value that the case has, an integer where only whole numbers are allowed."""
    from wearsim.runner.design import unknown_key, value_in

    if unknown := unknown_key(case.inputs, key):
        raise CaseError([Fault(f"--solve-for {unknown}", key, case.name)])
    value = value_in(case, key)
    if isinstance(value, bool) or not isinstance(value, int | float):
        what = "is not in the case" if value is None else f"is {value!r}"
        message = f"--solve-for needs a key that holds one number, but it {what}: give the case one"
        raise CaseError([Fault(message, key, case.name)])
    if not value > 0:
        raise CaseError(
            [Fault(f"--solve-for needs a value above 0 to start from (got {value:g})", key, case.name)]
        )
    return value


def _setting(key: str, value: float, start: float) -> str:
    return f"{key}={int(value) if isinstance(start, int) else repr(value)}"


def _show(solved: "Solved", path: Path, key: str, hours: float, start: float, as_json: bool) -> None:
    from wearsim.quantities import grouped

    result = solved.trial.result
    if as_json:
        content = {**result.summary(), "solve_for": _json(solved, key, hours)}
        print_json(content, path, result.warnings)
    else:
        label = "Solved " if solved.met else "Nearest"
        click.echo(f"  {label}    {_sentence(solved, key, hours)}")
        show(answer_text(result, f"{path} --set {_setting(key, solved.trial.value, start)}"))
    if not solved.met:
        warn(
            f"{path}: no value of {key} was found from {solved.low:.6g} to {solved.high:.6g} that lasts "
            f"{grouped(hours)} h: shown is the nearest"
        )


def _sentence(solved: "Solved", key: str, hours: float) -> str:
    trial = solved.trial
    text = f"{key} = {trial.value:.6g} lasts {trial.hours:.6g} h, {hours:g} h are required"
    if not math.isnan(solved.elasticity):
        side = "more" if solved.elasticity > 0.0 else "less"
        text += f"; 1 % more of it gives {abs(solved.elasticity):.3g} % {side} life"
    return f"{text} ({solved.runs} lives calculated)"


def _json(solved: "Solved", key: str, hours: float) -> dict[str, Any]:
    elasticity = None if math.isnan(solved.elasticity) else solved.elasticity
    return {
        "key": key,
        "value": solved.trial.value,
        "life_hours": solved.trial.hours,
        "required_hours": hours,
        "met": solved.met,
        "elasticity": elasticity,
        "lowest": solved.low,
        "highest": solved.high,
        "runs": solved.runs,
    }
