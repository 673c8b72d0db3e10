"""No process of a study outlives the one that started it, however that ends."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

PARENT = """
import os, signal, time
from wearsim.runner.workers import Processes

if __name__ == "__main__":
    signal.signal(signal.SIGHUP, signal.SIG_DFL)  # what starts the tests, such as nohup, may ignore it
    with Processes(2).open() as (pool, count):
        pids = {pool.submit(os.getpid).result() for _ in range(20)}
        for _ in range(count):
            pool.submit(time.sleep, 600)
        print(*pids, flush=True)
        time.sleep(600)
"""


def alive(pid):
    try:
        state = Path(f"/proc/{pid}/stat").read_text("utf-8").rpartition(")")[2].split()[0]
    except OSError:
        return False
    return state != "Z"


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="processes are looked up in /proc")
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP, signal.SIGKILL])
def test_workers_end_with_their_parent(tmp_path, number):
    script = tmp_path / "parent.py"
    script.write_text(PARENT, "utf-8")
    with subprocess.Popen([sys.executable, script], stdout=subprocess.PIPE, text=True) as parent:
        workers = [int(pid) for pid in parent.stdout.readline().split()]
        assert workers
        assert all(map(alive, workers))
        parent.send_signal(number)
        parent.wait(timeout=30)
    for _ in range(300):
        if not any(map(alive, workers)):
            return
        time.sleep(0.1)
    for pid in filter(alive, workers):
        os.kill(pid, signal.SIGKILL)
    pytest.fail("a worker lives on")
