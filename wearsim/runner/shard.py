"""A part of a study that is run and stored as a whole; all that a worker needs to run it."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from wearsim.drive.batch_lives import CaseLife
from wearsim.drive.load_case import load_case
from wearsim.drive.simulate import simulate_many
from wearsim.errors import StudyError, WearsimError
from wearsim.files import temporary_folder
from wearsim.result import Life
from wearsim.result.folder import with_files
from wearsim.runner.design import Design, Engine, content_hash, engine

COLUMNS = (
    "case_index",
    "life_hours",
    "hours_run",
    "cycles_run",
    "stop",
    "numerical_error",
    "warnings",
    "error",
    "case_sha256",
)
"""What is known of a case that has run, or of why it has not."""

TEXTS = ("stop", "warnings", "error", "case_sha256")
"""Columns of words; all others are numbers."""

Rows = dict[str, list[Any]]


@dataclass(frozen=True)
class Shard:
    """Some cases of a study."""

    first: int  # index of the first of them in the study
    design: Design  # the cases
    engine: Engine  # that which the study is run with

    @property
    def columns(self) -> tuple[str, ...]:
        """Columns of its rows."""
        return *COLUMNS, *life_columns(self.design)

    @property
    def count(self) -> int:
        """Number of its cases."""
        return len(self.design.rows)

    @cached_property
    def address(self) -> str:
        """Hash of all that its rows depend on."""
        return content_hash({"first": self.first, "design": self.design.address()})


def life_columns(design: Design) -> tuple[str, ...]:
    """Return the columns with the lives of the parts of each case."""
    return tuple(f"{name}_life_hours" for name in design.lives)


def shards(design: Design, firsts: Iterable[int] | None = None) -> Iterator[Shard]:
    """Give the shards of a study in order, all or those that begin there."""
    size = design.cases_per_shard
    for first in range(0, len(design.rows), size) if firsts is None else firsts:
        yield Shard(first, design.part(first, size), engine())


def run_shard(shard: Shard) -> Rows:
    """Run the cases of a shard, one after another in one thread."""
    if engine() != shard.engine:
        raise StudyError(
            f"a worker has wearsim {engine().version} (kernels {engine().kernels}), the study "
            f"{shard.engine.version} ({shard.engine.kernels}): install the same on all"
        )
    loaded = loaded_cases(shard.design)
    lives = simulate_many((case for case in loaded if not isinstance(case, WearsimError)), threads=1)
    rows: Rows = {name: [] for name in shard.columns}
    for index, case in enumerate(loaded):
        failed = isinstance(case, WearsimError)
        found = case if failed else next(lives)
        digest = None if failed else _digest(case, shard)
        values = (shard.first + index, *_row(found), digest, *_part_hours(found, shard.design.lives))
        for name, value in zip(shard.columns, values, strict=True):
            rows[name].append(value)
    return rows


def loaded_cases(design: Design) -> list[Any]:
    """Return the cases of a study, or of a part of it; in place of one that is wrong its error."""
    with temporary_folder() as folder:
        for name, text in design.files.items():
            (folder / name).write_text(text, encoding="utf-8", errors="surrogateescape")
        return [_loaded(design, index, str(folder)) for index in range(len(design.rows))]


def _loaded(design: Design, index: int, folder: str) -> Any:
    try:
        return load_case(with_files(design.tables_of(index), folder))
    except WearsimError as error:
        return error


def _row(found: CaseLife | WearsimError) -> tuple[Any, ...]:
    if isinstance(found, WearsimError):
        return (None,) * 5 + ("", re.sub("^case: ", "", str(found), flags=re.MULTILINE))
    life = found.life
    hours = life.hours if isinstance(life, Life) else None
    warnings = "\n".join(found.warnings)
    return hours, life.hours_run, life.cycles_run, found.stop, found.numerical_error, warnings, ""


def _part_hours(found: CaseLife | WearsimError, parts: tuple[str, ...]) -> list[float | None]:
    """Return the lives of parts; None where one was not reached."""
    lives = {} if isinstance(found, WearsimError) else found.parts
    return [life.hours if isinstance(life := lives.get(name), Life) else None for name in parts]


def _digest(case: Any, shard: Shard) -> str:
    """Hash of the validated case with every default taken, of its files and of the engine."""
    names = {path.name for path in case.files}
    files = {name: text for name, text in shard.design.files.items() if name in names}
    inputs = with_files(case.inputs, "")
    return content_hash({"inputs": inputs, "files": files, "engine": vars(shard.engine)})
