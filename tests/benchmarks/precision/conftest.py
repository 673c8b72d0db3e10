"""Nothing here is a test: tests/benchmarks/work_precision.py runs it."""

collect_ignore_glob = ["*.py"]
