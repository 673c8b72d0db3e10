"""Life error against time of the ways to integrate wear: python tests/benchmarks/work_precision.py.

It takes some minutes on one core and writes work_precision.md and work_precision.svg to
reports/reference.
"""

import runpy
from pathlib import Path

if __name__ == "__main__":
    runpy.run_path(str(Path(__file__).with_name("precision")), run_name="__main__")
