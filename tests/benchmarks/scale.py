"""Write reports/reference/scale.md: a sweep of 1e6 lives on a Dask cluster that loses workers.

    python tests/benchmarks/scale.py

Needs wearsim[study,dask] and a machine with nothing else to do; takes about an hour. One of two workers is
killed twice, and another comes each time; the client is killed once; then the same command goes on.
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
LIVES = 1_000_000
CORES = 1000
"""Of the cluster that is reckoned with."""
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
        lost = self.workers.pop(0)
        lost.kill()
        lost.wait()
        self.workers.append(self.add_worker())

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


def processor_time(pid: int) -> float:
    """Return the time that a process has been running on a core [s]."""
    fields = Path(f"/proc/{pid}/stat").read_text("utf-8").rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


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
    """Return what a sweep of strands costs on workers of which one is lost twice, and the client once."""
    study, out = folder / "study.toml", folder / "out"
    study.write_text(STRAND.format(root=ROOT, tensions=200, speeds=LIVES // 2000), "utf-8")
    parts = LIVES // 250
    cluster = Cluster(folder)
    try:
        options = ("--scheduler-file", str(cluster.file))
        begun = time.perf_counter()
        first = sweep(study, out, *options)
        wait_for(first, out, parts // 5)
        cluster.lose_worker()
        wait_for(first, out, 2 * parts // 5)
        first.send_signal(signal.SIGKILL)
        first.wait()
        kept, before = finished(out), peak(cluster.scheduler.pid)
        again = sweep(study, out, *options)
        wait_for(again, out, 3 * parts // 5)
        cluster.lose_worker()
        client = spent = 0.0
        while again.poll() is None:
            client, spent = max(client, peak(again.pid)), processor_time(again.pid)
            time.sleep(0.2)
        seconds = time.perf_counter() - begun
        if again.returncode:
            raise SystemExit(f"the sweep that went on ended with status {again.returncode}")
        scheduler, workers = peak(cluster.scheduler.pid), [peak(one.pid) for one in cluster.workers]
        scheduling = processor_time(cluster.scheduler.pid)
    finally:
        cluster.stop()
    with (out / "cases.csv").open(encoding="utf-8", newline="") as file:
        rows = sum(1 for _ in csv.reader(file)) - 1  # a warning may have several lines
    written = list((out / "shards").glob("*.parquet"))
    if (rows, len(written)) != (LIVES, parts):
        raise SystemExit(f"{rows} rows in cases.csv and {len(written)} parts, not {LIVES} and {parts}")
    kept_bytes = sum(part.stat().st_size for part in written)
    table = (out / "cases.csv").stat().st_size
    life, client_life = 2.0 * seconds / LIVES, spent / (LIVES * (1.0 - kept / parts))
    task, growth = scheduling / parts, (scheduler - before) / (parts - kept)
    on_many = max(life / CORES, client_life, task / 250.0)
    return [
        f"`wearsim sweep` of {LIVES} strands (teeth, tension, speed) on two Dask workers of one thread,",
        f"scheduler and client on the same {os.cpu_count()} cores. Workers are killed after {parts // 5} of",
        f"{parts} parts and after {3 * parts // 5}, and another comes each time; the client is killed after",
        f"{2 * parts // 5}, and the same command goes on from {kept} parts. cases.csv has all {rows} rows.",
        "",
        "| | |",
        "|---|---|",
        f"| whole, s | {seconds:.0f} |",
        f"| a life, ms of one core | {1e3 * life:.2f} |",
        f"| of that the client, ms | {1e3 * client_life:.2f} |",
        f"| a part of 250 lives, ms of the scheduler | {1e3 * task:.1f} |",
        f"| a life in parts, bytes | {kept_bytes / LIVES:.0f} |",
        f"| a life in cases.csv, bytes | {table / LIVES:.0f} |",
        f"| scheduler, MiB at most | {scheduler:.0f} |",
        f"| of that for a part more, kiB | {1024.0 * growth:.1f} |",
        f"| a worker, MiB at most | {max(workers):.0f} |",
        f"| client, MiB at most | {client:.0f} |",
        "",
        f"Reckoned from this for {CORES} cores: they would run {CORES / life:.0f} lives a second, the client",
        f"takes {1.0 / client_life:.0f} a second and the scheduler {250.0 / task:.0f}, so that strands keep",
        f"{life / client_life:.0f} cores busy, and what takes longer more: whole drives of some seconds all",
        f"{CORES}. {LIVES} strands take {LIVES * on_many / 60.0:.1f} min",
        f"then, and 10 million {10e6 * kept_bytes / LIVES / 1e9:.1f} GB in parts and "
        f"{10e6 * table / LIVES / 1e9:.1f} GB in cases.csv. As at most four parts wait with each worker,",
        f"the scheduler would have {scheduler + growth * 1e6:.0f} MiB after a million parts.",
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
