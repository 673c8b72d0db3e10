"""Write reports/reference/studies.md: what many lives of a strand and of wraps cost on this machine.

    python tests/benchmarks/studies.py

Needs wearsim[study,dask] and a machine with nothing else to do; takes about half an hour.
"""

import datetime
import os
import platform
import resource
import subprocess
import sys
import tempfile
import time
from dataclasses import replace
from pathlib import Path

import numpy as np

import wearsim

ROOT = Path(__file__).parents[2]
CASE = ROOT / "cases" / "16b-20t-oiled.toml"
SCATTER = ("--set", 'uncertainty.load.tension_N={distribution = "normal", standard_deviation = 300.0}')
WEARSIM = str(Path(sys.executable).parent / "wearsim")
DASK = str(Path(sys.executable).parent / "dask")
COUNTS = (25_000, 50_000, 100_000)
WRAPS = ("bicycle-17t-road", "08b-19t-wrap", "d6-crawler-27t-wrap")
WRAP_SAMPLES, WRAP_LIVES = 64, 200
CLUSTER_COUNT = 10_000


def sampled(count: int, *options: str, case: Path = CASE) -> tuple[float, float]:
    """Return seconds and MiB (of all processes of the command) of a study."""
    command = [WEARSIM, "uncertainty", str(case), "--samples", str(count), "--method", "lhs", "-q", *options]
    start = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if status:
        raise SystemExit(f"{' '.join(command)} ended with status {status}")
    return time.perf_counter() - start, usage.ru_maxrss / 1024.0


def many_wraps(*settings: str) -> str:
    """Return a line on so many lives of a wrap by `simulate_many`."""
    base = wearsim.load_case(ROOT / "cases" / f"{WRAPS[1]}.toml", settings)
    cases = (replace(base, modulus=base.modulus * (1.0 + 2e-4 * n)) for n in range(WRAP_LIVES))
    start = time.perf_counter()
    lives = list(wearsim.simulate_many(cases))
    seconds = time.perf_counter() - start
    errors = [life.numerical_error for life in lives if not isinstance(life, Exception)]
    return (
        f"| {', '.join(settings) or 'as shipped'} | {seconds:.0f} | {1000.0 * seconds / WRAP_LIVES:.0f} | "
        f"{100.0 * np.median(errors):.1f} % | {WRAP_LIVES - len(errors)} |"
    )


def wrap_lines() -> list[str]:
    """Return the lines on wraps."""
    lines = [
        "",
        "## Wraps",
        "",
        f"`wearsim uncertainty CASE --samples {WRAP_SAMPLES} --jobs 2`, goal 60 s:",
        "",
        "| case | s | s a life |",
        "|---|---|---|",
    ]
    for name in WRAPS:
        path = ROOT / "cases" / f"{name}.toml"
        seconds, _ = sampled(WRAP_SAMPLES, "--jobs", "2", case=path)
        lines.append(f"| {name} | {seconds:.1f} | {seconds / WRAP_SAMPLES:.2f} |")
    lines += [
        "",
        f"{WRAP_LIVES} lives of {WRAPS[1]}, no two with the same modulus, by `simulate_many` in threads; "
        "goal 300 s for 1000 at 1 %:",
        "",
        "| settings | s | s for 1000 | stated error, median | failed |",
        "|---|---|---|---|---|",
        many_wraps(),
        many_wraps("sprocket.nodes=301", "mechanism.phases=4"),
    ]
    return lines


def with_workers(count: int) -> float:
    """Return seconds of a study on Dask workers of one thread, the best of three."""
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / "scheduler.json"
        environment = {**os.environ, "DASK_TEMPORARY_DIRECTORY": folder}
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "env": environment}
        scheduler = ["scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard"]
        worker = ["worker", "--nthreads", "1", "--no-dashboard", "--no-nanny"]
        commands = [scheduler, *[worker] * count]
        processes = []
        try:
            for part in commands:
                full = [DASK, *part, "--scheduler-file", str(place)]
                processes.append(subprocess.Popen(full, cwd=folder, **quiet))
                while not place.exists():
                    time.sleep(0.1)
            time.sleep(5.0)
            options = ("--scheduler-file", str(place))
            sampled(1000, *SCATTER, *options)
            return min(sampled(CLUSTER_COUNT, *SCATTER, *options)[0] for _ in range(3))
        finally:
            for process in processes:
                process.kill()
                process.wait()


def main() -> None:
    sampled(1000, *SCATTER)
    lines = [
        "# Studies",
        "",
        "Made by `python tests/benchmarks/studies.py`.",
        "",
        f"- date: {datetime.date.today()}",
        f"- machine: {platform.machine()}, {os.cpu_count()} cores, {platform.system()}",
        "",
        f"Sampled lives of cases/{CASE.name}, whose wear coefficient and tension scatter, so that every",
        "life is a run of its own; the whole command, in threads.",
        "",
        "| lives | s | ms a life | peak memory, MiB |",
        "|---|---|---|---|",
    ]
    for count in COUNTS:
        seconds, memory = sampled(count, *SCATTER)
        lines.append(f"| {count} | {seconds:.1f} | {1000 * seconds / count:.3f} | {memory:.0f} |")
    seconds, memory = sampled(COUNTS[-1], *SCATTER, "--jobs", "2")
    children = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024.0
    lines.append(
        f"| {COUNTS[-1]} in two processes | {seconds:.1f} | {1000 * seconds / COUNTS[-1]:.3f} | "
        f"{max(memory, children):.0f} (the largest process) |"
    )
    one, two = with_workers(1), with_workers(2)
    lines += [
        "",
        f"{CLUSTER_COUNT} lives on Dask workers of one thread each, scheduler and client on the same "
        f"{os.cpu_count()} cores, best of three: one {one:.1f} s, two {two:.1f} s, ratio "
        f"{one / two:.2f} (goal 1.6).",
        *wrap_lines(),
    ]
    text = "\n".join(lines) + "\n"
    (ROOT / "reports" / "reference" / "studies.md").write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
