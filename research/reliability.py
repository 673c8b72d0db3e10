"""Random drives of every mechanism: each has a life or a named error, and twins of it agree.

``python research/reliability.py`` (half an hour on two cores) writes reports/reference/reliability.md;
``--minutes 5`` ends after five minutes with what has been drawn by then, in random order.

Drives are drawn as for research/stated_error.py, with another seed, and whole drives besides. A twin is
the same drive said otherwise, or one whose life is known from the first: where both have a life, their
lives must agree within what they state.
"""

import argparse
import math
import multiprocessing
import random
import tempfile
import time
import warnings
from collections import Counter
from collections.abc import Callable, Iterator
from copy import deepcopy
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from random_lives import log_uniform, reason, tensile_by_rows, uniform
from stated_error import WRAP_CHAINS, pair, pair_drive, strand, strand_drive, table, table_drive, wrap_drive

import wearsim
from wearsim.catalogue.catalogues import chains

SEED = 20261128
DRIVES = {"strand": 700, "pair": 400, "table": 400, "wrap": 350, "whole": 150}
BUDGET = {"strand": 10.0, "pair": 10.0, "table": 10.0, "wrap": 25.0, "whole": 60.0}
"""Seconds of processor time that one life may take."""

REPORT = Path(__file__).parent.parent / "reports" / "reference" / "reliability.md"

COLUMNS = (
    "drives",
    "drawn",
    "have a life",
    "refused by name",
    "twins",
    "broken",
    "late",
    "s, median",
    "s, most",
    "true error within the stated",
)

ROUNDING, OF_STATED = 1e-5, 1e-3
"""Relative difference of lives that is none, where a twin is the same numbers but for last bits, and the part
of the stated errors that it may have besides: steps may fall otherwise."""

UNITS = {"tension_N": ("kN", 1e-3), "power_kW": ("W", 1e3), "torque_N_m": ("N*mm", 1e3)}
"""Other units of a load, and how many of them one of the key's is."""

Tables = dict[str, Any]
Random = np.random.Generator
Reference = Callable[[], float]


@dataclass(frozen=True)
class Twin:
    """A drive whose lives are ``factor`` times those of another, exact or within what both state."""

    name: str
    tables: Tables
    factor: float
    exact: bool


@dataclass
class Outcome:
    """What became of one drive."""

    kind: str
    number: int
    seconds: float = 0.0
    refused: str = ""
    failed: list[str] = field(default_factory=list)
    """What sprockets of a drive ended with, where others have their lives."""
    broken: list[str] = field(default_factory=list)
    twins: Counter[str] = field(default_factory=Counter)
    apart: float = 0.0
    """Greatest relative difference of the lives of twins with the same numbers."""
    ratio: float = math.nan
    """True error over the stated one, where there is a reference."""


def whole_drive(rng: Random) -> Tables:
    """Draw a chain around two sprockets, or three, with an idler on a spring that takes up the slack."""
    chain = chains()[str(rng.choice(WRAP_CHAINS))]
    driver, driven = round(log_uniform(rng, 13, 30)), round(log_uniform(rng, 13, 80))
    distance = chain.pitch * max(uniform(rng, 20.0, 60.0), 0.25 * (driver + driven))
    radius = driver * chain.pitch / (2.0 * math.pi)
    speed, pull = log_uniform(rng, 20.0, 800.0), tensile_by_rows(chain) * log_uniform(rng, 0.01, 0.1)
    sprockets: list[Tables] = [
        {"name": "driver", "role": "driver", "teeth": driver},
        {"name": "driven", "role": "driven", "teeth": driven},
    ]
    tables: Tables = {
        "format_version": 1,
        "chain": {"designation": chain.designation},
        "load": {"power_kW": 1e-6 * pull * radius * speed * math.pi / 30.0, "speed_rpm": speed},
        "wear": {"condition": str(rng.choice(["hardened, oiled", "hardened, greased", "hardened, dry"]))},
        "service": {"hours_per_day": uniform(rng, 1.0, 24.0)},
    }
    if rng.random() < 0.5:
        sprockets += placed(rng, sprockets, chain.pitch, distance, pull)
    else:
        tables["drive"] = {"centre_distance_mm": distance}
    for sprocket in sprockets:
        sprocket |= {
            "profile": "ansi_b29" if "A" in chain.designation and rng.random() < 0.5 else "iso606",
            "nodes": 101,
        }
    return {**tables, "sprocket": sprockets}


def placed(rng: Random, two: list[Tables], pitch: float, distance: float, pull: float) -> list[Tables]:
    """Place two sprockets beside each other, and return an idler that presses on the slack span above."""
    two[0]["position_mm"], two[1]["position_mm"] = [0.0, 0.0], [distance, 0.0]
    teeth = round(log_uniform(rng, 13, 25))
    height = pitch * (max(two[0]["teeth"], two[1]["teeth"], teeth) + teeth) / (2.0 * math.pi)
    idler = {"name": "idler", "role": "idler", "teeth": teeth, "outside": True}
    idler["position_mm"] = [distance * uniform(rng, 0.35, 0.65), height]
    force = pull * uniform(rng, 0.02, 0.1)
    idler["take_up"] = {
        "tensioner_force_N": force,
        "guide_deg": 270,
        "travel_mm": [-3.0 * pitch, 3.0 * pitch],
    }
    return [idler]


def drawn(kind: str, number: int, folder: Path) -> Tables:
    """Return the tables of a drive by its number."""
    rng = np.random.default_rng([SEED, list(DRIVES).index(kind), number])
    match kind:
        case "strand":
            return strand_drive(rng)
        case "pair":
            return pair_drive(rng)
        case "table":
            return table_drive(rng, folder)(1)
        case "wrap":
            return wrap_drive(rng)
        case _:
            return whole_drive(rng)


def reference(kind: str, number: int, folder: Path) -> Reference | None:
    """Return what finds the life on a far finer grid; wraps have theirs in stated_error.csv."""
    finders = {"strand": strand, "pair": pair, "table": table}
    if kind not in finders:
        return None
    rng = np.random.default_rng([SEED, list(DRIVES).index(kind), number])
    return finders[kind](rng, folder)[1]


def twins(kind: str, tables: Tables) -> Iterator[Twin]:
    """Yield the twins of a drive: units, wear coefficient, speed, order and place of its sprockets."""
    yield in_other_units(tables)
    if kind == "whole":
        yield reordered(tables)
        if "drive" not in tables:
            yield turned(tables)
        return
    if "running_in_factor" not in tables["wear"]:
        yield worn_twice_as_fast(tables)
    if kind in ("strand", "pair") and tables["wear"]["law"] != "drozdov":
        faster = deepcopy(tables)
        faster["load"]["speed_rpm"] *= 2.0
        yield Twin("twice the speed", faster, 0.5, exact=True)


def in_other_units(tables: Tables) -> Twin:
    said = deepcopy(tables)
    load = said["load"]
    for key in UNITS.keys() & load.keys():
        unit, size = UNITS[key]
        load[key] = f"{load[key] * size!r} {unit}"
    load["speed_rpm"] = f"{load['speed_rpm']!r} rpm"
    return Twin("other units", said, 1.0, exact=True)


def worn_twice_as_fast(tables: Tables) -> Twin:
    faster = deepcopy(tables)
    for table_name, keys in (
        ("wear", ("specific_wear_rate_mm2_per_N", "coefficient")),
        ("joint", ("specific_wear_rate_mm2_per_N",)),
    ):
        for key in keys:
            if key in faster.get(table_name, {}):
                faster[table_name][key] *= 2.0
    return Twin("twice the coefficients", faster, 0.5, exact=False)


def turned(tables: Tables) -> Twin:
    """Return the drive with its places turned by a third of a right angle and moved."""
    said = deepcopy(tables)
    cos, sin = math.cos(math.pi / 6.0), math.sin(math.pi / 6.0)
    for sprocket in said["sprocket"]:
        x, y = sprocket["position_mm"]
        sprocket["position_mm"] = [120.0 + cos * x - sin * y, -45.0 + sin * x + cos * y]
        if "take_up" in sprocket:
            sprocket["take_up"]["guide_deg"] += 30
    return Twin("turned and moved", said, 1.0, exact=False)


def reordered(tables: Tables) -> Twin:
    """Return the drive with its sprockets listed from the second one on."""
    said = deepcopy(tables)
    first, *others = said["sprocket"]
    said["sprocket"] = [*others, first]
    return Twin("another first sprocket", said, 1.0, exact=False)


def lives(tables: Tables) -> tuple[dict[str, wearsim.WearResult], dict[str, wearsim.WearsimError]]:
    """Return the results of the parts of a drive, and what the runs of the others ended with."""
    result = wearsim.simulate(tables)
    if isinstance(result, wearsim.DriveLife):
        return result.results, result.failed
    return {"sprocket": result}, {}


def faults(name: str, result: wearsim.WearResult) -> Iterator[str]:
    """Yield what no result may hold: no number, or a flank that grew.

    A column that does not apply is blank, and one of the flank where nothing touches.
    """
    pressure = result.flank_columns.get("pressure_MPa")
    bare = False if pressure is None else pressure == 0.0
    for columns, blank in ((result.history_columns, False), (result.flank_columns, bare)):
        for column, values in columns.items():
            numbers = np.asarray(values)
            if numbers.dtype.kind != "f" or np.isnan(numbers).all():
                continue
            if not (np.isfinite(numbers) | blank).all():
                yield f"{name}: {column} is not finite"
            if "depth" in column and np.nanmin(numbers) < 0.0:
                yield f"{name}: {column} is negative, {np.nanmin(numbers):g}"
    if not 0.0 < result.cycles_run < math.inf or not result.numerical_error >= 0.0:
        yield f"{name}: {result.cycles_run} cycles, stated error {result.numerical_error}"


def compare(twin: Twin, first: dict[str, wearsim.WearResult], outcome: Outcome) -> None:
    """Note where the lives of a twin are other than those of the first."""
    outcome.twins[twin.name] += 1
    try:
        other, _ = lives(twin.tables)
    except wearsim.WearsimError as error:
        # A drive that lasts may be refused where it wears further in the same time.
        if twin.factor == 1.0 or all(isinstance(result.life, wearsim.Life) for result in first.values()):
            outcome.broken.append(f"{twin.name}: {reason('refused', error)}")
        return
    for name in first.keys() & other.keys():
        lone, twinned = first[name].life, other[name].life
        if not isinstance(lone, wearsim.Life) or not isinstance(twinned, wearsim.Life):
            continue
        both = first[name].numerical_error + other[name].numerical_error
        allowed = ROUNDING + (OF_STATED * both if twin.exact else both)
        difference = abs(twinned.hours / (twin.factor * lone.hours) - 1.0)
        if twin.exact:
            outcome.apart = max(outcome.apart, difference)
        if difference > allowed:
            outcome.broken.append(f"{twin.name}: {name} off by {difference:.2g}, {allowed:.2g} allowed")


def tried(job: tuple[str, int]) -> Outcome:
    """Run one drive, its twins and, where there is one, its reference."""
    outcome = Outcome(*job)
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            _try(outcome, Path(folder))
        except wearsim.WearsimError as error:
            outcome.refused = reason("its run", error)
        except Exception as error:
            outcome.broken.append(f"{type(error).__name__}: {error}")
    return outcome


def _try(outcome: Outcome, folder: Path) -> None:
    begun = time.process_time()
    try:
        tables = drawn(outcome.kind, outcome.number, folder)
        first, failed = lives(tables)
    finally:
        outcome.seconds = time.process_time() - begun
    outcome.failed = [reason("a sprocket", error) for error in failed.values()]
    outcome.broken = [fault for name, result in first.items() for fault in faults(name, result)]
    for twin in twins(outcome.kind, tables):
        compare(twin, first, outcome)
    outcome.ratio = true_over_stated(outcome.kind, outcome.number, folder, first)


def true_over_stated(kind: str, number: int, folder: Path, first: dict[str, wearsim.WearResult]) -> float:
    finder, result = reference(kind, number, folder), next(iter(first.values()))
    if finder is None or not isinstance(result.life, wearsim.Life):
        return math.nan
    try:
        return abs(result.life.cycles / finder() - 1.0) / max(result.numerical_error, 1e-6)
    except wearsim.WearsimError:
        return math.nan


def row(kind: str, found: list[Outcome]) -> str:
    """Return a row of the report's table."""
    lasting = [one for one in found if not one.refused]
    ratios = np.array([one.ratio for one in lasting if math.isfinite(one.ratio)])
    seconds = [one.seconds for one in found]
    within = f"{np.sum(ratios <= 1.0)} of {ratios.size}" if ratios.size else "not judged here"
    cells = (
        kind,
        len(found),
        len(lasting),
        len(found) - len(lasting),
        sum(sum(one.twins.values()) for one in found),
        sum(bool(one.broken) for one in found),
        sum(second > BUDGET[kind] for second in seconds),
        f"{np.median(seconds):.2g}",
        f"{max(seconds):.2g}",
        within,
    )
    return f"| {' | '.join(map(str, cells))} |"


def report(found: dict[str, list[Outcome]]) -> str:
    """Return the page."""
    refused = Counter(one.refused for ones in found.values() for one in ones if one.refused)
    failed = Counter(text for ones in found.values() for one in ones for text in one.failed)
    broken = [
        f"{one.kind} {one.number}: {fault}" for ones in found.values() for one in ones for fault in one.broken
    ]
    late = [
        f"{one.kind} {one.number}: {one.seconds:.0f} s"
        for ones in found.values()
        for one in ones
        if one.seconds > BUDGET[one.kind]
    ]
    apart = max(one.apart for ones in found.values() for one in ones)
    budgets = ", ".join(f"{kind} {seconds:g}" for kind, seconds in BUDGET.items())
    return "\n".join(
        [
            "# Random drives: a life, or a named error",
            "",
            "Written by `python research/reliability.py`. Twins are the same drive in other units, with",
            "twice the coefficients, twice the speed, its places turned and moved, or its sprockets in",
            f"another order: their lives must agree, to {ROUNDING:g} and a thousandth of the stated",
            f"errors where the numbers are the same (a last bit moved one by {apart:.2g} at most), within",
            "the stated errors where they are not. *Broken* are drives with a fault: no number, a negative",
            "depth, a twin that disagrees, any other error. *Late* are those that took more processor time",
            f"than {budgets} seconds. *True error* is that against a far finer run.",
            "",
            "Besides: `kills.md` (commands killed while they write), `soak.md` (memory over 2000 runs),",
            "`scale.md` (a million lives, workers lost) and `reproducible.md` (Pythons and libraries);",
            "mutated inputs are made by `python research/fuzz.py`, and what it found is in tests/corpus.",
            "",
            f"{sum(map(len, found.values()))} of {sum(DRIVES.values())} drives, in random order.",
            "",
            f"| {' | '.join(COLUMNS)} |",
            f"|{'---|' * len(COLUMNS)}",
            *(row(kind, ones) for kind, ones in found.items() if ones),
            "",
            "Wraps against finer runs: reports/reference/stated_error.csv.",
            "",
            "## Refused",
            "",
            *(f"- {times} times: {text}" for text, times in refused.most_common()),
            "",
            "## Sprockets without a life, where the others of the drive have theirs",
            "",
            *([f"- {times} times: {text}" for text, times in failed.most_common()] or ["None."]),
            "",
            "## Broken",
            "",
            *([f"- {line}" for line in broken] or ["None."]),
            "",
            "## Late",
            "",
            *([f"- {line}" for line in late] or ["None."]),
            "",
        ]
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=math.inf)
    until = time.monotonic() + 60.0 * parser.parse_args().minutes
    jobs = [(kind, number) for kind, drives in DRIVES.items() for number in range(drives)]
    random.Random(SEED).shuffle(jobs)  # noqa: S311
    found: dict[str, list[Outcome]] = {kind: [] for kind in DRIVES}
    with multiprocessing.Pool(2) as pool:
        for outcome in pool.imap_unordered(tried, jobs):
            found[outcome.kind].append(outcome)
            if time.monotonic() > until:
                break
    text = report(found)
    REPORT.write_text(text, "utf-8")
    print(text)


if __name__ == "__main__":
    main()
