"""The report of one saved run as a whole process: its time, and how large the page is.

The goals are 2 s on an idle machine with two cores, 300 kB beside the script and 6 MB with it; the
sizes are held by tests/unit/test_report_page.py, the time is only told.
"""

import subprocess
import sys
from pathlib import Path

import pytest

import wearsim

COMMAND = str(Path(sys.executable).with_name("wearsim"))
CASES = Path(__file__).parents[2] / "cases"


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("report") / "run"
    wearsim.simulate(wearsim.load_case(CASES / "16b-20t-oiled.toml")).save(folder)
    return folder


@pytest.mark.parametrize("options", [(), ("--single-file",), ("--detail", "brief")])
def test_report_of_a_run(benchmark, rounds, run, tmp_path, options):
    out = tmp_path / "out"
    arguments = [COMMAND, "report", str(run), "--out", str(out), "--force", *options]
    benchmark.pedantic(lambda: subprocess.run(arguments, check=True, capture_output=True), rounds=rounds)
    benchmark.extra_info["page_kB"] = (out / "index.html").stat().st_size // 1000
