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


def difference(one: Numbers, other: Numbers) -> tuple[float, str]:
    """Return the greatest difference relative to the largest number of its key, with that key."""
    worst = 0.0, "-"
    for key in one.keys() | other.keys():
        if len(one.get(key, ())) != len(other.get(key, ())):
            return math.inf, f"{key}: {len(one.get(key, ()))} and {len(other.get(key, ()))} numbers"
        size = max(map(abs, one[key]), default=0.0) or 1.0
        off = max((abs(a - b) / size for a, b in zip(one[key], other[key], strict=True)), default=0.0)
        worst = max(worst, (off, key))
    return worst


def main() -> None:
    first, *others = sys.argv[1:]
    told = [subprocess.check_output([python, "-c", TELL], text=True).strip() for python in sys.argv[1:]]
    os.environ["PYTHONWARNINGS"] = "ignore"
    lines = [
        "# One case, several environments",
        "",
        "Written by `python research/reproducible.py`. All numbers of `result.json`, `history.csv` and",
        "`flank.csv`, each relative to the largest of its key or column.",
        "",
        *(f"{number}. Python {text}" for number, text in enumerate(told, 1)),
        "",
        f"| case | numbers | {' | '.join(f'{number} - 1' for number, _ in enumerate(others, 2))} | where |",
        "|---|---|" + "---|" * (len(others) + 1),
    ]
    for case in CASES:
        with tempfile.TemporaryDirectory() as folder:
            base = run(first, case, Path(folder))
            off = [difference(base, run(python, case, Path(folder))) for python in others]
        where = max(off)[1] if max(off)[0] > 0.0 else "-"
        count = sum(map(len, base.values()))
        cells = " | ".join(f"{one:.1e}" if one else "0" for one, _ in off)
        lines.append(f"| {case} | {count} | {cells} | {where} |")
        print(lines[-1], file=sys.stderr)
    text = "\n".join(lines) + "\n"
    REPORT.write_text(text, "utf-8")
    print(text)


if __name__ == "__main__":
    main()
