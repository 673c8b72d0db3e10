"""The wear of a sprocket from a photograph of it."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from wearsim.case.model import Case
from wearsim.catalogue.catalogues import Chain
from wearsim.drive.case_input import CaseInput, loaded
from wearsim.drive.drive_case import DriveCase
from wearsim.errors import ABOVE_0, Allowed, CaseError, Fault, Range, check_ranges, check_series
from wearsim.readings.shared_reading import reading_toml
from wearsim.report.answer_table import csv_of
from wearsim.report.public_answer import DrawnAnswer
from wearsim.runner.in_threads import Progress, silent
from wearsim.scanning.chain_beside import ChainBeside, SeenChain, measure_chain
from wearsim.scanning.known_scales import LookUp, by_bore, by_dots, by_points
from wearsim.scanning.model import SURE, ScannedWheel, scan_photograph
from wearsim.scanning.new_wheel import (
    STANDARDS,
    NewWheel,
    chain_named,
    chain_of_case,
    wheel_of_case,
    wheel_of_chain,
)
from wearsim.scanning.photograph import Photograph, read_photograph
from wearsim.scanning.sheet import (
    chain_csv,
    depth_table,
    points_csv,
    readings_csv,
    scan_json,
    scan_text,
    tooth_table,
)
from wearsim.scanning.sheet_placement import check_circle, check_thickness, find_sheet
from wearsim.scanning.silhouette import Silhouette, find_silhouette
from wearsim.study.remaining.model import DEPTH, SingleReading, remaining_life

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

_ALLOWED: dict[str, Allowed] = {
    "teeth": Range(least=5, most=150, whole=True, optional=True),
    "profile": (*STANDARDS, None),
    "ruler": Range(least=50.0, most=200.0, optional=True),
    **dict.fromkeys(("bore", "dpi", "thickness", "chain_width", "hours"), Range(above=0.0, optional=True)),
}

_LINKS = Range(least=2, most=200, whole=True)


@dataclass(frozen=True, repr=False, eq=False)
class ScanResult(DrawnAnswer):
    """The wear of a sprocket in a photograph.

    Attributes
    ----------
    found : ScannedWheel
        Photograph, placed wheel and depths as objects.
    case : Case or None
        That of the sprocket, where one is given.
    """

    _tables = ("teeth", "gap")

    found: ScannedWheel
    case: Case | None = None

    @property
    def title(self) -> str:
        """Which photograph of what."""
        return f"{self.found.photograph.name}: {self.found.wheel.words}"

    @property
    def headline(self) -> str:
        """The depth with its standard error."""
        depths = self.found.depths
        return f"{depths.depth:.3f} mm +- {depths.depth_error:.3f} worn off {self.found.wheel.teeth} teeth"

    @property
    def text(self) -> str:
        """What ``wearsim scan`` prints."""
        return scan_text(self.found)

    @property
    def explained(self) -> str:
        """The text with every assumption."""
        return scan_text(self.found, explain=True)

    @property
    def depth(self) -> float:
        """Mean depth of the worn flanks at their deepest place [mm]."""
        return self.found.depths.depth

    @property
    def depth_error(self) -> float:
        """Standard error of the depth [mm]."""
        return self.found.depths.depth_error

    @property
    def chain_elongation(self) -> float | None:
        """How much longer the chain beside the wheel is than new [%]; None where none is measured."""
        return None if self.found.chain is None else self.found.chain.elongation

    @property
    def teeth(self) -> "pd.DataFrame":
        """A row for each tooth: its tip in the picture, and its depth."""
        return tooth_table(self.found).frame()

    @property
    def gap(self) -> "pd.DataFrame":
        """A row for each place along the mean gap: new form, depth, standard error, spread."""
        return depth_table(self.found).frame()

    def _content(self) -> dict[str, Any]:
        return scan_json(self.found)

    def pictures(self) -> "dict[str, Figure]":
        """Return the photograph with the new form and the worn edge on it.

        Returns
        -------
        dict of matplotlib.figure.Figure
            ``overlay``.
        """
        from wearsim.scanning.figure import overlay_figure

        return {"overlay": overlay_figure(self.found)}

    def shared_reading(self) -> str:
        """Return the depth with the conditions of the case as the file in which it can be shared.

        Returns
        -------
        str
            Content of ``reading.toml``.

        Raises
        ------
        CaseError
            Case or hours were not given, or the depth is within its error.
        """
        found = self.found
        if self.case is None or found.hours is None or not found.is_worn:
            text = "must have a case, running hours and a depth above its error to be shared: give them"
            raise CaseError([Fault(text, "", found.photograph.name)])
        depths = found.depths
        teeth = depths.of_teeth.tolist()
        return reading_toml(self.case, found.hours, depths.depth, depths.depth_error, teeth, depths.worn_gap)

    def _files(self) -> Mapping[str, str]:
        readings = (
            {"readings.csv": readings_csv(self.found)} if self.found.hours and self.found.is_worn else {}
        )
        if readings and self.case is not None:
            readings["reading.toml"] = self.shared_reading()
        chain, hours = self.found.chain, self.found.hours
        chain_reading = {} if chain is None or hours is None else {"chain.csv": chain_csv(chain, hours)}
        return {
            "teeth.csv": csv_of(self.teeth),
            "gap.csv": csv_of(self.gap),
            "points.csv": points_csv(self.found),
            **readings,
            **chain_reading,
            "scan.txt": f"{self.explained}\n",
        }


def scan(
    photograph: str | PathLike[str] | Photograph,
    case: CaseInput | None = None,
    *,
    chain: str | None = None,
    teeth: int | None = None,
    profile: str | None = None,
    bore: float | None = None,
    scale: tuple[float, float, float, float, float] | None = None,
    dpi: float | None = None,
    ruler: float | None = None,
    thickness: float | None = None,
    chain_beside: tuple[float, float, float, float, int] | None = None,
    chain_width: float | None = None,
    hours: float | None = None,
    sprocket: str | None = None,
    progress: Progress = silent,
) -> ScanResult:
    """Measure the wear of a sprocket in a photograph of it, taken along its axis.

    The new form comes from a case, or from a chain whose sprocket has a standard form. It gives the scale
    too, unless one of bore, scale and dpi is given, or the sprocket lies on a marker sheet of
    ``wearsim scan --sheet``, which is detected automatically.

    Parameters
    ----------
    photograph : path
        PNG, JPEG or TIFF of one sprocket off its drive, with all teeth in the picture; or a picture that
        has been read.
    case : Case, DriveCase, path or mapping, optional
        The drive of the sprocket.
    chain : str, optional
        Designation of the chain, in place of a case.
    teeth : int, optional
        Number of teeth, with a chain; counted without it.
    profile : str, optional
        ``iso606``, ``ansi_b29`` or ``gost591``, with a chain; by default that of the chain's series.
    bore : float, optional
        Diameter of the bore [mm], if it shows as a hole.
    scale : tuple of float, optional
        Two points of the picture x1, y1, x2, y2 [px] in the plane of the teeth, and their distance [mm].
    dpi : float, optional
        Dots per inch of a flatbed scan.
    ruler : float, optional
        Length of the ruler on the print of a marker sheet [mm]; 100 by default.
    thickness : float, optional
        Thickness of the teeth on a marker sheet [mm]; by default the tooth width of the chain or the case.
    chain_beside : tuple of float, optional
        Two pins x1, y1, x2, y2 [px] of a chain that lies on its side beside the wheel on the marker sheet, or
        on the same table, and the even number of links between them: its elongation is measured.
    chain_width : float, optional
        Width of that chain over the ends of a pin [mm]; needed with ``chain_beside``.
    hours : float, optional
        Running hours of the sprocket since it was new [h]; with a case the hours that are left follow.
    sprocket : str, optional
        Which sprocket of a whole drive it is, by its name.
    progress : callable, optional
        Called with the fraction done of the life that is computed, from 0 to 1.

    Returns
    -------
    ScanResult
        ``depth``, ``depth_error``, ``teeth`` and ``gap``.

    Raises
    ------
    TypeError
        Neither a case nor a chain is given, or both, or several scales, or only one of chain_beside and
        chain_width.
    CaseError
        What is wrong with the photograph, the case or the chain.
    GeometryError
        A number is out of its range.
    ContactError, ConvergenceError
        The life of the case cannot be run.

    Examples
    --------
    >>> import wearsim
    >>> wearsim.scan("wheel.txt", chain="08B")
    Traceback (most recent call last):
    wearsim.errors.CaseError: wheel.txt: must be a picture, but cannot be opened (No such file or directory):
    check the path
    """
    if (case is None) == (chain is None):
        raise TypeError("scan: must be given the new form, by a case or by a chain")
    if case is not None and (teeth is not None or profile is not None):
        raise TypeError("scan: teeth and profile belong to a chain, a case has its own")
    if sum(one is not None for one in (bore, scale, dpi)) > 1:
        raise TypeError("scan: must be given at most one of bore, scale and dpi")
    if (chain_beside is None) != (chain_width is None):
        raise TypeError("scan: chain_beside and chain_width must be given together")
    numbers = {"bore": bore, "dpi": dpi, "ruler": ruler, "thickness": thickness, "hours": hours}
    given = {"teeth": teeth, "profile": profile, "chain_width": chain_width, **numbers}
    check_ranges("scan", given, _ALLOWED)
    if scale is not None:
        check_series("scan", "scale", scale, Range(least=0.0), 5)
        check_ranges("scan", {"scale[4]": scale[4]}, {"scale[4]": ABOVE_0})
    asked = _asked(chain_beside, chain_width)
    one = None if case is None else _of_one(loaded(case), sprocket)
    picture = photograph if isinstance(photograph, Photograph) else read_photograph(Path(photograph))
    sheet = find_sheet(picture, ruler)
    if thickness is not None:
        check_thickness(thickness, sheet, picture.name)
    beside = None if asked is None else measure_chain(picture, sheet, _chain(one, chain), asked)
    plain = picture if sheet is None else sheet.cleared(picture, None if beside is None else beside.outline)
    seen = _silhouette(plain, beside)
    if one is not None:
        wheel = wheel_of_case(one)
    else:
        assert chain is not None
        wheel = replace(wheel_of_chain(chain, teeth or seen.teeth, profile), per_case=teeth is not None)
    wheel = replace(wheel, thickness=thickness or wheel.thickness)
    if sheet is not None:
        check_circle(wheel, sheet, picture.name)
    known = _scale(plain, seen, wheel, bore, scale, dpi)
    if known is None and sheet is not None:
        known = sheet.scale_of(wheel)
    found = replace(scan_photograph(plain, seen, wheel, known, sheet), photograph=picture)
    if beside is not None:
        found = replace(found, chain=beside, warnings=(*found.warnings, *beside.warnings))
    return ScanResult(_with_hours(found, one, hours, progress), one)


def _asked(beside: tuple[float, float, float, float, int] | None, width: float | None) -> ChainBeside | None:
    """Return which chain is to be measured, if any."""
    if beside is None or width is None:
        return None
    check_series("scan", "chain_beside", beside, Range(least=0.0), 5)
    x_1, y_1, x_2, y_2, links = beside
    whole = int(links) if links % 1 == 0 else links
    check_ranges("scan", {"chain_beside[4]": whole}, {"chain_beside[4]": _LINKS})
    return ChainBeside((x_1, y_1, x_2, y_2), whole, width)


def _silhouette(picture: Photograph, beside: SeenChain | None) -> Silhouette:
    """Return the outline of the wheel, and name the chain where it may be why there is none."""
    try:
        return find_silhouette(picture)
    except CaseError as error:
        if beside is None:
            raise
        hint = (
            "; what lies in line with the chain is left out, up to the edges of the picture: lay the chain "
            "so that its line passes beside the sprocket"
        )
        raise CaseError([replace(one, message=one.message + hint) for one in error.faults]) from None


def _scale(
    picture: Photograph,
    seen: Silhouette,
    wheel: NewWheel,
    bore: float | None,
    scale: tuple[float, float, float, float, float] | None,
    dpi: float | None,
) -> LookUp | None:
    """Return what the scale is known from beside the form."""
    if bore is not None:
        return by_bore(picture, seen, wheel.root_radius, bore)
    if scale is not None:
        return by_points(picture, scale[:4], scale[4])
    return None if dpi is None else by_dots(dpi)


def _chain(case: Case | None, designation: str | None) -> Chain:
    """Return the chain of a case, or that of a name."""
    if designation is not None:
        return chain_named(designation)
    found = None if case is None else chain_of_case(case)
    if found is None:
        text = "the case must have a chain if the length of one is to be measured, but has none"
        raise CaseError([Fault(text, "chain", "" if case is None else case.name)])
    return found


def _of_one(case: Case | DriveCase, sprocket: str | None) -> Case:
    """Return the case of the sprocket in the picture."""
    if isinstance(case, DriveCase):
        return case.titled_case(sprocket)
    if sprocket is not None:
        text = f"must be left out, as the case has only one (got {sprocket!r})"
        raise CaseError([Fault(text, "sprocket", case.name)])
    return case


def _with_hours(
    found: ScannedWheel, case: Case | None, hours: float | None, progress: Progress
) -> ScannedWheel:
    """Return what is found with the running time, and the remaining hours if the depth is sure enough."""
    if hours is None or case is None:
        return replace(found, hours=hours)
    depths = found.depths
    if not found.is_worn:
        text = "the depth is within its error, so there are no remaining hours: measure later, or from closer"
        return replace(found, hours=hours, warnings=(*found.warnings, text))
    reading = SingleReading(DEPTH, depths.depth, SURE * depths.depth_error, hours)
    try:
        left = remaining_life(case, reading, progress)
    except CaseError as error:
        reasons = "; ".join(fault.message for fault in error.faults)
        return replace(found, hours=hours, warnings=(*found.warnings, f"no remaining hours: {reasons}"))
    return replace(found, hours=hours, remaining=left, warnings=(*found.warnings, *left.warnings))
