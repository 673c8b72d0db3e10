"""What an optimisation asks of a case: what may change, what is sought, and within what limits."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from wearsim.case.document import read_document
from wearsim.case.load import load_case
from wearsim.case.model import Case
from wearsim.case.schema.optimise import MeasureLimit, OptimiseTable
from wearsim.errors import CaseError, Fault
from wearsim.sizing.blank import blank_mass, mass_assumption
from wearsim.study.runner.design import Design, design, replaced
from wearsim.study.scatter import WITH_FATIGUE
from wearsim.study.search_space import SearchSpace, search_space

_BEYOND = 1.02
"""Horizon over the longest life that is allowed, at least."""


@dataclass(frozen=True)
class OptimiseStudy:
    """What is asked of a case.

    Attributes
    ----------
    case : Case
        As it is given.
    given : Design
        The case as the only one, without [optimise].
    space : SearchSpace
        What may change.
    values : tuple
        Of the parameters in the case, None where it has none.
    objectives : tuple of str
        What is sought.
    limits : mapping of str to MeasureLimit
        What a design must keep to.
    seed, evaluations : int
        Of the search, and how many designs it may try.
    """

    case: Case
    given: Design
    space: SearchSpace
    values: tuple[Any, ...]
    objectives: tuple[str, ...]
    limits: Mapping[str, MeasureLimit]
    seed: int
    evaluations: int

    @property
    def measures(self) -> tuple[str, ...]:
        """Measures that are sought or limited, the life always."""
        return tuple(dict.fromkeys(("life_hours", *self.objectives, *self.limits)))

    def design(self, rows: Sequence[tuple[Any, ...]]) -> Design:
        """Return the cases of some designs.

        Parameters
        ----------
        rows : sequence of tuple
            Values of the parameters.

        Returns
        -------
        Design
            To be run.
        """
        return replace(self.given, keys=self.space.keys, rows=tuple(rows))

    def assumptions(self, cases: Sequence[Case]) -> tuple[str, ...]:
        """Return what is taken for granted of designs.

        Parameters
        ----------
        cases : sequence of Case
            The designs, at least one.

        Returns
        -------
        tuple of str
            What holds for all of them, and that more does where they differ.
        """
        each = [(*self._of_measures(case), *case.assumptions) for case in cases]
        shared = [text for text in each[0] if all(text in other for other in each[1:])]
        if any(len(texts) > len(shared) for texts in each):
            shared.append(
                "more that differs from design to design: `wearsim check designs/01.toml` tells it"
            )
        return tuple(shared)

    def _of_measures(self, case: Case) -> list[str]:
        found = []
        if "mass_kg" in self.measures:
            found.append(mass_assumption(case))
        if "peak_pressure_MPa" in self.measures:
            found.append(
                "the peak pressure is that on the new flank (Hertz) under the heaviest block of the duty; "
                "wear changes it"
            )
        if case.fatigue is not None:
            found.append(WITH_FATIGUE)
        return found


def load_optimise(
    path: Path, overrides: Sequence[str], evaluations: int, seed: int
) -> OptimiseStudy:
    """Return what is asked of a case by its table [optimise].

    Parameters
    ----------
    path : pathlib.Path
        The case.
    overrides : sequence of str
        ``table.key=VALUE``.
    evaluations : int
        Designs that may be tried.
    seed : int
        The same seed gives the same search.

    Returns
    -------
    OptimiseStudy
        To be searched. The horizon is raised to a limit of the life that lies beyond it.

    Raises
    ------
    CaseError
        The case is wrong, has no table [optimise], or has none of what is sought.
    """
    document = read_document(path, overrides)
    case = load_case(path, overrides)
    if "optimise" not in case.inputs:
        text = "this table is required: it tells what may change, as parameters by their keys"
        raise CaseError([Fault(text, "optimise", str(path))])
    table = OptimiseTable.model_validate(case.inputs["optimise"])
    space = search_space(document.data, table.parameters)
    limits = {name: limit for name, limit in table.limits if limit is not None}
    if "mass_kg" in (*table.objectives, *limits):
        blank_mass(case)
    if "life_hours" in limits:
        life = limits["life_hours"]
        # A life that runs beyond its high limit must be seen to.
        horizon = max(life.low or 0.0, _BEYOND * (life.high or 0.0), case.run.horizon_hours)
        case = load_case(path, [*overrides, f"run.horizon_hours={horizon!r}"])
    data = {name: part for name, part in document.data.items() if name != "optimise"}
    data = replaced(data, ("run", "horizon_hours"), case.run.horizon_hours)
    given = design(replace(document, data=data), space.keys, [], str(path))
    return OptimiseStudy(
        case, replace(given, keys=(), rows=((),)), space,
        tuple(_value(case.inputs, key) for key in space.keys),
        tuple(table.objectives), limits, seed, evaluations,
    )  # fmt: skip


def _value(inputs: Mapping[str, Any], key: str) -> Any:
    found: Any = inputs
    for part in key.split("."):
        if isinstance(found, list):
            found = found[int(part) - 1] if part.isdigit() and int(part) <= len(found) else None
        else:
            found = found.get(part) if isinstance(found, Mapping) else None
    return found
