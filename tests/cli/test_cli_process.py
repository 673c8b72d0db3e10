"""The installed command as a process of its own: pipes, signals, rights."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

WEARSIM = Path(sys.executable).with_name("wearsim")

STARTED = """\
import signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)
import dataclasses
import wearsim.wear.loop
run = wearsim.wear.loop.run_per_cycle

def started(problem, cycles_per_update, *progress):
    run(dataclasses.replace(problem, horizon=100.0), 1)
    print("started", flush=True)
    return run(problem, cycles_per_update, *progress)

wearsim.wear.loop.run_per_cycle = started
import wearsim.cli
wearsim.cli.main()
"""


@pytest.mark.wide
def test_installed_command_prints_a_life(drive):
    done = subprocess.run([WEARSIM, "life", drive()], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("Test drive\n  Life ")
    assert "\x1b" not in done.stdout


def test_closed_pipe_is_141_without_a_word():
    reader, writer = os.pipe()
    os.close(reader)
    done = subprocess.run([WEARSIM, "list", "chains"], stdout=writer, stderr=subprocess.PIPE)
    os.close(writer)
    assert (done.returncode, done.stderr) == (141, b"")


@pytest.mark.parametrize(
    ("stream", "code", "message"),
    [
        ("<&-", 2, "-: "),
        (">&-", 2, "standard output: must be open to print to, but is closed: send it to"),
        ("2>&-", 0, ""),
        ("<&- 2>&-", 0, ""),
    ],
)
def test_closed_streams(drive, tmp_path, stream, code, message):
    case = "-" if stream == "<&-" else drive()
    command = f'"{WEARSIM}" life "{case}" --out "{tmp_path / "out"}" {stream}'
    done = subprocess.run(["sh", "-c", command], capture_output=True, text=True)
    assert (done.returncode, done.stderr[: len(message)]) == (code, message)
    assert (tmp_path / "out").exists() == (code == 0)


@pytest.mark.wide
@pytest.mark.parametrize("horizon", ["5e4", "3e5"])
def test_interrupted_run_is_130_and_leaves_nothing(drive, tmp_path, horizon):
    """Some 1e8 or 1e9 cycles one by one take minutes; to end takes seconds at most."""
    command = [
        sys.executable,
        "-c",
        STARTED,
        "life",
        drive(),
        "--out",
        tmp_path / "out",
        "--set",
        "run.method=per_cycle",
        "--set",
        f"run.horizon_hours={horizon}",
        "--set",
        "load.power_kW=1e-4",
    ]
    run = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        assert run.stdout.readline() == "started\n"
        run.send_signal(signal.SIGINT)
        out, err = run.communicate(timeout=10)
    finally:
        run.kill()
        run.communicate()
    assert (run.returncode, out) == (130, "")
    assert err.splitlines()[-1].startswith("interrupted")
    assert [entry.name for entry in tmp_path.iterdir()] == ["drive.toml"]


@pytest.mark.wide
@pytest.mark.parametrize("command", ["life", "profile"])
def test_folder_without_write_permission(drive, tmp_path, command):
    path = drive()
    closed = tmp_path / "closed"
    closed.mkdir(mode=0o555)
    # Root may write anywhere unless it gives that up.
    rights = "-dac_override,-dac_read_search"
    ordinary = ["setpriv", f"--bounding-set={rights}", f"--inh-caps={rights}"]
    done = subprocess.run(
        [*(ordinary if os.geteuid() == 0 else []), WEARSIM, command, path, "--out", closed / "out"],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 2
    assert done.stderr == f"{closed / 'out'}: must be writable: Permission denied\n"
    assert list(closed.iterdir()) == []
