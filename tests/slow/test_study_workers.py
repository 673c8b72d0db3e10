"""Studies in processes and on a Dask cluster of this machine, interrupted and killed on the way."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

WEARSIM = str(Path(sys.executable).parent / "wearsim")
DASK = str(Path(sys.executable).parent / "dask")
SAMPLES = 4000
CASE = """\
format_version = 1
[chain]
designation = "16B-1"
[sprocket]
teeth = 20
profile = "evolute"
nodes = 201
[load]
tension_N = 3000.0
speed_rpm = 100
[wear]
specific_wear_rate_mm2_per_N = 5e-11
[run]
horizon_hours = 1e6
[uncertainty]
"load.tension_N" = {distribution = "normal", standard_deviation = 200.0}
"""


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    """A case, and the table of its samples in threads."""
    for library in ("pyarrow", "distributed"):
        pytest.importorskip(library, reason=f"{library} is not installed")
    folder = tmp_path_factory.mktemp("study")
    (folder / "case.toml").write_text(CASE)
    assert run(folder, "threads").returncode == 0
    return folder


def command(folder, out, *options):
    return [
        WEARSIM,
        "uncertainty",
        str(folder / "case.toml"),
        "--samples",
        str(SAMPLES),
        "-q",
        "--out",
        str(folder / out),
        *map(str, options),
    ]


def run(folder, out, *options):
    return subprocess.run(command(folder, out, *options), capture_output=True, text=True, timeout=300)


def table(folder, out):
    return (folder / out / "cases.csv").read_bytes()


def shard_files(folder, out):
    return list((folder / out / "shards").glob("*.parquet"))


def wait_for(condition, seconds=120):
    """Wait until something holds."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.02)


def start(folder, out, *options):
    """Start a study and wait until some of it is finished, but not all."""
    process = subprocess.Popen(
        command(folder, out, *options), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    wait_for(lambda: len(shard_files(folder, out)) > 2)
    assert process.poll() is None
    return process


@pytest.fixture
def cluster(tmp_path):
    """A scheduler and two workers of one thread, with the file that it wrote and the workers."""
    place = tmp_path / "scheduler.json"
    log = (tmp_path / "cluster.log").open("w")
    environment = {**os.environ, "DASK_TEMPORARY_DIRECTORY": str(tmp_path)}
    processes = [
        subprocess.Popen(
            [
                DASK,
                "scheduler",
                "--host",
                "127.0.0.1",
                "--port",
                "0",
                "--no-dashboard",
                "--scheduler-file",
                str(place),
            ],
            stdout=log,
            stderr=log,
            env=environment,
            cwd=tmp_path,
        )
    ]
    wait_for(place.exists)
    processes += [
        subprocess.Popen(
            [
                DASK,
                "worker",
                "--scheduler-file",
                str(place),
                "--nthreads",
                "1",
                "--no-dashboard",
                "--no-nanny",
                "--local-directory",
                str(tmp_path),
            ],
            stdout=log,
            stderr=log,
            env=environment,
            cwd=tmp_path,
        )
        for _ in range(2)
    ]
    yield place, processes[1:]
    for process in processes:
        process.kill()
        process.wait()
    log.close()


def test_processes_give_the_same_bits(study):
    done = run(study, "processes", "--jobs", 2)
    assert done.returncode == 0, done.stderr
    assert table(study, "processes") == table(study, "threads")


@pytest.mark.parametrize("options", [("--jobs", 2), ("--threads", 1)], ids=["processes", "threads"])
def test_interrupted_study_goes_on(study, options):
    out = f"interrupted-{options[0]}"
    process = start(study, out, *options)
    process.send_signal(signal.SIGINT)
    _, text = process.communicate(timeout=60)
    assert process.returncode == 130
    assert "run the same command again to go on" in text
    assert "Traceback" not in text
    before = {path: path.stat().st_mtime_ns for path in shard_files(study, out)}
    assert run(study, out, *options).returncode == 0
    assert table(study, out) == table(study, "threads")
    assert all(path.stat().st_mtime_ns == time for path, time in before.items())


def test_killed_study_goes_on(study):
    process = start(study, "killed")
    process.kill()
    process.communicate()
    assert run(study, "killed").returncode == 0
    assert table(study, "killed") == table(study, "threads")


def test_process_that_is_killed_is_replaced(study):
    process = start(study, "orphan", "--jobs", 2)
    children = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
    workers = [pid for pid in children if b"spawn_main" in Path(f"/proc/{pid}/cmdline").read_bytes()]
    os.kill(int(workers[0]), signal.SIGKILL)
    _, text = process.communicate(timeout=300)
    assert process.returncode == 0, text
    assert table(study, "orphan") == table(study, "threads")


def test_cluster_that_loses_a_worker_and_a_client(study, cluster):
    place, workers = cluster
    process = start(study, "cluster", "--scheduler-file", place)
    workers[0].kill()
    time.sleep(0.5)
    process.kill()
    process.communicate()
    assert len(shard_files(study, "cluster")) < SAMPLES / 250
    done = run(study, "cluster", "--scheduler-file", place)
    assert done.returncode == 0, done.stderr
    assert table(study, "cluster") == table(study, "threads")


def test_worker_of_another_version_is_refused(study, cluster):
    from distributed import Client

    place, _ = cluster
    with Client(scheduler_file=str(place), set_as_default=False) as client:
        client.wait_for_workers(2)
        client.run(other_version)
    done = run(study, "other", "--scheduler-file", place)
    assert done.returncode == 3
    assert "must have this wearsim" in done.stderr
    assert "but has 0.0.1" in done.stderr


def other_version():
    """Make a worker believe that it is older."""
    from wearsim.runner import design

    older = design.Engine("0.0.1", "old")
    design.engine.__wrapped__.__globals__["__version__"] = "0.0.1"
    design.engine.cache_clear()
    return older.version


def test_scheduler_that_does_not_answer(study):
    done = run(study, "nobody", "--scheduler", "tcp://127.0.0.1:1")
    assert done.returncode == 3
    assert "must be a Dask scheduler that answers" in done.stderr
    assert "Traceback" not in done.stderr
