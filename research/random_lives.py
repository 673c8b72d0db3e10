"""Lives of random feasible cases, with tighter steps and on a finer grid besides.

For ``research/life_tolerance.py``, which makes a table of them. Chains around a sprocket are left
out: one of them takes seconds.
"""

import math
import re
import tempfile
import warnings
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

import wearsim
from wearsim.catalogue.catalogues import Chain, chains
from wearsim.drive.wear_task import wear_task
from wearsim.result import Life, WearResult
from wearsim.wear import trajectory

SEED, CASES = 20261121, 200

STEPS = 0.1
"""Part of the tolerance that the steps may use up."""

ROUNDING = 1e-12
"""Relative difference of two lives that is none."""

MAX_POINTS = 801
"""Of the grid that a life is held against."""

WARNINGS = ("numerical error", "the error of the grid could not be estimated")
"""Starts of the warnings that say that a tolerance may not be met."""

PRESSURE, HARDNESS = 600.0, 6000.0
"""Pressure at which every law of a specific wear rate wears alike; of the drozdov law [MPa]."""

STAND_INS = {f"04B-{strands}": f"05B-{strands}" for strands in (1, 2, 3)}
"""Chains that the catalogue had when the cases were first drawn: without them all would be others."""

DESIGNATIONS = sorted({*(chain.designation for chain in chains().values() if chain.strands <= 3), *STAND_INS})
LIMITS = ("", "", "min_tip_land_mm", "min_tooth_thickness_mm", "case_depth_mm")
FADES = {0: "loaded to the ends", 1: "fading to the ends", 2: "fading smoothly"}

Tables = dict[str, Any]
Columns = Callable[[np.ndarray], dict[str, np.ndarray]]
Random = np.random.Generator


@dataclass(frozen=True)
class Draw:
    """A random case, feasible or not: its tables on a number of points, and what it is."""

    kind: str
    what: str
    points: int
    tolerance: float
    tables: Callable[[int], Tables]


@dataclass(frozen=True)
class Measured:
    """Relative differences of a life from those with tighter steps, and on a far finer grid besides."""

    name: str
    draw: Draw
    stop: str
    stated: float
    warned: bool
    steps: float
    total: float
    complaints: tuple[str, ...]
    """Warnings of Python, not of the result, on the way."""

    @property
    def allowed(self) -> float:
        """What steps and grid may come to: the tolerance, or the error that the result states."""
        return max(self.draw.tolerance, self.stated) + ROUNDING


def tensile_by_rows(chain: Chain) -> float:
    """Return the strength by which loads were first drawn, of B chains N times one row [N]."""
    stem, _, strands = chain.designation.partition("-")
    if not stem.endswith("B") or strands == "1":
        return chain.tensile
    return chain.strands * chains()[f"{stem}-1"].tensile


def log_uniform(rng: Random, low: float, high: float) -> float:
    return float(f"{math.exp(rng.uniform(math.log(low), math.log(high))):.4g}")


def uniform(rng: Random, low: float, high: float) -> float:
    return float(f"{rng.uniform(low, high):.4g}")


def draw(rng: Random, folder: Path) -> Draw:
    """Draw a case; where a value is drawn from that of a default, one without it is loaded."""
    kind = str(rng.choice(["evolute", "points", "table"], p=[0.6, 0.15, 0.25]))
    points, tolerance = round(log_uniform(rng, 61, 401)), log_uniform(rng, 1e-5, 1e-2)
    name = str(rng.choice(DESIGNATIONS))
    chain = chains()[STAND_INS.get(name, name)]
    depth = 0.5 * chain.roller_diameter * log_uniform(rng, 0.005, 0.2)
    local = kind == "table" and rng.random() < 0.5
    wear, law = random_wear(rng, depth, local)
    tables: Tables = {
        "format_version": 1,
        "chain": {"designation": chain.designation},
        "load": {"speed_rpm": log_uniform(rng, 10.0, 1000.0)},
        "wear": wear,
        "stop": {"critical_depth_mm": depth},
        "run": {"life_tolerance": tolerance, "horizon_hours": float(rng.choice([5e4, 1e12]))},
    }
    what = f"{kind}, {chain.designation}, {depth:.2g} mm"
    if kind == "table":
        columns, form = random_columns(rng, chain.roller_diameter, local)
        return Draw(kind, f"{what}, {form}, {law}", points, tolerance, tabled(tables, columns, folder))
    teeth = round(log_uniform(rng, 9, 120))
    tables["sprocket"] = {"teeth": teeth, "profile": "evolute"}
    tables["mechanism"] = {"roller_slip_fraction": uniform(rng, 0.05, 1.0)}
    tables["load"]["tension_N"] = tensile_by_rows(chain) * log_uniform(rng, 0.01, 0.2)
    add_range(rng, tables, chain.pitch)
    if kind == "points":
        replace_flank(rng, tables, folder)
    add_limit(rng, tables, depth)
    return Draw(kind, f"{what}, z = {teeth}, {law}", points, tolerance, on_nodes(tables))


def random_wear(rng: Random, depth: float, local: bool) -> tuple[Tables, str]:
    """Draw a law, sometimes with a hardened layer and with running-in."""
    law, rate = str(rng.choice(["archard", "power", "drozdov"])), log_uniform(rng, 1e-11, 1e-8)
    exponent = 1.0 if law == "archard" else uniform(rng, 0.5 if local else 1.0, 3.0)
    wear: Tables = {"law": law}
    if law == "archard":
        wear["specific_wear_rate_mm2_per_N"] = rate
    elif law == "power":
        wear["coefficient"] = rate * PRESSURE ** (1.0 - exponent)
    else:
        wear["coefficient"] = rate * PRESSURE * (HARDNESS / PRESSURE) ** exponent
        wear |= {"hardness_MPa": HARDNESS, "reference_speed_mm_per_s": 1000.0}
        wear["speed_exponent"] = uniform(rng, -0.5, 1.0)
    if law != "archard":
        wear["pressure_exponent"] = exponent
    name = f"{law} m = {exponent:g}"
    if rng.random() < 0.2:
        part = uniform(rng, 0.05, 1.2)
        wear |= {"case_depth_mm": part * depth, "core_factor": log_uniform(rng, 0.3, 10.0)}
        name += f", core {wear['core_factor']:.2g} below {part:.2g} of the depth"
    if rng.random() < 0.2:
        way = depth / (rate * PRESSURE) * log_uniform(rng, 0.01, 10.0)
        wear |= {"running_in_factor": uniform(rng, 1.5, 10.0), "running_in_distance_mm": way}
        name += f", runs in from {wear['running_in_factor']:.2g}"
    return wear, name


def add_range(rng: Random, tables: Tables, pitch: float) -> None:
    """Draw the range of contact and the evolute offset, or leave them to their defaults."""
    sprocket = tables["sprocket"]
    if rng.random() < 0.5:
        end, ratio = pitch * uniform(rng, 0.08, 0.3), uniform(rng, 1.01, 1.3)
        sprocket |= {"contact_end_mm": end, "contact_start_mm": end + ratio * pitch}
    if rng.random() < 0.5:
        usual = wearsim.load_case(tables).drive.tooth.strand.offset
        sprocket["evolute_offset_mm"] = usual * uniform(rng, 0.97, 2.0)


def replace_flank(rng: Random, tables: Tables, folder: Path) -> None:
    """Put points of the evolute flank in its place, exact or with an error."""
    drive, noise = wearsim.load_case(tables).drive, float(rng.choice([0.0, 1e-6, 1e-5, 1e-4, 1e-3]))
    x = np.linspace(drive.contact_end, drive.contact_start, int(rng.integers(40, 400)))
    places = drive.tooth.strand.conjugate_points(x) + noise * rng.standard_normal((x.size, 2))
    file = folder / "flank.csv"
    np.savetxt(file, places, "%.12g", ",", header="x_mm,y_mm", comments="")
    tables["sprocket"] |= {
        "profile": "points",
        "points_file": str(file),
        "points_noise_mm": noise,
        "evolute_offset_mm": drive.tooth.strand.offset,
    }


def add_limit(rng: Random, tables: Tables, depth: float) -> None:
    """Draw one more limit, or none."""
    part, key = rng.random(), str(rng.choice(LIMITS))
    if key == "case_depth_mm":
        tables["stop"][key] = part * depth
    elif key:
        drive = wearsim.load_case(tables).drive
        new = drive.tip_land if key == "min_tip_land_mm" else drive.pitch_line_thickness
        tables["stop"][key] = new - part * depth


def random_columns(rng: Random, roller: float, local: bool) -> tuple[Columns, str]:
    """Draw smooth load, sliding and curvature along a flank, as functions of 0 to 1."""
    length, squeeze = roller * uniform(rng, 0.2, 1.0), uniform(rng, -0.6, 0.6)
    load, fade = log_uniform(rng, 10.0, 1000.0), int(rng.choice([0, 0, 1, 2]))
    bend, slip = 2.0 / roller * uniform(rng, -0.7, 1.0), log_uniform(rng, 0.05, 1.0)
    order = np.arange(1, 4)
    waves, phases = rng.normal(0.0, 0.25, (4, 3)) / order, rng.uniform(0.0, 2.0 * np.pi, (4, 3))

    def columns(u: np.ndarray) -> dict[str, np.ndarray]:
        angles = np.pi * order[:, None] * u
        shape = [np.exp(waves[i] @ np.sin(angles + phases[i][:, None])) for i in range(4)]
        return {
            "arc_length_mm": length * (u + squeeze * np.sin(2.0 * np.pi * u) / (2.0 * np.pi)),
            "load_per_width_N_per_mm": load * shape[0] * np.sin(np.pi * u).clip(0.0) ** fade,
            "flank_curvature_per_mm": bend * shape[1],
            "sliding_distance_mm" if local else "slip_ratio": slip * shape[2],
            "sliding_speed_mm_per_s": 300.0 * shape[3],
        }

    return columns, f"{'given path' if local else 'given slip ratio'}, {FADES[fade]}"


def tabled(tables: Tables, columns: Columns, folder: Path) -> Callable[[int], Tables]:
    def on(points: int) -> Tables:
        found, file = columns(np.linspace(0.0, 1.0, points)), folder / "table.csv"
        rows = np.column_stack(list(found.values()))
        np.savetxt(file, rows, "%.15g", ",", header=",".join(found), comments="")
        return {**tables, "mechanism": {"kind": "prescribed", "table_file": str(file)}}

    return on


def on_nodes(tables: Tables) -> Callable[[int], Tables]:
    return lambda points: {**tables, "sprocket": {**tables["sprocket"], "nodes": points}}


def difference(result: WearResult, better: WearResult) -> float:
    """Of the lives; of the depths where a run ended at the horizon."""
    if isinstance(result.life, Life) and isinstance(better.life, Life):
        return abs(result.life.cycles / better.life.cycles - 1.0)
    return abs(result.max_depth / better.max_depth - 1.0)


def reason(stage: str, error: wearsim.WearsimError) -> str:
    """What a draw was refused for, without numbers and places."""
    text = str(error).split("\n")[0]
    if isinstance(error, wearsim.CaseError):
        text = f"{error.faults[0].key}: {error.faults[0].message}"
    text = re.sub(r"( at cycle [^,]*)?, \S+ mm from the root", "", text)
    text = re.split(r"[,;(]|: use", text)[0]
    text = re.sub(r"(?<![\w.])[-+]?\d[\d.]*(e[-+]?\d+)?", "..", text).strip()
    return f"{stage} | {type(error).__name__} | {text}"


def finer_points(points: int) -> int:
    four = 4 * points - 3
    return four if four <= MAX_POINTS else 2 * points - 1


def attempt(name: str, rng: Random, folder: Path, refused: Counter[str]) -> Measured | None:
    """Draw a case and run it, with tighter steps, and with these on four times the points.

    Twice the points are too few: a flank refined by itself may be better than those. Where four
    times are more than ``MAX_POINTS`` it is twice: histories of more take gigabytes.
    """
    stage = "the case itself"
    try:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            drawn = draw(rng, folder)
            case = wearsim.load_case(drawn.tables(drawn.points))
            stage = "its run"
            result = wearsim.simulate(case)
            tighter = replace(case.run, life_tolerance=0.1 * drawn.tolerance)
            stage = "with a tenth of the tolerance"
            contact = case.drive.mechanism(case).contact
            loose, tight = (
                wear_task(replace(case, run=run), contact).run()[0] for run in (case.run, tighter)
            )
            stage = "with that on four times the points"
            finer = wearsim.load_case(drawn.tables(finer_points(drawn.points)))
            fine = wearsim.simulate(replace(finer, run=tighter))
    except wearsim.WearsimError as error:
        refused[reason(stage, error)] += 1
        return None
    complaints = tuple(str(warning.message) for warning in caught)
    errors = trajectory.difference(loose, tight), difference(result, fine)
    warned = any(text.startswith(WARNINGS) for text in result.warnings)
    return Measured(name, drawn, result.stop, result.numerical_error, warned, *errors, complaints)


def measured(numbers: Iterable[int]) -> tuple[list[Measured], Counter[str]]:
    """Cases by their numbers, each drawn until one is feasible, and what the others lacked."""
    found: list[Measured] = []
    refused: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as folder:
        for number in numbers:
            case, tries = None, 0
            while case is None:
                rng = np.random.default_rng([SEED, number, tries])
                case = attempt(f"{number}.{tries}", rng, Path(folder), refused)
                tries += 1
            found.append(case)
    return found, refused
