"""How often the stated numerical error of a life holds: random drives against finer references.

``python research/stated_error.py`` (half an hour on two cores, nearly all of it for the wraps)
writes reports/reference/stated_error.csv, with the reference lives, and docs/stated_error.svg.
``python research/stated_error.py strand pair`` renews these kinds only; ``python research/stated_error.py
again`` (some minutes) finds the lives and stated errors anew and keeps the references.

Drives are drawn by kind, ``SEED`` and number. References share neither grids nor estimates with
what they judge:

- strand: lives on 801 and 1601 even points, extrapolated with the first power of the spacing;
- pair: the same on two and four times the points of the case;
- table: its functions on eight times the rows;
- wrap: a quarter of the steps on twice the points and three times the phases.
"""

import csv
import sys
import tempfile
import warnings
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from itertools import count, islice
from pathlib import Path
from typing import Any

import numpy as np
from random_lives import add_limit, add_range, draw, log_uniform, random_wear, tensile_by_rows, uniform

import wearsim
from wearsim.catalogue.catalogues import chains
from wearsim.drive.wear_task import wear_task
from wearsim.drive.wrap_life import wrap_task
from wearsim.geometry.profile_points import Profile
from wearsim.wear.implicit_steps import run_seated
from wearsim.wear.trajectory import Trajectory

SEED = 20261122
DRIVES = {"strand": 300, "table": 100, "pair": 60, "wrap": 120}
ROOT = Path(__file__).parent.parent
FILE = ROOT / "reports" / "reference" / "stated_error.csv"
PICTURE = ROOT / "docs" / "stated_error.svg"
COLUMNS = ("kind", "number", "life_cycles", "stated_error", "reference_cycles")

WRAP_STEPS = 400
"""A wrap that takes more of the largest steps is drawn again: its reference would take minutes."""

WRAP_CHAINS = sorted(
    [f"{size:02}A-1" for size in (8, 10, 12, 16, 20, 24, 28, 32)]
    + [f"{size:02}B-1" for size in (5, 6, 8, 10, 12, 16, 20, 24, 28, 32, 40, 48)]
)
"""Chains whose mass the catalogue had when wraps were first drawn: with others all would be others."""

Tables = dict[str, Any]
Random = np.random.Generator


@dataclass(frozen=True)
class Judged:
    """A drive, its life with the error stated, and the life that this is held against."""

    kind: str
    number: int
    life: float
    stated: float
    reference: float

    @property
    def ratio(self) -> float:
        """Of the true error to the one stated, which below 1e-6 is rounding."""
        return abs(self.life / self.reference - 1.0) / max(self.stated, 1e-6)


def strand_drive(rng: Random) -> Tables:
    """Draw an evolute sprocket on a strand, its nodes and tolerance left to their defaults."""
    names = sorted({chain.designation for chain in chains().values() if chain.strands <= 3})
    chain = chains()[str(rng.choice([name for name in names if name.isascii()]))]
    depth = 0.5 * chain.roller_diameter * log_uniform(rng, 0.005, 0.2)
    wear, _ = random_wear(rng, depth, False)
    tables: Tables = {
        "format_version": 1,
        "chain": {"designation": chain.designation},
        "load": {
            "speed_rpm": log_uniform(rng, 10.0, 1000.0),
            "tension_N": tensile_by_rows(chain) * log_uniform(rng, 0.01, 0.2),
        },
        "wear": wear,
        "stop": {"critical_depth_mm": depth},
        "run": {"horizon_hours": 1e12},
        "sprocket": {"teeth": round(log_uniform(rng, 9, 120)), "profile": "evolute"},
        "mechanism": {"roller_slip_fraction": uniform(rng, 0.05, 1.0)},
    }
    add_range(rng, tables, chain.pitch)
    add_limit(rng, tables, depth)
    return tables


def pair_drive(rng: Random) -> Tables:
    """Draw an involute pair, elastic or rigid."""
    teeth, module = int(rng.integers(12, 40)), log_uniform(rng, 1.0, 10.0)
    width = module * uniform(rng, 5.0, 15.0)
    wear, _ = random_wear(rng, 0.01 * module, False)
    tables: Tables = {
        "format_version": 1,
        "gear": {
            "pinion_teeth": teeth,
            "wheel_teeth": round(teeth * log_uniform(rng, 1.0, 5.0)),
            "module_mm": module,
            "pressure_angle_deg": uniform(rng, 15.0, 25.0),
            "pinion_shift": uniform(rng, -0.2, 0.4),
            "wheel_shift": uniform(rng, -0.2, 0.4),
            "face_width_mm": width,
        },
        "load": {
            "torque_N_m": 5e-4 * width * module**2 * teeth * log_uniform(rng, 0.2, 6.0),
            "speed_rpm": log_uniform(rng, 20.0, 1000.0),
        },
        "wear": wear,
        "stop": {"critical_depth_mm": module * log_uniform(rng, 0.001, 0.05)},
        "run": {"horizon_hours": 1e12},
    }
    if rng.random() < 0.4:
        tables["mechanism"] = {"load_sharing": "rigid"}
    return tables


def wrap_drive(rng: Random) -> Tables:
    """Draw a chain around a sprocket that wears teeth and joints."""
    chain = chains()[str(rng.choice(WRAP_CHAINS))]
    teeth, nodes = round(log_uniform(rng, 11, 60)), 2 * round(log_uniform(rng, 100, 200)) + 1
    mate = round(log_uniform(rng, max(11, teeth / 4), min(120, teeth * 4)))
    profile = str(rng.choice(["iso606", "iso606", "ansi_b29", "gost591"]))
    sprocket: Tables = {
        "teeth": teeth,
        "profile": profile,
        "nodes": nodes,
        "role": str(rng.choice(["driver", "driven"])),
    }
    if profile == "iso606":
        sprocket["form"] = str(rng.choice(["min", "max"]))
    law, rate = str(rng.choice(["archard", "archard", "power"])), log_uniform(rng, 1e-11, 1e-8)
    wear: Tables = {"law": law}
    if law == "archard":
        wear["specific_wear_rate_mm2_per_N"] = rate
    else:
        exponent = uniform(rng, 1.0, 2.5)
        wear |= {"coefficient": rate * 600 ** (1 - exponent), "pressure_exponent": exponent}
    depth = chain.roller_diameter * log_uniform(rng, 0.005, 0.06)
    joint = rate * log_uniform(rng, 0.05, 5.0)
    return {
        "format_version": 1,
        "chain": {"designation": chain.designation},
        "sprocket": sprocket,
        "drive": {"mate_teeth": mate},
        "mechanism": {"kind": "wrap", "roller_slip_fraction": uniform(rng, 0.05, 1.0)},
        "joint": {
            "specific_wear_rate_mm2_per_N": joint,
            "pitch": str(rng.choice(["alternating", "uniform"])),
        },
        "load": {
            "tension_N": tensile_by_rows(chain) * log_uniform(rng, 0.01, 0.12),
            "speed_rpm": log_uniform(rng, 10.0, 1000.0),
        },
        "wear": wear,
        "stop": {"critical_depth_mm": depth},
        "run": {"horizon_hours": 1e9},
    }


def table_drive(rng: Random, folder: Path) -> Callable[[int], Tables]:
    """Draw functions of load and sliding; the first draws of ``random_lives`` that are a table."""
    while True:
        drawn = draw(rng, folder)
        if drawn.kind == "table":
            return lambda fineness: drawn.tables(fineness * (drawn.points - 1) + 1)


def points_life(case: wearsim.Case, flank: Profile | None = None, points: int = 0) -> float:
    """Cycles of a case on a flank, or a number of points, of one's own, with tight steps."""
    mechanism: Any = case.drive.mechanism(case)
    if flank is not None:
        mechanism = replace(mechanism, profile=flank)
    if points:
        mechanism = replace(mechanism, points=points)
    tight = replace(case, run=replace(case.run, life_tolerance=min(1e-4, case.run.life_tolerance)))
    run, _ = wear_task(tight, mechanism.contact).run()
    if run.met is None:
        raise wearsim.ConvergenceError("no life")
    return float(run.cycles[-1])


def extrapolated(coarse: float, fine: float) -> float:
    return 2.0 * fine - coarse


def steps_life(case: wearsim.Case, level: int) -> Trajectory:
    """Wear a wrap by steps that are halved so many times."""
    run = run_seated(wrap_task(case, case.drive.contact(case)), level)
    if run.met is None:
        raise wearsim.ConvergenceError("no life")
    return run


def strand(rng: Random, folder: Path) -> tuple[wearsim.Case, Callable[[], float]]:
    case = wearsim.load_case(strand_drive(rng))
    drive: Any = case.drive

    def on(points: int) -> float:
        places = np.linspace(drive.contact_end, drive.contact_start, points)
        return points_life(case, Profile(*drive.tooth.strand.conjugate_points(places).T))

    return case, lambda: extrapolated(on(801), on(1601))


def pair(rng: Random, folder: Path) -> tuple[wearsim.Case, Callable[[], float]]:
    case = wearsim.load_case(pair_drive(rng))
    drive: Any = case.drive

    def on(fineness: int) -> float:
        return points_life(case, points=fineness * (drive.points - 1) + 1)

    return case, lambda: extrapolated(on(2), on(4))


def table(rng: Random, folder: Path) -> tuple[wearsim.Case, Callable[[], float]]:
    on = table_drive(rng, folder)
    return wearsim.load_case(on(1)), lambda: points_life(wearsim.load_case(on(8)))


def wrap(rng: Random, folder: Path) -> tuple[wearsim.Case, Callable[[], float]]:
    tables = wrap_drive(rng)
    case = wearsim.load_case(tables)

    def reference() -> float:
        if steps_life(case, 0).updates > WRAP_STEPS:
            raise wearsim.ConvergenceError("many steps")
        sprocket = tables["sprocket"]
        double = {**sprocket, "nodes": 2 * sprocket["nodes"] - 1}
        mechanism = {**tables["mechanism"], "phases": 3 * case.drive.phases}
        finer = wearsim.load_case({**tables, "sprocket": double, "mechanism": mechanism})
        return float(steps_life(finer, 2).cycles[-1])

    return case, reference


KINDS = {"strand": strand, "table": table, "pair": pair, "wrap": wrap}


def drive(kind: str, number: int, folder: Path) -> tuple[wearsim.Case, Callable[[], float]]:
    """Return a drive by its number, and what finds its reference."""
    rng = np.random.default_rng([SEED, list(KINDS).index(kind), number])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return KINDS[kind](rng, folder)


def judged(kind: str, number: int, known: float = 0.0) -> Judged | None:
    """Judge one drive, by a reference that is known or found; None where it has no life."""
    with tempfile.TemporaryDirectory() as folder:
        try:
            case, reference = drive(kind, number, Path(folder))
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                expected = known or reference()
                result = wearsim.simulate(case)
        except wearsim.WearsimError:
            return None
    part = result.parts.get("sprocket", result.life)
    return Judged(kind, number, part.cycles_run, result.numerical_error, expected)


def read() -> list[Judged]:
    """Return what the file holds."""
    with FILE.open(encoding="utf-8") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return [
            Judged(
                row["kind"],
                int(row["number"]),
                float(row["life_cycles"]),
                float(row["stated_error"]),
                float(row["reference_cycles"]),
            )
            for row in rows
        ]


def write(rows: list[Judged]) -> None:
    rows.sort(key=lambda row: (list(KINDS).index(row.kind), row.number))
    with FILE.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        for row in rows:
            life, reference = f"{row.life:.10g}", f"{row.reference:.10g}"
            writer.writerow([row.kind, row.number, life, f"{row.stated:.4g}", reference])


def picture(rows: list[Judged]) -> None:
    """Draw how often the true error comes to which part of the one stated."""
    import matplotlib.pyplot as plt

    edges = np.linspace(0.0, 2.0, 41)
    figure, axes = plt.subplots(2, 2, figsize=(8.0, 5.0), sharex=True, layout="constrained")
    for axis, kind in zip(axes.flat, KINDS, strict=True):
        ratios = np.array([row.ratio for row in rows if row.kind == kind])
        axis.hist(ratios.clip(max=edges[-1]), bins=edges, color="tab:blue")
        axis.axvline(1.0, color="tab:red")
        held = f"{(ratios <= 1.0).sum()} of {ratios.size} within"
        axis.set_title(f"{kind}: {held}", fontsize=10)
        axis.set_ylabel("drives")
    for axis in axes[-1]:
        axis.set_xlabel("true error over stated error (2: 2 or more)")
    with plt.rc_context({"svg.hashsalt": "wearsim"}):
        figure.savefig(PICTURE, metadata={"Date": None})


def table_of(rows: list[Judged]) -> list[str]:
    """Return the table of the validation page."""
    lines = [
        "| drives | drawn | stated error holds | largest ratio | true error, median | stated, median |",
        "|---|---|---|---|---|---|",
    ]
    for kind in KINDS:
        ones = [row for row in rows if row.kind == kind]
        if not ones:
            continue
        ratios = [row.ratio for row in ones]
        true = np.median([abs(row.life / row.reference - 1.0) for row in ones])
        cells = (
            kind,
            len(ones),
            sum(ratio <= 1.0 for ratio in ratios),
            f"{max(ratios):.2f}",
            f"{100 * true:.2g} %",
            f"{100 * np.median([row.stated for row in ones]):.2g} %",
        )
        lines.append(f"| {' | '.join(map(str, cells))} |")
    return lines


def judge_all(kind: str) -> Iterator[Judged]:
    """Judge drives of a kind until there are enough, in two processes."""
    wanted, found, numbers = DRIVES[kind], 0, count()
    with ProcessPoolExecutor(2) as pool:
        while found < wanted:
            batch = list(islice(numbers, min(16, 2 * (wanted - found))))
            for row in pool.map(judged, [kind] * len(batch), batch):
                if row is not None and found < wanted:
                    found += 1
                    yield row


def judged_again(rows: list[Judged]) -> list[Judged]:
    """Judge drives by the references that they have."""
    columns = zip(*((row.kind, row.number, row.reference) for row in rows), strict=True)
    with ProcessPoolExecutor(2) as pool:
        return [row for row in pool.map(judged, *columns) if row is not None]


def main() -> None:
    again = sys.argv[1:] == ["again"]
    kinds = [] if again else sys.argv[1:] or list(KINDS)
    rows = [row for row in read() if row.kind not in kinds] if FILE.exists() else []
    for kind in kinds:
        for row in judge_all(kind):
            rows.append(row)
            write(rows)
    if again:
        rows = judged_again(rows)
        write(rows)
    picture(rows)
    print("\n".join(table_of(rows)))


if __name__ == "__main__":
    main()
