"""Every number of every shipped case, calculation and study: what moves when code moves.

``python tests/golden/net.py`` runs all of them (minutes) and writes ``numbers.csv``; then ``git diff``
shows what moved. With words, only runs whose name holds one of them are renewed.

A row is a column of a table, or a key of an answer: how many numbers it has, the hash of all their
bits, their sum and the sum of their sizes. On the processor and with the libraries of the first line
the bits must be the same; elsewhere the sums, to their last digits.
"""

import contextlib
import csv
import hashlib
import io
import json
import math
import sys
import tempfile
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from importlib.metadata import version
from pathlib import Path
from typing import Any, NamedTuple

from llvmlite import binding as llvm

from wearsim.command.registry import CALCULATIONS

ROOT = Path(__file__).parents[2]
CASES = ROOT / "cases"
FILE = Path(__file__).with_name("numbers.csv")
STUDIES = {
    "teeth-and-tension": ("sweep", "studies/teeth-and-tension.toml", "--threads", "2"),
    "16b-20t-readings": ("calibrate", "16b-20t-oiled.toml", "studies/16b-20t-readings.csv"),
    "uncertainty": ("uncertainty", "16b-20t-oiled.toml", "--samples", "256", "--threads", "2"),
    "sensitivity": ("sensitivity", "16b-20t-oiled.toml", "--samples", "32", "--threads", "2"),
    "optimise": ("optimise", "16b-20t-lightest.toml", "--evaluations", "60", "--threads", "2"),
    "remaining": ("remaining", "16b-20t-oiled.toml", "--hours", "1000", "--depth-mm", "0.1"),
    "solve": ("life", "16b-20t-oiled.toml", "--require-hours", "3000", "--solve-for", "sprocket.teeth"),
    "verify": ("life", "16b-20t-oiled.toml", "--verify-grid"),
    "per-cycle": (
        "life",
        "16b-20t-oiled.toml",
        "--set",
        "stop.critical_depth_mm=0.0001",
        "--set",
        "run.method=per_cycle",
    ),
    "compare": ("compare", "16b-20t-oiled.toml", "10a-20t-drip.toml"),
}
WITHOUT_FOLDER = ("loads", "remaining", "sweep", "uncertainty", "sensitivity", "optimise")
"""Commands that take no ``--out``, or write no more there than their answer says."""

MAINTAINED = "08b-19t-wrap"
"""A life for each policy: half a minute, on others minutes."""

EXPORTED = ("16b-20t-oiled", "08b-19t-oiled", "a40-19t-rating", "pr254-27t-greased")
WORDS = {"true": 1.0, "false": 0.0, "nan": math.nan, "inf": math.inf, "-inf": -math.inf}
LEFT_OUT = ("environment", "seconds")
"""What the machine and the clock decide."""

LAST_DIGITS, ROUNDING = 1e-6, 1e-12
"""Of sums on another processor: part of the size, and what is a rounded zero."""

LIVES = ("life_hours", "sprocket_life_hours", "chain_life_hours")
WRAP_DIGITS = 0.02
"""What runs of wraps are held by on another processor, and how well: a last bit there decides where a roller
seats, and with it the next steps. Two processors gave lives up to 0.4 % apart, of stated errors of 5 %."""

FEW_DIGITS = {"numerical_error": 0.05}
"""The same of columns that are differences of lives nearly alike."""

STEP_DIGITS = {"face-load face-load-mill-drive": 1e-3}
"""The same of runs whose states are those where a controlled step ends, to the tolerance of the steps."""

WRAPS = [path.stem for path in sorted(CASES.glob("*.toml")) if 'kind = "wrap"' in path.read_text("utf-8")]


class Row(NamedTuple):
    run: str
    table: str
    column: str
    count: int
    bits: str
    sum: float
    size: float


def machine() -> str:
    """Name the processor and the libraries on which the last bits depend."""
    # Processors that share a name differ in their instructions, and so in what the compiler makes.
    features = hashlib.sha256(llvm.get_host_cpu_features().flatten().encode()).hexdigest()[:8]
    libraries = ("numpy", "scipy", "numba", "shapely", "pandas")
    return "; ".join(
        [f"{llvm.get_host_cpu_name()} {features}", *(f"{name} {version(name)}" for name in libraries)]
    )


def runs() -> dict[str, tuple[str, ...]]:
    """Return the arguments of each run by its name, but for ``--out`` and ``--json``."""
    found: dict[str, tuple[str, ...]] = {}
    for path in sorted(CASES.glob("*.toml")):
        found[f"life {path.stem}"] = ("life", path.name)
    for stem in WRAPS:
        found[f"loads {stem}"] = ("loads", f"{stem}.toml", "--worst")
    for path in sorted(CASES.glob("sizing/*.toml")):
        [command] = [name for name in CALCULATIONS if path.stem.startswith(name)]
        found[f"{command} {path.stem}"] = ("handbook", command, f"sizing/{path.name}")
    for stem in EXPORTED:
        found[f"export {stem}"] = ("export", f"{stem}.toml")
        found[f"profile {stem}"] = ("profile", f"{stem}.toml")
    found[f"maintain {MAINTAINED}"] = ("maintain", f"{MAINTAINED}.toml")
    return found | {f"{study[0]} {name}": study for name, study in STUDIES.items()}


def result_of(arguments: tuple[str, ...], folder: Path) -> Iterator[tuple[str, str]]:
    """Run a command and yield the name and the text of each table that it gives."""
    import wearsim.cli

    command, *rest = arguments
    words = [str(CASES / word) if word.endswith((".toml", ".csv")) else word for word in rest]
    if command in ("export", "profile"):
        words += ["--out", str(folder / "points.csv")]
    elif command not in WITHOUT_FOLDER and "--solve-for" not in words:
        words += ["--out", str(folder / "out")]
    if command not in ("export", "profile"):
        words.append("--json")
    before, out = sys.argv, io.StringIO()
    sys.argv = ["wearsim", command, *words, "--quiet"]
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(io.StringIO()) as errors:
            wearsim.cli.main()
    except SystemExit as end:
        if end.code not in (None, 0, 4):
            raise RuntimeError(f"{' '.join(sys.argv)}: {end.code}\n{errors.getvalue()}") from None
    finally:
        sys.argv = before
    yield "stdout.json", out.getvalue()
    for path in sorted(folder.rglob("*")):
        if path.suffix in (".csv", ".json"):
            yield path.relative_to(folder).as_posix(), path.read_text("utf-8")


def number(value: object) -> float | None:
    """Return a value as a number, None where it is none."""
    if isinstance(value, bool | int | float):
        return float(value)
    text = str(value).strip()
    try:
        return float(text)
    except ValueError:
        return WORDS.get(text.lower())


def leaves(value: Any, path: str) -> Iterator[tuple[str, float]]:
    """Yield the numbers of an answer with their keys; items of a list share theirs."""
    if isinstance(value, dict):
        for key, part in value.items():
            if not str(key).startswith(LEFT_OUT):
                yield from leaves(part, f"{path}.{key}" if path else str(key))
    elif isinstance(value, list):
        for part in value:
            yield from leaves(part, f"{path}[]")
    elif isinstance(value, bool | int | float):
        yield path, float(value)


def columns(name: str, text: str) -> dict[str, list[float]]:
    """Return the numbers of a table by column, or of an answer by key."""
    found: dict[str, list[float]] = {}
    if name.endswith(".json"):
        for line in text.splitlines() if name.startswith("stdout") else [text]:
            for key, value in leaves(json.loads(line), ""):
                found.setdefault(key, []).append(value)
        return found
    rows = csv.DictReader(line for line in io.StringIO(text) if not line.startswith("#"))
    for row in rows:
        for key, cell in row.items():
            if (value := number(cell)) is not None and not key.startswith(LEFT_OUT):
                found.setdefault(key, []).append(value)
    return found


def rows_of(name: str) -> list[Row]:
    """Run what has this name and return its rows."""
    found = []
    with tempfile.TemporaryDirectory() as folder:
        for table, text in result_of(runs()[name], Path(folder)):
            for column, values in sorted(columns(table, text).items()):
                finite = [value for value in values if math.isfinite(value)]
                sums = (math.fsum(part) for part in (finite, map(abs, finite)))
                rounded = (float(f"{part:.12g}") for part in sums)
                found.append(Row(name, table, column, len(values), bits(values), *rounded))
    return found


def bits(values: list[float]) -> str:
    return hashlib.sha256(" ".join(map(float.hex, values)).encode()).hexdigest()[:16]


def read() -> tuple[str, list[Row]]:
    """Return the machine and the rows of the file."""
    with FILE.open(encoding="utf-8", newline="") as file:
        made_on = file.readline().removeprefix("# ").strip()
        return made_on, [
            Row(*names, int(count), hashed, float(total), float(size))
            for *names, count, hashed, total, size in list(csv.reader(file))[1:]
        ]


def write(rows: list[Row]) -> None:
    with FILE.open("w", encoding="utf-8", newline="") as file:
        file.write(f"# {machine()}\n")
        csv.writer(file, lineterminator="\n").writerows([Row._fields, *rows])


def main(words: list[str]) -> None:
    names = [name for name in runs() if not words or any(word in name for word in words)]
    kept = [row for row in read()[1] if row.run not in names] if words else []
    with ProcessPoolExecutor(2) as pool:
        found = [row for rows in pool.map(rows_of, names) for row in rows]
    write(sorted([*kept, *found]))


if __name__ == "__main__":
    main(sys.argv[1:])
