"""Two thousand runs in one process: memory and open files before and after.

``python research/soak.py`` (some minutes) draws strands, pairs of gears, tables of loads and coarse wraps by
turns, as research/reliability.py does, and writes reports/reference/soak.md. ``--runs 100`` takes fewer and
prints only.
"""

import argparse
import ctypes
import gc
import os
import sys
import tempfile
import warnings
from collections import Counter
from pathlib import Path

import numpy as np
from reliability import drawn, lives

import wearsim

REPORT = Path(__file__).parents[1] / "reports" / "reference" / "soak.md"
KINDS = (*4 * ("strand", "pair", "strand", "table"), "strand", "pair", "strand", "wrap")
EVERY = 50
"""Runs between two readings of the memory."""

SLOPE = 1000.0
"""Bytes a run that memory may grow by."""


def resident() -> int:
    """Return the memory of this process that is in use [bytes]."""
    pages = Path("/proc/self/statm").read_text("ascii").split()[1]
    return int(pages) * os.sysconf("SC_PAGE_SIZE")


def open_files() -> int:
    return len(list(Path("/proc/self/fd").iterdir()))


def ended(number: int, folder: Path) -> str:
    """Run a drive, save and load its folder, and say how it ended."""
    kind = KINDS[number % len(KINDS)]
    try:
        tables = drawn(kind, number, folder)
        tables.setdefault("run", {})["life_tolerance"] = 0.1
        result = lives(tables)[0]["sprocket"]
    except wearsim.WearsimError:
        return f"{kind} refused"
    result.save(folder / "run", force=True)
    wearsim.WearResult.load(folder / "run")
    return kind


def slope_of(readings: list[int]) -> tuple[float, float]:
    """Return how much readings grow by a run, with a standard error, after the first quarter.

    That quarter loads libraries and fills caches.
    """
    late = readings[len(readings) // 4 :]
    fit, spread = np.polyfit(EVERY * np.arange(len(late)), late, 1, cov=True)
    return float(fit[0]), float(np.sqrt(spread[0, 0]))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=2000)
    runs: int = parser.parse_args().runs
    warnings.simplefilter("ignore")
    ends: Counter[str] = Counter()
    memory, blocks, files = [], [], []
    with tempfile.TemporaryDirectory() as folder:
        for number in range(runs):
            ends[ended(number, Path(folder))] += 1
            if number % EVERY == EVERY - 1:
                gc.collect()
                ctypes.CDLL(None).malloc_trim(0)
                memory.append(resident())
                blocks.append(sys.getallocatedblocks())
                files.append(open_files())
    slope, error = slope_of(memory)
    more_blocks, blocks_error = slope_of(blocks)
    rows = "\n".join(
        f"| {EVERY * number} | {used / 1e6:.1f} | {held} | {count} |"
        for number, (used, held, count) in enumerate(zip(memory, blocks, files, strict=True), 1)
        if number % 5 == 0 or number == 1
    )
    mixed = ", ".join(f"{count} {name}" for name, count in sorted(ends.items()))
    text = f"""# Two thousand runs in one process

Written by `python research/soak.py`: {mixed}.
Each is saved and loaded. After the first quarter memory grows by {slope:.0f} bytes a run with a standard
error of {error:.0f}, as it goes up and down by some megabytes ({SLOPE:.0f} allowed; the script fails where
the slope is more by two standard errors), and blocks of Python's objects by {more_blocks:.2f} a run with
one of {blocks_error:.2f}. {files[-1] - files[0]} more files are open at the end than
at the first reading.

| runs | memory, MB | blocks | open files |
|---|---|---|---|
{rows}
"""
    if runs == 2000:
        REPORT.write_text(text, "utf-8")
    print(text)
    sys.exit(slope > SLOPE + 2.0 * error or files[-1] > files[0])


if __name__ == "__main__":
    main()
