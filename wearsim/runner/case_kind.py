"""What the cases of a study are: of one sprocket, or of another kind that its command gives."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

from wearsim.case.model import Case
from wearsim.drive.load_case import load_single
from wearsim.errors import WearsimError
from wearsim.input.document import CaseSource
from wearsim.simulation.batch_lives import CaseLife, simulate_many


@dataclass(frozen=True)
class CaseKind:
    """How the cases of a study are read and run; functions of modules, which workers find by their names."""

    read: Callable[[CaseSource, Sequence[str]], Case]  # case that stands for an input: title, inputs, wear
    load: Callable[[CaseSource], Any]  # all of it, with `inputs` and `files`; raises `WearsimError`
    lives: Callable[[Iterable[Any]], Iterator[CaseLife | WearsimError]]  # in one thread
    parts: tuple[str, ...] = ()  # parts whose lives have columns of their own


ONE_SPROCKET = CaseKind(load_single, load_single, partial(simulate_many, threads=1))
