"""One case in several environments: how far their numbers differ.

``python research/reproducible.py PYTHON PYTHON ...`` runs shipped cases with each interpreter, in which
wearsim must be installed, and writes reports/reference/reproducible.md. Numbers are compared with those of
the first interpreter, each relative to the largest of its key or column.
"""

import csv
import json
import math
import os
import subprocess
import sys
import tempfile
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import Any

REPORT = Path(__file__).parents[1] / "reports" / "reference" / "reproducible.md"

CASES = (
    *("16b-20t-oiled", "10a-20t-drip", "pr254-27t-greased", "nylon-19t-dry", "beet-harvester-18t-soil"),
    *("fzg-c14-16t-mild", "constant-stress-36t-mild", "hertz-arc-prescribed"),
    *("08b-19t-wrap", "bicycle-17t-lubricants", "d6-crawler-27t-wrap", "packaging-conveyor"),
)

TELL = """
import platform
from importlib.metadata import version
names = "numpy", "scipy", "numba", "shapely", "pandas"
print(platform.python_version(), *(f"{name} {version(name)}" for name in names), sep=", ")
"""

LEFT_OUT = ("environment", "seconds", "wearsim_version", "inputs")
"""Keys that the machine and the clock decide."""

GROUPS = ("lives", "other answers", "tables")
"""Hours and cycles of JSON, its other numbers, and the columns of CSV files."""

MOST = 1e-10
"""Relative difference of lives that is allowed."""

Numbers = dict[str, list[float]]


def numbers_of(value: Any, key: str = "") -> Iterator[tuple[str, float]]:
    """Yield all numbers of an answer with their keys; those of a list have one key."""
    if isinstance(value, dict):
        for name, part in value.items():
            if name not in LEFT_OUT:
                yield from numbers_of(part, f"{key}.{name}".strip("."))
    elif isinstance(value, list):
        for part in value:
            yield from numbers_of(part, key)
    elif isinstance(value, int | float) and not isinstance(value, bool):
        yield key, float(value)


def run(python: str, case: str, folder: Path) -> Numbers:
    """Return all numbers that a life writes."""
    out = folder / "out"
    subprocess.run(
        [python, "-m", "wearsim", "life", case, "--quiet", "--force", "--out", str(out)],
        cwd=folder,
        check=True,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    found: Numbers = defaultdict(list)
    for path in sorted(out.rglob("*.json")):
        if path.name != "environment.json":
            for key, number in numbers_of(json.loads(path.read_text("utf-8"))):
                found[f"{path.relative_to(out)} {key}"].append(number)
    for path in sorted(out.rglob("*.csv")):
        for row in csv.DictReader(path.read_text("utf-8").splitlines()):
            for column, cell in row.items():
                if cell.replace(".", "").replace("-", "").replace("+", "").replace("e", "").isdigit():
                    found[f"{path.relative_to(out)} {column}"].append(float(cell))
    return found


def group(key: str) -> str:
    """Return which of the groups a key belongs to."""
    if ".csv" in key:
        return "tables"
    return "lives" if "hours" in key or "cycles" in key else "other answers"


def differences(one: Numbers, other: Numbers) -> dict[str, tuple[float, str]]:
    """Return the greatest differences relative to the largest number of their keys, with those keys."""
    worst = dict.fromkeys(GROUPS, (0.0, "-"))
    for key in one.keys() | other.keys():
        counts = len(one.get(key, ())), len(other.get(key, ()))
        if counts[0] != counts[1]:
            found = math.inf, f"{key}: {counts[0]} and {counts[1]} numbers"
        else:
            size = max(map(abs, one[key]), default=0.0) or 1.0
            pairs = zip(one[key], other[key], strict=True)
            found = max((abs(a - b) / size for a, b in pairs), default=0.0), key
        worst[group(key)] = max(worst[group(key)], found)
    return worst


def main() -> None:
    first, *others = sys.argv[1:]
    told = [subprocess.check_output([python, "-c", TELL], text=True).strip() for python in sys.argv[1:]]
    os.environ["PYTHONWARNINGS"] = "ignore"
    lines = [
        "# One case, several environments",
        "",
        "Written by `python research/reproducible.py`. All numbers of `result.json`, `history.csv` and",
        "`flank.csv`, each relative to the largest of its key or column: the greatest difference from the",
        f"first environment of lives (hours and cycles; {MOST:g} allowed), of other answers, and of the",
        "columns of tables.",
        "",
        *(f"{number}. Python {text}" for number, text in enumerate(told, 1)),
        "",
        f"| case | numbers | environment | {' | '.join(GROUPS)} | the greatest of them |",
        "|---|---|---|" + "---|" * (len(GROUPS) + 1),
    ]
    worst = 0.0
    for case in CASES:
        with tempfile.TemporaryDirectory() as folder:
            base = run(first, case, Path(folder))
            for number, python in enumerate(others, 2):
                off = differences(base, run(python, case, Path(folder)))
                cells = " | ".join(f"{off[name][0]:.1e}" if off[name][0] else "0" for name in GROUPS)
                worst = max(worst, off["lives"][0])
                most, where = max(off.values())
                where = where if most else "-"
                lines.append(f"| {case} | {sum(map(len, base.values()))} | {number} | {cells} | {where} |")
                print(lines[-1], file=sys.stderr)
    text = "\n".join(lines) + "\n"
    REPORT.write_text(text, "utf-8")
    print(text)
    sys.exit(worst > MOST)


if __name__ == "__main__":
    main()
