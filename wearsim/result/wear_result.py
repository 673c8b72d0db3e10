"""What a simulation hands back: complete, immutable, saves and loads itself."""

from __future__ import annotations

import platform
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from functools import cached_property
from importlib import import_module, metadata
from pathlib import Path
from typing import TYPE_CHECKING, Any

from wearsim._version import __version__
from wearsim.chain.rating_findings import RatingFinding, overloading
from wearsim.errors import WearsimError
from wearsim.geometry.profile_points import Vector
from wearsim.jit.compiled import source_hash
from wearsim.notebook import html_rows, one_line
from wearsim.result.ends import PITTING, LifeBand, PartEnd, before_wear, ends_json, first_end_keys, part_ends
from wearsim.result.events import Event, drive_events, events_json
from wearsim.result.folder import SCHEMA_VERSION, read_result, write_result
from wearsim.result.lives import Life, LimitState, LowerBound, first_life, life_keys, service_keys
from wearsim.result.second_opinions import SecondOpinions, opinions_json

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_ANSWER, _PICTURES = "wearsim.report.answer", "wearsim.report.result_pictures"
"""What shows a result; it knows results, and not the other way round."""


@dataclass(frozen=True, eq=False)
class WearResult:
    """The life of one case and the flank on the way to it.

    Attributes
    ----------
    case, title : str
        Name and title of the case.
    life : Life or LowerBound
        With the coefficient of the case.
    life_low, life_high : Life or LowerBound
        With the coefficient at the high and at the low end of its band.
    band : str
        Where the band comes from.
    stop : str
        The limit that ended the life, or ``horizon_hours``.
    stop_value : float
        Value of that limit, in the unit of its key.
    cycles_run, hours_run : float
        What the run covers.
    max_depth : float
        Depth at the deepest point at the end [mm].
    max_depth_arc_length : float
        Where it lies along the unworn flank from the root, on a wrap along the unworn gap
        from its right tip [mm].
    removed_area, worn_area : float
        Between the new and the worn outline by their points, and summed over the wear of the
        run [mm2]: the same but for numerical errors. Of all gaps told apart on a wrap.
    initial_peak_pressure, final_peak_pressure : float
        Highest contact pressure on the unworn flank or gaps, and at the end of the run [MPa].
    speed_rpm : float
        Speed of the sprocket.
    method : str
        ``advance`` or ``per_cycle``.
    updates : int
        Evaluations of the wear rate.
    numerical_error : float
        Estimated relative error of the life by steps and grid.
    life_tolerance : float
        What was asked for.
    parts : mapping
        LifeBand of ``chain`` and ``sprocket`` on a wrap, with chains replaced at their limit;
        ``sprocket_fatigue``, or ``pinion_fatigue`` and ``wheel_fatigue`` of gears, where their
        materials are given: hours until pitting, which ``life`` leaves out; empty otherwise.
    limits : tuple of LimitState
        Every limit and what its quantity has come to at the end of the life.
    bands : mapping
        Of ``chain`` and ``sprocket`` on a wrap, their lives at the high and at the low end of their
        coefficients; empty otherwise.
    ratings : tuple of RatingFinding
        What the handbooks allow of the drive, on a wrap; empty otherwise.
    practice : SecondOpinions or None
        What published rules say of the chain's life; None where no chain wraps the sprocket.
    assumptions, warnings : tuple of str
        What was taken for granted, and what the user should look at.
    inputs : mapping
        All tables of the case with every default taken.
    input_files : mapping
        Text of every file that the case read, by name.
    history_columns, flank_columns : mapping
        Columns of ``history`` and ``flank`` as arrays.
    environment : mapping
        Versions and platform.
    """

    case: str
    title: str
    life: Life | LowerBound
    life_low: Life | LowerBound
    life_high: Life | LowerBound
    band: str
    stop: str
    stop_value: float
    cycles_run: float
    hours_run: float
    max_depth: float
    max_depth_arc_length: float
    removed_area: float
    worn_area: float
    initial_peak_pressure: float
    final_peak_pressure: float
    speed_rpm: float
    method: str
    updates: int
    numerical_error: float
    life_tolerance: float
    parts: Mapping[str, Life | LowerBound]
    limits: tuple[LimitState, ...]
    bands: Mapping[str, LifeBand]
    ratings: tuple[RatingFinding, ...]
    practice: SecondOpinions | None
    assumptions: tuple[str, ...]
    warnings: tuple[str, ...]
    inputs: Mapping[str, Any]
    input_files: Mapping[str, str]
    history_columns: Mapping[str, Vector]
    flank_columns: Mapping[str, Vector]
    environment: Mapping[str, str]

    def __repr__(self) -> str:
        return one_line(
            "WearResult", self.title, *(f"{label} {text}" for label, text in self._findings()[:2])
        )

    def _repr_html_(self) -> str:
        texts = ("Assumes", self.assumptions), ("Warnings", self.warnings or "none")
        return html_rows(self.title, [*self._findings(), *texts])

    def _findings(self) -> list[tuple[str, str]]:
        found: list[tuple[str, str]] = import_module(_ANSWER).findings(self)
        return found

    def plot(self, axes: Axes | None = None) -> Figure:
        """Draw the flank new and at the end of its life, the depth enlarged, with the roller.

        Parameters
        ----------
        axes : matplotlib.axes.Axes, optional
            Where to draw; a figure of its own without it.

        Returns
        -------
        matplotlib.figure.Figure
            A notebook shows it; ``savefig`` writes it.
        """
        figure: Figure = import_module(_PICTURES).flank_picture([self], axes)
        return figure

    def plot_history(self) -> Figure:
        """Draw the greatest depth over running time, on a wrap the elongation of the chain too.

        Returns
        -------
        matplotlib.figure.Figure
            A notebook shows it; ``savefig`` writes it.
        """
        figure: Figure = import_module(_PICTURES).history_picture([self])
        return figure

    def plot_loads(self) -> Figure:
        """Draw what the flank carries per width along it, new and worn; on a wrap the force on each tooth.

        Returns
        -------
        matplotlib.figure.Figure
            A notebook shows it; ``savefig`` writes it.
        """
        figure: Figure = import_module(_PICTURES).loads_picture(self)
        return figure

    @property
    def cycles(self) -> float:
        """Loading cycles to the first limit; raises where it was not reached."""
        return self.life.cycles

    @property
    def fatigue(self) -> dict[str, Life | LowerBound]:
        """LifeBand of `parts` by contact fatigue; empty where it was not asked for."""
        return {name: life for name, life in self.parts.items() if name.endswith("_fatigue")}

    @property
    def governing(self) -> str | None:
        """``wear`` or the name of a life by contact fatigue, as `first_life` gives it."""
        return first_life(self.life, self.fatigue)

    @property
    def earliest_life(self) -> Life | LowerBound:
        """The life that governs, by wear or by contact fatigue; a bound where none ends."""
        return self.fatigue.get(self.governing or "", self.life)

    @property
    def named_lives(self) -> dict[str, Life | LowerBound]:
        """LifeBand by what they are in words: by wear, by contact fatigue, and by what else ends it first."""
        fatigue = {f"{name.replace('_', ' ')} life": life for name, life in self.fatigue.items()}
        first = before_wear(self.ends)
        other = {} if first is None or first.mode == PITTING else {f"life by {first.mode}": first.life}
        return {"life": self.life, **fatigue, **other}

    @property
    def failed(self) -> dict[str, WearsimError]:
        """What runs of single parts ended with: none, there is one run."""
        return {}

    @property
    def ends(self) -> tuple[PartEnd, ...]:
        """Everything that may end a part, that which comes first at the head."""
        wear = self.parts if "chain" in self.parts else {"sprocket": self.life, **self.parts}
        bands = self.bands or {"sprocket": (self.life_low, self.life_high)}
        return part_ends(wear, bands, self.ratings)

    @property
    def events(self) -> tuple[Event, ...]:
        """What happens to the chain and the sprocket when, in the order of time; none without a chain."""
        limit = next((one.limit for one in self.limits if one.name == "elongation_percent"), None)
        if limit is None or "chain" not in self.parts:
            return ()
        return drive_events(self.inputs, self.history_columns, limit, self.ends)

    @property
    def overloaded(self) -> tuple[RatingFinding, ...]:
        """Those of `ratings` that overload the drive; the lives do not count them."""
        return overloading(self.ratings)

    @cached_property
    def history(self) -> pd.DataFrame:
        """The run over time, a row for every snapshot."""
        import pandas as pd

        return pd.DataFrame(dict(self.history_columns))

    @cached_property
    def flank(self) -> pd.DataFrame:
        """The worn flank, a row for every snapshot and point."""
        import pandas as pd

        return pd.DataFrame(dict(self.flank_columns))

    def summary(self) -> dict[str, Any]:
        """Return the answer as ``wearsim life --json`` prints it.

        Returns
        -------
        dict
            Plain numbers, strings, lists and None; never nan.
        """
        reached = isinstance(self.life, Life)
        return {
            "schema_version": SCHEMA_VERSION,
            "wearsim_version": self.environment["wearsim"],
            "case": self.case,
            "title": self.title,
            **life_keys("life_hours", self.life),
            "cycles": self.life.cycles if isinstance(self.life, Life) else None,
            "life_reached": reached,
            "hours_run": self.hours_run,
            "cycles_run": self.cycles_run,
            **life_keys("life_hours_low", self.life_low),
            **life_keys("life_hours_high", self.life_high),
            "band": self.band,
            "stop": self.stop,
            "stop_value": self.stop_value,
            **self._parts(),
            "limits": [asdict(state) for state in self.limits],
            **self._rated(),
            **first_end_keys(self.ends),
            "ends": ends_json(self.ends),
            **({"events": events_json(self.events)} if self.events else {}),
            **({} if self.practice is None else {"practice": opinions_json(self.practice)}),
            "max_depth_mm": self.max_depth,
            "max_depth_arc_length_mm": self.max_depth_arc_length,
            "flank_length_mm": float(self.flank_columns["arc_length_mm"][-1]),
            "removed_area_mm2": self.removed_area,
            "worn_area_mm2": self.worn_area,
            "initial_peak_pressure_MPa": self.initial_peak_pressure,
            "final_peak_pressure_MPa": self.final_peak_pressure,
            "speed_rpm": self.speed_rpm,
            "method": self.method,
            "updates": self.updates,
            "numerical_error": self.numerical_error,
            "life_tolerance": self.life_tolerance,
            "assumptions": list(self.assumptions),
            "warnings": list(self.warnings),
            **service_keys(self.inputs, self.life),
        }

    def _parts(self) -> dict[str, Any]:
        """LifeBand of the parts, which of wear and contact fatigue governs, and the chains they take."""
        keys: dict[str, Any] = {}
        for name, life in self.parts.items():
            found = life_keys(f"{name}_life_hours", life)
            if name in self.fatigue:
                # A stress that is always endured: there is no such life, and no bound of it.
                del found[f"{name}_life_hours_at_least"]
            keys |= found
        if "chain" in self.parts:
            keys["chains_run"] = int(self.history_columns["chain"][-1])
        if self.fatigue:
            keys["governing_life"] = self.governing
            keys |= life_keys("governing_life_hours", self.earliest_life)
        return keys

    def _rated(self) -> dict[str, Any]:
        if not self.ratings:
            return {}
        return {
            "overloaded": [_rating(finding) for finding in self.overloaded],
            "ratings": [_rating(finding) for finding in self.ratings],
        }

    def save(self, folder: str | Path, force: bool = False, parquet: bool = False) -> None:
        """Write the result into a folder, all of it or nothing.

        Parameters
        ----------
        folder : path
            New folder for result.json, case.lock.toml, environment.json, history.csv,
            flank.csv and ``inputs`` with the CSV files of the case.
        force : bool
            Replace a folder that is there.
        parquet : bool
            Write history.parquet and flank.parquet too (extra ``parquet``).

        Raises
        ------
        OutputError
            The folder is there, or cannot be written.
        CaseError
            pyarrow is not installed, which Parquet needs.
        """
        write_result(vars(self), self.summary(), Path(folder), force, parquet)

    @classmethod
    def load(cls, folder: str | Path) -> WearResult:
        """Read a result that was saved.

        Parameters
        ----------
        folder : path
            Folder with result.json.

        Returns
        -------
        WearResult
            Equal to what was saved, number by number.

        Raises
        ------
        OutputError
            The folder does not hold a complete result of this version.
        """
        return cls(**read_result(Path(folder)))


def environment() -> dict[str, str]:
    """Return what a result depends on beside its inputs."""
    libraries = ("numpy", "scipy", "shapely", "numba", "pandas", "pydantic")
    return {
        "wearsim": __version__,
        "kernels": source_hash(),
        "python": platform.python_version(),
        "platform": f"{platform.system()} {platform.machine()}",
        **{name: metadata.version(name) for name in libraries},
    }


def _rating(finding: RatingFinding) -> dict[str, Any]:
    more = {"margin": finding.margin, "used_percent": 100.0 * finding.used, "ok": finding.ok}
    return {**asdict(finding), **more}
