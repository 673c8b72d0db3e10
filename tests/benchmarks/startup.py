"""How long commands take to start, and kernels to compile.

``python tests/benchmarks/startup.py > reports/reference/startup.md`` writes the page; with the root of
another checkout as its argument, that one's times stand beside these. Times are those of a processor, which
other programs disturb least; commands run by turns and count by their median.
"""

import os
import platform
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import numba

ROOT = Path(__file__).parents[2]
CASES = ROOT / "cases"
PROGRAM = "import wearsim.cli; wearsim.cli.main()"
STRAND, WRAP = "16b-20t-oiled", "08b-19t-wrap"
COMMANDS = (
    ("`--help`", ("--help",), False),
    ("`check` of a strand", ("check", STRAND), False),
    ("`life` of a strand", ("life", STRAND), False),
    ("`life` of a strand, empty cache", ("life", STRAND), True),
    ("`life` of a wrap", ("life", WRAP), False),
    ("`life` of a wrap, empty cache", ("life", WRAP), True),
)
BYTECODE = tempfile.mkdtemp()
"""Where bytecode of all modules lies, which each command would else compile first."""

WARM, COLD = 5, 1
"""Runs of a command, with what it needs in the cache and without."""

KERNELS = """
import numba.core.event, time
from wearsim.input.mechanism_registry import MECHANISMS
from wearsim.jit.compiled import kernel_of
from wearsim.jit.object_code import object_code

class Clock(numba.core.event.Listener):
    def __init__(self):
        self.open, self.own = [], {}
    def on_start(self, event):
        self.open.append([time.process_time(), 0.0])
    def on_end(self, event):
        start, inside = self.open.pop()
        took = time.process_time() - start
        if self.open:
            self.open[-1][1] += took
        function = event.data["dispatcher"].py_func
        name = f"{function.__module__.rpartition('.')[2]}.{function.__qualname__}"
        self.own[name] = self.own.get(name, 0.0) + took - inside

clock = Clock()
numba.core.event.register("numba:compile", clock)
start = time.process_time()
for name in sorted({name for mechanism in MECHANISMS.values() for name in mechanism.kernels}):
    object_code(kernel_of(name))
print("all", time.process_time() - start)
for name, took in clock.own.items():
    print(name, took)
"""


def main() -> None:
    """Print the page."""
    roots = [*map(Path, sys.argv[1:2]), ROOT]
    sys.stdout.writelines(f"{line}\n" for line in page(roots))


def page(roots: list[Path]) -> Iterator[str]:
    """Lines of the page."""
    yield "# Start-up"
    yield ""
    yield (
        f"By `python tests/benchmarks/startup.py`, Python {platform.python_version()}, numba "
        f"{numba.__version__}, {len(os.sched_getaffinity(0))} cores."
    )
    yield ""
    yield "## Commands"
    yield ""
    yield "Seconds of a processor, of all processes together, and in brackets those on a clock (medians)."
    yield "With an empty cache two processes compile: where both times agree they shared one core."
    yield ""
    before = len(roots) > 1
    yield "| command | before | now |" if before else "| command | now |"
    yield "|---|---|---|" if before else "|---|---|"
    for root in roots:
        for _, (command, *case), cold in COMMANDS:
            if not cold:
                used(root, [command, *(str(CASES / f"{name}.toml") for name in case)], cold)
    for text, (command, *case), cold in COMMANDS:
        files = [str(CASES / f"{name}.toml") for name in case]
        runs = [
            [used(root, [command, *files], cold) for root in roots] for _ in range(COLD if cold else WARM)
        ]
        medians = [
            [statistics.median(row) for row in zip(*times, strict=True)] for times in zip(*runs, strict=True)
        ]
        cells = [f"{processor:.2f} ({clock:.2f})" for processor, clock in medians]
        yield f"| {text} | {' | '.join(cells)} |"
    yield ""
    yield "## Kernels"
    yield ""
    yield "Seconds of a processor to compile the kernels that lives call: by numba, each without those"
    yield "that it calls (others take less than 0.2 s), and by LLVM, to one file for each with all these."
    yield ""
    yield "| kernel | s |"
    yield "|---|---|"
    own = kernel_times()
    total = own.pop("all")
    ours = {
        name: took
        for name, took in own.items()
        if (ROOT / f"wearsim/kernels/{name.split('.')[0]}.py").exists()
    }
    for name, took in sorted(ours.items(), key=lambda item: -item[1]):
        if took >= 0.2:
            yield f"| `{name}` | {took:.2f} |"
    yield f"| all {len(ours)} | {sum(ours.values()):.1f} |"
    yield f"| functions of numba's own that they take | {sum(own.values()) - sum(ours.values()):.1f} |"
    yield f"| linked, optimised and made object files | {total - sum(own.values()):.1f} |"


def used(root: Path, arguments: list[str], cold: bool) -> tuple[float, float]:
    """Seconds of a processor and on a clock that a command takes whose modules are in bytecode."""
    with tempfile.TemporaryDirectory() as empty:
        own = {"PYTHONPATH": str(root), "PYTHONPYCACHEPREFIX": BYTECODE, "WEARSIM_RUNS": ""}
        variables = {**os.environ, **own}
        variables |= {"NUMBA_CACHE_DIR": empty} if cold else {}
        variables.pop("PYTHONDONTWRITEBYTECODE", None)
        command = [sys.executable, "-c", PROGRAM, *arguments]
        before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
        subprocess.run(command, cwd=root, env=variables, check=True, capture_output=True)
        clock, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime, clock


def kernel_times() -> dict[str, float]:
    """Seconds that each kernel takes to compile."""
    with tempfile.TemporaryDirectory() as empty:
        variables = {**os.environ, "NUMBA_CACHE_DIR": empty, "PYTHONPATH": str(ROOT)}
        command = [sys.executable, "-c", KERNELS]
        done = subprocess.run(command, cwd=ROOT, env=variables, check=True, capture_output=True, text=True)
    rows = (line.split(" ") for line in done.stdout.splitlines())
    return {name: float(took) for name, took in rows}


if __name__ == "__main__":
    main()
