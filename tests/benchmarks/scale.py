"""Write reports/reference/scale.md: a sweep of 1e5 lives on a Dask cluster that loses a worker.

    python tests/benchmarks/scale.py

Needs wearsim[study,dask] and a machine with nothing else to do; takes about ten minutes. The client is killed
once, and so is one of two workers, for which another comes; then the same command goes on.
"""

import csv
import datetime
import os
import platform
import re
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).parents[2]
BIN = Path(sys.executable).parent
STRAND = """\
format_version = 1
case = "{root}/cases/16b-20t-oiled.toml"
[grid]
"sprocket.teeth" = [20, 21, 22, 23, 24, 25, 26, 27, 28, 30]
"load.tension_N" = {{from = 1000.0, to = 8000.0, count = {tensions}, spacing = "log"}}
"load.speed_rpm" = {{from = 50.0, to = 200.0, count = {speeds}}}
"""
LIVES = 100_000
DRIVES = """\
format_version = 1
case = "{root}/cases/drives/packaging-conveyor.toml"
[grid]
"load.power_kW" = {{from = 2.0, to = 5.0, count = {count}}}
"""
WHOLE = 24


class Cluster:
    """A scheduler and workers of one thread."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.file = folder, folder / "scheduler.json"
        self.scheduler = self._start("scheduler", "--host", "127.0.0.1", "--port", "0")
        while not self.file.exists():
            time.sleep(0.1)
        self.workers = [self.add_worker() for _ in range(2)]

    def _start(self, *command: str) -> subprocess.Popen[bytes]:
        full = [str(BIN / "dask"), *command, "--no-dashboard", "--scheduler-file", str(self.file)]
        environment = {**os.environ, "DASK_TEMPORARY_DIRECTORY": str(self.folder)}
        quiet = subprocess.DEVNULL
        return subprocess.Popen(full, cwd=self.folder, stdout=quiet, stderr=quiet, env=environment)

    def add_worker(self) -> subprocess.Popen[bytes]:
        """Start one more worker."""
        return self._start("worker", "--nthreads", "1", "--no-nanny")

    def lose_worker(self) -> None:
        """Kill a worker and start another one in its place."""
        self.workers[0].kill()
        self.workers[0].wait()
        self.workers[0] = self.add_worker()

    def stop(self) -> None:
        """Kill them all."""
        for process in (self.scheduler, *self.workers):
            process.kill()
            process.wait()


def peak(pid: int) -> float:
    """Return the greatest memory that a process has had [MiB]."""
    status = Path(f"/proc/{pid}/status").read_text("utf-8")
    found = re.search(r"VmHWM:\s+(\d+)", status)
    return int(found[1]) / 1024.0 if found else 0.0


def sweep(study: Path, out: Path, *options: str) -> subprocess.Popen[bytes]:
    """Start a sweep."""
    command = [str(BIN / "wearsim"), "sweep", str(study), "--out", str(out), "-q", *options]
    return subprocess.Popen(command, stdout=subprocess.DEVNULL)


def finished(out: Path) -> int:
    """Return how many parts of a study are written."""
    return len(list((out / "shards").glob("*.parquet")))


def wait_for(process: subprocess.Popen[bytes], out: Path, parts: int) -> None:
    """Wait until so many parts are written while the study goes on."""
    while finished(out) < parts:
        if process.poll() is not None:
            raise SystemExit(f"the sweep ended with status {process.returncode} before {parts} parts")
        time.sleep(0.2)


def cluster_lines(folder: Path) -> list[str]:
    """Return what a sweep of strands costs on workers of which one is lost, and the client once."""
    study, out = folder / "study.toml", folder / "out"
    study.write_text(STRAND.format(root=ROOT, tensions=200, speeds=LIVES // 2000), "utf-8")
    cluster = Cluster(folder)
    try:
        options = ("--scheduler-file", str(cluster.file))
        begun = time.perf_counter()
        first = sweep(study, out, *options)
        wait_for(first, out, 80)
        cluster.lose_worker()
        wait_for(first, out, 160)
        first.send_signal(signal.SIGKILL)
        first.wait()
        kept = finished(out)
        again = sweep(study, out, *options)
        client = 0.0
        while again.poll() is None:
            client = max(client, peak(again.pid))
            time.sleep(0.2)
        seconds = time.perf_counter() - begun
        if again.returncode:
            raise SystemExit(f"the sweep that went on ended with status {again.returncode}")
        scheduler, workers = peak(cluster.scheduler.pid), [peak(one.pid) for one in cluster.workers]
    finally:
        cluster.stop()
    with (out / "cases.csv").open(encoding="utf-8", newline="") as file:
        rows = sum(1 for _ in csv.reader(file)) - 1  # a warning may have several lines
    if rows != LIVES:
        raise SystemExit(f"{rows} rows in cases.csv, not {LIVES}")
    parts = list((out / "shards").glob("*.parquet"))
    kept_bytes = sum(part.stat().st_size for part in parts)
    table = (out / "cases.csv").stat().st_size
    return [
        f"`wearsim sweep` of {LIVES} strands (teeth, tension, speed) on two Dask workers of one thread,",
        f"scheduler and client on the same {os.cpu_count()} cores. One worker is killed after 80 of",
        f"{len(parts)} parts, and another comes; the client is killed after 160, and the same command goes",
        f"on from {kept} parts. cases.csv has all {rows} rows.",
        "",
        "| | |",
        "|---|---|",
        f"| whole, s | {seconds:.0f} |",
        f"| a life, ms of one core | {2e3 * seconds / LIVES:.2f} |",
        f"| a life in parts, bytes | {kept_bytes / LIVES:.0f} |",
        f"| a life in cases.csv, bytes | {table / LIVES:.0f} |",
        f"| scheduler, MiB at most | {scheduler:.0f} |",
        f"| a worker, MiB at most | {max(workers):.0f} |",
        f"| client, MiB at most | {client:.0f} |",
    ]


def drive_lines(folder: Path) -> list[str]:
    """Return what whole drives cost in processes."""
    study, out = folder / "drives.toml", folder / "drives"
    study.write_text(DRIVES.format(root=ROOT, count=WHOLE), "utf-8")
    begun = time.perf_counter()
    if sweep(study, out, "--jobs", "2").wait():
        raise SystemExit("the sweep of drives failed")
    seconds = time.perf_counter() - begun
    return [
        "",
        f"{WHOLE} whole drives, packaging-conveyor at 2 to 5 kW, in two processes: {seconds:.0f} s, "
        f"{2.0 * seconds / WHOLE:.1f} s of one core a drive.",
    ]


def main() -> None:
    """Run both and write the page."""
    lines = [
        "# At scale",
        "",
        "Made by `python tests/benchmarks/scale.py`.",
        "",
        f"- date: {datetime.date.today()}",
        f"- machine: {platform.machine()}, {os.cpu_count()} cores, {platform.system()}",
        "",
    ]
    with tempfile.TemporaryDirectory() as folder:
        lines += [*cluster_lines(Path(folder)), *drive_lines(Path(folder))]
    text = "\n".join(lines) + "\n"
    (ROOT / "reports" / "reference" / "scale.md").write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
