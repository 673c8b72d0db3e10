"""Run the benchmarks and write their table: python tests/benchmarks/performance.py."""

import json
import platform
import subprocess
import sys
import tempfile
from datetime import date
from importlib.metadata import version
from pathlib import Path

FOLDER = Path(__file__).parent
TABLE = FOLDER.parents[1] / "reports" / "reference" / "performance.md"
WAYS = {
    "kernel": "numba kernel, strict arithmetic",
    "c plain": "C, one loop over the points, -O3 -march=native",
    "c fast-math": "the same with -ffast-math",
    "c fissioned": "C in split loops, -O3 -march=native -fno-math-errno -ffinite-math-only -fno-signed-zeros",
    "numpy": "NumPy, whole arrays",
}
PROCESSES = {
    "test_help": ("`wearsim --help`", 0.15),
    "test_life_warm": ("`wearsim life cases/16b-20t-oiled.toml`", 1.0),
    "test_life_cold": ("the same with an empty NUMBA_CACHE_DIR", 4.0),
}


def measured(folder):
    """Results of all benchmarks, by name."""
    file = folder / "benchmarks.json"
    words = ["-n", "0", "--benchmark-only", "--benchmark-warmup=on", f"--benchmark-json={file}"]
    subprocess.run([sys.executable, "-m", "pytest", str(FOLDER), *words], check=True)
    content = json.loads(file.read_text(encoding="utf-8"))
    return content["machine_info"]["cpu"], {item["name"]: item for item in content["benchmarks"]}


def median(item):
    """Median of the rounds [s]."""
    return item["stats"]["median"]


def per_point(item):
    """Median per point and cycle [ns]."""
    return 1e9 * median(item) / item["extra_info"]["point_cycles"]


ANCHOR = {"numpy": 11.5, "floor": 0.24}
"""ns per point and cycle of B9 in offset form at 500 points, on the machine of the goals."""


MANY_GOAL = 0.25
"""s for 1000 lives on the machine of the goals, in two threads."""


def reached(value, goal):
    return "reached" if value <= goal else "NOT reached"


def slowness(results):
    """How many times as long as the machine of the goals this one takes, by NumPy and by its root."""
    times = results["test_offset[500]"]["extra_info"]["nanoseconds"]
    return times["numpy"] / ANCHOR["numpy"], times["floor"] / ANCHOR["floor"]


def strand_lines(results):
    """The cycle loop of the strand: time per point and cycle and its ratio to the kernel."""
    yield "| the same cycle loop as | 201 nodes, ns | ratio | 401 nodes, ns | ratio |"
    yield "|---|---|---|---|---|"
    kernel = {nodes: per_point(results[f"test_strand[kernel-{nodes}]"]) for nodes in (201, 401)}
    for way, what in WAYS.items():
        cells = []
        for nodes in (201, 401):
            time = per_point(results[f"test_strand[{way}-{nodes}]"])
            cells += [f"{time:.2f}", f"{time / kernel[nodes]:.2f}"]
        yield f"| {what} | {' | '.join(cells)} |"
    yield ""
    for nodes in (201, 401):
        ratios = results[f"test_strand_reaches_its_goals[{nodes}]"]["extra_info"]
        to_c, to_numpy = ratios["to_c"], ratios["to_numpy"]
        split, floor = ratios["to_c fissioned"], ratios["to_floor"]
        yield (
            f"- {nodes} nodes, fastest of nine runs taken in turn: {to_c:.3f} of plain C -O3 "
            f"(goal 0.3: {reached(to_c, 0.3)}), {split:.2f} of the split loops in C (goal 1.25: "
            f"{reached(split, 1.25)}), {floor:.2f} of its 2 square roots and 5 divisions alone (goal 1.5: "
            f"{reached(floor, 1.5)}), {to_numpy:.0f} times as fast as NumPy"
            + (f" (goal 20: {reached(20.0, to_numpy)})" if nodes == 201 else "")
        )


def offset_lines(results):
    """The cycle loop in offset form."""
    names = ("kernel", "c fissioned", "c fast-math", "numpy", "floor")
    head = ("points", "kernel, ns", "C in split loops", "C -ffast-math", "NumPy", "its root alone")
    yield f"| {' | '.join(head)} | kernel to C |"
    yield "|---|---|---|---|---|---|---|"
    for nodes in (200, 500, 2000):
        times = results[f"test_offset[{nodes}]"]["extra_info"]["nanoseconds"]
        cells = " | ".join(f"{times[name]:.3f}" for name in names)
        ratio = times["kernel"] / times["c fissioned"]
        yield f"| {nodes} | {cells} | {ratio:.2f} (goal 1.25: {reached(ratio, 1.25)}) |"
    yield ""
    slower = slowness(results)
    yield (
        "- Goals in seconds on this page were set on a machine on which, at 500 points, NumPy took "
        f"{ANCHOR['numpy']:g} ns and the root alone {ANCHOR['floor']:g} ns: this one is "
        f"{slower[0]:.1f} and {slower[1]:.1f} times as slow; that of many lives is scaled by the first, the "
        "others are compared as they stand"
    )


def many_lines(results):
    """Many strand lives by `simulate_many`."""
    yield "| 1000 lives | one thread, s | two, s | ratio | error of a life |"
    yield "|---|---|---|---|---|"
    slower = slowness(results)[0]
    limit = MANY_GOAL * slower
    for nodes, tolerance in ((200, "0.01"), (401, "0.0001")):
        found = results[f"test_threads[{nodes}-{tolerance}]"]["extra_info"]
        one, two = (found["seconds"][key] for key in ("1", "2"))
        goal = f" (goal {limit:.2f}: {reached(two, limit)})" if nodes == 200 else ""
        yield (
            f"| {nodes} nodes, life_tolerance {tolerance} | {one:.3f} | {two:.3f}{goal} | "
            f"{one / two:.2f} (goal 1.9: {reached(1.9, one / two)}) | {found['error']:.1g} |"
        )
    peaks = results["test_memory"]["extra_info"]["peak_MiB"]
    yield ""
    yield (
        f"- goal: {MANY_GOAL:g} s where NumPy takes {ANCHOR['numpy']:g} ns a point of B9 in offset form; "
        f"on this machine it takes {slower:.1f} times as long"
    )
    shown = ", ".join(f"{peak:.1f} MiB at {count} lives" for count, peak in peaks.items())
    yield f"- peak of what Python and NumPy allocate: {shown}"


def life_lines(results):
    """Other runs inside one process."""
    yield "| run | median |"
    yield "|---|---|"
    for tolerance in ("0.001", "0.0001"):
        time = 1e3 * median(results[f"test_advance_reference_run[{tolerance}]"])
        yield f"| reference run by `advance`, 201 nodes, life_tolerance {tolerance} | {time:.1f} ms |"


def wrap_lines(results):
    """One equilibrium of the wrap, in microseconds, and its ratio to SciPy's minimiser."""
    yield "| elongation of the chain | warm, us | cold, us |"
    yield "|---|---|---|"
    for elongation in ("0.0", "0.01", "0.03"):
        warm, cold = (1e6 * median(results[f"test_wrap[{elongation}-{start}]"]) for start in ("warm", "cold"))
        yield f"| {100 * float(elongation):g} % | {warm:.1f} | {cold:.1f} |"
    yield ""
    info = results["test_wrap_reaches_its_goal"]["extra_info"]
    time, ratio = info["microseconds"], info["to_scipy"]
    yield (
        f"- 3 %, warm, fastest of nine runs taken in turn: {time:.1f} us (goal 50: "
        f"{reached(time, 50.0)}), {ratio:.0f} times as fast as BFGS of SciPy on the same energy "
        f"(goal 50: {reached(50.0, ratio)})"
    )


def wrap_life_lines(results):
    """A whole life on a wrap and the shares of its compiled parts."""
    found = results["test_wrap_life"]["extra_info"]
    seconds = found["seconds"]
    yield (
        f"- {seconds:.2f} s of one core (goal 2: {reached(seconds, 2.0)}), {found['updates']} steps in "
        f"the finest run, numerical error {100 * found['error']:.2g} %"
    )
    for name, share in found["shares"].items():
        yield f"- {name}: {100 * share:.0f} %"
    rest = 1.0 - sum(found["shares"].values())
    yield f"- the rest, Python and NumPy between these and tables of the result: {100 * rest:.0f} %"


def process_lines(results):
    """Whole processes and their peak memory."""
    yield "| process | fastest, s | median, s | goal, s | |"
    yield "|---|---|---|---|---|"
    for name, (what, goal) in PROCESSES.items():
        fastest, time = results[name]["stats"]["min"], median(results[name])
        yield f"| {what} | {fastest:.3f} | {time:.3f} | {goal:g} | {reached(time, goal)} |"
    yield ""
    yield "| peak memory of `wearsim life`, MiB | 8.1e3 cycles | 8.1e4 | 8.1e6 |"
    yield "|---|---|---|---|"
    for method in ("per_cycle", "advance"):
        name = f"test_peak_memory_does_not_grow_with_the_cycles[{method}]"
        peaks = results[name]["extra_info"]["peak_MiB"]
        yield f"| {method} | {' | '.join(f'{peaks[key]:.0f}' for key in ('1', '10', '1000'))} |"


def lines(cpu, results):
    """All lines of the table."""
    compiler = subprocess.run(["gcc", "--version"], check=True, capture_output=True, text=True)
    versions = [f"{name} {version(name)}" for name in ("numba", "llvmlite", "numpy", "scipy")]
    python = f"{platform.python_implementation()} {platform.python_version()}"
    yield "# Performance"
    yield ""
    yield "Made by `python tests/benchmarks/performance.py`; the ratios are what to compare."
    yield ""
    yield f"- date: {date.today().isoformat()}"
    yield f"- machine: {cpu['brand_raw']}, {cpu['count']} cores, {platform.system()}"
    yield f"- versions: {python}, {', '.join(versions)}, {compiler.stdout.splitlines()[0]}"
    yield ""
    yield "## One loading cycle of the strand (reference run, m = 1)"
    yield ""
    yield "C and NumPy give the kernel's flank to 1e-10 before they are timed."
    yield ""
    yield from strand_lines(results)
    yield ""
    yield "## One loading cycle in offset form (benchmark B9, sliding distance given)"
    yield ""
    yield "Fastest of fifteen runs taken in turn, per point and cycle; C and NumPy give the kernel's"
    yield "depth before they are timed."
    yield ""
    yield from offset_lines(results)
    yield ""
    yield "## Many lives"
    yield ""
    yield from many_lines(results)
    yield ""
    yield "## Lives"
    yield ""
    yield "How time and error of a life go together: work_precision.md."
    yield ""
    yield from life_lines(results)
    yield ""
    yield "## One equilibrium of 12 rollers in the wrap (ANSI 40, 24 teeth)"
    yield ""
    yield "Warm starts from the answer at 0.001 % less elongation, cold from one place on the flank."
    yield ""
    yield from wrap_lines(results)
    yield ""
    yield "## A life on a wrap: chain no. 40, 19 teeth, 12 rollers, 16 phases, 15 000 h"
    yield ""
    yield from wrap_life_lines(results)
    yield ""
    yield "## Processes"
    yield ""
    yield from process_lines(results)


def main():
    with tempfile.TemporaryDirectory() as folder:
        cpu, results = measured(Path(folder))
    TABLE.parent.mkdir(parents=True, exist_ok=True)
    TABLE.write_text("\n".join(lines(cpu, results)) + "\n", encoding="utf-8")
    print(TABLE)


if __name__ == "__main__":
    main()
