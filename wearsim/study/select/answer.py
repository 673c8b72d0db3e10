"""Chains and teeth of the catalogue for a drive."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from wearsim.drive.drive_case import DriveCase
from wearsim.drive.load_case import load_drive
from wearsim.errors import CaseError, Range, check_ranges
from wearsim.quantities import grouped
from wearsim.report.public_answer import Answer
from wearsim.study.select.selected_case import case_tables
from wearsim.study.select.sheet import (
    SelectionAnswer,
    answer_to,
    drives_table,
    selection_json,
    selection_text,
)
from wearsim.study.select.wish import Wish, read_wish

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, repr=False, eq=False)
class SelectionResult(Answer):
    """Drives of the catalogue that do what is asked.

    Attributes
    ----------
    wish : Wish
        What was asked.
    answer : SelectionAnswer
        All drives that were judged, as objects.
    """

    _tables = ("drives",)

    wish: Wish
    answer: SelectionAnswer

    @property
    def title(self) -> str:
        """Power, speed, ratio and hours that are asked for."""
        need = self.wish.need
        return f"{need.power:g} kW at {need.speed:g} rpm, ratio {need.ratio:g}, {grouped(need.hours)} h"

    @property
    def headline(self) -> str:
        """The first drive, or that none passes."""
        if not self.answer.shown:
            return "no drive passes"
        best = self.answer.shown[0]
        teeth = f"{best.layout.teeth_1}/{best.layout.teeth_2} teeth"
        return f"{best.chain.designation} on {teeth}, first of {len(self.answer.passing)} drives"

    @property
    def text(self) -> str:
        """What ``wearsim select`` prints."""
        return selection_text(self.answer)

    @property
    def explained(self) -> str:
        """The text with every assumption and default."""
        return selection_text(self.answer, explain=True)

    @property
    def drives(self) -> "pd.DataFrame":
        """A row for each drive that passes, the lightest or cheapest first; empty where none does."""
        return drives_table(self.answer.shown).frame()

    def case(self, row: int = 0) -> DriveCase:
        """Return one of the drives as a case.

        Parameters
        ----------
        row : int
            Its row in ``drives``.

        Returns
        -------
        DriveCase
            Both sprockets and the chain.

        Raises
        ------
        IndexError
            There is no such row.
        """
        wish = self.wish
        drive = self.answer.shown[row]
        return load_drive(case_tables(drive, wish.need, wish.hours_per_day))

    def _content(self) -> dict[str, Any]:
        return selection_json(self.answer)


def select(
    *,
    power: float | str,
    rpm: float | str,
    ratio: float,
    hours: float | str,
    centre: float | str | None = None,
    centre_min: float | str | None = None,
    centre_max: float | str | None = None,
    max_diameter: float | str | None = None,
    lubrication: str = "drip",
    environment: str = "clean",
    tooth_hardness: str = "hardened",
    shock: str = "smooth",
    hours_per_day: float = 8.0,
    series: Sequence[str] = ("A", "B", "H", "GOST"),
    strands: tuple[int, int] = (1, 3),
    ratio_tolerance: float = 0.03,
    teeth_min: int = 17,
    teeth_max: int = 25,
    price: str | PathLike[str] | None = None,
    every_pair: bool = False,
    count: int = 10,
) -> SelectionResult:
    """Choose chains and teeth of the catalogue for a drive.

    A drive passes if it is within the ratings and its chain lasts long enough. Text may give
    a unit, such as ``"4 hp"``.

    Parameters
    ----------
    power : float or str
        Transmitted power [kW].
    rpm : float or str
        Speed of the driver [rpm].
    ratio : float
        Speed ratio: driver speed over driven speed.
    hours : float or str
        Required life of the chain, in running hours [h].
    centre : float or str, optional
        Centre distance [mm]; by default about 40 pitches.
    centre_min : float or str, optional
        Smallest centre distance allowed [mm].
    centre_max : float or str, optional
        Largest centre distance allowed [mm].
    max_diameter : float or str, optional
        Largest tip diameter allowed [mm].
    lubrication : str
        ``drip``, ``oil bath``, ``forced``, ``manual``, ``greased`` or ``dry``.
    environment : str
        Environment of the chain: ``clean``, ``dust``, ``wet``, ``mud`` or ``soil``.
    tooth_hardness : str
        ``hardened`` or ``normalised``: it changes the life of the teeth, not that of the chain.
    shock : str
        ``smooth``, ``moderate`` or ``heavy``.
    hours_per_day : float
        Running hours per day.
    series : sequence of str
        Series of chains: ``A``, ``B``, ``H``, ``GOST``.
    strands : tuple of int
        Fewest and most strands of a chain.
    ratio_tolerance : float
        Allowed deviation of the ratio.
    teeth_min : int
        Fewest teeth of the smaller sprocket.
    teeth_max : int
        Most teeth of the smaller sprocket.
    price : path, optional
        CSV of designation, price_per_m, sprocket_price_per_kg: the cheapest drive comes first.
    every_pair : bool
        Every pair of tooth numbers of a chain, not only the best.
    count : int
        Drives in the table.

    Returns
    -------
    SelectionResult
        ``drives``, and each of them as a ``case``.

    Raises
    ------
    CaseError
        Everything that is wrong with what is asked.
    GeometryError
        Count must be at least 1.

    Examples
    --------
    >>> import wearsim
    >>> found = wearsim.select(power=3, rpm=120, ratio=2.7, hours=15_000, series=["A"])
    >>> best = found.drives.iloc[0]
    >>> best.designation, int(best.driver_teeth), int(best.driven_teeth)
    ('10A-3', 18, 49)
    """
    check_ranges("select", {"count": count}, {"count": Range(1, whole=True)})
    given = {
        "power": power,
        "rpm": rpm,
        "ratio": ratio,
        "hours": hours,
        "centre": centre,
        "centre_min": centre_min,
        "centre_max": centre_max,
        "max_diameter": max_diameter,
        "lubrication": lubrication,
        "environment": environment,
        "tooth_hardness": tooth_hardness,
        "shock": shock,
        "hours_per_day": hours_per_day,
        "series": ",".join(series),
        "strands": "-".join(map(str, strands)),
        "ratio_tolerance": f"{100.0 * ratio_tolerance} %",
        "teeth_min": teeth_min,
        "teeth_max": teeth_max,
    }
    texts = {name: None if value is None else str(value) for name, value in given.items()}
    try:
        wish = read_wish(texts, None if price is None else Path(price))
    except CaseError as error:
        raise CaseError([replace(one, file=_argument(one.file)) for one in error.faults]) from None
    return SelectionResult(wish, answer_to(wish, every_pair, count))


def _argument(place: str) -> str:
    """Return an option of the command as the argument here, any other place as it is."""
    return place.removeprefix("--").replace("-", "_") if place.startswith("--") else place
