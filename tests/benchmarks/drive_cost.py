"""What a drive of two sprockets costs beside the cases of each of them.

``python tests/benchmarks/drive_cost.py > reports/reference/drive_cost.md`` writes the page. Commands run as a
user runs them, kernels compiled, by turns; they count by their median.
"""

import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import tomlkit

from wearsim.drive.load_case import load_drive

ROOT = Path(__file__).parents[2]
DRIVES = ROOT / "cases" / "drives"
PROGRAM = "import wearsim.cli; wearsim.cli.main()"
RUNS = 3

EQUAL = """\
format_version = 1
[chain]
designation = "08B-1"
[[sprocket]]
teeth = 19
profile = "iso606"
nodes = 101
[[sprocket]]
teeth = 19
profile = "iso606"
nodes = 101
[drive]
links = 110
[load]
power_kW = 1.3
speed_rpm = 300
[wear]
condition = "hardened, oiled"
"""


def main() -> None:
    """Print the page."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "equal.toml").write_text(EQUAL)
        drives = {
            "two equal sprockets, 08B-1, 19 teeth": folder / "equal.toml",
            "packaging-conveyor, 21 to 57 teeth": DRIVES / "packaging-conveyor.toml",
            "motorcycle-520, 15 to 43 teeth": DRIVES / "motorcycle-520.toml",
        }
        sys.stdout.writelines(f"{line}\n" for line in page(drives, folder))


def page(drives: dict[str, Path], folder: Path) -> Iterator[str]:
    """Lines of the page."""
    yield "# What a drive costs beside one sprocket"
    yield ""
    cores = len(os.sched_getaffinity(0))
    yield f"By `python tests/benchmarks/drive_cost.py`, Python {platform.python_version()}, {cores} cores."
    yield (
        f"Seconds of a processor and in brackets on a clock, medians of {RUNS} runs of `wearsim life`. One "
        "sprocket is the mean of both cases, each run alone with the teeth of its mate as a number; the goal "
        "is 2.2 times that."
    )
    yield ""
    yield "| drive | first alone | second alone | drive | times one sprocket |"
    yield "|---|---|---|---|---|"
    for text, path in drives.items():
        files = [*alone(path, folder), path]
        runs = [[used(file) for file in files] for _ in range(RUNS)]
        first, second, both = (
            tuple(statistics.median(one[kind] for one in times) for kind in (0, 1))
            for times in zip(*runs, strict=True)
        )
        ratios = [2.0 * both[kind] / (first[kind] + second[kind]) for kind in (0, 1)]
        cells = [f"{one[0]:.1f} ({one[1]:.1f})" for one in (first, second, both)]
        yield f"| {text} | {' | '.join(cells)} | {ratios[0]:.2f} ({ratios[1]:.2f}) |"


def alone(path: Path, folder: Path) -> list[Path]:
    """Write the case of each sprocket with every default taken."""
    files = []
    for one in load_drive(path).sprockets:
        tables = {key: table for key, table in one.case.inputs.items() if table not in ({}, None)}
        files.append(folder / f"{path.stem} {one.name}.toml")
        files[-1].write_text(tomlkit.dumps(tables))
    return files


def used(file: Path) -> tuple[float, float]:
    """Seconds of a processor, and on a clock, that the life of a file takes."""
    start, before = time.perf_counter(), os.times()
    subprocess.run(
        [sys.executable, "-c", PROGRAM, "-q", "life", "--fresh", str(file)],
        check=True,
        stdout=subprocess.DEVNULL,
    )
    after = os.times()
    spent = sum(getattr(after, name) - getattr(before, name) for name in ("children_user", "children_system"))
    return spent, time.perf_counter() - start


if __name__ == "__main__":
    main()
