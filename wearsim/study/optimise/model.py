"""What an optimisation asks of a case: what may change, what is sought, and within what limits."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import zip_longest
from pathlib import Path, PurePath
from typing import Any

from wearsim.case.keys.study_tables import MeasureLimit, OptimiseTable
from wearsim.case.model import Case
from wearsim.catalogue.catalogues import materials
from wearsim.drive.drive_case import DriveCase
from wearsim.drive.load_case import load_case
from wearsim.errors import CaseError, Fault
from wearsim.input.document import CaseSource, Document, read_document
from wearsim.input.table import all_differ
from wearsim.runner.design import NAMES_FILE, Design, design, replaced, value_in
from wearsim.runner.scatter import WITH_FATIGUE
from wearsim.study.optimise.search_space import SearchSpace, search_space

_BEYOND = 1.02
"""Horizon over the longest life that is allowed, at least."""


@dataclass(frozen=True)
class OptimiseStudy:
    """What is asked of a case."""

    case: Case  # as it is given
    unchanged: Design  # the case as the only one, without [optimise]
    space: SearchSpace  # what may change
    values: tuple[Any, ...]  # of the parameters in the case, None where it has none
    objectives: tuple[str, ...]  # what is sought
    limits: Mapping[str, MeasureLimit]  # what a design must keep to
    seed: int  # of the search, and how many designs it may try
    evaluations: int  # of the search, and how many designs it may try

    @property
    def measures(self) -> tuple[str, ...]:
        """Measures that are sought or limited, the life always."""
        return tuple(dict.fromkeys(("life_hours", *self.objectives, *self.limits)))

    def design(self, rows: Sequence[tuple[Any, ...]]) -> Design:
        """Return the cases of some designs."""
        return replace(self.unchanged, keys=self.space.keys, rows=tuple(rows))

    def assumptions(self, cases: Sequence[Case | DriveCase]) -> tuple[str, ...]:
        """Return what is taken for granted of designs."""
        each = [(*self._of_measures(case), *case.assumptions) for case in cases]
        shared = [text for text in each[0] if all(text in other for other in each[1:])]
        if any(len(texts) > len(shared) for texts in each):
            shared.append(
                "more that differs from design to design: `wearsim check --explain designs/01.toml` lists it"
            )
        return tuple(shared)

    def _of_measures(self, case: Case | DriveCase) -> list[str]:
        found = []
        if "mass_kg" in self.measures:
            found.append(mass_assumption(case))
        if "peak_pressure_MPa" in self.measures:
            found.append(
                "the peak pressure is that on the new flank (Hertz) under the heaviest block of the duty; "
                "wear changes it"
            )
        if case.chain_case.fatigue is not None:
            found.append(WITH_FATIGUE)
        return found


def load_optimise(source: CaseSource, overrides: Sequence[str], evaluations: int, seed: int) -> OptimiseStudy:
    """Return what is asked of a case by its table [optimise]."""
    document = read_document(source, overrides)
    loaded = load_case(source, overrides)
    case = loaded.chain_case
    if "optimise" not in case.inputs:
        text = "this table is required: it lists what may change, as parameters by their keys"
        raise CaseError([Fault(text, "optimise", document.faults.file)])
    table = OptimiseTable.model_validate(case.inputs["optimise"])
    space = search_space(document.data, table.parameters)
    limits = {name: limit for name, limit in table.limits if limit is not None}
    if "mass_kg" in (*table.objectives, *limits):
        blank_mass(loaded)
    if "life_hours" in limits:
        life = limits["life_hours"]
        # A life that runs beyond its high limit must be seen to.
        horizon = max(life.low or 0.0, _BEYOND * (life.high or 0.0), case.run.horizon_hours)
        loaded = load_case(source, [*overrides, f"run.horizon_hours={horizon!r}"])
        case = replace(loaded.chain_case, title=case.title)
    data = {name: part for name, part in document.data.items() if name != "optimise"}
    data = replaced(data, ("run", "horizon_hours"), case.run.horizon_hours)
    given, space = _with_files(replace(document, data=data), space)
    return OptimiseStudy(
        case,
        replace(given, keys=(), rows=((),)),
        space,
        tuple(_value(loaded, key) for key in space.keys),
        tuple(table.objectives),
        limits,
        seed,
        evaluations,
    )


def _with_files(document: Document, space: SearchSpace) -> tuple[Design, SearchSpace]:
    """Read the files that the case and the choices name; the choices are then bare names."""
    place = document.faults.file
    named = {
        parameter.key: parameter.choices for parameter in space.parameters if parameter.key in NAMES_FILE
    }
    faults = [
        Fault(f"must name files that can be read, but {name!r} cannot", _quoted(key), place)
        for key, names in named.items()
        for name in names
        if not _is_readable(document.folder / name)
    ]
    if faults:
        raise CaseError(faults)
    rows = list(zip_longest(*(named.get(key, ()) for key in space.keys)))
    given = design(document, space.keys, rows, place)
    parameters = []
    for parameter, column in zip(space.parameters, zip(*given.rows, strict=True), strict=False):
        bare = tuple(name for name in column if name is not None)
        if not all_differ(bare):
            text = "each file may appear once, but one is given twice: remove it"
            raise CaseError([Fault(text, _quoted(parameter.key), place)])
        parameters.append(replace(parameter, choices=bare) if bare else parameter)
    return given, SearchSpace(tuple(parameters) or space.parameters)


def _is_readable(path: Path) -> bool:
    try:
        with path.open("rb"):
            return True
    except (OSError, ValueError):
        return False


def _quoted(key: str) -> str:
    return f'optimise.parameters."{key}"'


def _value(case: Case | DriveCase, key: str) -> Any:
    """Of a key in the case; of a file its name without folder."""
    found = value_in(case, key)
    return PurePath(found).name if key in NAMES_FILE and isinstance(found, str) else found


_M3_PER_MM3 = 1e-9


def blank_mass(case: Case | DriveCase) -> float:
    """Return the mass of new sprockets: their outlines times face width and density."""
    return math.fsum(_blank_mass(one) for one in case.single_cases.values())


def _blank_mass(case: Case) -> float:
    area = case.drive.blank_area()
    if area is None:
        text = (
            "the mass needs a sprocket whose whole outline is known, which a table of loads and gears do "
            "not give: leave mass_kg out of [optimise]"
        )
        raise CaseError([Fault(text, "mass_kg", case.name)])
    width: float = case.inputs["sprocket"]["face_width_mm"]
    return _M3_PER_MM3 * area * width * density(case)


def density(case: Case) -> float:
    """Return the density of a sprocket's material."""
    return materials()[_material(case)].density


def mass_assumption(case: Case | DriveCase) -> str:
    """Return what the mass takes for granted."""
    singles = list(case.single_cases.values())
    of = " and ".join(dict.fromkeys(f"{_material(one)} with {density(one):g} kg/m3" for one in singles))
    whole = (
        "outlines over the face widths of all sprockets"
        if len(singles) > 1
        else "outline over the face width"
    )
    return f"the mass is that of the new {whole}, without bore, hub and chamfers, of {of}"


def _material(case: Case) -> str:
    return str(case.inputs.get("material", {}).get("sprocket", {}).get("name", "steel"))
