"""A sweep of a million cases in bounded memory."""

import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

CASE = (Path(__file__).parents[2] / "cases" / "16b-20t-oiled.toml").as_posix()
STUDY = """
format_version = 1
case = "{case}"
[grid]
"sprocket.teeth" = [20, 21, 22, 23, 24, 25, 26, 27, 28, 30]
"load.tension_N" = {{from = 1000.0, to = 8000.0, count = 200, spacing = "log"}}
"load.speed_rpm" = {{from = 50.0, to = 200.0, count = 500}}
"""

RUN = """
import re, sys
from pathlib import Path
from wearsim.runner import run_study as runner
from wearsim.runner.design import content_hash
from wearsim.runner.store import open_store
from wearsim.runner.workers import Threads
from wearsim.study.sweep.model import load_sweep
from wearsim.study.sweep.sheet import sweep_json, sweep_lines, sweep_warning, write_sweep

def instantly(shard):
    numbers = range(shard.first, shard.first + shard.count)
    known = {
        "case_index": list(numbers),
        "stop": ["critical_depth_mm"] * shard.count,
        "warnings": [f"the pressure is {number % 900} MPa, above what is known" for number in numbers],
        "error": [""] * shard.count,
        "case_sha256": [content_hash({"case": number}) for number in numbers],
    }
    return {name: known.get(name, [1.0 + number for number in numbers]) for name in shard.columns}

runner.run_shard = instantly
folder = Path(sys.argv[1])
study = load_sweep(folder / "study.toml")
store = open_store(folder / "out", study.design, {"study": "sweep"}, False)
table = runner.run_study(study.design, Threads(1), store)
lines = sum(1 for _ in sweep_lines(study, table)), sum(1 for _ in sweep_json(study, table))
sweep_warning(table)
write_sweep(study, table, folder / "out")
most = re.search(r"VmHWM:\\s+(\\d+)", Path("/proc/self/status").read_text())[1]
print(*lines, int(most) * 1024 // 1_000_000)
"""


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="memory is read from /proc")
def test_million_cases_in_500_megabytes(tmp_path):
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    (tmp_path / "study.toml").write_text(STUDY.format(case=CASE))
    done = subprocess.run(
        [sys.executable, "-c", RUN, str(tmp_path)], capture_output=True, text=True, check=True, timeout=600
    )
    lines, objects, megabytes = map(int, done.stdout.split())
    assert (lines, objects) == (1_000_002, 1_000_000)
    with (tmp_path / "out" / "cases.csv").open() as file:
        assert sum(1 for _ in file) == 1_000_001
    assert megabytes < 500
