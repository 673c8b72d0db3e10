"""A drive with all of its sprockets, each of them with a case of its own."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from wearsim.case.model import Case
from wearsim.case.read_tables import ReadTables
from wearsim.drive.wheels import DRIVER, DriveWheel
from wearsim.errors import CaseError, Fault
from wearsim.input.changes import changed
from wearsim.input.document import GivenInput, read_document
from wearsim.input.input_origins import input_lines
from wearsim.input.mechanism_registry import read_case
from wearsim.mechanisms.wrap.drive import WrapDrive
from wearsim.notebook import html_rows, one_line
from wearsim.quantities import kind_of_text, with_ranges

if TYPE_CHECKING:
    from wearsim.case.keys import PlacedSprocketTable


@dataclass(frozen=True)
class DriveSprocket:
    """A sprocket of a drive."""

    name: str  # as the user calls it, with its teeth where it is a cog of a cassette
    role: str  # `driver`, `driven` or `idler`
    case: Case  # of this sprocket alone

    @property
    def drive(self) -> WrapDrive:
        """Sprocket and chain."""
        assert isinstance(self.case.drive, WrapDrive)
        return self.case.drive


@dataclass(frozen=True)
class DriveCase(ReadTables):
    """A drive whose sprockets share one chain.

    Attributes
    ----------
    name : str
        Stem of the file, or ``case``.
    title : str
        What it is about.
    inputs : mapping
        Tables of the file.
    tables : DriveTables
        The same with every default and keys as attributes, ``drive.tables.run.method``, read-only. `chain`,
        `sprocket` (a list), `load`, `mechanism`, `material`, `joint` and `stop` are attributes of the drive
        too. What differs between sprockets is in their own cases; here it is as of the driver.
    sprockets : tuple of DriveSprocket
        In the order of the file, each with the ``case`` of it alone.
    wheels : tuple of DriveWheel
        In the order of the file, which is that of the chain; a cassette is one.
    given : GivenInput
        What it was read from.
    """

    name: str  # stem of its file
    title: str  # of the file, or what is driven by what
    inputs: Mapping[str, Any]  # tables of the file
    sprockets: tuple[DriveSprocket, ...]  # in the order of the file, each cog of a cassette for itself
    wheels: tuple[DriveWheel, ...]  # in the order of the file, which is that of the chain
    given: GivenInput  # what it was read from

    def __repr__(self) -> str:
        return one_line("DriveCase", self.title, ", ".join(one.name for one in self.sprockets))

    def _repr_html_(self) -> str:
        return html_rows(self.title, input_lines(self.inputs, self.assumptions, self.warnings))

    @cached_property
    def complete_inputs(self) -> Mapping[str, Any]:
        """All tables with every default taken: those of all sprockets as the driver has them."""
        of_driver = {**self.driver.case.inputs, "drive": {**self.driver.case.inputs["drive"]}}
        of_driver["drive"].pop("mate_teeth", None)
        sprockets = [
            {**(self.single_cases[wheel.parts[0]].inputs["sprocket"] if wheel.parts else {}), **given}
            for wheel, given in zip(self.wheels, self.inputs["sprocket"], strict=True)
        ]
        return {**self.inputs, **of_driver, "title": self.title, "sprocket": sprockets}

    @cached_property
    def sprocket(self) -> "list[PlacedSprocketTable]":
        """Keys of every [[sprocket]]."""
        return cast("list[PlacedSprocketTable]", self.tables.sprocket)

    def with_(self, changes: Mapping[str, Any]) -> "DriveCase":
        """Return the drive with other values of some keys, read anew.

        Parameters
        ----------
        changes : mapping
            As for `Case.with_`; ``"sprocket.2.teeth"`` is a key of the second sprocket.

        Returns
        -------
        DriveCase
            Complete as if it had been written so; its title names the changes.

        Raises
        ------
        CaseError
            What is wrong with it then.
        """
        found: DriveCase = read_case(read_document(changed(self.given, changes), ()))
        return found

    def check(self) -> None:
        """Raise `CaseError` where the drive cannot run; such a drive is not even read."""

    def with_horizon(self, hours: float) -> "DriveCase":
        """Return the drive with runs that cover at least so many hours, for a life that is required.

        Parameters
        ----------
        hours : float
            Running time [h].

        Returns
        -------
        DriveCase
            As `Case.with_horizon` of every sprocket.
        """
        sprockets = tuple(replace(one, case=one.case.with_horizon(hours)) for one in self.sprockets)
        return replace(self, sprockets=sprockets)

    def titled_cases(self) -> dict[str, Case]:
        """Return the cases of all sprockets by their names, under titles that say which one of what drive."""
        return {one.name: replace(one.case, title=f"{self.title}: {one.name}") for one in self.sprockets}

    def titled_case(self, sprocket: str | None) -> Case:
        """Return the case of the sprocket that is named, under a title that says so.

        Parameters
        ----------
        sprocket : str, optional
            Its name.

        Returns
        -------
        Case
            With all of the drive that wears it.

        Raises
        ------
        CaseError
            None is named, or one that the drive has not.
        """
        cases = self.titled_cases()
        if sprocket not in cases:
            got = "" if sprocket is None else f" (got {sprocket!r})"
            text = f"must name one wheel of the whole drive: one of {', '.join(map(repr, cases))}{got}"
            raise CaseError([Fault(text, "sprocket", self.name)])
        return cases[sprocket]

    @property
    def worn_wheels(self) -> tuple[DriveWheel, ...]:
        """Wheels with teeth that wear: all but smooth idlers."""
        return tuple(wheel for wheel in self.wheels if not wheel.is_smooth)

    @property
    def single_cases(self) -> dict[str, Case]:
        """Cases of single sprockets by their names."""
        return {one.name: one.case for one in self.sprockets}

    @property
    def chain_case(self) -> Case:
        """Case of the chain: that of its driver, under the title of the drive."""
        return replace(
            self.driver.case,
            name=self.name,
            title=self.title,
            assumptions=self.assumptions,
            warnings=self.warnings,
        )

    @property
    def driver(self) -> DriveSprocket:
        """The sprocket that drives the chain."""
        return next(one for one in self.sprockets if one.role == DRIVER)

    @property
    def files(self) -> tuple[Path, ...]:
        """Files that the sprockets name."""
        return tuple(path for one in self.sprockets for path in one.case.files)

    @property
    def assumptions(self) -> tuple[str, ...]:
        """What is taken for granted, each once with the sprockets that it is about."""
        return said_of_sprockets({one.name: one.case.assumptions for one in self.sprockets}, self.wheels)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is doubtful before a run, each once with the sprockets that it is about."""
        return said_of_sprockets({one.name: one.case.warnings for one in self.sprockets}, self.wheels)


def with_one_wear(case: Case | DriveCase) -> Case | DriveCase:
    """Return a case whose [wear] is that of all its sprockets, as a study changes it; a fault on others."""
    faults = [
        Fault(
            "must be left out here, as [wear] applies to all sprockets: move it there", f"sprocket.{i}.wear"
        )
        for i, wheel in enumerate(getattr(case, "wheels", ()), start=1)
        if wheel.table.wear is not None
    ]
    if faults:
        raise CaseError([replace(fault, file=case.name) for fault in faults])
    return case


def said_of_sprockets(texts: Mapping[str, Sequence[str]], wheels: Sequence[DriveWheel]) -> tuple[str, ...]:
    """Return texts about single sprockets, by their names, with those names but where it is all of them.

    What cogs of one cassette differ in by numbers alone is one text, with the range of these numbers.
    """
    found: dict[str, list[str]] = {}
    about: dict[str, int] = {}
    for wheel in wheels:
        for text, parts in _of_wheel([part for part in wheel.parts if part in texts], texts):
            found.setdefault(text, []).append(_called(wheel, parts))
            about[text] = about.get(text, 0) + len(parts)
    return tuple(
        text if about[text] == len(texts) else f"{', '.join(names)}: {text}" for text, names in found.items()
    )


def _of_wheel(parts: Sequence[str], texts: Mapping[str, Sequence[str]]) -> list[tuple[str, list[str]]]:
    """Return what is said of a wheel, with the parts of it that it is said of."""
    kinds: dict[tuple[str, int], list[tuple[str, str]]] = {}
    for part in parts:
        count: dict[str, int] = {}
        for text in texts[part]:
            kind = kind_of_text(text)
            count[kind] = count.get(kind, 0) + 1
            kinds.setdefault((kind, count[kind]), []).append((part, text))
    return [(with_ranges([text for _, text in said]), [part for part, _ in said]) for said in kinds.values()]


def _called(wheel: DriveWheel, parts: Sequence[str]) -> str:
    """Return the name of a wheel, with the cogs of a cassette where it is not all of them."""
    if len(parts) == len(wheel.parts):
        return wheel.name
    return f"{wheel.name} {', '.join(part.removeprefix(f'{wheel.name} ') for part in parts)}"
