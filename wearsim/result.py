"""What a simulation hands back: complete, immutable, saves and loads itself."""

from __future__ import annotations

import json
import platform
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from functools import cached_property
from importlib import metadata
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING, Any

import numpy as np

import wearsim
from wearsim.errors import LimitNotReachedError, OutputError
from wearsim.geometry.profile import Vector
from wearsim.kernels.compiled import source_hash

if TYPE_CHECKING:
    import pandas as pd

SCHEMA_VERSION = 1

HISTORY_COLUMNS = (
    "cycles", "time_hours", "max_depth_mm", "peak_pressure_MPa", "max_sliding_speed_mm_per_s",
    "removed_area_mm2", "worn_contact_ratio",
)  # fmt: skip
FLANK_COLUMNS = (
    "cycles", "node", "arc_length_mm", "x_mm", "y_mm", "depth_mm", "pressure_MPa",
    "sliding_speed_mm_per_s", "load_per_width_N_per_mm", "relative_curvature_per_mm",
)  # fmt: skip

_INPUTS = "inputs"
_FILE_KEYS = (("sprocket", "points_file"), ("mechanism", "table_file"))


@dataclass(frozen=True)
class Life:
    """A life that was reached.

    Attributes
    ----------
    cycles : float
        Loading cycles of one gap.
    hours : float
        Running time [h], equation (13).
    """

    cycles: float
    hours: float


@dataclass(frozen=True)
class LowerBound:
    """A run that ended before any limit was met.

    Attributes
    ----------
    cycles_run : float
        Loading cycles that it covers.
    hours_run : float
        Running time that it covers [h].
    """

    cycles_run: float
    hours_run: float

    @property
    def cycles(self) -> float:
        """Raise: the life is not known.

        Raises
        ------
        LimitNotReachedError
            Always, with the bound.
        """
        raise LimitNotReachedError(self._message)

    @property
    def hours(self) -> float:
        """Raise: the life is not known.

        Raises
        ------
        LimitNotReachedError
            Always, with the bound.
        """
        raise LimitNotReachedError(self._message)

    @property
    def _message(self) -> str:
        return (
            f"life: no limit was met within {self.hours_run:g} h ({self.cycles_run:g} cycles), the "
            "life is longer: raise run.horizon_hours"
        )


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
        Where it lies on the unworn flank from the root [mm].
    initial_peak_pressure, final_peak_pressure : float
        Highest Hertz pressure along the flank [MPa].
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
    initial_peak_pressure: float
    final_peak_pressure: float
    speed_rpm: float
    method: str
    updates: int
    numerical_error: float
    life_tolerance: float
    assumptions: tuple[str, ...]
    warnings: tuple[str, ...]
    inputs: Mapping[str, Any]
    input_files: Mapping[str, str]
    history_columns: Mapping[str, Vector]
    flank_columns: Mapping[str, Vector]
    environment: Mapping[str, str]

    @property
    def cycles(self) -> float:
        """Loading cycles to the first limit; raises where it was not reached."""
        return self.life.cycles

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
            "case": self.case,
            "title": self.title,
            "life_hours": _hours(self.life),
            "cycles": self.life.cycles if isinstance(self.life, Life) else None,
            "life_reached": reached,
            "hours_run": self.hours_run,
            "cycles_run": self.cycles_run,
            "life_hours_low": _hours(self.life_low),
            "life_hours_high": _hours(self.life_high),
            "band": self.band,
            "stop": self.stop,
            "stop_value": self.stop_value,
            "max_depth_mm": self.max_depth,
            "max_depth_arc_length_mm": self.max_depth_arc_length,
            "initial_peak_pressure_MPa": self.initial_peak_pressure,
            "final_peak_pressure_MPa": self.final_peak_pressure,
            "speed_rpm": self.speed_rpm,
            "method": self.method,
            "updates": self.updates,
            "numerical_error": self.numerical_error,
            "life_tolerance": self.life_tolerance,
            "assumptions": list(self.assumptions),
            "warnings": list(self.warnings),
        }

    def save(self, folder: str | Path, force: bool = False) -> None:
        """Write the result into a folder, all of it or nothing.

        Parameters
        ----------
        folder : path
            New folder for result.json, case.lock.toml, environment.json, history.csv,
            flank.csv and ``inputs`` with the CSV files of the case.
        force : bool
            Replace a folder that is there.

        Raises
        ------
        OutputError
            The folder is there, or cannot be written.
        """
        from wearsim.output import new_folder

        with new_folder(Path(folder), force) as place:
            bounds = {
                name: asdict(getattr(self, name)) for name in ("life", "life_low", "life_high")
            }
            _write_json(place / "result.json", {**self.summary(), "lives": bounds})
            _write_json(place / "environment.json", dict(self.environment))
            (place / "case.lock.toml").write_text(self._lock(), encoding="utf-8")
            for name, text in self.input_files.items():
                (place / _INPUTS).mkdir(exist_ok=True)
                (place / _INPUTS / name).write_text(text, encoding="utf-8")
            self.history.to_csv(place / "history.csv", index=False)
            self.flank.to_csv(place / "flank.csv", index=False)

    def _lock(self) -> str:
        import tomlkit

        document = tomlkit.document()
        document.add(tomlkit.comment(f"{self.case} with every default taken by wearsim"))
        for key, value in _with_files(self.inputs, _INPUTS).items():
            if value != {}:
                document.add(key, value)
        return tomlkit.dumps(document)

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
        folder = Path(folder)
        try:
            return cls(**_stored(folder))
        except OutputError:
            raise
        except (OSError, ValueError, TypeError, AttributeError, LookupError) as error:
            raise OutputError(
                f"{folder}: must be the folder of a result (result.json, case.lock.toml, "
                f"environment.json, history.csv, flank.csv): {type(error).__name__} {error}"
            ) from None


def _stored(folder: Path) -> dict[str, Any]:
    """Return the fields of a result in a folder."""
    import tomllib

    stored = json.loads((folder / "result.json").read_text(encoding="utf-8"))
    version = stored.get("schema_version")
    if version != SCHEMA_VERSION:
        raise OutputError(
            f"{folder}: result.json must have schema_version {SCHEMA_VERSION}, has "
            f"{version!r}: read it with the wearsim that wrote it"
        )
    lock = tomllib.loads((folder / "case.lock.toml").read_text(encoding="utf-8"))
    inputs = _with_files(lock, "")
    same = (
        "case", "title", "band", "stop", "stop_value", "cycles_run", "hours_run", "speed_rpm",
        "method", "updates", "numerical_error", "life_tolerance",
    )  # fmt: skip
    return {
        **{name: stored[name] for name in same},
        **{name: _life(life) for name, life in stored["lives"].items()},
        "max_depth": stored["max_depth_mm"],
        "max_depth_arc_length": stored["max_depth_arc_length_mm"],
        "initial_peak_pressure": stored["initial_peak_pressure_MPa"],
        "final_peak_pressure": stored["final_peak_pressure_MPa"],
        "assumptions": tuple(stored["assumptions"]),
        "warnings": tuple(stored["warnings"]),
        "inputs": inputs,
        "input_files": {
            name: (folder / _INPUTS / name).read_text(encoding="utf-8") for name in _named(inputs)
        },
        "history_columns": _read_columns(folder / "history.csv", HISTORY_COLUMNS),
        "flank_columns": _read_columns(folder / "flank.csv", FLANK_COLUMNS),
        "environment": json.loads((folder / "environment.json").read_text(encoding="utf-8")),
    }


def environment() -> dict[str, str]:
    """Return what a result depends on beside its inputs.

    Returns
    -------
    dict
        Versions of wearsim and its numerical libraries, Python, platform, kernel hash.
    """
    libraries = ("numpy", "scipy", "shapely", "numba", "pandas", "pydantic")
    return {
        "wearsim": wearsim.__version__,
        "kernels": source_hash(),
        "python": platform.python_version(),
        "platform": f"{platform.system()} {platform.machine()}",
        **{name: metadata.version(name) for name in libraries},
    }


def _hours(life: Life | LowerBound) -> float | None:
    return life.hours if isinstance(life, Life) else None


def _life(stored: dict[str, float]) -> Life | LowerBound:
    return Life(**stored) if "hours" in stored else LowerBound(**stored)


def _named(inputs: Mapping[str, Any]) -> list[str]:
    """Names of the CSV files in a case's tables."""
    return [inputs[table][key] for table, key in _FILE_KEYS if key in inputs.get(table, {})]


def _with_files(inputs: Mapping[str, Any], folder: str) -> dict[str, Any]:
    """Return the tables with the CSV files that they name in another folder."""
    moved = dict(inputs)
    for table, key in _FILE_KEYS:
        if key in inputs.get(table, {}):
            name = PurePosixPath(folder, PurePosixPath(inputs[table][key]).name)
            moved[table] = {**inputs[table], key: str(name)}
    return moved


def _write_json(path: Path, value: Mapping[str, Any]) -> None:
    text = json.dumps(value, indent=2, ensure_ascii=False, allow_nan=False)
    path.write_text(text + "\n", encoding="utf-8")


def _read_columns(path: Path, names: tuple[str, ...]) -> dict[str, Vector]:
    import pandas as pd

    frame = pd.read_csv(path, float_precision="round_trip")
    if frame.empty or tuple(frame) != names:
        raise ValueError(f"{path.name} must hold rows of {', '.join(names)}")
    return {name: np.asarray(frame[name].to_numpy()) for name in names}
