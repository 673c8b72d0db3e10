"""Two thousand runs in one process: memory and open files before and after.

``python research/soak.py`` (about an hour) draws strands, pairs of gears, tables of loads and coarse
wraps by turns, as research/reliability.py does, and writes reports/reference/soak.md. ``--runs 100`` takes
fewer and prints only. The runs are made twice side by side: with glibc as it is, which gives each thread an
arena of its own and keeps what is free at the end of it, and with MALLOC_ARENA_MAX=1, where all threads share
one that is given back.
"""

import argparse
import ctypes
import gc
import json
import os
import subprocess
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


class _Heap(ctypes.Structure):
    """What mallinfo2 of glibc 2.33 and later tells of all arenas, in bytes: mallinfo(3)."""

    _fields_ = tuple(
        (name, ctypes.c_size_t)
        for name in (
            *("arena", "ordblks", "smblks", "hblks", "hblkhd"),
            *("usmblks", "fsmblks", "uordblks", "fordblks", "keepcost"),
        )
    )


def allocated() -> int:
    """Return what is allocated from the C library and not freed yet [bytes]."""
    mallinfo = ctypes.CDLL(None).mallinfo2
    mallinfo.restype = _Heap
    heap = mallinfo()
    return int(heap.uordblks + heap.hblkhd)


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


def soaked(runs: int) -> dict[str, object]:
    """Return the ends of the runs and the readings of memory, blocks and files."""
    warnings.simplefilter("ignore")
    ends: Counter[str] = Counter()
    memory, in_use, blocks, files = [], [], [], []
    with tempfile.TemporaryDirectory() as folder:
        for number in range(runs):
            ends[ended(number, Path(folder))] += 1
            if number % EVERY == EVERY - 1:
                gc.collect()
                ctypes.CDLL(None).malloc_trim(0)
                memory.append(resident())
                in_use.append(allocated())
                blocks.append(sys.getallocatedblocks())
                files.append(open_files())
    return {"ends": ends, "memory": memory, "in_use": in_use, "blocks": blocks, "files": files}


def side_by_side(runs: int) -> tuple[dict, dict]:
    """Return what is read with an arena for each thread and with one for all."""
    command = [sys.executable, __file__, "--runs", str(runs), "--readings"]
    env = {name: value for name, value in os.environ.items() if not name.startswith("MALLOC_")}
    both = [
        subprocess.Popen(command, stdout=subprocess.PIPE, env={**env, **more})
        for more in ({}, {"MALLOC_ARENA_MAX": "1"})
    ]
    own, one = (json.loads(process.communicate()[0]) for process in both)
    return own, one


def growth(readings: dict) -> str:
    """Return two cells: bytes a run, in use and resident, each with its standard error."""
    slopes = (slope_of(readings[name]) for name in ("in_use", "memory"))
    return " | ".join(f"{slope:.0f} ± {error:.0f}" for slope, error in slopes)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=2000)
    parser.add_argument("--readings", action="store_true", help="of this process only, as JSON")
    options = parser.parse_args()
    if options.readings:
        print(json.dumps(soaked(options.runs)))
        return
    own, one = side_by_side(options.runs)
    bytes_held = (readings[name] for readings in (own, one) for name in ("memory", "in_use"))
    rows = "\n".join(
        f"| {EVERY * number} | {' | '.join(f'{held / 1e6:.1f}' for held in megabytes)} | {blocks} | {files} |"
        for number, (*megabytes, blocks, files) in enumerate(
            zip(*bytes_held, own["blocks"], own["files"], strict=True), 1
        )
        if number % 5 == 0 or number == 1
    )
    mixed = ", ".join(f"{count} {name}" for name, count in sorted(own["ends"].items()))
    more_blocks, blocks_error = slope_of(own["blocks"])
    text = f"""# Two thousand runs in one process

Written by `python research/soak.py`: {mixed}.
Each is saved and loaded. Growth after the first quarter, bytes a run with its standard error (at most
{SLOPE:.0f} and two standard errors are allowed):

| | in use (not freed) | resident |
|---|---|---|
| one arena for all threads (`MALLOC_ARENA_MAX=1`) | {growth(one)} |
| an arena for each thread, as glibc does | {growth(own)} |

Blocks of Python's objects grow by {more_blocks:.2f} ± {blocks_error:.2f} a run, and
{own["files"][-1] - own["files"][0]} more files are open at the end than at the first reading.

Resident memory with an arena for each thread has no limit here. Wraps run in threads, and glibc keeps the
free end of such an arena, up to twice the largest block freed so far (mallopt(3), M_TRIM_THRESHOLD; 64 MB
at most), even after malloc_trim. It rises when a larger wrap runs for the first time; later wraps use it
again.

Memory in MB, blocks and open files after so many runs:

| runs | resident | in use | resident, one arena | in use, one arena | blocks | open files |
|---|---|---|---|---|---|---|
{rows}
"""
    if options.runs == 2000:
        REPORT.write_text(text, "utf-8")
    print(text)
    asked = [own["in_use"], one["in_use"], one["memory"]]
    grows = any(slope > SLOPE + 2.0 * error for slope, error in map(slope_of, asked))
    sys.exit(grows or any(readings["files"][-1] > readings["files"][0] for readings in (own, one)))


if __name__ == "__main__":
    main()
